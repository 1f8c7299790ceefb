"""One run of any :class:`hermite_fe.system.System`: steps between the saved instants, samples at them.

Only samples are kept, so memory is (saved instants) × (dofs), whatever the number of steps; and where that is much,
they are given away block by block while the run goes on.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import MOST_INSTANTS, affordable
from hermite_fe.beam import banded_product
from hermite_fe.integrators import Integrator
from hermite_fe.kernels import subnormals
from hermite_fe.kernels.banded import stiff_multiply
from hermite_fe.kernels.problem import (
    ABSORBED,
    ALGORITHMIC,
    IMPACT,
    MATERIAL,
    PRODUCT,
    SMALLEST_REACTION,
    VISCOUS,
    WORK,
    ContactLaw,
    problem_of,
    state_of,
    works_of,
)
from hermite_fe.kernels.rows import CYCLING, NOT_FINITE, SINGULAR, SOLVED
from hermite_fe.system import System

__all__ = ["Stepper", "Trajectory", "integrate", "saved_steps"]

BLOCK = 10_000_000  # nodes x saved instants that are kept in memory: a gigabyte with all that is made of them

Array = NDArray[np.float64]

MOST_WORK = 1e11  # steps x nodes: about an hour
FAILURES = {
    SINGULAR: "the step matrix is not positive definite",
    CYCLING: "the active set of the contact does not settle",
    NOT_FINITE: "the solution is not finite",
}


@dataclass(frozen=True)
class Trajectory:
    """Samples of a run, first axis ``time`` (saved,), s.

    q, v : (saved, dofs). impulse, held_impulse, gap : (saved, rows); closed : (saved, rows) bool.
    kinetic, strain, work, viscous, material, absorbed, impact, algorithmic : (saved,), J, from ``work`` on since the
        start, each computed from its cause: kinetic + strain − work + the five losses stays what it was at the start
        but for what went wrong (:meth:`defect`).
    smallest_reaction, product : (saved,), worst reaction impulse of rows that are not held, and worst |p·(…)|
        since the last sample: complementarity, at round-off when all is well.
    steps : taken; seconds : spent on them, kernels being compiled already.
    mean_iterations, most_iterations : of the active set in one solve.
    failure : why the run did not finish ("": it did); failure_time : s, how far it got.
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
    material: Array
    absorbed: Array
    impact: Array
    algorithmic: Array
    smallest_reaction: Array
    product: Array
    steps: int
    seconds: float
    mean_iterations: float
    most_iterations: int
    failure: str = ""
    failure_time: float = 0.0

    def defect(self) -> Array:
        """Energy that the budget does not explain, (saved,), J."""
        losses = self.viscous + self.material + self.absorbed + self.impact + self.algorithmic
        total = self.kinetic + self.strain - self.work + losses
        return np.asarray(total - total[0])


def saved_steps(instants: Array, save: int | Sequence[float] | Array) -> NDArray[np.int64]:
    """Indices of the instants to keep: an equal number of √t's, or those nearest to given times; the first
    always.

    Raises ``ValueError`` for fewer than two, or times that are not increasing, negative or past the end.
    """
    end = instants[-1]
    if np.ndim(save) == 0:
        count = int(np.asarray(save))
        if count != save or not 2 <= count <= MOST_INSTANTS:
            raise ValueError(f"save must be a whole number from 2 to {MOST_INSTANTS}, or times (got {save!r})")
        wanted = end * np.linspace(0.0, 1.0, count) ** 2
    else:
        wanted = np.asarray(save, float)
        if wanted.ndim != 1 or wanted.size < 1 or not np.all(np.isfinite(wanted)):
            raise ValueError("save must be a whole number of at least 2, or a list of finite times")
        if np.any(np.diff(wanted) <= 0.0) or wanted[0] < 0.0 or wanted[-1] > end * (1.0 + 1e-9):
            raise ValueError(f"save must hold increasing times from 0 to the end time {end!r}")
    middles = 0.5 * (instants[1:] + instants[:-1])
    return np.unique(np.concatenate([[0], np.searchsorted(middles, wanted)]))


