"""Compiled fall-back of :mod:`hermite_fe.kernels.pivoting`: an active-set method whose energy falls each time.

The reactions p ≥ 0 minimise ½pᵀGS⁻¹Gᵀp + pᵀ(GS⁻¹b − c). From no reaction on, the row that is furthest in the wall is
closed; where a reaction then turns negative the step goes only as far as to the first that vanishes, and that row opens
(Lawson & Hanson 1974, Solving Least Squares Problems, ch. 23). No set of closed rows comes back. It takes about as many
solutions as rows close, so it is for the steps at which exchanging many rows at once runs in a circle.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.banded import back_substitute, factor, substitute
from hermite_fe.kernels.jit import compiled_apart
from hermite_fe.kernels.problem import Problem, Work
from hermite_fe.kernels.rows import CYCLING, SINGULAR, SOLVED, right_side, wrong_rows

Flags = NDArray[np.bool_]

MOST = 20  # exchanges a row


@compiled_apart
def solve_monotone(problem: Problem, work: Work, closed: Flags, tolerance: float) -> tuple[int, int]:
    """Solve for work.y and work.p from scratch; ``closed`` (rows,) is the answer. No row may lack its multiplier.

    Returns (status, solutions); CYCLING also where a row is left in the wall because closing it makes it pull:
    ``tolerance`` is below round-off.
    """
    switch, place, dofs, factors = problem.switch, work.place, problem.dofs, problem.factors
    S, fixed, y, p = work.S, work.fixed, work.y, work.p
    n, m, width = y.size, closed.size, factors.shape[1]
    direct = width == 1
    known, barred = work.known, work.barred
    for j in range(m):
        known[j] = 0.0
        barred[j] = False
        closed[j] = work.held[j]
        fixed[switch[j]] = closed[j] == direct
    last_closed = -1
    work.twist[0] = work.twist[1] = 0  # factored from above alone
    for attempt in range(MOST * (m + 1)):
        right_side(S, work.b, place, fixed, switch, factors, work.target, closed, m - 1, 0, n, work.z)
        if not factor(S, fixed, n - 1, n, -1, work.D, work.U):
            return SINGULAR, attempt
        substitute(work.U, n - 1, n, -1, work.z, work.z)
        back_substitute(work.U, work.z, 0, n, 1, y)
        wrong_rows(problem, work, closed, 0, m, 0, n, tolerance)
        share, opening = 1.0, -1
        for j in range(m):
            if closed[j] and work.wrong[j]:
                reached = known[j] / (known[j] - p[j])
                if reached < share:
                    share, opening = reached, j
        if opening >= 0:
            for j in range(m):
                if closed[j]:
                    known[j] += share * (p[j] - known[j])
            known[opening] = 0.0
            closed[opening] = False
            fixed[switch[opening]] = not direct
            if opening == last_closed:  # it closed for nothing but round-off
                barred[opening] = True
            continue
        if last_closed >= 0 and closed[last_closed]:  # it stays: what was barred before is judged anew
            for j in range(m):
                barred[j] = False
        left, deepest, closing = False, 0.0, -1
        for j in range(m):
            known[j] = p[j] if closed[j] else 0.0
            left = left or (work.wrong[j] and barred[j])
            if not closed[j] and work.wrong[j] and not barred[j]:
                slack = -work.target[j]
                for i in range(width):
                    slack += factors[j, i] * y[place[dofs[j, i]]]
                if slack < deepest:
                    deepest, closing = slack, j
        if closing < 0:
            return CYCLING if left else SOLVED, attempt
        closed[closing] = True
        fixed[switch[closing]] = direct
        last_closed = closing
    return CYCLING, MOST * (m + 1)
