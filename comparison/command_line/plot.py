"""``bentbeam plot``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line.options import Json, emit

__all__ = ["plot"]


def plot(
    files: Annotated[list[Path], typer.Argument(metavar="FILE.nc …", help="Histories written by simulate --out.")],
    out: Annotated[Path, typer.Option(help="Folder to write into.")] = Path("."),
    format: Annotated[list[str], typer.Option(help="png, pdf or svg; repeatable.")] = ["png"],  # noqa: B006
    as_json: Json = False,
) -> None:
    """Draw stored runs: beam, force map, impulse, energies.

    Example: bentbeam plot run.nc --out pictures
    """
    from bent_beam.history import ImpactHistory
    from comparison.figures.history import draw_history
    from comparison.store import check_writable

    histories = [(file.stem, ImpactHistory.load(file)) for file in files]
    check_writable(out, folder=True)
    drawn = [str(f) for name, history in histories for f in draw_history(history, out, name, format)]
    emit({"files": drawn}, as_json, lambda: "\n".join(drawn))