class Samples:
    """Up to ``count`` saved instants of a run."""

    def __init__(self, system: System, count: int) -> None:
        n, m = system.dofs, len(system.contacts)
        self.contacts, self.count, self.size = system.contacts, count, 0
        self.arrays: dict[str, NDArray[Any]] = {name: np.zeros((count, n)) for name in ("q", "v")}
        self.arrays |= {name: np.zeros((count, m)) for name in ("gap", "impulse", "held_impulse")}
        self.arrays |= {"time": np.zeros(count), "closed": np.zeros((count, m), bool)}
        self.sums: list[dict[str, float]] = []

    def add(self, run: Stepper) -> None:
        """The instant that ``run`` has reached."""
        s, state = self.size, run.state
        self.arrays["time"][s] = run.instants[run.step]
        self.arrays["q"][s], self.arrays["v"][s] = state.q, state.v
        self.arrays["gap"][s] = self.contacts.gaps(state.q)
        self.arrays["impulse"][s], self.arrays["held_impulse"][s] = state.impulse, state.held_impulse
        self.arrays["closed"][s] = state.closed
        self.sums.append(run.sums())
        self.size += 1

    def trajectory(self, run: Stepper, seconds: float, failure: str = "", failure_time: float = 0.0) -> Trajectory:
        """What there is, at least one instant."""
        mean, most = run.iterations()
        records: dict[str, Any] = {name: samples[: self.size] for name, samples in self.arrays.items()}
        records |= {name: np.array([row[name] for row in self.sums]) for name in self.sums[0]}
        return Trajectory(
            steps=run.step,
            seconds=seconds,
            mean_iterations=mean,
            most_iterations=most,
            failure=failure,
            failure_time=failure_time,
            **records,
        )

    def keep_last(self) -> None:
        """Forget all instants but the last."""
        for samples in self.arrays.values():
            samples[0] = samples[self.size - 1]
        del self.sums[:-1]
        self.size = 1


