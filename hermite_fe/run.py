"""One run of any :class:`hermite_fe.system.System`: steps between the saved instants, samples at them.

Only samples are kept, so memory is (saved instants) × (dofs), whatever the number of steps.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hermite_fe._banded import quadratic, stiff_multiply
from hermite_fe._problem import ALGORITHMIC, IMPACT, VISCOUS, WORK, ContactLaw, problem_of, state_of, work_of
from hermite_fe.integrators import Integrator
from hermite_fe.system import System

__all__ = ["Trajectory", "integrate", "saved_steps"]

Array = NDArray[np.float64]

FAILURES = {
    1: "the step matrix is not positive definite",
    2: "the active set of the contact does not settle",
    3: "the solution is not finite",
}


@dataclass(frozen=True)
class Trajectory:
    """Samples of a run, first axis ``time`` (saved,), s.

    q, v : (saved, dofs). impulse, held_impulse, gap : (saved, rows); closed : (saved, rows) bool.
    kinetic, strain, work, viscous, impact, algorithmic : (saved,), J, the last four since the start.
    smallest_reaction, product : (saved,), worst reaction impulse of rows that are not held, and worst |p·(…)|
        since the last sample: complementarity, at round-off when all is well.
    status : 0 when the run finished; failure says why not. steps : taken; seconds : spent.
    """

    time: Array
    q: Array
    v: Array
    gap: Array
    impulse: Array
    held_impulse: Array
    closed: NDArray[np.bool_]
    kinetic: Array
    strain: Array
    work: Array
    viscous: Array
    impact: Array
    algorithmic: Array
    smallest_reaction: Array
    product: Array
    steps: int
    seconds: float
    failure: str = ""
    failure_time: float = 0.0


def saved_steps(instants: Array, save: int | Sequence[float] | Array) -> NDArray[np.int64]:
    """Indices of the instants to keep: an equal number of √t's, or those nearest to given times; the first
    always.

    Raises ``ValueError`` for fewer than two, or times that are not increasing, negative or past the end.
    """
    end = instants[-1]
    if np.ndim(save) == 0:
        count = int(np.asarray(save))
        if count != save or count < 2:
            raise ValueError(f"save must be a whole number of at least 2, or times (got {save!r})")
        wanted = end * np.linspace(0.0, 1.0, count) ** 2
    else:
        wanted = np.asarray(save, float)
        if wanted.ndim != 1 or wanted.size < 1 or not np.all(np.isfinite(wanted)):
            raise ValueError("save must be a whole number of at least 2, or a list of finite times")
        if np.any(np.diff(wanted) <= 0.0) or wanted[0] < 0.0 or wanted[-1] > end * (1.0 + 1e-9):
            raise ValueError(f"save must hold increasing times from 0 to the end time {end!r}")
    middles = 0.5 * (instants[1:] + instants[:-1])
    return np.unique(np.concatenate([[0], np.searchsorted(middles, wanted)]))


def integrate(
    system: System,
    q: Array,
    v: Array,
    integrator: Integrator,
    end_time: float,
    *,
    restitution: float = 0.0,
    hold: int = 0,
    hold_until: float = 0.0,
    save: int | Sequence[float] | Array = 200,
    progress: Callable[[float], None] | None = None,
) -> Trajectory:
    """Step ``system`` from (q, v) at t = 0 to ``end_time``, s.

    q, v : (dofs,), in the system's units. restitution, hold, hold_until : see
        :class:`hermite_fe.contacts.Contact`.
    save : number of saved instants, or times. progress : called with the finished fraction.

    A run that cannot finish returns what it reached, with ``failure`` set. Raises ``ValueError`` for bad
    input.
    """
    instants = integrator.instants(end_time)
    kept = saved_steps(instants, save)
    problem = problem_of(system)
    works = tuple(work_of(system, problem) for _ in range(integrator.matrices))
    state = state_of(system, q, v)
    law = ContactLaw(float(restitution), int(hold), float(hold_until))
    n, m, count = system.dofs, len(system.contacts), kept.size
    samples = {name: np.zeros((count, n)) for name in ("q", "v")}
    samples |= {name: np.zeros((count, m)) for name in ("gap", "impulse", "held_impulse")}
    closed = np.zeros((count, m), bool)
    sums = {
        name: np.zeros(count)
        for name in (
            "kinetic",
            "strain",
            "work",
            "viscous",
            "impact",
            "algorithmic",
            "smallest_reaction",
            "product",
        )
    }
    failure, failure_time, taken, good = "", 0.0, 0, 0
    forces = np.zeros(n)
    started = clock.perf_counter()
    for s, step in enumerate(kept):
        if s > 0:
            status, reached = integrator.advance(
                problem, law, state, works, instants, int(kept[s - 1]), int(step)
            )
            taken = reached
            if status == 0 and not (np.all(np.isfinite(state.q)) and np.all(np.isfinite(state.v))):
                status = 3
            if status != 0:
                failure, failure_time = FAILURES[status], float(instants[reached])
                break
        samples["q"][s], samples["v"][s] = state.q, state.v
        samples["gap"][s] = system.contacts.gaps(state.q)
        samples["impulse"][s], samples["held_impulse"][s] = state.impulse, state.held_impulse
        closed[s] = state.closed
        sums["kinetic"][s] = 0.5 * quadratic(problem.M, state.v)
        stiff_multiply(problem.K, problem.even, problem.odd, state.q, forces)
        sums["strain"][s] = 0.5 * float(forces @ state.q)
        half = state.budget.size // 2
        for name, place in (
            ("work", WORK),
            ("viscous", VISCOUS),
            ("impact", IMPACT),
            ("algorithmic", ALGORITHMIC),
        ):
            sums[name][s] = state.budget[place] + state.budget[place + half]
        sums["smallest_reaction"][s], sums["product"][s] = state.worst
        state.worst[:] = 0.0
        good = s + 1
        if progress is not None:
            progress(float(step) / float(kept[-1]))
    seconds = clock.perf_counter() - started
    kept_time = instants[kept[:good]]
    return Trajectory(
        time=kept_time,
        closed=closed[:good],
        steps=int(taken),
        seconds=seconds,
        failure=failure,
        failure_time=failure_time,
        **{k: a[:good] for k, a in samples.items()},
        **{k: a[:good] for k, a in sums.items()},
    )
