r"""The twelve φ functions of the contact conditions (A.5.1)–(A.5.16).

Every φ is an integral of the kernel (2.6.18)–(2.7.68) and has a closed form in φ_ν and φ_κ. Those closed
forms cancel for large λ (φ_q keeps none of its digits at λ = 50), so each function is written twice: the
closed form for λ < SWITCH, and for λ ≥ SWITCH the same combination after I_k → −I_{k+2} has removed
the cancelling powers, in terms of the moments I_k of `theory._fresnel` with q = λ²/4.

All functions take λ ≥ 0 of any shape, return the same shape (a float for a scalar), and raise ValueError
for a negative λ or NaN. Several φ of the same λ share its integrals through an `Argument`. Relative error below
1e-13, next to a zero of the function relative to its terms.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import fresnel

from theory._fresnel import SWITCH, FloatArray, scaled_erfc, scaled_moments

_ROOT_TWO_PI = np.sqrt(2.0 * np.pi)


@dataclass(frozen=True)
class Argument:
    """λ ≥ 0 of shape (n,) with its Fresnel integrals and moments, computed once for any number of φ. Every φ takes one
    in place of λ."""

    lam: FloatArray
    near: NDArray[np.bool_]
    integrals: tuple[FloatArray, FloatArray]
    moments: FloatArray

    @classmethod
    def of(cls, lam: FloatArray) -> Argument:
        """From λ, shape (n,), none negative or NaN (ValueError)."""
        if not np.all(lam >= 0.0):
            raise ValueError(f"lam must not be negative or NaN (got {lam[~(lam >= 0.0)][0]!r})")
        near = lam < SWITCH
        both = (1.0 + 1.0j) * scaled_erfc(lam[near])  # φ_κ + iφ_ν
        return cls(lam, near, (both.imag, both.real), scaled_moments(lam[~near] ** 2 / 4.0))


def _evaluate(lam: ArrayLike | Argument, closed: Callable[..., FloatArray], reduced: Callable[..., FloatArray]) -> Any:
    """closed(λ, φ_ν, φ_κ) for λ < SWITCH, reduced(q, moments q^{k+1/2} I_k) beyond."""
    at = lam if isinstance(lam, Argument) else Argument.of(np.asarray(lam, dtype=np.float64).ravel())
    result = np.empty_like(at.lam)
    result[at.near] = closed(at.lam[at.near], *at.integrals)
    result[~at.near] = reduced(at.lam[~at.near] ** 2 / 4.0, at.moments)
    return result if isinstance(lam, Argument) else result.reshape(np.shape(lam))[()]


def phi_nu(lam: ArrayLike | Argument) -> Any:
    """φ_ν = (4/π)∫λ³H/(β²+λ²)² dβ (2.6.18): deflection at ξ = 0, leading order."""
    return _evaluate(lam, lambda x, nu, kappa: nu, lambda q, m: m[0] / np.sqrt(q))


def phi_kappa(lam: ArrayLike | Argument) -> Any:
    """φ_κ = (4/π)∫2λ(λ²−3β²)H/(β²+λ²)³ dβ (2.6.20): curvature at ξ = 0, leading order."""
    return _evaluate(lam, lambda x, nu, kappa: kappa, lambda q, m: m[1] * q**-1.5)


def phi_p(lam: ArrayLike | Argument) -> Any:
    """φ_p = (8/√2π)∫βλ⁴P/(β²+λ²)³ dβ (2.7.17): deflection by the uniform reaction."""
    scale = np.sqrt(np.pi / 8.0)
    return _evaluate(lam, lambda x, nu, kappa: scale * x * nu, lambda q, m: 2.0 * scale * m[0])


def phi_pdot(lam: ArrayLike | Argument) -> Any:
    """φ_ṗ = −(8/π)∫λ²βH′/(β²+λ²)² dβ (2.7.34): curvature by the uniform reaction."""
    return _evaluate(lam, lambda x, nu, kappa: x * kappa, lambda q, m: 2.0 * m[1] / q)


def phi_alpha(lam: ArrayLike | Argument) -> Any:
    """φ_α = (16/π)∫λ³β²H/(β²+λ²)³ dβ (2.7.23): deflection by r₁, and at ξ = λ_c by r₀ (2.7.54)."""
    return _evaluate(lam, lambda x, nu, kappa: nu - x**2 / 2.0 * kappa, lambda q, m: (2.0 * m[3] - m[2]) * q**-2.5)


def phi_lambda(lam: ArrayLike | Argument) -> Any:
    """φ_λ = −(8/π)∫λ³β³H′/(β²+λ²)³ dβ (2.7.23): deflection by λ₁."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: 0.75 * x**2 * kappa - x**3 / (2.0 * _ROOT_TWO_PI) + x**4 / 8.0 * nu,
        lambda q, m: (2.0 * m[4] - 3.0 * m[3]) * q**-2.5,
    )


def phi_kappadot(lam: ArrayLike | Argument) -> Any:
    """φ_κ̇ = −(8/π)∫β²λH″/(β²+λ²)² dβ (2.7.38): curvature by r₁."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: kappa - np.sqrt(2.0 / np.pi) * x + x**2 / 2.0 * nu,
        lambda q, m: (m[1] - 2.0 * m[2]) * q**-1.5,
    )


def phi_lambdadot(lam: ArrayLike | Argument) -> Any:
    """φ_λ̇ = (16/π)∫β³λH‴/(β²+λ²)² dβ (2.7.38), an Abel limit: curvature by λ₁."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: 4.0 * np.sqrt(2.0 / np.pi) * x - 3.0 * x**2 * nu + x**4 / 2.0 * kappa,
        lambda q, m: (12.0 * m[2] - 8.0 * m[3]) * q**-1.5,
    )


