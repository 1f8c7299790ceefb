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
from hermite_fe.kernels.contact import force_rows, mark_held, row_times, rows_times_both
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


@compiled_in_place
def predict_rows(problem: Problem, state: State, work: Work, h: float, theta: float, first: int, stop: int) -> None:
    """Rows ``first`` … ``stop`` − 1 of work.b = −h[K(q + θhv) + Cv]."""
    q, v, moved, part = state.q, state.v, work.z, work.d3
    origin, reach = max(first - 3, 0), min(stop + 3, q.size)
    old, rate, right = q[origin:reach], v[origin:reach], work.b[first:stop]
    for i in range(reach - origin):
        moved[i] = old[i] + theta * h * rate[i]
    stiff_rows(problem.K, problem.even, problem.odd, moved, origin, first, stop, right)
    multiply_rows(problem.C, v, q.size, first, stop, part)
    for i in range(stop - first):
        right[i] = -h * (right[i] + part[i])


@compiled_in_place
def load_rows(problem: Problem, work: Work, t: float, h: float, theta: float, first: int, stop: int) -> None:
    """Add hF_θ to rows ``first`` … ``stop`` − 1 of work.b, the change of momentum of a step without Δv and without
    contact."""
    if problem.load.shape[0] > 0:
        right, force = work.b[first:stop], work.d3
        force_rows(problem.load, t, h, theta, first, stop, force)
        for i in range(stop - first):
            right[i] += h * force[i]


@compiled_apart
def predict(problem: Problem, state: State, work: Work, t: float, h: float, theta: float) -> None:
    """work.b = h[F_θ − K(q + θhv) − Cv]."""
    n = state.q.size
    for first in range(0, n, CHUNK):
        stop = min(first + CHUNK, n)
        predict_rows(problem, state, work, h, theta, first, stop)
        load_rows(problem, work, t, h, theta, first, stop)


@compiled_apart
def correct(
    problem: Problem, state: State, work: Work, t: float, h: float, theta: float, next_t: float, next_h: float
) -> float:
    """q⁺ and v⁺ from Δv = work.x, and the energies that the step takes, booked; and :func:`predict` for a step of
    length ``next_h`` (0: none), while q⁺ and v⁺ are at hand. Returns the sum of the energies: finite where the solution
    is."""
    q, v, dv, lost, mean, change, force = state.q, state.v, work.x, work.lost, work.d1, work.d2, work.d3
    n, known, origin, loaded = q.size, 0, 0, problem.load.shape[0] > 0
    kinetic, strain, work_done = 0.0, 0.0, 0.0
    for cause in range(lost.size):
        lost[cause] = 0.0
    for first in range(0, n, CHUNK):
        stop = min(first + CHUNK, n)
        start, reach, count = max(first - 3, 0), min(stop + 3, n), stop - first
        there = known - start  # of the rows before
        for i in range(there):
            mean[i], change[i] = mean[start - origin + i], change[start - origin + i]
        origin = start
        motion, rate, jump = q[known:reach], v[known:reach], dv[known:reach]
        new_mean, new_change = mean[there : reach - start], change[there : reach - start]
        for i in range(reach - known):
            new_mean[i] = rate[i] + theta * jump[i]
            new_change[i] = h * new_mean[i]
            motion[i] += new_change[i]
            rate[i] += jump[i]
        known = reach
        if loaded:
            force_rows(problem.load, t, h, theta, first, stop, force)
            work_done += dot(force[:count], mean[first - origin : stop - origin])
        kinetic += quadratic_rows(problem.M, dv, 0, first, stop)
        for cause in range(lost.size):
            lost[cause] += quadratic_rows(problem.parts[cause], mean, origin, first, stop)
        stiff_rows(problem.K, problem.even, problem.odd, change, origin, first, stop, force)
        strain += dot(force[:count], change[first - origin : stop - origin])
        if next_h > 0.0:
            predict_rows(problem, state, work, next_h, theta, first, stop)
            load_rows(problem, work, next_t, next_h, theta, first, stop)
    add(state.budget, WORK, h * work_done)
    add(state.budget, ALGORITHMIC, (theta - 0.5) * kinetic)
    add(state.budget, ALGORITHMIC, (theta - 0.5) * strain)
    for cause in range(lost.size):
        add(state.budget, problem.slots[cause], h * lost[cause])
    return work_done + kinetic + strain


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
            combine(problem.M, problem.C, problem.K, 1.0, theta * h, theta * theta * h * h, work.place, work.S)
            work.made_with[0] = h
        if k == first:
            predict(problem, state, work, t, h, theta)

        mark_held(problem, law, closed, t, held)
        rows_times_both(dofs, factors, q, v, gap, speed)
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
        next_h = step_length(times, k + 1, work.made_with) if k + 1 < last else 0.0
        if not math.isfinite(correct(problem, state, work, t, h, theta, times[k + 1], next_h)):
            return NOT_FINITE, k
    return SOLVED, last
