"""What every study shares: runs in, a table, one picture and a conclusion in words out."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from bent_beam.cases import Case
from comparison.figures.recorder import Sheet, shown
from comparison.plain import plain
from comparison.store import write_atomically
from comparison.studies.outcome import MEASURES, Outcome
from comparison.studies.panels import draw_outcomes
from comparison.studies.thesis import Variant, run_variants
from comparison.studies.variation import Vary

__all__ = ["Progress", "Study", "StudyResult", "perform", "used_measures", "write_result"]

Progress = Callable[[int, int], None]


@dataclass
class StudyResult:
    """What a study found. columns : key → heading; rows : JSON-ready dictionaries; conclusion : plain sentences."""

    name: str
    title: str
    case: str
    columns: dict[str, str]
    rows: list[dict[str, Any]]
    conclusion: str
    outcomes: list[Outcome] = field(default_factory=list)
    files: list[str] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready; numbers finite or null."""
        return dict(
            plain(
                {
                    "name": self.name,
                    "title": self.title,
                    "case": self.case,
                    "columns": self.columns,
                    "rows": self.rows,
                    "conclusion": self.conclusion,
                    "files": self.files,
                    "warnings": self.warnings,
                }
            )
        )

    def table(self) -> list[list[Any]]:
        """Rows of cells, in the order of the columns."""
        return [[row.get(key) for key in self.columns] for row in self.rows]

    def text(self) -> str:
        """Table and conclusion for a terminal."""
        cells = [list(self.columns.values()), *([shown(v) for v in row] for row in self.table())]
        widths = [max(len(row[i]) for row in cells) for i in range(len(self.columns))]
        lines = [
            "  ".join(c.ljust(w) if i == 0 else c.rjust(w) for i, (c, w) in enumerate(zip(row, widths))).rstrip()
            for row in cells
        ]
        lines.insert(1, "  ".join("-" * w for w in widths))
        notes = [f"failed: {_called(r)}: {r['failure']}" for r in self.rows if r.get("failure")]
        notes += [f"warning: {w}" for w in self.warnings]
        files = [f"file: {f}" for f in self.files]
        return "\n".join([f"{self.title}: {self.case}", "", *lines, "", self.conclusion, *notes, *files])


def _called(row: dict[str, Any]) -> str:
    """A row in words."""
    refine = row.get("refine", 1.0)
    words = [row["label"], "" if refine == 1.0 else f"refined {refine:g} times", row.get("setting")]
    return ", ".join(word for word in words if word)


@dataclass(frozen=True)
class Study:
    """A study by name. ``variants(case)`` are its runs, ``conclude(outcomes)`` says what they show; ``perform`` runs
    them.

    heading : of the varied parameter. own : the whole of a study that is not a list of runs.
    vary : its parameter varied on any method (:mod:`comparison.studies.of_methods`).
    """

    name: str
    title: str
    variants: Callable[[Case], list[Variant]] = lambda case: []
    conclude: Callable[[Sequence[Outcome]], str] = lambda outcomes: ""
    heading: str = "run"
    own: Callable[[Case, int, Progress | None], tuple[StudyResult, Sheet]] | None = None
    vary: Vary | None = None


def perform(study: Study, case: Case, *, out: Path | None, jobs: int, progress: Progress | None) -> StudyResult:
    """Run a study on a case; with ``out`` its picture, CSV and conclusion are written there."""
    if study.own is not None:
        result, sheet = study.own(case, jobs, progress)
    else:
        outcomes = run_variants(study.variants(case), jobs=jobs, progress=progress)
        result, sheet = _result(study, case, outcomes), Sheet()
        if out is not None:
            draw_outcomes(sheet, outcomes)
    if out is not None:
        result.files = write_result(result, sheet, out)
    sheet.close()
    return result


def _result(study: Study, case: Case, outcomes: list[Outcome]) -> StudyResult:
    finished = [o for o in outcomes if o.failure is None]
    warnings = sorted({f"{o.label}: {w}" for o in finished if o.reference for w in o.warnings})
    return StudyResult(
        name=study.name,
        title=study.title,
        case=case.title,
        columns={"label": study.heading, **used_measures(outcomes)},
        rows=[o.row() for o in outcomes],
        conclusion=_concluded(study, outcomes) if finished else "No run finished.",
        outcomes=list(outcomes),
        warnings=warnings,
    )


def used_measures(outcomes: Sequence[Outcome]) -> dict[str, str]:
    """Measures that any run has, and how they are headed."""
    return {k: h for k, h in MEASURES.items() if any(o.measures.get(k) is not None for o in outcomes)}


def _concluded(study: Study, outcomes: Sequence[Outcome]) -> str:
    """What the finished runs show, and which runs are missing from it."""
    missing = [o.label for o in outcomes if o.failure is not None]
    text = study.conclude([o for o in outcomes if o.failure is None])
    return f"{text} Without {', '.join(missing)}: it did not finish." if missing else text


def write_result(result: StudyResult, sheet: Sheet, out: Path) -> list[str]:
    """Picture with its curves' CSV, the table's CSV, and the result as JSON; returns the files."""
    files = []
    if sheet.figure_ is not None:
        files = [str(f) for f in sheet.save(out, result.name)]
    table = Sheet()
    table.table(list(result.columns.values()), result.table())
    written = out / f"{result.name}-table.csv"
    write_atomically(written, table.csv())
    table.close()
    files += [str(written), str(out / f"{result.name}.json")]
    result.files = files
    write_atomically(out / f"{result.name}.json", json.dumps(result.to_dict(), indent=1, allow_nan=False))
    return files
