"""Compiled kernels for symmetric banded matrices of half bandwidth 3, the bandwidth of Hermite beam elements.

Storage by rows: ``A[k, m] = A(k, k − m)`` for m = 0…3, shape (n, 4): one dof is one cache line's half.
The factorisation A = U D Uᵀ runs from the last dof to the first. In a contact problem the first dofs are those
whose constraints switch, so what lies beyond the contact zone is factored once for a step and never touched again.

A *fixed* dof keeps a given value: its row and column are those of the identity.
"""

from __future__ import annotations

import numba
import numpy as np

_JIT = {"cache": True, "fastmath": {"contract"}, "error_model": "numpy"}


@numba.njit(**_JIT)
def combine(M, C, K, c, k, S):  # type: ignore[no-untyped-def]
    """S = M + c·C + k·K."""
    for i in range(M.shape[0]):
        for m in range(4):
            S[i, m] = M[i, m] + c * C[i, m] + k * K[i, m]


@numba.njit(**_JIT)
def multiply(A, x, y):  # type: ignore[no-untyped-def]
    """y = A x."""
    n = x.size
    for i in range(n):
        y[i] = A[i, 0] * x[i]
    for i in range(1, n):
        a = A[i, 1]
        y[i] += a * x[i - 1]
        y[i - 1] += a * x[i]
    for i in range(2, n):
        a = A[i, 2]
        y[i] += a * x[i - 2]
        y[i - 2] += a * x[i]
    for i in range(3, n):
        a = A[i, 3]
        y[i] += a * x[i - 3]
        y[i - 3] += a * x[i]


@numba.njit(**_JIT)
def row_times(A, x, i):  # type: ignore[no-untyped-def]
    """Row i of A times x."""
    n = x.size
    y = A[i, 0] * x[i]
    for m in range(1, 4):
        if i >= m:
            y += A[i, m] * x[i - m]
        if i + m < n:
            y += A[i + m, m] * x[i + m]
    return y


@numba.njit(**_JIT)
def quadratic(A, x):  # type: ignore[no-untyped-def]
    """xᵀ A x."""
    n = x.size
    total = 0.0
    for i in range(min(3, n)):
        y = 0.5 * A[i, 0] * x[i]
        for m in range(1, i + 1):
            y += A[i, m] * x[i - m]
        total += x[i] * y
    for i in range(3, n):
        total += x[i] * (0.5 * A[i, 0] * x[i] + A[i, 1] * x[i - 1] + A[i, 2] * x[i - 2] + A[i, 3] * x[i - 3])
    return 2.0 * total


@numba.njit(**_JIT)
def factor(S, fixed, top, D, U):  # type: ignore[no-untyped-def]
    """Factor S = U D Uᵀ from dof ``top`` down to 0; what is above ``top`` must be factored already.

    D (n + 3,) holds the pivots, U (n + 3, 4) the couplings U[q, m] = U(q − m, q); three idle dofs pad the end.
    Returns False when a pivot is not positive (the matrix is not positive definite, or not finite).
    """
    for k in range(top, -1, -1):
        if fixed[k]:
            D[k] = 1.0
            U[k, 1] = 0.0
            U[k, 2] = 0.0
            U[k, 3] = 0.0
            continue
        a1, a2, a3 = U[k + 1, 1], U[k + 2, 2], U[k + 3, 3]
        b1, b2, b3 = a1 * D[k + 1], a2 * D[k + 2], a3 * D[k + 3]
        d = S[k, 0] - a1 * b1 - a2 * b2 - a3 * b3
        if not d > 0.0:
            return False
        D[k] = d
        inverse = 1.0 / d
        U[k, 1] = 0.0 if k < 1 or fixed[k - 1] else (S[k, 1] - b1 * U[k + 1, 2] - b2 * U[k + 2, 3]) * inverse
        U[k, 2] = 0.0 if k < 2 or fixed[k - 2] else (S[k, 2] - b1 * U[k + 1, 3]) * inverse
        U[k, 3] = 0.0 if k < 3 or fixed[k - 3] else S[k, 3] * inverse
    return True


@numba.njit(**_JIT)
def sweep_in(U, b, top, z):  # type: ignore[no-untyped-def]
    """Solve U z = b from dof ``top`` down to 0; z above ``top`` must be known (z has three idle dofs at the end)."""
    z1, z2, z3 = z[top + 1], z[top + 2], z[top + 3]
    for k in range(top, -1, -1):
        value = b[k] - U[k + 2, 2] * z2 - U[k + 3, 3] * z3 - U[k + 1, 1] * z1
        z[k] = value
        z3 = z2
        z2 = z1
        z1 = value


@numba.njit(**_JIT)
def sweep_out(D, U, z, start, stop, x):  # type: ignore[no-untyped-def]
    """Solve D Uᵀ x = z for dofs start…stop − 1; x below ``start`` must be known."""
    for k in range(start, min(stop, 3)):
        value = z[k] / D[k]
        for m in range(1, k + 1):
            value -= U[k, m] * x[k - m]
        x[k] = value
    first = max(start, 3)
    if first >= stop:
        return
    x1, x2, x3 = x[first - 1], x[first - 2], x[first - 3]
    for k in range(first, stop):
        value = z[k] / D[k] - U[k, 2] * x2 - U[k, 3] * x3 - U[k, 1] * x1
        x[k] = value
        x3 = x2
        x2 = x1
        x1 = value


@numba.njit(**_JIT)
def add(sum_, k, value):  # type: ignore[no-untyped-def]
    """sum_[k] += value with Neumaier's compensation, kept in sum_[k + half]."""
    half = sum_.size // 2
    total = sum_[k]
    new = total + value
    if abs(total) >= abs(value):
        sum_[k + half] += (total - new) + value
    else:
        sum_[k + half] += (value - new) + total
    sum_[k] = new


def by_rows(lower: np.ndarray) -> np.ndarray:
    """Rows ``A[k, m] = A(k, k − m)`` from scipy's lower form ``lower[m, i] = A(i + m, i)``; at most 3 subdiagonals."""
    width, n = lower.shape
    rows = np.zeros((n, 4))
    for m in range(width):
        rows[m:, m] = lower[m, : n - m]
    return rows
