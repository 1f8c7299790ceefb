"""The judge's score of a result, its limits, and the fault that was found."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

from bent_beam.measure.numbers import Number
from comparison.readable import plain

__all__ = ["LIMITS", "PART", "Finding", "Score"]

#: The judge's one limit: a hundredth of the quantity. An error below it is no verdict, whatever the error bar says.
PART = 0.01
#: Measure → its limit, and the outcome's addition beyond it: a hundredth of the wall's impulse, of the way V₀τ, and for
#: noise, a root mean square, half of that, for its peaks are about twice as high.
LIMITS = {
    "adhesion": (PART, "adhesive"),
    "penetration": (PART, "leaky"),
    "lift": (PART, "lifted"),
    "noise": (PART / 2.0, "unsettled"),
}
BARS = 3.0  # error bars beyond which a value is off


@dataclass(frozen=True)
class Finding:
    """One fault: its name, the number that shows it, and what to change."""

    name: str
    evidence: str = ""
    advice: str = ""


@dataclass(frozen=True)
class Score:
    """The judge's score of one result; a number is ``None`` where it is not reported or means nothing.

    outcome : the adapter's, with the judge's additions after a comma ("completed, lifted"). reason : one line for
    anything but "completed". measured : name → value, error bar and exact value. lift, penetration (over V₀τ),
    adhesion (tensile over largest whole impulse), noise (residual of the fit over the impulse), energy (shares of
    J V₀), momentum_residual (momentum that the beam lost, without the loads', over J, less 1), ratios (J and Jm over
    the exact ones), raw (whether J and Jm were added up from nodal histories).
    reference : name → error bar and source of a value in ``measured`` that is held against a simulation.
    """

    problem: str
    outcome: str
    reason: str | None = None
    measured: dict[str, Number] = field(default_factory=dict)
    lift: float | None = None
    penetration: float | None = None
    adhesion: float | None = None
    noise: float | None = None
    energy: dict[str, float | None] | None = None
    momentum_residual: float | None = None
    ratios: dict[str, float] = field(default_factory=dict)
    raw: bool = False
    reference: dict[str, dict[str, Any]] = field(default_factory=dict)
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

    def error(self, name: str) -> float | None:
        """Relative error of one measured number against its exact value; ``None`` where either is missing."""
        found = self.measured.get(name)
        return found.relative() if found is not None and found.theory else None

    @property
    def off(self) -> list[str]:
        """Names of the numbers whose error exceeds three bars and a hundredth: a bar of 0 is no bar."""
        return [name for name in self.measured if self._excess(name) > 1.0]

    @property
    def excess(self) -> float:
        """The largest error over its limit."""
        return max(map(self._excess, self.measured), default=0.0)

    def _excess(self, name: str) -> float:
        found = self.measured[name]
        bar = (found.bar or 0.0) + self.reference.get(name, {}).get("error", 0.0)
        return abs(found.difference or 0.0) / max(BARS * bar, PART * (abs(found.theory or 0.0) or 1.0))

    @property
    def gained(self) -> float | None:
        """Largest gain of energy over J V₀."""
        return (self.energy or {}).get("gained")

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON: finite numbers or ``None``."""
        numbers = dict.fromkeys(("lambda0", "r0", "lambda1", "r1")) | {k: asdict(v) for k, v in self.measured.items()}
        measures = ("lift", "penetration", "adhesion", "noise", "energy", "momentum_residual", "raw")
        document = {"problem": self.problem, "outcome": self.outcome, "reason": self.reason, **numbers}
        document |= {name: getattr(self, name) for name in measures} | {"reference": self.reference or None}
        document["diagnosis"] = [finding.name for finding in self.diagnosis]
        document["advice"] = [asdict(finding) for finding in self.diagnosis if finding.name != "clean"]
        return dict(plain(document | {"metadata": self.metadata}))
