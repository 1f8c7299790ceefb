"""Numbers as engineers write them: kN and kN m from a hundred on, mm below a centimetre, MPa, ms; as many digits as
the error bar carries."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from bent_beam.impact import Impact
from measure.measured import Band, Measured

__all__ = ["milliseconds", "number_from", "scales", "unit_for"]


def unit_for(unit: str, values: Iterable[float | None]) -> tuple[float, str]:
    """Factor and name of the unit in which ``values`` (N, N m, N/m, m, Pa, s) are written."""
    if unit == "Pa":
        return 1e-6, "MPa"
    if unit == "s":
        return 1e3, "ms"
    largest = max((abs(value) for value in values if value is not None), default=0.0)
    if unit == "m":
        return (1e3, "mm") if largest < 1e-2 else (1.0, unit)
    return (1e-3, f"k{unit}") if unit.startswith("N") and unit != "N s" and largest >= 100.0 else (1.0, unit)


def number_from(found: dict[str, Any] | None) -> Measured | Band:
    """The number that a document holds."""
    if found and found.get("band"):
        return Band(**found["band"])
    return Measured(found["value"], found["error"]) if found else Measured()


def milliseconds(time: float) -> str:
    """A time, s, for a sentence."""
    return f"{1e3 * time:.3g} ms"


def scales(impact: Impact) -> dict[str, float]:
    """SI units of the dimensionless numbers: N s, s, N m, J."""
    return {
        "impulse": impact.mass_per_length * impact.half_length * impact.velocity,
        "time": impact.slow_time_scale,
        "moment": impact.velocity * math.sqrt(impact.bending_stiffness * impact.mass_per_length),
        "energy": 0.5 * impact.mass_per_length * impact.length * impact.velocity**2,
        "length": impact.half_length,
        "force": impact.mass_per_length * impact.half_length * impact.velocity / impact.slow_time_scale,
    }
