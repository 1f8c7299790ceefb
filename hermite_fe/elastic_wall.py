"""A wall that gives way: springs and dashpots along the beam that never pull.

Per length of beam, p = u − (K − K_w)x²/2 the penetration (``facing`` is its second term) and x₊ = max(x, 0),

    R = max(0, k p + c ṗ) where p > 0,     W = ½k ∫ p₊² dx.

Over a step in which every point moves from p to p⁺ at a constant speed, each point's spring does the work −Δ(½k p₊²)
and its dashpot acts while p > 0. The mean of R over the step is then

    R̄ = max(0, G + D),     G = ½k (p₊⁺² − p₊²)/Δp,     D = c (p₊⁺ − p₊)/h.

G is a discrete gradient (Gonzalez 1996, J. Nonlinear Sci. 6, 449): G Δp is the change of the spring's energy exactly,
and (R̄ − G)Δp ≥ 0 is what the dashpot takes. Where the beam leaves faster than the wall springs back, that is all of the
spring's energy. R̄ is continuous in p⁺: a point that lands within a step does not jump.

Forces are f = ∫Nᵀ R̄ dx with the cubic p of the elements (:mod:`hermite_fe.beam`), split where p or p⁺ changes sign, so
that partly covered elements are integrated as exactly as covered ones: four Gauss points on each piece are exact for W
and for G Δp. A stop is one such spring at a node.
"""

import math
from typing import NamedTuple

import numpy as np

from bent_beam.impact import AT_ONCE
from hermite_fe.compiled import Array, compiled, compiled_within

FORCE, FORCE_TIME, PENETRATION, PRESSURE = range(4)
"""Indices in ``State.peaks``: the largest force on the whole zone of all steps, N, and its time, s; the largest
penetration, m, and pressure, N/m (at a stop force, N)."""
PEAKS = ("peak_force", "peak_force_time", "peak_penetration", "peak_pressure")

POINTS, WEIGHTS = (0.5 * (values + shift) for values, shift in zip(np.polynomial.legendre.leggauss(4), (1.0, 0.0)))
HALVINGS = 60  # of an interval that holds a zero


class Springs(NamedTuple):
    """stiffness, damping : k, N/m², and c, N s/m²; of a stop N/m and N s/m. facing : (dofs,), p = side·q + facing, m.

    lengths, shares : (elements,), m, and σ of shear.
    Elements ``first`` to ``last`` − 1 stand before the wall. stop : the dof of a stop, or −1.
    side : 1 of a wall in front of the beam, −1 behind it. at_landing : c where all of a stop or a plate lands at once,
    within ``at_once`` of a step.
    """

    stiffness: float
    damping: float
    facing: Array
    lengths: Array
    shares: Array
    first: int
    last: int
    stop: int
    side: float = 1.0
    at_landing: float = 0.0
    at_once: float = AT_ONCE  # a field: in compiled code a constant of another package would stay what it was


NO_SPRINGS = Springs(0.0, 0.0, np.zeros(0), np.zeros(0), np.zeros(0), 0, 0, -1)
"""A rigid wall."""


@compiled_within
def shapes(at: float, length: float, share: float) -> tuple[float, float, float, float]:
    """N₁ … N₄ at ξ = ``at`` of an element with the share σ of shear (:mod:`hermite_fe.beam`)."""
    square, cube = at * at, at * at * at
    sheared = share * (at - 3.0 * square + 2.0 * cube)
    return (1.0 - 3.0 * square + 2.0 * cube - sheared, length * (at - 2.0 * square + cube - 0.5 * sheared),
            3.0 * square - 2.0 * cube + sheared, length * (cube - square - 0.5 * sheared))  # fmt: skip


@compiled_within
def sunk(springs: Springs, q: Array, i: int) -> float:
    """p, or its slope, of dof i."""
    return springs.side * q[i] + springs.facing[i]


@compiled_within
def depth(springs: Springs, q: Array, e: int, at: float) -> float:
    """p at ξ = ``at`` of element e."""
    n1, n2, n3, n4 = shapes(at, springs.lengths[e], springs.shares[e])
    i = 2 * e
    return (n1 * sunk(springs, q, i) + n2 * sunk(springs, q, i + 1)
            + n3 * sunk(springs, q, i + 2) + n4 * sunk(springs, q, i + 3))  # fmt: skip