class Stepper:
    """A run in progress: ``advance_to`` takes steps, ``state`` is what they lead to.

    Arguments as for :func:`integrate`. instants : all instants, (steps + 1,), s; step : the one reached.
    """

    def __init__(
        self,
        system: System,
        q: Array,
        v: Array,
        integrator: Integrator,
        end_time: float,
        *,
        restitution: float = 0.0,
        hold: int = 0,
        hold_until: float = 0.0,
        hold_ends: float = math.inf,
    ) -> None:
        self.integrator = integrator
        self.instants = integrator.instants(end_time)
        self.problem = problem_of(system)
        self.works = works_of(system, self.problem, integrator.solves)
        self.state = state_of(system, q, v)
        self.law = ContactLaw(float(restitution), int(hold), float(hold_until))
        self.step = 0
        self.released = int(np.searchsorted(self.instants, hold_ends))  # the step from which on nothing is held

    def compile(self) -> None:
        """Have all kernels compiled, or loaded, by taking no step: the seconds of a run are those of its steps."""
        state, works = deepcopy((self.state, self.works))  # a scheme may prepare its first step in them
        self.integrator.advance(self.problem, self.law, state, works, self.instants, 0, 0)
        self.energy()

    def advance_to(self, step: int) -> int:
        """Take steps up to number ``step``; SOLVED (0) when all went well, else a key of ``FAILURES``."""
        if self.step < self.released < step:
            status = self.advance_to(self.released)
            if status != SOLVED:
                return status
        if step <= self.step:
            return SOLVED
        if self.step >= self.released:
            self.law = ContactLaw(self.law.restitution, 0, 0.0)
        before = subnormals.flush()
        try:
            status, self.step = self.integrator.advance(
                self.problem, self.law, self.state, self.works, self.instants, self.step, step
            )
        finally:
            subnormals.restore(before)
        finite = bool(np.isfinite(self.state.q).all() and np.isfinite(self.state.v).all())
        return NOT_FINITE if status == SOLVED and not finite else status

    def iterations(self) -> tuple[float, int]:
        """Active-set iterations a contact solve so far: mean and most, of the solve of a step that took most."""
        solves, rounds, most = max((w.rounds for w in self.works), key=lambda r: r[1] / max(r[0], 1))
        return float(rounds) / max(int(solves), 1), int(most)

    def energy(self) -> float:
        """Kinetic and strain energy now, J."""
        return self._kinetic() + self._strain()

    def _kinetic(self) -> float:
        return 0.5 * float(np.sum(self.state.v * banded_product(self.problem.M, self.state.v)))

    def _strain(self) -> float:
        forces = np.zeros(self.state.q.size)
        stiff_multiply(self.problem.K, self.problem.even, self.problem.odd, self.state.q, forces)
        return 0.5 * float(forces @ self.state.q)

    def sums(self) -> dict[str, float]:
        """Energies now, J, what they lost since the start, and the worst complementarity since the last
        call."""
        state = self.state
        half = state.budget.size // 2
        total = state.budget[:half] + state.budget[half:]
        worst = state.worst.copy()
        state.worst[:] = 0.0
        return {
            "kinetic": self._kinetic(),
            "strain": self._strain(),
            "work": total[WORK],
            "viscous": total[VISCOUS],
            "material": total[MATERIAL],
            "absorbed": total[ABSORBED],
            "impact": total[IMPACT],
            "algorithmic": total[ALGORITHMIC],
            "smallest_reaction": worst[SMALLEST_REACTION],
            "product": worst[PRODUCT],
        }


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
    hold_ends: float = math.inf,
    save: int | Sequence[float] | Array = 200,
    progress: Callable[[float], None] | None = None,
    until: Callable[[Stepper], bool] | None = None,
    record: Callable[[Trajectory, int], None] | None = None,
) -> Trajectory:
    """Step ``system`` from (q, v) at t = 0 to ``end_time``, s.

    q, v : (dofs,), in the system's units. restitution, hold, hold_until : see
        :class:`hermite_fe.contacts.Contact`; hold_ends : s, nothing is held from then on.
    save : number of saved instants, or times. progress : called with the finished fraction.
    until : asked at every saved instant; the run ends with the first at which it says so.
    record : takes the instants of a run that saves more than ``BLOCK`` nodes x instants, block by block as they come,
        and how many are to be saved in all; each block starts with the last instant of the one before, and the last
        one is returned (a shorter run calls it never and returns all).

    A run that cannot finish returns what it reached, with ``failure`` set. Raises ``ValueError`` for bad
    input.
    """
    run = Stepper(
        system,
        q,
        v,
        integrator,
        end_time,
        restitution=restitution,
        hold=hold,
        hold_until=hold_until,
        hold_ends=hold_ends,
    )
    kept = saved_steps(run.instants, save)
    nodes = max(1, system.dofs // 2)
    block = kept.size if record is None else max(2, BLOCK // nodes)
    affordable("integrator and mesh", run.instants.size - 1, nodes, min(kept.size, block), MOST_WORK)
    samples = Samples(system, min(kept.size, block))
    failure, failure_time = "", 0.0
    run.compile()
    started = clock.perf_counter()
    for step in kept:
        status = run.advance_to(int(step))
        if status != SOLVED:
            failure, failure_time = FAILURES[status], float(run.instants[run.step])
            break
        if samples.size == samples.count and record is not None:
            record(samples.trajectory(run, clock.perf_counter() - started), kept.size)
            samples.keep_last()
        samples.add(run)
        if progress is not None:
            progress(float(step) / float(kept[-1]))
        if until is not None and until(run):
            break
    # at least one instant: the start takes no step
    return samples.trajectory(run, clock.perf_counter() - started, failure, failure_time)
