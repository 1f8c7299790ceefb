"""One run of any :class:`hermite_fe.system.System`: it is stepped, and sampled at the saved instants."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import affordable
from hermite_fe.active_set import CYCLING, NOT_FINITE, SINGULAR, SOLVED
from hermite_fe.banded import product, stiff_product
from hermite_fe.compiled import recompiling
from hermite_fe.constraints import PRODUCT, SMALLEST_REACTION, ContactLaw
from hermite_fe.elastic_wall import FORCE, FORCE_TIME, PENETRATION, PRESSURE, stored_energy
from hermite_fe.integrators import Integrator
from hermite_fe.maxwell import branch_energy
from hermite_fe.saved_steps import saved_steps
from hermite_fe.stepping import (
    ABSORBED,
    ALGORITHMIC,
    IMPACT,
    MATERIAL,
    VISCOUS,
    WALL,
    WORK,
    problem_of,
    state_of,
)
from hermite_fe.system import System

__all__ = ["Stepper", "Trajectory", "integrate"]

Array = NDArray[np.float64]

MOST_WORK = 1e11  # steps x nodes: about an hour
UNSTABLE = 1e12  # times the energy that a beam has been given; steps that do not resolve a stiff spring pass 1e6
FAILURES = {
    SINGULAR: "the step matrix is not positive definite",
    CYCLING: "the active set of the contact does not settle",
    NOT_FINITE: "the solution is not finite",
}


@dataclass(frozen=True)
class Trajectory:
    """Samples of a run, first axis ``time`` (saved,), s.

    q, v : (saved, dofs). impulse, held_impulse, gap : (saved, rows); closed : (saved, rows) bool.
    kinetic, strain, springs, work, viscous, material, absorbed, impact, algorithmic, wall : (saved,), J, ``branches``
        the part of ``strain`` in Maxwell branches, ``springs`` stored in those of the wall, from ``work`` on since the
        start, each by its own formula: kinetic + strain + springs − work + the six losses is constant, and its change
        is the energy residual (:meth:`defect`).
    peak_force, peak_force_time, peak_penetration, peak_pressure : (saved,), the largest of all steps so far
        (:data:`hermite_fe.elastic_wall.FORCE`); zero before a rigid wall.
    smallest_reaction, product : (saved,), smallest impulse of constraints that are not held, and largest |p·slack|
        since the last sample: complementarity, at round-off in a correct run.
    largest_moment, largest_moment_node, largest_midspan_moment : (saved,), of all steps since the last sample.
    steps : taken; seconds : spent on them, without compilation.
    mean_iterations, most_iterations : rounds of the active set in one solution.
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
    branches: Array
    springs: Array
    work: Array
    viscous: Array
    material: Array
    absorbed: Array
    impact: Array
    algorithmic: Array
    wall: Array
    peak_force: Array
    peak_force_time: Array
    peak_penetration: Array
    peak_pressure: Array
    smallest_reaction: Array
    product: Array
    largest_moment: Array
    largest_moment_node: Array
    largest_midspan_moment: Array
    steps: int
    seconds: float
    mean_iterations: float
    most_iterations: int
    failure: str = ""
    failure_time: float = 0.0

    def defect(self) -> Array:
        """The energy residual: what the budget does not explain, (saved,), J."""
        losses = self.viscous + self.material + self.absorbed + self.impact + self.algorithmic + self.wall
        total = self.kinetic + self.strain + self.springs - self.work + losses
        return np.asarray(total - total[0])


