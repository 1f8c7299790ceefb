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

from hermite_fe.kernels.jit import compiled_apart, compiled_in_place, compiled_sums

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

ROWS = 512
"""Of the step matrix that are written at a time: 20 kB."""

CHUNK = 4096
"""Dofs that a sweep takes at a time. Few enough for the second-level cache (three matrices of four arrays of 32 kB),
enough for the processor to see that it reads on: with 1,024 a step of 50,000 nodes took a tenth longer."""


@compiled_sums
def band_row(A: Array, x: Array, origin: int, n: int, i: int) -> float:
    """Row i of A x, anywhere, with x taken as zero from n on; ``x`` starts with dof ``origin``."""
    o = i - origin
    total = A[0, i] * x[o]
    for m in range(1, 4):
        if i >= m:
            total += A[m, i - m] * x[o - m]
        if i + m < n:
            total += A[m, i] * x[o + m]
    return total


@compiled_sums
def multiply_rows(A: Array, x: Array, n: int, first: int, stop: int, y: Array) -> None:
    """y = rows ``first`` … ``stop`` − 1 of A x, y (stop − first,), with x taken as zero from n on."""
    low, high = max(first, 3), min(stop, n - 3)
    for i in range(first, min(low, stop)):
        y[i - first] = band_row(A, x, 0, n, i)
    for i in range(max(high, min(low, stop)), stop):
        y[i - first] = band_row(A, x, 0, n, i)
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
def stiff_row(A: Array, even: Array, odd: Array, x: Array, origin: int, i: int) -> float:
    """Row i of :func:`stiff_multiply`, anywhere."""
    n, o = even.size, i - origin
    total = even[i] * x[o]
    if i >= 2:
        total += A[2, i - 2] * (x[o - 2] - x[o])
    if i + 2 < n:
        total += A[2, i] * (x[o + 2] - x[o])
    left = 0.0
    if i >= 1:
        left = x[o - 1]
        total += odd[i] * left
    if i >= 3:
        total += A[3, i - 3] * (x[o - 3] - left)
    if i + 1 < n:
        total += A[1, i] * (x[o + 1] - left)
    if i + 3 < n:
        total += A[3, i] * (x[o + 3] - left)
    return total


