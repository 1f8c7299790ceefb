"""Any method held against the theory: leading order from one run at ε = 0, first order by ε → 0.

Nothing here knows a path. A method simulates; its history is reduced to moments of the impulse; the estimators read
λ₀, r₀, λ₁, r₁ off them; the theory is joined to the numbers afterwards.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from bent_beam.checks import finite, one_of, positive
from bent_beam.errors import SimulationError
from bent_beam.impact import Impact
from bent_beam.method import Method, chosen_for, refined, settings_of
from comparison.compared import MISSING, Compared
from comparison.estimators import (
    FirstOrderEstimate,
    LeadingEstimate,
    Moments,
    first_order,
    leading_order,
    moments,
    with_companions,
)
from comparison.reduction import hold_of, pull_of
from comparison.store import RunStore, source_of
from comparison.time_limit import affordable_refinement

__all__ = ["THESIS_KAPPAS", "First", "MatchRow", "Question", "failures", "match", "questions"]

First = tuple[float, float, float, float]
"""(α, ψ, χ, N) with ν = 1."""

THESIS_KAPPAS = (1 / 1600, 1 / 800, 1 / 400, 1 / 200, 1 / 100, 1 / 40, 1 / 20, 1 / 4, 1 / 2)
"""κ/ν of the thesis's Table 3.4."""

DURATION = 0.1  # τ of the end: any will do at ε = 0 (self-similar); the thesis ends here
INSTANTS = 250
SHARES = (0.35, 0.7, 1.0)  # of the largest ε
PERTURBATION = 0.05  # see first_order_epsilon (tests: half, twice); a method may carry its own ``perturbation``
COMPANIONS: dict[str, tuple[float, ...]] = {"drift": (), "quick": (0.5,), "thorough": (0.5, 2.0)}
WIDE = 0.02  # of a leading-order number: a wider error bar deserves a warning
WIDE_FIRST = 0.1  # of max(|r₁|, 1), likewise


class Refused(ValueError):
    """What a method refuses, when it is made or before its run; any other error is a failure."""


@dataclass(frozen=True)
class Question:
    """One row to be matched. ``first`` : (α, ψ, χ, N), or ``None`` for the leading order alone; ``refine`` : elements
    and steps so many times finer than the method's own; ``error_bars`` : "drift" (of the run alone), "quick" (a
    companion at half the resolution, a quarter of the work), "thorough" (one at twice the resolution too)."""

    method: Method
    kappa_over_nu: float
    first: First | None = None
    refine: float = 1.0
    error_bars: str = "quick"

    def __post_init__(self) -> None:
        positive("kappa_over_nu", self.kappa_over_nu)
        positive("refine", self.refine)
        one_of("error_bars", self.error_bars, COMPANIONS)
        if self.first is not None:
            for name, value in zip(("alpha", "psi", "chi", "axial"), self.first):
                finite(name, value)
            object.__setattr__(self, "first", (*self.first, 0.0)[:4] if any(self.first) else None)


@dataclass(frozen=True)
class MatchRow:
    """One row of the matching table; the command line prints it as it stands here.

    lift : the largest gap inside the zone over V₀t in the last decade of time; pull : the largest negative contact
    impulse over the largest positive one, after the start; hold : ``{"until": s, "pull": …}`` where any contact was
    held; seconds : of all runs of the row; epsilons : of the runs of first order.
    reason : why there are no numbers (``None``: there are); refused : the method had said so before the run.
    """

    label: str
    path: str
    settings: dict[str, Any]
    kappa_over_nu: float
    alpha: float
    psi: float
    chi: float
    axial: float
    refine: float
    regime: str | None = None
    lambda0: Compared = MISSING
    r0: Compared = MISSING
    lambda1: Compared = MISSING
    r1: Compared = MISSING
    lift: float | None = None
    pull: float | None = None
    hold: dict[str, float | None] | None = None
    seconds: float | None = None
    steps: int | None = None
    epsilons: list[float] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)
    reason: str | None = None
    refused: bool = False

    @property
    def first(self) -> First:
        return (self.alpha, self.psi, self.chi, self.axial)

    @property
    def of_first_order(self) -> bool:
        return any(self.first)

    @property
    def of_tension_alone(self) -> bool:
        """Whether it is about a bow free of stress under an axial force in free flight: λ₁/N = λ_N, r₁/N = r_N."""
        flight = math.isclose(self.alpha, -self.kappa_over_nu * self.axial, rel_tol=1e-9)
        return self.axial != 0.0 and flight and self.psi == self.chi == 0.0

    def compared(self) -> dict[str, Compared]:
        """The numbers that this row is about."""
        names = ("lambda1", "r1") if self.of_first_order else ("lambda0", "r0")
        return {name: getattr(self, name) for name in names}


