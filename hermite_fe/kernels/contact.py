"""Compiled pieces that all schemes with unilateral rows share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.jit import compiled_apart, compiled_in_place
from hermite_fe.kernels.problem import ContactLaw

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
def rows_times_both(dofs: Places, factors: Array, x: Array, y: Array, first: Array, second: Array) -> None:
    """first = G x and second = G y, in one pass over the rows."""
    m, width = dofs.shape
    if width == 1:
        for j in range(m):
            d, factor = dofs[j, 0], factors[j, 0]
            first[j] = factor * x[d]
            second[j] = factor * y[d]
    else:
        for j in range(m):
            one, other = 0.0, 0.0
            for k in range(width):
                d, factor = dofs[j, k], factors[j, k]
                one += factor * x[d]
                other += factor * y[d]
            first[j] = one
            second[j] = other


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
    for i in range(stop - first):
        force[i] = 0.0
    for power in range(load.shape[0]):
        mean = theta * (t + h) ** power + (1.0 - theta) * t**power if power > 0 else 1.0
        part = load[power, first:stop]
        for i in range(part.size):
            force[i] += mean * part[i]


@compiled_in_place
def force_at(load: Array, t: float, h: float, theta: float, force: Array) -> None:
    """force = θF(t + h) + (1 − θ)F(t) for F = Σ load[k]·t^k."""
    force_rows(load, t, h, theta, 0, force.size, force)


@compiled_apart
def mark_held(rank: Places, side: Places, law: ContactLaw, closed: Flags, t: float, held: Flags) -> None:
    """Rows that stay closed after time t: those whose front is fewer than ``law.hold`` rows further, and before
    ``law.hold_until`` all that are closed."""
    everything = t < law.hold_until
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
