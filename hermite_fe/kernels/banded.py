"""Compiled kernels for symmetric banded matrices.

Matrices of a system (half bandwidth 3, as Hermite elements have) are kept in scipy's lower form, ``A[m, i] =
A(i + m, i)``, shape (4, n): products run along diagonals.

The matrix that is factored has half bandwidth 4, room for a contact multiplier between the dofs of two nodes,
and is kept by rows, ``S[k, m] = S(k, k − m)``, shape (n, 5). Its factorisation is twisted: it runs from the last
unknown down to unknown ``twist`` and from the first one up to it. In a contact problem constraints switch at the
front of the contact zone, so what lies beyond the zone, and what lies settled within it, is factored once and not
touched again. Below ``twist``, U holds the couplings to the four unknowns that follow, from there on those to the
four before. A *fixed* unknown has row and column of the identity.

A long beam's matrices do not fit the processor's cache. What ends in ``_rows`` works on some rows, so that a step can
do all that it does with them while they are there: ``CHUNK`` dofs at a time.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.jit import compiled, compiled_in_place, compiled_sums

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

CHUNK = 8192
"""Dofs that a sweep takes at a time. Few enough for the second-level cache (four arrays of 64 kB a matrix), enough for
the processor to see that it reads on: with 1,024 a step of 50,000 nodes took a fifth longer."""


@compiled_sums
def band_row(A: Array, x: Array, n: int, i: int) -> float:
    """Row i of A x, anywhere, with x taken as zero from n on."""
    total = A[0, i] * x[i]
    for m in range(1, 4):
        if i >= m:
            total += A[m, i - m] * x[i - m]
        if i + m < n:
            total += A[m, i] * x[i + m]
    return total


@compiled_sums
def multiply_rows(A: Array, x: Array, n: int, first: int, stop: int, y: Array) -> None:
    """y = rows ``first`` … ``stop`` − 1 of A x, y (stop − first,), with x taken as zero from n on."""
    low, high = max(first, 3), min(stop, n - 3)
    for i in range(first, min(low, stop)):
        y[i - first] = band_row(A, x, n, i)
    for i in range(max(high, min(low, stop)), stop):
        y[i - first] = band_row(A, x, n, i)
    if high <= low:
        return
    d0, d1, d2, d3 = A[0, low:high], A[1, low:high], A[2, low:high], A[3, low:high]
    e1, e2, e3 = A[1, low - 1 : high - 1], A[2, low - 2 : high - 2], A[3, low - 3 : high - 3]
    x0, r1, r2, r3 = x[low:high], x[low + 1 : high + 1], x[low + 2 : high + 2], x[low + 3 : high + 3]
    l1, l2, l3 = x[low - 1 : high - 1], x[low - 2 : high - 2], x[low - 3 : high - 3]
    inner = y[low - first : high - first]
    for i in range(high - low):
        inner[i] = (
            d0[i] * x0[i]
            + d1[i] * r1[i]
            + d2[i] * r2[i]
            + d3[i] * r3[i]
            + e1[i] * l1[i]
            + e2[i] * l2[i]
            + e3[i] * l3[i]
        )


@compiled_sums
def multiply(A: Array, x: Array, y: Array, n: int) -> None:
    """y = A x for A in lower form, in the first n places, with x taken as zero beyond them."""
    multiply_rows(A, x, n, 0, n, y)


@compiled_in_place
def stiff_row(A: Array, even: Array, odd: Array, x: Array, i: int) -> float:
    """Row i of :func:`stiff_multiply`, anywhere."""
    n = x.size
    total = even[i] * x[i]
    if i >= 2:
        total += A[2, i - 2] * (x[i - 2] - x[i])
    if i + 2 < n:
        total += A[2, i] * (x[i + 2] - x[i])
    left = 0.0
    if i >= 1:
        left = x[i - 1]
        total += odd[i] * left
    if i >= 3:
        total += A[3, i - 3] * (x[i - 3] - left)
    if i + 1 < n:
        total += A[1, i] * (x[i + 1] - left)
    if i + 3 < n:
        total += A[3, i] * (x[i + 3] - left)
    return total


@compiled_in_place
def stiff_rows(A: Array, even: Array, odd: Array, x: Array, first: int, stop: int, y: Array) -> None:
    """y = rows ``first`` … ``stop`` − 1 of :func:`stiff_multiply`, y (stop − first,)."""
    n = x.size
    low, high = max(first, 3), min(stop, n - 3)
    for i in range(first, min(low, stop)):
        y[i - first] = stiff_row(A, even, odd, x, i)
    for i in range(max(high, min(low, stop)), stop):
        y[i - first] = stiff_row(A, even, odd, x, i)
    if high <= low:
        return
    d1, d2, d3 = A[1, low:high], A[2, low:high], A[3, low:high]
    e2, e3 = A[2, low - 2 : high - 2], A[3, low - 3 : high - 3]
    s, o, inner = even[low:high], odd[low:high], y[low - first : high - first]
    x0, r1, r2, r3 = x[low:high], x[low + 1 : high + 1], x[low + 2 : high + 2], x[low + 3 : high + 3]
    l1, l2, l3 = x[low - 1 : high - 1], x[low - 2 : high - 2], x[low - 3 : high - 3]
    for i in range(high - low):
        inner[i] = (
            (s[i] * x0[i] + o[i] * l1[i])
            + (e2[i] * (l2[i] - x0[i]) + d2[i] * (r2[i] - x0[i]))
            + (e3[i] * (l3[i] - l1[i]) + d1[i] * (r1[i] - l1[i]) + d3[i] * (r3[i] - l1[i]))
        )


@compiled_in_place
def stiff_multiply(A: Array, even: Array, odd: Array, x: Array, y: Array) -> None:
    """y = A x for a stiffness whose large entries cancel, by differences of neighbouring dofs of a kind.

    A(i, ·)x = Σ_even A(i, j)(x_j − x_i) + even_i x_i + Σ_odd A(i, j)(x_j − x_{i−1}) + odd_i x_{i−1}

    for j − i even or odd, with the row sums even, odd of :func:`row_sums`. Round-off is then that of the
    differences, not of 12EI/Δx³·x.
    """
    stiff_rows(A, even, odd, x, 0, x.size, y)


@compiled_sums
def dot(x: Array, y: Array) -> float:
    """xᵀy."""
    total = 0.0
    for i in range(x.size):
        total += x[i] * y[i]
    return total


@compiled_sums
def is_finite(x: Array) -> bool:
    """Whether no number of x is infinite or none."""
    total = 0.0
    for i in range(x.size):
        total += 0.0 * x[i]
    return total == 0.0


@compiled_sums
def quadratic_rows(A: Array, x: Array, first: int, stop: int) -> float:
    """What rows ``first`` … ``stop`` − 1 contribute to xᵀ A x."""
    n, total = x.size, 0.0
    low, high = max(first, 3), min(stop, n - 3)
    for i in range(first, min(low, stop)):
        total += x[i] * band_row(A, x, n, i)
    for i in range(max(high, min(low, stop)), stop):
        total += x[i] * band_row(A, x, n, i)
    if high <= low:
        return total
    d0, d1, d2, d3 = A[0, low:high], A[1, low:high], A[2, low:high], A[3, low:high]
    e1, e2, e3 = A[1, low - 1 : high - 1], A[2, low - 2 : high - 2], A[3, low - 3 : high - 3]
    x0, r1, r2, r3 = x[low:high], x[low + 1 : high + 1], x[low + 2 : high + 2], x[low + 3 : high + 3]
    l1, l2, l3 = x[low - 1 : high - 1], x[low - 2 : high - 2], x[low - 3 : high - 3]
    for i in range(high - low):
        total += x0[i] * (
            d0[i] * x0[i]
            + d1[i] * r1[i]
            + d2[i] * r2[i]
            + d3[i] * r3[i]
            + e1[i] * l1[i]
            + e2[i] * l2[i]
            + e3[i] * l3[i]
        )
    return total


@compiled_sums
def quadratic(A: Array, x: Array) -> float:
    """xᵀ A x for A in lower form, row by row: the large terms of a stiffness cancel before they are
    summed."""
    return quadratic_rows(A, x, 0, x.size)


@compiled_in_place
def combine(
    M: Array, C: Array, K: Array, m: float, c: float, k: float, place: NDArray[np.int64], S: Array
) -> None:
    """Write m·M + c·C + k·K (lower form) into S (by rows), dof i at unknown place[i]; nothing else in S
    changes."""
    n = place.size
    if place[n - 1] == n - 1:  # no multipliers between the dofs
        for apart in range(min(4, n)):
            for i in range(n - apart):
                S[i + apart, apart] = m * M[apart, i] + c * C[apart, i] + k * K[apart, i]
        return
    for i in range(n):
        row = place[i]
        for j in range(max(0, i - 3), i + 1):
            apart = row - place[j]
            if apart < 5:
                S[row, apart] = m * M[i - j, j] + c * C[i - j, j] + k * K[i - j, j]


@compiled_in_place
def factor(S: Array, fixed: Flags, top: int, bottom: int, D: Array, U: Array) -> bool:
    """Factor S = U D Uᵀ from unknown ``top`` down to ``bottom``; what is above ``top`` must be factored already.

    D (n + 4,) pivots, U (n + 4, 5) their inverses U[q, 0] and couplings U[q, m] = U(q − m, q); four idle rows pad the
    end. Returns False when a pivot is zero or not a number.
    """
    sound = True
    for t in range(top + 1 - bottom):
        k = top - t
        if fixed[k]:
            D[k] = 1.0
            U[k, 0] = 1.0
            for m in range(1, 5):
                U[k, m] = 0.0
            continue
        b1, b2 = U[k + 1, 1] * D[k + 1], U[k + 2, 2] * D[k + 2]
        b3, b4 = U[k + 3, 3] * D[k + 3], U[k + 4, 4] * D[k + 4]
        d = S[k, 0] - b4 * U[k + 4, 4] - b3 * U[k + 3, 3] - b2 * U[k + 2, 2] - b1 * U[k + 1, 1]
        sound = sound and abs(d) > 0.0
        r = 1.0 / d
        D[k] = d
        U[k, 0] = r
        u1 = (S[k, 1] - b3 * U[k + 3, 4] - b2 * U[k + 2, 3] - b1 * U[k + 1, 2]) * r
        u2 = (S[k, 2] - b2 * U[k + 2, 4] - b1 * U[k + 1, 3]) * r
        u3 = (S[k, 3] - b1 * U[k + 1, 4]) * r
        u4 = S[k, 4] * r
        U[k, 1] = 0.0 if k < 1 or fixed[k - 1] else u1
        U[k, 2] = 0.0 if k < 2 or fixed[k - 2] else u2
        U[k, 3] = 0.0 if k < 3 or fixed[k - 3] else u3
        U[k, 4] = 0.0 if k < 4 or fixed[k - 4] else u4
    return sound


@compiled_in_place
def factor_up(S: Array, fixed: Flags, first: int, stop: int, D: Array, U: Array) -> bool:
    """Factor S = L D Lᵀ from unknown ``first`` up to ``stop`` − 1, with L(q + m, q) in U[q, m]; what is below ``first``
    must be factored already. (Before unknown 0 come, as Python counts, the idle rows at the end.)"""
    sound = True
    for k in range(first, stop):
        if fixed[k]:
            D[k] = 1.0
            U[k, 0] = 1.0
            for m in range(1, 5):
                U[k, m] = 0.0
            continue
        b1, b2 = U[k - 1, 1] * D[k - 1], U[k - 2, 2] * D[k - 2]
        b3, b4 = U[k - 3, 3] * D[k - 3], U[k - 4, 4] * D[k - 4]
        d = S[k, 0] - b4 * U[k - 4, 4] - b3 * U[k - 3, 3] - b2 * U[k - 2, 2] - b1 * U[k - 1, 1]
        sound = sound and abs(d) > 0.0
        r = 1.0 / d
        D[k] = d
        U[k, 0] = r
        u1 = (S[k + 1, 1] - b3 * U[k - 3, 4] - b2 * U[k - 2, 3] - b1 * U[k - 1, 2]) * r
        u2 = (S[k + 2, 2] - b2 * U[k - 2, 4] - b1 * U[k - 1, 3]) * r
        u3 = (S[k + 3, 3] - b1 * U[k - 1, 4]) * r
        u4 = S[k + 4, 4] * r
        U[k, 1] = 0.0 if fixed[k + 1] else u1
        U[k, 2] = 0.0 if fixed[k + 2] else u2
        U[k, 3] = 0.0 if fixed[k + 3] else u3
        U[k, 4] = 0.0 if fixed[k + 4] else u4
    return sound


@compiled
def factor_down(S: Array, fixed: Flags, top: int, twist: int, D: Array, U: Array) -> bool:
    """:func:`factor` from unknown ``top`` down to ``twist``, what is below it factored by :func:`factor_up`."""
    if twist == 0:
        return factor(S, fixed, top, 0, D, U)
    sound = top < twist + 4 or factor(S, fixed, top, twist + 4, D, U)
    meeting = np.zeros((4, 5))  # S between the first four unknowns, less what the elimination of those below takes off
    for i in range(4):
        for m in range(i + 1):
            total = S[twist + i, m]
            for q in range(twist + i - 4, twist):
                total -= U[q, twist + i - q] * D[q] * U[q, twist + i - m - q]
            meeting[i, m] = total
    return factor(meeting, fixed[twist:], min(top - twist, 3), 0, D[twist:], U[twist:]) and sound


@compiled_in_place
def forward_substitute(U: Array, top: int, bottom: int, z: Array) -> None:
    """Solve U z = r from unknown ``top`` down to ``bottom``, in place of r; z above ``top`` must be known (z has four
    idle places at the end)."""
    z1, z2, z3, z4 = z[top + 1], z[top + 2], z[top + 3], z[top + 4]
    for t in range(top + 1 - bottom):
        k = top - t
        value = (z[k] - U[k + 4, 4] * z4 - U[k + 3, 3] * z3 - U[k + 2, 2] * z2) - U[k + 1, 1] * z1
        z[k] = value
        z4 = z3
        z3 = z2
        z2 = z1
        z1 = value


@compiled_in_place
def substitute_up(U: Array, first: int, stop: int, z: Array) -> None:
    """Solve L z = r, of :func:`factor_up`, from unknown ``first`` up to ``stop`` − 1, in place of r; z below ``first``
    must be known."""
    z1, z2, z3, z4 = 0.0, 0.0, 0.0, 0.0
    if first > 0:
        z1, z2, z3, z4 = z[first - 1], z[first - 2], z[first - 3], z[first - 4]
    for k in range(first, stop):
        value = (z[k] - U[k - 4, 4] * z4 - U[k - 3, 3] * z3 - U[k - 2, 2] * z2) - U[k - 1, 1] * z1
        z[k] = value
        z4 = z3
        z3 = z2
        z2 = z1
        z1 = value


@compiled_in_place
def substitute_down(U: Array, top: int, twist: int, z: Array) -> None:
    """:func:`forward_substitute` from unknown ``top`` down to ``twist``, z below it known by :func:`substitute_up`."""
    if twist == 0:
        forward_substitute(U, top, 0, z)
        return
    if top >= twist + 4:
        forward_substitute(U, top, twist + 4, z)
    for i in range(4):
        total = z[twist + i]
        for q in range(twist + i - 4, twist):
            total -= U[q, twist + i - q] * z[q]
        z[twist + i] = total
    forward_substitute(U[twist:], min(top - twist, 3), 0, z[twist:])


@compiled_in_place
def back_substitute(U: Array, z: Array, start: int, stop: int, x: Array) -> None:
    """Solve D Uᵀ x = z for unknowns start…stop − 1; x below ``start`` must be known."""
    x1, x2, x3, x4 = 0.0, 0.0, 0.0, 0.0
    if start > 0:
        x1 = x[start - 1]
    if start > 1:
        x2 = x[start - 2]
    if start > 2:
        x3 = x[start - 3]
    if start > 3:
        x4 = x[start - 4]
    for k in range(start, stop):
        value = (z[k] * U[k, 0] - U[k, 4] * x4 - U[k, 3] * x3 - U[k, 2] * x2) - U[k, 1] * x1
        x[k] = value
        x4 = x3
        x3 = x2
        x2 = x1
        x1 = value


@compiled_in_place
def back_substitute_down(U: Array, z: Array, twist: int, x: Array) -> None:
    """Solve D Lᵀ x = z, of :func:`factor_up`, from unknown ``twist`` − 1 down to 0; x from ``twist`` on must be known.
    """
    if twist == 0:
        return
    x1, x2, x3, x4 = x[twist], x[twist + 1], x[twist + 2], x[twist + 3]
    for t in range(twist):
        k = twist - 1 - t
        value = (z[k] * U[k, 0] - U[k, 4] * x4 - U[k, 3] * x3 - U[k, 2] * x2) - U[k, 1] * x1
        x[k] = value
        x4 = x3
        x3 = x2
        x2 = x1
        x1 = value


@compiled_in_place
def fade_out(U: Array, start: int, smallest: float, x: Array) -> int:
    """Go on with :func:`back_substitute` from unknown ``start`` where z is zero, until four values in a row are below
    ``smallest``: all that follow are, and x is zero from there on. Returns where that is.
    """
    n = x.size
    x1, x2, x3, x4 = 0.0, 0.0, 0.0, 0.0
    if start > 0:
        x1 = x[start - 1]
    if start > 1:
        x2 = x[start - 2]
    if start > 2:
        x3 = x[start - 3]
    if start > 3:
        x4 = x[start - 4]
    end = n
    for k in range(start, n):
        if max(max(abs(x1), abs(x2)), max(abs(x3), abs(x4))) < smallest:
            end = k
            break
        value = (-U[k, 4] * x4 - U[k, 3] * x3 - U[k, 2] * x2) - U[k, 1] * x1
        x[k] = value
        x4 = x3
        x3 = x2
        x2 = x1
        x1 = value
    x[end:] = 0.0
    return end


@compiled_in_place
def add(sums: Array, k: int, value: float) -> None:
    """sums[k] += value with Neumaier's compensation, kept half the array further."""
    half = sums.size // 2
    total = sums[k]
    new = total + value
    if abs(total) >= abs(value):
        sums[k + half] += (total - new) + value
    else:
        sums[k + half] += (value - new) + total
    sums[k] = new


def row_sums(A: Array) -> tuple[Array, Array]:
    """Sums of A's rows over dofs an even and an odd distance away, shape (n,) each; round-off is cut to zero.

    Row 0 has no dof to its left to take odd differences from; its odd sum is not used.
    """
    n = A.shape[1]
    sums, sizes = np.zeros((2, n)), np.zeros((2, n))
    for m in range(4):
        band = A[m, : n - m]
        sums[m % 2, : n - m] += band
        sizes[m % 2, : n - m] += np.abs(band)
        if m:
            sums[m % 2, m:] += band
            sizes[m % 2, m:] += np.abs(band)
    sums[np.abs(sums) < 1e-12 * sizes] = 0.0
    return sums[0], sums[1]
