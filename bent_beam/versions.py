"""Which versions a result was computed with, when and on what."""

import contextlib
import importlib.metadata
import platform
from datetime import UTC, datetime
from functools import cache
from pathlib import Path
from typing import Any


def versions() -> dict[str, str]:
    """Versions of what a result depends on, by distribution name."""
    names = ("bent-beam-impact", "numpy", "scipy", "numba", "exudyn", "xarray")
    return {name: version for name in names if (version := _version(name)) is not None}


@cache
def _version(name: str) -> str | None:
    """Of a distribution; what is installed does not change while Python runs."""
    try:
        return importlib.metadata.version(name)
    except importlib.metadata.PackageNotFoundError:
        return None


def today() -> str:
    """The day (UTC), as in 2026-11-22."""
    return datetime.now(UTC).date().isoformat()


def stamp(made_by: str) -> dict[str, Any]:
    """Where stored numbers are from: the command that makes them anew, the day (UTC) and the versions."""
    return {"made_by": made_by, "date": today(), "versions": versions()}


def processor() -> str:
    """The processor's name as its maker gives it, where the system tells."""
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines():
            if line.lower().startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()
