"""Compiled pieces that all schemes with unilateral rows share."""

from __future__ import annotations

import numba
import numpy as np

from hermite_fe._banded import _JIT
from hermite_fe._pivoting import solve_at_dofs


@numba.njit(**_JIT)
def rows_times(dofs, factors, x, j):  # type: ignore[no-untyped-def]
    """Row j of G x."""
    total = factors[j, 0] * x[dofs[j, 0]]
    for k in range(1, dofs.shape[1]):
        total += factors[j, k] * x[dofs[j, k]]
    return total


@numba.njit(**_JIT)
def force_at(load, t, h, theta, force):  # type: ignore[no-untyped-def]
    """force = θF(t + h) + (1 − θ)F(t) for F = Σ load[k]·t^k."""
    n = force.size
    for i in range(n):
        force[i] = load[0, i]
    for power in range(1, load.shape[0]):
        mean = theta * (t + h) ** power + (1.0 - theta) * t**power
        for i in range(n):
            force[i] += mean * load[power, i]


@numba.njit(**_JIT)
def mark_held(closed, rank, side, distance, everything, held):  # type: ignore[no-untyped-def]
    """Rows that must stay closed: those that the front has left fewer than ``distance`` rows behind, or all."""
    front = np.full(2, -1)
    for j in range(closed.size):
        if closed[j]:
            front[side[j]] = max(front[side[j]], rank[j])
    for j in range(closed.size):
        held[j] = closed[j] and (everything or front[side[j]] - rank[j] < distance)


@numba.njit(**_JIT)
def solve_rows(problem, work, fresh, closed):  # type: ignore[no-untyped-def]
    """Solve S x = b + Gᵀp with the rows of ``problem``; returns the status of the pivoting."""
    status, _ = solve_at_dofs(
        work.S, fresh, work.b, problem.dofs[:, 0], problem.factors[:, 0], work.target, work.candidate, work.held,
        closed, work.fixed, work.D, work.U, work.r, work.z, work.wrong, work.x, work.p,
    )
    return status
