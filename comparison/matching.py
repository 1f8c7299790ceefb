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


def _loaded(bare: Impact, epsilon: float, first: tuple[float, float, float]) -> Impact:
    """``bare`` with (εα, εψ, εχ) = ε·(α, ψ, χ)."""
    alpha, psi, chi = (epsilon * value for value in first)
    return bare.replace(acceleration=alpha, fourth_derivative=psi, curvature_rate=chi)


def _simulate(path: str, impact: Impact, largest: Impact | None) -> ImpactHistory:
    """A run; with ``largest``, the impact of the largest load it will be compared with, by parts fit for that one."""
    end = DURATION * impact.time_scale
    if path == "hermite":
        from self_similar_fe import SelfSimilarFE

        method = SelfSimilarFE().chosen_for(impact if largest is None else largest, end)
        return method.simulate(impact, end_time=end, save=250)
    import exudyn_models
    from exudyn_models.contacts import CONTACTS

    nodes = exudyn_models.chosen_mesh(impact if largest is None else largest, end)
    # A hold would pull on a zone that lifts off; the run at ε = 0 must do without it too.
    contact = CONTACTS["penalty"](hold=0) if largest is not None and _lifted(largest) else None
    return exudyn_models.simulate(impact, end_time=end, mesh=nodes, contact=contact, save=250)


def _pressed(impact: Impact) -> bool:
    """A uniform load pushes the zone against the wall."""
    return impact.epsilon_alpha + impact.epsilon_psi > 0.0


def _lifted(impact: Impact) -> bool:
    return impact.epsilon_alpha + impact.epsilon_psi < 0.0


def _reduced(
    store: RunStore, path: str, impact: Impact, *, largest: Impact | None = None
) -> tuple[Moments, list[str], float]:
    """Moments, warnings and seconds of a run, from the store when it is there."""
    question: dict[str, Any] = {"path": path, "impact": asdict(impact), "duration": DURATION}
    if largest is not None:  # on the Hermite path only its kind matters, so that all such runs share one base
        question["largest"] = asdict(largest) if path == "exudyn" else _pressed(largest)

    def compute() -> dict[str, Any]:
        history = _simulate(path, impact, largest)
        loaded = bool(impact.acceleration or impact.fourth_derivative or impact.curvature_rate)
        found = moments(history, uniform=loaded)
        return {
            "moments": {name: values.tolist() for name, values in vars(found).items()},
            "warnings": history.warnings,
            "seconds": history.seconds,
        }

    kept = store.answer(question, compute)
    found = Moments(**{name: np.array(values) for name, values in kept["moments"].items()})
    return found, list(kept["warnings"]), float(kept["seconds"])


def first_order_epsilon(path: str, leading: LeadingEstimate, first: tuple[float, float, float]) -> float:
    """The largest ε of the runs: the free motion changes by a small part of V₀t over the contact zone at their end.

    ετ(|α|/4 + |χ|z²/2 + |ψ|z⁴/24) at z = the zone measured at ε = 0 and half the front's thickness: 3 % on the Hermite
    path, whose noise is far below that, 6 % on the Exudyn path. (α counts half: its second order is small.) Where
    nothing presses, a front that is close to the centre is spared too long a way.
    """
    front = leading.lambda0.value
    z = front + 1.0 / math.sqrt(1.0 + front**2)
    alpha, psi, chi = (abs(v) for v in first)
    part = 0.03 if path == "hermite" else 0.06
    if first[0] + first[1] <= 0.0 and front > 0.0:
        part *= front / (front + 0.2)
    return part / (DURATION * (alpha / (4 if path == "hermite" else 2) + chi * z**2 / 2 + psi * z**4 / 24))


def answer(question: Question, store: RunStore) -> MatchRow:
    """Simulate and estimate one row. Raises :class:`bent_beam.SimulationError` when a run cannot finish."""
    from theory import contact_parameters

    path, kappa, first = question.path, question.kappa_over_nu, question.first
    bare = Impact.dimensionless(kappa)
    run, warnings, seconds = _reduced(store, path, bare)
    leading = leading_order(run)
    estimate = None
    if first is not None:
        top = first_order_epsilon(path, leading, first)
        found: list[Moments] = []
        largest = _loaded(bare, top, first)
        # Under pressure each run has its own noise of captures: more of them average it.
        shares = (0.25, 0.5, 0.75, 1.0) if path == "hermite" and _pressed(largest) else (0.5, 1.0)
        for share in (0.0, *shares):
            run, more, spent = _reduced(store, path, _loaded(bare, share * top, first), largest=largest)
            found.append(run)
            warnings, seconds = warnings + more, seconds + spent
        estimate = first_order([(share * top, run) for share, run in zip(shares, found[1:])], found[0], leading)
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
    except SimulationError as error:
        return failure(question, " ".join(str(error).split()))
    except Exception as error:  # a sweep of hours must not end because one of its runs did
        return failure(question, f"{type(error).__name__}: {' '.join(str(error).split())}")


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
