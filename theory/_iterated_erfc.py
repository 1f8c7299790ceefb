r"""Iterated integrals of the complementary error function without its factor e^{−z²}.

    i⁰erfc = erfc,   iⁿerfc(z) = ∫_z^∞ iⁿ⁻¹erfc,   2n iⁿerfc = iⁿ⁻²erfc − 2z iⁿ⁻¹erfc
    iⁿerfc(z) ~ (2/√π) e^{−z²}/(2z)ⁿ⁺¹ Σ_m (−1)^m (2m+n)!/(n! m!) (2z)^{−2m},   |arg z| < 3π/4

They are what decaying bending waves are made of. The recurrence loses digits for large |z|, where the series
has all of them.
"""

from __future__ import annotations

from math import factorial

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import wofz

from theory._fresnel import ComplexArray, scaled_erfc

_Four = tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]
_TURN = np.exp(-0.25j * np.pi) / 2.0

# From here on 14 terms of the series give 1e-16, and the recurrence has lost no more than that absolutely.
_FAR = 12.0
_SERIES = {
    n: [(-1) ** m * factorial(2 * m + n) / (factorial(n) * factorial(m)) for m in range(14)]
    for n in (1, 2, 3)
}


def scaled_iterated_erfc(z: ComplexArray) -> _Four:
    """e^{z²} iⁿerfc(z) for n = 0…3 with absolute error 1e-13; any shape, |arg z| ≤ π/2 where |z| > 12."""
    return _integrated(z, np.asarray(wofz(1j * z)))


def iterated_erfc_of_wave(x: ArrayLike) -> _Four:
    """The same with 1e-14 at z = e^{−iπ/4}x/2, x ≥ 0 of any shape: a wave that decays ahead of x."""
    return _integrated(_TURN * np.asarray(x, dtype=np.float64), scaled_erfc(x))


def _integrated(z: ComplexArray, zeroth: ComplexArray) -> _Four:
    first = 1.0 / np.sqrt(np.pi) - z * zeroth
    second = 0.25 * (zeroth - 2.0 * z * first)
    third = (first - 2.0 * z * second) / 6.0
    far = np.abs(z) > _FAR
    if np.any(far):
        twice = 2.0 * z[far]
        for n, values in ((1, first), (2, second), (3, third)):
            values[far] = 2.0 / np.sqrt(np.pi) / twice ** (n + 1) * np.polyval(_SERIES[n][::-1], twice**-2.0)
    return zeroth, first, second, third
