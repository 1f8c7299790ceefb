"""What a benchmark keeps: its rows, with date, processor and versions."""

from __future__ import annotations

import argparse
import importlib.metadata
import json
import platform
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bent_beam.files import write_atomically
from bent_beam.versions import processor, today

__all__ = ["RESULTS", "Row", "keep", "keep_rows", "options", "said"]

VERSIONS = ("numpy", "scipy", "numba", "typer", "exudyn", "xarray")

RESULTS = Path(__file__).parent / "results"


@dataclass(frozen=True)
class Row:
    """One figure and its goal (``None``: it has none, and is there to be known). at_least : the goal is the least, not
    the most; about : whatever else is kept."""

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


def options(name: str, about: str | None, rounds: int | None = None) -> argparse.ArgumentParser:
    """The command line of a benchmark: ``--rounds``, if it has any, and ``--out`` for what it keeps."""
    parser = argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
    if rounds is not None:
        parser.add_argument("--rounds", type=int, default=rounds)
    parser.add_argument("--out", type=Path, default=RESULTS / f"{name}.json")
    return parser


def said(row: Row) -> Row:
    """The row, printed as soon as it is known."""
    print(row, flush=True)
    return row


def keep(file: Path, rows: list[Row]) -> list[Row]:
    """Write ``rows`` as JSON; returns them."""
    keep_rows(
        file,
        [
            {
                "row": row.label,
                "figure": round(row.figure, 4),
                "goal": row.goal,
                "at_least": row.at_least,
                "met": row.met,
                **row.about,
            }
            for row in rows
        ],
    )
    return rows


def keep_rows(file: Path, rows: list[dict[str, Any]]) -> None:
    """Write JSON rows of any kind."""
    record = {
        "date": today(),
        "processor": processor(),
        "python": platform.python_version(),
        "versions": {name: importlib.metadata.version(name) for name in VERSIONS},
        "rows": rows,
    }
    write_atomically(file, json.dumps(record, indent=1, ensure_ascii=False) + "\n")
