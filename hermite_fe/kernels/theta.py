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

from hermite_fe.kernels.ahead import carry, chosen_length, dofs_to_take, last_nonzero, moving
from hermite_fe.kernels.banded import CHUNK, add, combine, dot, quadratic_rows, stiff_rows
from hermite_fe.kernels.contact import force_rows, mark_held, row_times, rows_times_both
from hermite_fe.kernels.far_rows import largest, leave_alone, row_bound
from hermite_fe.kernels.jit import compiled_apart, compiled_in_place
from hermite_fe.kernels.pivoting import solve_part
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
from hermite_fe.kernels.rows import NOT_FINITE, SOLVED, TOO_SHORT
from hermite_fe.kernels.stepping import hand_back, step_length

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]


@compiled_in_place
def predict_rows(
    K: Array,
    even: Array,
    odd: Array,
    C: Array,
    damping_even: Array,
    damping_odd: Array,
    q: Array,
    v: Array,
    h: float,
    theta: float,
    first: int,
    stop: int,
    moved: Array,
    part: Array,
    b: Array,
) -> None:
    """Rows ``first`` … ``stop`` − 1 of b = −h[K(q + θhv) + Cv]; ``moved`` and ``part`` are scratch."""
    origin, reach = max(first - 3, 0), min(stop + 3, q.size)
    old, rate, right = q[origin:reach], v[origin:reach], b[first:stop]
    for i in range(reach - origin):
        moved[i] = old[i] + theta * h * rate[i]
    stiff_rows(K, even, odd, moved, origin, first, stop, right)
    stiff_rows(C, damping_even, damping_odd, v, 0, first, stop, part)
    for i in range(stop - first):
        right[i] = -h * (right[i] + part[i])


@compiled_in_place
def load_rows(
    load: Array, t: float, h: float, theta: float, first: int, stop: int, force: Array, b: Array
) -> None:
    """Add hF_θ to rows ``first`` … ``stop`` − 1 of b, the change of momentum of a step without Δv and without contact;
    ``force`` is scratch."""
    if load.shape[0] > 0:
        right = b[first:stop]
        force_rows(load, t, h, theta, first, stop, force)
        for i in range(stop - first):
            right[i] += h * force[i]


@compiled_apart
def predict(
    problem: Problem, state: State, work: Work, t: float, h: float, theta: float, first: int, stop: int
) -> None:
    """Rows ``first`` … ``stop`` − 1 of work.b = h[F_θ − K(q + θhv) − Cv]."""
    for start in range(first, stop, CHUNK):
        end = min(start + CHUNK, stop)
        predict_rows(
            problem.K,
            problem.even,
            problem.odd,
            problem.C,
            problem.damping_even,
            problem.damping_odd,
            state.q,
            state.v,
            h,
            theta,
            start,
            end,
            work.z,
            work.d3,
            work.b,
        )
        load_rows(problem.load, t, h, theta, start, end, work.d3, work.b)


@compiled_apart
def correct(
    problem: Problem,
    state: State,
    work: Work,
    t: float,
    h: float,
    theta: float,
    next_t: float,
    next_h: float,
    far: int,
    length: int,
) -> tuple[float, float, float]:
    """q⁺ and v⁺ of the first ``length`` dofs (and of three more, which move alike) from Δv = work.x, and the energies
    that the step takes, booked; and :func:`predict` for a step of length ``next_h`` (0: none), while q⁺ and v⁺ are at
    hand.

    Returns the sum of the energies, finite where the solution is, and bounds of how far rows moved, and how fast they
    are, whose dofs are all from ``far`` on.
    """
    q, v, dv, lost, mean, change, force = state.q, state.v, work.x, work.lost, work.d1, work.d2, work.d3
    n, known, origin, loaded = q.size, 0, 0, problem.load.shape[0] > 0
    kinetic, strain, work_done = 0.0, 0.0, 0.0
    deflection, slope, speed, turn = 0.0, 0.0, 0.0, 0.0
    for cause in range(lost.size):
        lost[cause] = 0.0
    for first in range(0, length, CHUNK):
        stop = min(first + CHUNK, length)
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
        if reach > far:
            begin = max(known, far)
            one, other = largest(new_change[begin - known : reach - known], begin)
            deflection, slope = max(deflection, one), max(slope, other)
            one, other = largest(rate[begin - known :], begin)
            speed, turn = max(speed, one), max(turn, other)
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
            predict(problem, state, work, next_t, next_h, theta, first, stop)
    add(state.budget, WORK, h * work_done)
    add(state.budget, ALGORITHMIC, (theta - 0.5) * kinetic)
    add(state.budget, ALGORITHMIC, (theta - 0.5) * strain)
    for cause in range(lost.size):
        add(state.budget, problem.slots[cause], h * lost[cause])
    moved, fastest = row_bound(problem.lever, deflection, slope), row_bound(problem.lever, speed, turn)
    return work_done + kinetic + strain, moved, fastest


