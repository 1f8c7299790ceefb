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
    from itertools import chain, count

    from bent_beam.history import ImpactHistory
    from comparison.figures.history import draw_history
    from comparison.store import check_writable

    histories: dict[str, ImpactHistory] = {}
    for file in files:
        names = chain([file.stem], (f"{file.stem}-{k}" for k in count(2)))
        name = next(n for n in names if n not in histories)
        histories[name] = ImpactHistory.load(file)
    check_writable(out, folder=True)
    kinds = list(dict.fromkeys(format))
    drawn = [str(f) for name, history in histories.items() for f in draw_history(history, out, name, kinds)]
    emit({"files": drawn}, as_json, lambda: "\n".join(drawn))
