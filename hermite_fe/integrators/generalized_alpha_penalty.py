"""Generalised-α (Chung & Hulbert 1993) with penalty contact: a spring and a damper at each node.

    M v̇⁺ + C v⁺ + K q⁺ = F⁺ + Gᵀλ,    λ_j = −(k_c g_j + d_c ġ_j)·(tributary length of j)  where j is closed

A node is closed while it is in the wall, where the sum of both may pull, as in Exudyn's own ``ObjectContactCoordinate``
with linear damping. One that lands may be in the wall if taken as open, and off it if taken as closed: off the wall a
node that was closed stays so as long as its force pushes. (The Exudyn path is another discretisation: its contact never
pulls, and its k and d go with the element.) Constraints must touch one dof each: contact at nodes. Measured at
κ/ν = 0.5 and 0.1, τ = 0.1: with k = 10⁵, d = 10³ λ₀ is 1.6 and 1.1 % off, with the 10⁷ and 3·10⁴ that these cases get
by default 0.12 and 0.03 %, with 10⁸ and 10⁵ 0.05 and 0.003 %. There is no impact law and no hold; what springs and
dampers take in, stored or dissipated, is booked as loss in impacts.
"""

import dataclasses
import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple, Self

from bent_beam.errors import InputError
from bent_beam.fields import Quantity
from bent_beam.impact import Impact
from hermite_fe.active_set import CYCLING, SINGULAR, SOLVED, solve_free
from hermite_fe.banded import copy
from hermite_fe.compiled import Array, Flags, compiled, compiled_within
from hermite_fe.constraints import PRODUCT, SMALLEST_REACTION, Constraints, constraints_of, count_rounds, rows_times
from hermite_fe.integrators import generalized_alpha as alpha
from hermite_fe.integrators.base import Integrator, Reached
from hermite_fe.stepping import Problem, State, forces_at


class PenaltyMemory(NamedTuple):
    """The motion, work arrays of the contact, and k_c, d_c and ``contact_rounds``."""

    motion: alpha.Motion
    conditions: Constraints
    stiffness: float
    damping: float
    rounds: int


@compiled
def take_steps(problem: Problem, state: State, memory: PenaltyMemory, times: Array, first: int, last: int) -> Reached:
    motion = memory.motion
    scheme, vectors, reactions = motion
    for k in range(first, last):
        t, made_for = times[k], problem.solver.step[0]
        h = alpha.prepare_step(problem, scheme, times[k + 1] - t, times[k + 1])
        if h != made_for:
            reactions.with_spring[:] = False  # the new matrix has no springs yet
        alpha.predict(state, motion, h)
        forces_at(problem.matrices, t + h, state.q, state.v, vectors.force, vectors.scratch)
        status = solve_with_springs(problem, state, memory, h)
        if status == SOLVED:
            alpha.correct(state, motion, h)
            add_spring_reactions(problem, state, memory, h)
            status = alpha.finish_step(problem, state, motion, t, h)
        if status != SOLVED:
            return status, k
    return SOLVED, last


@compiled_within
def set_springs(
    problem: Problem, memory: PenaltyMemory, closed: Flags, position_share: float, velocity_share: float
) -> None:
    """Put the springs and dampers of the closed constraints into the step matrix and into ``vectors.b``."""
    matrices, rows, _, solver = problem
    motion, conditions, stiffness, damping, _ = memory
    with_spring, b = motion.reactions.with_spring, motion.vectors.b
    copy(motion.vectors.force, b)
    for j in range(closed.size):
        d, g = rows.dofs[j, 0], rows.factors[j, 0]
        spring, damper = stiffness * rows.tributary[j], damping * rows.tributary[j]
        if closed[j] != with_spring[j]:
            with_spring[j] = closed[j]
            diagonal = matrices.M[0, d] + velocity_share * matrices.C[0, d] + position_share * matrices.K[0, d]
            if closed[j]:
                diagonal += g * g * (position_share * spring + velocity_share * damper)
            solver.S[0, solver.unknown[d]] = diagonal
            solver.stale[0] = max(solver.stale[0], solver.unknown[d])
        if closed[j]:
            b[d] -= g * (spring * (rows.gap[j] + conditions.Gq[j]) + damper * conditions.Gv[j])


