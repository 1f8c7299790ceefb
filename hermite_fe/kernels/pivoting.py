"""Compiled active-set solution of a banded linear complementarity problem

    S x = b + Gᵀ p,      0 ≤ p ⊥ G x − c ≥ 0,      x = 0 at supports,

by block principal pivoting: guess which rows are closed (G x = c), solve, exchange every row whose sign is
wrong, repeat. Exchanging all at once takes two or three rounds; should the number of wrong rows stop falling,
one row at a time is exchanged (Murty's rule), which cannot cycle for a positive definite S (Júdice & Pires
1994, Comput. Oper. Res. 21, 587).

A row that touches one dof fixes it when closed, and p is what is left over in that dof's equation. A row that
touches several has a multiplier −p among the unknowns, fixed at 0 while open. Either way a switch changes the
factors from there inwards only (:mod:`hermite_fe.kernels.banded`), so a round costs the contact zone, not the beam.
A *held* row is closed whatever the sign of p; a row that is no *candidate* is open.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.banded import back_substitute, factor, fade_out, forward_substitute
from hermite_fe.kernels.jit import compiled
from hermite_fe.kernels.problem import Problem, Work

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

SOLVED, SINGULAR, CYCLING, NOT_FINITE = 0, 1, 2, 3
PATIENCE = 8  # rounds of block exchange without progress before Murty's rule
ROUND_OFF = 1e-13  # of the terms summed: below it a wrong sign means nothing
LENIENT_AFTER = 40  # rounds, and one more a row: nearly degenerate rows are then judged ten times more leniently
COARSEST = 1e-8
MARGIN = 64  # unknowns beyond the closed rows that every round looks at; the rest of the beam is looked at last
FADED = 1e-100  # of the largest unknown: what is smaller, and beyond all loads, is taken as zero


@compiled
def is_slope(dof: int) -> bool:
    """Deflections and slopes take turns among the dofs, as in :func:`hermite_fe.kernels.banded.row_sums`. (Not an array
    of :class:`Problem`: to look it up costs a step 1–3 %.)"""
    return dof % 2 == 1


@compiled
def equation(S: Array, x: Array, right: float, k: int) -> tuple[float, float]:
    """Equation k of S x less its right-hand side, and the sum of the terms' sizes: round-off is judged against it."""
    n = x.size
    term = S[k, 0] * x[k]
    total, size = term - right, abs(term) + abs(right)
    for m in range(1, 5):
        if k >= m:
            term = S[k, m] * x[k - m]
            total += term
            size += abs(term)
        if k + m < n:
            term = S[k + m, m] * x[k + m]
            total += term
            size += abs(term)
    return total, size


@compiled
def right_side(
    S: Array,
    b: Array,
    place: NDArray[np.int64],
    fixed: Flags,
    switch: NDArray[np.int64],
    factors: Array,
    target: Array,
    closed: Flags,
    last_row: int,
    end: int,
    r: Array,
) -> None:
    """Right-hand side of the first ``end`` unknowns, rows 0 … ``last_row`` closed as ``closed`` says."""
    direct = factors.shape[1] == 1
    n = r.size
    for i in range(b.size):
        k = place[i]
        if k >= end:
            break
        r[k] = 0.0 if fixed[k] else b[i]
    if not direct:
        for j in range(last_row + 1):
            k = switch[j]
            if k < end:
                r[k] = target[j] if closed[j] else 0.0
        return
    for j in range(last_row + 1):
        if not closed[j]:
            continue
        k = switch[j]
        if k >= end + 4:
            break
        value = target[j] / factors[j, 0]
        if k < end:
            r[k] = value
        if value != 0.0:
            for m in range(1, 5):
                if k >= m and k - m < end and not fixed[k - m]:
                    r[k - m] -= S[k, m] * value
                if k + m < min(n, end) and not fixed[k + m]:
                    r[k + m] -= S[k + m, m] * value


@compiled
def largest_in(place: NDArray[np.int64], y: Array, zone: int) -> tuple[float, float]:
    """Largest deflection and largest slope among the unknowns before ``zone``: of different units, each is round-off's
    measure for its own kind alone."""
    deflection, slope = 0.0, 0.0
    for i in range(place.size):
        k = place[i]
        if k >= zone:
            break
        if is_slope(i):
            slope = max(slope, abs(y[k]))
        else:
            deflection = max(deflection, abs(y[k]))
    return deflection, slope


