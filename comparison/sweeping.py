"""A case over ranges of its keys: for each combination the numbers that ``bounce`` gives of that case, in SI; as a
document, a table for readers, columns (pandas), a grid (xarray).

A row is a case like any other, and its runs are kept under its own questions: a killed sweep goes on where it was, and
``bounce`` of one of its cases runs nothing again. Where no separation is the last, between two walls or supports, a row
holds what ``predict`` gives at the end time.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from functools import cached_property
from itertools import product
from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from bent_beam.cases import Case, case_from_tables, lay_values, value_of
from bent_beam.checks import shortened
from bent_beam.errors import ANY_FAILURE, InputError
from bent_beam.impact import Impact
from bent_beam.measure.numbers import Band, Number
from bent_beam.method import separation_times
from bent_beam.settings import settings
from bent_beam.tables import in_keys
from comparison.bounced import documents
from comparison.bouncing import bounce
from comparison.doubts import doubts, told_by
from comparison.predicting import numbers_at, runs_to
from comparison.readable import flat, milliseconds, readable, text_table, unit_for, with_bar
from comparison.rows import failures, reason_of
from comparison.store import RunStore
from comparison.whole_numbers import WHOLE

if TYPE_CHECKING:
    import xarray

__all__ = ["NAMES", "Row", "SweepTable", "cases_of", "never_leaves", "numeric", "row_of", "varied_from"]

NAMES = tuple(name for name, about in WHOLE.items() if about.heading or name.startswith("peak_moment"))
"""Numbers of a row, SI."""
MOST = 10_000  # rows


@dataclass(frozen=True)
class Row:
    """One case: what was ``varied``, by key, and its ``numbers`` by name (:data:`NAMES`; those that exist).

    until : s, of a case without a last separation, whose numbers are those until then. kept : whether all its runs came
    from the store. reason : why there are no numbers; refused : input said so, no run.
    """

    varied: dict[str, Any]
    kappa_over_nu: float | None = None
    yield_stress: float | None = None
    numbers: Mapping[str, Number | Band] = field(default_factory=dict)
    until: float | None = None
    warnings: Sequence[str] = ()
    reason: str | None = None
    refused: bool = False
    kept: bool = False

    @property
    def name(self) -> str:
        """In words."""
        return ", ".join(f"{key} = {readable(value)}" for key, value in self.varied.items())

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready: the same however often the sweep was interrupted."""
        names = ("varied", "kappa_over_nu", "until", "yield_stress", "reason", "refused")
        found = {name: getattr(self, name) for name in names} | documents(self.numbers, NAMES)
        return found | {"warnings": list(self.warnings)}


def varied_from(text: str) -> tuple[str, list[Any]]:
    """Key and values of ``TABLE.KEY=A:B:N``, N values evenly from A to B, or ``TABLE.KEY=A,B,C``.

    >>> varied_from("impact.velocity=0.5:1.5:3")
    ('impact.velocity', [0.5, 1.0, 1.5])
    >>> varied_from("section.kind=pipe,round_bar")
    ('section.kind', ['pipe', 'round_bar'])
    """
    key, _, given = (part.strip() for part in text.partition("="))
    key = ".".join(name.strip() for name in key.split("."))
    words = given.split(",")
    if "." not in key or not all(word.strip() for word in words):
        raise InputError(f"--vary takes TABLE.KEY=A:B:N or TABLE.KEY=A,B,C (got {shortened(text)})")
    ends = [value_of(word) for word in given.split(":")]
    if len(ends) == 1 or (len(ends) != 3 and not numeric(ends)):  # a name may hold colons
        return key, [value_of(word) for word in words]
    if len(ends) != 3 or not _are_range(ends):
        forms = f"A:B:N, two numbers and how many values, from 2 on, or A,B,C; {MOST} values at most"
        raise InputError(f"--vary {key} takes {forms} (got {shortened(given)})")
    return key, [float(f"{value:.12g}") for value in np.linspace(*ends)]  # as one would type them


