"""The closed forms of the theory as Chebyshev polynomials, which the page evaluates by Clenshaw's rule.

Every number of the theory is a function of κ/ν alone: λ₁ and r₁ are linear in the acceleration α and the axial force N,
the loads that the page asks for. Each has a law of its own at both ends, λ₀ ~ √(π/2)(1 − κ/ν) for κ/ν → 1 and
λ₀ ~ √(2ν/κ) for κ/ν → 0, so that polynomials in κ/ν converge badly. With ν/κ − 1 = √(2/π) b + b²/2 the variable b is
the sum of both laws: it runs from 0 to ∞, λ₀/b is smooth in it, and every φ function is analytic in λ₀ at 0 and has a
series in 1/λ₀ at ∞. Hence

    f(κ/ν) = (1 + b)^p Σ c_k T_k(u),   u = (b − 3)/(b + 3) ∈ [−1, 1),

with p the power with which f grows (κ/ν)^{−p/2}. Where the beam touches in one point, κ/ν ≥ 1, b = 0 is the limit.

The largest force on an undamped wall that gives way has other powers at both ends:

    f(κ/ν) = (κ/ν)^{−1/2} (1 + κ/ν)^{3/8} Σ c_k T_k(u),   u = (κ/ν − 1)/(κ/ν + 1).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.special import wofz

from theory import contact_parameters
from theory.elastic_wall import peak_force
from theory.similarity import peak_moment, wave_amplitude

__all__ = ["coefficients"]

Array = NDArray[np.float64]
Function = Callable[[Array], Array]
MIDDLE = 3.0  # b where u = 0
BREAKS = (-1.0, -0.5, 0.5, 1.0)
NODES = 40
NODES_OF_FORCE = 12  # f within 2e-4; the theory's own error is 1e-4
DIGITS = 13  # of the largest coefficient: smaller ones are left out
SLOPE = np.sqrt(2.0 / np.pi)
TURN = np.exp(-0.25j * np.pi) / 2.0  # z = TURN·x


def _variable(u: Array) -> Array:
    """b, 0 … ∞, where the variable of the polynomials is u, −1 … 1."""
    return np.asarray(MIDDLE * (1.0 + u) / (1.0 - u))


def _kappa_over_nu(u: Array) -> Array:
    b = _variable(u)
    return np.asarray(1.0 / (1.0 + SLOPE * b + b**2 / 2.0))


def _erfc(x: Array) -> NDArray[np.complex128]:
    """e^{z²} erfc z."""
    return np.asarray(wofz(1j * TURN * x))


def _steepest(kappa: Array) -> Array:
    """Largest slope |E′|: where E″ = 0, between the front and the largest moment ahead of it; found by halving."""
    contact = contact_parameters(kappa)
    front, amplitude = contact.lambda0, wave_amplitude(contact)
    low, high = front, peak_moment(kappa).place
    for _ in range(60):
        x = (low + high) / 2.0
        wave = amplitude * np.exp(0.25j * (x**2 - front**2)) * TURN
        bent = (wave * TURN * _erfc(x)).real > 0.0
        low, high = np.where(bent, low, x), np.where(bent, x, high)
    return np.abs((wave * (1.0 / np.sqrt(np.pi) - TURN * x * _erfc(x))).real)


def _functions() -> dict[str, tuple[int, Function]]:
    """Name → (p, f), ν = 1. λ₁ and r₁ per unit of α, whose sign decides between continuous and detached contact.

    The gap's wave is E = Re[A e^{i(x² − λ₀²)/4} S(x)], S = e^{z²} i²erfc z, with the amplitude A.
    """
    of = contact_parameters
    return {
        "lambda0": (1, lambda k: of(k).lambda0),
        "r0": (1, lambda k: of(k).r0),
        "lambda1_continuous": (1, lambda k: of(k, 1.0).lambda1),
        "lambda1_detached": (1, lambda k: -of(k, -1.0).lambda1),
        "r1_continuous": (1, lambda k: of(k, 1.0).r1),
        "r1_detached": (1, lambda k: -of(k, -1.0).r1),
        "lambda_axial": (-1, lambda k: of(k).lambda_axial),
        "r_axial": (-1, lambda k: of(k).r_axial),
        "moment_ahead": (0, lambda k: peak_moment(k).ahead),
        "place_ahead": (1, lambda k: peak_moment(k).place),
        "steepest": (-1, _steepest),
        "amplitude_real": (2, lambda k: wave_amplitude(of(k)).real),
        "amplitude_imaginary": (2, lambda k: wave_amplitude(of(k)).imag),
    }


def _fit(scaled: Function) -> list[list[float]]:
    """Coefficients of a function of u on each interval: the interpolant at Chebyshev points."""
    points, pieces = chebyshev.chebpts1(NODES), []
    for low, high in pairwise(BREAKS):
        found = chebyshev.chebfit(points, scaled(low + (high - low) * (points + 1.0) / 2.0), NODES - 1)
        digits = DIGITS - int(np.ceil(np.log10(np.abs(found).max())))
        pieces.append(chebyshev.chebtrim(found.round(digits)).tolist())
    return pieces


def _force() -> list[float]:
    """Coefficients of the largest force on a wall that gives way, over V₀√μ(EI k)^¼."""
    u = chebyshev.chebpts1(NODES_OF_FORCE)
    ratio = (1.0 + u) / (1.0 - u)
    scaled = [peak_force(float(k)).value * np.sqrt(k) * (1.0 + k) ** -0.375 for k in ratio]
    return list(chebyshev.chebfit(u, scaled, NODES_OF_FORCE - 1).round(7).tolist())


@cache
def coefficients() -> dict[str, Any]:
    """``breaks`` of u, and ``functions``: name → ``power`` and ``pieces``, the coefficients on each interval.

    ``wave_real``, ``wave_imaginary``: S(x) = e^{z²} i²erfc z, z = e^{−iπ/4}x/2, likewise with x in place of b.
    """

    def wave(u: Array) -> NDArray[np.complex128]:
        z = TURN * _variable(u)
        return np.asarray(((1.0 + 2.0 * z**2) * wofz(1j * z) - 2.0 * z / np.sqrt(np.pi)) / 4.0)

    def scaled(power: int, function: Function) -> Function:
        return lambda u: function(_kappa_over_nu(u)) / (1.0 + _variable(u)) ** power

    functions: dict[str, Any] = {
        name: {"power": power, "pieces": _fit(scaled(power, function))}
        for name, (power, function) in _functions().items()
    }
    functions["wave_real"] = {"power": 0, "pieces": _fit(lambda u: wave(u).real)}
    functions["wave_imaginary"] = {"power": 0, "pieces": _fit(lambda u: wave(u).imag)}
    return {"breaks": list(BREAKS), "middle": MIDDLE, "functions": functions, "force": _force()}