@compiled_in_place
def swing(
    lever: Array, v: Array, dv: Array, h: float, theta: float, far: int, length: int, scratch: Array
) -> float:
    """Bound of how far rows move in the step, whose dofs are all from ``far`` on; from ``length`` on all move alike."""
    deflection, slope = 0.0, 0.0
    for first in range(far, length, CHUNK):
        stop = min(first + CHUNK, length)
        rate, jump = v[first:stop], dv[first:stop]
        for i in range(stop - first):
            scratch[i] = rate[i] + theta * jump[i]
        one, other = largest(scratch[: stop - first], first)
        deflection, slope = max(deflection, one), max(slope, other)
    return h * row_bound(lever, deflection, slope)


@compiled_apart
def look(
    dofs: Places,
    factors: Array,
    gap0: Array,
    restitution: float,
    q: Array,
    v: Array,
    h: float,
    theta: float,
    at_position: bool,
    held: Flags,
    gap: Array,
    speed: Array,
    candidate: Flags,
    target: Array,
) -> None:
    """Which rows are candidates, and the change of their velocities that they ask for; Gq in ``gap``, Gv in
    ``speed``."""
    rows_times_both(dofs, factors, q, v, gap, speed)
    if at_position:
        for j in range(dofs.shape[0]):
            candidate[j] = True
            target[j] = -((gap0[j] + gap[j]) / h + speed[j]) / theta
    else:
        for j in range(dofs.shape[0]):
            # where a row would come to rest if it were closed now
            candidate[j] = gap0[j] + gap[j] + (1.0 - theta) * h * speed[j] <= 0.0
            target[j] = -speed[j] if held[j] else -(1.0 + restitution) * speed[j]


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
    dofs, factors, q, v, closed = problem.dofs, problem.factors, state.q, state.v, state.closed
    b, dv, p, target, held, candidate = work.b, work.x, work.p, work.target, work.held, work.candidate
    gap0, gap, speed, e = problem.gap, work.gap, work.speed, law.restitution
    n, m = v.size, closed.size
    # rows from number ``rows`` on, whose dofs are all from ``far`` on, have gaps larger than ``clearance``
    rows, far, clearance, fastest = m, n, 0.0, 0.0
    length = n  # dofs that steps take: the others move alike
    status, k = SOLVED, first
    while k < last:
        t = times[k]
        h = step_length(times, k, work.made_with)
        fresh = work.made_with[0] != h
        mark_held(problem.rank, problem.side, law, closed, t, held)
        everything = rows == m or (not at_position and clearance <= (1.0 - theta) * h * fastest)
        if everything:
            carry(q, length + 3, n)
            rows = m
        look(
            dofs[:rows], factors[:rows], gap0, e, q, v, h, theta, at_position, held, gap, speed, candidate, target
        )
        if everything:
            rows, far, clearance = leave_alone(n, dofs, gap0, closed, gap, speed, h)
            candidate[rows:] = False
            taken = n
            if rows < m:
                needed = max(moving(problem.still, q, v), far + dofs.shape[1])
                taken = chosen_length(n, needed, work.length[0])
            b[length:taken] = 0.0
            length = taken
        if k == first:
            predict(problem, state, work, t, h, theta, 0, length)
        while True:
            fresh = fresh or work.length[0] != length
            if fresh:
                combine(
                    problem.M, problem.C, problem.K, 1.0, theta * h, theta * theta * h * h, work.place[:length], work.S
                )
                work.made_with[0], work.length[0] = h, length
            extent = last_nonzero(b, length)
            status = TOO_SHORT
            if length == n or extent < length:
                status = solve_part(problem, work, fresh, extent, closed, rows, length)
                fresh = False
            if status == SOLVED and at_position and rows < m:
                if clearance <= swing(problem.lever, v, dv, h, theta, far, length, work.d1):
                    carry(q, length + 3, n)
                    rows, far = m, n
                    look(dofs, factors, gap0, e, q, v, h, theta, at_position, held, gap, speed, candidate, target)
                    status = TOO_SHORT
            if status != TOO_SHORT:
                break
            longer = dofs_to_take(n, length) if rows < m else n
            carry(q, length + 3, min(longer + 3, n))
            b[length:longer] = 0.0
            length = longer
        if status != SOLVED:
            break

        for j in range(rows):
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
        total, moved, fastest = correct(problem, state, work, t, h, theta, times[k + 1], next_h, far, length)
        if not math.isfinite(total):
            status = NOT_FINITE
            break
        clearance -= moved
        k += 1
    hand_back(q, work.made_with, length, status)
    return status, k
