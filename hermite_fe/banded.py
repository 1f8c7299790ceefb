"""Compiled products with symmetric banded matrices, and the factors of a step matrix.

A system's matrices have half bandwidth 3, as Hermite elements need, and scipy's lower form: A[m, i] = A(i + m, i),
shape (4, dofs). The step matrix has half bandwidth 4: one more where the multiplier of a contact constraint stands
between the dofs of two nodes. It is S[m, k] = S(k + m, k), shape (5, unknowns + 2·PAD), with ``PAD`` idle entries at
either end, so that loops need no case for the ends. The factors

    S = U D Uᵀ,    U[m, k] the entry (k, k + m) of U,    U[0, k] = 1/D_k

run from the last unknown to the first: a change at unknown k affects the factors of k and of all before it only. The
contact zone of a half beam is at the first unknowns.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hermite_fe.compiled import Array, Flags, Places, compiled, compiled_within

PAD = 4
BLOCK = 16  # unknowns after which a solution is checked for having faded
FADED = 1e-100
"""Smaller values, in any unit, are set to zero: they would become subnormal numbers, which slow some processors."""


@compiled
def multiply(A: Array, x: Array, y: Array) -> None:
    """y = A x."""
    for i in range(x.size):
        y[i] = A[0, i] * x[i]
    for m in range(1, 4):
        for i in range(x.size - m):
            y[i] += A[m, i] * x[i + m]
            y[i + m] += A[m, i] * x[i]


def row_sums(A: Array) -> Array:
    """Sums of A's rows over dofs at even and at odd distances, shape (2, n); sums at round-off are set to zero.

    Row 0 has no left neighbour; its odd sum is not used.
    """
    n, both = A.shape[1], np.zeros((2, 2, A.shape[1]))
    for m in range(4):
        band = np.stack([A[m, : n - m], np.abs(A[m, : n - m])])
        both[:, m % 2, : n - m] += band
        if m:
            both[:, m % 2, m:] += band
    sums, sizes = both
    sums[np.abs(sums) < 1e-12 * sizes] = 0.0
    return sums


@compiled
def stiff_multiply(A: Array, sums: Array, x: Array, y: Array) -> None:
    """y = A x for a stiffness whose large entries cancel, by differences between deflections and between slopes.

    A(i, ·)x = Σ_even A(i, j)(x_j − x_i) + even_i x_i + Σ_odd A(i, j)(x_j − x_{i−1}) + odd_i x_{i−1}

    for j − i even or odd, with ``sums`` = (even, odd) of :func:`row_sums`, and x_{−1} = 0. Round-off errors are those
    of the differences, not of 12EI/Δx³·x.
    """
    n, left = x.size, 0.0
    for i in range(n):
        y[i] = sums[0, i] * x[i] + sums[1, i] * left
        left = x[i]
    for i in range(n - 2):
        change = A[2, i] * (x[i + 2] - x[i])
        y[i] += change
        y[i + 2] -= change
    left = 0.0
    for i in range(n - 1):
        y[i] += A[1, i] * (x[i + 1] - left)
        if i + 3 < n:
            y[i] += A[3, i] * (x[i + 3] - left)
            y[i + 3] += A[3, i] * (x[i] - x[i + 2])
        left = x[i]


def product(A: Array, x: Array) -> Array:
    """A x."""
    y = np.empty(x.size)
    multiply(A, x, y)
    return y


def stiff_product(A: Array, x: Array, sums: Array | None = None) -> Array:
    """A x by differences, as the integrators compute it: what is to cancel cancels to the last digit. ``sums`` of
    :func:`row_sums`, where they are known."""
    y = np.empty(x.size)
    stiff_multiply(A, row_sums(A) if sums is None else sums, x, y)
    return y


@compiled_within
def copy(x: NDArray[Any], y: NDArray[Any]) -> None:
    """y = x, of any type. (y[:] = x takes numba seconds to compile.)"""
    for i in range(x.size):
        y[i] = x[i]


@compiled_within
def dot(x: Array, y: Array) -> float:
    """x · y."""
    total = 0.0
    for i in range(x.size):
        total += x[i] * y[i]
    return total


@compiled
def combine(M: Array, C: Array, K: Array, c: float, k: float, unknown: Places, S: Array) -> None:
    """S = M + cC + kK with the dofs at their places ``unknown`` among the unknowns; rows of multipliers are zero."""
    n = unknown.size
    S[:] = 0.0
    for i in range(n):
        here = unknown[i]
        for m in range(min(4, n - i)):
            if unknown[i + m] - here < 5:  # else the slope of one node and the next node but one: never coupled
                S[unknown[i + m] - here, here] = M[m, i] + c * C[m, i] + k * K[m, i]


@compiled_within
def factor(S: Array, fixed: Flags, sign: Array, last: int, U: Array) -> bool:
    """Compute the factors of unknown ``last`` and all before it, those beyond being valid; False where S is singular.

    fixed : unknowns whose row and column are those of the identity. sign : of the pivots, 1 for dofs, −1 for
        multipliers; any other sign means that S is not positive definite on the dofs.
    """
    for k in range(last, PAD - 1, -1):
        if fixed[k]:
            U[0, k] = 1.0
            U[1, k] = U[2, k] = U[3, k] = U[4, k] = 0.0
            continue
        u4 = 0.0 if fixed[k + 4] else S[4, k]
        u3 = (0.0 if fixed[k + 3] else S[3, k]) - U[1, k + 3] * u4
        u2 = (0.0 if fixed[k + 2] else S[2, k]) - U[1, k + 2] * u3 - U[2, k + 2] * u4
        u1 = (0.0 if fixed[k + 1] else S[1, k]) - U[1, k + 1] * u2 - U[2, k + 1] * u3 - U[3, k + 1] * u4
        U[1, k] = u1 * U[0, k + 1]
        U[2, k] = u2 * U[0, k + 2]
        U[3, k] = u3 * U[0, k + 3]
        U[4, k] = u4 * U[0, k + 4]
        pivot = S[0, k] - U[4, k] * u4 - U[3, k] * u3 - U[2, k] * u2 - U[1, k] * u1
        if not pivot * sign[k] > 0.0:
            return False
        U[0, k] = 1.0 / pivot
    return True


@compiled_within
def substitute_forward(U: Array, y: Array) -> None:
    """Solve U z = y, z in place of y."""
    z1 = z2 = z3 = z4 = 0.0
    for k in range(y.size - PAD - 1, PAD - 1, -1):
        value = (y[k] - U[4, k] * z4 - U[3, k] * z3 - U[2, k] * z2) - U[1, k] * z1
        y[k] = value
        z4, z3, z2, z1 = z3, z2, z1, value


@compiled_within
def substitute_back(U: Array, y: Array) -> None:
    """Solve D Uᵀ x = y, x in place of y."""
    x1 = x2 = x3 = x4 = 0.0
    for k in range(PAD, y.size - PAD):
        if k % BLOCK == 0 and abs(x1) + abs(x2) + abs(x3) + abs(x4) < FADED:
            x1 = x2 = x3 = x4 = 0.0
        value = (y[k] * U[0, k] - U[4, k - 4] * x4 - U[3, k - 3] * x3 - U[2, k - 2] * x2) - U[1, k - 1] * x1
        y[k] = value
        x4, x3, x2, x1 = x3, x2, x1, value
