"""Types of arrays, and checks of values that may be left open."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

__all__ = ["Array", "Flags", "Indices", "unless_open"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.int64]


def unless_open(check: Callable[[str, float], float], name: str, value: float | None) -> None:
    """``check`` a value that is given. Raises what ``check`` raises."""
    if value is not None:
        check(name, value)
