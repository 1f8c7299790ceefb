"""The doors for Python: what the commands of the same names answer, with the same numbers."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from bent_beam.cases import Case, load_case
from bent_beam.impact import Impact
from bent_beam.method import Method, method_from_tables
from comparison import bouncing, predicting
from comparison.matching import match as match_all
from comparison.rows import THESIS_KAPPAS, MatchRow, match_document, match_table, questions
from comparison.store import RunStore, default_store

__all__ = ["Matched", "bounce", "match", "predict"]

Beam = Case | Impact | str | Path


def case_of(beam: Beam) -> Case:
    """A case, or that of a file, or of an impact whose damping is as it says. Raises ``InputError``."""
    if isinstance(beam, Case):
        return beam
    if isinstance(beam, Impact):
        return Case(title="", impact=beam, end_time=beam.checked_end_time(), mesh=None, tables={})
    return load_case(beam)


def predict(beam: Beam, *times: float, theory_only: bool = False, fresh: bool = False) -> predicting.PredictedCase:
    """Theory beside simulation at ``times``, s (default: the case's own), and the whole impact.

    beam : a case, its file, or an impact. theory_only : nothing is simulated. fresh : stored runs are ignored.
    Raises ``ValueError`` for what theory or simulation does not take, :class:`bent_beam.SimulationError`.
    """
    case = case_of(beam)
    store = RunStore(None if fresh else default_store())
    return predicting.predict_case(case, times or (case.end_time,), theory_only=theory_only, store=store)


def bounce(beam: Beam, path: str = "hermite", *, jobs: int = 1, fresh: bool = False) -> bouncing.Bounce:
    """The whole impact by the method of ``path``, to the last separation.

    beam : a case, its file, or an impact. jobs : processes. fresh : stored runs are ignored.
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` when it cannot finish.
    """
    case = case_of(beam)
    how: dict[str, Any] = {"section": case.section, "damping_stated": case.damping_stated, "jobs": jobs}
    return bouncing.bounce(case.impact, case.method(path), store=RunStore(None if fresh else default_store()), **how)


class Matched(list[MatchRow]):
    """Rows of a match."""

    def to_dict(self) -> dict[str, Any]:
        """The contract of ``bentbeam match --json``."""
        return match_document(self)

    def __str__(self) -> str:
        return match_table(self)

    def plot(self) -> Any:
        """λ₀ and r₀ over κ/ν on the theory's curves, as a Matplotlib figure."""
        from comparison.figures.matching import leading_figure

        return leading_figure(self)


def match(
    *methods: Method | str,
    kappa_over_nu: Iterable[float] = THESIS_KAPPAS,
    first_order: Sequence[Sequence[float | None]] = (),
    refine: Sequence[float] = (1.0,),
    jobs: int = 1,
    fresh: bool = False,
) -> Matched:
    """Hold methods (or paths; default: Hermite and Exudyn) against the theory: a row for each κ/ν, load and refinement.

    first_order : (α, ψ, χ[, N]) each; none: the leading order. jobs : processes. fresh : stored runs are ignored.
    """
    made = [method_from_tables(one, {}) if isinstance(one, str) else one for one in methods or ("hermite", "exudyn")]
    asked = questions(made, kappa_over_nu, first_order, refine)
    return Matched(match_all(asked, store=RunStore(None if fresh else default_store()), jobs=jobs))
