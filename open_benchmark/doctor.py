"""What is likely wrong with a result, and what to change."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from open_benchmark.result import Result

if TYPE_CHECKING:
    from open_benchmark.score import Score

__all__ = ["Finding", "diagnose"]


@dataclass(frozen=True)
class Finding:
    """One fault: its name, the number that shows it, and what to change."""

    name: str
    evidence: str = ""
    advice: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        return {"name": self.name, "evidence": self.evidence, "advice": self.advice}


def diagnose(result: Result, found: Score) -> list[Finding]:
    """Findings, the likeliest first."""
    return []
