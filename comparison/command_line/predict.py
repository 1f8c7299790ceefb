"""``bentbeam predict``."""

from __future__ import annotations

from typing import Annotated

import typer

from comparison.command_line.console import Console
from comparison.command_line.options import CaseFile, Json, Quiet, Set, emit

__all__ = ["predict"]


def predict(
    case: CaseFile,
    time: Annotated[
        list[float] | None, typer.Option(help="Time after first contact, s, in place of end_time; repeatable.")
    ] = None,
    theory_only: Annotated[
        bool, typer.Option("--theory-only", help="Closed forms only, without simulation.")
    ] = False,
    assignments: Set = None,
    as_json: Json = False,
    quiet: Quiet = False,
) -> None:
    """Predict contact and stress: theory beside a simulation.

    Prints contact, force, impulse, moment, stress and rebound. For plates, stops and supports: simulate.

    Example: bentbeam predict cases/drill_pipe.toml --time 0.005 --time 0.01
    """
    from bent_beam.cases import load_case
    from bent_beam.errors import InputError
    from comparison.prediction import predict_case
    from comparison.prediction_text import prediction_text

    loaded = load_case(case, assignments or ())
    loaded.method("hermite")  # every table of the case is looked at, also where nothing is simulated
    times = time or [loaded.end_time]
    for one in times:
        try:
            loaded.impact.checked_time("time", one)
        except ValueError as error:
            raise InputError(f"--time: {error}") from None
    with Console(quiet or as_json or theory_only).progress(f"the whole beam: {case.name}") as bar:
        document = predict_case(loaded, times, theory_only=theory_only, progress=bar.fraction)
    emit(document, as_json, lambda: prediction_text(document))