@compiled_within
def reaction(p: float, new: float, h: float, stiffness: float, damping: float) -> tuple[float, float, float]:
    """R̄, dR̄/dp⁺ and the dashpot's loss (R̄ − G)Δp of one point."""
    before, after = max(p, 0.0), max(new, 0.0)
    if before == 0.0 and after == 0.0:
        return 0.0, 0.0, 0.0
    if before > 0.0 and after > 0.0:
        spring, slope = 0.5 * stiffness * (p + new), 0.5 * stiffness
    else:
        spring = 0.5 * stiffness * (after * after - before * before) / (new - p)
        slope = (stiffness * after - spring) / (new - p)
    force = spring + damping * (after - before) / h
    if force <= 0.0:
        return 0.0, 0.0, -spring * (new - p)
    return force, slope + (damping / h if after > 0.0 else 0.0), (force - spring) * (new - p)


@compiled_within
def bernstein(a: float, b: float, c: float, d: float, at: float) -> float:
    """The cubic with the Bernstein coefficients a … d at ξ = ``at``."""
    rest = 1.0 - at
    return rest * rest * (rest * a + 3.0 * at * b) + at * at * (3.0 * rest * c + at * d)


@compiled_within
def coefficients(springs: Springs, q: Array, e: int) -> tuple[float, float, float, float]:
    """Bernstein's of p of element e: between the smallest and the largest lies p."""
    i, third = 2 * e, springs.lengths[e] / 3.0
    a, left, d, right = (sunk(springs, q, i), sunk(springs, q, i + 1),
                         sunk(springs, q, i + 2), sunk(springs, q, i + 3))  # fmt: skip
    angle = springs.shares[e] * ((d - a) / springs.lengths[e] - 0.5 * (left + right))
    return a, a + third * (left + angle), d - third * (right + angle), d


@compiled_within
def add_zeros(springs: Springs, q: Array, e: int, places: Array, count: int) -> int:
    """Add the places 0 < ξ < 1 where p of element e changes sign to ``places``; returns how many there are now.

    Between its turning points a cubic is monotone; a change of sign there is found by halving.
    """
    a, b, c, d = coefficients(springs, q, e)
    if max(a, b, c, d) <= 0.0 or min(a, b, c, d) >= 0.0:
        return count
    first, bend, curve = b - a, c - 2.0 * b + a, d - 3.0 * c + 3.0 * b - a  # p′/3 = first + 2 bend ξ + curve ξ²
    root = math.sqrt(max(bend * bend - curve * first, 0.0))
    turn = -(bend + math.copysign(root, bend))
    one = turn / curve if curve != 0.0 else 0.0
    other = first / turn if turn != 0.0 else 0.0
    low = 0.0
    for end in (min(max(min(one, other), 0.0), 1.0), min(max(max(one, other), 0.0), 1.0), 1.0):
        left, high = low, end
        below = bernstein(a, b, c, d, left) > 0.0
        if end > low and below != (bernstein(a, b, c, d, high) > 0.0):
            for _ in range(HALVINGS):
                middle = 0.5 * (left + high)
                if (bernstein(a, b, c, d, middle) > 0.0) == below:
                    left = middle
                else:
                    high = middle
            places[count] = 0.5 * (left + high)
            count += 1
        low = end
    return count


@compiled_within
def split(springs: Springs, q: Array, new: Array, e: int, places: Array) -> int:
    """Put 0, the places where p or p⁺ of element e changes sign, and 1 into ``places``, in order; returns how many."""
    places[0] = 0.0
    count = add_zeros(springs, new, e, places, add_zeros(springs, q, e, places, 1))
    places[count] = 1.0
    places[: count + 1].sort()
    return count + 1


@compiled_within
def note_peaks(springs: Springs, q: Array, new: Array, e: int, at: float, h: float, peaks: Array) -> None:
    """Note penetration and pressure at ``at`` of an element: a plate, or half a beam, is often deepest at its end."""
    after = depth(springs, new, e, at)
    pressure, _, _ = reaction(depth(springs, q, e, at), after, h, springs.stiffness, springs.damping)
    peaks[PENETRATION], peaks[PRESSURE] = max(peaks[PENETRATION], after), max(peaks[PRESSURE], pressure)


