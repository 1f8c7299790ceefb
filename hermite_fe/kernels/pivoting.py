"""Compiled active-set solution of a banded linear complementarity problem

    S x = b + Gᵀ p,      0 ≤ p ⊥ G x − c ≥ 0,      x = 0 at supports,

by block principal pivoting: guess which rows are closed (G x = c), solve, exchange every row whose sign is
wrong, repeat. Exchanging all at once takes two or three rounds; should the number of wrong rows stop falling,
one row at a time is exchanged, the one that pulls most or else is furthest in the wall. Where that does not help the
last of them is (Murty's rule), which cannot cycle for a positive definite S (Júdice & Pires 1994, Comput. Oper. Res.
21, 587) but may take very long: then :mod:`hermite_fe.kernels.monotone` takes over.

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
from hermite_fe.kernels.monotone import solve_monotone
from hermite_fe.kernels.problem import Problem, Work
from hermite_fe.kernels.rows import (
    SINGULAR,
    SOLVED,
    largest_in,
    right_side,
    wrong_rows,
)

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

PATIENCE = 8  # rounds of block exchange without progress before one row at a time is exchanged
PERSISTENCE = 64  # rounds without progress of exchanging the worst row before Murty's rule
ROUND_OFF = 1e-13  # of the terms summed: below it a wrong sign means nothing
LENIENT_AFTER = 150  # rounds, whatever the rows: nearly degenerate rows are then judged ten times more leniently
MOST_LENIENT = 1e-12  # beyond it the exchanges run in a circle, and the fall-back takes over
COARSEST = 1e-8  # of the fall-back, which starts at round-off
MARGIN = 64  # unknowns beyond the closed rows that every round looks at; the rest of the beam is looked at last
FADED = 1e-100  # of the largest unknown: what is smaller, and beyond all loads, is taken as zero


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
    p[:] = 0.0
    wrong[:] = False
    for j in range(m):
        want = held[j] or (closed[j] and candidate[j])
        closed[j] = want
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
        count, last, worst = wrong_rows(problem, work, closed, 0, near, zone, tolerance)
        if count == 0:
            if end < n:
                deflection, slope = largest_in(place, y, zone)
                smallest = FADED * max(deflection, slope)
            work.extent[0] = substitute_rest(work, zone, end, smallest)
            if near > last_row:
                break
            count, last, worst = wrong_rows(problem, work, closed, near, last_row + 1, whole, tolerance)
            if count == 0:
                break
            zone, near = whole, last_row + 1
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
        rounds += 1
        if rounds % LENIENT_AFTER == 0:
            tolerance *= 10.0
            if tolerance > MOST_LENIENT:
                tolerance = ROUND_OFF
                status, more = solve_monotone(problem, work, closed, tolerance)
                while status != SOLVED and tolerance < COARSEST:
                    tolerance = min(10.0 * tolerance, COARSEST)
                    status, more = solve_monotone(problem, work, closed, tolerance)
                if status != SOLVED:
                    return status
                rounds += more
                work.extent[0] = n
                break
        chosen = worst if patience > -PERSISTENCE else last
        top = -1
        for j in range(last + 1):
            if wrong[j] and (patience > 0 or j == chosen):
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
