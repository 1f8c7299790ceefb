"""Both numerical paths held against the theory: leading order at one ε = 0 run, first order by ε → 0.

A question is (path, κ/ν, α, ψ, χ) and nothing else: meshes, steps, ε and fitting windows are chosen from the problem.
The Hermite path runs on its expanding mesh (an infinite beam), the Exudyn path on a fixed one, long enough for its
time.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any

import numpy as np

from bent_beam.checks import finite, one_of, positive
from bent_beam.history import ImpactHistory, SimulationError
from bent_beam.impact import Impact
from comparison.estimators import LeadingEstimate, Moments, first_order, leading_order, moments
from comparison.store import RunStore

__all__ = ["PATHS", "THESIS_KAPPAS", "MatchFailure", "MatchRow", "Question", "match", "questions"]

PATHS = ("hermite", "exudyn")
THESIS_KAPPAS = (1 / 1600, 1 / 800, 1 / 400, 1 / 200, 1 / 100, 1 / 40, 1 / 20, 1 / 4, 1 / 2)
"""κ/ν of the thesis's Table 3.4."""


@dataclass(frozen=True)
class Question:
    """One row to be matched; ``first`` is (α, ψ, χ) with ν = 1, or ``None`` for the leading order alone."""

    path: str
    kappa_over_nu: float
    first: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        one_of("path", self.path, PATHS)
        positive("kappa_over_nu", self.kappa_over_nu)
        if self.first is not None:
            for name, value in zip(("alpha", "psi", "chi"), self.first):
                finite(name, value)
            if not any(self.first):
                object.__setattr__(self, "first", None)


@dataclass(frozen=True)
class MatchRow:
    """One row of the matching table. ``…_error`` is the numerical estimate's error bar, ``None`` where it does not
    apply.
    """

    path: str
    kappa_over_nu: float
    alpha: float
    psi: float
    chi: float
    regime: str
    lambda0: float
    lambda0_error: float
    lambda0_theory: float
    r0: float
    r0_error: float
    r0_theory: float
    lambda1: float | None
    lambda1_error: float | None
    lambda1_theory: float | None
    r1: float | None
    r1_error: float | None
    r1_theory: float | None
    flatness: float
    seconds: float
    epsilons: list[float] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class MatchFailure:
    """A question that could not be answered, why, and the command that asks it again."""

    path: str
    kappa_over_nu: float
    first: tuple[float, float, float] | None
    reason: str
    rerun: str


def questions(
    paths: Sequence[str], kappas: Iterable[float], firsts: Sequence[tuple[float, float, float]] = ()
) -> list[Question]:
    """Every path × κ/ν × (α, ψ, χ); without ``firsts`` the leading order alone."""
    return [Question(path, k, first) for k in kappas for path in paths for first in (firsts or (None,))]


# --- one run, reduced ---------------------------------------------------------------------------------------------


DURATION = 0.1  # τ of the end: any will do at ε = 0 (self-similar); the thesis ends here


def _simulate(path: str, impact: Impact, first: bool) -> ImpactHistory:
    if path == "hermite":
        from hermite_fe.expanding import ExpandingMesh, simulate_expanding

        # First order: the load must have closed the last trace of lift long before the fit begins, hence the earlier
        # start and the finer front; its steps may be longer, for nothing happens within one.
        mesh = (
            ExpandingMesh(front_resolution=0.003, interior_elements=100, step_ratio=0.04, decades=6.0)
            if first
            else ExpandingMesh()
        )
        return simulate_expanding(impact, mesh, end_time=DURATION * impact.time_scale, save=250)
    import exudyn_models

    return exudyn_models.simulate(impact, end_time=DURATION * impact.time_scale, save=250)


def _reduced(store: RunStore, path: str, impact: Impact, *, first: bool) -> tuple[Moments, list[str], float]:
    """Moments, warnings and seconds of a run, from the store when it is there."""
    loaded = bool(impact.acceleration or impact.fourth_derivative or impact.curvature_rate)

    def compute() -> dict[str, Any]:
        history = _simulate(path, impact, first)
        found = moments(history, uniform=loaded)
        return {
            "moments": {name: values.tolist() for name, values in vars(found).items()},
            "warnings": history.warnings,
            "seconds": history.seconds,
        }

    kept = store.answer({"path": path, "impact": asdict(impact), "first": first, "duration": DURATION}, compute)
    found = Moments(**{name: np.array(values) for name, values in kept["moments"].items()})
    return found, list(kept["warnings"]), float(kept["seconds"])


