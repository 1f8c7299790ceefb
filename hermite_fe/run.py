"""One run of any :class:`hermite_fe.system.System`: it is stepped, and sampled at the saved instants."""

import logging
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from bent_beam.checks import MOST_INSTANTS, affordable, whole
from bent_beam.errors import InputError
from bent_beam.method import Progress, checked_times
from hermite_fe.active_set import CYCLING, NOT_FINITE, SINGULAR, SOLVED
from hermite_fe.banded import product, stiff_product
from hermite_fe.compiled import Array, Flags, Places, recompiling
from hermite_fe.constraints import WORST, ContactLaw
from hermite_fe.elastic_wall import PEAKS, stored_energy
from hermite_fe.integrators import Integrator
from hermite_fe.integrators.base import MOST_WORK
from hermite_fe.maxwell import branch_energy
from hermite_fe.stepping import ENERGIES, LARGEST, problem_of, state_of
from hermite_fe.system import System

SOON, LONG = 5.0, 60.0  # s: so long after its start a run that will take longer says so
UNSTABLE = 10.0  # times the energy that a beam has been given, at the end: what is not resolved may swing in between
FAILURES = {
    SINGULAR: "the step matrix is not positive definite",
    CYCLING: "the active set of the contact does not settle",
    NOT_FINITE: "the solution is not finite",
}


@dataclass(frozen=True)
class Trajectory:
    """Samples of a run, first axis ``time`` (saved,), s.

    q, v : (saved, dofs). impulse, held_impulse, gap : (saved, rows); closed : (saved, rows) bool.
    sums : (saved,) each, by the names that :meth:`Stepper.sums` gives them.
    law : of the constraints that closed. steps : taken; seconds : spent on them, without compilation.
    mean_iterations, most_iterations : rounds of the active set in one solution.
    failure : why the run did not finish ("": it did); failure_time : s, how far it got.
    """

    time: Array
    q: Array
    v: Array
    gap: Array
    impulse: Array
    held_impulse: Array
    closed: Flags
    sums: dict[str, Array]
    law: ContactLaw
    steps: int
    seconds: float
    mean_iterations: float
    most_iterations: int
    failure: str = ""
    failure_time: float = 0.0


