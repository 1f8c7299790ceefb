"""Nonsmooth generalised-α: second order in smooth motion, first order across impacts (thesis 3.2, 3.3.10–16;
:mod:`hermite_fe.integrators.generalized_alpha`).

The level at which the constraints are imposed (``levels``):

- ``velocity`` : the impact law at velocity level; positions drift (after Chen, Acary, Virlez, Brüls 2013,
  Int. J. Numer. Meth. Eng. 96, 487);
- ``position_velocity`` : gaps and velocities, one after the other, no drift (after Brüls, Acary, Cardona
  2014, CMAME 281, 131);
- ``position_velocity_acceleration`` : also the smooth acceleration obeys the constraints at rest on the wall, so
  that lasting contact is second order as well (after Brüls, Acary, Cardona 2018, in Advanced Topics in
  Nonsmooth Dynamics, Springer, 335): the thesis's solver.
"""

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

from bent_beam.fields import Quantity
from hermite_fe import constraints
from hermite_fe.active_set import SOLVED, solve_constrained
from hermite_fe.banded import copy, dot, multiply
from hermite_fe.compiled import Array, compiled, compiled_within
from hermite_fe.constraints import Constraints, constraints_of
from hermite_fe.integrators import generalized_alpha as alpha
from hermite_fe.integrators.base import Integrator, Reached
from hermite_fe.stepping import Problem, State, add_impulses, forces_at

LEVELS = ("velocity", "position_velocity", "position_velocity_acceleration")
VELOCITY, _, ACCELERATION = range(3)
AT_REST = 1e-12  # of the rate at which the kinetic energy would move its dofs alone: slower, it has not rebounded


class AlphaMemory(NamedTuple):
    """The motion, the conditions of the three contact problems of a step, and the place in :data:`LEVELS`."""

    motion: alpha.Motion
    smooth: Constraints
    position: Constraints
    velocity: Constraints
    level: int


@compiled
def take_steps(problem: Problem, state: State, memory: AlphaMemory, times: Array, first: int, last: int) -> Reached:
    motion, _, _, velocity, level = memory
    for k in range(first, last):
        t, h = times[k], alpha.prepare_step(problem, motion.scheme, times[k + 1] - times[k], times[k + 1])
        constraints.set_bounds(problem.rows, problem.law, state.closed, t, h, velocity.least)
        constraints.rows_times(problem.rows, state.v, velocity.Gv)
        if level == VELOCITY:
            status = velocity_step(problem, state, memory, t, h)
        else:
            status = position_step(problem, state, memory, t, h)
        if status == SOLVED:
            status = alpha.finish_step(problem, state, motion, t, h)
        if status != SOLVED:
            return status, k
    return SOLVED, last


@compiled_within
def smooth_motion(problem: Problem, state: State, memory: AlphaMemory, t: float, h: float) -> int:
    """The step's motion without jumps, with the contact conditions of accelerations; returns the status."""
    motion, conditions = memory.motion, memory.smooth
    scheme, vectors, reactions = motion
    alpha.predict(state, motion, h)
    forces_at(problem.matrices, t + h, state.q, state.v, vectors.b, vectors.scratch)
    status = solve_constrained(problem.solver, problem.rows, conditions, vectors.b, vectors.x)
    if status == SOLVED:
        constraints.note_complementarity(problem.rows, conditions, vectors.x, h, state.worst)
        alpha.correct(state, motion, h)
        for j in range(conditions.p.size):
            alpha.take_reaction(scheme, reactions, h, j, conditions.p[j])
    return status


