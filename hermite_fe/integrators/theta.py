"""Compiled θ-steps with unilateral constraints, for Moreau–Jean and for Signorini at the new position.

    M Δv + hC v_θ + hK q_θ = hF_θ + Gᵀp,     q⁺ = q + h v_θ,      x_θ = x + θΔx

Solved for Δv: S Δv = h[F_θ − K(q + θhv) − Cv] + Gᵀp, S = M + θhC + θ²h²K. Exactly, per step,

    Δ(T + V) = h F_θᵀv_θ − h v_θᵀC v_θ + pᵀG(v + ½Δv) − (θ − ½)[Δvᵀ(MΔv − Gᵀp) + h² v_θᵀK v_θ]:

the work of the loads, less viscous loss, less loss in impacts −pᵀG(v + ½Δv), less algorithmic loss. Maxwell branches
add to S, to the right side and to the energies (:mod:`hermite_fe.maxwell`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hermite_fe.active_set import NOT_FINITE, SOLVED, solve_constrained
from hermite_fe.banded import copy, dot, multiply, stiff_multiply
from hermite_fe.compiled import compiled
from hermite_fe.constraints import (
    Constraints,
    Rows,
    constraints_of,
    find_held,
    note_complementarity,
    row_times,
    rows_times,
)
from hermite_fe.maxwell import add_branch_forces, step_branches, stiffen
from hermite_fe.solver import prepare
from hermite_fe.stepping import MATERIAL, Matrices, Problem, State, add_energies, add_impulses, end_step, mean_forces

__all__ = ["ThetaMemory", "take_steps", "theta_memory"]

Array = NDArray[np.float64]


class ThetaMemory(NamedTuple):
    """Work arrays of a step: its conditions, and vectors (dofs,)."""

    conditions: Constraints
    b: Array
    dv: Array
    v_theta: Array
    mean_v: Array
    force: Array
    scratch: Array


def theta_memory(problem: Problem) -> ThetaMemory:
    """Work arrays for ``problem``."""
    return ThetaMemory(constraints_of(problem.rows), *np.zeros((6, problem.matrices.M.shape[1])))


@compiled
def impose(
    rows: Rows, conditions: Constraints, q: Array, v: Array, h: float, theta: float, e: float, at_position: bool
) -> None:
    """Set the candidates and the targets c of GΔv ≥ c."""
    rows_times(rows, q, conditions.Gq)
    rows_times(rows, v, conditions.Gv)
    for j in range(rows.gap.size):
        gap, speed = rows.gap[j] + conditions.Gq[j], conditions.Gv[j]
        if at_position:  # g⁺ ≥ 0 at the end of the step
            conditions.candidate[j] = True
            conditions.target[j] = -(gap / h + speed) / theta
        else:  # Gv⁺ ≥ −eGv for constraints that would end the step on the wall or inside it
            conditions.candidate[j] = gap + (1.0 - theta) * h * speed <= 0.0
            conditions.target[j] = -speed if conditions.held[j] else -(1.0 + e) * speed


@compiled
def right_side(
    matrices: Matrices, q: Array, v: Array, force: Array, h: float, theta: float, b: Array, moved: Array, scratch: Array
) -> None:
    """b = h[F_θ − K(q + θhv) − Cv]; ``moved`` and ``scratch`` are work arrays."""
    for i in range(q.size):
        moved[i] = q[i] + theta * h * v[i]
    stiff_multiply(matrices.K, matrices.K_sums, moved, b)
    stiff_multiply(matrices.C, matrices.C_sums, v, scratch)
    for i in range(q.size):
        b[i] = h * (force[i] - b[i] - scratch[i])


@compiled
def algorithmic_loss(matrices: Matrices, rows: Rows, p: Array, dv: Array, v_theta: Array, h: float, theta: float,
                     scratch: Array) -> float:  # fmt: skip
    """(θ − ½)[Δvᵀ(MΔv − Gᵀp) + h² v_θᵀK v_θ]."""
    if theta == 0.5:
        return 0.0
    multiply(matrices.M, dv, scratch)
    loss = dot(dv, scratch)
    stiff_multiply(matrices.K, matrices.K_sums, v_theta, scratch)
    loss += h * h * dot(v_theta, scratch)
    for j in range(p.size):
        if p[j] != 0.0:
            loss -= p[j] * row_times(rows, dv, j)
    return (theta - 0.5) * loss


@compiled
def take_steps(
    problem: Problem, state: State, memory: ThetaMemory, times: Array, first: int, last: int, theta: float,
    at_position: bool
) -> tuple[int, int]:  # fmt: skip
    """Take the steps ``first`` … ``last`` − 1 between the instants ``times``; returns (status, step reached)."""
    matrices, rows, law, solver = problem
    conditions, b, dv, v_theta, mean_v, force, scratch = memory
    q, v = state.q, state.v
    for k in range(first, last):
        t, h, made_for = times[k], times[k + 1] - times[k], solver.step[0]
        h = prepare(
            solver, rows, matrices.M, matrices.C, matrices.K, theta * h, theta * theta * h * h, h, times[k + 1]
        )
        if h != made_for:
            stiffen(state.bending, h, theta, solver)
        find_held(rows, law, state.closed, t, conditions.held)
        impose(rows, conditions, q, v, h, theta, law.restitution, at_position)
        mean_forces(matrices.load, t, h, theta, force)
        right_side(matrices, q, v, force, h, theta, b, v_theta, scratch)
        add_branch_forces(state.bending, state.branches, v, h, b)
        copy(state.closed, conditions.closed)
        status = solve_constrained(solver, rows, conditions, b, dv)
        if status != SOLVED:
            return status, k
        copy(conditions.closed, state.closed)
        for i in range(q.size):
            v_theta[i] = v[i] + theta * dv[i]
            mean_v[i] = v[i] + 0.5 * dv[i]
            q[i] += h * v_theta[i]
            v[i] += dv[i]
        add_impulses(state, conditions)
        note_complementarity(rows, conditions, dv, 1.0, theta * h if at_position else 1.0, state.worst)
        work = h * dot(force, v_theta)
        state.energy[MATERIAL] += step_branches(state.bending, v_theta, h, state.branches, state.stretch)
        loss = algorithmic_loss(matrices, rows, conditions.p, dv, v_theta, h, theta, scratch)
        add_energies(matrices, rows, h, work, conditions.p, mean_v, v_theta, loss, scratch, state.energy)
        if not end_step(state):
            return NOT_FINITE, k
    return SOLVED, last