def cases_of(
    tables: Mapping[str, Any], vary: Mapping[str, Sequence[Any]]
) -> list[tuple[dict[str, Any], Case | InputError]]:
    """Each combination of the values of ``vary`` (``table.key`` → values), the last key varying fastest, and what it
    laid over a case's ``tables`` makes. Raises :class:`InputError` where none of them is a case, and for a key without
    effect on any."""
    if not vary:
        raise InputError("vary: nothing is varied: give at least one key with its values")
    count = int(np.prod([len(values) for values in vary.values()]))
    if count > MOST:
        raise InputError(f"vary: {MOST} rows at most (got {count} rows)")
    for key, values in vary.items():
        if len(values) == 0:
            raise InputError(f"vary: {key} has no values (got {shortened(list(values))})")
        if len({float(value) if numeric([value]) else str(value) for value in values}) < len(values):
            raise InputError(f"vary: {key} has a value twice (got {shortened(list(values))})")
    combinations = [dict(zip(vary, values)) for values in product(*vary.values())]
    cases = [_case(tables, varied) for varied in combinations]
    if all(isinstance(case, InputError) for case in cases):
        raise cases[0]  # type: ignore[misc]
    for key in vary:
        alike: dict[str, list[Any]] = defaultdict(list)
        for varied, case in zip(combinations, cases):
            alike[repr({**varied, key: None})].append(_effective(case))
        if len(vary[key]) > 1 and all(one == rows[0] for rows in alike.values() for one in rows):
            raise InputError(f"vary: {key} has no effect on any row (got {shortened(list(vary[key]))}): leave it out")
    return list(zip(combinations, cases))


def _effective(case: Case | InputError) -> Any:
    """What a row depends on."""
    if isinstance(case, InputError):
        return str(case)
    section = case.section
    strength = section and (section.section_modulus, section.area, section.yield_stress)
    return case.impact, case.damping_stated, case.end_time, case.mesh, case.tables, strength


def never_leaves(impact: Impact) -> bool:
    """Whether no separation is the last: a row then ends with ``run``."""
    try:
        separation_times(impact)
    except InputError:
        return True
    return False


def _case(tables: Mapping[str, Any], varied: Mapping[str, Any]) -> Case | InputError:
    laid = deepcopy(dict(tables))
    try:
        lay_values(laid, varied, "--vary")
        return case_from_tables(laid)
    except InputError as error:
        return error


def row_of(varied: dict[str, Any], case: Case | InputError, path: str, store: RunStore) -> Row:
    """One row, in a worker: a failure is an answer too."""
    if isinstance(case, InputError):
        return Row(varied, reason=str(case), refused=True)
    about: dict[str, Any] = {"varied": varied, "kappa_over_nu": case.impact.kappa_over_nu}
    try:
        return Row(**about, yield_stress=getattr(case.section, "yield_stress", None), **_found(case, path, store))
    except ANY_FAILURE as error:
        return Row(**about, reason=in_keys(reason_of(error)), refused=isinstance(error, InputError))


def _found(case: Case, path: str, store: RunStore) -> dict[str, Any]:
    impact, method = case.impact, case.method(path)
    if never_leaves(impact):
        runs = runs_to(case, method, (case.end_time,), store)
        numbers = numbers_at(runs, case)
        warnings = [*doubts(impact, case.section), *told_by(numbers, case.section), *runs.warnings]
        return {"numbers": numbers, "until": case.end_time, "warnings": warnings, "kept": runs.kept}
    found = bounce(case, method, store=store)
    return {"numbers": found.in_si, "warnings": found.warnings, "kept": found.kept}


