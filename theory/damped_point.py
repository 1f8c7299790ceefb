r"""One point of an infinite beam stopped, with Kelvin and Voigt's damping: what damping does to the first instants.

    μ y_tt + EI(y_xxxx + η y_txxxx) = −R(t)δ(x),   y(0,t) = V₀t in the free motion's frame

κ/ν ≥ 1 at leading order (the thesis has η = 0 only). With s the Laplace variable and T = t/η

    R ∝ (1 + ηs)^{1/4} s^{−1/2},     M(0) ∝ (1 + ηs)^{1/2}/s,

and against η = 0, J₀ = 4√(2/π) μV₀√(ct), R₀ = 2√(2/π) μV₀√(c/t), M₀ = V₀√(EIμ):

    J/J₀ = Γ(3/2)/Γ(5/4) T^{−1/4} ₁F₁(−1/4; 5/4; −T)  → 1 + 1/(8T)
    R/R₀ = Γ(1/2)/Γ(1/4) T^{−1/4} ₁F₁(−1/4; 1/4; −T)  → 1 − 1/(8T)
    M/M₀ = e^{−T}/√(πT) + erf √T                       → 1

so that after t = 6.3 η the impulse is within 2 % of the undamped one, and the moment much earlier.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import erf, gamma, hyp1f1

from theory._fresnel import FloatArray


def impulse_ratio(age: ArrayLike) -> FloatArray:
    """J/J₀ at t/η > 0, any shape: the wall's impulse over that without damping; relative error 1e-13."""
    return _ratio(age, 1.25, float(gamma(1.5) / gamma(1.25)))


def reaction_ratio(age: ArrayLike) -> FloatArray:
    """R/R₀ at t/η > 0, any shape; it starts like T^{−1/4} and crosses 1; relative error 1e-13."""
    return _ratio(age, 0.25, float(gamma(0.5) / gamma(0.25)))


def moment_ratio(age: ArrayLike) -> FloatArray:
    """M/M₀ at the contact at t/η > 0, any shape, viscous part included."""
    t = _ages(age)
    return np.asarray(np.exp(-t) / np.sqrt(np.pi * t) + erf(np.sqrt(t)))


def _ages(age: ArrayLike) -> FloatArray:
    values = np.asarray(age, dtype=np.float64)
    if not np.all(values > 0.0):
        raise ValueError(f"age must be positive, in units of the damping time (got {age!r})")
    return values


def _ratio(age: ArrayLike, c: float, front: float) -> FloatArray:
    t = _ages(age)
    return np.asarray(front * t**-0.25 * hyp1f1(-0.25, c, -t))