@compiled
def wrong_rows(
    problem: Problem, work: Work, closed: Flags, first: int, stop: int, zone: int, tolerance: float
) -> tuple[int, int]:
    """Mark in work.wrong which of the rows ``first`` … ``stop`` − 1 have the wrong sign, the unknowns before ``zone``
    known, and put their reactions in work.p. Returns how many are wrong, and the last of them (−1: none)."""
    dofs, factors, place, switch = problem.dofs, problem.factors, problem.place, problem.switch
    y, b, r, p, target = work.y, work.b, work.r, work.p, work.target
    width = factors.shape[1]
    count, last = 0, -1
    deflection, slope, measured = 0.0, 0.0, False
    for j in range(first, stop):
        bad = False
        if closed[j]:
            if width == 1:
                left, size = equation(work.S, y, b[dofs[j, 0]], switch[j])
                p[j] = left / factors[j, 0]
            else:
                k = place[dofs[j, 0]]
                _, size = equation(work.S, y, r[k], k)
                p[j] = -y[switch[j]]
            bad = not work.held[j] and p[j] < -tolerance * size / abs(factors[j, 0])
        elif work.candidate[j]:
            p[j] = 0.0
            if width == 1:
                slack = factors[j, 0] * y[dofs[j, 0]] - target[j]
            else:
                slack = -target[j]
                for i in range(width):
                    slack += factors[j, i] * y[place[dofs[j, i]]]
            if slack < 0.0:
                if not measured:
                    deflection, slope = largest_in(place, y, zone)
                    measured = True
                size = abs(target[j])
                for i in range(width):
                    size += abs(factors[j, i]) * (slope if is_slope(dofs[j, i]) else deflection)
                bad = slack < -tolerance * size
        work.wrong[j] = bad
        if bad:
            count += 1
            last = j
    return count, last


@compiled
def substitute_rest(work: Work, start: int, end: int, smallest: float) -> int:
    """Unknowns from ``start`` on, where right-hand sides are zero from ``end`` on. Returns where they become zero."""
    y = work.y
    if end >= y.size:
        back_substitute(work.R, work.U, work.z, start, y.size, y)
        return int(y.size)
    if start < end:
        back_substitute(work.R, work.U, work.z, start, end, y)
        start = end
    return fade_out(work.U, start, smallest, y)


@compiled
def solve_rows(problem: Problem, work: Work, fresh: bool, extent: int, closed: Flags) -> int:
    """Solve for work.x (dofs,) and work.p (rows,) from work.S, work.b, work.target, work.candidate,
    work.held.

    fresh : work.S is new, its factors are stale. extent : b is zero from this dof on (the number of dofs when it may be
        non-zero anywhere). closed : (rows,), the guess on entry, the answer on return.

    Returns SOLVED, SINGULAR or CYCLING.
    """
    factors, place, switch, reach = problem.factors, problem.place, problem.switch, problem.reach
    S, fixed, D, R, U, r, z, y = work.S, work.fixed, work.D, work.R, work.U, work.r, work.z, work.y
    b, x, p, wrong = work.b, work.x, work.p, work.wrong
    target, candidate, held = work.target, work.candidate, work.held
    n, m = y.size, closed.size
    direct = factors.shape[1] == 1
    top = n - 1 if fresh else -1
    last_row, last_closed = -1, -1
    for j in range(m):
        want = held[j] or (closed[j] and candidate[j])
        closed[j] = want
        p[j] = 0.0
        wrong[j] = False
        if want:
            last_closed = j
        if want or candidate[j]:
            last_row = j
        k = switch[j]
        if fixed[k] != (want == direct):
            fixed[k] = want == direct
            top = max(top, min(k + 4, n - 1))
    whole = min(reach[last_row] + 5, n) if last_row >= 0 else 0
    zone, near = whole, last_row + 1
    limit = MARGIN + (reach[last_closed] if last_closed >= 0 else 0)
    if limit < whole:
        zone, near = limit, last_closed + 1
        while reach[near] + 5 <= zone:
            near += 1

    end = n  # of the unknowns with a right-hand side
    if extent < b.size:
        end = place[extent - 1] + 1 if extent > 0 else 0
        if last_closed >= 0:
            end = max(end, min(switch[last_closed] + 5, n))
        z[end:] = 0.0
    right_side(S, b, place, fixed, switch, factors, target, closed, last_closed, end, r)
    if top >= 0 and not factor(S, fixed, top, D, R, U):
        return SINGULAR
    forward_substitute(U, r, end - 1, z)

    fewest, patience, rounds, tolerance, smallest = m + 1, PATIENCE, 0, ROUND_OFF, 0.0
    while True:
        back_substitute(R, U, z, 0, zone, y)
        count, last = wrong_rows(problem, work, closed, 0, near, zone, tolerance)
        if count == 0:
            if end < n:
                deflection, slope = largest_in(place, y, zone)
                smallest = FADED * max(deflection, slope)
            work.extent[0] = substitute_rest(work, zone, end, smallest)
            if near > last_row:
                break
            count, last = wrong_rows(problem, work, closed, near, last_row + 1, whole, tolerance)
            if count == 0:
                break
            zone, near = whole, last_row + 1
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
        rounds += 1
        if rounds % (LENIENT_AFTER + m) == 0:
            tolerance *= 10.0
            if tolerance > COARSEST:
                return CYCLING
        top = -1
        for j in range(last_row + 1):
            if wrong[j] and (patience > 0 or j == last):
                closed[j] = not closed[j]
                fixed[switch[j]] = closed[j] == direct
                top = max(top, min(switch[j] + 4, n - 1))
        end = max(end, top + 1)
        right_side(S, b, place, fixed, switch, factors, target, closed, last_row, top + 1, r)
        if not factor(S, fixed, top, D, R, U):
            return SINGULAR
        forward_substitute(U, r, top, z)
    if not direct:
        for i in range(x.size):
            x[i] = y[place[i]]
    work.rounds[0] += 1
    work.rounds[1] += rounds + 1
    work.rounds[2] = max(work.rounds[2], rounds + 1)
    return SOLVED
