"""The implicit midpoint rule for a wall that gives way (:mod:`hermite_fe.elastic_wall`): it conserves energy.

    M Δv + hC v̄ + hK q̄ = hF̄ − h f(q, q⁺),     q⁺ = q + h v̄,     v̄ = v + ½Δv,     q̄ = q + ½h v̄

with f the wall's mean force over the step. Newton's method for Δv, T = ∂f/∂q⁺:

    (M + ½hC + ¼h²K + ½h²T) Δv = h[F̄ − K(q + ½hv) − Cv] − h f + ½h²T Δv

Exactly, per step, Δ(T + V + W) = h F̄ᵀv̄ − h v̄ᵀC v̄ − the dashpots' loss: there is no algorithmic loss.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from hermite_fe.active_set import CYCLING, NOT_FINITE, SOLVED, solve_free
from hermite_fe.banded import PAD, dot, multiply
from hermite_fe.compiled import compiled
from hermite_fe.elastic_wall import FORCE, FORCE_TIME, PENETRATION, PRESSURE, push
from hermite_fe.integrators.base import Integrator
from hermite_fe.integrators.theta import right_side
from hermite_fe.maxwell import add_branch_forces, step_branches, stiffen
from hermite_fe.solver import prepare, refactor_from
from hermite_fe.stepping import MATERIAL, WALL, Problem, State, add_energies, end_step, mean_forces

__all__ = ["Midpoint"]

Array = NDArray[np.float64]
Places = NDArray[np.int64]

CONVERGED = 1e-11  # change of Δv over the largest velocity; the next would be its square
MOST_ROUNDS = 60
FULL_ROUNDS = 20  # of whole Newton steps; then half ones


@dataclass(frozen=True)
class Midpoint(Integrator):
    """The implicit midpoint rule, for a wall that gives way."""

    elastic: ClassVar[bool] = True
    hysteretic: ClassVar[bool] = True

    def start(self, problem: Problem, state: State) -> MidpointMemory:
        n, m = problem.matrices.M.shape[1], problem.rows.gap.size
        base, reach = np.zeros_like(problem.solver.S), np.zeros(1, np.int64)
        return MidpointMemory(base, np.zeros((4, n)), reach, np.zeros(m), np.zeros(4), *np.zeros((9, n)))

    def advance(
        self, problem: Problem, state: State, memory: MidpointMemory, times: Array, first: int, last: int
    ) -> tuple[int, int]:
        return take_steps(problem, state, memory, times, first, last)


class MidpointMemory(NamedTuple):
    """base : S without the wall; tangent : T, (4, dofs); reach : (1,), the last dof of the wall's part in S.

    impulse : (rows,), zeros; peaks : of a step; work arrays (dofs,).
    """

    base: Array
    tangent: Array
    reach: Places
    impulse: Array
    peaks: Array
    b: Array
    right: Array
    dv: Array
    solution: Array
    new: Array
    wall: Array
    force: Array
    mean_v: Array
    scratch: Array


@compiled
def solve_step(problem: Problem, state: State, memory: MidpointMemory, h: float) -> tuple[int, float, float]:
    """Δv by Newton's method, from ``memory.b``; returns the status, the wall's force, N, and the dashpots' loss, J."""
    matrices, rows, _, solver = problem
    q, v, dv, new, x = state.q, state.v, memory.dv, memory.new, memory.solution
    speed, converged = 0.0, False
    for i in range(0, v.size, 2):
        speed = max(speed, abs(v[i]))
    for k in range(MOST_ROUNDS):
        for i in range(q.size):
            new[i] = q[i] + h * (v[i] + 0.5 * dv[i])
        total, loss, touched = push(matrices.springs, q, new, h, memory.wall, memory.tangent, memory.peaks)
        if converged:
            solver.rounds[0] += 1
            solver.rounds[1] += k
            solver.rounds[2] = max(solver.rounds[2], k)
            return SOLVED, total, loss
        multiply(memory.tangent, dv, memory.right)
        for i in range(q.size):
            memory.right[i] = memory.b[i] - h * memory.wall[i] + 0.5 * h * h * memory.right[i]
        reach = max(touched, memory.reach[0]) + 1
        for m in range(4):
            for i in range(reach):
                solver.S[m, i + PAD] = memory.base[m, i + PAD] + 0.5 * h * h * memory.tangent[m, i]
        refactor_from(solver, reach - 1 + PAD)
        memory.reach[0] = touched
        status = solve_free(solver, rows, memory.right, x)
        if status != SOLVED:
            return status, 0.0, 0.0
        change, share = 0.0, 1.0 if k < FULL_ROUNDS else 0.5
        for i in range(q.size):
            if i % 2 == 0:
                change = max(change, abs(x[i] - dv[i]))
            dv[i] += share * (x[i] - dv[i])
        converged = change <= CONVERGED * speed
    return CYCLING, 0.0, 0.0


@compiled
def record_push(problem: Problem, state: State, memory: MidpointMemory, t: float, h: float, total: float) -> None:
    """Add the impulses of a step from t, and note the largest force, penetration and pressure so far. The forces on
    deflections add up to the whole force, N₁ + N₃ = 1."""
    rows = problem.rows
    for j in range(rows.gap.size):
        dof = rows.dofs[j, 0]
        state.impulse[j] += h * memory.wall[dof]
        state.closed[j] = memory.new[dof] + problem.matrices.springs.facing[dof] > 0.0
    if total > state.peaks[FORCE]:
        state.peaks[FORCE], state.peaks[FORCE_TIME] = total, t + 0.5 * h
    for i in (PENETRATION, PRESSURE):
        state.peaks[i] = max(state.peaks[i], memory.peaks[i])


@compiled
def take_steps(
    problem: Problem, state: State, memory: MidpointMemory, times: Array, first: int, last: int
) -> tuple[int, int]:
    """Take the steps ``first`` … ``last`` − 1 between the instants ``times``; returns (status, step reached)."""
    matrices, rows, _, solver = problem
    q, v, dv, mean_v = state.q, state.v, memory.dv, memory.mean_v
    for k in range(first, last):
        t, made_for = times[k], solver.step[0]
        h = times[k + 1] - t
        h = prepare(solver, rows, matrices.M, matrices.C, matrices.K, 0.5 * h, 0.25 * h * h, h, times[k + 1])
        if h != made_for:
            stiffen(state.bending, h, 0.5, solver)
            memory.base[:] = solver.S
        mean_forces(matrices.load, t, h, 0.5, memory.force)
        right_side(matrices, q, v, memory.force, h, 0.5, memory.b, memory.new, memory.scratch)
        add_branch_forces(state.bending, state.branches, v, h, memory.b)
        status, total, loss = solve_step(problem, state, memory, h)
        if status != SOLVED:
            return status, k
        record_push(problem, state, memory, t, h, total)
        for i in range(q.size):
            mean_v[i] = v[i] + 0.5 * dv[i]
            q[i] = memory.new[i]
            v[i] += dv[i]
        work = h * dot(memory.force, mean_v)
        add_energies(matrices, rows, h, work, memory.impulse, mean_v, mean_v, 0.0, memory.scratch, state.energy)
        state.energy[WALL] += loss
        state.energy[MATERIAL] += step_branches(state.bending, mean_v, h, state.branches, state.stretch)
        if not end_step(state):
            return NOT_FINITE, k
    return SOLVED, last