class Stepper:
    """A run in progress: ``advance_to`` takes steps, ``state`` is what they lead to.

    Arguments as for :func:`integrate`; law : inelastic and unilateral unless given. instants : all instants, (steps +
    1,), s; step : the one reached.
    """

    def __init__(
        self, system: System, q: Array, v: Array, integrator: Integrator, end_time: float, law: ContactLaw | None = None
    ) -> None:
        if integrator.elastic != (system.springs.stiffness > 0.0):
            raise InputError(
                "hermite.integrator.kind: midpoint is for a wall with a stiffness, the others for a rigid one; leave "
                f"it out (got {type(integrator).__name__})"
            )
        if system.branches.shares.size and not integrator.hysteretic:
            raise InputError(
                "hermite.integrator.kind: hysteretic_loss needs moreau_jean or signorini_position, before a wall with "
                f"a stiffness midpoint; leave it out (got {type(integrator).__name__})"
            )
        law, kind = law or ContactLaw(), type(integrator).__name__
        if law.restitution > 0.0 and not integrator.rebounds:
            raise InputError(f"{kind} has no impact law: restitution must be 0 (got {law.restitution!r})")
        if (law.hold or law.hold_until) and not integrator.holds:
            raise InputError(f"hermite.integrator.kind: {kind} holds nothing: hold and hold_until must be 0")
        if not np.all(np.asarray(law.strength) >= 0.0):
            raise InputError(f"strength must be 0 or more, N (got {float(np.min(law.strength))!r})")
        if np.any(law.strength) and not integrator.sticks:
            raise InputError(
                "hermite.integrator.kind: contact that may pull needs moreau_jean, or signorini_position with theta = "
                f"1 (got {kind})"
            )
        if np.any(law.strength):
            for name in ("restitution", "hold", "hold_until"):
                if value := getattr(law, name):
                    what = "contact that may pull neither rebounds nor is held"
                    raise InputError(f"{what}: {name} must be 0 (got {value!r})")
        for name, value in (("q", q), ("v", v)):
            if np.shape(value) != (system.dofs,):
                raise InputError(f"{name} must have shape ({system.dofs},) (got {np.shape(value)})")
        self.integrator = integrator
        self.instants = integrator.instants(end_time)
        self.contacts = system.contacts
        self.problem = problem_of(system, law)
        self.state = state_of(system, q, v)
        self.memory = integrator.start(self.problem, self.state)
        self.step = 0

    def compile(self) -> None:
        """Compile or load all functions by taking no step, so that the seconds of a run are those of its steps."""
        recompiling(lambda: (self._advance(self.step), self.energies()))

    def _advance(self, step: int) -> tuple[int, int]:
        """What the integrator returns; it may be somebody else's."""
        found = self.integrator.advance(self.problem, self.state, self.memory, self.instants, self.step, step)
        if not (isinstance(found, tuple) and len(found) == 2):
            name = type(self.integrator).__name__
            raise InputError(f"integrator: {name}.advance must return the status and the last step (got {found!r})")
        return found

    def advance_to(self, step: int) -> int:
        """Take steps up to number ``step``; SOLVED (0) when all went well, else a key of ``FAILURES``."""
        if step <= self.step:
            return SOLVED
        status, self.step = self._advance(step)
        finite = bool(np.isfinite(self.state.q).all() and np.isfinite(self.state.v).all())
        return NOT_FINITE if status == SOLVED and not finite else status

    def energies(self) -> dict[str, float]:
        """What is stored now, J: kinetic and strain energy, of the latter the part in Maxwell branches where there are
        any, and the contact energy in the springs of a wall that gives way."""
        matrices, state = self.problem.matrices, self.state
        found = {
            "kinetic_energy": 0.5 * float(state.v @ product(matrices.M, state.v)),
            "strain_energy": 0.5 * float(state.q @ stiff_product(matrices.K, state.q, matrices.K_sums)),
        }
        if state.branches.shares.size:
            found["branch_energy"] = branch_energy(state.branches, state.bending)
            found["strain_energy"] += found["branch_energy"]
        if self.integrator.elastic:
            found["contact_energy"] = stored_energy(matrices.springs, state.q)
            found["contact_energy"] += stored_energy(matrices.second, state.q)
        return found

    def energy(self) -> float:
        """Kinetic and strain energy now, J."""
        found = self.energies()
        return found["kinetic_energy"] + found["strain_energy"]

    def sums(self) -> dict[str, float]:
        """:meth:`energies` now; since the start the work of the loads and the losses, each by its own formula
        (:data:`hermite_fe.stepping.ENERGIES`), and the largest of all steps at a wall that gives way
        (:data:`hermite_fe.elastic_wall.PEAKS`); since the last call the worst complementarity, at round-off in a
        correct run (:data:`hermite_fe.constraints.WORST`), and the largest bending moments."""
        state = self.state
        named = ((ENERGIES, state.energy), (PEAKS, state.peaks), (WORST, state.worst), (LARGEST, state.largest))
        found = self.energies() | {name: float(value) for names, values in named for name, value in zip(names, values)}
        state.worst[:] = state.largest[:] = 0.0
        return found

    def sample(self) -> dict[str, Any]:
        """The instant now, by the names of :class:`Trajectory`."""
        arrays = {name: getattr(self.state, name).copy() for name in ("q", "v", "impulse", "held_impulse", "closed")}
        gap = self.contacts.gaps(self.state.q)
        return {"time": self.instants[self.step], **arrays, "gap": gap, "sums": self.sums()}


