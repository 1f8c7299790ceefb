r"""Auxiliary Fresnel functions as Laplace moments, the common root of the kernel and of every φ; error functions.

    I_k(q) = (√2/π) ∫₀^∞ e^{−qt} t^{k−1/2}/(1+t²) dt,      q = λ²/4,
    φ_ν(λ) = 2f = I₀,   φ_κ(λ) = 2g = I₁                                        (A.5.1), (A.5.2)
    I_k + I_{k+2} = (√2/π) Γ(k+1/2) q^{−k−1/2}.

f, g are the auxiliary Fresnel functions at λ/√(2π). The last line is what makes large λ harmless: the
powers of λ that cancel in a closed form are exactly its right-hand sides, so replacing I_k by −I_{k+2}
removes them before any digit is lost.

Every decaying bending wave is made of the same two: with z = e^{−iπ/4}x/2, e^{z²} erfc z = (φ_κ(x) + iφ_ν(x))/(1 + i)
(DLMF 7.5.10). With it come the iterated integrals of the complementary error function,

    i⁰erfc = erfc,   iⁿerfc(z) = ∫_z^∞ iⁿ⁻¹erfc,   2n iⁿerfc = iⁿ⁻²erfc − 2z iⁿ⁻¹erfc
    iⁿerfc(z) ~ (2/√π) e^{−z²}/(2z)ⁿ⁺¹ Σ_m (−1)^m (2m+n)!/(n! m!) (2z)^{−2m},   |arg z| < 3π/4

whose recurrence loses digits for large |z|, where the series has all of them.
"""

from math import factorial, sqrt
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import wofz

FloatArray = NDArray[np.float64]
ComplexArray = NDArray[np.complex128]

#: z = TURN·x on the ray of a bending wave that decays ahead of x ≥ 0.
TURN = (1.0 - 1.0j) * sqrt(0.125)

#: Below it the closed forms lose less than two digits, above it the moments have all of theirs.
SWITCH = 1.5

_ORDERS = 7
# With t = v²/q the integrand is e^{−v²}v^{2k}/(1+v⁴/q²) over the whole line. The trapezoidal rule, put right by the
# residues of the four poles (Hunter and Regan 1972), errs by (π/h)^{2k}e^{−π²/h²} ≤ 1e-16; its terms are less past 8.
_STEP = 0.4
_NODES = _STEP * np.arange(21)
_WEIGHTS = 2.0 * _STEP * np.exp(-(_NODES**2)) * np.where(_NODES == 0.0, 0.5, 1.0)
_FRONT = float(np.sqrt(2.0) / np.pi)
_MOMENT_WEIGHTS = _FRONT * _WEIGHTS[:, None] * _NODES[:, None] ** (2 * np.arange(_ORDERS))
# The residues fall like e^{−2π√(q/2)/h}: below 1e-18 of every moment from here on.
_POLES_FAR = 40.0


def scaled_moments(q: FloatArray) -> FloatArray:
    """q^{k+1/2} I_k(q) for k = 0…6; q of shape (n,), q ≥ SWITCH²/4, result of shape (7, n).

    They tend to (√2/π) Γ(k+1/2) for large q. Relative error below 1e-14.
    """
    moments = 1.0 / (1.0 + (_NODES**2 * (1.0 / q[:, None])) ** 2) @ _MOMENT_WEIGHTS
    near = q < _POLES_FAR
    moments[near] += _residues(q[near])
    return moments.T


def _residues(q: FloatArray) -> FloatArray:
    """What the trapezoidal rule lacks, 2 Re[4πi Res/(1 − e^{−2πiv/h})] at v = √q e^{iπ/4}; shape (n, 7)."""
    root = np.sqrt(q)
    decay = np.exp((-1.0 + 1.0j) * (np.sqrt(2.0) * np.pi / _STEP) * root)
    # Res of order k: e^{−iq}(iq)^k q²/(4v³), v³ = q^{3/2}e^{3iπ/4}
    term = (-2.0j * np.pi * _FRONT * np.exp(-0.75j * np.pi)) * np.exp(-1.0j * q) * root * decay / (1.0 - decay)
    return (term[:, None] * np.vander(1.0j * q, _ORDERS, increasing=True)).real


def scaled_erfc(x: ArrayLike) -> ComplexArray:
    """e^{z²} erfc z at z = e^{−iπ/4}x/2 for x ≥ 0 of any shape; relative error below 1e-14."""
    return np.asarray(wofz(1j * TURN * np.asarray(x, dtype=np.float64)))


# From here on 14 terms of the series give 1e-16, and the recurrence has lost no more than that absolutely.
_FAR = 12.0
_SERIES = {n: [(-1) ** m * factorial(2 * m + n) / (factorial(n) * factorial(m)) for m in range(14)] for n in (1, 2, 3)}


def scaled_iterated_erfc(z: NDArray[np.complexfloating[Any, Any]]) -> tuple[ComplexArray, ...]:
    """e^{z²} iⁿerfc(z) for n = 0…3, any shape, |arg z| ≤ π/2 where |z| > 12. Absolute error 1e-13, on the ray
    z = TURN·x, x ≥ 0, of a wave that decays ahead of x 1e-14."""
    zeroth = np.asarray(wofz(1j * z))
    first = 1.0 / np.sqrt(np.pi) - z * zeroth
    second = 0.25 * (zeroth - 2.0 * z * first)
    third = (first - 2.0 * z * second) / 6.0
    far = np.abs(z) > _FAR
    if np.any(far):
        twice = 2.0 * z[far]
        for n, values in ((1, first), (2, second), (3, third)):
            values[far] = 2.0 / np.sqrt(np.pi) / twice ** (n + 1) * np.polyval(_SERIES[n][::-1], twice**-2.0)
    return zeroth, first, second, third
