"""Numbers as engineers write them: kN and kN m from a hundred on, MPa, ms; as many digits as the error bar carries."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from measure.measured import Band, Measured

__all__ = ["milliseconds", "number_from", "unit_for"]


def unit_for(unit: str, values: Iterable[float | None]) -> tuple[float, str]:
    """Factor and name of the unit in which ``values`` (N, N m, Pa, s) are written."""
    if unit == "Pa":
        return 1e-6, "MPa"
    if unit == "s":
        return 1e3, "ms"
    largest = max((abs(value) for value in values if value is not None), default=0.0)
    return (1e-3, f"k{unit}") if unit.startswith("N") and unit != "N s" and largest >= 100.0 else (1.0, unit)


def number_from(found: dict[str, Any] | None) -> Measured | Band:
    """The number that a document holds."""
    if found and found.get("band"):
        return Band(**found["band"])
    return Measured(found["value"], found["error"]) if found else Measured()


def milliseconds(time: float) -> str:
    """A time, s, for a sentence."""
    return f"{1e3 * time:.3g} ms"