def trajectory_of(
    run: Stepper, samples: list[dict[str, Any]], seconds: float, failure: str = "", failure_time: float = 0.0
) -> Trajectory:
    """The samples so far, at least one; they are used up."""
    sums = [sample.pop("sums") for sample in samples]
    solutions, rounds, most = (int(number) for number in run.problem.solver.rounds)
    return Trajectory(
        **{name: np.array([sample.pop(name) for sample in samples]) for name in list(samples[0])},
        sums={name: np.array([row[name] for row in sums]) for name in sums[0]},
        law=run.problem.law,
        steps=run.step,
        seconds=seconds,
        mean_iterations=rounds / max(solutions, 1),
        most_iterations=most,
        failure=failure,
        failure_time=failure_time,
    )


def saved_steps(instants: Array, save: int | Sequence[float] | Array) -> Places:
    """Indices of the instants to keep: so many, evenly spaced in √t, or those nearest to given times; the first always.

    Raises ``ValueError`` for fewer than two, or times that are not increasing, negative or past the end.
    """
    end = instants[-1]
    if np.ndim(save) == 0:
        count = whole("save", save, 2)  # type: ignore[arg-type]
        if count > MOST_INSTANTS:
            raise InputError(f"save must be {MOST_INSTANTS} at most (got {count})")
        wanted = end * np.linspace(0.0, 1.0, count) ** 2
    else:
        wanted = checked_times(save, end)
    middles = 0.5 * (instants[1:] + instants[:-1])
    return np.unique(np.concatenate([[0], np.searchsorted(middles, wanted)]))


def integrate(
    system: System,
    q: Array,
    v: Array,
    integrator: Integrator,
    end_time: float,
    *,
    law: ContactLaw | None = None,
    save: int | Sequence[float] | Array = 200,
    progress: Progress | None = None,
    until: Callable[[Stepper], bool] | None = None,
) -> Trajectory:
    """Step ``system`` from (q, v) at t = 0 to ``end_time``, s, or to the last of given times.

    q, v : (dofs,), in the system's units. law : of constraints that close, by default inelastic and unilateral.
    save : number of saved instants, or times. progress : called with the finished fraction.
    until : called at every saved instant; the run ends with the first at which it returns True.

    A run that cannot finish returns the samples so far, with ``failure`` set. Raises ``ValueError`` for bad input.
    """
    run = Stepper(system, q, v, integrator, end_time, law)
    kept = saved_steps(run.instants, save)
    affordable("integrator and mesh", run.instants.size - 1, max(1, system.dofs // 2), kept.size, MOST_WORK)
    samples: list[dict[str, Any]] = []
    failure = ""
    run.compile()
    start, worked, started, said = run.energy(), 0.0, clock.perf_counter(), False
    for step in kept:
        status = run.advance_to(int(step))
        if status != SOLVED:
            failure = FAILURES[status]
            break
        samples.append(run.sample())
        sums = samples[-1]["sums"]
        worked = max(worked, abs(sums["work_of_loads"]))
        if progress is not None:
            progress(float(step) / max(float(kept[-1]), 1.0))
        spent = clock.perf_counter() - started
        if not said and step and spent >= SOON:
            said, left = True, spent * (float(kept[-1]) / float(step) - 1.0)
            if left > LONG:
                how, log = "about" if until is None else "up to", logging.getLogger("bent_beam")
                steps, nodes = int(kept[-1]) - int(step), system.dofs // 2
                log.warning("%s %.2g minutes more: %d steps of %d nodes", how, left / 60.0, steps, nodes)
        if until is not None and until(run):
            break
    if not failure and run.energy() > UNSTABLE * (start + worked) > 0.0:
        failure = "the scheme is unstable: its energy grows without bound"
    seconds, reached = clock.perf_counter() - started, float(run.instants[run.step])
    return trajectory_of(run, samples, seconds, failure, reached if failure else 0.0)