def first_order_epsilon(path: str, leading: LeadingEstimate, first: tuple[float, float, float]) -> float:
    """ε whose free motion changes by a small part of V₀t over the contact zone at the end of the run.

    ετ(|α|/2 + |χ|z²/2 + |ψ|z⁴/24) at z = the zone measured at ε = 0 and half the front's thickness: 3 % on the Hermite
    path, whose noise is far below that, 6 % on the Exudyn path.
    """
    front = leading.lambda0.value
    z = front + 1.0 / math.sqrt(1.0 + front**2)
    alpha, psi, chi = (abs(v) for v in first)
    return (0.03 if path == "hermite" else 0.06) / (DURATION * (alpha / 2 + chi * z**2 / 2 + psi * z**4 / 24))


def answer(question: Question, store: RunStore) -> MatchRow:
    """Simulate and estimate one row. Raises :class:`bent_beam.SimulationError` when a run cannot finish."""
    from theory import contact_parameters

    path, kappa, first = question.path, question.kappa_over_nu, question.first
    base_impact = Impact.dimensionless(kappa)
    base, warnings, seconds = _reduced(store, path, base_impact, first=first is not None)
    leading = leading_order(base)
    estimate = None
    if first is not None:
        alpha, psi, chi = first
        top = first_order_epsilon(path, leading, first)
        runs = []
        for epsilon in (0.5 * top, top):
            impact = base_impact.replace(
                acceleration=epsilon * alpha, fourth_derivative=epsilon * psi, curvature_rate=epsilon * chi
            )
            run, more, spent = _reduced(store, path, impact, first=True)
            runs.append((epsilon, run))
            warnings, seconds = warnings + more, seconds + spent
        estimate = first_order(runs, base, leading)
    alpha, psi, chi = first or (0.0, 0.0, 0.0)
    exact = contact_parameters(kappa, alpha, psi, chi)
    if leading.lambda0.error > 0.02 * max(leading.lambda0.value, 0.1) or leading.r0.error > 0.02 * leading.r0.value:
        warnings.append(f"wide error bar: lambda0 = {leading.lambda0}, r0 = {leading.r0}")
    if estimate is not None and estimate.r1.error > 0.1 * max(abs(estimate.r1.value), 1.0):
        warnings.append(f"wide error bar: r1 = {estimate.r1}")
    return MatchRow(
        path=path,
        kappa_over_nu=kappa,
        alpha=alpha,
        psi=psi,
        chi=chi,
        regime=str(exact.regime),
        lambda0=leading.lambda0.value,
        lambda0_error=leading.lambda0.error,
        lambda0_theory=float(exact.lambda0),
        r0=leading.r0.value,
        r0_error=leading.r0.error,
        r0_theory=float(exact.r0),
        lambda1=estimate.lambda1.value if estimate else None,
        lambda1_error=estimate.lambda1.error if estimate else None,
        lambda1_theory=float(exact.lambda1) if first else None,
        r1=estimate.r1.value if estimate else None,
        r1_error=estimate.r1.error if estimate else None,
        r1_theory=float(exact.r1) if first else None,
        flatness=leading.flatness,
        seconds=seconds,
        epsilons=list(estimate.epsilons) if estimate else [],
        warnings=sorted(set(warnings)),
    )


def _attempt(question: Question, folder: str | None) -> MatchRow | MatchFailure:
    """One question in a worker: a failure is an answer too, so that the rest of a sweep goes on."""
    from pathlib import Path

    try:
        return answer(question, RunStore(Path(folder) if folder else None))
    except (SimulationError, ValueError, ArithmeticError) as error:
        return failure(question, " ".join(str(error).split()))


def failure(question: Question, reason: str) -> MatchFailure:
    first = "" if question.first is None else f" --first-order {','.join(f'{v:g}' for v in question.first)}"
    return MatchFailure(
        question.path,
        question.kappa_over_nu,
        question.first,
        reason,
        f"bentbeam match --path {question.path} --kappa-over-nu {question.kappa_over_nu!r}{first}",
    )


def match(
    asked: Sequence[Question],
    *,
    store: RunStore | None = None,
    jobs: int = 1,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[list[MatchRow], list[MatchFailure]]:
    """Answer all questions, in their order, with ``jobs`` processes or on a dask ``scheduler``.

    The rows are the same, bit for bit, for any number of jobs. ``progress(done, total)`` is called after each.
    """
    from comparison.workers import run_all

    store = store or RunStore(None)
    folder = None if store.folder is None else str(store.folder)
    outcomes = run_all(
        _attempt,
        [(question, folder) for question in asked],
        jobs=jobs,
        scheduler=scheduler,
        progress=progress,
        on_death=lambda i, why: failure(asked[i], why),
    )
    rows = [o for o in outcomes if isinstance(o, MatchRow)]
    failures = [o for o in outcomes if isinstance(o, MatchFailure)]
    return rows, failures
