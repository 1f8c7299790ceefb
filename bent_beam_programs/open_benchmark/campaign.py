"""All codes on all problems at three resolutions: drawn, run, kept, scored, resumed.

docs/guide/submit.md says which rows were *run here*; every other one is self-declared.

Nobody can have the answers of drawn problems ready. κ/ν, ζ and the stiffness of a stop are within 15 % of the named
problem's, each load within 30 %, tension with the free motion that belongs to it. Problems with one κ/ν get one κ/ν, so
that they share their base.

The folder of a campaign holds ``results/CODE/PROBLEM-RESOLUTION.npz`` (written by the adapter), a row of JSON beside it
(the end of the run, and the digest of its input), and the page. A row whose adapter, problem and limits are unchanged
is not run again; scores are always taken anew from the results.
"""

import hashlib
import json
import math
import random
import secrets
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field, replace
from itertools import product
from pathlib import Path
from typing import Any

from bent_beam.errors import InputError
from bent_beam.files import write_atomically
from bent_beam_programs.open_benchmark.adapter import Adapter
from bent_beam_programs.open_benchmark.judgement import Score
from bent_beam_programs.open_benchmark.problem import IDS, Problem, problem, problem_text
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.result import Result, ResultError
from bent_beam_programs.open_benchmark.running import Limits, Run, run_adapter
from bent_beam_programs.open_benchmark.score import resolution_ignored, score

#: Default problems of ``bentbeam benchmark``: 0.5 ranks codes, 0.1 is the stress test of the first
#: instants, then one point, and the three regimes of loads (pressed on, lifted off, under tension).
STANDARD = ("leading-0.5", "leading-0.1", "point-2", "first-0.5-1-1-1", "first-0.5--1--1-0", "first-0.5--0.5-0-0-1")
AGAIN = ("not_installed", "invalid", "crashed")  # what may be the machine's fault, as a full disk, is asked anew


@dataclass(frozen=True)
class Row:
    """One code on one problem at one resolution. seconds : wall clock of the process, the least of ``repeats`` runs
    (``None``: not run here). drawn : whether the problem was drawn at run time. made_by : digest of the source,
    arguments and versions. unlimited : limits that this system cannot set."""

    solver: str
    problem: str
    resolution: str
    seconds: float | None
    score: Score
    unlimited: str = ""
    repeats: int = 0
    drawn: bool = False
    made_by: dict[str, Any] = field(default_factory=dict)

    @property
    def declared_because(self) -> str:
        """Why the row is not one that was run here ("": it is)."""
        seen = {symptom.name for symptom in self.score.symptoms}
        checks = {
            "not run here": self.seconds is None,
            self.score.brief: not self.score.completed,
            "numbers that no solver gives": bool(seen & {"too_smooth", "copies"}),
            "no nodal histories or no gaps": self.unverifiable,
            "a problem whose answer is published": not self.drawn,
        }
        return next((why for why, holds in checks.items() if holds), "")

    @property
    def unverifiable(self) -> bool:
        """Whether an infinite beam's histories or gaps are missing: sums alone can be right by a table of answers."""
        return problem(self.problem).is_front and not self.score.raw

    @property
    def table(self) -> str:
        """The one that it stands in."""
        return "self-declared" if self.declared_because else "run here"

    @property
    def solver_seconds(self) -> float | None:
        """Of the time loop, as the adapter measured them."""
        given = self.score.metadata.get("seconds")
        return float(given) if isinstance(given, int | float) and not isinstance(given, bool) and given >= 0.0 else None

    def to_dict(self) -> dict[str, Any]:
        return {
            "solver": self.solver,
            "resolution": self.resolution,
            "process_seconds": self.seconds,
            "solver_seconds": self.solver_seconds,
            "table": self.table,
            "declared_because": self.declared_because or None,
            **self.score.to_dict(),
            "repeats": self.repeats,
            "made_by": self.made_by,
            "unlimited": self.unlimited or None,
        }