@compiled_within
def velocity_jump(problem: Problem, state: State, memory: AlphaMemory) -> int:
    """The jump W (``vectors.x``) of (M + hγsC + h²βsK)W = b + Gᵀp, 0 ≤ p ⊥ Gv⁺ + eGv ≥ 0, v⁺ += W, Gv of before the
    step, b = ``vectors.b``. Puts KW in ``vectors.force``, CW in ``vectors.scratch``; returns the status."""
    matrices, rows, law, solver = problem
    vectors, velocity, v = memory.motion.vectors, memory.velocity, state.v
    W = vectors.x
    constraints.rows_times(rows, v, velocity.Gq)
    constraints.ask_for_rebound(law, velocity, velocity.Gq)
    status = solve_constrained(solver, rows, velocity, vectors.b, W)
    if status == SOLVED:
        copy(velocity.p, memory.motion.reactions.impulse)
        add_impulses(state, velocity)
        constraints.note_complementarity(rows, velocity, W, 1.0, state.worst)
        multiply(matrices.K, W, vectors.force)
        multiply(matrices.C, W, vectors.scratch)
        for i in range(v.size):
            v[i] += W[i]
    return status


@compiled_within
def velocity_step(problem: Problem, state: State, memory: AlphaMemory, t: float, h: float) -> int:
    """Constraints at velocity level only.

    smooth :    M v̇⁺ + C ṽ + K q̃ = F⁺, the motion without reactions
    velocity :  (M + hγsC + h²βsK)W = Gᵀp,  U = h(β/γ)W (½hW at ρ∞ = 1),   0 ≤ p ⊥ Gv⁺ + eGv ≥ 0

    The matrix of W includes the elastic forces that the jump causes within the step. With M W = Gᵀp alone the next
    accelerations would have to compensate them, which is unstable for a stiff beam.
    """
    q = state.q
    (scheme, vectors, _), _, _, velocity, _ = memory
    share = h * scheme.beta / scheme.gamma  # a constraint comes to rest h − share ahead if it is closed now
    constraints.find_candidates(problem.rows, velocity, q, state.closed, h - share)
    status = smooth_motion(problem, state, memory, t, h)
    vectors.b[:] = 0.0
    if status == SOLVED:
        status = velocity_jump(problem, state, memory)
    copy(velocity.closed, state.closed)
    W, J = vectors.x, vectors.new_jump_force
    for i in range(W.size):
        J[i] = share * vectors.force[i] + vectors.scratch[i]
        vectors.missed_momentum[i] = (0.5 - scheme.gamma * scheme.s) * J[i]
        vectors.missed_motion[i] += (share - 0.5 * h) * W[i]
        q[i] += share * W[i]
    return status


@compiled_within
def position_step(problem: Problem, state: State, memory: AlphaMemory, t: float, h: float) -> int:
    """Constraints at position and velocity level and, for smooth reactions, at acceleration level, one after the other.

    smooth :    M v̇⁺ + C ṽ + K q̃ = F⁺ + Gᵀλ,   0 ≤ λ ⊥ Gv̇⁺ ≥ 0 for constraints at rest on the wall
        (at acceleration level; else λ = 0)
    position :  (M + hγsC + h²βsK)U = Gᵀν,                 0 ≤ ν ⊥ g(q̃ + U) ≥ 0                (after 3.2.19)
    velocity :  (M + hγsC + h²βsK)W = −hKU + Gᵀ(p − p_λ),  0 ≤ p ⊥ Gv⁺ + eGv ≥ 0               (after 3.2.20)
        for constraints closed at position, or with λ > 0; p = 0 in the others

    p_λ is the impulse of λ, through the same filter as v̇, p that of the whole step: momentum is exact. Signorini's
    condition is imposed on p, not on p − p_λ: the delayed reaction of the filter then cannot push a constraint that has
    opened, and for e = 0 the wall does work only on constraints that were leaving. The matrix is that of
    :func:`velocity_step`, for the same reason. With (3.2.20) unchanged, M W = −hKU − hCW +
    GᵀΛ and 0 ≤ Λ, an undamped beam whose shortest waves the steps do not resolve gains energy from the wall (1.8 times
    the initial one at κ/ν = 0.1, 50 elements, h = 1e-3 T*).
    """
    motion, smooth, position, velocity, level = memory
    at_rest = motion.reactions.at_rest
    for j in range(at_rest.size):
        smooth.candidate[j] = level == ACCELERATION and at_rest[j]
        smooth.least[j] = velocity.least[j] if smooth.candidate[j] else 0.0  # 0 or −∞, in any unit
        smooth.closed[j] = smooth.candidate[j]
    status = smooth_motion(problem, state, memory, t, h)
    if status == SOLVED:
        copy(velocity.least, position.least)
        status = position_jump(problem, state, memory, h)
    if status == SOLVED:
        status = velocity_after_position(problem, state, memory, h)
    return status


