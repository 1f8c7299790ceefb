"""Contact rows far ahead of the zone are not looked at while nothing ahead can have moved as far as their gaps.

A row's gap changes by at most Σ|factor|·(largest motion of a dof). So what rows from some number on have as their
smallest gap, less the largest motions of the steps since, says how long all of them stay open: a long beam's thousands
of rows are then looked at now and then, not in every step.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.jit import compiled_apart, compiled_in_place, compiled_maxima

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]

FEWEST = 64  # rows that are looked at in every step
AHEAD = 2  # times as many rows as reach to the last closed one
STEPS_AHEAD = 2.0  # that the nearest row left alone is off the wall, at least


@compiled_apart
def leave_alone(
    n: int, dofs: Places, gap0: Array, closed: Flags, gap: Array, speed: Array, h: float
) -> tuple[int, int, float]:
    """How many rows are to be looked at, the first of ``n`` dofs that only others touch, and what they have as their
    smallest gap (all, n, 0 where none can be left alone). ``gap`` and ``speed`` (rows,) are Gq and Gv."""
    m, far = closed.size, n
    rows, fastest = FEWEST, 0.0
    for j in range(m):
        fastest = max(fastest, abs(speed[j]))
        if closed[j]:
            rows = max(rows, AHEAD * (j + 1))
    near = STEPS_AHEAD * h * fastest
    for j in range(m - 1, rows - 1, -1):
        if gap0[j] + gap[j] <= near:
            rows = j + 1
            break
    if rows >= m:
        return m, n, 0.0
    clearance = gap0[rows] + gap[rows]
    for j in range(rows + 1, m):
        clearance = min(clearance, gap0[j] + gap[j])
    for i in range(dofs.shape[1]):
        far = min(far, dofs[rows, i])
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
def row_bound(lever: Array, deflection: float, slope: float) -> float:
    """What no |G x| exceeds where no deflection and no slope does these; ``lever`` is that of a
    :class:`hermite_fe.kernels.problem.Problem`."""
    return lever[0] * deflection + lever[1] * slope
