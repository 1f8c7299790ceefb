"""The commands on stored histories: ``bentbeam rerun``, ``plot``, ``compare``."""

from pathlib import Path
from typing import Annotated

import typer

from comparison.command_line import options
from comparison.command_line.options import check_out, emit, progress


def rerun(
    file: Annotated[Path, typer.Argument(metavar="FILE.nc", help="A history written by simulate --out.")],
    out: Annotated[Path | None, typer.Option(metavar="FILE.nc", help="Keep the new history.")] = None,
    overwrite: options.Overwrite = False,
    as_json: options.Json = False,
    quiet: options.Quiet = False,
) -> None:
    """Repeat a stored run and compare the two.

    Example: bentbeam rerun out/K10.nc
    """
    from bent_beam.history import ImpactHistory
    from comparison.compare import rerun_history, rerun_text

    check_out(out, overwrite, ".nc")
    with progress(f"again: {file.name}", quiet) as bar:
        found = rerun_history(ImpactHistory.load(file), out, bar.fraction)
    emit(found, as_json, lambda: rerun_text(found))


def plot(
    files: Annotated[list[Path], typer.Argument(metavar="FILE.nc …", help="Histories written by simulate --out.")],
    out: Annotated[Path, typer.Option(help="Folder to write into.")] = Path("."),
    format: Annotated[list[str], typer.Option(help="png, pdf or svg; repeatable.")] = ["png"],  # noqa: B006
    as_json: options.Json = False,
) -> None:
    """Draw stored runs: force, stress, contact, shapes, energies.

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


def compare(
    first: Annotated[Path, typer.Argument(metavar="A.nc", help="A history written by simulate --out.")],
    second: Annotated[Path, typer.Argument(metavar="B.nc", help="The history to compare with it.")],
    as_json: options.Json = False,
) -> None:
    """Compare two stored runs: their numbers and their settings.

    Example: bentbeam compare hermite.nc exudyn.nc
    """
    from bent_beam.history import ImpactHistory
    from comparison.compare import compare_histories, comparison_text

    found = compare_histories(ImpactHistory.load(first), ImpactHistory.load(second))
    emit(found, as_json, lambda: comparison_text(found, str(first), str(second)))
