"""The lowest mode of a beam whose ends are held, in which it arrives.

With the deflection w, the angle φ of a section, the moment M and the transverse force Q, in units of half of the beam's
length, EI and μ, an axial force N, the rotary inertia J and the shear compliance f = 1/S (without shear 0), all of them
times e^{iωt}:

    w′ = (φ + f Q)/(1 + f N),    φ′ = M,    M′ = N w′ − Q − ω²J φ,    Q′ = −ω² w                         (1)

(S. P. Timoshenko, Phil. Mag. 41 (1921) 744–746; Q = S(w′ − φ) + N w′, N acting along the axis), and at an end

    free       M = Q = 0        hinged     w = M = 0        clamped     w = φ = 0.

Each field is a sum of Chebyshev's polynomials, (1) holds at as many points (J. P. Boyd, Chebyshev and Fourier Spectral
Methods, Dover 2001, chapter 6): A c = ω² B c, whose lowest mode is that of the largest 1/ω² of A⁻¹B.
"""

import math
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from bent_beam.errors import InputError
from bent_beam.impact import Impact
from bent_beam.loads import Array

DEGREE = 80  # of a string whose ends bend over 1/100 of its half length the mode is right to 1e-8
ROUND_OFF = 1e-3  # of the largest 1/ω²: a negative one that is larger than this means buckling
HELD = {"free": (2, 3), "hinged": (0, 2), "clamped": (0, 1)}
"""Which of w, φ, M, Q are 0 at an end."""


def lowest_mode(impact: Impact, x: Array) -> tuple[Array, Array]:
    """w, 1 in the middle, and φ, 1/m, at the places x, m from the middle; without shear φ = w′. Raises
    :class:`InputError` for a beam that has buckled."""
    half = impact.half_length
    if _is_rigid(impact):
        turns = float(impact.left_end == "hinged") - float(impact.right_end == "hinged")
        return 1.0 + turns * x / half, np.full_like(x, turns / half)
    w, angle = (chebyshev.chebval(x / half, c) for c in _lowest_of(impact)[1])
    return np.asarray(w), np.asarray(angle / half)


def lowest_frequency(impact: Impact) -> float:
    """Of the lowest mode, Hz; 0 of a beam that flies, or swings about a hinge."""
    omega = 0.0 if _is_rigid(impact) else _lowest_of(impact)[0]
    return omega * impact.wave_constant / impact.half_length**2 / (2.0 * math.pi)


def _is_rigid(impact: Impact) -> bool:
    """Whether it moves as it is, flying or swinging."""
    ends = {impact.left_end, impact.right_end}
    return ends == {"free"} or (ends == {"free", "hinged"} and not impact.axial_force)


def _lowest_of(impact: Impact) -> tuple[float, Array]:
    """ω, and the coefficients of w and φ, in the units of (1)."""
    unit, shears = impact.bending_stiffness / impact.half_length**2, impact.shear_stiffness
    inertia = impact.rotary_inertia / (impact.mass_per_length * impact.half_length**2)
    ends = (impact.left_end, impact.right_end)
    found = _lowest(ends, impact.axial_force / unit, 0.0 if shears is None else unit / shears, inertia)
    if found is None:
        raise InputError(
            "axial_force must not press with more than what a straight beam with these ends bears: it buckles "
            f"(got {impact.axial_force!r})"
        )
    return found


@lru_cache(maxsize=64)
def _lowest(ends: tuple[str, str], pull: float, compliance: float, inertia: float) -> tuple[float, Array] | None:
    """ω, and coefficients of w, 1 in the middle, and φ, (2, degrees), in the units of (1); ``None``: it has buckled."""
    if compliance * pull <= -1.0:  # by shear alone
        return None
    points, every = chebyshev.chebpts1(DEGREE), np.eye(DEGREE + 1)
    values = chebyshev.chebvander(points, DEGREE)
    slopes = chebyshev.chebvander(points, DEGREE - 1) @ chebyshev.chebder(every)
    of_w = np.array([0.0, 1.0, 0.0, compliance]) / (1.0 + compliance * pull)  # w′ of (w, φ, M, Q)
    static = np.array([of_w, [0.0, 0.0, 1.0, 0.0], pull * of_w - [0.0, 0.0, 0.0, 1.0], np.zeros(4)])
    moving = np.zeros((4, 2))  # ω² stands with w and φ alone
    moving[2, 1], moving[3, 0] = -inertia, -1.0
    left = np.kron(np.eye(4), slopes) - np.kron(static, values)
    right = np.kron(moving, values)
    at_ends = chebyshev.chebvander(np.array([-1.0, 1.0]), DEGREE)
    held = [np.kron(np.eye(4)[field], at_ends[side]) for side in (0, 1) for field in HELD[ends[side]]]
    left, right = np.vstack([left, *held]), np.vstack([right, np.zeros((4, right.shape[1]))])
    found, modes = np.linalg.eig(np.linalg.solve(left, right)[: right.shape[1]])
    inverse = found.real  # 1/ω²: of a mode that has buckled, ω² is negative
    lowest = int(np.argmax(inverse))
    if inverse.min() < -ROUND_OFF * inverse[lowest]:
        return None
    shape = modes[:, lowest].real.reshape(2, -1)
    return float(inverse[lowest]) ** -0.5, np.asarray(shape / chebyshev.chebval(0.0, shape[0]))
