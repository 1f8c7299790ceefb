"""``bentbeam predict``."""

from __future__ import annotations

from typing import Annotated

import typer

from comparison.command_line.options import CaseFile, Json, Set, emit

__all__ = ["predict"]


def predict(
    case: CaseFile,
    time: Annotated[list[float] | None, typer.Option(help="Time after first contact, s; repeatable.")] = None,
    assignments: Set = None,
    as_json: Json = False,
) -> None:
    """Contact length, reaction and impulse in SI units, and whether the theory holds there.

    Example: bentbeam predict cases/drill_pipe.toml --time 0.005 --time 0.01
    """
    from bent_beam.cases import load_case
    from comparison.validity import add_measured_errors
    from theory import predict as predict_impact

    loaded = load_case(case, assignments or ())
    prediction = predict_impact(loaded.impact, time or [loaded.end_time])
    document = prediction.to_dict()
    notes = add_measured_errors(document)
    emit(document, as_json, lambda: "\n".join([prediction.summary(), *notes]))
