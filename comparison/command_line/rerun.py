"""``bentbeam rerun``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.console import Console
from comparison.command_line.options import Json, Overwrite, Quiet, check_out, emit

__all__ = ["rerun"]


def rerun(
    file: Annotated[Path, typer.Argument(metavar="FILE.nc", help="A history written by simulate --out.")],
    out: Annotated[Path | None, typer.Option(metavar="FILE.nc", help="Keep the new history.")] = None,
    overwrite: Overwrite = False,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Repeat a stored run and compare the two.

    Example: bentbeam rerun out/K10.nc
    """
    from bent_beam.history import ImpactHistory
    from comparison.rerun import rerun_history, rerun_text

    check_out(out, overwrite)
    with Console(quiet).progress(f"again: {file.name}") as bar:
        found = rerun_history(ImpactHistory.load(file), out, bar.fraction)
    emit(found, as_json, lambda: rerun_text(found))