def questions(
    methods: Sequence[Method],
    kappas: Iterable[float],
    firsts: Sequence[Sequence[float | None]] = (),
    refines: Sequence[float] = (1.0,),
    error_bars: str = "quick",
) -> list[Question]:
    """Every method × κ/ν × (α, ψ, χ[, N]) × refinement; without ``firsts`` the leading order alone. α = ``None``: what
    the axial force makes of a bow free of stress in free flight, α = −κN."""

    def load(first: Sequence[float | None] | None, kappa: float) -> Any:
        if first is None:
            return None
        alpha, psi, chi, axial = (*first, 0.0)[:4]
        return (-kappa * (axial or 0.0) if alpha is None else alpha, psi, chi, axial)

    asked: list[Sequence[float | None] | None] = [*firsts] or [None]
    return [
        Question(m, k, load(f, k), r, error_bars) for k in kappas for m in methods for f in asked for r in refines
    ]


# --- one run, reduced ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class _Reduced:
    moments: Moments
    pull: float | None
    hold: dict[str, float | None] | None
    warnings: list[str]
    seconds: float
    steps: int


def _loaded(bare: Impact, epsilon: float, first: First) -> Impact:
    """``bare`` with (εα, εψ, εχ, n) = ε·(α, ψ, χ, N)."""
    alpha, psi, chi, axial = (epsilon * value for value in first)
    return bare.replace(acceleration=alpha, fourth_derivative=psi, curvature_rate=chi, axial_force=axial)


def _reduced(store: RunStore, method: Method, impact: Impact, *, uniform: bool = False) -> _Reduced:
    """A run reduced to moments, from the store where it is there; ``uniform``: see :func:`moments`. The run without
    loads must be reduced as the loaded ones are, or the noise that they share does not drop out."""
    question = {
        "settings": settings_of(method) | {"label": ""},
        "source": source_of(type(method)),
        "impact": asdict(impact),
        "duration": DURATION,
        "uniform": uniform,
    }

    def compute() -> dict[str, Any]:
        try:
            history = method.simulate(impact, end_time=DURATION * impact.time_scale, save=INSTANTS)
        except ValueError as error:
            raise Refused(str(error)) from None
        found = moments(history, uniform=uniform)
        return {
            "moments": {name: values.tolist() for name, values in vars(found).items()},
            "pull": pull_of(history),
            "hold": hold_of(history),
            "warnings": history.warnings,
            "seconds": history.seconds,
            "steps": history.steps,
        }

    kept = store.answer(question, compute)
    kept["moments"] = Moments(**{name: np.array(values) for name, values in kept["moments"].items()})
    return _Reduced(**kept)


def first_order_epsilon(leading: LeadingEstimate, first: First, perturbation: float) -> float:
    """The largest ε of the runs: the loads change the free motion by a small part of V₀t over the contact zone.

    ε τ (|α|/2 + |χ|z²/2 + |ψ|z⁴/24 + |N|/2) = ``perturbation`` at the end, z being the zone measured at ε = 0 and half
    the front's thickness. Where nothing presses, ε is reduced for a front near the centre, which would move too far.
    """
    front = leading.lambda0.value
    z = front + 1.0 / math.sqrt(1.0 + front**2)
    alpha, psi, chi, axial = (abs(v) for v in first)
    part = perturbation
    if first[0] + first[1] <= 0.0 and front > 0.0:
        part *= front / (front + 0.2)
    return part / (DURATION * (alpha / 2 + chi * z**2 / 2 + psi * z**4 / 24 + axial / 2))


