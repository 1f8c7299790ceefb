"""Compiled θ-stepping with unilateral rows, for Moreau–Jean and for Signorini at the new position.

    M Δv + h C v_θ + h K q_θ = h F_θ + Gᵀp,     q⁺ = q + h v_θ,      x_θ = θx⁺ + (1 − θ)x

is solved for Δv with S = M + θhC + θ²h²K. Exactly, per step,

    Δ(T + V) = h F_θᵀv_θ − h v_θᵀC v_θ + ½pᵀG(v⁺ + v) − (θ − ½)[Δvᵀ(MΔv − Gᵀp) + ΔqᵀKΔq]:

work of loads, viscous loss, (minus) loss in impacts, algorithmic loss. The sums are compensated.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.banded import add, combine, dot, multiply, quadratic, stiff_multiply
from hermite_fe.kernels.contact import force_at, mark_held, row_times, rows_times
from hermite_fe.kernels.jit import compiled
from hermite_fe.kernels.pivoting import solve_rows
from hermite_fe.kernels.problem import (
    ALGORITHMIC,
    IMPACT,
    PRODUCT,
    SMALLEST_REACTION,
    WORK,
    ContactLaw,
    Problem,
    State,
    Work,
)
from hermite_fe.kernels.rows import NOT_FINITE, SOLVED

Array = NDArray[np.float64]


@compiled
def steps(
    problem: Problem,
    law: ContactLaw,
    state: State,
    work: Work,
    times: Array,
    first: int,
    last: int,
    theta: float,
    at_position: bool,
) -> tuple[int, int]:
    """Take the steps ``first`` … ``last`` − 1 between the instants ``times``. Returns (status, step
    reached)."""
    M, C, K, load = problem.M, problem.C, problem.K, problem.load
    dofs, factors, gap0 = problem.dofs, problem.factors, problem.gap
    q, v, closed = state.q, state.v, state.closed
    b, dv, p, target, candidate, held = work.b, work.x, work.p, work.target, work.candidate, work.held
    gap, speed, dq, vel, force = work.gap, work.speed, work.d1, work.d2, work.d3
    n, m = q.size, closed.size
    for k in range(first, last):
        t = times[k]
        h = times[k + 1] - t
        fresh = work.made_with[0] != h
        if fresh:
            combine(M, C, K, 1.0, theta * h, theta * theta * h * h, problem.place, work.S)
            work.made_with[0] = h
        for i in range(n):
            dq[i] = q[i] + theta * h * v[i]
        stiff_multiply(K, problem.even, problem.odd, dq, b)
        multiply(C, v, vel, n)
        force_at(load, t, h, theta, force)
        for i in range(n):
            b[i] = h * (force[i] - b[i] - vel[i])

        mark_held(problem, law, closed, t, held)
        rows_times(dofs, factors, q, gap)
        rows_times(dofs, factors, v, speed)
        if at_position:
            for j in range(m):
                candidate[j] = True
                target[j] = -((gap0[j] + gap[j]) / h + speed[j]) / theta
        else:
            for j in range(m):
                # where a row would come to rest if it were closed now
                candidate[j] = gap0[j] + gap[j] + (1.0 - theta) * h * speed[j] <= 0.0
                target[j] = -speed[j] if held[j] else -(1.0 + law.restitution) * speed[j]
        status = solve_rows(problem, work, fresh, n, closed)
        if status != SOLVED:
            work.made_with[0] = math.nan
            return status, k

        for j in range(m):
            if closed[j]:
                change = row_times(dofs, factors, dv, j)
                add(state.budget, IMPACT, -0.5 * p[j] * (2.0 * speed[j] + change))
                add(state.budget, ALGORITHMIC, -(theta - 0.5) * p[j] * change)
                state.impulse[j] += p[j]
                if held[j]:
                    state.held_impulse[j] += min(p[j], 0.0)
                else:
                    state.worst[SMALLEST_REACTION] = min(state.worst[SMALLEST_REACTION], p[j])
                product = abs(p[j] * (change - target[j])) * (h if at_position else 1.0)
                state.worst[PRODUCT] = max(state.worst[PRODUCT], product)
        add(state.budget, ALGORITHMIC, (theta - 0.5) * quadratic(M, dv))
        work_done = 0.0
        for i in range(n):
            vel[i] = v[i] + theta * dv[i]
            dq[i] = h * vel[i]
            q[i] += dq[i]
            v[i] += dv[i]
            work_done += force[i] * vel[i]
        add(state.budget, WORK, h * work_done)
        for cause in range(problem.slots.size):
            add(state.budget, problem.slots[cause], h * quadratic(problem.parts[cause], vel))
        stiff_multiply(K, problem.even, problem.odd, dq, vel)
        add(state.budget, ALGORITHMIC, (theta - 0.5) * dot(dq, vel))
        if not math.isfinite(work_done):
            return NOT_FINITE, k
    return SOLVED, last