@compiled_within
def push(
    springs: Springs, q: Array, new: Array, h: float, force: Array, tangent: Array, peaks: Array
) -> tuple[float, float, int]:
    """f = ∫Nᵀ R̄ dx, (dofs,), of a step from q to ``new``; ∂f/∂q⁺ is added to ``tangent``, lower banded, (4, dofs).

    Returns the whole force, N, the dashpots' loss over the step, J, and the last dof that is touched, −1: none. Forces
    are positive off the wall. ``peaks`` takes the largest penetration and pressure.
    """
    force[:] = 0.0
    total, loss, touched, places = 0.0, 0.0, -1, np.zeros(8)
    peaks[PENETRATION] = peaks[PRESSURE] = 0.0
    for e in range(springs.first, springs.last):
        if max(coefficients(springs, q, e)) <= 0.0 and max(coefficients(springs, new, e)) <= 0.0:
            continue  # off the wall
        length, i, count = springs.lengths[e], 2 * e, split(springs, q, new, e, places)
        for piece in range(count - 1):
            span = places[piece + 1] - places[piece]
            note_peaks(springs, q, new, e, places[piece], h, peaks)
            for point in range(4):
                at = places[piece] + span * POINTS[point]
                p, after = depth(springs, q, e, at), depth(springs, new, e, at)
                if p <= 0.0 and after <= 0.0:
                    break  # nowhere on this piece
                pressure, slope, taken = reaction(p, after, h, springs.stiffness, springs.damping)
                weight = WEIGHTS[point] * span * length
                total += weight * pressure
                loss += weight * taken
                touched = i + 3
                peaks[PENETRATION] = max(peaks[PENETRATION], after)
                peaks[PRESSURE] = max(peaks[PRESSURE], pressure)
                N = shapes(at, length, springs.shares[e])
                for j in range(4):
                    force[i + j] += weight * pressure * N[j]
                    for m in range(j + 1):
                        tangent[j - m, i + m] += weight * slope * N[j] * N[m]
    if springs.first < springs.last:
        note_peaks(springs, q, new, springs.last - 1, 1.0, h, peaks)
    if springs.stop >= 0:
        i = springs.stop
        after = sunk(springs, new, i)
        pressure, slope, taken = reaction(sunk(springs, q, i), after, h, springs.stiffness, springs.damping)
        total, loss, touched = pressure, taken, i
        peaks[PENETRATION], peaks[PRESSURE] = max(after, 0.0), pressure
        force[i] = pressure
        tangent[0, i] += slope
    return total, loss, touched


@compiled_within
def landing(springs: Springs, q: Array, new: Array, v: Array) -> tuple[float, float]:
    """Force, N, and largest pressure at the instant at which all of a stop or plate lands at once, between q, with the
    velocities v, and ``new``: its dashpots have it before the beam has slowed down. 0 where it lands bit by bit."""
    if springs.at_landing == 0.0:
        return 0.0, 0.0
    flow, fastest, low, high, after = 0.0, 0.0, math.inf, -math.inf, -math.inf
    for e in range(springs.first, springs.last):
        low, high = min(low, min(coefficients(springs, q, e))), max(high, max(coefficients(springs, q, e)))
        after = max(after, max(coefficients(springs, new, e)))
        if high > 0.0 or high - low > springs.at_once * (after - high):
            return 0.0, 0.0
        i, length = 2 * e, springs.lengths[e]
        flow += length * (0.5 * (v[i] + v[i + 2]) + length / 12.0 * (v[i + 1] - v[i + 3]))
        fastest = max(fastest, springs.side * v[i], springs.side * v[i + 2])
    if springs.stop >= 0:
        high, after = sunk(springs, q, springs.stop), sunk(springs, new, springs.stop)
        flow = v[springs.stop]
        fastest = springs.side * flow
    if not high <= 0.0 < after:
        return 0.0, 0.0
    return springs.at_landing * springs.side * flow, springs.at_landing * fastest


@compiled
def stored_energy(springs: Springs, q: Array) -> float:
    """W, J."""
    energy, places = 0.0, np.zeros(8)
    for e in range(springs.first, springs.last):
        count = split(springs, q, q, e, places)
        for piece in range(count - 1):
            span = places[piece + 1] - places[piece]
            for point in range(4):
                p = max(depth(springs, q, e, places[piece] + span * POINTS[point]), 0.0)
                energy += 0.5 * springs.stiffness * p * p * WEIGHTS[point] * span * springs.lengths[e]
    if springs.stop >= 0:
        p = max(sunk(springs, q, springs.stop), 0.0)
        energy += 0.5 * springs.stiffness * p * p
    return energy
