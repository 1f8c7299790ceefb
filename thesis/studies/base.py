"""A study: runs in; a table, one picture and a fixed sentence out."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import Any

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.plain import plain
from comparison.readable import readable
from comparison.store import write_atomically
from thesis.sheet import Sheet
from thesis.studies.of_methods import CONCLUSION, Vary, draw_methods, runs_of_methods
from thesis.studies.outcome import MEASURES, Outcome
from thesis.studies.panels import draw_outcomes
from thesis.studies.thesis import Progress, Variant, run_variants

SAME = 30  # characters of a warning that tell its kind: its numbers differ from run to run


@dataclass(frozen=True)
class Study:
    """A study by name.

    heading : of the varied parameter. variants : the runs with the thesis's settings; the first line of its docstring
    is the study's title, the rest one sentence on what the table shows, whatever its numbers. vary : the same parameter
    on any method. columns : of the table, key → heading. more(variant, outcome) : further numbers for them. draw : the
    picture.
    """

    name: str
    heading: str
    variants: Callable[[Case], list[Variant]]
    vary: Vary
    columns: Mapping[str, str] = field(default_factory=lambda: MEASURES)
    more: Callable[[Variant, Outcome], Mapping[str, float | None]] = lambda variant, outcome: {}
    draw: Callable[[Sheet, Sequence[Outcome]], None] = draw_outcomes

    @property
    def title(self) -> str:
        return (self.variants.__doc__ or "").partition("\n\n")[0]

    @property
    def conclusion(self) -> str:
        return " ".join((self.variants.__doc__ or "").partition("\n\n")[2].split())


@dataclass
class StudyResult:
    """Result of a study. columns : key → heading; rows : JSON-ready dictionaries. problem : why files are missing."""

    name: str
    title: str
    case: str
    columns: dict[str, str]
    rows: list[dict[str, Any]]
    conclusion: str
    files: list[str]
    warnings: list[str]
    problem: str | None = None

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready; numbers finite or null."""
        return dict(plain(asdict(self)))

    def table(self) -> list[list[Any]]:
        """Rows of cells, in the order of the columns."""
        return [[row.get(key) for key in self.columns] for row in self.rows]

    def text(self) -> str:
        """Table and conclusion for a terminal."""
        cells = [list(self.columns.values()), *([readable(v) for v in row] for row in self.table())]
        widths = [max(map(len, column)) for column in zip(*cells)]
        lines = [
            "  ".join([row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:], widths[1:]))]).rstrip()
            for row in [cells[0], ["-" * w for w in widths], *cells[1:]]
        ]
        notes = [
            f"failed: {', '.join(filter(None, (r['label'], r.get('setting'))))}: {r['failure']}"
            for r in self.rows
            if r.get("failure")
        ]
        notes += [f"warning: {w}" for w in self.warnings] + [f"file: {f}" for f in self.files]
        return "\n".join([f"{self.title}: {self.case}", "", *lines, "", self.conclusion, *notes])


def outcomes_of(study: Study, case: Case, *, jobs: int = 1, progress: Progress | None = None) -> list[Outcome]:
    """The runs of a study with the thesis's settings, with the study's own numbers among their measures."""
    runs = study.variants(case)
    return [
        replace(outcome, measures={**outcome.measures, **study.more(run, outcome)})
        for run, outcome in zip(runs, run_variants(runs, jobs=jobs, progress=progress))
    ]


def _on_methods(
    study: Study, case: Case, methods: Sequence[Method], refines: Sequence[float], jobs: int, progress: Progress | None
) -> list[Outcome]:
    asked = runs_of_methods(study.vary, case, methods, refines)
    runs = [one for one in asked if isinstance(one, Variant)]
    done = iter(run_variants(runs, jobs=jobs, progress=progress))
    return [next(done) if isinstance(one, Variant) else one for one in asked]


def perform(
    study: Study,
    case: Case,
    methods: Sequence[Method] = (),
    refines: Sequence[float] = (1.0,),
    *,
    out: Path | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
) -> StudyResult:
    """Run a study on a case, with the thesis's settings or on ``methods``, each with elements and steps ``refines``
    times finer; with ``out`` its picture, data and result are written there.
    """
    heads = {"label": study.heading}
    if methods:
        outcomes = _on_methods(study, case, methods, refines, jobs, progress)
        heads = {"label": "method", **({"refine": "refine"} if set(refines) != {1.0} else {}), "setting": study.heading}
    else:
        outcomes = outcomes_of(study, case, jobs=jobs, progress=progress)
    rows = [o.row() for o in outcomes]
    measured = MEASURES if methods else study.columns
    result = StudyResult(
        name=study.name,
        title=study.title,
        case=case.title,
        columns=heads | {k: h for k, h in measured.items() if any(r.get(k) is not None for r in rows)},
        rows=rows,
        conclusion=CONCLUSION if methods else study.conclusion,
        files=[],
        warnings=_warnings([o for o in outcomes if methods or o.mark is not None]),
    )
    if out is not None:
        sheet = Sheet()
        if methods:
            draw_methods(sheet, study.heading, outcomes)
        else:
            study.draw(sheet, outcomes)
        try:
            _write(result, sheet, out)
        except OSError as error:  # the answer is worth more than its files
            result.problem = f"out: {error}"
    return result


def _warnings(outcomes: Sequence[Outcome]) -> list[str]:
    """Each kind of warning of a method once, with its first run."""
    found: dict[tuple[str, str], str] = {}
    for o in outcomes:
        for text in o.warnings:
            found.setdefault((o.method, text[:SAME]), f"{o.name}: {text}")
    return list(found.values())


def _write(result: StudyResult, sheet: Sheet, out: Path) -> None:
    """Picture with its curves' CSV, the table's CSV, and the result as JSON."""
    if sheet.figure_ is not None:
        result.files += [str(f) for f in sheet.save(out, result.name)]
    table, document = out / f"{result.name}-table.csv", out / f"{result.name}.json"
    cells = Sheet()
    cells.data(list(result.columns.values()), result.table())
    write_atomically(table, cells.csv())
    result.files += [str(table), str(document)]
    write_atomically(document, json.dumps(result.to_dict(), indent=1, allow_nan=False))
