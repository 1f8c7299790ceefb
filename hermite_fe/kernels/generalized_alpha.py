"""Compiled generalised-α stepping (Chung & Hulbert) with unilateral rows.

    v⁺ = v + h(1 − γ)a + hγa⁺ + W,    q⁺ = q + hv + h²(½ − β)a + h²βa⁺ + U   (thesis 3.3.10–11)
    (1 − α_m)a⁺ + α_m a = (1 − α_f)v̇⁺ + α_f v̇                                                (3.3.12)

with the coefficients of (3.3.13–16). W and U are the jumps that the contact makes. With s = (1 − α_f)/(1 −
α_m), the part of a⁺ that is known, a* = (α_f v̇ − α_m a)/(1 − α_m), and the predictions v*, q* made with it,

    v⁺ = v* + hγs v̇⁺ + W,    q⁺ = q* + h²βs v̇⁺ + U.

Energy, per step (bars: means over the step, Δ: changes, p: the impulse of all reactions). The scheme misses
momentum and motion of the mean state by

    r_p = MΔv − h(F̄ − Cv̄ − Kq̄) − Gᵀp = h(½ − α_f)[MΔ(v̇ − a) − GᵀΔ(λ − λ_a)] + h[½J + ½J⁺ − E⁺],
    r_q = Δq − h v̄ = h²(β − ½γ)Δa + U − ½hW,                                    J = CW + KU,

λ_a the reactions λ through the filter of (3.3.12), J the forces of a step's jumps, which its v̇⁺ has not felt, E those
that the jump W was made with. From Δ(T + V) = v̄ᵀMΔv + q̄ᵀKΔq follows, exactly,

    Δ(T + V) = F̄ᵀΔq − h v̄ᵀCv̄ + pᵀGv̄ + v̄ᵀr_p + (Kq̄ − F̄)ᵀr_q:

work of loads, (minus) viscous losses, loss in impacts, algorithmic loss. The last is evaluated on the right-hand
sides of r_p and r_q, never as what the others leave, so that a wrong force, velocity or energy shows as a defect.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.ahead import carry, chosen_length, dofs_to_take, last_nonzero, moving
from hermite_fe.kernels.banded import CHUNK, combine, factor, multiply, multiply_rows, stiff_rows
from hermite_fe.kernels.contact import force_rows, mark_held, row_times, rows_times, rows_times_both
from hermite_fe.kernels.far_rows import largest, leave_alone, row_bound
from hermite_fe.kernels.jit import compiled, compiled_apart, compiled_in_place
from hermite_fe.kernels.pivoting import solve_part, solve_rows
from hermite_fe.kernels.problem import PRODUCT, SMALLEST_REACTION, ContactLaw, Problem, State, Work
from hermite_fe.kernels.rows import NOT_FINITE, SINGULAR, SOLVED, TOO_SHORT
from hermite_fe.kernels.stepping import (
    book_step,
    hand_back,
    initial_acceleration,
    residual_force,
    residual_rows,
    step_length,
)

Flags = NDArray[np.bool_]
Array = NDArray[np.float64]
AT_REST = 1e-10  # of the largest velocity: a closed row slower than this has not rebounded


class Scheme(NamedTuple):
    """Coefficients of (3.3.13–16), and s = (1 − α_f)/(1 − α_m)."""

    alpha_m: float
    alpha_f: float
    gamma: float
    beta: float
    s: float


@compiled_in_place
def scheme_of(spectral_radius: float) -> Scheme:
    """The coefficients for ρ∞."""
    alpha_m = (2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0)
    alpha_f = spectral_radius / (spectral_radius + 1.0)
    gamma = 0.5 + alpha_f - alpha_m
    return Scheme(alpha_m, alpha_f, gamma, 0.25 * (gamma + 0.5) ** 2, (1.0 - alpha_f) / (1.0 - alpha_m))


@compiled_in_place
def combine_smooth(scheme: Scheme, problem: Problem, h: float, work: Work, length: int) -> None:
    """work.S = M + hγsC + h²βsK, the matrix of v̇⁺, for the first ``length`` dofs."""
    _, _, gamma, beta, s = scheme
    combine(problem.M, problem.C, problem.K, 1.0, h * gamma * s, h * h * beta * s, work.place[:length], work.S)
    work.made_with[0], work.length[0] = h, length


class Kept(NamedTuple):
    """What a step keeps of its start: q, v, a*, v̇ − a and λ − λ_a; and what it builds up: r_q in ``slip``, J in
    ``jump``, ½J − E in ``missed``."""

    q: Array
    v: Array
    predicted: Array
    lag: Array
    row_lag: Array
    slip: Array
    jump: Array
    missed: Array


@compiled
def kept_of(n: int, m: int) -> Kept:
    """Work space for n dofs and m rows."""
    return Kept(np.empty(n), np.empty(n), np.empty(n), np.empty(n), np.zeros(m), np.empty(n), np.zeros(n), np.zeros(n))


@compiled_apart
def predict(scheme: Scheme, state: State, h: float, kept: Kept, reach: int) -> None:
    """Keep the start of the step and put q*, v* in place of q, v; ``slip`` starts as −h²(β − ½γ)a. All of the first
    ``reach`` dofs."""
    alpha_m, alpha_f, gamma, beta, _ = scheme
    q, v, a, rate = state.q, state.v, state.a, state.acceleration
    for i in range(reach):
        known = (alpha_f * rate[i] - alpha_m * a[i]) / (1.0 - alpha_m)
        kept.q[i] = q[i]
        kept.v[i] = v[i]
        kept.predicted[i] = known
        kept.lag[i] = rate[i] - a[i]
        kept.slip[i] = -h * h * (beta - 0.5 * gamma) * a[i]
        q[i] += h * v[i] + h * h * ((0.5 - beta) * a[i] + beta * known)
        v[i] += h * ((1.0 - gamma) * a[i] + gamma * known)


@compiled_apart
def correct(scheme: Scheme, state: State, h: float, rate: Array, kept: Kept, length: int) -> None:
    """v̇⁺ = rate and the a⁺, q⁺, v⁺ that follow from it and from what :func:`predict` kept; jumps are not in them."""
    _, _, gamma, beta, s = scheme
    q, v, a = state.q, state.v, state.a
    for i in range(length):
        a_old = a[i]
        state.acceleration[i] = rate[i]
        a[i] = kept.predicted[i] + s * rate[i]
        q[i] = kept.q[i] + h * kept.v[i] + h * h * ((0.5 - beta) * a_old + beta * a[i])
        v[i] = kept.v[i] + h * ((1.0 - gamma) * a_old + gamma * a[i])
        kept.slip[i] += h * h * (beta - 0.5 * gamma) * a[i]


@compiled_in_place
def react(scheme: Scheme, state: State, h: float, j: int, force: float, kept: Kept, impulse: Array) -> None:
    """Row j's reaction at the end of the step is ``force``; its impulse over the step goes to impulse[j], through the
    same filter as v̇."""
    alpha_m, alpha_f, gamma, _, s = scheme
    kept.row_lag[j] = state.reaction[j] - state.reaction_a[j]
    known = (alpha_f * state.reaction[j] - alpha_m * state.reaction_a[j]) / (1.0 - alpha_m)
    impulse[j] = h * (1.0 - gamma) * state.reaction_a[j]
    state.reaction[j] = force
    state.reaction_a[j] = known + s * force
    impulse[j] += h * gamma * state.reaction_a[j]


@compiled_apart
def lengthen(state: State, kept: Kept, first: Work, second: Work, length: int, longer: int) -> None:
    """In the middle of a step, take ``longer`` dofs in place of ``length``: those added move as the beam ahead."""
    stop = min(longer + 3, state.q.size)
    carry(state.q, length + 3, stop)
    carry(kept.q, length + 3, stop)
    for i in range(length + 3, stop):
        kept.v[i] = state.v[i]
        kept.predicted[i] = kept.lag[i] = kept.slip[i] = kept.jump[i] = kept.missed[i] = 0.0
    first.b[length:longer] = 0.0
    second.b[length:longer] = 0.0


@compiled_apart
def solve_growing(
    scheme: Scheme,
    problem: Problem,
    state: State,
    smooth: Work,
    work: Work,
    kept: Kept,
    h: float,
    extent: int,
    closed: Flags,
    rows: int,
    length: int,
) -> tuple[int, int]:
    """:func:`solve_part` with as many dofs as it takes, whose matrix is made where it is not there yet. ``smooth`` and
    ``work`` are the works of the step. Returns the status and how many."""
    n = state.q.size
    while True:
        fresh = smooth.made_with[0] != h or smooth.length[0] != length
        if fresh:
            combine_smooth(scheme, problem, h, smooth, length)
        status = TOO_SHORT
        if length == n or extent < length:
            status = solve_part(problem, work, fresh, extent, closed, rows, length)
        elif fresh:
            smooth.made_with[0] = math.nan  # no factors were made
        if status != TOO_SHORT:
            return status, length
        longer = dofs_to_take(n, length)
        lengthen(state, kept, smooth, work, length, longer)
        length = longer


@compiled_apart
def dofs_that_move(problem: Problem, state: State, needed: int, made_for: int) -> int:
    """:func:`chosen_length` where ``needed`` dofs may touch the wall: beyond those that are taken the beam moves as a
    whole, and nothing accelerates it."""
    needed = max(needed, moving(problem.still, state.q, state.v))
    for x in (state.a, state.acceleration, state.jump):
        needed = max(needed, last_nonzero(x, x.size))
    return chosen_length(state.q.size, needed, made_for)


@compiled_apart
def account(
    scheme: Scheme,
    problem: Problem,
    state: State,
    kept: Kept,
    work: Work,
    t: float,
    h: float,
    impulse: Array,
    filtered: bool,
    far: int,
    length: int,
) -> tuple[bool, float, float]:
    """Book a step by the sums in the module's head. Returns whether they are finite, and bounds of how far rows moved,
    and how fast they are, whose dofs are all from ``far`` on.

    kept : the start of the step, with ``slip``, ``jump`` and ``missed`` of this one. impulse : of all reactions over
        the step. filtered : reactions of v̇ went through its filter. length : dofs from which on all move alike.
    """
    q, v, old_q, old_v, lag = state.q, state.v, kept.q, kept.v, kept.lag
    mean_v, force, product = work.d1, work.d2, work.d3
    half, reach = 0.5 - scheme.alpha_f, min(length + 3, state.q.size)
    gain, momentum, deflection, slope, speed, turn = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(reach):
        mean_v[i] = 0.5 * (v[i] + old_v[i])
        old_v[i] = 0.5 * (q[i] + old_q[i])
        old_q[i] = q[i] - old_q[i]
        lag[i] = (state.acceleration[i] - state.a[i]) - lag[i]
    if far < reach:
        deflection, slope = largest(old_q[far:reach], far)
        speed, turn = largest(v[far:reach], far)
    for first in range(0, length, CHUNK):
        stop = min(first + CHUNK, length)
        part, loads, slip = product[first:stop], force[first:stop], kept.slip[first:stop]
        stiff_rows(problem.K, problem.even, problem.odd, old_v, 0, first, stop, part)
        force_rows(problem.load, t, h, 0.5, first, stop, loads)
        for i in range(stop - first):
            gain += (part[i] - loads[i]) * slip[i]
        multiply_rows(problem.M, lag, q.size, first, stop, part)
        mean, old_jump, jump, missed = mean_v[first:stop], state.jump[first:stop], kept.jump[first:stop], kept.missed
        for i in range(stop - first):
            momentum += mean[i] * (half * part[i] + 0.5 * old_jump[i] + missed[first + i])
            old_jump[i] = jump[i]
    if filtered:
        for j in range(impulse.size):
            change = state.reaction[j] - state.reaction_a[j] - kept.row_lag[j]
            if change != 0.0:
                momentum -= half * change * row_times(problem.dofs, problem.factors, mean_v, j)
    book_step(problem, state, h, force[:length], old_q[:length], mean_v, impulse, -gain - h * momentum)
    finite = math.isfinite(gain) and math.isfinite(momentum)
    return finite, row_bound(problem.lever, deflection, slope), row_bound(problem.lever, speed, turn)


@compiled
def velocity_steps(
    problem: Problem,
    law: ContactLaw,
    state: State,
    smooth: Work,
    velocity: Work,
    times: Array,
    first: int,
    last: int,
    spectral_radius: float,
) -> tuple[int, int]:
    """Rows at velocity level only.

    smooth :    M v̇⁺ + C ṽ + K q̃ = F⁺, the motion without reactions
    velocity :  (M + hγsC + h²βsK)W = Gᵀp,  U = h(β/γ)W (½hW at ρ∞ = 1),   0 ≤ p ⊥ Gv⁺ + eGv ≥ 0

    The jump takes along the elastic forces that it raises within the step: with M W = Gᵀp alone the next
    smooth accelerations would have to undo them, which a stiff beam does not survive.
    """
    scheme = scheme_of(spectral_radius)
    gamma, beta, s = scheme.gamma, scheme.beta, scheme.s
    q, v, a, rate, closed = state.q, state.v, state.a, state.acceleration, state.closed
    dofs, factors, work = problem.dofs, problem.factors, velocity
    n, m = q.size, closed.size
    kept = kept_of(n, m)
    none = np.zeros(m, np.bool_)
    if first == 0:
        status = initial_acceleration(problem, state, smooth)
        if status != SOLVED:
            return status, 0
    # as in hermite_fe.kernels.theta
    rows, far, clearance, fastest, length = m, n, 0.0, 0.0, n
    status, k = SOLVED, first
    while k < last:
        t = times[k]
        h = step_length(times, k, smooth.made_with)
        if rows == m or clearance <= h * (1.0 - beta / gamma) * fastest:
            carry(q, length + 3, n)
            rows_times_both(dofs, factors, q, v, work.gap, work.speed)
            rows, far, clearance = leave_alone(n, dofs, problem.gap, closed, work.gap, work.speed, h)
            work.candidate[rows:] = False
            length = dofs_that_move(problem, state, far + dofs.shape[1], smooth.length[0]) if rows < m else n
        else:
            rows_times_both(dofs[:rows], factors[:rows], q, v, work.gap, work.speed)
        mark_held(problem.rank, problem.side, law, closed, t, work.held)
        for j in range(rows):
            # where a row would come to rest if it were closed now
            work.candidate[j] = problem.gap[j] + work.gap[j] + h * (1.0 - beta / gamma) * work.speed[j] <= 0.0
        predict(scheme, state, h, kept, min(length + 3, n))
        residual_rows(problem, t + h, q, v, smooth.b, smooth.d1, length)
        extent = last_nonzero(smooth.b, length)
        status, length = solve_growing(
            scheme, problem, state, smooth, smooth, kept, h, extent, none, rows, length
        )
        if status != SOLVED:
            break
        for i in range(length):
            rate[i] = smooth.x[i]
            a[i] = kept.predicted[i] + s * rate[i]
            q[i] += h * h * beta * s * rate[i]
            v[i] += h * gamma * s * rate[i]
        rows_times(dofs[:rows], factors[:rows], v, work.gap)
        for j in range(rows):
            rebound = 0.0 if work.held[j] else law.restitution
            work.target[j] = -work.gap[j] - rebound * work.speed[j]
        status, length = solve_growing(scheme, problem, state, smooth, work, kept, h, 0, closed, rows, length)
        if status != SOLVED:
            break
        for j in range(rows):
            if closed[j]:
                p = work.p[j]
                if work.held[j]:
                    state.held_impulse[j] += min(p, 0.0)
                else:
                    state.worst[SMALLEST_REACTION] = min(state.worst[SMALLEST_REACTION], p)
                slack = row_times(dofs, factors, work.x, j) - work.target[j]
                state.worst[PRODUCT] = max(state.worst[PRODUCT], abs(p * slack))
        end, reach = min(work.extent[0] + 3, n), min(length + 3, n)
        multiply(problem.K, work.x, kept.jump, end)
        multiply(problem.C, work.x, work.d1, end)
        for i in range(end):
            kept.jump[i] = h * (beta / gamma) * kept.jump[i] + work.d1[i]
            kept.missed[i] = (0.5 - gamma * s) * kept.jump[i]
            kept.slip[i] += h * (beta / gamma - 0.5) * work.x[i]
            q[i] += h * (beta / gamma) * work.x[i]
            v[i] += work.x[i]
        kept.jump[end:reach] = 0.0
        kept.missed[end:reach] = 0.0
        for i in range(length):
            kept.slip[i] += h * h * (beta - 0.5 * gamma) * a[i]
        finite, moved, fastest = account(
            scheme, problem, state, kept, work, t, h, work.p[:rows], False, far, length
        )
        if not finite:
            status = NOT_FINITE
            break
        clearance -= moved
        k += 1
    hand_back(q, smooth.made_with, length, status)
    return status, k


@compiled_apart
def aim(problem: Problem, state: State, position: Work, rows: int) -> None:
    """Have the first ``rows`` rows ask that their gaps do not become negative."""
    rows_times(problem.dofs[:rows], problem.factors[:rows], state.q, position.gap)
    for j in range(rows):
        position.candidate[j] = True
        position.target[j] = -(problem.gap[j] + position.gap[j])


@compiled_apart
def swing(problem: Problem, state: State, jump: Array, kept: Kept, far: int, length: int) -> float:
    """Bound of how far rows are from where they were at the start of the step, whose dofs are all from ``far`` on."""
    scratch = kept.jump
    for i in range(far, length):
        scratch[i] = state.q[i] + jump[i] - kept.q[i]
    deflection, slope = largest(scratch[far:length], far)
    return row_bound(problem.lever, deflection, slope)


@compiled
def sequential_steps(
    problem: Problem,
    law: ContactLaw,
    state: State,
    smooth: Work,
    position: Work,
    velocity: Work,
    times: Array,
    first: int,
    last: int,
    spectral_radius: float,
    with_acceleration: bool,
) -> tuple[int, int]:
    """Rows at position and velocity level and, for smooth reactions, at acceleration level, one after the
    other.

    smooth :    M v̇⁺ + C ṽ + K q̃ = F⁺ + Gᵀλ,   0 ≤ λ ⊥ Gv̇⁺ ≥ 0 for rows at rest on the wall
        (with_acceleration; else λ = 0)
    position :  (M + hγsC + h²βsK)U = Gᵀν,                 0 ≤ ν ⊥ g(q̃ + U) ≥ 0                (after 3.2.19)
    velocity :  (M + hγsC + h²βsK)W = −hKU + Gᵀ(p − p_λ),  0 ≤ p ⊥ Gv⁺ + eGv ≥ 0               (after 3.2.20)
        for rows closed at position, or with λ > 0; p = 0 in the others

    p_λ is the impulse of λ, through the same filter as v̇, p that of the whole step: momentum is exact. Signorini's
    condition is asked of p, not of what has to be added to p_λ: so a reaction that the filter trails cannot push a row
    that has left, and for e = 0 the wall does work only where it catches a row that was leaving. The jump raises
    elastic forces within the step, as in :func:`velocity_steps`. With (3.2.20) as it stands, M W = −hKU − hCW + GᵀΛ and
    0 ≤ Λ, an undamped beam whose shortest waves the steps do not resolve gains energy from the wall (1.8 times the
    initial one at κ/ν = 0.1, 50 elements, h = 1e-3 T*).
    """
    scheme = scheme_of(spectral_radius)
    q, v, closed, resting = state.q, state.v, state.closed, state.resting
    dofs, factors = problem.dofs, problem.factors
    n, m = q.size, closed.size
    kept, impulse, taking_part = kept_of(n, m), np.zeros(m), np.zeros(m, np.bool_)
    if first == 0:
        status = initial_acceleration(problem, state, velocity)
        if status != SOLVED:
            return status, 0
    # as in hermite_fe.kernels.theta
    rows, far, clearance, length = m, n, 0.0, n
    status, k = SOLVED, first
    while k < last:
        t = times[k]
        h = step_length(times, k, smooth.made_with)
        if rows == m:
            carry(q, length + 3, n)
            rows_times_both(dofs, factors, q, v, position.gap, velocity.speed)
            for j in range(m):  # a reaction goes on in its filter when its row has opened
                reacting = state.reaction[j] != 0.0 or state.reaction_a[j] != 0.0
                taking_part[j] = closed[j] or resting[j] or reacting
            gap, speed = position.gap, velocity.speed
            rows, far, clearance = leave_alone(n, dofs, problem.gap, taking_part, gap, speed, h)
            length = dofs_that_move(problem, state, far + dofs.shape[1], smooth.length[0]) if rows < m else n
            for work in (smooth, position, velocity):
                work.candidate[rows:] = False
            impulse[rows:] = 0.0
        mark_held(problem.rank, problem.side, law, closed, t, position.held)
        rows_times(dofs[:rows], factors[:rows], v, velocity.speed)

        predict(scheme, state, h, kept, min(length + 3, n))
        residual_rows(problem, t + h, q, v, smooth.b, smooth.d1, length)
        for j in range(rows):
            smooth.candidate[j] = with_acceleration and resting[j]
            smooth.held[j] = smooth.candidate[j] and position.held[j]
            smooth.target[j] = 0.0
        extent = last_nonzero(smooth.b, length)
        status, length = solve_growing(
            scheme, problem, state, smooth, smooth, kept, h, extent, resting, rows, length
        )
        if status != SOLVED:
            break
        correct(scheme, state, h, smooth.x, kept, length)
        for j in range(rows):
            react(scheme, state, h, j, smooth.p[j], kept, impulse)

        aim(problem, state, position, rows)
        status, length = solve_growing(
            scheme, problem, state, smooth, position, kept, h, 0, closed, rows, length
        )
        if status == SOLVED and rows < m and clearance <= swing(problem, state, position.x, kept, far, length):
            lengthen(state, kept, position, velocity, length, n)
            rows, far, length = m, n, n
            rows_times(dofs, factors, kept.v, velocity.speed)
            aim(problem, state, position, rows)
            status, length = solve_growing(
                scheme, problem, state, smooth, position, kept, h, 0, closed, rows, length
            )
        if status != SOLVED:
            break

        end, reach = min(position.extent[0] + 3, n), min(length + 3, n)
        multiply(problem.K, position.x, kept.jump, end)
        for i in range(end):
            q[i] += position.x[i]
            kept.slip[i] += position.x[i]
            kept.missed[i] = -0.5 * kept.jump[i]
            velocity.b[i] = -h * kept.jump[i]
        kept.jump[end:reach] = 0.0
        kept.missed[end:reach] = 0.0
        velocity.b[end:reach] = 0.0
        rows_times(dofs[:rows], factors[:rows], v, velocity.gap)
        fastest = 0.0
        for j in range(rows):
            fastest = max(fastest, abs(velocity.gap[j]))
        for j in range(rows):
            velocity.candidate[j] = closed[j] or smooth.p[j] > 0.0
            if impulse[j] != 0.0:
                for i in range(dofs.shape[1]):
                    velocity.b[dofs[j, i]] -= factors[j, i] * impulse[j]
                    end = max(end, dofs[j, i] + 1)
            velocity.held[j] = position.held[j]
            rebound = 0.0 if velocity.held[j] else law.restitution
            velocity.target[j] = -velocity.gap[j] - rebound * velocity.speed[j]
            resting[j] = velocity.candidate[j]
        status, length = solve_growing(
            scheme, problem, state, smooth, velocity, kept, h, end, resting, rows, length
        )
        if status != SOLVED:
            break
        end = min(velocity.extent[0] + 3, n)
        multiply(problem.K, velocity.x, velocity.d1, end)
        for i in range(end):
            kept.missed[i] -= h * scheme.beta * scheme.s * velocity.d1[i]
            kept.slip[i] -= 0.5 * h * velocity.x[i]
            v[i] += velocity.x[i]
        if problem.slots.size > 0:
            multiply(problem.C, velocity.x, velocity.d1, end)
            for i in range(end):
                kept.missed[i] += (0.5 - scheme.gamma * scheme.s) * velocity.d1[i]
                kept.jump[i] += velocity.d1[i]
        for j in range(rows):
            impulse[j] = velocity.p[j]
            if closed[j]:
                p = velocity.p[j]
                if position.held[j]:
                    state.held_impulse[j] += min(impulse[j], 0.0)
                else:
                    worst = min(min(p, h * smooth.p[j]), position.p[j] / h)
                    state.worst[SMALLEST_REACTION] = min(state.worst[SMALLEST_REACTION], worst)
                slack = row_times(dofs, factors, velocity.x, j) - velocity.target[j]
                gap = row_times(dofs, factors, position.x, j) - position.target[j]
                product = abs(p * slack) if resting[j] else 0.0
                state.worst[PRODUCT] = max(state.worst[PRODUCT], max(product, abs(position.p[j] * gap) / (h * h)))
            rebounding = row_times(dofs, factors, v, j) if resting[j] else 0.0
            resting[j] = resting[j] and abs(rebounding) <= AT_REST * fastest
        finite, moved, _ = account(
            scheme, problem, state, kept, velocity, t, h, impulse[:rows], True, far, length
        )
        if not finite:
            status = NOT_FINITE
            break
        clearance -= moved
        k += 1
    hand_back(q, smooth.made_with, length, status)
    return status, k


@compiled
def penalty_steps(
    problem: Problem,
    state: State,
    work: Work,
    times: Array,
    first: int,
    last: int,
    spectral_radius: float,
    stiffness: float,
    damping: float,
    rounds: int,
) -> tuple[int, int]:
    """Rows as springs and dampers on penetration: M v̇⁺ + Cv⁺ + Kq⁺ = F⁺ − Gᵀ(k g + d ġ)⁺ where g⁺ ≤ 0.

    Rows touch one dof each. Which ones are in touch is settled by re-solving, at most ``rounds`` times, as
    Exudyn's discontinuous iteration does; a damper may pull while its row is in touch.
    """
    scheme = scheme_of(spectral_radius)
    gamma, beta, s = scheme.gamma, scheme.beta, scheme.s
    q, v, closed = state.q, state.v, state.closed
    dofs, factors = problem.dofs, problem.factors
    n, m = q.size, closed.size
    kept, right = kept_of(n, m), np.empty(n)
    touching = state.resting  # as the factors know them
    none = np.zeros(m, np.bool_)
    if first == 0:
        status = initial_acceleration(problem, state, work)
        if status != SOLVED:
            return status, 0
    for k in range(first, last):
        t = times[k]
        h = step_length(times, k, work.made_with)
        fresh = work.made_with[0] != h
        if fresh:
            combine_smooth(scheme, problem, h, work, n)
            for j in range(m):
                touching[j] = False
        predict(scheme, state, h, kept, n)
        residual_force(problem, t + h, q, v, right, work.d1)
        rows_times(dofs, factors, q, work.gap)
        rows_times(dofs, factors, v, work.speed)
        for attempt in range(rounds + 1):
            top = -1
            for i in range(n):
                work.b[i] = right[i]
            for j in range(m):
                d, g = dofs[j, 0], factors[j, 0]
                spring, damper = stiffness * problem.tributary[j], damping * problem.tributary[j]
                if closed[j] != touching[j]:
                    sign = 1.0 if closed[j] else -1.0
                    work.S[d, 0] += sign * g * g * (h * h * beta * s * spring + h * gamma * s * damper)
                    touching[j] = closed[j]
                    top = max(top, d)
                if closed[j]:
                    work.b[d] -= g * (spring * (problem.gap[j] + work.gap[j]) + damper * work.speed[j])
            if not fresh and top >= 0:
                if not factor(work.S, work.fixed, top, top + 1, -1, work.D, work.U):
                    work.made_with[0] = math.nan
                    return SINGULAR, k
            status = solve_rows(problem, work, fresh, n, none)
            if status != SOLVED:
                work.made_with[0] = math.nan
                return status, k
            fresh = False
            changed = False
            for j in range(m):
                new = problem.gap[j] + work.gap[j] + h * h * beta * s * factors[j, 0] * work.x[dofs[j, 0]]
                work.wrong[j] = (new <= 0.0) != closed[j]
                changed = changed or work.wrong[j]
            if not changed or attempt == rounds:
                break
            for j in range(m):
                if work.wrong[j]:
                    closed[j] = not closed[j]
        correct(scheme, state, h, work.x, kept, n)
        for j in range(m):
            d, g = dofs[j, 0], factors[j, 0]
            spring, damper = stiffness * problem.tributary[j], damping * problem.tributary[j]
            force = 0.0
            if closed[j]:
                force = -spring * (problem.gap[j] + g * q[d]) - damper * g * v[d]
            react(scheme, state, h, j, force, kept, work.p)
            state.worst[SMALLEST_REACTION] = min(state.worst[SMALLEST_REACTION], h * force)
            if closed[j]:
                gap = problem.gap[j] + g * q[d]
                state.worst[PRODUCT] = max(state.worst[PRODUCT], abs(h * force * gap))
        if not account(scheme, problem, state, kept, work, t, h, work.p, True, n, n)[0]:
            return NOT_FINITE, k
    return SOLVED, last
