r"""Auxiliary Fresnel functions as Laplace moments, the common root of the kernel and of every φ.

    I_k(q) = (√2/π) ∫₀^∞ e^{−qt} t^{k−1/2}/(1+t²) dt,      q = λ²/4,
    φ_ν(λ) = 2f = I₀,   φ_κ(λ) = 2g = I₁                                        (A.5.1), (A.5.2)
    I_k + I_{k+2} = (√2/π) Γ(k+1/2) q^{−k−1/2}.

f, g are the auxiliary Fresnel functions at λ/√(2π). The last line is what makes large λ harmless: the
powers of λ that cancel in a closed form are exactly its right-hand sides, so replacing I_k by −I_{k+2}
removes them before any digit is lost.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.special import fresnel

FloatArray = NDArray[np.float64]

#: Below it the closed forms lose less than two digits, above it the moments have all of theirs.
SWITCH = 1.5

_ORDERS = 7
# With t = v²/q the integrand is even and analytic in |Im v| < √(q/2), so the trapezoidal rule errs by
# exp(−2π√(q/2)/h): below 1e-16 for λ ≥ SWITCH. Its terms are below 1e-20 past v = 8.
_STEP = 0.09
_NODES = _STEP * np.arange(int(8.0 / _STEP) + 1)
_WEIGHTS = 2.0 * _STEP * np.exp(-(_NODES**2)) * np.where(_NODES == 0.0, 0.5, 1.0)
_MOMENT_WEIGHTS = _WEIGHTS[:, None] * _NODES[:, None] ** (2 * np.arange(_ORDERS))
_FRONT = np.sqrt(2.0) / np.pi


def scaled_moments(q: FloatArray) -> FloatArray:
    """q^{k+1/2} I_k(q) for k = 0…6; q of shape (n,), q ≥ SWITCH²/4, result of shape (7, n).

    They tend to (√2/π) Γ(k+1/2) for large q. Relative error below 1e-14.
    """
    poles = 1.0 / (1.0 + (_NODES**2 / q[:, None]) ** 2)
    return np.asarray(_FRONT * (poles @ _MOMENT_WEIGHTS).T)


def twice_auxiliary(lam: FloatArray) -> tuple[FloatArray, FloatArray]:
    """φ_ν = 2f and φ_κ = 2g from the Fresnel integrals, for 0 ≤ λ < SWITCH (A.5.1), (A.5.2)."""
    s, c = fresnel(lam / np.sqrt(2.0 * np.pi))
    sine, cosine = np.sin(lam**2 / 4.0), np.cos(lam**2 / 4.0)
    return (
        cosine * (1.0 - 2.0 * s) - sine * (1.0 - 2.0 * c),
        cosine * (1.0 - 2.0 * c) + sine * (1.0 - 2.0 * s),
    )