@compiled_within
def position_jump(problem: Problem, state: State, memory: AlphaMemory, h: float) -> int:
    """U of :func:`position_step`. Puts −hKU in ``vectors.b``; returns the status."""
    matrices, rows, _, solver = problem
    vectors, position = memory.motion.vectors, memory.position
    q, U, b, force = state.q, vectors.x, vectors.b, vectors.new_jump_force
    constraints.ask_for_gaps(rows, position, q, state.closed, 1.0, 1.0)
    b[:] = 0.0
    status = solve_constrained(solver, rows, position, b, U)
    copy(position.closed, state.closed)
    constraints.note_complementarity(rows, position, U, 1.0 / h, state.worst)
    multiply(matrices.K, U, force)
    for i in range(U.size):
        q[i] += U[i]
        vectors.missed_motion[i] += U[i]
        vectors.missed_momentum[i] = -0.5 * force[i]
        b[i] = -h * force[i]
    return status


@compiled_within
def velocity_after_position(problem: Problem, state: State, memory: AlphaMemory, h: float) -> int:
    """W of :func:`position_step`, and which constraints are at rest after it. ``vectors.b`` is −hKU."""
    rows, v = problem.rows, state.v
    (scheme, vectors, reactions), smooth, _, velocity, _ = memory
    for j in range(reactions.at_rest.size):
        velocity.candidate[j] = state.closed[j] or smooth.p[j] > 0.0
        velocity.closed[j] = velocity.candidate[j]
        for i in range(rows.dofs.shape[1]):
            vectors.b[rows.dofs[j, i]] -= rows.factors[j, i] * reactions.impulse[j]
    status = velocity_jump(problem, state, memory)
    force, damping = vectors.force, vectors.scratch
    for i in range(v.size):
        vectors.missed_momentum[i] += (0.5 - scheme.gamma * scheme.s) * damping[i]
        vectors.missed_momentum[i] -= h * scheme.beta * scheme.s * force[i]
        vectors.missed_motion[i] -= 0.5 * h * vectors.x[i]
        vectors.new_jump_force[i] += damping[i]
    multiply(problem.matrices.M, v, damping)
    energy = dot(v, damping)
    for j in range(reactions.at_rest.size):
        fastest = 0.0
        for i in range(rows.dofs.shape[1]):
            fastest += abs(rows.factors[j, i]) * math.sqrt(energy / problem.matrices.M[0, rows.dofs[j, i]])
        reactions.at_rest[j] = velocity.closed[j] and abs(constraints.row_times(rows, v, j)) <= AT_REST * fastest
    return status


@dataclass(frozen=True)
class NonsmoothGeneralizedAlpha(Integrator):
    """Generalised-α with jumps, its constraints imposed at the levels asked for."""

    holds: ClassVar[bool] = True

    spectral_radius: alpha.SpectralRadius = 0.8
    levels: Annotated[str, Quantity("", "at which constraints are imposed", choices=LEVELS)] = LEVELS[-1]

    def start(self, problem: Problem, state: State) -> AlphaMemory:
        smooth, position, velocity = (constraints_of(problem.rows) for _ in range(3))
        motion, level = alpha.motion_of(problem, state, self.spectral_radius), LEVELS.index(self.levels)
        return AlphaMemory(motion, smooth, position, velocity, level)

    advance = staticmethod(take_steps)
