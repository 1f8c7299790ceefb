r"""One point of an infinite beam stopped, with Kelvin and Voigt's damping: what damping does to the first instants.

    μ y_tt + EI(y_xxxx + η y_txxxx) = −R(t)δ(x),   y(0,t) = V₀t in the free motion's frame

κ/ν ≥ 1 at leading order (the thesis has η = 0 only). With s the Laplace variable and T = t/η

    R ∝ (1 + ηs)^{1/4} s^{−1/2},     M(0) ∝ (1 + ηs)^{1/2}/s,

and against η = 0, J₀ = 4√(2/π) μV₀√(ct), R₀ = 2√(2/π) μV₀√(c/t), M₀ = V₀√(EIμ):

    J/J₀ = Γ(3/2)/Γ(5/4) T^{−1/4} ₁F₁(−1/4; 5/4; −T)  → 1 + 1/(8T)
    R/R₀ = Γ(1/2)/Γ(1/4) T^{−1/4} ₁F₁(−1/4; 1/4; −T)  → 1 − 1/(8T)
    M/M₀ = e^{−T}/√(πT) + erf √T                       → 1

so that after t = 6.3 η the impulse is within 2 % of the undamped one, and the moment much earlier. ₁F₁ is summed here,
by Kummer's transformation or its asymptotic series: the library that has it takes longer to import than all of theory.
"""

from __future__ import annotations

from math import erf, gamma

import numpy as np
from numpy.typing import ArrayLike

from theory._fresnel import FloatArray


def impulse_ratio(age: ArrayLike) -> FloatArray:
    """J/J₀ at t/η > 0, any shape: the wall's impulse over that without damping; relative error 1e-13."""
    return _ratio(age, 1.25, gamma(1.5) / gamma(1.25))


def reaction_ratio(age: ArrayLike) -> FloatArray:
    """R/R₀ at t/η > 0, any shape; it starts like T^{−1/4} and crosses 1; relative error 1e-13."""
    return _ratio(age, 0.25, gamma(0.5) / gamma(0.25))


def moment_ratio(age: ArrayLike) -> FloatArray:
    """M/M₀ at the contact at t/η > 0, any shape, viscous part included."""
    t = _ages(age)
    elastic = np.array([erf(root) for root in np.sqrt(t).ravel()]).reshape(t.shape)
    return np.asarray(np.exp(-t) / np.sqrt(np.pi * t) + elastic)


def _ages(age: ArrayLike) -> FloatArray:
    values = np.asarray(age, dtype=np.float64)
    if not np.all(values > 0.0):
        raise ValueError(f"age must be positive, in units of the damping time (got {age!r})")
    return values


def _ratio(age: ArrayLike, c: float, front: float) -> FloatArray:
    t = _ages(age)
    result = np.empty_like(t)
    near = t < _FAR
    result[near] = front * t[near] ** -0.25 * _kummer(c, t[near])
    result[~near] = _asymptotic(c, t[~near])
    return result


# From here on e^{−T}, which the asymptotic series leaves out, is below round-off, and so is its 25th term.
_FAR = 36.0


def _kummer(c: float, t: FloatArray) -> FloatArray:
    """₁F₁(−1/4; c; −T) = e^{−T} ₁F₁(c + 1/4; c; T), every term positive (DLMF 13.2.39)."""
    term = np.exp(-t)
    total = term.copy()
    for n in range(110):
        term = term * ((c + 0.25 + n) / ((c + n) * (n + 1.0))) * t
        total += term
    return total


def _asymptotic(c: float, t: FloatArray) -> FloatArray:
    """Γ(c + 1/4)/Γ(c) T^{−1/4} ₁F₁(−1/4; c; −T) for large T (DLMF 13.7.2)."""
    term = np.ones_like(t)
    total = term.copy()
    for n in range(25):
        term = term * ((n - 0.25) * (n + 0.75 - c) / (n + 1.0)) / t
        total += term
    return total
