"""Compiled pieces that all schemes with unilateral rows share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.jit import compiled_apart, compiled_in_place
from hermite_fe.kernels.problem import ContactLaw, Problem

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]


@compiled_in_place
def rows_times(dofs: Places, factors: Array, x: Array, out: Array) -> None:
    """out = G x."""
    m, width = dofs.shape
    if width == 1:
        for j in range(m):
            out[j] = factors[j, 0] * x[dofs[j, 0]]
    else:
        for j in range(m):
            total = 0.0
            for k in range(width):
                total += factors[j, k] * x[dofs[j, k]]
            out[j] = total


@compiled_in_place
def row_times(dofs: Places, factors: Array, x: Array, j: int) -> float:
    """Row j of G x."""
    total = 0.0
    for k in range(dofs.shape[1]):
        total += factors[j, k] * x[dofs[j, k]]
    return total


@compiled_in_place
def force_rows(load: Array, t: float, h: float, theta: float, first: int, stop: int, force: Array) -> None:
    """Rows ``first`` … ``stop`` − 1 of :func:`force_at`, force (stop − first,)."""
    steady = load[0, first:stop]
    for i in range(steady.size):
        force[i] = steady[i]
    for power in range(1, load.shape[0]):
        mean, part = theta * (t + h) ** power + (1.0 - theta) * t**power, load[power, first:stop]
        for i in range(part.size):
            force[i] += mean * part[i]


@compiled_in_place
def force_at(load: Array, t: float, h: float, theta: float, force: Array) -> None:
    """force = θF(t + h) + (1 − θ)F(t) for F = Σ load[k]·t^k."""
    force_rows(load, t, h, theta, 0, force.size, force)


@compiled_apart
def mark_held(problem: Problem, law: ContactLaw, closed: Flags, t: float, held: Flags) -> None:
    """Rows that stay closed after time t: those whose front is fewer than ``law.hold`` rows further, and before
    ``law.hold_until`` all that are closed."""
    rank, side, everything = problem.rank, problem.side, t < law.hold_until
    if law.hold == 0 and not everything:
        held[:] = False
        return
    right, left = -1, -1  # the front on either side
    for j in range(closed.size):
        if closed[j] and side[j] == 0:
            right = max(right, rank[j])
        elif closed[j]:
            left = max(left, rank[j])
    for j in range(closed.size):
        held[j] = closed[j] and (everything or (right if side[j] == 0 else left) - rank[j] < law.hold)