@dataclass(frozen=True)
class _Estimates:
    """What the runs at one resolution gave: ``run`` alone without loads, ``runs`` all of them."""

    run: _Reduced
    runs: list[_Reduced]
    leading: LeadingEstimate
    first: FirstOrderEstimate | None


def _estimates(question: Question, factor: float, store: RunStore, epsilon: float | None) -> _Estimates:
    """Run and estimate at ``factor`` times the method's own resolution; ``epsilon`` is the largest ε, ``None``: chosen.

    Raises :class:`Refused` for what the method refuses.
    """
    asked, first = question.method, question.first
    method = refined(asked, factor)
    if method is None:
        raise Refused(f"refine: {asked.path} does not know how to be refined (got {factor:g})")
    bare = Impact.dimensionless(question.kappa_over_nu)
    _raise_if_refused(method, bare)
    run = _reduced(store, method, bare)
    runs = [run]
    leading = leading_order(run.moments)
    estimate = None
    if first is not None:
        top = epsilon
        if top is None:
            top = first_order_epsilon(leading, first, getattr(asked, "perturbation", PERTURBATION))
        largest = _loaded(bare, top, first)
        _raise_if_refused(method, largest)
        fixed = chosen_for(method, largest, DURATION * bare.time_scale)
        # only a load that presses the zone leaves a uniform reaction to take out, of the bare run too
        pressed = largest.zone_pressure > 0.0
        shares = (0.0, *SHARES)
        found = [(s * top, _reduced(store, fixed, _loaded(bare, s * top, first), uniform=pressed)) for s in shares]
        runs += [run for _, run in found]
        estimate = first_order([(e, run.moments) for e, run in found[1:]], found[0][1].moments, leading)
    return _Estimates(run, runs, leading, estimate)


def _raise_if_refused(method: Method, impact: Impact) -> None:
    """Ask the method before its run. Raises :class:`Refused` with its reason."""
    reason = method.refuses(impact)
    if reason:
        raise Refused(reason)


def coarsened(question: Question, store: RunStore, limit: float) -> tuple[Question, list[str]]:
    """The question at a resolution whose row ends within ``limit``, s, and a warning where that is not the one asked
    for."""
    bare = Impact.dimensionless(question.kappa_over_nu)

    def seconds_at(factor: float) -> float:
        method = refined(question.method, factor * question.refine)
        if method is None:
            return 0.0
        began = time.perf_counter()
        _reduced(store, method, bare)
        return time.perf_counter() - began

    runs = 1.0 + sum(factor**2 for factor in COMPANIONS[question.error_bars])
    factor, expected = affordable_refinement(seconds_at, limit, runs * (1 + len(SHARES) if question.first else 1))
    if factor == 1.0:
        return question, []
    return replace(question, refine=factor * question.refine), [
        f"coarser than asked for: the row would take about {expected:.0f} s, more than the limit of {limit:g} s; "
        f"this is the answer at {factor:g} times the resolution, with its own error bar"
    ]


def answer(question: Question, store: RunStore, limit: float | None = None) -> MatchRow:
    """Simulate and estimate one row; companion runs at other resolutions say what the error bar is.

    limit : s; a row that would take longer is made coarser, and says so.

    Raises :class:`Refused` for what the method refuses, :class:`bent_beam.SimulationError` when a run cannot finish.
    """
    question, coarser = (question, []) if limit is None else coarsened(question, store, limit)
    fine = _estimates(question, question.refine, store, None)
    others: list[_Estimates] = []
    lost: list[str] = []
    epsilon = None if fine.first is None else fine.first.epsilons[-1]
    for factor in COMPANIONS[question.error_bars]:
        try:
            others.append(_estimates(question, factor * question.refine, store, epsilon))
        except (ValueError, SimulationError) as error:
            lost.append(without_companion(factor, error))
    leading = leading_order(fine.run.moments, companions=[o.run.moments for o in others])
    estimate = fine.first and with_companions(fine.first, [o.first for o in others if o.first])
    warnings = [w for r in fine.runs for w in r.warnings] + lost + coarser
    if leading.lambda0.error > WIDE * max(leading.lambda0.value, 0.1) or leading.r0.error > WIDE * leading.r0.value:
        warnings.append(f"wide error bar: λ₀ = {leading.lambda0}, r₀ = {leading.r0}")
    if estimate is not None and estimate.r1.error > WIDE_FIRST * max(abs(estimate.r1.value), 1.0):
        warnings.append(f"wide error bar: r₁ = {estimate.r1}")
    holds = [r.hold for r in fine.runs if r.hold]
    return MatchRow(
        **_about(question),
        **_with_theory(question, leading, estimate),
        lift=leading.lift,
        pull=_largest(r.pull for r in fine.runs),
        hold={name: _largest(h[name] for h in holds) for name in ("until", "pull")} if holds else None,
        seconds=sum(r.seconds for r in fine.runs),
        steps=sum(r.steps for r in fine.runs),
        epsilons=list(estimate.epsilons) if estimate else [],
        warnings=sorted(set(warnings)),
    )


