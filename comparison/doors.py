"""The doors for Python: what the commands of the same names answer, with the same numbers. What a command has more of,
such as hits or other end times, stands in its driver: :mod:`comparison.bouncing`, :mod:`comparison.predicting` …"""

from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam import InputError
from bent_beam.cases import Case, holds, lay_over, lay_values, read_toml
from bent_beam.checks import finite, shortened
from bent_beam.files import write_atomically, write_dataset
from bent_beam.method import Method, method_from_tables
from comparison import bouncing
from comparison.bounced import Bounce
from comparison.bouncing import Beam, case_of
from comparison.matching import Matched
from comparison.matching import match as match_all
from comparison.methods import PATHS, check_effect
from comparison.predicting import PredictedCase, predict_case
from comparison.readable import csv_text, folder, write_answer
from comparison.rows import THESIS_KAPPAS, questions
from comparison.store import RunStore
from comparison.sweeping import Row, SweepTable, cases_of, never_leaves, row_of, varied_from
from comparison.workers import Count, run_all

__all__ = ["Swept", "bounce", "match", "predict", "sweep"]


def predict(beam: Beam, *times: float, theory_only: bool = False, fresh: bool = False) -> PredictedCase:
    """Theory beside simulation at ``times``, s (default: the case's own), and the whole impact.

    beam : a case, its file or tables, or an impact. theory_only : no simulation. fresh : stored runs are ignored.
    Raises ``ValueError`` for what theory or simulation does not take, :class:`bent_beam.SimulationError`.
    """
    case = case_of(beam)
    for time in times:
        if isinstance(time, (Sequence, np.ndarray)) and not isinstance(time, str):
            got = shortened(time)
            raise InputError(f"times must be a finite number each: predict(case, 0.001, 0.002), no list (got {got})")
        finite("times", time)
    return predict_case(case, times or (case.end_time,), theory_only=theory_only, store=RunStore.usual(fresh))


def made(method: Method | str, case: Case | None = None) -> Method:
    """The method of a path, with the settings of a case, or the one that is given. Raises ``InputError``."""
    if isinstance(method, str):
        return method_from_tables(method, {}) if case is None else case.method(method)
    if isinstance(method, type):
        raise InputError(f"method: must be made from its class: {method.__name__}() (got the class)")
    if not isinstance(method, Method):
        raise InputError(f"method: must be the name of a path or a method (got {shortened(method)})")
    return method


def bounce(beam: Beam, path: Method | str = "hermite", *, jobs: int = 1, fresh: bool = False) -> Bounce:
    """The whole impact by the method of ``path``, or by a method, to the last separation.

    beam : a case, its file or tables, or an impact. jobs : processes. fresh : stored runs are ignored.
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` when it cannot finish.
    """
    case = case_of(beam)
    return bouncing.bounce(case, made(path, case), store=RunStore.usual(fresh), jobs=jobs)


def match(
    *methods: Method | str,
    kappa_over_nu: float | Iterable[float] = THESIS_KAPPAS,
    first_order: Sequence[Sequence[float | None]] = (),
    refine: Sequence[float] = (1.0,),
    jobs: int = 1,
    fresh: bool = False,
) -> Matched:
    """Hold methods (or paths; default: Hermite and Exudyn) against the theory: a row for each κ/ν, load and refinement.

    first_order : (α, ψ, χ[, N]) each; none: the leading order. jobs : processes. fresh : stored runs are ignored.
    """
    many = isinstance(kappa_over_nu, Iterable) and not isinstance(kappa_over_nu, (str, np.ndarray))
    ratios: Any = kappa_over_nu if many else np.atleast_1d(kappa_over_nu).tolist()  # type: ignore[arg-type]
    firsts = [one.tolist() if isinstance(one, np.ndarray) else one for one in first_order]
    asked = questions([made(one) for one in methods or PATHS], ratios, firsts, refine)
    return match_all(asked, store=RunStore.usual(fresh), jobs=jobs)


class Swept(SweepTable):
    """A sweep: its rows as a table, a grid and a figure."""

    def plot(self) -> Any:
        """Curves with bars over one key, or maps over two, as a Matplotlib figure. Raises ``ValueError`` for more."""
        from comparison.figures.sweep import sweep_figure

        return sweep_figure(self)

    def write(self, out: str | Path) -> list[Path]:
        """``sweep.json``, ``sweep.csv``, ``sweep.nc`` and, where it can be drawn, ``sweep.png``; returns the files."""
        table, grid = (folder(out) / f"sweep.{kind}" for kind in ("csv", "nc"))
        write_atomically(table, csv_text(row.to_dict() for row in self.rows))
        write_dataset(self.to_dataset(), grid)
        drawable = len(self.vary) <= 2 and any(row.numbers for row in self.rows)
        return [table, grid, *write_answer(self, out, "sweep", drawable)]


def sweep(
    case: str | Path | Mapping[str, Any],
    vary: Mapping[str, Sequence[Any] | str],
    path: str = "hermite",
    *,
    assignments: Sequence[str] = (),
    jobs: int | None = 1,
    scheduler: str | None = None,
    fresh: bool = False,
    progress: Count | None = None,
) -> Swept:
    """The whole impact of a case for each combination of ``vary``: key → values, or their text ("0.5:2:4").

    case : its file, or its tables. assignments : ``table.key=value``, laid over it first. jobs : processes
        (``None``: as many as pay). scheduler : address of a dask one. progress : called with (done, all) rows.
    fresh : stored runs are ignored.
    Raises ``ValueError`` for what is no case at all; a row that fails is a row with its reason.
    """
    if not isinstance(case, (str, Path, Mapping)):
        raise InputError(f"case must be a case file or its tables, whose keys can be varied (got {shortened(case)})")
    if not isinstance(path, str):
        raise InputError(f"path must be the name of a path; its settings stand in the case (got {shortened(path)})")
    tables: dict[str, Any] = deepcopy(dict(case)) if isinstance(case, Mapping) else read_toml(Path(case), "case file")
    lay_over(tables, assignments)
    given: dict[str, Sequence[Any]] = {}
    for key, values in vary.items():
        if not isinstance(values, (str, Sequence, np.ndarray)):
            raise InputError(f"vary: {key} takes its values in a list, or as text (got {shortened(values)})")
        listed = values.tolist() if isinstance(values, np.ndarray) else values
        given[key] = varied_from(f"{key}={listed}")[1] if isinstance(listed, str) else list(listed)
        for value in given[key]:
            if isinstance(value, float):
                finite(f"vary: {key}", value)
    lay_values(laid := deepcopy(tables), {key: values[0] for key, values in given.items() if values}, "--vary")
    for said in assignments:
        key = ".".join(name.strip() for name in said.partition("=")[0].split("."))
        if key in given or not holds(laid, key):
            raise InputError(f"--set {shortened(said)} has no effect: --vary says the same in every row; leave one out")
    cases = cases_of(tables, given)
    timed = any(isinstance(case, Case) and never_leaves(case.impact) for _, case in cases)
    unused = {} if timed else {"run": "the last separation ends a row"}
    check_effect(assignments, [path], unused, "--set")
    check_effect(vary, [path], unused, "vary:")

    def died(i: int, why: str) -> Row:
        return Row(cases[i][0], reason=why)

    calls = [(varied, case, path, RunStore.usual(fresh)) for varied, case in cases]
    rows = run_all(row_of, calls, jobs=jobs, scheduler=scheduler, progress=progress, on_death=died)
    return Swept(str(tables.get("title", "")), path, given, rows)
