"""``bentbeam predict``."""

from __future__ import annotations

from typing import Annotated

import typer

from comparison.command_line.console import Console
from comparison.command_line.options import CaseFile, Json, Quiet, Set, emit

__all__ = ["predict"]


def predict(
    case: CaseFile,
    time: Annotated[list[float] | None, typer.Option(help="Time after first contact, s; repeatable.")] = None,
    simulate: Annotated[
        bool, typer.Option("--simulate", help="Answer by the whole-beam solver too, ends and loads included.")
    ] = False,
    assignments: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Predict contact, force and stress of a case by theory.

    The answer says until when it holds and what ends it.

    Example: bentbeam predict cases/drill_pipe.toml --time 0.005 --time 0.01
    """
    from bent_beam.cases import load_case
    from comparison.verdict import verdict, verdict_text

    loaded = load_case(case, assignments or ())
    times = time or [loaded.end_time]
    if simulate:
        with Console(quiet or as_json).progress(f"the whole beam: {case.name}") as bar:
            document = verdict(loaded, times, simulate=True, progress=bar.fraction)
    else:  # at once: a bar would take longer to set up
        document = verdict(loaded, times)
    emit(document, as_json, lambda: verdict_text(document))
