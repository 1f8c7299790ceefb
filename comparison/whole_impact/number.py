"""A number of a whole impact with its error bar; importing it takes nothing that follows an impact."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["NUMBERS", "Number"]

NUMBERS = (
    "restitution",
    "impulse",
    "last_contact",
    "separations",
    "peak_moment",
    "peak_moment_place",
    "peak_moment_time",
    "midspan_moment",
    "translation",
    "vibration",
    "dissipated",
)
"""Fields of :class:`comparison.whole_impact.outcome.WholeImpact` that get error bars."""


@dataclass(frozen=True)
class Number:
    """A number of a whole impact: ``value`` with its ``error`` bar and its ``parts`` by cause, or, without damping,
    ``mean`` and ``std`` of an ensemble of ``runs``."""

    value: float | None = None
    error: float | None = None
    parts: Mapping[str, float] = dataclasses.field(default_factory=dict)
    mean: float | None = None
    std: float | None = None
    runs: int = 0

    def scaled(self, unit: float) -> Number:
        """The number in another unit."""

        def times(number: float | None) -> float | None:
            return None if number is None else number * unit

        parts = {cause: part * unit for cause, part in self.parts.items()}
        return Number(times(self.value), times(self.error), parts, times(self.mean), times(self.std), self.runs)

    def shifted(self, by: float) -> Number:
        """The number and a known constant."""
        moved = {name: None if at is None else at + by for name, at in (("value", self.value), ("mean", self.mean))}
        return dataclasses.replace(self, **moved)  # type: ignore[arg-type]

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready: ``value`` and ``error``, or ``band``; what is missing is null."""
        if self.runs:
            return {"value": None, "error": None, "band": {"mean": self.mean, "std": self.std, "runs": self.runs}}
        return {"value": self.value, "error": self.error}

    def __str__(self) -> str:
        if self.runs:
            return f"{self.mean:.4g} ± {self.std:.1g} (band of {self.runs} runs)"
        if self.value is None or self.error is None:
            return "-"
        if self.error == 0.0:
            return f"{self.value:g}"
        digits = min(max(0, 1 - math.floor(math.log10(self.error))), 12)
        return f"{self.value:.{digits}f} ± {self.error:.1g}"
