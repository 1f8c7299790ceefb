"""Contact rows far ahead of the zone are not looked at while nothing ahead can have moved as far as their gaps.

A row's gap changes by at most Σ|factor|·(largest motion of a dof). So what rows from some number on have as their
smallest gap, less the largest motions of the steps since, says how long all of them stay open: a long beam's thousands
of rows are then looked at now and then, not in every step.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.jit import compiled_in_place, compiled_maxima
from hermite_fe.kernels.problem import Problem

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

FEWEST = 64  # rows that are looked at in every step
AHEAD = 2  # times as many rows as reach to the last closed one
STEPS_AHEAD = 2.0  # that the nearest row left alone is off the wall, at least


@compiled_in_place
def leave_alone(problem: Problem, closed: Flags, gap: Array, speed: Array, h: float) -> tuple[int, int, float]:
    """How many rows are to be looked at, the first dof that only others touch, and what they have as their smallest gap
    (all, as many dofs as there are, 0 where none can be left alone). ``gap`` and ``speed`` (rows,) are Gq and Gv."""
    n, m, far = problem.before.size, closed.size, problem.before.size
    rows, fastest = FEWEST, 0.0
    for j in range(m):
        fastest = max(fastest, abs(speed[j]))
        if closed[j]:
            rows = max(rows, AHEAD * (j + 1))
    near = STEPS_AHEAD * h * fastest
    for j in range(m - 1, rows - 1, -1):
        if problem.gap[j] + gap[j] <= near:
            rows = j + 1
            break
    if rows >= m:
        return m, n, 0.0
    clearance = problem.gap[rows] + gap[rows]
    for j in range(rows + 1, m):
        clearance = min(clearance, problem.gap[j] + gap[j])
    for i in range(problem.dofs.shape[1]):
        far = min(far, problem.dofs[rows, i])
    return rows, far, clearance


@compiled_maxima
def largest(x: Array, first: int) -> tuple[float, float]:
    """Largest deflection and largest slope of ``x``, whose first number is dof ``first``."""
    one, other = 0.0, 0.0
    for i in range(x.size // 2):
        a, b = abs(x[2 * i]), abs(x[2 * i + 1])
        one = a if a > one else one
        other = b if b > other else other
    if x.size % 2 == 1:
        one = max(one, abs(x[x.size - 1]))
    return (one, other) if first % 2 == 0 else (other, one)


@compiled_in_place
def row_bound(problem: Problem, deflection: float, slope: float) -> float:
    """What no |G x| exceeds where no deflection and no slope does these."""
    return problem.lever[0] * deflection + problem.lever[1] * slope