@compiled_in_place
def stiff_rows(A: Array, even: Array, odd: Array, x: Array, origin: int, first: int, stop: int, y: Array) -> None:
    """y = rows ``first`` … ``stop`` − 1 of :func:`stiff_multiply`, y (stop − first,); x[0] is dof ``origin``."""
    n = even.size
    low, high = max(first, 3), min(stop, n - 3)
    for i in range(first, min(low, stop)):
        y[i - first] = stiff_row(A, even, odd, x, origin, i)
    for i in range(max(high, min(low, stop)), stop):
        y[i - first] = stiff_row(A, even, odd, x, origin, i)
    if high <= low:
        return
    d1, d2, d3 = A[1, low:high], A[2, low:high], A[3, low:high]
    e2, e3 = A[2, low - 2 : high - 2], A[3, low - 3 : high - 3]
    s, t, inner = even[low:high], odd[low:high], y[low - first : high - first]
    o, size = low - origin, high - low
    x0, r1, r2, r3 = x[o : o + size], x[o + 1 : o + 1 + size], x[o + 2 : o + 2 + size], x[o + 3 : o + 3 + size]
    l1, l2, l3 = x[o - 1 : o - 1 + size], x[o - 2 : o - 2 + size], x[o - 3 : o - 3 + size]
    for i in range(size):
        inner[i] = (
            (s[i] * x0[i] + t[i] * l1[i])
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
    stiff_rows(A, even, odd, x, 0, 0, x.size, y)


@compiled_sums
def dot(x: Array, y: Array) -> float:
    """xᵀy."""
    total = 0.0
    for i in range(x.size):
        total += x[i] * y[i]
    return total


@compiled_sums
def quadratic_rows(A: Array, x: Array, origin: int, first: int, stop: int) -> float:
    """What rows ``first`` … ``stop`` − 1 contribute to xᵀ A x; ``x`` starts with dof ``origin``."""
    n, total = A.shape[1], 0.0
    low, high = max(first, 3), min(stop, n - 3)
    for i in range(first, min(low, stop)):
        total += x[i - origin] * band_row(A, x, origin, n, i)
    for i in range(max(high, min(low, stop)), stop):
        total += x[i - origin] * band_row(A, x, origin, n, i)
    if high <= low:
        return total
    d0, d1, d2, d3 = A[0, low:high], A[1, low:high], A[2, low:high], A[3, low:high]
    e1, e2, e3 = A[1, low - 1 : high - 1], A[2, low - 2 : high - 2], A[3, low - 3 : high - 3]
    o, size = low - origin, high - low
    x0, r1, r2, r3 = x[o : o + size], x[o + 1 : o + 1 + size], x[o + 2 : o + 2 + size], x[o + 3 : o + 3 + size]
    l1, l2, l3 = x[o - 1 : o - 1 + size], x[o - 2 : o - 2 + size], x[o - 3 : o - 3 + size]
    for i in range(size):
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
    return quadratic_rows(A, x, 0, 0, x.size)


@compiled_in_place
def combine(
    M: Array, C: Array, K: Array, m: float, c: float, k: float, place: NDArray[np.int64], S: Array
) -> None:
    """Write m·M + c·C + k·K (lower form) into S (by rows), dof i at unknown place[i]; nothing else in S
    changes."""
    n, shift = place.size, place[place.size - 1] - place.size + 1
    low, high = 0, n  # the dofs before ``high`` have multipliers between them
    while low < high:
        middle = (low + high) // 2
        if place[middle] == middle + shift:
            high = middle
        else:
            low = middle + 1
    near = min(high + 3, n) if shift > 0 else 0
    for i in range(near):
        row = place[i]
        for back in range(min(i, 3) + 1):
            j = i - back
            apart = row - place[j]
            if apart < 5:
                S[row, apart] = m * M[back, j] + c * C[back, j] + k * K[back, j]
    for first in range(near, n, ROWS):  # a few rows at a time: each of the four sweeps passes all of them
        stop = min(first + ROWS, n)
        for apart in range(4):
            start = max(first, apart)
            part = S[start + shift : stop + shift, apart]
            a, b, d = M[apart, start - apart :], C[apart, start - apart :], K[apart, start - apart :]
            for i in range(stop - start):
                part[i] = m * a[i] + c * b[i] + k * d[i]


@compiled_apart
def factor(S: Array, fixed: Flags, first: int, count: int, way: int, D: Array, U: Array) -> bool:
    """Factor ``count`` unknowns from ``first`` on: S = U D Uᵀ on the ``way`` −1 downwards, S = L D Lᵀ on the way 1
    upwards; those before ``first``, as one goes, must be factored already.

    D (n + 4,) pivots, U (n + 4, 5) their inverses U[q, 0] and couplings U[q, m] = U(q − m, q) or L(q + m, q); four idle
    rows pad the end (and come, as Python counts, before unknown 0). Returns False when a pivot is zero or not a number.
    """
    sound = True
    i1, i2, i3, i4 = first - way, first - 2 * way, first - 3 * way, first - 4 * way
    d1, d2, d3, d4 = D[i1], D[i2], D[i3], D[i4]
    u11, u12, u13, u14 = U[i1, 1], U[i1, 2], U[i1, 3], U[i1, 4]  # kept at hand: what has just been written
    u22, u23, u24 = U[i2, 2], U[i2, 3], U[i2, 4]  # would have to be waited for
    u33, u34, u44 = U[i3, 3], U[i3, 4], U[i4, 4]
    for t in range(count):
        k = first + way * t
        d, r, u1, u2, u3, u4 = 1.0, 1.0, 0.0, 0.0, 0.0, 0.0
        if not fixed[k]:
            j1, j2, j3, j4 = k + way, k + 2 * way, k + 3 * way, k + 4 * way
            b1, b2, b3, b4 = u11 * d1, u22 * d2, u33 * d3, u44 * d4
            d = S[k, 0] - b4 * u44 - b3 * u33 - b2 * u22 - b1 * u11
            sound = sound and abs(d) > 0.0
            r = 1.0 / d
            if j1 >= 0 and not fixed[j1]:
                u1 = (S[max(k, j1), 1] - b3 * u34 - b2 * u23 - b1 * u12) * r
            if j2 >= 0 and not fixed[j2]:
                u2 = (S[max(k, j2), 2] - b2 * u24 - b1 * u13) * r
            if j3 >= 0 and not fixed[j3]:
                u3 = (S[max(k, j3), 3] - b1 * u14) * r
            if j4 >= 0 and not fixed[j4]:
                u4 = S[max(k, j4), 4] * r
        D[k] = d
        U[k, 0] = r
        U[k, 1] = u1
        U[k, 2] = u2
        U[k, 3] = u3
        U[k, 4] = u4
        d1, d2, d3, d4 = d, d1, d2, d3
        u33, u34, u44 = u23, u24, u34
        u22, u23, u24 = u12, u13, u14
        u11, u12, u13, u14 = u1, u2, u3, u4
    return sound


@compiled_in_place
def factor_down(S: Array, fixed: Flags, top: int, twist: int, meeting: Array, D: Array, U: Array) -> bool:
    """:func:`factor` from unknown ``top`` down to ``twist``, what is below it being factored upwards.

    meeting : (4, 5), scratch: S between the first four unknowns, less what the elimination of those below takes off.
    """
    if twist == 0:
        return factor(S, fixed, top, top + 1, -1, D, U)
    sound = factor(S, fixed, top, top - twist - 3, -1, D, U)
    for i in range(4):
        for m in range(i + 1):
            total = S[twist + i, m]
            for q in range(twist + i - 4, twist):
                total -= U[q, twist + i - q] * D[q] * U[q, twist + i - m - q]
            meeting[i, m] = total
    last = min(top - twist, 3)
    return factor(meeting, fixed[twist:], last, last + 1, -1, D[twist:], U[twist:]) and sound


@compiled_in_place
def four_before(x: Array, first: int, way: int) -> tuple[float, float, float, float]:
    """The four values before ``first``, as one goes, the nearest first; zero where there are none."""
    n, i1, i2, i3, i4 = x.size, first - way, first - 2 * way, first - 3 * way, first - 4 * way
    x1 = x[i1] if 0 <= i1 < n else 0.0
    x2 = x[i2] if 0 <= i2 < n else 0.0
    x3 = x[i3] if 0 <= i3 < n else 0.0
    x4 = x[i4] if 0 <= i4 < n else 0.0
    return x1, x2, x3, x4


@compiled_apart
def substitute(U: Array, first: int, count: int, way: int, r: Array, z: Array) -> None:
    """Solve U z = r (L z = r), of :func:`factor`, for ``count`` unknowns from ``first`` on; z before ``first`` must be
    known (z has four idle places at the end). r may be z itself."""
    z1, z2, z3, z4 = four_before(z, first, way)
    for t in range(count):
        k = first + way * t
        value = (r[k] - U[k - 4 * way, 4] * z4 - U[k - 3 * way, 3] * z3 - U[k - 2 * way, 2] * z2) - U[k - way, 1] * z1
        z[k] = value
        z4 = z3
        z3 = z2
        z2 = z1
        z1 = value


@compiled_in_place
def substitute_down(U: Array, top: int, twist: int, z: Array) -> None:
    """:func:`substitute` in place from unknown ``top`` down to ``twist``, z below it being known from the way up."""
    if twist == 0:
        substitute(U, top, top + 1, -1, z, z)
        return
    substitute(U, top, top - twist - 3, -1, z, z)
    for i in range(4):
        total = z[twist + i]
        for q in range(twist + i - 4, twist):
            total -= U[q, twist + i - q] * z[q]
        z[twist + i] = total
    last = min(top - twist, 3)
    substitute(U[twist:], last, last + 1, -1, z[twist:], z[twist:])


@compiled_apart
def back_substitute(U: Array, z: Array, first: int, count: int, way: int, x: Array) -> None:
    """Solve D Uᵀ x = z, on the ``way`` 1 upwards (D Lᵀ x = z, on the way −1 downwards), for ``count`` unknowns from
    ``first`` on; x before ``first``, as one goes, must be known."""
    x1, x2, x3, x4 = four_before(x, first, way)
    for t in range(count):
        k = first + way * t
        value = (z[k] * U[k, 0] - U[k, 4] * x4 - U[k, 3] * x3 - U[k, 2] * x2) - U[k, 1] * x1
        x[k] = value
        x4 = x3
        x3 = x2
        x2 = x1
        x1 = value


@compiled_apart
def fade_out(U: Array, start: int, smallest: float, x: Array) -> int:
    """Go on with :func:`back_substitute`, upwards from unknown ``start``, where z is zero, until four values in a row
    are not above ``smallest``: all that follow are, and x is zero from there on. Returns where that is.
    """
    n = x.size
    x1, x2, x3, x4 = four_before(x, start, 1)
    end = n
    for k in range(start, n):
        if max(max(abs(x1), abs(x2)), max(abs(x3), abs(x4))) <= smallest:
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
