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


@compiled_in_place
def rows_to_look_at(closed: Flags) -> int:
    """Rows that are looked at in every step, up to well ahead of the last closed one."""
    for j in range(closed.size - 1, -1, -1):
        if closed[j]:
            return min(max(AHEAD * (j + 1), FEWEST), closed.size)
    return min(FEWEST, closed.size)


@compiled_in_place
def smallest_gap(problem: Problem, change: Array, first: int) -> float:
    """Of the rows from ``first`` on, at least one; ``change`` (rows,) is G q."""
    smallest = problem.gap[first] + change[first]
    for j in range(first + 1, change.size):
        smallest = min(smallest, problem.gap[j] + change[j])
    return smallest


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
