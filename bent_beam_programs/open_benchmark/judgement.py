"""The judge's score of a result: numbers with bars, what is seen, and what that amounts to.

A number is *clean* where error and bar are both within its limit; else it is *within its bar*, or *off*.
"""

from dataclasses import asdict, dataclass, field
from typing import Any

from bent_beam.as_json import plain
from bent_beam.measure.numbers import Number

__all__ = ["FIRST_ORDER", "LOADED", "PART", "WORDS", "Finding", "Score", "Symptom"]

PART = 0.01  # the judge's limit: a hundredth, of the exact value, of the wall's impulse, of the way V₀τ
FIRST_ORDER = 0.05  # of max(1, |exact|): the limit of λ₁ and r₁, which are differences of two runs
WORDS = {"pull": "adhesive", "penetration": "leaky", "lift": "lifted", "noise_in_time": "unsettled"}
LOADED = ("lambda1", "r1")


@dataclass(frozen=True)
class Symptom:
    """What is seen: its name, figure, limit and where, in words that name no cause."""

    name: str
    figure: float | None
    limit: float
    where: str = ""
    words: str = ""

    @property
    def seen(self) -> bool:
        """Whether the figure is beyond the limit; a number that is not known is."""
        return self.figure is None or abs(self.figure) > self.limit

    def __str__(self) -> str:
        figure = "no number" if self.figure is None else f"{self.figure:.3g}"
        return f"{self.words}: {figure} (limit {self.limit:.2g})" + (f", {self.where}" if self.where else "")


@dataclass(frozen=True)
class Finding:
    """The verdict, or a cause that the first symptom has alone: its name, the symptom, and what to change."""

    name: str
    evidence: str = ""
    advice: str = ""


@dataclass(frozen=True)
class Score:
    """The judge's score of one result; a number is ``None`` where it is not reported or means nothing.

    outcome : the adapter's, with the judge's additions after a comma ("completed, lifted"). reason : one line for
    anything but "completed". measured : name → value, error bar and exact value. readings : what was looked at, by name
    (:mod:`.symptoms`); not_told : what could not be, and for want of what. raw : whether nodal histories and gaps are
    reported.
    reference : name → error bar and source of a value in ``measured`` that is held against a computed one.
    """

    problem: str
    outcome: str
    reason: str | None = None
    measured: dict[str, Number] = field(default_factory=dict)
    readings: dict[str, Symptom] = field(default_factory=dict)
    not_told: dict[str, str] = field(default_factory=dict)
    raw: bool = False
    reference: dict[str, dict[str, Any]] = field(default_factory=dict)
    symptoms: tuple[Symptom, ...] = ()
    diagnosis: tuple[Finding, ...] = ()
    metadata: dict[str, Any] = field(default_factory=dict)

    @property
    def completed(self) -> bool:
        """Whether there is a result to judge."""
        return self.outcome.startswith("completed")

    @property
    def brief(self) -> str:
        """The outcome in one or two words."""
        return self.outcome.split("(")[0].replace("_", " ")

    def figure(self, name: str) -> float | None:
        """The figure of one reading."""
        return self.readings[name].figure if name in self.readings else None

    def error(self, name: str) -> float | None:
        """Relative error of one measured number against its exact value; ``None`` where either is missing."""
        found = self.measured.get(name)
        return found.relative() if found is not None and found.theory else None

    def bar(self, name: str) -> float | None:
        """Its error bar in the same unit, that of the reference included; ``None`` where there is none."""
        found = self.measured[name]
        own, other = found.bar, self.reference.get(name, {}).get("error")
        if found.theory is None or own is None is other:
            return None
        return ((own or 0.0) + (other or 0.0)) / (abs(found.theory) or 1.0)

    def in_limits(self, name: str) -> tuple[float | None, float]:
        """Error and bar of one number over its limit; an unknown number has no error and an infinite bar."""
        found = self.measured[name]
        size = abs(found.theory or 0.0)
        limit = FIRST_ORDER * max(1.0, size) if name in LOADED else PART * (size or 1.0)
        if found.difference is None:
            return None, float("inf") if found.value is None else 0.0
        return abs(found.difference) / limit, (self.bar(name) or 0.0) * (size or 1.0) / limit

    @property
    def off(self) -> list[str]:
        """Names of the numbers whose error exceeds its bar and its limit."""
        pairs = {name: self.in_limits(name) for name in self.measured}
        return [name for name, (error, bar) in pairs.items() if error is not None and error > max(bar, 1.0)]

    @property
    def unsure(self) -> list[str]:
        """Names of those that are not off, but whose error or bar exceeds the limit."""
        pairs = {name: self.in_limits(name) for name in self.measured if name not in self.off}
        return [name for name, (error, bar) in pairs.items() if max(error or 0.0, bar) > 1.0 + 1e-9]

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON: finite numbers or ``None``."""
        numbers: dict[str, Any] = dict.fromkeys(("lambda0", "r0", "lambda1", "r1"))
        numbers |= {name: found.compared() for name, found in self.measured.items()}
        document = {"problem": self.problem, "outcome": self.outcome, "reason": self.reason, **numbers, "raw": self.raw}
        document |= {"reference": self.reference or None, "symptoms": [asdict(one) for one in self.symptoms]}
        document |= {"readings": {name: one.figure for name, one in self.readings.items()}, "not_told": self.not_told}
        document["diagnosis"] = [finding.name for finding in self.diagnosis]
        document["advice"] = [asdict(finding) for finding in self.diagnosis if finding.name != "clean"]
        return dict(plain(document | {"metadata": self.metadata}))
