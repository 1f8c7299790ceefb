"""The φ functions against their defining integrals and their closed forms in multiprecision (A.5)."""

from __future__ import annotations

from collections.abc import Callable

import mpmath as mp
import numpy as np
import pytest
from many_digits import phi_pair

from theory import phi

PI = mp.pi
with mp.workdps(130):
    ROOT = mp.sqrt(2 * mp.pi)
    Q2 = mp.sqrt(2 / mp.pi)

# numerators over D = β²+λ² to the given power; which derivative of H (or P) they weigh
INTEGRALS: dict[str, tuple[str, Callable[[mp.mpf, mp.mpf], mp.mpf]]] = {
    "phi_nu": ("H", lambda b, x: 4 / PI * x**3 / (b**2 + x**2) ** 2),
    "phi_kappa": ("H", lambda b, x: 4 / PI * 2 * x * (x**2 - 3 * b**2) / (b**2 + x**2) ** 3),
    "phi_p": ("P", lambda b, x: 8 / ROOT * b * x**4 / (b**2 + x**2) ** 3),
    "phi_pdot": ("H1", lambda b, x: -8 / PI * x**2 * b / (b**2 + x**2) ** 2),
    "phi_alpha": ("H", lambda b, x: 16 / PI * x**3 * b**2 / (b**2 + x**2) ** 3),
    "phi_lambda": ("H1", lambda b, x: -8 / PI * x**3 * b**3 / (b**2 + x**2) ** 3),
    "phi_kappadot": ("H2", lambda b, x: -8 / PI * b**2 * x / (b**2 + x**2) ** 2),
    "phi_lambdadot": ("H3", lambda b, x: 16 / PI * b**3 * x / (b**2 + x**2) ** 2),
    "phi_q": ("H", lambda b, x: 64 / PI * b**2 * x**3 * (b**2 - x**2) ** 2 / (b**2 + x**2) ** 5),
    "phi_r": ("H1", lambda b, x: 16 / PI * b**3 * x**2 * (b**4 + 3 * x**4) / (b**2 + x**2) ** 5),
    "phi_s": ("H2", lambda b, x: -8 / PI * b**2 * x * (b**4 + 3 * x**4) / (b**2 + x**2) ** 4),
    "phi_t": ("H1", lambda b, x: -8 / PI * b * x**2 * (b**2 - x**2) ** 2 / (b**2 + x**2) ** 4),
}

# coefficients of φ_ν, φ_κ and 1 in the closed forms
CLOSED: dict[str, Callable[[mp.mpf], tuple[mp.mpf, mp.mpf, mp.mpf]]] = {
    "phi_nu": lambda x: (1, 0, 0),
    "phi_kappa": lambda x: (0, 1, 0),
    "phi_p": lambda x: (mp.sqrt(PI / 8) * x, 0, 0),
    "phi_pdot": lambda x: (0, x, 0),
    "phi_alpha": lambda x: (1, -(x**2) / 2, 0),
    "phi_lambda": lambda x: (x**4 / 8, 3 * x**2 / 4, -(x**3) / 2 / ROOT),
    "phi_kappadot": lambda x: (x**2 / 2, 1, -Q2 * x),
    "phi_lambdadot": lambda x: (-3 * x**2, x**4 / 2, 4 * Q2 * x),
    "phi_q": lambda x: ((12 - 7 * x**4) / 12, (x**6 - 36 * x**2) / 24, Q2 * x**3),
    "phi_r": lambda x: (
        x**3 * (x**4 - 84) / 192,
        x * (3 * x**4 - 44) / 32,
        -(x**2) * (x**4 - 60) / 48 / ROOT,
    ),
    "phi_s": lambda x: (x**2 * (36 - x**4) / 48, (4 - x**4) / 4, x * (x**4 - 24) / 12 / ROOT),
    "phi_t": lambda x: (x**3 / 3, x * (12 - x**4) / 24, -(x**2) / ROOT),
    "one_minus_phi_p": lambda x: (-mp.sqrt(PI / 8) * x, 0, 1),
    "phi_nu_minus_kappa": lambda x: (1, -1, 0),
    "phi_r_plus_lambda_phi_kappa": lambda x: (
        x**3 * (x**4 - 84) / 192,
        x * (3 * x**4 - 12) / 32,
        -(x**2) * (x**4 - 60) / 48 / ROOT,
    ),
    "phi_kappa_minus_s": lambda x: (
        -(x**2) * (36 - x**4) / 48,
        x**4 / 4,
        -x * (x**4 - 24) / 12 / ROOT,
    ),
}


