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

from hermite_fe.kernels.banded import factor, sweep_in, sweep_out
from hermite_fe.kernels.jit import compiled
from hermite_fe.kernels.problem import Problem, Work

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

SOLVED, SINGULAR, CYCLING, NOT_FINITE = 0, 1, 2, 3
PATIENCE = 8  # rounds of block exchange without progress before Murty's rule
ROUND_OFF = 1e-13  # of the terms summed: below it a wrong sign means nothing
DOUBT = 40  # rounds, and one more a row, after which nearly degenerate rows are judged ten times more leniently
COARSEST = 1e-8


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
def solve_rows(problem: Problem, work: Work, fresh: bool, closed: Flags) -> int:
    """Solve for work.x (dofs,) and work.p (rows,) from work.S, work.b, work.target, work.candidate,
    work.held.

    ``fresh`` : work.S is new, its factors are stale. ``closed`` (rows,) is the guess on entry, the answer on
    return. Returns SOLVED, SINGULAR or CYCLING.
    """
    dofs, factors = problem.dofs, problem.factors
    place, switch, reach = problem.place, problem.switch, problem.reach
    S, fixed, D, R, U, r, z, y = work.S, work.fixed, work.D, work.R, work.U, work.r, work.z, work.y
    b, x, p, wrong = work.b, work.x, work.p, work.wrong
    target, candidate, held = work.target, work.candidate, work.held
    n, m, width = y.size, closed.size, factors.shape[1]
    direct = width == 1
    top = n - 1 if fresh else -1
    zone, last_row = 0, -1
    for j in range(m):
        want = held[j] or (closed[j] and candidate[j])
        closed[j] = want
        p[j] = 0.0
        wrong[j] = False
        if want or candidate[j]:
            last_row = j
            zone = max(zone, reach[j])
        k = switch[j]
        if fixed[k] != (want == direct):
            fixed[k] = want == direct
            top = max(top, min(k + 4, n - 1))
    zone = min(zone + 5, n)

    right_side(S, b, place, fixed, switch, factors, target, closed, m - 1, n, r)
    if top >= 0 and not factor(S, fixed, top, D, R, U):
        return SINGULAR
    sweep_in(U, r, n - 1, z)

    fewest, patience, rounds, tolerance = m + 1, PATIENCE, 0, ROUND_OFF
    while True:
        sweep_out(R, U, z, 0, zone, y)
        deflection, slope = 0.0, 0.0  # of different units: each is round-off's measure for its own kind alone
        for i in range(min(b.size, zone)):
            if place[i] >= zone:
                break
            if is_slope(i):
                slope = max(slope, abs(y[place[i]]))
            else:
                deflection = max(deflection, abs(y[place[i]]))
        count, last = 0, -1
        for j in range(last_row + 1):
            wrong[j] = False
            if not (candidate[j] or held[j]):
                continue
            if closed[j]:
                if direct:
                    left, size = equation(S, y, b[dofs[j, 0]], switch[j])
                    p[j] = left / factors[j, 0]
                else:
                    k = place[dofs[j, 0]]
                    _, size = equation(S, y, r[k], k)
                    p[j] = -y[switch[j]]
                wrong[j] = not held[j] and p[j] < -tolerance * size / abs(factors[j, 0])
            else:
                p[j] = 0.0
                slack, size = -target[j], abs(target[j])
                for i in range(width):
                    slack += factors[j, i] * y[place[dofs[j, i]]]
                    size += abs(factors[j, i]) * (slope if is_slope(dofs[j, i]) else deflection)
                wrong[j] = slack < -tolerance * size
            if wrong[j]:
                count += 1
                last = j
        if count == 0:
            break
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
        rounds += 1
        if rounds % (DOUBT + m) == 0:
            tolerance *= 10.0
            if tolerance > COARSEST:
                return CYCLING
        top = -1
        for j in range(last_row + 1):
            if wrong[j] and (patience > 0 or j == last):
                closed[j] = not closed[j]
                fixed[switch[j]] = closed[j] == direct
                top = max(top, min(switch[j] + 4, n - 1))
        right_side(S, b, place, fixed, switch, factors, target, closed, last_row, top + 1, r)
        if not factor(S, fixed, top, D, R, U):
            return SINGULAR
        sweep_in(U, r, top, z)
    sweep_out(R, U, z, zone, n, y)
    if not direct:
        for i in range(x.size):
            x[i] = y[place[i]]
    work.rounds[0] += 1
    work.rounds[1] += rounds + 1
    work.rounds[2] = max(work.rounds[2], rounds + 1)
    return SOLVED
