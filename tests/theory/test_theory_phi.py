"""The φ functions against their defining integrals and their closed forms in multiprecision (A.5)."""

from collections.abc import Callable

import mpmath as mp
import numpy as np
import pytest
from many_digits import CLOSED, closed_form, phi_pair
from scipy import special
from scipy.integrate import quad

from theory import phi

# which derivative of H (or P) is weighed, and how
INTEGRALS: dict[str, tuple[str, Callable[[complex, float], complex]]] = {
    "phi_nu": ("H", lambda b, x: 4 / np.pi * x**3 / (b**2 + x**2) ** 2),
    "phi_kappa": ("H", lambda b, x: 4 / np.pi * 2 * x * (x**2 - 3 * b**2) / (b**2 + x**2) ** 3),
    "phi_p": ("P", lambda b, x: 8 / np.sqrt(2 * np.pi) * b * x**4 / (b**2 + x**2) ** 3),
    "phi_pdot": ("H1", lambda b, x: -8 / np.pi * x**2 * b / (b**2 + x**2) ** 2),
    "phi_alpha": ("H", lambda b, x: 16 / np.pi * x**3 * b**2 / (b**2 + x**2) ** 3),
    "phi_lambda": ("H1", lambda b, x: -8 / np.pi * x**3 * b**3 / (b**2 + x**2) ** 3),
    "phi_kappadot": ("H2", lambda b, x: -8 / np.pi * b**2 * x / (b**2 + x**2) ** 2),
    "phi_lambdadot": ("H3", lambda b, x: 16 / np.pi * b**3 * x / (b**2 + x**2) ** 2),
    "phi_q": ("H", lambda b, x: 64 / np.pi * b**2 * x**3 * (b**2 - x**2) ** 2 / (b**2 + x**2) ** 5),
    "phi_r": ("H1", lambda b, x: 16 / np.pi * b**3 * x**2 * (b**4 + 3 * x**4) / (b**2 + x**2) ** 5),
    "phi_s": ("H2", lambda b, x: -8 / np.pi * b**2 * x * (b**4 + 3 * x**4) / (b**2 + x**2) ** 4),
    "phi_t": ("H1", lambda b, x: -8 / np.pi * b * x**2 * (b**2 - x**2) ** 2 / (b**2 + x**2) ** 4),
}


def by_integration(name: str, lam: float) -> float:
    """The defining integral, turned into the sector where the kernel does not oscillate but decays.

    H and its derivatives are real parts of e^{iβ²/4} times slowly varying functions; along β = e^{iπ/4}ρ they
    are error functions of a real argument, and the sector has no pole of the weights (they are at ±iλ).
    """
    kind, weight = INTEGRALS[name]
    turn = np.exp(0.25j * np.pi)

    def complex_kernel(rho: float) -> complex:
        # β = e^{iπ/4}ρ, z = e^{−iπ/4}β/2 = ρ/2
        z, root = rho / 2.0, np.sqrt(2.0 * np.pi)
        wave, erfc = np.exp(-(z**2)), special.erfc(z)
        ierfc = wave / np.sqrt(np.pi) - z * erfc
        return {
            "H": root / turn * ierfc,
            "H1": 1j * np.sqrt(np.pi / 2.0) * erfc,
            "H2": -(1 + 1j) / 2 * wave,
            "H3": (1 - 1j) / 4 * turn * rho * wave,
            "P": np.sqrt(np.pi / 2.0) - root / 2.0 * (erfc - 2.0 * z * ierfc),
        }[kind]

    def integrand(rho: float) -> float:
        return float((complex_kernel(rho) * weight(turn * rho, lam) * turn).real)

    pieces = ((0.0, lam), (lam, 20.0), (20.0, np.inf))
    return sum(quad(integrand, *piece, epsabs=1e-14, epsrel=1e-12)[0] for piece in pieces)


ZEROS = {"phi_kappadot": 1.1657, "phi_lambdadot": 2.2200, "phi_s": 1.9097, "phi_r_plus_lambda_phi_kappa": 1.0083}
RNG = np.random.default_rng(5)
LAMBDAS = (*10.0 ** RNG.uniform(-8, 4, 60), *RNG.uniform(0.5, 4.0, 40), np.nextafter(1.5, 0.0), 1.5, *ZEROS.values())
DIGITS = 100


@pytest.fixture(scope="module")
def pairs() -> list[tuple[mp.mpf, mp.mpf]]:
    with mp.workdps(DIGITS):
        return [phi_pair(mp.mpf(lam)) for lam in LAMBDAS]


@pytest.mark.parametrize("lam", [0.3, 4.0])
@pytest.mark.parametrize("name", sorted(INTEGRALS))
def test_phi_equals_its_defining_integral(name: str, lam: float) -> None:
    assert getattr(phi, name)(lam) == pytest.approx(by_integration(name, lam), rel=1e-12, abs=1e-14)


@pytest.mark.parametrize("name", sorted(CLOSED))
def test_phi_equals_its_closed_form_in_multiprecision(name: str, pairs: list[tuple[mp.mpf, mp.mpf]]) -> None:
    values = getattr(phi, name)(np.array(LAMBDAS))
    with mp.workdps(DIGITS):
        for lam, pair, value in zip(LAMBDAS, pairs, values, strict=True):
            exact = closed_form(name, lam, pair)
            near_zero = abs(lam - ZEROS.get(name, -1.0)) < 0.1
            assert abs(mp.mpf(value) - exact) < (1e-14 if near_zero else 1e-13 * abs(exact)), lam
