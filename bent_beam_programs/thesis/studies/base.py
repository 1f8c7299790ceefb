"""A study: runs in; a table, one picture and a fixed sentence out."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

from bent_beam.as_json import plain
from bent_beam.cases import Case
from bent_beam_programs.thesis.sheet import Sheet
from bent_beam_programs.thesis.studies.of_methods import Vary
from bent_beam_programs.thesis.studies.outcome import MEASURES, Outcome
from bent_beam_programs.thesis.studies.panels import draw_outcomes
from bent_beam_programs.thesis.studies.thesis import Variant, run_variants
from comparison.readable import readable, text_table
from comparison.workers import Count


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
        return [[row.get(key) for key in self.columns] for row in self.rows]

    def text(self) -> str:
        """Table and conclusion for a terminal."""
        table = text_table(list(self.columns.values()), [[readable(v) for v in row] for row in self.table()])
        lost = [r for r in self.rows if r.get("failure")]
        notes = [f"failed: {', '.join(filter(None, (r['label'], r.get('setting'))))}: {r['failure']}" for r in lost]
        notes += [f"warning: {w}" for w in self.warnings] + [f"file: {f}" for f in self.files]
        return "\n".join([f"{self.title}: {self.case}", "", table, "", self.conclusion, *notes])


def outcomes_of(study: Study, case: Case, *, jobs: int = 1, progress: Count | None = None) -> list[Outcome]:
    """The runs of a study with the thesis's settings, with the study's own numbers among their measures."""
    runs = study.variants(case)
    return [
        replace(outcome, measures={**outcome.measures, **study.more(run, outcome)})
        for run, outcome in zip(runs, run_variants(runs, jobs=jobs, progress=progress))
    ]
