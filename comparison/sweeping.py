"""A case over ranges of its keys: for each combination the numbers that ``bounce`` gives of that case, in SI.

A row is a case like any other, and its runs are kept under its own questions: a killed sweep goes on where it was, and
``bounce`` of one of its cases runs nothing again. Where no separation is the last, between two walls or supports, a row
holds what ``predict`` gives at the end time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from bent_beam.cases import Case, case_from_tables, lay_values, value_of
from bent_beam.checks import shortened
from bent_beam.errors import ANY_FAILURE, InputError
from bent_beam.measure.numbers import Band, Number
from bent_beam.method import separation_times
from bent_beam.tables import in_keys
from comparison.bounced import documents
from comparison.bouncing import bounce
from comparison.doubts import doubts
from comparison.predicting import instants_reading, numbers_at
from comparison.questions import Question
from comparison.readable import readable
from comparison.rows import reason_of
from comparison.runs import runs_of
from comparison.store import RunStore
from comparison.whole_numbers import WHOLE

__all__ = ["NAMES", "Row", "cases_of", "row_of", "varied_from"]

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
        return {name: getattr(self, name) for name in names} | {
            **documents(self.numbers, NAMES),
            "warnings": list(self.warnings),
        }


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
    ends = given.split(":")
    if len(ends) != 3:
        return key, [value_of(word) for word in words]
    first, last, count = map(value_of, ends)
    if isinstance(first, str) or isinstance(last, str) or not isinstance(count, int) or not 2 <= count <= MOST:
        raise InputError(f"--vary {key}: A:B:N are two numbers and how many values, from 2 on (got {shortened(given)})")
    return key, [float(f"{value:.12g}") for value in np.linspace(first, last, count)]  # as one would type them


def cases_of(
    tables: Mapping[str, Any], vary: Mapping[str, Sequence[Any]]
) -> list[tuple[dict[str, Any], Case | InputError]]:
    """Each combination of the values of ``vary`` (``table.key`` → values), the last key varying fastest, and what it
    laid over a case's ``tables`` makes.

    Raises :class:`InputError` for a combination that is no case where none of them is.
    """
    count = int(np.prod([len(values) for values in vary.values()]))
    if not vary or not 1 <= count <= MOST:
        raise InputError(f"vary: takes at least one key with values, and {MOST} rows at most (got {count} rows)")
    combinations = [dict(zip(vary, values)) for values in product(*vary.values())]
    cases = [_case(tables, varied) for varied in combinations]
    if all(isinstance(case, InputError) for case in cases):
        raise cases[0]  # type: ignore[misc]
    return list(zip(combinations, cases))


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
    """What runs say in a row."""
    impact, method = case.impact, case.method(path)
    try:
        separation_times(impact)
    except InputError:
        question = Question(impact, method, case.end_time, damping_stated=case.damping_stated)
        runs = runs_of(question, partial(instants_reading, (case.end_time,), question.first_spread), store=store)
        warnings = [*doubts(impact, case.section), *runs.warnings]
        return {"numbers": numbers_at(runs, case), "until": case.end_time, "warnings": warnings, "kept": runs.kept}
    found = bounce(case, method, store=store)
    return {"numbers": found.in_si, "warnings": found.warnings, "kept": found.kept}
