"""A number that was computed, its error bar, and what the theory says: one type from the estimator to the page."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

__all__ = ["MISSING", "Band", "Measured"]

LARGE, SMALL = 1e6, 1e-4  # beyond, numbers are written with a power of ten


@dataclass(frozen=True)
class Measured:
    """``value`` ± ``error`` (about two standard deviations, systematic part included) next to ``theory``.

    Each is ``None`` where it does not exist, never 0 in its place. In JSON: ``{"value": …, "error": …, "theory": …}``.
    """

    value: float | None = None
    error: float | None = None
    theory: float | None = None

    def __post_init__(self) -> None:
        for name in ("value", "error", "theory"):
            number = getattr(self, name)
            if number is not None:
                object.__setattr__(self, name, float(number) if math.isfinite(number) else None)

    @property
    def known(self) -> float:
        """The value. Raises ``ValueError`` where there is none."""
        if self.value is None:
            raise ValueError("there is no value")
        return self.value

    @property
    def bar(self) -> float:
        """The error bar; infinite where it is not known."""
        return math.inf if self.error is None else self.error

    @property
    def measured(self) -> bool:
        """Whether there is a value."""
        return self.value is not None

    @property
    def difference(self) -> float | None:
        """``value`` − ``theory``."""
        return None if self.value is None or self.theory is None else self.value - self.theory

    def relative(self, least: float = 0.0) -> float | None:
        """The difference over the larger of |theory| and ``least``; absolute where both are 0."""
        return None if self.difference is None else self.difference / self._unit(least)

    def relative_error(self, least: float = 0.0) -> float | None:
        """The error bar in the same unit as :meth:`relative`."""
        return None if self.error is None or self.theory is None else self.error / self._unit(least)

    @property
    def covered(self) -> bool | None:
        """Whether the error bar holds the theory."""
        return None if self.difference is None or self.error is None else abs(self.difference) <= self.error

    def scaled(self, unit: float, shift: float = 0.0) -> Measured:
        """The number in another unit, and a known constant added."""
        value, theory = (None if v is None else v * unit + shift for v in (self.value, self.theory))
        return Measured(value, None if self.error is None else self.error * unit, theory)

    def to_dict(self) -> dict[str, Any]:
        """Value and error alone, JSON-ready."""
        return {"value": self.value, "error": self.error}

    def _unit(self, least: float) -> float:
        return max(abs(self.theory or 0.0), least) or 1.0

    def __str__(self) -> str:
        """As many digits as the error bar carries."""
        if self.value is None:
            return "-"
        return f"{self.value:.6g}" if not self.error else _with_bar(self.value, self.error)


MISSING = Measured()


@dataclass(frozen=True)
class Band:
    """Mean and standard deviation of a number over so many runs, where it does not converge."""

    mean: float
    std: float
    runs: int
    value: ClassVar[None] = None
    error: ClassVar[None] = None

    @classmethod
    def of(cls, values: Sequence[float]) -> Band:
        """Of the values of at least two runs."""
        return cls(statistics.fmean(values), statistics.stdev(values), len(values))

    def scaled(self, unit: float, shift: float = 0.0) -> Band:
        """The band in another unit, and a known constant added."""
        return Band(self.mean * unit + shift, self.std * unit, self.runs)

    def to_dict(self) -> dict[str, Any]:
        """No value and no error, and the band, JSON-ready."""
        return {"value": None, "error": None, "band": {"mean": self.mean, "std": self.std, "runs": self.runs}}

    def __str__(self) -> str:
        band = _with_bar(self.mean, self.std) if math.isfinite(self.mean) and math.isfinite(self.std) else "-"
        return f"{band} (band of {self.runs} runs)"


def _with_bar(value: float, error: float) -> str:
    """``value`` ± ``error``, both to the first digit of the error."""
    if error <= 0.0:
        return f"{value:.6g} ± {error:.1g}"
    error = float(f"{error:.1g}")
    power = math.floor(math.log10(max(abs(value), error)))
    if not SMALL <= 10.0**power < LARGE:
        return f"({_with_bar(value / 10.0**power, error / 10.0**power)})e{power:+03d}"
    digits = -math.floor(math.log10(error))
    places = min(max(0, digits), 12)
    size = f"{error:.{places}f}" if digits <= places else f"{error:.1g}"
    return f"{round(value, digits) + 0.0:.{places}f} ± {size}"  # not −0
