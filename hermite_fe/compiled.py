"""Compilation of this package's loops: plain numba, cached in a folder named by the digest of the sources.

Numba checks only a function's own file for changes. A folder for each version of the package invalidates its callers
too. A file that cannot be read or written costs the time to compile, never a wrong answer (:func:`recompiling`).
"""

import hashlib
import logging
import os
import shutil
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from functools import wraps
from pathlib import Path
from traceback import walk_tb
from typing import Any, TypeVar, cast

import numba
import numpy as np
from numba.extending import overload, register_jitable
from numpy.typing import NDArray
from platformdirs import user_cache_path

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]
Function = TypeVar("Function", bound=Callable[..., Any])
Result = TypeVar("Result")

CACHE = "numba.core.caching"  # the module in which a file of the folder is read or written
UNUSED = 30 * 86400.0  # s
LEAST_SPACE = 100e6  # bytes that must be free on the disk before anything is kept there


def digest_of_sources() -> str:
    """Digest of every module of this package."""
    files = sorted(Path(__file__).parent.rglob("*.py"))
    return hashlib.sha256(b"\0".join(file.read_bytes() for file in files)).hexdigest()[:16]


FOLDER = user_cache_path("bentbeam") / f"compiled-{digest_of_sources()}"


def can_be_kept() -> bool:
    """Whether the folder can be written and its disk has room."""
    try:
        FOLDER.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=FOLDER).close()
        return shutil.disk_usage(FOLDER).free > LEAST_SPACE
    except OSError:
        return False


def forget_old() -> None:
    """Note that the folder is in use; remove those of other versions that have not been for ``UNUSED``."""
    with suppress(OSError):
        os.utime(FOLDER)
        for other in FOLDER.parent.glob("compiled-*"):
            if time.time() - other.stat().st_mtime > UNUSED:
                shutil.rmtree(other, ignore_errors=True)


KEPT = can_be_kept()
if KEPT:
    forget_old()

ARITHMETIC: dict[str, Any] = {"error_model": "numpy", "fastmath": {"contract"}}
"""Sums may be contracted to fused multiply-adds; nothing else of IEEE arithmetic is given up."""


def compiled_within(function: Function) -> Function:
    """``function`` compiled as a part of the compiled functions that call it; from Python it is called as it stands.

    It needs no way in from Python, which for the data of a run takes long to compile.
    """
    return cast(Function, register_jitable(**ARITHMETIC)(function))


def compiled(function: Function) -> Function:
    """``function`` compiled at its first call for the types of its arguments, and kept on disk where possible.

    Compiled functions that call it take it in as a part, without a way in from Python.
    """
    before = numba.config.CACHE_DIR  # type: ignore[attr-defined]
    numba.config.CACHE_DIR = str(FOLDER)  # type: ignore[attr-defined]
    try:
        alone = numba.njit(cache=KEPT, **ARITHMETIC)(function)
    finally:
        numba.config.CACHE_DIR = before  # type: ignore[attr-defined]

    @wraps(function)
    def from_python(*arguments: Any, **named: Any) -> Any:
        return alone(*arguments, **named)

    overload(from_python, jit_options=cast(Any, ARITHMETIC), strict=False)(lambda *arguments: function)
    return cast(Function, from_python)


def recompiling(call: Callable[[], Result]) -> Result:
    """Run ``call``, which may be the first to need compiled functions; return what it returns.

    A torn file in the folder, or a disk that has become full, makes numba's cache raise whatever the file made of it.
    The folder is then removed and ``call`` tried again. What ``call`` itself raises is the caller's.
    """
    if not any(FOLDER.rglob("*.nbi")):
        message = "compiling, as always on a new machine or after an update: some twenty seconds"
        logging.getLogger("bent_beam").info(message)
    try:
        return call()
    except Exception as error:
        if not KEPT or not any(frame.f_globals.get("__name__") == CACHE for frame, _ in walk_tb(error.__traceback__)):
            raise
        shutil.rmtree(FOLDER, ignore_errors=True)
        return call()
