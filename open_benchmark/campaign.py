"""All codes on all problems at three resolutions: run, kept, scored, resumed.

The folder of a campaign holds ``results/CODE/PROBLEM-RESOLUTION.npz`` (what the adapter wrote), a row of JSON beside it
(how the run ended, and what it was made from), and the page. A row whose adapter, problem and limits are unchanged is
not run again; scores are always taken anew from the results.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from comparison.store import write_atomically
from open_benchmark.adapter import RESOLUTIONS, Adapter
from open_benchmark.judgement import Score, invalid
from open_benchmark.problem import Problem, problem, problem_text
from open_benchmark.result import Result, ResultError, load_result
from open_benchmark.running import Limits, Run, run_adapter
from open_benchmark.score import score

__all__ = ["STANDARD", "Row", "campaign", "with_bases"]

#: What ``bentbeam benchmark`` asks unless told otherwise: 0.5 ranks codes, 0.1 is the stress test of the first
#: instants, then one point, and the three regimes of loads (pressed on, lifted off, under tension).
STANDARD = (
    "leading-0.5",
    "leading-0.1",
    "point-2",
    "first-0.5-1-1-1",
    "first-0.5--1--1-0",
    "first-0.5--0.5-0-0-1",
)


@dataclass(frozen=True)
class Row:
    """One code on one problem at one resolution."""

    solver: str
    problem: str
    resolution: str
    seconds: float
    score: Score

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        names = {"solver": self.solver, "resolution": self.resolution, "wall_seconds": self.seconds}
        return {**names, **self.score.to_dict()}


def campaign(
    adapters: Sequence[Adapter],
    problems: Sequence[str],
    out: Path,
    *,
    limits: Limits | None = None,
    resolutions: Sequence[str] = RESOLUTIONS,
    progress: Callable[[int, int], None] | None = None,
) -> list[Row]:
    """Run what has not been run, and score all. A first-order problem brings its base along."""
    limits = limits or Limits()
    asked = [problem(name) for name in with_bases(problems)]
    pairs = [(adapter, item) for adapter in adapters for item in asked if adapter.takes(item)]
    runs = [(adapter, item, resolution) for adapter, item in pairs for resolution in resolutions]
    for done, (adapter, item, resolution) in enumerate(runs):
        if progress:
            progress(done, len(runs))
        _run_once(adapter, item, resolution, out, limits)
    return [_row(adapter.name, item, resolution, out) for adapter, item, resolution in runs]


def with_bases(problems: Sequence[str]) -> list[str]:
    """The problems, each once, every base before what needs it."""
    found: dict[str, None] = {}
    for name in problems:
        base = problem(name).base_id
        if base:
            found[base] = None
        found[name] = None
    return sorted(found, key=lambda name: problem(name).base_id is not None)


def _place(out: Path, solver: str, name: str, resolution: str) -> Path:
    return out / "results" / solver / f"{name}-{resolution}.npz"


def _key(adapter: Adapter, asked: Problem, resolution: str, limits: Limits) -> str:
    text = json.dumps([adapter.digest(), problem_text(asked), resolution, asdict(limits)])
    return hashlib.sha256(text.encode()).hexdigest()


def _run_once(adapter: Adapter, asked: Problem, resolution: str, out: Path, limits: Limits) -> None:
    kept = _place(out, adapter.name, asked.id, resolution)
    about = kept.with_suffix(".row.json")
    key = _key(adapter, asked, resolution, limits)
    try:
        old = json.loads(about.read_text(encoding="utf-8"))
        if old["key"] == key and old["outcome"] != "not_installed":
            return
    except (OSError, ValueError, KeyError, TypeError):
        pass
    run = run_adapter(adapter, asked, resolution, kept, limits)
    write_atomically(about, json.dumps({"key": key, **asdict(run)}))


def _stored(out: Path, solver: str, name: str, resolution: str) -> tuple[Run, Result | None]:
    """How a run ended and what it left; a file that somebody broke since is an invalid result."""
    kept = _place(out, solver, name, resolution)
    try:
        said = json.loads(kept.with_suffix(".row.json").read_text(encoding="utf-8"))
        run = Run(str(said["outcome"]), str(said["reason"]), float(said["seconds"]))
    except (OSError, ValueError, KeyError, TypeError):
        return Run("invalid", "its row cannot be read", 0.0), None
    if run.outcome:
        return run, None
    try:
        return run, load_result(kept if kept.exists() else kept.with_suffix(".json"))
    except ResultError as error:
        return Run("invalid", str(error), run.seconds), None


def _row(solver: str, asked: Problem, resolution: str, out: Path) -> Row:
    run, result = _stored(out, solver, asked.id, resolution)
    if result is None:
        found = replace(invalid(run.reason, asked.id), outcome=run.outcome)
        return Row(solver, asked.id, resolution, run.seconds, found)
    base = _stored(out, solver, asked.base_id, resolution)[1] if asked.base_id else None
    try:
        found = score(result, base if base is not None and base.outcome == "completed" else None)
    except ResultError as error:
        found = invalid(str(error), asked.id)
    return Row(solver, asked.id, resolution, run.seconds, found)
