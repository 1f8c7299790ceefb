"""One row of a benchmark, and the file that keeps rows."""

import json
import platform
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bent_beam.files import write_atomically
from bent_beam.versions import processor, today, versions

RESULTS = Path(__file__).parent / "results"


@dataclass(frozen=True)
class Row:
    """One figure and its goal (``None``: it has none). at_least : the goal is the least, not the most; about :
    whatever else is kept."""

    label: str
    figure: float
    goal: float | None
    at_least: bool = False
    about: dict[str, Any] = field(default_factory=dict)

    @property
    def met(self) -> bool:
        if self.goal is None:
            return True
        return self.figure >= self.goal if self.at_least else self.figure <= self.goal

    def __str__(self) -> str:
        if self.goal is None:
            return f"{self.label:50}{self.figure:9.3f}  no goal"
        sign = "≥" if self.at_least else "≤"
        return f"{self.label:50}{self.figure:9.3f}  {sign} {self.goal:<6g} {'met' if self.met else 'NOT MET'}"

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        row = {"row": self.label, "figure": round(self.figure, 4), "goal": self.goal, "at_least": self.at_least}
        return {**row, "met": self.met, **self.about}


def keep(file: Path, rows: list[dict[str, Any]]) -> None:
    """Write rows with date, processor and versions."""
    record = {"date": today(), "processor": processor(), "python": platform.python_version()}
    record |= {"versions": versions(), "rows": rows}
    write_atomically(file, json.dumps(record, indent=1, ensure_ascii=False) + "\n")
