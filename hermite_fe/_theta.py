"""Compiled θ-stepping with unilateral rows, for Moreau–Jean and for Signorini at the new position.

    M Δv + h C v_θ + h K q_θ = h F_θ + Gᵀp,     q⁺ = q + h v_θ,      x_θ = θx⁺ + (1 − θ)x

is solved for Δv with S = M + θhC + θ²h²K. Exactly, per step,

    Δ(T + V) = h F_θᵀv_θ − h v_θᵀC v_θ + ½pᵀG(v⁺ + v) − (θ − ½)[Δvᵀ(MΔv − Gᵀp) + ΔqᵀKΔq]:

work of loads, viscous loss, (minus) loss in impacts, algorithmic loss. The sums are compensated.
"""

from __future__ import annotations

import math

import numba

from hermite_fe._banded import _JIT, add, combine, multiply, quadratic
from hermite_fe._contact import force_at, mark_held, rows_times, solve_rows
from hermite_fe._pivoting import SOLVED
from hermite_fe._problem import PRODUCT, SMALLEST_REACTION

NOT_FINITE = 3
WORK, VISCOUS, IMPACT, ALGORITHMIC = 0, 1, 2, 3  # places in State.budget


@numba.njit(**_JIT)
def steps(problem, contact, state, work, times, first, last, theta, at_position):  # type: ignore[no-untyped-def]
    """Take the steps ``first`` … ``last`` − 1 between the instants ``times``. Returns (status, step reached)."""
    M, C, K, load = problem.M, problem.C, problem.K, problem.load
    dofs, factors = problem.dofs, problem.factors
    q, v, closed = state.q, state.v, state.closed
    n, m = q.size, closed.size
    dv, dq = work.x, work.y2
    for k in range(first, last):
        t = times[k]
        h = times[k + 1] - t
        fresh = work.cache[0] != h
        if fresh:
            combine(M, C, K, theta * h, theta * theta * h * h, work.S)
            work.cache[0] = h
        for i in range(n):
            dq[i] = q[i] + theta * h * v[i]
        multiply(K, dq, work.b)
        multiply(C, v, work.y1)
        force_at(load, t, h, theta, work.y3)
        for i in range(n):
            work.b[i] = h * (work.y3[i] - work.b[i] - work.y1[i])

        mark_held(closed, problem.rank, problem.side, contact.hold_rows, t < contact.hold_until, work.held)
        for j in range(m):
            gap = problem.gap[j] + rows_times(dofs, factors, q, j)
            speed = rows_times(dofs, factors, v, j)
            if at_position:
                work.candidate[j] = True
                work.target[j] = -(gap / h + speed) / theta
            else:
                # where a row would come to rest if it were closed now
                work.candidate[j] = gap + (1.0 - theta) * h * speed <= 0.0
                work.target[j] = -speed if work.held[j] else -(1.0 + contact.restitution) * speed
        status = solve_rows(problem, work, fresh, closed)
        if status != SOLVED:
            work.cache[0] = math.nan
            return status, k

        p = work.p
        for j in range(m):
            if closed[j] or p[j] != 0.0:
                speed = rows_times(dofs, factors, v, j)
                change = rows_times(dofs, factors, dv, j)
                add(state.budget, IMPACT, -0.5 * p[j] * (2.0 * speed + change))
                add(state.budget, ALGORITHMIC, -(theta - 0.5) * p[j] * change)
                state.impulse[j] += p[j]
                if work.held[j]:
                    state.held_impulse[j] += min(p[j], 0.0)
                else:
                    state.worst[SMALLEST_REACTION] = min(state.worst[SMALLEST_REACTION], p[j])
                product = abs(p[j] * (change - work.target[j])) * (h if at_position else 1.0)
                state.worst[PRODUCT] = max(state.worst[PRODUCT], product)
        add(state.budget, ALGORITHMIC, (theta - 0.5) * quadratic(M, dv))
        work_done = 0.0
        for i in range(n):
            speed = v[i] + theta * dv[i]
            work.y1[i] = speed
            work_done += work.y3[i] * speed
            dq[i] = h * speed
            q[i] += dq[i]
            v[i] += dv[i]
        add(state.budget, WORK, h * work_done)
        add(state.budget, VISCOUS, h * quadratic(C, work.y1))
        add(state.budget, ALGORITHMIC, (theta - 0.5) * quadratic(K, dq))
        if not math.isfinite(work_done + q[0] + v[0] + v[n - 1]):
            return NOT_FINITE, k
    return SOLVED, last
