"""Any method held against the theory: leading order from one run at ε = 0, first order by ε → 0.

Nothing here knows a path. A method simulates; its history is reduced to moments of the impulse; the estimators read
λ₀, r₀, λ₁, r₁ off them; the theory is joined to the numbers afterwards.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any, Self

import numpy as np

from bent_beam import Impact, ImpactHistory
from bent_beam.checks import positive
from bent_beam.errors import ANY_FAILURE, SimulationError
from bent_beam.measure.balance import balance_of
from bent_beam.measure.estimators import FirstOrderEstimate, LeadingEstimate, first_order, leading_order
from bent_beam.measure.moments import Moments, moments, unresolved_at_end
from bent_beam.measure.numbers import MISSING, Number, number_of
from bent_beam.measure.reduction import hold_of, pull_of, wall_peaks
from bent_beam.method import Method, chosen_for, refined, simulated
from comparison import rows
from comparison.questions import ERROR_BARS, FEWEST, check_lengths
from comparison.rows import MatchQuestion, MatchRow
from comparison.runs import Run, kept
from comparison.store import RunStore
from comparison.workers import Clock, Count, run_all

__all__ = ["CODE", "Matched", "answer", "match"]

SAVED = 250
SHARES = (0.35, 0.7, 1.0)  # of the largest ε
PERTURBATION = 0.05  # see first_order_epsilon (tests: half, twice); a method may carry its own ``perturbation``
WIDE = 0.02  # of a leading-order number: a wider error bar deserves a warning
WIDE_FIRST = 0.1  # of max(|r₁|, 1), likewise
CODE = (
    *("bent_beam", "theory", "hermite_fe", "self_similar_fe", "exudyn_models"),
    *("comparison.matching", "comparison.questions", "comparison.rows", "comparison.runs"),
)
"""What the numbers of a row depend on, as :func:`bent_beam.stored.write` takes it."""


class Refused(ValueError):
    """What a method refuses, when it is made or before its run; any other error is a failure."""


def _reading(uniform: bool, history: ImpactHistory) -> dict[str, Any]:
    """A run reduced to moments, JSON-ready. uniform : see :func:`moments`; the run without loads must be read as the
    loaded ones are, or the noise that they share does not drop out."""
    peaks, balance = wall_peaks(history), balance_of(history)
    unit = (history.impact.wall_stiffness or 1.0) ** 0.25  # EI = μ = V₀ = 1
    found = moments(history, uniform=uniform)
    return {
        "moments": {name: values.tolist() for name, values in vars(found).items()},
        "unresolved": unresolved_at_end(history, found),
        "peak_force": None if peaks is None else peaks.force / unit,
        "pull": pull_of(history),
        "hold": hold_of(history),
        "momentum_residual": balance.momentum,
        "gap_of_push": balance.gap_of_push,
        "warnings": balance.warnings,
    }


def _moments(run: Run) -> Moments:
    return Moments(**{name: np.array(values) for name, values in run.reading["moments"].items()})


def _run(
    store: RunStore, duration: float, clock: Clock | None, method: Method, impact: Impact, uniform: bool = False
) -> Run:
    """A run to ``duration`` (t*), from the store where it is there, against the clock. Raises :class:`Refused` for what
    the method refuses, before its run or in it."""
    if reason := method.refuses(impact):
        raise Refused(str(reason))

    def run() -> ImpactHistory:
        how: dict[str, Any] = {"end_time": duration * impact.time_scale, "save": SAVED}
        try:
            return simulated(method.simulate, impact, progress=clock and clock.progress(), **how)
        except ValueError as error:
            raise Refused(str(error)) from None

    return kept(store, {"impact": asdict(impact), "duration": duration}, method, partial(_reading, uniform), run)


@dataclass(frozen=True)
class _Estimates:
    """What the runs at one resolution gave: all ``runs``, the one without loads first; ``base`` without loads and
    ``loaded`` at each ε on the mesh for first order; ``pressure`` on the zone over ε."""

    runs: list[Run]
    base: Moments | None = None
    loaded: Sequence[tuple[float, Moments]] = ()
    pressure: float = 0.0

    def leading(self, others: Sequence[Self] = ()) -> LeadingEstimate:
        own, companions = self.runs[0], [_moments(other.runs[0]) for other in others]
        return leading_order(_moments(own), companions=companions, unresolved=own.reading["unresolved"])

    def first(self, others: Sequence[Self] = ()) -> FirstOrderEstimate | None:
        """``None`` where first order was not asked for."""
        if self.base is None:
            return None
        companions = [found for found in (o.first() for o in others) if found]
        return first_order(self.loaded, self.base, self.leading(others), pressure=self.pressure, companions=companions)


def _estimates(
    question: MatchQuestion, factor: float, run: Callable[..., Run], epsilon: float | None = None
) -> _Estimates:
    """Run and estimate at ``factor`` times the method's own resolution; ``epsilon`` is the largest ε, ``None``: chosen.
    Raises :class:`Refused` for what the method refuses."""
    asked, first, bare = question.method, question.first, question.bare
    method = refined(asked, factor)
    if method is None:
        raise Refused(f"refine: {asked.path} does not know how to be refined (got {factor:g})")
    alone = run(method, bare)
    if first is None:
        return _Estimates([alone])
    if epsilon is None:
        perturbation = getattr(asked, "perturbation", PERTURBATION)
        epsilon = rows.first_order_epsilon(leading_order(_moments(alone)), first, perturbation, question.duration)
    largest = question.loaded(epsilon)
    if reason := method.refuses(largest):
        raise Refused(str(reason))
    fixed = chosen_for(method, largest, question.duration * bare.time_scale)
    # only a load that presses the zone leaves a uniform reaction to take out, of the bare run too
    pressed = largest.zone_pressure > 0.0
    base, *found = (run(fixed, question.loaded(share * epsilon), pressed) for share in (0.0, *SHARES))
    moved = [(share * epsilon, _moments(one)) for share, one in zip(SHARES, found)]
    return _Estimates([alone, base, *found], _moments(base), moved, largest.zone_pressure / epsilon)


def _check(question: MatchQuestion) -> None:
    """Raises :class:`Refused` for elements or steps of which no run with half as many tells the error."""
    bare, method = question.bare, refined(question.method, question.refine) or question.method
    try:
        check_lengths(method, bare, question.duration * bare.time_scale / FEWEST, f"until {question.duration:g} t*")
    except ValueError as error:
        raise Refused(str(error)) from None


def answer(question: MatchQuestion, store: RunStore, limit: float | None = None) -> MatchRow:
    """Simulate and estimate one row; companion runs at other resolutions say what the error bar is.

    limit : s, of the row. Raises :class:`Refused`, ``SimulationError``, ``TimeLimitError`` (:mod:`bent_beam.errors`).
    """
    run = partial(_run, store, question.duration, None if limit is None else Clock(limit))
    _check(question)
    fine = _estimates(question, question.refine, run)
    others, lost = list[_Estimates](), list[str]()
    epsilon = fine.loaded[-1][0] if fine.loaded else None
    for factor in ERROR_BARS[question.error_bars]:
        try:
            others.append(_estimates(question, factor * question.refine, run, epsilon))
        except (ValueError, SimulationError) as error:
            what = f"no companion run at {factor:g} times the resolution, so the error bar is a guess"
            lost.append(f"{what}: {error}")
    leading, estimate = fine.leading(others), fine.first(others)
    warnings = [w for r in fine.runs for w in (*r.warnings, *r.reading["warnings"])] + lost
    place, push = leading.lambda0, leading.r0
    # a λ₀ within its bar (front 0) is one point's; near κ/ν = 1, where λ₀ vanishes, its bar is held against 0.1
    wide = (leading.front and place.spread > WIDE * max(place.known, 0.1)) or push.spread > WIDE * push.known
    if wide and question.wall is None:  # before a wall that gives way they are no constants
        warnings.append(f"wide error bar: λ₀ = {leading.lambda0}, r₀ = {leading.r0}")
    if estimate is not None and estimate.r1.spread > WIDE_FIRST * max(abs(estimate.r1.known), 1.0):
        warnings.append(f"wide error bar: r₁ = {estimate.r1}")
    numbers = rows.with_theory(question, leading, estimate)
    if estimate is not None and question.kappa_over_nu < 1.0 and numbers["lambda1"].value is None:
        no_zone = f"the run shows no zone, λ₀ = {leading.lambda0} is not larger than its error bar"
        warnings.append(f"λ₁ is missing: {no_zone}")
    warnings += _of_rigid_wall(question)
    readings = [r.reading for r in fine.runs]
    holds = [reading["hold"] for reading in readings if reading["hold"]]
    return MatchRow(
        **rows.about(question),
        **numbers,
        peak_force=_peak_force(question, [found.runs[0] for found in (fine, *others)]),
        lift=leading.lift,
        **_largest(readings, "pull", "momentum_residual", "gap_of_push"),
        hold=_largest(holds, "until", "pull") if holds else None,
        seconds=sum(r.seconds for r in fine.runs),
        steps=sum(r.steps for r in fine.runs),
        epsilons=list(estimate.epsilons) if estimate else [],
        warnings=sorted(set(warnings)),
    )


def _of_rigid_wall(question: MatchQuestion) -> list[str]:
    """A warning where the wall gives way and the run ends before the theory, a rigid wall's, holds on it."""
    from theory import contact_parameters
    from theory.wall_prediction import on_elastic_wall

    wall = on_elastic_wall(question.bare, contact_parameters(question.kappa_over_nu))
    if wall is None or wall.rigid_from <= question.duration:
        return []
    since = f"from {wall.rigid_from:.3g} t* on" if math.isfinite(wall.rigid_from) else "at a time that is not known"
    end = f"the run ends at {question.duration:g} t*"
    return [f"λ₀ and r₀ are held against a rigid wall; this one comes within 2 % of it {since} ({end})"]


