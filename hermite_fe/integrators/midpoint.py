"""The implicit midpoint rule for a wall that gives way (:mod:`hermite_fe.elastic_wall`): it conserves energy.

    M Δv + hC v̄ + hK q̄ = hF̄ − h f(q, q⁺),     q⁺ = q + h v̄,     v̄ = v + ½Δv,     q̄ = q + ½h v̄

with f the mean force of the wall, or of both, f₁ − f₂, over the step: the θ-scheme with θ = ½
(:mod:`hermite_fe.integrators.theta`). Newton's method for Δv, T = ∂f/∂q⁺:

    (M + ½hC + ¼h²K + ½h²T) Δv = h[F̄ − K(q + ½hv) − Cv] − h f + ½h²T Δv

Exactly, per step, Δ(T + V + W) = h F̄ᵀv̄ − h v̄ᵀC v̄ − the dashpots' loss: there is no algorithmic loss.
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from hermite_fe.active_set import CYCLING, SOLVED, largest_of_a_kind, solve_free
from hermite_fe.banded import PAD, copy, multiply
from hermite_fe.compiled import Array, Places, compiled, compiled_within
from hermite_fe.constraints import count_rounds
from hermite_fe.elastic_wall import FORCE, FORCE_TIME, PENETRATION, PRESSURE, landing, push
from hermite_fe.integrators.base import Integrator, Reached
from hermite_fe.integrators.theta import Vectors, begin_step, finish_step
from hermite_fe.stepping import WALL, Problem, State

CONVERGED = 1e-11  # change of Δv over the largest velocity; the next would be its square
ROUNDED = 2.0**-52  # h times that change over the largest deflection: of a beam at rest nothing smaller can be told
MOST_ROUNDS = 60
FULL_ROUNDS = 20  # of whole Newton steps; then half ones


class MidpointMemory(NamedTuple):
    """base : S without the wall; tangent : T, (4, dofs); reach : (1,), the last dof of the wall's part in S.

    impulse : (rows,), zeros, of a rigid wall; peaks : (walls, 4), of a step. wall : (walls, dofs), f₁ and f₂. right,
    solution, new : (dofs,), of a round, its right-hand side, its Δv and q⁺.
    """

    vectors: Vectors
    base: Array
    tangent: Array
    reach: Places
    impulse: Array
    peaks: Array
    wall: Array
    right: Array
    solution: Array
    new: Array


@compiled
def take_steps(problem: Problem, state: State, memory: MidpointMemory, times: Array, first: int, last: int) -> Reached:
    for k in range(first, last):
        h, anew = begin_step(problem, state, memory.vectors, times[k], times[k + 1], 0.5)
        if anew:
            for m in range(memory.base.shape[0]):
                copy(problem.solver.S[m], memory.base[m])
        status = solve_step(problem, state, memory, times[k], h)
        if status == SOLVED:
            status = finish_step(problem, state, memory.impulse, memory.vectors, h, 0.5)
        if status != SOLVED:
            return status, k
    return SOLVED, last


@compiled_within
def solve_step(problem: Problem, state: State, memory: MidpointMemory, t: float, h: float) -> int:
    """Δv by Newton's method, and what the wall then does; returns the status."""
    springs, second, rows, solver = problem.matrices.springs, problem.matrices.second, problem.rows, problem.solver
    walls, total = memory.wall, np.zeros(2)
    q, v, dv, new, right, x = state.q, state.v, memory.vectors.dv, memory.new, memory.right, memory.solution
    (speed, _), (bent, _), converged = largest_of_a_kind(v), largest_of_a_kind(q), False
    for k in range(MOST_ROUNDS):
        for i in range(q.size):
            new[i] = q[i] + h * (v[i] + 0.5 * dv[i])
        memory.tangent[:] = 0.0
        total[0], loss, touched = push(springs, q, new, h, walls[0], memory.tangent, memory.peaks[0])
        if second.stiffness > 0.0:
            total[1], more, last = push(second, q, new, h, walls[1], memory.tangent, memory.peaks[1])
            loss, touched = loss + more, max(touched, last)
        if converged:
            count_rounds(solver, k)
            state.energy[WALL] += loss
            record_push(problem, state, memory, t, h, total)
            return SOLVED
        multiply(memory.tangent, dv, right)
        for i in range(q.size):
            right[i] = memory.vectors.b[i] - h * (walls[0, i] - walls[1, i]) + 0.5 * h * h * right[i]
        reach = max(touched, memory.reach[0]) + 1
        for m in range(4):
            for i in range(reach):
                solver.S[m, i + PAD] = memory.base[m, i + PAD] + 0.5 * h * h * memory.tangent[m, i]
        solver.stale[0] = max(solver.stale[0], reach - 1 + PAD)
        memory.reach[0] = touched
        status = solve_free(solver, rows, right, x)
        if status != SOLVED:
            return status
        change, share = 0.0, 1.0 if k < FULL_ROUNDS else 0.5
        for i in range(0, q.size, 2):
            change = max(change, abs(x[i] - dv[i]))
        for i in range(q.size):
            dv[i] += share * (x[i] - dv[i])
        converged = change <= max(CONVERGED * speed, ROUNDED * bent / h)
    return CYCLING


@compiled_within
def record_push(problem: Problem, state: State, memory: MidpointMemory, t: float, h: float, total: Array) -> None:
    """Add the impulses of a step from t, and note the largest force, penetration and pressure so far, each of the wall
    with the larger one. The forces on deflections add up to the whole force of a wall, N₁ + N₃ = 1."""
    rows = problem.rows
    for j in range(rows.gap.size):
        dof = rows.dofs[j, 0]
        state.impulse[j] += h * memory.wall[0 if rows.factors[j, 0] < 0.0 else 1, dof]
        state.closed[j] = rows.gap[j] + rows.factors[j, 0] * memory.new[dof] < 0.0
    largest, when = max(total[0], total[1]), t + 0.5 * h
    for springs in (problem.matrices.springs, problem.matrices.second):
        force, pressure = landing(springs, state.q, memory.new, state.v)
        state.peaks[PRESSURE] = max(state.peaks[PRESSURE], pressure)
        if force > largest:
            largest, when = force, t
    if largest > state.peaks[FORCE]:
        state.peaks[FORCE], state.peaks[FORCE_TIME] = largest, when
    for i in (PENETRATION, PRESSURE):
        state.peaks[i] = max(state.peaks[i], memory.peaks[0, i], memory.peaks[1, i])


@dataclass(frozen=True)
class Midpoint(Integrator):
    """The implicit midpoint rule, for a wall that gives way."""

    rebounds: ClassVar[bool] = False
    elastic: ClassVar[bool] = True
    hysteretic: ClassVar[bool] = True

    def start(self, problem: Problem, state: State) -> MidpointMemory:
        n, base, reach = state.q.size, np.zeros_like(problem.solver.S), np.zeros(1, np.int64)
        impulse, peaks = np.zeros_like(state.impulse), np.zeros((2, state.peaks.size))
        vectors, tangent, wall = Vectors(*np.zeros((6, n))), np.zeros((4, n)), np.zeros((2, n))
        return MidpointMemory(vectors, base, tangent, reach, impulse, peaks, wall, *np.zeros((3, n)))

    advance = staticmethod(take_steps)
