"""``bentbeam compare``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.options import Json, emit

__all__ = ["compare"]


def compare(
    first: Annotated[Path, typer.Argument(metavar="A.nc", help="A history written by simulate --out.")],
    second: Annotated[Path, typer.Argument(metavar="B.nc", help="The history to compare with it.")],
    as_json: Json = False,
) -> None:
    """Compare two stored runs: their numbers and their settings.

    Example: bentbeam compare hermite.nc exudyn.nc
    """
    from bent_beam.history import ImpactHistory
    from comparison.compare import compare_histories, comparison_text

    found = compare_histories(ImpactHistory.load(first), ImpactHistory.load(second))
    emit(found, as_json, lambda: comparison_text(found, str(first), str(second)))
