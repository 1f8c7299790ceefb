r"""One point of an infinite beam stopped, with Kelvin and Voigt's damping: what damping does to the first instants.

    μ y_tt + EI(y_xxxx + η y_txxxx) = −R(t)δ(x),   y(0,t) = V₀t in the free motion's frame

κ/ν ≥ 1 at leading order (the thesis has η = 0 only). Of the Laplace variable s, R ∝ (1 + ηs)^{1/4} s^{−1/2} and
M(0) ∝ (1 + ηs)^{1/2}/s. Over their values at η = 0 the reaction (m = 0), the impulse and the reaction to a constant
acceleration a₀ (m = 1), and the impulse by a₀ (m = 2) at T = t/η are

    Γ(m + 1/2)/Γ(m + 1/4) T^{−1/4} ₁F₁(−1/4; m + 1/4; −T),      M/M₀ = e^{−T}/√(πT) + erf √T.

The elastic moment ahead of it is 0.24 of that at the contact at first, 0.56 in the end, less 1.4 η/t of itself.

With damping, without shear, a zone (κ/ν < 1) starts as one point, too (with shear as a zone: `theory.shear`). Its
elastic moment is erf √T of that of a point, and it spreads once that is κ/ν, at T_p = erf⁻¹(κ/ν)². From then on damping
has no closed form.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import erf, erfinv, gamma, hyp1f1

from theory._fresnel import FloatArray

AHEAD_FROM = 75.0  # η, after which the elastic moment ahead of the point is within 2 % of that without damping


def reaction_ratio(age: ArrayLike) -> FloatArray:
    """R/R₀ at T = t/η > 0, any shape; it starts like T^{−1/4} and crosses 1. Relative error 1e-13."""
    return _ratio(age, 0)


def impulse_ratio(age: ArrayLike) -> FloatArray:
    """J/J₀ at T = t/η > 0, any shape; also the ratio of the reaction to a constant acceleration."""
    return _ratio(age, 1)


def impulse_ratio_of_acceleration(age: ArrayLike) -> FloatArray:
    """Impulse by a constant acceleration over its undamped value at T = t/η > 0, any shape."""
    return _ratio(age, 2)


def moment_ratio(age: ArrayLike) -> FloatArray:
    """M/M₀ at the contact at T = t/η > 0, any shape, viscous part included."""
    t = _ages(age)
    return np.asarray(np.exp(-t) / np.sqrt(np.pi * t) + erf(np.sqrt(t)))


def elastic_moment_ratio(age: ArrayLike) -> FloatArray:
    """The part of M/M₀ that bends the beam, erf √T, at T = t/η > 0, any shape: it only grows."""
    return np.asarray(erf(np.sqrt(_ages(age))))


def age_of_spreading(kappa_over_nu: float) -> float:
    """T_p = erf⁻¹(κ/ν)² until which a damped contact is one point; infinite for κ/ν ≥ 1."""
    return float(erfinv(min(kappa_over_nu, 1.0)) ** 2)


def _ages(age: ArrayLike) -> FloatArray:
    values = np.asarray(age, dtype=np.float64)
    if not np.all(values > 0.0):
        raise ValueError(f"age must be positive, in units of the damping time (got {age!r})")
    return values


def _ratio(age: ArrayLike, m: int) -> FloatArray:
    t = _ages(age)
    return np.asarray(gamma(m + 0.5) / gamma(m + 0.25) * t**-0.25 * hyp1f1(-0.25, m + 0.25, -t))
