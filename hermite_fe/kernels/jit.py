"""How the kernels of this package are compiled: cached on disk, so that a second start pays nothing."""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, TypeVar, cast

import numba
from numba.core.caching import FunctionCache, IndexDataCacheFile

__all__ = ["compiled", "compiled_sums", "inlined"]

Function = TypeVar("Function", bound=Callable[..., Any])


def sources() -> str:
    """Digest of all modules of this package."""
    texts = (path.read_bytes() for path in sorted(Path(__file__).parent.glob("*.py")))
    return hashlib.sha256(b"\0".join(texts)).hexdigest()


SOURCES = sources()


class KernelCache(FunctionCache):
    """Numba's cache, stale as soon as any module of the package changes.

    Numba itself looks at the kernel's own file only, and would go on running what that kernel had called before
    (``theta`` with the ``pivoting`` of the version before an upgrade).
    """

    def __init__(self, kernel: Callable[..., Any]) -> None:
        super().__init__(kernel)
        self._cache_file = IndexDataCacheFile(
            cache_path=self._cache_path, filename_base=self._impl.filename_base, source_stamp=SOURCES
        )

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        found = super().load_overload(signature, target_context)
        if found is None:
            _say_once()
        return found


@cache
def _say_once() -> None:
    """To the logger that the command shows on standard error."""
    logging.getLogger("bent_beam").info("compiling, as always on a new machine or after an update: about ten seconds")


def kernel(function: Function, **options: Any) -> Function:
    """``function`` compiled at its first call or loaded; as it is under ``NUMBA_DISABLE_JIT=1``, to step through it."""
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]  # set as numba is imported
        return function
    dispatcher = numba.njit(error_model="numpy", **options)(function)
    template = dispatcher.get_call_template

    def without_literals(arguments: tuple[Any, ...], names: dict[str, Any]) -> Any:
        """Numba would compile a kernel once more for each number that a call writes out, as ``first = 0``."""
        return template(tuple(numba.types.unliteral(a) for a in arguments), names)

    dispatcher.get_call_template = without_literals
    try:
        dispatcher._cache = KernelCache(dispatcher.py_func)
    except RuntimeError:  # neither this folder nor the user's can be written: compiled anew at every start
        pass
    return cast(Function, dispatcher)


def compiled(function: Function) -> Function:
    """Compile with multiply–add contraction only: the order of sums is kept, as compensated sums need."""
    return kernel(function, fastmath={"contract"})


def compiled_sums(function: Function) -> Function:
    """Compile with sums reordered for speed, for kernels to which their order is nothing."""
    return kernel(function, fastmath={"contract", "reassoc"})


def inlined(function: Function) -> Function:
    """Write ``function`` into the kernels that call it before they are compiled: for arithmetic that several share.

    As a kernel of its own it would be compiled for itself and once more within each caller, with other contractions.
    Which of the two then runs depends on what the cache holds, so a first run and a second one would differ in their
    last digits (measured).
    """
    return cast(Function, numba.njit(inline="always")(function))