class Stepper:
    """A run in progress: ``advance_to`` takes steps, ``state`` is what they lead to.

    Arguments as for :func:`integrate`; law : inelastic and unilateral unless given. instants : all instants, (steps +
    1,), s; step : the one reached.
    """

    def __init__(
        self, system: System, q: Array, v: Array, integrator: Integrator, end_time: float, law: ContactLaw | None = None
    ) -> None:
        if integrator.elastic != (system.springs.stiffness > 0.0):
            raise ValueError(
                "integrator.kind: midpoint is for a wall with a stiffness, the others for a rigid one; leave it out "
                f"(got {type(integrator).__name__})"
            )
        if system.bending.shares.size and not integrator.hysteretic:
            raise ValueError(
                "integrator.kind: hysteretic_loss needs moreau_jean or signorini_position, before a wall with a "
                f"stiffness midpoint; leave it out (got {type(integrator).__name__})"
            )
        self.integrator = integrator
        self.instants = integrator.instants(end_time)
        self.problem = problem_of(system, law or ContactLaw())
        self.state = state_of(system, q, v)
        self.memory = integrator.start(self.problem, self.state)
        self.step = 0

    def compile(self) -> None:
        """Compile or load all functions by taking no step, so that the seconds of a run are those of its steps."""

        def no_step() -> None:
            self.integrator.advance(self.problem, self.state, self.memory, self.instants, self.step, self.step)
            self.energy()

        recompiling(no_step)

    def advance_to(self, step: int) -> int:
        """Take steps up to number ``step``; SOLVED (0) when all went well, else a key of ``FAILURES``."""
        if step <= self.step:
            return SOLVED
        status, self.step = self.integrator.advance(
            self.problem, self.state, self.memory, self.instants, self.step, step
        )
        finite = bool(np.isfinite(self.state.q).all() and np.isfinite(self.state.v).all())
        return NOT_FINITE if status == SOLVED and not finite else status

    def iterations(self) -> tuple[float, int]:
        """Rounds of the active set per contact problem so far: mean and most."""
        solutions, rounds, most = self.problem.solver.rounds
        return float(rounds) / max(int(solutions), 1), int(most)

    def energy(self) -> float:
        """Kinetic and strain energy now, J."""
        return self._kinetic() + self._strain()

    def _kinetic(self) -> float:
        return 0.5 * float(self.state.v @ product(self.problem.matrices.M, self.state.v))

    def _strain(self) -> float:
        return 0.5 * float(self.state.q @ stiff_product(self.problem.matrices.K, self.state.q)) + self._branches()

    def _branches(self) -> float:
        """In the springs of Maxwell branches, a part of the strain energy."""
        return branch_energy(self.state.bending, self.state.branches) if self.state.branches.size else 0.0

    def _stored(self) -> float:
        """In the springs of the wall; a rigid one has no need to compile this."""
        springs = self.problem.matrices.springs
        return stored_energy(springs, self.state.q) if springs.stiffness > 0.0 else 0.0

    def sums(self) -> dict[str, float]:
        """Energies now, J, what they lost since the start, and since the last call the worst complementarity and the
        largest bending moments."""
        energy, worst, largest = self.state.energy, self.state.worst.copy(), self.state.largest.copy()
        peaks = self.state.peaks
        self.state.worst[:] = self.state.largest[:] = 0.0
        return {
            "kinetic": self._kinetic(),
            "strain": self._strain(),
            "branches": self._branches(),
            "springs": self._stored(),
            "work": energy[WORK],
            "viscous": energy[VISCOUS],
            "material": energy[MATERIAL],
            "absorbed": energy[ABSORBED],
            "impact": energy[IMPACT],
            "algorithmic": energy[ALGORITHMIC],
            "wall": energy[WALL],
            "peak_force": peaks[FORCE],
            "peak_force_time": peaks[FORCE_TIME],
            "peak_penetration": peaks[PENETRATION],
            "peak_pressure": peaks[PRESSURE],
            "smallest_reaction": worst[SMALLEST_REACTION],
            "product": worst[PRODUCT],
            **dict(zip(("largest_moment", "largest_moment_node", "largest_midspan_moment"), largest)),
        }


class Samples:
    """Up to ``count`` saved instants of a run."""

    def __init__(self, system: System, count: int) -> None:
        n, m = system.dofs, len(system.contacts)
        self.contacts, self.size = system.contacts, 0
        self.arrays: dict[str, NDArray[Any]] = {name: np.zeros((count, n)) for name in ("q", "v")}
        self.arrays |= {name: np.zeros((count, m)) for name in ("gap", "impulse", "held_impulse")}
        self.arrays |= {"time": np.zeros(count), "closed": np.zeros((count, m), bool)}
        self.sums: list[dict[str, float]] = []

    def add(self, run: Stepper) -> None:
        """Keep the instant that ``run`` has reached."""
        s, state = self.size, run.state
        self.arrays["time"][s] = run.instants[run.step]
        self.arrays["q"][s], self.arrays["v"][s] = state.q, state.v
        self.arrays["gap"][s] = self.contacts.gaps(state.q)
        self.arrays["impulse"][s], self.arrays["held_impulse"][s] = state.impulse, state.held_impulse
        self.arrays["closed"][s] = state.closed
        self.sums.append(run.sums())
        self.size += 1

    def energy_gain(self) -> float:
        """Energy now over that of the start and the most that the loads have worked."""
        first, last = self.sums[0], self.sums[-1]
        given = first["kinetic"] + first["strain"] + max(abs(sums["work"]) for sums in self.sums)
        return (last["kinetic"] + last["strain"]) / given if given > 0.0 else 0.0

    def trajectory(self, run: Stepper, seconds: float, failure: str, failure_time: float) -> Trajectory:
        """The instants kept so far, at least one."""
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
) -> Trajectory:
    """Step ``system`` from (q, v) at t = 0 to ``end_time``, s, or to the last of given times.

    q, v : (dofs,), in the system's units. restitution, hold, hold_until : see :class:`hermite_fe.contacts.Contact`;
        hold_ends : s, nothing is held from then on.
    save : number of saved instants, or times. progress : called with the finished fraction.
    until : called at every saved instant; the run ends with the first at which it returns True.

    A run that cannot finish returns the samples so far, with ``failure`` set. Raises ``ValueError`` for bad input.
    """
    law = ContactLaw(float(restitution), int(hold), float(hold_until), float(hold_ends))
    run = Stepper(system, q, v, integrator, end_time, law)
    kept = saved_steps(run.instants, save)
    affordable("integrator and mesh", run.instants.size - 1, max(1, system.dofs // 2), kept.size, MOST_WORK)
    samples = Samples(system, kept.size)
    failure, failure_time = "", 0.0
    run.compile()
    started = clock.perf_counter()
    for step in kept:
        status = run.advance_to(int(step))
        if status != SOLVED:
            failure, failure_time = FAILURES[status], float(run.instants[run.step])
            break
        samples.add(run)
        if samples.energy_gain() > UNSTABLE:
            failure = "the scheme is unstable: its energy grows without bound"
            failure_time = float(run.instants[run.step])
            break
        if progress is not None:
            progress(float(step) / max(float(kept[-1]), 1.0))
        if until is not None and until(run):
            break
    return samples.trajectory(run, clock.perf_counter() - started, failure, failure_time)
