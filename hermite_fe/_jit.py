"""How the kernels of this package are compiled: cached on disk, so that a second start pays nothing."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numba

__all__ = ["compiled", "compiled_sums"]

Function = TypeVar("Function", bound=Callable[..., Any])


def compiled(function: Function) -> Function:
    """Compile with multiply–add contraction only: the order of sums is kept, as compensated sums need."""
    return cast(Function, numba.njit(cache=True, error_model="numpy", fastmath={"contract"})(function))


def compiled_sums(function: Function) -> Function:
    """Compile with sums reordered for speed, for kernels to which their order is nothing."""
    options: Any = {"contract", "reassoc"}
    return cast(Function, numba.njit(cache=True, error_model="numpy", fastmath=options)(function))
