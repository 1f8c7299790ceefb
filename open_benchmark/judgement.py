"""The judge's score of a result, its limits, and the fault that was found."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

from comparison.plain import plain
from measure.measured import Measured
from open_benchmark.result import plain_number

__all__ = ["LIMITS", "TOLERANCE", "Finding", "Score", "invalid"]

#: Measure → its limit, and the outcome's addition beyond it (benchmark.md). Each limit is about ten times what the best
#: strictly unilateral code shows on its finest mesh at κ/ν = 0.5.
LIMITS = {
    "adhesion": (0.01, "adhesive"),
    "penetration": (0.01, "leaky"),
    "lift": (0.01, "lifted"),
    "noise": (0.005, "unsettled"),
}
#: A restitution is "off" when it is further from its reference than both error bars and this: three times the
#: differences between the best codes on meshes of a hundred elements.
TOLERANCE = 0.005


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
    J V₀).
    reference : name → error bar and source of a value in ``measured`` that is held against a simulation.
    """

    problem: str
    outcome: str
    reason: str | None = None
    measured: dict[str, Measured] = field(default_factory=dict)
    lift: float | None = None
    penetration: float | None = None
    adhesion: float | None = None
    noise: float | None = None
    energy: dict[str, float | None] | None = None
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
    def gained(self) -> float | None:
        """Largest gain of energy over J V₀."""
        return (self.energy or {}).get("gained")

    @property
    def seconds(self) -> float | None:
        """Of the time loop, as the adapter reports them; ``None`` when it does not."""
        seconds = plain_number(self.metadata.get("seconds"))
        return seconds if seconds is not None and seconds > 0.0 else None

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON: finite numbers or ``None``."""
        document: dict[str, Any] = {"problem": self.problem, "outcome": self.outcome, "reason": self.reason}
        for name in dict.fromkeys(("lambda0", "r0", "lambda1", "r1", *self.measured)):
            document[name] = asdict(self.measured[name]) if name in self.measured else None
        for name in ("lift", "penetration", "adhesion", "noise", "energy"):
            document[name] = getattr(self, name)
        document["reference"] = self.reference or None
        document["diagnosis"] = [finding.name for finding in self.diagnosis]
        document["advice"] = [asdict(finding) for finding in self.diagnosis if finding.name != "clean"]
        document["metadata"] = self.metadata
        return dict(plain(document))


def invalid(reason: str, name: str = "", outcome: str = "invalid") -> Score:
    """The score of a result that cannot be read, or of a run that left none."""
    return Score(problem=name, outcome=outcome, reason=reason)
