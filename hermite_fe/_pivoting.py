"""Compiled active-set solution of a banded linear complementarity problem

    S x = b + Gᵀ p,      0 ≤ p ⊥ G x − c ≥ 0,      x = 0 at supports,

by block principal pivoting: guess which rows are closed (G x = c), solve, exchange every row whose sign is wrong, and
repeat. Exchanging all at once takes two or three rounds; should the number of wrong rows stop falling, one row at
a time is exchanged (Murty's rule), which cannot cycle for a positive definite S.

Here each row touches one dof (contact at nodes), so a closed row fixes its dof and p is what is left over in
that dof's equation. The factorisation runs towards the contact zone (:mod:`hermite_fe._banded`): a round costs the
zone, not the beam. A *held* row is closed whatever the sign of p; a row that is no *candidate* is open.
"""

from __future__ import annotations

import numba

from hermite_fe._banded import _JIT, factor, sweep_in, sweep_out

SOLVED, INDEFINITE, CYCLING = 0, 1, 2
PATIENCE = 8  # rounds of block exchange without progress before Murty's rule
ROUND_OFF = 1e-13


@numba.njit(**_JIT)
def solve_at_dofs(S, fresh, b, dofs, factors, target, candidate, held, closed, fixed, D, U, r, z, wrong, x, p):  # type: ignore[no-untyped-def]
    """Solve with single-dof rows, sorted by dof. Returns (status, rounds).

    S (n, 4) by rows; fresh: S is new, its factors D (n+3,), U (n+3, 4) are stale; b (n,); row j is
    factors[j]·x[dofs[j]] ≥ target[j]; closed (m,) is the guess on entry, the answer on return; fixed (n,) marks closed
    dofs and supports as the factors know them; r (n,), z (n+3,), wrong (m,) are work space; x (n,), p (m,) the answer.
    """
    n, m = b.size, dofs.size
    top = n - 1 if fresh else -1
    zone = 0
    for j in range(m):
        want = held[j] or (closed[j] and candidate[j])
        closed[j] = want
        d = dofs[j]
        if want or candidate[j]:
            zone = max(zone, d)
        if want != fixed[d]:
            fixed[d] = want
            top = max(top, min(d + 3, n - 1))
    zone = min(zone + 4, n)

    for i in range(n):
        r[i] = 0.0 if fixed[i] else b[i]
    for j in range(m):
        if closed[j]:
            _prescribe(S, fixed, dofs[j], target[j] / factors[j], r)
    if top >= 0 and not factor(S, fixed, top, D, U):
        return INDEFINITE, 0
    sweep_in(U, r, n - 1, z)

    fewest, patience, rounds = m + 1, PATIENCE, 0
    while True:
        rounds += 1
        if rounds > 100 + 4 * m:
            return CYCLING, rounds
        sweep_out(D, U, z, 0, zone, x)
        count, last = 0, -1
        scale = 0.0
        for j in range(m):
            wrong[j] = False
            p[j] = 0.0
            if candidate[j] or held[j]:
                scale = max(scale, abs(x[dofs[j]]))
        for j in range(m):
            if not (candidate[j] or held[j]):
                continue
            d = dofs[j]
            if closed[j]:
                total, size = _residual(S, x, b, d)
                p[j] = total / factors[j]
                wrong[j] = not held[j] and p[j] < -ROUND_OFF * size / abs(factors[j])
            else:
                slack = factors[j] * x[d] - target[j]
                wrong[j] = slack < -ROUND_OFF * (scale * abs(factors[j]) + abs(target[j]))
            if wrong[j]:
                count += 1
                last = j
        if count == 0:
            break
        if count < fewest:
            fewest, patience = count, PATIENCE
        else:
            patience -= 1
        top = -1
        for j in range(m):
            if wrong[j] and (patience > 0 or j == last):
                d = dofs[j]
                closed[j] = not closed[j]
                fixed[d] = closed[j]
                top = max(top, min(d + 3, n - 1))
        for i in range(min(top + 4, n)):
            r[i] = 0.0 if fixed[i] else b[i]
        for j in range(m):
            if closed[j]:
                if dofs[j] > top + 7:
                    break
                _prescribe_below(S, fixed, dofs[j], target[j] / factors[j], r, top + 4)
        if not factor(S, fixed, top, D, U):
            return INDEFINITE, rounds
        sweep_in(U, r, top, z)
    sweep_out(D, U, z, zone, n, x)
    return SOLVED, rounds


@numba.njit(**_JIT)
def _residual(S, x, b, d):  # type: ignore[no-untyped-def]
    """Row d of S x − b, and the sum of its terms' sizes, against which round-off is judged."""
    n = b.size
    total, size = S[d, 0] * x[d] - b[d], abs(S[d, 0] * x[d]) + abs(b[d])
    for k in range(1, 4):
        if d >= k:
            term = S[d, k] * x[d - k]
            total += term
            size += abs(term)
        if d + k < n:
            term = S[d + k, k] * x[d + k]
            total += term
            size += abs(term)
    return total, size


@numba.njit(**_JIT)
def _prescribe(S, fixed, d, value, r):  # type: ignore[no-untyped-def]
    """Take the known x[d] = value to the right-hand side."""
    r[d] = value
    if value != 0.0:
        for k in range(1, 4):
            if d >= k and not fixed[d - k]:
                r[d - k] -= S[d, k] * value
            if d + k < r.size and not fixed[d + k]:
                r[d + k] -= S[d + k, k] * value


@numba.njit(**_JIT)
def _prescribe_below(S, fixed, d, value, r, end):  # type: ignore[no-untyped-def]
    """As :func:`_prescribe`, touching only r[: end]."""
    if d < end:
        r[d] = value
    if value != 0.0:
        for k in range(1, 4):
            if d >= k and d - k < end and not fixed[d - k]:
                r[d - k] -= S[d, k] * value
            if d + k < r.size and d + k < end and not fixed[d + k]:
                r[d + k] -= S[d + k, k] * value
