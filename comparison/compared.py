"""A number that was computed, its error bar, and what the theory says: one type from estimator to page."""

from __future__ import annotations

import math
from dataclasses import dataclass

__all__ = ["MISSING", "Compared"]


@dataclass(frozen=True)
class Compared:
    """``value`` ± ``error`` next to ``theory``; each is ``None`` where it does not exist, never 0 in its place.

    In JSON: ``{"value": …, "error": …, "theory": …}``.
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
    def measured(self) -> bool:
        """Whether there is a value."""
        return self.value is not None

    @property
    def difference(self) -> float | None:
        """``value`` − ``theory``."""
        return None if self.value is None or self.theory is None else self.value - self.theory

    def relative(self, least: float = 0.0) -> float | None:
        """The difference over the larger of |theory| and ``least``; absolute where both are 0."""
        if self.difference is None or self.theory is None:
            return None
        return self.difference / self._unit(least)

    def relative_error(self, least: float = 0.0) -> float | None:
        """The error bar in the same unit as :meth:`relative`."""
        return None if self.error is None or self.theory is None else self.error / self._unit(least)

    @property
    def covered(self) -> bool | None:
        """Whether the error bar holds the theory."""
        return None if self.difference is None or self.error is None else abs(self.difference) <= self.error

    def _unit(self, least: float) -> float:
        return max(abs(self.theory or 0.0), least) or 1.0

    def __str__(self) -> str:
        if self.value is None:
            return "-"
        return f"{self.value:.6g}" if self.error is None else f"{self.value:.6g}±{self.error:.0e}"


MISSING = Compared()
