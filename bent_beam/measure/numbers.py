"""A number that was computed, its bar, and what the theory says: one type from the estimator to the page, one rule for
its bar, with one factor (``make coverage`` says how often the bars hold)."""

from __future__ import annotations

import math
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

__all__ = ["FACTOR", "LEAST", "MISSING", "Band", "Number", "number_of"]

FACTOR = 1.25  # of what a companion changes; `make coverage` draws fresh beams and methods to hold it against
LEAST = 1e-5  # of a number, unless no companion changes it at all: closer agreement than this is chance

LARGE, SMALL = 1e6, 1e-4  # beyond, numbers are written with a power of ten


@dataclass(frozen=True)
class Number:
    """``value`` ± ``bar`` in ``unit``, next to ``theory``. The bar is about two standard deviations, systematic part
    included: the sum of its ``parts``, by cause, where they are known. Each is ``None`` where it does not exist, never
    0 in its place. In JSON: ``{"value": …, "error": …, "theory": …}``, the error being the bar."""

    value: float | None = None
    bar: float | None = None
    theory: float | None = None
    unit: str = ""
    parts: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("value", "bar", "theory"):
            number = getattr(self, name)
            if number is not None:
                object.__setattr__(self, name, float(number) if math.isfinite(number) else None)

    @property
    def known(self) -> float:
        """The value, for those who need one (``known`` of :func:`number_of` is another thing: sizes of errors). Raises
        ``ValueError`` where there is none."""
        if self.value is None:
            raise ValueError("there is no value")
        return self.value

    @property
    def spread(self) -> float:
        """The bar; infinite where it is not known."""
        return math.inf if self.bar is None else self.bar

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

    def relative_bar(self, least: float = 0.0) -> float | None:
        """The bar in the same unit as :meth:`relative`."""
        return None if self.bar is None or self.theory is None else self.bar / self._unit(least)

    @property
    def covered(self) -> bool | None:
        """Whether the bar holds the theory."""
        return None if self.difference is None or self.bar is None else abs(self.difference) <= self.bar

    def scaled(self, unit: float, shift: float = 0.0, name: str = "") -> Number:
        """The number in another unit, called ``name``, and a known constant added."""
        value, theory = (None if v is None else v * unit + shift for v in (self.value, self.theory))
        parts = {cause: part * abs(unit) for cause, part in self.parts.items()}
        return Number(value, None if self.bar is None else self.bar * abs(unit), theory, name, parts)

    def to_dict(self) -> dict[str, Any]:
        """Value and bar, and the theory where there is one, JSON-ready."""
        return {"value": self.value, "error": self.bar} | ({} if self.theory is None else {"theory": self.theory})

    def compared(self) -> dict[str, float | None]:
        """Value, bar and theory, each there or ``None``, JSON-ready."""
        return {"value": self.value, "error": self.bar, "theory": self.theory}

    def _unit(self, least: float) -> float:
        return max(abs(self.theory or 0.0), least) or 1.0

    def __str__(self) -> str:
        """As many digits as the bar carries."""
        if self.value is None:
            return "-"
        return f"{self.value:.6g}" if not self.bar else _with_bar(self.value, self.bar)


def number_of(
    value: float | None,
    others: Mapping[str, float | None],
    known: Mapping[str, float] | None = None,
    *,
    theory: float | None = None,
    least: float = LEAST,
) -> Number:
    """The number that a run gives. Its bar is :data:`FACTOR` times what each companion changes, and what is known.

    others : cause → the value of a run that differs from this one by that cause alone: half of the elements and steps,
        another contact law. What both share is no cause that they can see.
    known : cause → size of an error that no companion shows, as of an element or a fit; not :attr:`Number.known`.
    A bar is ``least`` of the value, or more. Without a value there is no number; without companions, and where one
    of them has no value, there is no bar.

    >>> str(number_of(0.51, {"mesh_and_step": 0.508, "contact_law": 0.511}))
    '0.510 ± 0.004'
    """
    if value is None:
        return Number(theory=theory)
    if not others or any(other is None for other in others.values()):
        return Number(value, theory=theory)
    changed = {cause: FACTOR * abs(other - value) for cause, other in others.items() if other is not None}
    parts = changed | dict(known or {})
    if 0.0 < (found := sum(parts.values())) < least * abs(value):
        parts["chance"] = least * abs(value) - found
    return Number(value, sum(parts.values()), theory, parts=parts)


MISSING = Number()


@dataclass(frozen=True)
class Band:
    """Mean and standard deviation of a number over so many runs, where it does not converge."""

    mean: float
    std: float
    runs: int
    value: ClassVar[None] = None
    bar: ClassVar[None] = None
    theory: ClassVar[None] = None

    @classmethod
    def of(cls, values: Sequence[float]) -> Band:
        """Of the values of at least two runs."""
        return cls(statistics.fmean(values), statistics.stdev(values), len(values))

    def scaled(self, unit: float, shift: float = 0.0, name: str = "") -> Band:
        """The band in another unit, and a known constant added."""
        return Band(self.mean * unit + shift, self.std * unit, self.runs)

    def to_dict(self) -> dict[str, Any]:
        """No value and no error, and the band, JSON-ready."""
        return {"value": None, "error": None, "band": {"mean": self.mean, "std": self.std, "runs": self.runs}}

    def __str__(self) -> str:
        band = _with_bar(self.mean, self.std) if math.isfinite(self.mean) and math.isfinite(self.std) else "-"
        return f"{band} (band of {self.runs} runs)"


def _digits(error: float) -> int:
    """How many digits of an error are written: two where the first is 1, since 0.01 for 0.0149 is a third less."""
    return 2 if f"{error:.1e}".startswith("1") else 1


def _with_bar(value: float, error: float) -> str:
    """``value`` ± ``error``, both to the last digit that is written of the error; a value within its bar to two digits
    of its own, unless it is less than a twentieth of the bar."""
    if error <= 0.0:
        return f"{value:.6g} ± {error:.1g}"
    error = float(f"{error:.{_digits(error)}g}")
    significant = _digits(error)  # 0.096 has become 0.1
    power = math.floor(math.log10(max(abs(value), error)))
    if not SMALL <= 10.0**power < LARGE:
        return f"({_with_bar(value / 10.0**power, error / 10.0**power)})e{power:+03d}"
    digits = significant - 1 - math.floor(math.log10(error))
    places = min(max(0, digits), 12)
    size = f"{error:.{places}f}" if digits <= places else f"{error:.{significant}g}"
    if 0.05 * error <= abs(value) < error:
        value = float(f"{value:.1e}")
        digits = max(digits, 1 - math.floor(math.log10(abs(value))))
        places = min(max(0, digits), 12)
    return f"{round(value, digits) + 0.0:.{places}f} ± {size}"  # not −0
