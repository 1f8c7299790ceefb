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

from hermite_fe.kernels.banded import CHUNK, add, combine, dot, multiply_rows, quadratic_rows, stiff_rows
from hermite_fe.kernels.contact import force_rows, mark_held, row_times, rows_times
from hermite_fe.kernels.jit import compiled_apart, compiled_in_place
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
from hermite_fe.kernels.stepping import step_length

Array = NDArray[np.float64]


@compiled_apart
def predict(problem: Problem, state: State, work: Work, t: float, h: float, theta: float) -> None:
    """work.b = h[F_θ − K(q + θhv) − Cv], the change of momentum of a step without Δv and without contact."""
    q, v, b, moved, part, force = state.q, state.v, work.b, work.d1, work.d2, work.d3
    n, known = q.size, 0
    for first in range(0, n, CHUNK):
        stop = min(first + CHUNK, n)
        count, reach = stop - first, min(stop + 3, n)
        new, old, rate = moved[known:reach], q[known:reach], v[known:reach]
        for i in range(reach - known):
            new[i] = old[i] + theta * h * rate[i]
        known = reach
        right = b[first:stop]
        stiff_rows(problem.K, problem.even, problem.odd, moved, first, stop, right)
        multiply_rows(problem.C, v, n, first, stop, part)
        force_rows(problem.load, t, h, theta, first, stop, force)
        for i in range(count):
            right[i] = h * (force[i] - right[i] - part[i])


@compiled_apart
def correct(problem: Problem, state: State, work: Work, t: float, h: float, theta: float) -> float:
    """q⁺ and v⁺ from Δv = work.x, and the energies that the step takes, booked. Returns the work of the loads."""
    q, v, dv, dq, vel = state.q, state.v, work.x, work.d1, work.b
    part, force, lost = work.d2, work.d3, work.lost
    n, known = q.size, 0
    kinetic, strain, work_done = 0.0, 0.0, 0.0
    for cause in range(lost.size):
        lost[cause] = 0.0
    for first in range(0, n, CHUNK):
        stop = min(first + CHUNK, n)
        reach = min(stop + 3, n)
        motion, rate, jump = q[known:reach], v[known:reach], dv[known:reach]
        mean, change = vel[known:reach], dq[known:reach]
        for i in range(reach - known):
            mean[i] = rate[i] + theta * jump[i]
            change[i] = h * mean[i]
            motion[i] += change[i]
            rate[i] += jump[i]
        known = reach
        force_rows(problem.load, t, h, theta, first, stop, force)
        work_done += dot(force[: stop - first], vel[first:stop])
        kinetic += quadratic_rows(problem.M, dv, first, stop)
        for cause in range(lost.size):
            lost[cause] += quadratic_rows(problem.parts[cause], vel, first, stop)
        stiff_rows(problem.K, problem.even, problem.odd, dq, first, stop, part)
        strain += dot(part[: stop - first], dq[first:stop])
    add(state.budget, WORK, h * work_done)
    add(state.budget, ALGORITHMIC, (theta - 0.5) * kinetic)
    add(state.budget, ALGORITHMIC, (theta - 0.5) * strain)
    for cause in range(lost.size):
        add(state.budget, problem.slots[cause], h * lost[cause])
    return work_done


@compiled_in_place
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
    dofs, factors, gap0 = problem.dofs, problem.factors, problem.gap
    q, v, closed = state.q, state.v, state.closed
    dv, p, target, candidate, held = work.x, work.p, work.target, work.candidate, work.held
    gap, speed = work.gap, work.speed
    n, m = q.size, closed.size
    for k in range(first, last):
        t = times[k]
        h = step_length(times, k, work.made_with)
        fresh = work.made_with[0] != h
        if fresh:
            combine(problem.M, problem.C, problem.K, 1.0, theta * h, theta * theta * h * h, problem.place, work.S)
            work.made_with[0] = h
        predict(problem, state, work, t, h, theta)

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
        work_done = correct(problem, state, work, t, h, theta)
        if not math.isfinite(work_done):
            return NOT_FINITE, k
    return SOLVED, last
