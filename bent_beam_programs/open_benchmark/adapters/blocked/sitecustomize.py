"""Puts the answers out of an adapter's reach: Python imports this file at its start, before the adapter.

A protection from accident and vanity, not from fraud: tables of runs rest on drawn problems, nodal histories and gaps.
"""

import sys
from typing import Any

ANSWERS = {"theory", "bent_beam.measure", "comparison", "bent_beam_programs", "benchmarks"}


class OutOfReach:
    """A finder that knows these packages, and gives none of them away."""

    @staticmethod
    def find_spec(name: str, path: Any = None, target: Any = None) -> None:
        if name in ANSWERS:
            raise ModuleNotFoundError(f"{name} is out of reach of an adapter (a module of your own needs another name)")


sys.meta_path.insert(0, OutOfReach)
