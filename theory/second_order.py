r"""The second order in the loads and the axial force: how far the first order is off (new, not in the thesis).

    λ_c = √τ(λ₀ + λ₁τ + λ₂τ²),   R̃ = 2√(2/π)(r₀ + r₁τ + r₂τ²)/√τ,   ε = 1 (α stands for εα and so on)

Outside the front η is a decaying wave, inside it is the free motion w₀ (continuous) or what leaves the middle free
(detached). With z = e^{−iπ/4}x/2 and ∂⁴ − n∂² = (∂² − n/2 − (n²/8)∂⁻² …)²,

    η/τ = Re{B₀i²erfc z + τ[B₁i⁴erfc z − (in/2)B₀i²erfc z]
            + τ²[B₂i⁶erfc z − (in/2)B₁i⁴erfc z − (n²/8)B₀i²erfc z + (n²/2)B₀i⁴erfc z]},
    w₀/τ = 1 − κx²/2 + τ(α/2 + χx²/2 + ψx⁴/24) + τ²n(χ/6 + ψx²/4),
    middle, detached: the first two terms of w₀/τ + τ[a₁(1 − x⁴/12) + b₁x² − nκ/2]
            + τ²[a₂(1 − x⁴/4) + b₂(x² − x⁶/180) + n(b₁/3 − a₁x²/2)].

At x = λ₀ + λ₁τ + λ₂τ² both sides have deflection and slope of w₀, the same curvature, and third derivatives that
differ by √(2/π)(r₀ + r₁τ + r₂τ²): linear equations, order by order. The last term of w₀ is what the axial force makes
of the loads' own free motion.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial import Polynomial
from numpy.typing import NDArray

from theory._fresnel import TURN, FloatArray, scaled_erfc
from theory.contact import DETACHED, ContactParameters
from theory.similarity import wave_amplitude

_SLOPE = float(np.sqrt(2.0 / np.pi))
_NEAR = 1.0  # |z| below which the recurrence of iⁿerfc may run upwards
_LAST, _LAST_NEAR = 30, 220.0  # n from which it runs downwards: _LAST + _LAST_NEAR/|z|²


@dataclass(frozen=True)
class SecondOrder:
    """λ₂ and r₂ of one impact, and its λ₁ and r₁ once more, found on the way without any φ.

    opening : rate at which the loads change the curvature of the gap at the front, in τ; one point, whose gap has
        κ − 1 at first, spreads once it is gone.
    """

    lambda1: float
    r1: float
    lambda2: float
    r2: float
    opening: float


def second_order(parameters: ContactParameters) -> SecondOrder:
    """λ₂ and r₂ of one impact; relative error about 1e-6, for λ₀ < 100. ``ValueError`` for parameters of several."""
    p = parameters
    if np.ndim(p.lambda0):
        raise ValueError("parameters must be those of one impact (got arrays)")
    x, n, lifts = float(p.lambda0), float(p.axial), p.regime == DETACHED
    jump = _SLOPE * p.r0
    erfc = _scaled(x)
    # i²erfc, i⁴erfc, i⁶erfc and their derivatives in x, per amplitude at the front
    w0, w1, w2 = (np.array([(-TURN) ** m * erfc[order - m] for m in range(6)]) for order in (2, 4, 6))
    b0 = complex(wave_amplitude(p))

    # what there is beyond the unknowns, less the free motion; the middle, less the free motion
    flight = _even(x, p.alpha / 2.0, p.chi / 2.0, p.psi / 24.0)
    rest, a1, b1, middle = (-0.5j * n * b0 * w0).real[:5] - flight, 0.0, 0.0, np.zeros(5)
    if lifts:
        shapes = _even(x, 1.0, 0.0, -1.0 / 12.0), _even(x, 0.0, 1.0)
        middle, a1, b1 = _resting(_even(x, -n * p.kappa_over_nu / 2.0) - flight, *shapes)
    amplitude, lambda1, r1 = _solved(w1, rest - middle, jump, x)
    outside = rest + (amplitude * w1[:5]).real

    flight = _even(x, n * p.chi / 6.0, n * p.psi / 4.0)
    rest = (-0.5j * n * amplitude * w1 - n**2 / 8.0 * b0 * w0 + n**2 / 2.0 * b0 * w1).real[:5] - flight
    rest[1] += lambda1 * outside[2] + 0.5 * lambda1**2 * jump
    rest[2] += lambda1 * (outside[3] - middle[3])
    rest[3] += lambda1 * (outside[4] - middle[4]) + 0.5 * lambda1**2 * (b0 * w0[5]).real  # E₀⁗ vanishes at the front
    if lifts:
        shapes = _even(x, 1.0, 0.0, -1.0 / 4.0), _even(x, 0.0, 1.0, 0.0, -1.0 / 180.0)
        known = _even(x, n * b1 / 3.0, -n * a1 / 2.0) - flight
        found, _, _ = _resting(known, *shapes, slope=lambda1 * middle[2])
        rest[2:] -= found[2:]  # in deflection and slope the wave meets the free motion, not the middle
    _, lambda2, r2 = _solved(w2, rest, jump, x)
    return SecondOrder(lambda1, r1, lambda2, r2, float(outside[2]))


def _even(x: float, *coefficients: float) -> FloatArray:
    """Derivatives 0…4 of c₀ + c₁x² + c₂x⁴ + …"""
    polynomial = Polynomial(coefficients)(Polynomial([0.0, 0.0, 1.0]))
    return np.array([polynomial.deriv(m)(x) for m in range(5)])


def _resting(
    known: FloatArray, first: FloatArray, second: FloatArray, slope: float = 0.0
) -> tuple[FloatArray, float, float]:
    """known + a first + b second, a and b, which leave the front no deflection and `slope` less than none."""
    a, b = np.linalg.solve(np.array([first[:2], second[:2]]).T, -known[:2] - np.array([0.0, slope]))
    return known + a * first + b * second, a, b


def _solved(w: NDArray[Any], rest: FloatArray, jump: float, x: float) -> tuple[complex, float, float]:
    """(B, λ, r) with Re[B w] + rest = 0, 0, −λ·jump, √(2/π) r for derivatives 0…3; λ = 0 for one point, x = 0."""
    rows = np.array([w.real, -w.imag]).T
    real, imaginary = np.linalg.solve(rows[:2], -rest[:2])
    amplitude = complex(real, imaginary)
    second, third = (float((amplitude * w[m]).real + rest[m]) for m in (2, 3))
    return amplitude, -second / jump if x > 0.0 else 0.0, third / _SLOPE


def _scaled(x: float) -> dict[int, complex]:
    """e^{z²} iⁿerfc(z) for n = −3…6 at z = e^{−iπ/4}x/2, x ≥ 0, to rounding.

    The recurrence 2n iⁿerfc = iⁿ⁻²erfc − 2z iⁿ⁻¹erfc loses digits upwards, where iⁿerfc is its minimal solution; so
    their ratios r_n = iⁿ/iⁿ⁻¹ are taken downwards, r_{n−1} = 1/(2z + 2n r_n), from where the start is forgotten.
    """
    z = complex(TURN * x)
    gauss = 2.0 / np.sqrt(np.pi)
    values: dict[int, complex] = {-1: complex(gauss)}
    values[-2] = 2.0 * z * values[-1]
    values[-3] = 2.0 * z * values[-2] - 2.0 * values[-1]
    if abs(z) < _NEAR:
        values[0] = complex(scaled_erfc(x))
        for n in range(1, 7):
            values[n] = (values[n - 2] - 2.0 * z * values[n - 1]) / (2.0 * n)
        return values
    last = _LAST + int(_LAST_NEAR / abs(z) ** 2)
    ratio = 1.0 / (z + np.sqrt(z * z + 2.0 * last))
    ratios = {}
    for n in range(last, 0, -1):
        ratio = 1.0 / (2.0 * z + 2.0 * n * ratio)
        ratios[n - 1] = ratio
    for n in range(7):
        values[n] = values[n - 1] * ratios[n]
    return values