def campaign(
    adapters: Sequence[Adapter],
    problems: Sequence[str],
    out: Path,
    *,
    limits: Limits | None = None,
    seed: int | None = None,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> list[Row]:
    """Do the runs that are missing, and score all. A first-order problem brings its base along.

    seed : of the drawn problems that are run besides, one like each of ``problems``; ``None``: none.
    """
    limits = limits or Limits()
    drawn_ids = _with_bases(drawn(problems, seed)) if seed is not None else []
    asked = [problem(name) for name in [*_with_bases(problems), *drawn_ids]]
    pairs = [(one, item) for one, item in product(adapters, asked) if not one.kinds or item.kind in one.kinds]
    runs = [(one, item, resolution) for one, item in pairs for resolution in one.resolutions]
    digests = {adapter.name: adapter.digest() for adapter in adapters}
    for done, (adapter, item, resolution) in enumerate(runs):
        progress(done, len(runs))
        kept = _kept(out, adapter.name, item.id, resolution)
        decisive = json.dumps([digests[adapter.name], problem_text(item), resolution, asdict(limits)])
        key, old = hashlib.sha256(decisive.encode()).hexdigest(), _stored_row(kept)
        if old.get("key") != key or old.get("outcome") in AGAIN:
            run = run_adapter(adapter, item, resolution, kept, limits)
            write_atomically(kept.with_suffix(".row.json"), json.dumps({"key": key, **asdict(run)}))
    rows: list[Row] = []
    for adapter in adapters:
        own = [_row(one, item, place, out, item.id in drawn_ids) for one, item, place in runs if one is adapter]
        scores = resolution_ignored([row.score for row in own])
        rows += [_without_praise(replace(row, score=found)) for row, found in zip(own, scores)]
    return rows


def _without_praise(row: Row) -> Row:
    """A row is clean only where it can be looked into."""
    if not row.unverifiable:
        return row
    kept = tuple(finding for finding in row.score.diagnosis if finding.name != "clean")
    return replace(row, score=replace(row.score, diagnosis=kept))


def drawn(names: Sequence[str], seed: int) -> list[str]:
    """Ids of drawn problems like those named; none for the ladder and the whole impacts, which are what they are."""
    kept = [problem(name) for name in names]
    return list(dict.fromkeys(_near(one, seed) for one in kept if one.is_front or one.kind.startswith("elastic")))


def _near(asked: Problem, seed: int) -> str:
    draw = random.Random(f"{seed} {asked.id}")
    if not asked.is_front:
        found = IDS[asked.kind].fullmatch(asked.id)
        assert found is not None  # a problem has an id of its kind
        while True:  # until all numbers lie in the range of the kind, as those asked for do
            numbers = [float(f"{float(word) * draw.uniform(0.85, 1.15):.4g}") for word in found.groups()]
            try:
                return problem("-".join([asked.kind, *(f"{value:.12g}" for value in numbers)])).id
            except InputError:
                continue
    kappa = asked.kappa_over_nu * random.Random(f"{seed} {asked.kappa_over_nu:g}").uniform(0.85, 1.15)
    kappa = float(f"{min(kappa, 0.95) if asked.kappa_over_nu < 1.0 else max(kappa, 1.05):.4g}")
    if asked.kind != "first":
        return f"{asked.kind}-{kappa:g}"
    alpha, psi, chi, axial = (float(f"{load * draw.uniform(0.7, 1.3):.3g}") for load in asked.loads)
    if math.isclose(asked.loads[0], -asked.kappa_over_nu * asked.loads[3]) and axial:
        alpha = float(f"{-kappa * axial:.6g}")  # tension lets go of the bow
    loads = [alpha, psi, chi, axial] if axial else [alpha, psi, chi]
    return "-".join(["first", f"{kappa:g}", *(f"{load:g}" for load in loads)])


def drawn_once(out: Path, seed: int | None) -> int:
    """The seed of a campaign's drawn problems: as asked, as it was when the folder was made, or a new one."""
    file = out / "draw.json"
    try:
        kept = json.loads(file.read_text(encoding="utf-8"))["seed"] if file.is_file() else None
    except (OSError, ValueError, KeyError, TypeError):
        raise InputError(f"out: {file} cannot be read: delete it, and problems are drawn anew") from None
    chosen = seed if seed is not None else kept if isinstance(kept, int) else secrets.randbelow(2**31)
    write_atomically(file, json.dumps({"seed": chosen}))
    return chosen


def declared_rows(files: Sequence[Path]) -> list[Row]:
    """Rows of results that others ran, as they declare them."""
    rows = []
    for file in files:
        try:
            result = load_result(file)
        except ResultError as error:
            raise InputError(f"result: {error}") from None
        name, resolution = result.metadata.get("tool") or file.stem, result.metadata.get("resolution", "–")
        rows.append(_without_praise(Row(str(name)[:40], result.problem.id, str(resolution)[:20], None, score(result))))
    return rows


def _with_bases(problems: Sequence[str]) -> list[str]:
    """The problems, each once, every base before the problem that needs it."""
    bases = [base for name in problems if (base := problem(name).base_id)]
    return sorted(dict.fromkeys([*problems, *bases]), key=lambda name: problem(name).base_id is not None)


def _kept(out: Path, solver: str, name: str, resolution: str) -> Path:
    return out / "results" / solver / f"{name}-{resolution}.npz"


def _stored_row(kept: Path) -> dict[str, Any]:
    try:
        return dict(json.loads(kept.with_suffix(".row.json").read_text(encoding="utf-8")))
    except (OSError, ValueError, TypeError):  # none, or one that somebody broke
        return {}


def _stored(kept: Path) -> tuple[Run, Result | None]:
    """The end of a run and its result; a file that somebody broke since is an invalid result."""
    row = _stored_row(kept)
    try:
        run = Run(str(row["outcome"]), str(row["reason"]), float(row["seconds"]), row["unlimited"], row["repeats"])
    except (ValueError, KeyError, TypeError):
        return Run("invalid", "its row cannot be read", 0.0), None
    if run.outcome:
        return run, None
    try:
        return run, load_result(kept if kept.is_file() else kept.with_suffix(".json"))
    except ResultError as error:
        return Run("invalid", str(error), run.seconds, run.unlimited, run.repeats), None


def _row(adapter: Adapter, asked: Problem, resolution: str, out: Path, drawn: bool) -> Row:
    solver = adapter.name
    run, result = _stored(_kept(out, solver, asked.id, resolution))
    found = Score(asked.id, run.outcome, run.reason)
    if result is not None:
        base = _stored(_kept(out, solver, asked.base_id, resolution))[1] if asked.base_id else None
        try:
            found = score(result, base if base is not None and base.outcome == "completed" else None)
        except ResultError as error:
            found = Score(asked.id, "invalid", str(error))
    return Row(solver, asked.id, resolution, run.seconds, found, run.unlimited, run.repeats, drawn, adapter.made_by())
