"""The drill pipe of ``cases/drill_pipe.toml`` in SI units: what ``bentbeam predict`` says of it, as a table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bent_beam.cases import Case, load_case
from bent_beam.errors import InputError
from comparison.prediction import predict_case

__all__ = ["COLUMNS", "Pipe", "pipe_prediction"]

CASE = Path(__file__).resolve().parents[1] / "cases" / "drill_pipe.toml"
TIMES = (0.001, 0.005, 0.010)  # s
COLUMNS = {
    "half_contact_length": ("λ<sub>c</sub>, m", 1.0),
    "reaction": ("R, kN", 1e3),
    "impulse": ("impulse, N s", 1.0),
    "peak_moment": ("bending moment, kN m", 1e3),
    "peak_stress": ("stress, MPa", 1e6),
}
"""Name → heading and its unit."""


@dataclass(frozen=True)
class Pipe:
    """The case and its table: time (ms), by what, and a text for each of :data:`COLUMNS`."""

    case: Case
    rows: list[tuple[str, str, list[str]]]
    valid_until: float | None
    limited_by: str | None


def pipe_prediction(file: Path = CASE) -> Pipe | None:
    """The prediction of a case, or ``None`` where this installation has no such file."""
    try:
        case = load_case(file)
    except InputError:
        return None
    document = predict_case(case, TIMES)
    rows = []
    for row in document["times"]:
        for by, numbers in (("theory", row), ("simulation", row.get("simulation"))):
            if numbers is not None:
                rows.append((f"{1000.0 * row['time']:g}", by, [_text(numbers, name) for name in COLUMNS]))
    return Pipe(case, rows, document.get("valid_until"), document.get("limited_by"))


def _text(numbers: Mapping[str, Any], name: str) -> str:
    """A number in its column's unit, with its error bar where it has one."""
    number, unit = numbers.get(name), COLUMNS[name][1]
    value, bar = (number.get("value"), number.get("error")) if isinstance(number, Mapping) else (number, None)
    if value is None:
        return "–"
    return f"{value / unit:.4g}" + ("" if bar is None else f" ± {bar / unit:.1g}")