def closed_form(name: str, lam: float) -> mp.mpf:
    x = mp.mpf(lam)
    weights = CLOSED[name](x)
    return sum(w * v for w, v in zip(weights, (*phi_pair(x), mp.mpf(1)), strict=True))


def by_integration(name: str, lam: float) -> mp.mpf:
    """The defining integral, turned into the sector where the kernel does not oscillate but decays.

    H and its derivatives are real parts of e^{iβ²/4} times slowly varying functions; along β = e^{iπ/4}ρ they
    are error functions of a real argument, and the sector has no pole of the weights (they are at ±iλ).
    """
    kind, weight = INTEGRALS[name]
    x = mp.mpf(lam)
    turn = mp.exp(1j * PI / 4)

    def complex_kernel(rho: mp.mpf) -> mp.mpc:
        # β = e^{iπ/4}ρ, z = e^{−iπ/4}β/2 = ρ/2
        z = rho / 2
        wave, erfc = mp.exp(-(z**2)), mp.erfc(z)
        ierfc = wave / mp.sqrt(PI) - z * erfc
        i2erfc = (erfc - 2 * z * ierfc) / 4
        beta = turn * rho
        return {
            "H": ROOT / turn * ierfc,
            "H1": 1j * mp.sqrt(PI / 2) * erfc,
            "H2": -(1 + 1j) / 2 * wave,
            "H3": (1 - 1j) / 4 * beta * wave,
            "P": mp.sqrt(PI / 2) - 2 * ROOT * i2erfc,
        }[kind]

    def integrand(rho: mp.mpf) -> mp.mpf:
        return mp.re(complex_kernel(rho) * weight(turn * rho, x) * turn)

    points = sorted({mp.mpf(0), x / 2, x, 2 * x, 4 * x, mp.mpf(1), mp.mpf(4), mp.mpf(12), 40 + 20 * x})
    return mp.quad(integrand, [*points, mp.inf])


# where a function changes sign
ZEROS = {
    "phi_kappadot": 1.1657,
    "phi_lambdadot": 2.2200,
    "phi_s": 1.9097,
    "phi_r_plus_lambda_phi_kappa": 1.0083,
}


@pytest.mark.parametrize("name", sorted(INTEGRALS))
def test_phi_equals_its_defining_integral(name: str) -> None:
    with mp.workdps(30):
        for lam in (0.3, 4.0):
            reference = float(by_integration(name, lam))
            assert getattr(phi, name)(lam) == pytest.approx(reference, rel=1e-12, abs=1e-14)


@pytest.mark.parametrize("name", sorted(CLOSED))
def test_phi_equals_its_closed_form_in_multiprecision(name: str) -> None:
    rng = np.random.default_rng(5)
    lams = np.concatenate([10.0 ** rng.uniform(-8, 4, 60), rng.uniform(0.5, 4.0, 40), [np.nextafter(1.5, 0.0), 1.5]])
    lams = lams[np.abs(lams - ZEROS.get(name, -1.0)) > 0.1]
    values = getattr(phi, name)(lams)
    with mp.workdps(100):
        errors = [
            abs(float((mp.mpf(v) - closed_form(name, x)) / closed_form(name, x)))
            for v, x in zip(values, lams, strict=True)
        ]
    assert max(errors) < 1e-13


@pytest.mark.parametrize(("name", "near"), sorted(ZEROS.items()))
def test_error_next_to_a_zero_is_absolute(name: str, near: float) -> None:
    with mp.workdps(40):
        zero = float(mp.findroot(lambda x: closed_form(name, x), near))
        assert getattr(phi, name)(zero) == pytest.approx(float(closed_form(name, zero)), abs=1e-14)