def _largest(values: Iterable[float | None]) -> float | None:
    return max((value for value in values if value is not None), default=None)


def without_companion(factor: float, error: Exception) -> str:
    """What to say where a companion run could not finish."""
    return f"no companion run at {factor:g} times the resolution, so the error bar is a guess: {error}"


def _with_theory(question: Question, leading: LeadingEstimate | None, estimate: Any) -> dict[str, Any]:
    """The numbers of a row with the theory's beside them."""
    from theory import contact_parameters

    alpha, psi, chi, axial = question.first or (0.0,) * 4
    exact = contact_parameters(question.kappa_over_nu, alpha, psi, chi, axial=axial)
    row: dict[str, Any] = {"regime": str(exact.regime)}
    for name, source in (("lambda0", leading), ("r0", leading), ("lambda1", estimate), ("r1", estimate)):
        number = None if source is None else getattr(source, name)
        theory = getattr(exact, name) if name in ("lambda0", "r0") or question.first else None
        row[name] = Compared(number and number.value, number and number.error, theory)
    return row


def _about(question: Question) -> dict[str, Any]:
    alpha, psi, chi, axial = question.first or (0.0,) * 4
    return {
        "label": question.method.label,
        "path": question.method.path,
        "settings": settings_of(question.method),
        "kappa_over_nu": question.kappa_over_nu,
        "alpha": alpha,
        "psi": psi,
        "chi": chi,
        "axial": axial,
        "refine": question.refine,
    }


def _attempt(question: Question, store: RunStore, limit: float | None) -> MatchRow:
    """One question in a worker: a failure is an answer too, so that the sweep goes on."""
    try:
        return answer(question, store, limit)
    except SimulationError as error:
        return _lost(question, str(error))
    except Refused as error:
        return _lost(question, str(error), refused=True)
    except Exception as error:  # a sweep of hours must not end because one of its runs did
        return _lost(question, f"{type(error).__name__}: {error}")


def _lost(question: Question, reason: str, *, refused: bool = False) -> MatchRow:
    """The row of a question without an answer."""
    row = _about(question) | _with_theory(question, None, None)
    return MatchRow(**row, reason=" ".join(reason.split()), refused=refused)


def failures(rows: Iterable[MatchRow]) -> list[MatchRow]:
    """The rows that failed though nothing had said that they must."""
    return [row for row in rows if row.reason is not None and not row.refused]


def match(
    asked: Sequence[Question],
    *,
    store: RunStore | None = None,
    jobs: int = 1,
    scheduler: str | None = None,
    limit: float | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> list[MatchRow]:
    """A row for each question, in their order, with ``jobs`` processes or on a dask ``scheduler``.

    limit : seconds that one row may take (``None``: no limit); a row that would take longer is made coarser and says
        so, one that takes longer nevertheless is a failure.
    The rows are the same, bit for bit, for any number of jobs. ``progress(done, total)`` is called after each.
    """
    from comparison.workers import run_all

    store = store or RunStore(None)
    return list(
        run_all(
            _attempt,
            [(question, store, limit) for question in asked],
            jobs=jobs,
            scheduler=scheduler,
            limit=limit,
            progress=progress,
            on_death=lambda i, why: _lost(asked[i], why),
        )
    )
