"""What tests of the theory take in many digits."""

from __future__ import annotations

import mpmath as mp

__all__ = ["iterated_erfc", "phi_pair", "row"]


def phi_pair(x: mp.mpf) -> tuple[mp.mpf, mp.mpf]:
    """φ_ν and φ_κ (A.5.1), (A.5.2)."""
    s, c = mp.fresnels(x / mp.sqrt(2 * mp.pi)), mp.fresnelc(x / mp.sqrt(2 * mp.pi))
    sine, cosine = mp.sin(x**2 / 4), mp.cos(x**2 / 4)
    return cosine * (1 - 2 * s) - sine * (1 - 2 * c), cosine * (1 - 2 * c) + sine * (1 - 2 * s)


def iterated_erfc(z: mp.mpc, order: int) -> list[mp.mpc]:
    """erfc z, ierfc z, …, up to iⁿerfc z of this order."""
    values = [mp.erfc(z), mp.exp(-(z**2)) / mp.sqrt(mp.pi) - z * mp.erfc(z)]
    for n in range(2, order + 1):
        values.append((values[-2] - 2 * z * values[-1]) / (2 * n))
    return values


def row(c: mp.mpc) -> list[mp.mpf]:
    """Coefficients of Re B and Im B in Re(Bc)."""
    return [mp.re(c), -mp.im(c)]