@dataclass(frozen=True)
class SweepTable:
    """Rows of a sweep of the case ``title`` by the method of ``path``. vary : key → values, the last one fastest."""

    title: str
    path: str
    vary: Mapping[str, Sequence[Any]]
    rows: Sequence[Row]

    @property
    def kept(self) -> int:
        """How many rows came from the store, all their runs."""
        return sum(row.kept for row in self.rows)

    @cached_property
    def units(self) -> dict[str, str]:
        """Unit of each key that is varied, as ``bentbeam settings`` has it; "" of a pure number."""
        known = {f"{one.table}.{one.name}": "" if one.unit == "1" else one.unit for one in settings()}
        return {key: known.get(key, "") for key in self.vary}

    def to_dict(self) -> dict[str, Any]:
        """The contract of ``bentbeam sweep --json``."""
        return {
            "title": self.title,
            "path": self.path,
            "vary": {key: list(values) for key, values in self.vary.items()},
            "rows": [row.to_dict() for row in self.rows],
            "failures": [{"varied": row.varied, "reason": row.reason} for row in failures(self.rows)],
            "kept": self.kept,
        }

    def to_dataset(self) -> "xarray.Dataset":
        """The numbers, ``name`` and ``name_error``, over the keys as coordinates, SI; NaN where there is none."""
        import xarray

        columns = {"kappa_over_nu": "1"}
        columns |= {f"{n}{end}": WHOLE[n].unit or "1" for n in NAMES for end in ("", "_error", "_mean", "_std")}
        rows, shape = [flat(row.to_dict()) for row in self.rows], [len(values) for values in self.vary.values()]
        variables = {}
        for name, unit in columns.items():
            values = np.array([row.get(name) for row in rows], float)  # None is NaN
            if np.isfinite(values).any():
                variables[name] = (list(self.vary), values.reshape(shape), {"units": unit})
        coordinates = {
            key: (key, np.array(values if numeric(values) else list(map(str, values))), {"units": self.units[key]})
            for key, values in self.vary.items()
        }
        about = {"title": self.title, "path": self.path, "made_by": "bentbeam sweep"}
        return xarray.Dataset(variables, coordinates, about)

    @property
    def table(self) -> Any:
        """The same as a pandas frame: a column a key and a number, a row a case."""
        return self.to_dataset().to_dataframe().reset_index()

    def __str__(self) -> str:
        units = {}
        for name, about in WHOLE.items():
            found = [row.numbers[name] for row in self.rows if name in row.numbers]
            if about.heading and found:
                units[name] = unit_for(about.unit, [with_bar(one)[0] for one in found])
        titles = [*self.units.items(), *((WHOLE[name].heading, unit) for name, (_, unit) in units.items())]
        head = [f"{title}, {unit}" if unit else title for title, unit in titles]
        body = []
        for row in self.rows:
            numbers = row.numbers
            cells = [str(numbers[n].scaled(scale)) if n in numbers else "-" for n, (scale, _) in units.items()]
            body.append([readable(value) for value in row.varied.values()] + cells)
        banded = any(isinstance(number, Band) for row in self.rows for number in row.numbers.values())
        bars = "± is the error bar; a band is mean ± standard deviation of runs" if banded else "± is the error bar"
        kept = f"{bars}. {self.kept} of {len(self.rows)} rows came from the store."
        lines = [text_table(head, body), "", kept]
        if ends := sorted({row.until for row in self.rows if row.until is not None}):
            lines.append(
                "Between two walls or supports no separation is the last: numbers until the case's end time, "
                f"{' to '.join(map(milliseconds, dict.fromkeys((ends[0], ends[-1]))))}."
            )
        said = [(f"no numbers: {row.reason}", row.name) for row in self.rows if row.reason]
        said += [(f"warning: {text}", row.name) for row in self.rows for text in row.warnings]
        told: dict[str, list[str]] = {}  # each sentence once, and of which rows it is
        for text, name in said:
            told.setdefault(text, []).append(name)
        return "\n".join([*lines, *(f"{text} ({self._which(names)})" for text, names in told.items())])

    def _which(self, names: Sequence[str]) -> str:
        """Rows in words."""
        if 1 < len(names) == len(self.rows):
            return "all rows"
        return names[0] if len(names) == 1 else f"{len(names)} rows, the first at {names[0]}"


def _are_range(ends: Sequence[Any]) -> bool:
    """Whether these are two numbers and how many values."""
    return numeric(ends) and bool(np.all(np.isfinite(ends))) and isinstance(ends[2], int) and 2 <= ends[2] <= MOST


def numeric(values: Sequence[Any]) -> bool:
    return all(isinstance(value, Real) and not isinstance(value, bool) for value in values)
