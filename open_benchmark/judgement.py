"""What the judge says of a result: its score, the limits it is held to, and a fault that was found."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any

from comparison.compared import Compared
from comparison.plain import plain
from open_benchmark.result import plain_number

__all__ = ["LIMITS", "MEASURES", "TOLERANCE", "Finding", "Score", "invalid"]

#: What the judge calls a result beyond (benchmark.md; each about ten times what the best strictly unilateral code shows
#: on its finest mesh at κ/ν = 0.5): tensile impulse over J, penetration over V₀τ, gap in the zone over V₀τ, noise.
LIMITS = {"adhesive": 0.01, "leaky": 0.01, "lifted": 0.01, "unsettled": 0.005}
MEASURES = {"adhesive": "adhesion", "leaky": "penetration", "lifted": "lift", "unsettled": "noise"}
#: A restitution that is further from its reference than both error bars and this is called "off": what the best codes
#: differ by on meshes of a hundred elements, three times.
TOLERANCE = 0.005


@dataclass(frozen=True)
class Finding:
    """One fault: its name, the number that shows it, and what to change."""

    name: str
    evidence: str = ""
    advice: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        return {"name": self.name, "evidence": self.evidence, "advice": self.advice}


@dataclass(frozen=True)
class Score:
    """What the judge says of one result; a number is ``None`` where it is not reported or means nothing.

    outcome : the adapter's, with the judge's additions after a comma ("completed, lifted"). reason : one line for
    anything but "completed". measured : name → value, error bar and exact value. lift, penetration (over V₀τ),
    adhesion (tensile over largest whole impulse), noise (residual of the fit over the impulse), energy (shares of
    J V₀).
    reference : name → error bar and source of a value in ``measured`` that is held against a simulation.
    """

    problem: str
    outcome: str
    reason: str | None = None
    measured: dict[str, Compared] = field(default_factory=dict)
    lift: float | None = None
    penetration: float | None = None
    adhesion: float | None = None
    noise: float | None = None
    energy: dict[str, float | None] | None = None
    reference: dict[str, dict[str, Any]] = field(default_factory=dict)
    diagnosis: tuple[Finding, ...] = ()
    metadata: dict[str, Any] = field(default_factory=dict)

    def error(self, name: str) -> float | None:
        """Relative error of one measured number against its exact value; ``None`` where either is missing."""
        found = self.measured.get(name)
        return found.relative() if found is not None and found.theory else None

    @property
    def seconds(self) -> float | None:
        """Of the time loop, as the adapter reports them; ``None`` when it does not."""
        said = plain_number(self.metadata.get("seconds"))
        return said if said is not None and said > 0.0 else None

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON: finite numbers or ``None``."""
        document: dict[str, Any] = {"problem": self.problem, "outcome": self.outcome, "reason": self.reason}
        for name in dict.fromkeys(("lambda0", "r0", "lambda1", "r1", *self.measured)):
            document[name] = asdict(self.measured[name]) if name in self.measured else None
        for name in ("lift", "penetration", "adhesion", "noise"):
            document[name] = getattr(self, name)
        document["energy"] = self.energy
        document["reference"] = self.reference or None
        document["diagnosis"] = [finding.name for finding in self.diagnosis]
        document["advice"] = [finding.to_dict() for finding in self.diagnosis if finding.name != "clean"]
        document["metadata"] = self.metadata
        return dict(plain(document))


def invalid(reason: str, name: str = "") -> Score:
    """The score of a result that cannot be read."""
    return Score(problem=name, outcome="invalid", reason=reason)