@compiled_within
def solve_with_springs(problem: Problem, state: State, memory: PenaltyMemory, h: float) -> int:
    """Solve for v̇⁺ under ``vectors.force`` and the springs of the closed constraints, and again until the open are off
    the wall and the closed in it, or pushed off it in this step: their dampers alone keep them out. CYCLING after
    ``memory.rounds`` solutions.
    """
    motion, conditions, stiffness, damping, rounds = memory
    rows, solver, closed, x, status = problem.rows, problem.solver, state.closed, motion.vectors.x, CYCLING
    _, _, gamma, beta, s = motion.scheme
    position_share, velocity_share = h * h * beta * s, h * gamma * s
    rows_times(rows, state.q, conditions.Gq)
    rows_times(rows, state.v, conditions.Gv)
    taken = 0
    while status == CYCLING and taken < rounds:
        set_springs(problem, memory, closed, position_share, velocity_share)
        status = solve_free(solver, rows, motion.vectors.b, x)
        taken += 1
        for j in range(closed.size):
            change = rows.factors[j, 0] * x[rows.dofs[j, 0]]
            gap = rows.gap[j] + conditions.Gq[j] + position_share * change
            pushes = stiffness * gap + damping * (conditions.Gv[j] + velocity_share * change) < 0.0
            if status != SINGULAR and closed[j] != (gap <= 0.0 or (closed[j] and pushes)):
                closed[j], status = not closed[j], CYCLING
    count_rounds(solver, taken)
    return status


@compiled_within
def add_spring_reactions(problem: Problem, state: State, memory: PenaltyMemory, h: float) -> None:
    """The forces of springs and dampers at the end of the step, and their impulses."""
    motion, _, stiffness, damping, _ = memory
    rows, reactions, worst = problem.rows, motion.reactions, state.worst
    for j in range(rows.gap.size):
        d, g = rows.dofs[j, 0], rows.factors[j, 0]
        gap, force = rows.gap[j] + g * state.q[d], 0.0
        if state.closed[j]:
            force = -(stiffness * gap + damping * g * state.v[d]) * rows.tributary[j]
            worst[PRODUCT] = max(worst[PRODUCT], abs(force * gap))
        alpha.take_reaction(motion.scheme, reactions, h, j, force)
        state.impulse[j] += reactions.impulse[j]
        worst[SMALLEST_REACTION] = min(worst[SMALLEST_REACTION], h * force)


@dataclass(frozen=True)
class GeneralizedAlphaPenalty(Integrator):
    """Generalised-α with a spring and damper at each node while it penetrates."""

    rebounds: ClassVar[bool] = False

    spectral_radius: alpha.SpectralRadius = 0.8
    stiffness: Annotated[
        float | None, Quantity("N/m²", "k_c, per length of beam", above=0.0, absent="chosen, 1e5 μ/T² of a run to T")
    ] = None
    damping: Annotated[
        float | None, Quantity("N s/m²", "d_c, per length of beam", least=0.0, absent="chosen, 3e3 μ/T of a run to T")
    ] = None
    contact_rounds: Annotated[
        int, Quantity("", "limit on solutions a step for the set of active springs; more fail", least=1)
    ] = 20

    def refined(self, factor: float) -> Self:
        """Steps shorter, the contact stiffer in proportion to their square: the error of the penalty must fall too."""
        return dataclasses.replace(
            super().refined(factor),
            stiffness=None if self.stiffness is None else self.stiffness * factor**2,
            damping=None if self.damping is None else self.damping * factor,
        )

    def with_defaults(self, impact: Impact, end_time: float | None) -> Self:
        """The shorter the run the stiffer, as the front is the thinner; T* / 10 is as good as longer ones."""
        mass, time = impact.mass_per_length, min(end_time or math.inf, 0.1 * impact.slow_time_scale)
        return dataclasses.replace(
            self,
            stiffness=1e5 * mass / time**2 if self.stiffness is None else self.stiffness,
            damping=3e3 * mass / time if self.damping is None else self.damping,
        )

    def start(self, problem: Problem, state: State) -> PenaltyMemory:
        if self.stiffness is None or self.damping is None:
            raise InputError("hermite.integrator.stiffness and hermite.integrator.damping are not chosen yet")
        if problem.rows.dofs.shape[1] != 1:
            raise InputError('generalized_alpha_penalty takes hermite.contact.kind = "node" or "alternate"')
        motion = alpha.motion_of(problem, state, self.spectral_radius)
        return PenaltyMemory(motion, constraints_of(problem.rows), self.stiffness, self.damping, self.contact_rounds)

    advance = staticmethod(take_steps)
