"""The drill pipe of ``cases/drill_pipe.toml`` in SI units: its first instants, its whole impact, and that over a range
of damping. All that the report takes of whole impacts from :mod:`comparison` passes here, so that its numbers are those
of ``bentbeam predict``, to the digit."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bent_beam.cases import EXAMPLES, load_case
from comparison.predicting import predict_case
from comparison.readable import number_from
from comparison.store import RunStore
from comparison.texts import validity_text

PIPE = EXAMPLES / "drill_pipe.toml"
TIMES = (0.001, 0.005, 0.010)  # s
COLUMNS = {  # of the first instants: name → heading and its unit
    "half_contact_length": ("λ<sub>c</sub>, m", 1.0),
    "reaction": ("R, kN", 1e3),
    "impulse": ("impulse, N s", 1.0),
    "peak_moment": ("bending moment, kN m", 1e3),
    "peak_stress": ("stress, MPa", 1e6),
}
WHOLE = {
    "restitution": ("coefficient of restitution {}", 1.0),
    "last_contact": ("last contact after {} s", 1.0),
    "peak_stress": ("largest stress {} MPa", 1e6),
}


def pipe_prediction(file: Path = PIPE, store: RunStore | None = None) -> dict[str, Any]:
    """The prediction of the pipe of a case file.

    case; rows : time (ms), by what, and a text for each of :data:`COLUMNS`; validity : of the theory, in words; whole :
    texts of the whole impact as the case states it; damping : (ratio in %, largest stress in MPa); yield_stress, MPa.
    """
    case = load_case(file)
    document = predict_case(case, TIMES, store=store).to_dict()
    rows = [
        (f"{1000.0 * row['time']:g}", by, [text(numbers.get(name), unit) for name, (_, unit) in COLUMNS.items()])
        for row in document["times"]
        for by, numbers in (("theory", row), ("simulation", row.get("simulation")))
        if numbers is not None
    ]
    whole, yields = document["whole_impact"] or {}, document["yield_stress"]
    ratios = whole.get("over_damping") or ()
    return {
        "case": case,
        "rows": rows,
        "validity": validity_text(document),
        "whole": [words.format(text(whole.get(key), unit)) for key, (words, unit) in WHOLE.items()],
        "damping": [(f"{100.0 * r['damping_ratio']:g}", text(r["peak_stress"], 1e6)) for r in ratios],
        "yield_stress": None if yields is None else f"{yields / 1e6:.4g}",
    }


def text(number: Any, unit: float) -> str:
    """A number in its column's unit, with its error bar or band where it has one, as ``bentbeam predict`` writes it."""
    if not isinstance(number, Mapping):
        return "–" if number is None else f"{number / unit:.4g}"
    return str(number_from(dict(number)).scaled(1.0 / unit))