def _peak_force(question: MatchQuestion, runs: Sequence[Run]) -> Number:
    """The largest force on a wall that gives way, beside the theory of that wall."""
    force, *coarser = (one.reading["peak_force"] for one in runs)
    if force is None:
        return MISSING
    from theory.elastic_wall import FLATTEST, MOST_DAMPED, SHARPEST, peak_force

    theory, (_, ratio) = None, question.wall or (0.0, 0.0)
    if not question.first and FLATTEST <= question.kappa_over_nu <= SHARPEST and ratio <= MOST_DAMPED:
        theory = peak_force(question.kappa_over_nu, ratio).value
    return number_of(force, {f"resolution_{i}": other for i, other in enumerate(coarser)}, theory=theory)


def _largest(found: Sequence[dict[str, Any]], *names: str) -> dict[str, Any]:
    return {name: max((one[name] for one in found if one[name] is not None), default=None) for name in names}


def _attempt(question: MatchQuestion, store: RunStore, limit: float | None) -> MatchRow:
    """One question in a worker: a failure is an answer too, so that a sweep of hours goes on."""
    try:
        return answer(question, store, limit)
    except ANY_FAILURE as error:
        return rows.lost_row(question, rows.reason_of(error), refused=isinstance(error, Refused))


class Matched(list[MatchRow]):
    """Rows of a match."""

    def to_dict(self) -> dict[str, Any]:
        """The contract of ``bentbeam match --json``."""
        return rows.match_document(self)

    def __str__(self) -> str:
        return rows.match_table(self)

    def plot(self) -> Any:
        """λ₀ and r₀ over κ/ν on the theory's curves, as a Matplotlib figure."""
        from comparison.figures.matching import leading_figure

        return leading_figure(self)


def match(
    asked: Sequence[MatchQuestion],
    *,
    store: RunStore | None = None,
    jobs: int | None = 1,
    scheduler: str | None = None,
    limit: float | None = None,
    progress: Count | None = None,
) -> Matched:
    """A row for each question, in order, with ``jobs`` processes (``None``: as many as pay) or on a dask ``scheduler``.

    limit : seconds that one row may take (``None``: no limit); one that takes longer is a failure.
    The rows are the same, bit for bit, for any number of jobs. ``progress(done, total)`` is called after each.

    >>> from comparison.matching import match
    >>> from comparison.rows import MatchQuestion
    >>> from self_similar_fe import SelfSimilarFE
    >>> row = match([MatchQuestion(SelfSimilarFE(), 0.5)])[0]
    >>> row.label, row.r0.covered
    ('Self-similar', True)
    """
    if limit is not None:
        positive("limit", limit)

    def died(i: int, why: str) -> MatchRow:
        return rows.lost_row(asked[i], why)

    calls = [(question, store or RunStore(None), limit) for question in asked]
    return Matched(run_all(_attempt, calls, jobs=jobs, scheduler=scheduler, progress=progress, on_death=died))
