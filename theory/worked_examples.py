r"""The two worked examples of perturbation theory: perturbed roots and the Duffing oscillator.

    x² − εx − 1 = 0,    x = ±1 + ε/2 ± ε²/8 + O(ε⁴)                                   (2.2.2), (2.2.3)
    y″ + y + εy³ = 0,   y(0) = 1,  y′(0) = 0                                          (2.2.4)
    regular expansion   y = cos t + ε[(cos 3t − cos t)/32 − (3/8) t sin t] + O(ε²)    (2.2.8)
    multiple scales     y = cos ωt + (ε/32)(cos 3ωt − cos ωt), ω = 1 + 3ε/8           (2.2.13), (2.2.14)

The term t sin t grows without bound, the oscillator does not: the reason for two time scales (Fig. 2.2). No impact:
they stand in docs/theory.md, section 12, the oscillator in the gallery.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp

from theory._fresnel import FloatArray


def perturbed_roots(epsilon: ArrayLike) -> FloatArray:
    """Both roots of x² − εx − 1 = 0 to second order (2.2.3); shape (2, *epsilon.shape), positive first."""
    e = np.asarray(epsilon, dtype=np.float64)
    return np.stack([1.0 + e / 2.0 + e**2 / 8.0, -1.0 + e / 2.0 - e**2 / 8.0])


def exact_roots(epsilon: ArrayLike) -> FloatArray:
    """Both roots of x² − εx − 1 = 0; shape (2, *epsilon.shape), positive first."""
    e = np.asarray(epsilon, dtype=np.float64)
    root = np.sqrt(1.0 + e**2 / 4.0)
    return np.stack([e / 2.0 + root, e / 2.0 - root])


def duffing_regular(times: ArrayLike, epsilon: float) -> FloatArray:
    """y(t) of (2.2.4) by regular expansion (2.2.8): the error grows like ε²t² and worse."""
    t = np.asarray(times, dtype=np.float64)
    return np.cos(t) + epsilon * ((np.cos(3.0 * t) - np.cos(t)) / 32.0 - 0.375 * t * np.sin(t))


def duffing_multiple_scales(times: ArrayLike, epsilon: float) -> FloatArray:
    """y(t) of (2.2.4) by multiple scales (2.2.13): the error is O(ε²) in amplitude and O(ε²t) in phase."""
    t = (1.0 + 0.375 * epsilon) * np.asarray(times, dtype=np.float64)
    return np.cos(t) + epsilon / 32.0 * (np.cos(3.0 * t) - np.cos(t))


def duffing_numerical(times: ArrayLike, epsilon: float) -> FloatArray:
    """y(t) of (2.2.4) by direct integration at times ≥ 0 in ascending order, shape (n,); error below 1e-9."""
    t = np.asarray(times, dtype=np.float64)

    def rate(_: float, state: FloatArray) -> FloatArray:
        return np.array([state[1], -state[0] - epsilon * state[0] ** 3])

    solution = solve_ivp(rate, (0.0, float(t[-1])), [1.0, 0.0], method="DOP853", t_eval=t, rtol=1e-12, atol=1e-13)
    return np.asarray(solution.y[0])
