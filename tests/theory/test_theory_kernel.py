"""The kernel (2.3.2), (2.3.3), (2.7.12) as real parts of waves iⁿerfc; φ functions by integrals and closed forms."""

from collections.abc import Callable
from functools import cache

import mpmath as mp
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from many_digits import CLOSED, closed_form, phi_pair, wave

from theory import kernel, phi

ORDERS = {"H": 0, "H1": 1, "H2": 2, "H3": 3}  # of the derivative
FUNCTIONS = (*ORDERS, "P")


def waved(name: str, beta: mp.mpf) -> mp.mpc:
    """What the function is the real part of, as a wave: along β = e^{iπ/4}ρ that decays, for P to a limit."""
    root, turn = mp.sqrt(2 * mp.pi), mp.exp(mp.j * mp.pi / 4)
    return root / 2 - 2 * root * wave(2)(beta, 0) if name == "P" else root / turn * wave(1)(beta, ORDERS[name])


@example(beta=1.5)
@given(beta=st.floats(-1e6, 1e6, allow_subnormal=False) | st.floats(-5.0, 5.0))
def test_kernel_functions_are_exact_anywhere(beta: float) -> None:
    b = abs(beta)  # sizes of the oscillations, by which an error next to a zero is measured
    sizes = {"H": min(1.0, 2.0 * np.sqrt(2.0) / max(b, 1.0) ** 2), "H1": min(b / 2.0, 1.4 / max(b, 1.0))}
    sizes |= {"H2": 0.5, "H3": b / 4.0, "P": min(b, 1.25)}
    with mp.workdps(400):  # of the smallest β, too
        for name, size in sizes.items():
            exact = mp.re(waved(name, mp.mpf(beta)))
            scale = max(abs(float(exact)), size)
            assert abs(float(mp.mpf(getattr(kernel, name)(beta)) - exact)) <= 1e-13 * scale, name


@given(beta=st.floats(-1e300, 1e300))
def test_values_at_zero_and_infinity_and_no_overflow(beta: float) -> None:
    assert all(np.isfinite(getattr(kernel, name)(beta)) for name in FUNCTIONS)
    assert [getattr(kernel, name)(0.0) for name in FUNCTIONS] == [1.0, 0.0, -0.5, 0.0, 0.0]
    assert kernel.H(np.inf) == pytest.approx(0.0, abs=1e-100)
    assert kernel.P(np.inf) == pytest.approx(np.sqrt(np.pi / 2.0), rel=1e-15)


def test_K_starts_from_rest_and_solves_the_beam_equation_away_from_the_impulse() -> None:
    with mp.workdps(40):

        def deflection(xi: mp.mpf, tau: mp.mpf) -> mp.mpf:
            return mp.sqrt(tau / (2 * mp.pi)) * mp.re(waved("H", xi / mp.sqrt(tau)))

        point = (mp.mpf("1.3"), mp.mpf("0.7"))
        inertia = mp.diff(deflection, point, (0, 2), h=mp.mpf("1e-8"))
        bending = mp.diff(deflection, point, (4, 0), h=mp.mpf("1e-6"))
        assert abs(inertia + bending) < 1e-8
        assert kernel.K(1.3, 0.7) == pytest.approx(float(deflection(*point)), rel=1e-14)
    assert kernel.K(0.2, 0.0) == 0.0


def test_the_kernel_under_tension_is_that_of_the_dispersion_relation() -> None:
    # ω² = k⁴ + nk² and K = (1/π)∫ cos(kξ) sin(ωτ)/ω dk, so ∂K/∂n at n = 0, τ = 1 has [cos k²/k² − sin k²/k⁴]/2
    k = np.linspace(0.05, 60.0, 300_001)
    smooth = np.exp(-((k / 25.0) ** 4))  # in place of the Abel limit
    rate = 0.5 * (np.cos(k**2) / k**2 - np.sin(k**2) / k**4) * smooth
    start = -(0.05**3) / 18.0  # of the integral up to 0.05, where the two terms would cancel
    for beta in (0.0, 0.3, 1.0, 2.0, 3.0, 5.0):
        integral = (np.trapezoid(rate * np.cos(k * beta), k) + start) / np.pi
        assert kernel.H_axial(beta) == pytest.approx(np.sqrt(2.0 * np.pi) * integral, abs=1e-5)
    assert kernel.H_axial(0.0) == pytest.approx(-1.0 / 6.0, rel=1e-14)
    assert kernel.H_axial(-1.7) == kernel.H_axial(1.7)


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


ZEROS = {"phi_kappadot": 1.1657, "phi_lambdadot": 2.2200, "phi_s": 1.9097, "phi_r_plus_lambda_phi_kappa": 1.0083}
RNG = np.random.default_rng(5)
LAMBDAS = (*10.0 ** RNG.uniform(-8, 4, 60), *RNG.uniform(0.5, 4.0, 40), np.nextafter(1.5, 0.0), 1.5, *ZEROS.values())
pair = cache(lambda lam: phi_pair(mp.mpf(lam)))  # once for all functions


@pytest.mark.parametrize("name", sorted(INTEGRALS))
def test_phi_equals_its_defining_integral(name: str) -> None:
    """Along β = e^{iπ/4}ρ: the sector between has no pole of the weights, which are at ±iλ."""
    (kind, weight), turn = INTEGRALS[name], mp.exp(mp.j * mp.pi / 4)
    weighed = lambda rho: mp.re(waved(kind, turn * rho) * weight(turn * rho, 1.3) * turn)  # noqa: E731
    integral = mp.quad(weighed, [0, 1.3, 20, mp.inf], maxdegree=5)
    assert getattr(phi, name)(1.3) == pytest.approx(float(integral), rel=1e-12, abs=1e-14)


@pytest.mark.parametrize("name", sorted(CLOSED))
def test_phi_equals_its_closed_form_in_multiprecision(name: str) -> None:
    values = getattr(phi, name)(np.array(LAMBDAS))
    with mp.workdps(100):
        for lam, value in zip(LAMBDAS, values, strict=True):
            exact = closed_form(name, lam, pair(lam))
            near_zero = abs(lam - ZEROS.get(name, -1.0)) < 0.1
            assert abs(mp.mpf(value) - exact) < (1e-14 if near_zero else 1e-13 * abs(exact)), lam
