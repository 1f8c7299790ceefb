"""Compiled pieces of a contact problem's active set: right-hand sides, and which rows have the wrong sign."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.jit import compiled_apart, compiled_in_place
from hermite_fe.kernels.problem import Problem, Work

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

SOLVED, SINGULAR, CYCLING, NOT_FINITE, TOO_SHORT = 0, 1, 2, 3, 4


@compiled_in_place
def is_slope(dof: int) -> bool:
    """Deflections and slopes take turns among the dofs, as in :func:`hermite_fe.kernels.banded.row_sums`. (Not an array
    of :class:`Problem`: to look it up costs a step 1–3 %.)"""
    return dof % 2 == 1


@compiled_in_place
def first_from(increasing: NDArray[np.int64], value: int) -> int:
    """Index of the first number that is not below ``value``."""
    low, high = 0, increasing.size
    while low < high:
        middle = (low + high) // 2
        if increasing[middle] < value:
            low = middle + 1
        else:
            high = middle
    return low


@compiled_in_place
def equation(S: Array, x: Array, right: float, k: int) -> tuple[float, float]:
    """Equation k of S x less its right-hand side, and the sum of the terms' sizes: round-off is judged against it."""
    n = x.size
    term = S[k, 0] * x[k]
    total, size = term - right, abs(term) + abs(right)
    for m in range(1, 5):
        if k >= m:
            term = S[k, m] * x[k - m]
            total += term
            size += abs(term)
        if k + m < n:
            term = S[k + m, m] * x[k + m]
            total += term
            size += abs(term)
    return total, size


@compiled_apart
def right_side(
    S: Array,
    b: Array,
    place: NDArray[np.int64],
    fixed: Flags,
    switch: NDArray[np.int64],
    factors: Array,
    target: Array,
    closed: Flags,
    last_row: int,
    start: int,
    end: int,
    r: Array,
) -> None:
    """Right-hand side of the unknowns ``start`` … ``end`` − 1, rows 0 … ``last_row`` closed as ``closed`` says."""
    direct = factors.shape[1] == 1
    n = fixed.size
    first_row = first_from(switch, start - 4)
    if direct:
        for k in range(start, min(end, n)):
            r[k] = 0.0 if fixed[k] else b[k]
    else:
        for i in range(first_from(place, start), b.size):
            k = place[i]
            if k >= end:
                break
            r[k] = 0.0 if fixed[k] else b[i]
        for j in range(first_row, last_row + 1):
            k = switch[j]
            if k >= end:
                break
            if k >= start:
                r[k] = target[j] if closed[j] else 0.0
        return
    for j in range(first_row, last_row + 1):
        k = switch[j]
        if k >= end + 4:
            break
        if not closed[j]:
            continue
        value = target[j] / factors[j, 0]
        if start <= k < end:
            r[k] = value
        if value != 0.0:
            for m in range(1, 5):
                if start <= k - m < end and not fixed[k - m]:
                    r[k - m] -= S[k, m] * value
                if start <= k + m < min(n, end) and not fixed[k + m]:
                    r[k + m] -= S[k + m, m] * value


@compiled_in_place
def largest_in(place: NDArray[np.int64], y: Array, start: int, stop: int) -> tuple[float, float]:
    """Largest deflection and largest slope among the unknowns ``start`` … ``stop`` − 1: of different units, each is
    round-off's measure for its own kind alone."""
    deflection, slope = 0.0, 0.0
    for i in range(first_from(place, start), place.size):
        k = place[i]
        if k >= stop:
            break
        if is_slope(i):
            slope = max(slope, abs(y[k]))
        else:
            deflection = max(deflection, abs(y[k]))
    return deflection, slope


@compiled_in_place
def nearest_open(problem: Problem, work: Work, closed: Flags, first: int, stop: int) -> float:
    """Smallest slack of the rows ``first`` … ``stop`` − 1, which touch one dof each; −1 where one of them is closed.

    It decides nearly always that no row far from the contact zone is wrong, at a third of what looking at each costs.
    """
    dofs, factors, y = problem.dofs[first:stop, 0], problem.factors[first:stop, 0], work.y
    target, candidate, shut = work.target[first:stop], work.candidate[first:stop], closed[first:stop]
    nearest = math.inf
    for j in range(stop - first):
        slack = factors[j] * y[dofs[j]] - target[j] if candidate[j] else math.inf
        slack = -1.0 if shut[j] else slack
        nearest = slack if slack < nearest else nearest
    return nearest


@compiled_apart
def wrong_rows(
    problem: Problem, work: Work, closed: Flags, first: int, stop: int, start: int, zone: int, tolerance: float
) -> tuple[int, int, int]:
    """Mark in work.wrong which of the rows ``first`` … ``stop`` − 1 have the wrong sign, and put by how much in
    work.excess and their reactions in work.p. The unknowns from ``start`` to before ``zone`` are known, and measure
    round-off. Returns how many are wrong, the last of them, and the one that pulls most or, where none pulls, is
    furthest in the wall (−1: none)."""
    dofs, factors, place, switch = problem.dofs, problem.factors, work.place, problem.switch
    y, b, p, target = work.y, work.b, work.p, work.target
    width = factors.shape[1]
    count, last, pulling, deepest = 0, -1, -1, -1
    pull, depth = 0.0, 0.0
    deflection, slope, measured = 0.0, 0.0, False
    if width == 1 and first > 0 and nearest_open(problem, work, closed, first, stop) >= 0.0:
        p[first:stop] = 0.0
        work.wrong[first:stop] = False
        return 0, -1, -1
    for j in range(first, stop):
        bad = False
        if closed[j]:
            if width == 1:
                left, size = equation(work.S, y, b[dofs[j, 0]], switch[j])
                p[j] = left / factors[j, 0]
            else:
                k = place[dofs[j, 0]]
                _, size = equation(work.S, y, b[dofs[j, 0]], k)
                p[j] = -y[switch[j]]
            bad = not work.held[j] and p[j] < -tolerance * size / abs(factors[j, 0])
            work.excess[j] = -p[j]
            if bad and p[j] < pull:
                pull, pulling = p[j], j
        elif work.candidate[j]:
            p[j] = 0.0
            if width == 1:
                slack = factors[j, 0] * y[dofs[j, 0]] - target[j]
            else:
                slack = -target[j]
                for i in range(width):
                    slack += factors[j, i] * y[place[dofs[j, i]]]
            if slack < 0.0:
                if not measured:
                    deflection, slope = largest_in(place, y, start, zone)
                    measured = True
                size = abs(target[j])
                for i in range(width):
                    size += abs(factors[j, i]) * (slope if is_slope(dofs[j, i]) else deflection)
                bad = slack < -tolerance * size
                work.excess[j] = -slack
                if bad and slack < depth:
                    depth, deepest = slack, j
        work.wrong[j] = bad
        if bad:
            count += 1
            last = j
    return count, last, pulling if pulling >= 0 else deepest
