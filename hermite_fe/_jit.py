"""How the kernels of this package are compiled: cached on disk, so that a second start pays nothing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numba

__all__ = ["compiled", "compiled_sums"]

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Compile with multiply–add contraction only: the order of sums is kept, as compensated sums need."""
    return numba.njit(cache=True, error_model="numpy", fastmath={"contract"})(function)  # type: ignore[no-any-return]


def compiled_sums(function: Function) -> Function:
    """Compile with sums reordered for speed, for kernels to which their order is nothing."""
    return numba.njit(cache=True, error_model="numpy", fastmath={"contract", "reassoc"})(function)  # type: ignore[no-any-return]
