"""All codes on all problems at three resolutions: run, kept, scored, resumed.

The folder of a campaign holds ``results/CODE/PROBLEM-RESOLUTION.npz`` (written by the adapter), a row of JSON beside it
(the end of the run, and the digest of its input), and the page. A row whose adapter, problem and limits are unchanged
is not run again; scores are always taken anew from the results.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from bent_beam.files import write_atomically
from open_benchmark.adapter import RESOLUTIONS, Adapter
from open_benchmark.judgement import Score, invalid
from open_benchmark.problem import problem, problem_text
from open_benchmark.reading import load_result
from open_benchmark.result import Result, ResultError
from open_benchmark.running import Limits, Run, run_adapter
from open_benchmark.score import score

__all__ = ["STANDARD", "Row", "campaign", "with_bases"]

#: Default problems of ``bentbeam benchmark``: 0.5 ranks codes, 0.1 is the stress test of the first
#: instants, then one point, and the three regimes of loads (pressed on, lifted off, under tension).
STANDARD = (
    "leading-0.5",
    "leading-0.1",
    "point-2",
    "first-0.5-1-1-1",
    "first-0.5--1--1-0",
    "first-0.5--0.5-0-0-1",
)


AGAIN = ("not_installed", "invalid", "crashed")  # what may be the machine's fault, as a full disk, is asked anew


@dataclass(frozen=True)
class Row:
    """One code on one problem at one resolution. ``unlimited``: limits that this system cannot set."""

    solver: str
    problem: str
    resolution: str
    seconds: float
    score: Score
    unlimited: str = ""

    def to_dict(self) -> dict[str, Any]:
        """Ready for JSON."""
        names = {"solver": self.solver, "resolution": self.resolution, "wall_seconds": self.seconds}
        return {**names, **self.score.to_dict(), "unlimited": self.unlimited or None}


def campaign(
    adapters: Sequence[Adapter],
    problems: Sequence[str],
    out: Path,
    *,
    limits: Limits | None = None,
    resolutions: Sequence[str] = RESOLUTIONS,
    progress: Callable[[int, int], None] | None = None,
) -> list[Row]:
    """Do the runs that are missing, and score all. A first-order problem brings its base along."""
    limits = limits or Limits()
    asked = [problem(name) for name in with_bases(problems)]
    pairs = [(adapter, item) for adapter in adapters for item in asked if adapter.takes(item)]
    runs = [(adapter, item, resolution) for adapter, item in pairs for resolution in resolutions]
    for done, (adapter, item, resolution) in enumerate(runs):
        if progress:
            progress(done, len(runs))
        kept = _kept(out, adapter.name, item.id, resolution)
        decisive = json.dumps([adapter.digest(), problem_text(item), resolution, asdict(limits)])
        key = hashlib.sha256(decisive.encode()).hexdigest()
        old = _stored_row(kept)
        if old.get("key") != key or old.get("outcome") in AGAIN:
            run = run_adapter(adapter, item, resolution, kept, limits)
            write_atomically(kept.with_suffix(".row.json"), json.dumps({"key": key, **asdict(run)}))
    return [_row(adapter.name, item.id, resolution, out) for adapter, item, resolution in runs]


def with_bases(problems: Sequence[str]) -> list[str]:
    """The problems, each once, every base before the problem that needs it."""
    bases = [base for name in problems if (base := problem(name).base_id)]
    found = dict.fromkeys([*problems, *bases])
    return sorted(found, key=lambda name: problem(name).base_id is not None)


def _kept(out: Path, solver: str, name: str, resolution: str) -> Path:
    return out / "results" / solver / f"{name}-{resolution}.npz"


def _stored_row(kept: Path) -> dict[str, Any]:
    try:
        found = json.loads(kept.with_suffix(".row.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def _stored(kept: Path) -> tuple[Run, Result | None]:
    """The end of a run and its result; a file that somebody broke since is an invalid result."""
    row = _stored_row(kept)
    try:
        run = Run(str(row["outcome"]), str(row["reason"]), float(row["seconds"]), str(row.get("unlimited", "")))
    except (ValueError, KeyError, TypeError):
        return Run("invalid", "its row cannot be read", 0.0), None
    if run.outcome:
        return run, None
    try:
        return run, load_result(kept if kept.exists() else kept.with_suffix(".json"))
    except ResultError as error:
        return Run("invalid", str(error), run.seconds, run.unlimited), None


def _row(solver: str, name: str, resolution: str, out: Path) -> Row:
    run, result = _stored(_kept(out, solver, name, resolution))
    if result is None:
        found = invalid(run.reason, name, run.outcome)
    else:
        base_id = problem(name).base_id
        base = _stored(_kept(out, solver, base_id, resolution))[1] if base_id else None
        try:
            found = score(result, base if base is not None and base.outcome == "completed" else None)
        except ResultError as error:
            found = invalid(str(error), name)
    return Row(solver, name, resolution, run.seconds, found, run.unlimited)