def phi_q(lam: ArrayLike | Argument) -> Any:
    """φ_q = (64/π)∫β²λ³(β²−λ²)²H/(β²+λ²)⁵ dβ (2.7.53): deflection at ξ = λ_c by r₁."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: (
            np.sqrt(2.0 / np.pi) * x**3 + (x**6 - 36.0 * x**2) / 24.0 * kappa + (12.0 - 7.0 * x**4) / 12.0 * nu
        ),
        lambda q, m: (8.0 / 3.0 * m[5] - 28.0 / 3.0 * m[4] + 6.0 * m[3] - m[2]) * q**-2.5,
    )


def phi_r(lam: ArrayLike | Argument) -> Any:
    """φ_r = (16/π)∫β³λ²(β⁴+3λ⁴)H′/(β²+λ²)⁵ dβ (2.7.53): deflection at ξ = λ_c by λ₁."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: (
            x**3 * (x**4 - 84.0) / 192.0 * nu
            + x * (3.0 * x**4 - 44.0) / 32.0 * kappa
            - x**2 * (x**4 - 60.0) / (48.0 * _ROOT_TWO_PI)
        ),
        lambda q, m: (-2.0 / 3.0 * m[6] + 3.0 * m[5] - 3.5 * m[4] + 2.75 * m[3]) * q**-3.0,
    )


def phi_s(lam: ArrayLike | Argument) -> Any:
    """φ_s = −(8/π)∫β²λ(β⁴+3λ⁴)H″/(β²+λ²)⁴ dβ (2.7.68): slope at ξ = λ_c by λ₁."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: (
            x**2 * (36.0 - x**4) / 48.0 * nu + (4.0 - x**4) / 4.0 * kappa + x * (x**4 - 24.0) / (12.0 * _ROOT_TWO_PI)
        ),
        lambda q, m: (m[1] - 3.0 * m[2] + 4.0 * m[3] - 4.0 / 3.0 * m[4]) * q**-1.5,
    )


def phi_t(lam: ArrayLike | Argument) -> Any:
    """φ_t = −(8/π)∫βλ²(β²−λ²)²H′/(β²+λ²)⁴ dβ (2.7.68): slope at ξ = λ_c by r₁."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: x**3 / 3.0 * nu + x * (12.0 - x**4) / 24.0 * kappa - x**2 / _ROOT_TWO_PI,
        lambda q, m: (4.0 / 3.0 * m[3] - 8.0 / 3.0 * m[2] + m[1]) / q,
    )


# Differences that the contact conditions need to full relative precision on their own: each vanishes in
# a limit where its two terms do not.


def one_minus_phi_p(lam: ArrayLike | Argument) -> Any:
    """1 − φ_p, which vanishes like λ⁻⁴ for large λ."""
    scale = np.sqrt(np.pi / 8.0)
    return _evaluate(lam, lambda x, nu, kappa: 1.0 - scale * x * nu, lambda q, m: 2.0 * scale * m[2] / q**2)


def phi_nu_minus_kappa(lam: ArrayLike | Argument) -> Any:
    """φ_ν − φ_κ, which vanishes like √(2/π) λ for small λ."""

    def closed(x: FloatArray, nu: FloatArray, kappa: FloatArray) -> FloatArray:
        # (A.5.1) − (A.5.2) with the ones cancelled by hand
        s, c = fresnel(x / _ROOT_TWO_PI)
        phase = x**2 / 4.0
        return np.asarray(2.0 * ((c - s) * np.cos(phase) - (1.0 - c - s) * np.sin(phase)))

    return _evaluate(lam, closed, lambda q, m: (m[0] - m[1] / q) / np.sqrt(q))


def phi_r_plus_lambda_phi_kappa(lam: ArrayLike | Argument) -> Any:
    """φ_r + λφ_κ, the (1, 2) entry of (2.7.71) over r₀ since κ = r₀φ_κ (2.7.69)."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: (
            x**3 * (x**4 - 84.0) / 192.0 * nu
            + x * (3.0 * x**4 - 12.0) / 32.0 * kappa
            - x**2 * (x**4 - 60.0) / (48.0 * _ROOT_TWO_PI)
        ),
        lambda q, m: (2.0 / 3.0 * m[4] - 3.0 * m[3] + 3.5 * m[2] - 0.75 * m[1]) / q,
    )


def phi_kappa_minus_s(lam: ArrayLike | Argument) -> Any:
    """φ_κ − φ_s, the (2, 2) entry of (2.7.71) over r₀; it vanishes like √(2/π) λ for small λ."""
    return _evaluate(
        lam,
        lambda x, nu, kappa: (
            -(x**2) * (36.0 - x**4) / 48.0 * nu + x**4 / 4.0 * kappa - x * (x**4 - 24.0) / (12.0 * _ROOT_TWO_PI)
        ),
        lambda q, m: (4.0 / 3.0 * m[4] - 4.0 * m[3] + 3.0 * m[2]) * q**-1.5,
    )
