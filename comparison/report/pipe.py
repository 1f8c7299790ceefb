"""The drill pipe of ``cases/drill_pipe.toml`` in SI units: what ``bentbeam predict`` says of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bent_beam.cases import load_case
from bent_beam.errors import InputError
from comparison.verdict import verdict

__all__ = ["Pipe", "pipe_verdict"]

CASE = Path(__file__).resolve().parents[2] / "cases" / "drill_pipe.toml"
TIMES = (0.001, 0.005, 0.010)  # s


@dataclass(frozen=True)
class Pipe:
    """A case, its groups, and the theory's numbers over time."""

    title: str
    velocity: float
    curvature: float
    length: float
    document: Mapping[str, Any]

    @property
    def rows(self) -> Sequence[Mapping[str, Any]]:
        return list(self.document["times"])


def pipe_verdict(file: Path = CASE) -> Pipe | None:
    """The verdict on a case, or ``None`` where this installation has no such file."""
    try:
        case = load_case(file)
    except InputError:
        return None
    impact = case.impact
    return Pipe(case.title, impact.velocity, impact.curvature, impact.length, verdict(case, TIMES))
