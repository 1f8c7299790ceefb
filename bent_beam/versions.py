"""Which versions a result was computed with."""

from __future__ import annotations

import importlib.metadata

__all__ = ["versions"]


def versions() -> dict[str, str]:
    """Versions of what a result depends on, by distribution name."""
    found = {}
    for name in ("bent-beam-impact", "numpy", "scipy", "numba", "exudyn", "xarray"):
        try:
            found[name] = importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError:
            continue
    return found
