"""Compiled active-set solution of a banded linear complementarity problem

    S x = b + Gᵀ p,      0 ≤ p ⊥ G x − c ≥ 0,      x = 0 at supports,

by block principal pivoting: guess which rows are closed (G x = c), solve, exchange rows whose sign is wrong, repeat.
All are exchanged as long as their number falls fast, then the worst of every run of neighbours that are wrong alike: a
beam is stiff over a few nodes, so that it mends most of the others. Should the number not fall for some rounds, one row
at a time is exchanged, the one that pulls most or else is furthest in the wall. Where that does not help the
last of them is (Murty's rule), which cannot cycle for a positive definite S (Júdice & Pires 1994, Comput. Oper. Res.
21, 587) but may take very long: then :mod:`hermite_fe.kernels.monotone` takes over.

A row that touches one dof fixes it when closed, and p is what is left over in that dof's equation. A row that
touches several has a multiplier −p among the unknowns, fixed at 0 while open. Either way a switch changes the
factors from there to the twist only (:mod:`hermite_fe.kernels.banded`), which stays below all rows that have switched
of late: so a round costs the front of the contact zone, not the zone or the beam. The rest of either is looked at when
the front is settled. A *held* row is closed whatever the sign of p; a row that is no *candidate* is open.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.banded import (
    back_substitute,
    factor,
    factor_down,
    fade_out,
    substitute,
    substitute_down,
)
from hermite_fe.kernels.jit import compiled_apart, compiled_in_place
from hermite_fe.kernels.monotone import solve_monotone
from hermite_fe.kernels.multipliers import extend
from hermite_fe.kernels.problem import Problem, Work
from hermite_fe.kernels.rows import (
    SINGULAR,
    SOLVED,
    TOO_SHORT,
    first_from,
    largest_in,
    right_side,
    wrong_rows,
)

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]

FALLING = 0.75  # share of the wrong rows of the round before, up to which all are exchanged
FEW = 2  # neighbours that are exchanged together nevertheless
PATIENCE = 8  # rounds of block exchange without progress before one row at a time is exchanged
PERSISTENCE = 64  # rounds without progress of exchanging the worst row before Murty's rule
ROUND_OFF = 1e-13  # of the terms summed: below it a wrong sign means nothing
LENIENT_AFTER = 150  # rounds, whatever the rows: nearly degenerate rows are then judged ten times more leniently
MOST_LENIENT = 1e-12  # beyond it the exchanges run in a circle, and the fall-back takes over
COARSEST = 1e-8  # of the fall-back, which starts at round-off
MARGIN = 64  # unknowns beyond the closed rows that every round looks at; the rest of the beam is looked at last
REACH = 5  # unknowns: the twist is so far below a switch, which changes couplings of four unknowns on either side
ADVANCE = 32  # unknowns that the twist lags at most behind where it may be
CALMING = 4  # solves in which a row that switched is forgotten for the most part
FADED = 1e-50  # of the largest unknown: what is smaller, and beyond all loads, is taken as zero


@compiled_in_place
def substitute_rest(U: Array, z: Array, place: Places, bottom: int, start: int, end: int, y: Array) -> int:
    """Unknowns from ``start`` on, those from ``bottom`` to there being known, where right-hand sides are zero from
    ``end`` on. Returns where they become zero."""
    if start < end:
        back_substitute(U, z, start, end - start, 1, y)
        start = end
    if start >= y.size:
        return int(y.size)
    deflection, slope = largest_in(place, y, bottom, start)
    return fade_out(U, start, FADED * max(deflection, slope), y)


@compiled_apart
def refactor(work: Work, D: Array, U: Array, calm: int, low: int, top: int, wanted: int) -> int:
    """Bring the factors up to date where unknowns between ``low`` and ``top`` − 4 have switched, or all are new
    (``calm`` = 0): the first ``calm`` unknowns are factored from below. The twist moves to ``wanted`` where that is
    below it or well above. Returns the last unknown that was factored anew from above, −1 if none, −2 on failure.
    """
    S, fixed = work.S, work.fixed
    before, twist = work.twist[0], work.twist[0]
    if wanted < twist or wanted > twist + ADVANCE:
        twist = wanted
    calm = min(calm, before, max(low - REACH, 0))
    sound = True
    if twist > calm:
        sound = factor(S, fixed, calm, twist - calm, 1, D, U)
    if twist < before:
        top = max(top, before + 3)
    if twist != before or calm < twist:
        top = max(top, twist + 3)
    work.twist[0] = twist
    if top >= twist:
        sound = factor_down(S, fixed, top, twist, work.meeting, D, U) and sound
    return top if sound else -2


@compiled_in_place
def solve_rows(problem: Problem, work: Work, fresh: bool, extent: int, closed: Flags) -> int:
    """Solve for work.x (dofs,) and work.p (rows,) from work.S, work.b, work.target, work.candidate,
    work.held.

    fresh : work.S is new, its factors are stale. extent : b is zero from this dof on (the number of dofs when it may be
        non-zero anywhere). closed : (rows,), the guess on entry, the answer on return.

    Returns SOLVED, SINGULAR or CYCLING.
    """
    return solve_part(problem, work, fresh, extent, closed, closed.size, work.b.size)


@compiled_in_place
def solve_part(
    problem: Problem, work: Work, fresh: bool, extent: int, closed: Flags, rows: int, length: int
) -> int:
    """:func:`solve_rows` for the first ``rows`` rows and the first ``length`` dofs; of the others work.p, S and work.x
    (but for three, which become zero) are not looked at.

    Rows from number ``rows`` on are open, are known to stay so, and touch, as all others do, no dof from ``length`` on
    (unless that is all of them). Returns TOO_SHORT where the solution does not fade before dof ``length``.
    """
    if work.span[0] == 0 and closed.size > 0:
        extend(problem, work, 0)
        fresh = True
    while True:
        status, row = solve_near(problem, work, fresh, extent, closed, rows, length)
        if row < 0:
            return status
        extend(problem, work, row)
        fresh = True


@compiled_in_place
def mark_rows(problem: Problem, work: Work, closed: Flags, rows: int, n: int) -> tuple[int, int, int, int]:
    """Close the rows that are held, and of those that were closed the ones that take part; p and wrong of all become
    nothing. Returns between which unknowns that switched, of ``n``, the last row that takes part, the last closed one
    (−1: none)."""
    switch, fixed, p, wrong = problem.switch, work.fixed, work.p, work.wrong
    candidate, held, span = work.candidate, work.held, work.span[0]
    direct = problem.factors.shape[1] == 1
    low, top, last_row, last_closed = n, -1, -1, -1
    for j in range(rows):
        p[j] = 0.0
        wrong[j] = False
        want = held[j] or (closed[j] and candidate[j])
        closed[j] = want
        if want:
            last_closed = j
        if want or candidate[j]:
            last_row = j
        if j >= span:
            continue
        k = switch[j]
        if fixed[k] != (want == direct):
            fixed[k] = want == direct
            low = min(low, k)
            top = max(top, min(k + 4, n - 1))
    return low, top, last_row, last_closed


@compiled_in_place
def exchange(
    problem: Problem, work: Work, closed: Flags, last: int, chosen: int, one: bool, together: bool, n: int
) -> tuple[int, int]:
    """Switch rows whose sign is wrong, ``last`` being the last of them: ``chosen`` where only ``one`` may, all
    ``together``, or else of each run of neighbours that are wrong alike the worst (all of a short run). Returns the
    first unknown that is wrong and the last one, of ``n``, whose factors that changes."""
    switch, fixed, wrong, excess = problem.switch, work.fixed, work.wrong, work.excess
    direct = problem.factors.shape[1] == 1
    low, top, stop, most, few = n, -1, 0, -1, True
    for j in range(last + 1):
        if not wrong[j]:
            continue
        low = min(low, switch[j])
        if j >= stop:  # a run of neighbours that are wrong alike
            shut, stop, most = closed[j], j + 1, j
            while stop <= last and wrong[stop] and closed[stop] == shut:
                if excess[stop] > excess[most]:
                    most = stop
                stop += 1
            few = stop - j <= FEW
        if j == chosen if one else together or few or j == most:
            closed[j] = not closed[j]
            fixed[switch[j]] = closed[j] == direct
            top = max(top, min(switch[j] + 4, n - 1))
    return low, top


@compiled_apart
def solve_near(
    problem: Problem, work: Work, fresh: bool, extent: int, closed: Flags, rows: int, length: int
) -> tuple[int, int]:
    """:func:`solve_part` as far as rows have multipliers. Returns (status, −1), or a row that has none and would close
    in place of −1."""
    factors, place, switch, reach = problem.factors, work.place, problem.switch, problem.reach
    S, fixed = work.S, work.fixed
    b, x, target, twist = work.b, work.x, work.target, work.twist
    m, span = rows, work.span[0]
    direct = factors.shape[1] == 1
    shift = 0 if direct else span  # multipliers, all of them before the first unknown of ``far``
    n = length + shift
    D, U, z, y = work.D[: n + 4], work.U[: n + 4], work.z[: n + 4], work.y[:n]
    if fresh:  # the four idle rows
        D[n:] = 1.0
        U[n:] = 0.0
        z[n:] = 0.0
    low, top, last_row, last_closed = mark_rows(problem, work, closed, m, n)
    if fresh:
        top = n - 1
    if last_closed >= span:
        return SOLVED, last_closed
    whole = min(reach[last_row] + 5, n) if last_row >= 0 else 0
    zone, near = whole, last_row + 1
    limit = MARGIN + (reach[last_closed] if last_closed >= 0 else 0)
    if limit < whole:
        zone, near = limit, last_closed + 1
        while reach[near] + 5 <= zone:
            near += 1
    near = min(near, span)

    end = n  # of the unknowns with a right-hand side
    if extent < length:
        end = place[extent - 1] + 1 if extent > 0 else 0
        if last_closed >= 0:
            end = max(end, min(switch[last_closed] + 5, n))
        z[end:n] = 0.0
    settled = min(twist[1], low) if last_closed >= 0 else 0
    wanted = max(0, min(settled, switch[last_closed] if last_closed >= 0 else 0, n - 4 + REACH) - REACH)
    if refactor(work, D, U, 0 if fresh else n, low, top, wanted) == -2:
        return SINGULAR, -1
    bottom = twist[0]
    end = max(end, min(bottom + 4, n))
    # beyond what a closed row or a multiplier touches the right-hand side is b as it stands
    for support in problem.supports:
        b[support] = 0.0
    far = max(bottom + 4, switch[span - 1] + 1 if shift > 0 else 0)
    if last_closed >= 0:
        far = max(far, switch[last_closed] + 5)
    far = min(far, end)
    right_side(S, b, place, fixed, switch, factors, target, closed, last_closed, 0, far, z)
    substitute(U[shift:], end - 1 - shift, end - far, -1, b, z[shift:])
    substitute(U, 0, bottom, 1, z, z)
    substitute_down(U, far - 1, bottom, z)
    first = first_from(switch, bottom + 4) if bottom > 0 else 0

    fewest, patience, rounds, tolerance = m + 1, PATIENCE, 0, ROUND_OFF
    lowest, together, before = low, True, m + 1
    while True:
        back_substitute(U[bottom:], z[bottom:], 0, zone - bottom, 1, y[bottom:])
        count, last, worst = wrong_rows(problem, work, closed, first, near, bottom, zone, tolerance)
        if count == 0:
            work.extent[0] = substitute_rest(U, z, place, bottom, zone, end, y)
            if work.extent[0] == n and length < b.size:
                return TOO_SHORT, -1
            back_substitute(U, z, bottom - 1, bottom, -1, y)
            if bottom > 0:
                count, last, worst = wrong_rows(problem, work, closed, 0, first, 0, zone, tolerance)
            if near <= last_row:
                more, beyond, worse = wrong_rows(problem, work, closed, near, last_row + 1, 0, whole, tolerance)
                if more > 0:
                    count, last, worst = count + more, beyond, worse
                if last >= span:
                    return SOLVED, last
                zone, near = whole, min(last_row + 1, span)
            if count == 0:
                break
        together = together and count < FALLING * before
        before = count
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
        rounds += 1
        if rounds % LENIENT_AFTER == 0:
            tolerance *= 10.0
            if tolerance > MOST_LENIENT:
                if length < b.size:
                    return TOO_SHORT, -1
                if span < closed.size:
                    return SOLVED, closed.size - 1
                tolerance = ROUND_OFF
                status, more = solve_monotone(problem, work, closed, tolerance)
                while status != SOLVED and tolerance < COARSEST:
                    tolerance = min(10.0 * tolerance, COARSEST)
                    status, more = solve_monotone(problem, work, closed, tolerance)
                if status != SOLVED:
                    return status, -1
                rounds += more
                work.extent[0] = b.size
                lowest = 0
                break
        chosen = worst if patience > -PERSISTENCE else last
        low, top = exchange(problem, work, closed, last, chosen, patience <= 0, together, n)
        lowest = min(lowest, low)
        top = refactor(work, D, U, n, low, top, min(bottom, max(0, low - REACH)))
        if top == -2:
            return SINGULAR, -1
        if twist[0] < bottom:
            bottom = twist[0]
            first = first_from(switch, bottom + 4) if bottom > 0 else 0
        end = max(end, top + 1)
        right_side(S, b, place, fixed, switch, factors, target, closed, min(last_row, span - 1), bottom, top + 1, z)
        substitute_down(U, top, bottom, z)
    if last_closed >= 0:
        twist[1] = min(lowest, twist[1] + max(1, (switch[last_closed] - twist[1]) // CALMING))
    if shift > 0:
        near = switch[span - 1] + 1 - shift
        # of the dofs: beyond the multipliers there are ``shift`` fewer of them than unknowns
        work.extent[0] = max(work.extent[0] - shift, near)
        for i in range(near):
            x[i] = y[place[i]]
        rest, found = x[near:length], y[near + shift :]
        for i in range(rest.size):
            rest[i] = found[i]
    for i in range(length, min(length + 3, x.size)):
        x[i] = 0.0
    work.rounds[0] += 1
    work.rounds[1] += rounds + 1
    work.rounds[2] = max(work.rounds[2], rounds + 1)
    return SOLVED, -1
