"""The kernel (2.3.2), (2.3.3), (2.7.12) as real parts of waves iⁿerfc; φ functions by closed forms."""

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
    if name == "H_axial":  # of ω² = k⁴ + nk²: ½√(2/π)∫(τ cos k²τ/k² − sin k²τ/k⁴) cos kξ dk, τ = 1
        return root / turn / 2j * (wave(1)(beta, 0) - 4 * wave(3)(beta, 0))
    return root / 2 - 2 * root * wave(2)(beta, 0) if name == "P" else root / turn * wave(1)(beta, ORDERS[name])


@example(beta=1.5)
@given(beta=st.floats(-1e6, 1e6, allow_subnormal=False) | st.floats(-5.0, 5.0))
def test_kernel_functions_are_exact_anywhere(beta: float) -> None:
    b = abs(beta)  # sizes of the oscillations, by which an error next to a zero is measured
    sizes = {"H": min(1.0, 2.0 * np.sqrt(2.0) / max(b, 1.0) ** 2), "H1": min(b / 2.0, 1.4 / max(b, 1.0))}
    sizes |= {"H2": 0.5, "H3": b / 4.0, "P": min(b, 1.25), "H_axial": 1.0 / 6.0}
    with mp.workdps(400):  # of the smallest β, too
        for name, size in sizes.items():
            exact = mp.re(waved(name, mp.mpf(b if name == "H_axial" else beta)))  # even
            scale = max(abs(float(exact)), size)
            assert abs(float(mp.mpf(getattr(kernel, name)(beta)) - exact)) <= 1e-13 * scale, name


@given(beta=st.floats(-1e300, 1e300))
def test_values_at_zero_and_infinity_and_no_overflow(beta: float) -> None:
    assert all(np.isfinite(getattr(kernel, name)(beta)) for name in FUNCTIONS)
    assert [getattr(kernel, name)(0.0) for name in FUNCTIONS] == [1.0, 0.0, -0.5, 0.0, 0.0]
    assert kernel.H(np.inf) == pytest.approx(0.0, abs=1e-100)
    assert kernel.P(np.inf) == pytest.approx(np.sqrt(np.pi / 2.0), rel=1e-15)


def test_K_is_the_wave_of_an_impulse_and_starts_from_rest() -> None:
    with mp.workdps(40):
        xi, tau = mp.mpf("1.3"), mp.mpf("0.7")
        exact = mp.sqrt(tau / (2 * mp.pi)) * mp.re(waved("H", xi / mp.sqrt(tau)))
    assert kernel.K(1.3, 0.7) == pytest.approx(float(exact), rel=1e-14)
    assert kernel.K(0.2, 0.0) == 0.0


ZEROS = {"phi_kappadot": 1.1657, "phi_lambdadot": 2.2200, "phi_s": 1.9097, "phi_r_plus_lambda_phi_kappa": 1.0083}
RNG = np.random.default_rng(5)
LAMBDAS = (*10.0 ** RNG.uniform(-8, 4, 60), *RNG.uniform(0.5, 4.0, 40), np.nextafter(1.5, 0.0), 1.5, *ZEROS.values())
pair = cache(lambda lam: phi_pair(mp.mpf(lam)))  # once for all functions


@pytest.mark.parametrize("name", sorted(CLOSED))
def test_phi_equals_its_closed_form_in_multiprecision(name: str) -> None:
    values = getattr(phi, name)(np.array(LAMBDAS))
    with mp.workdps(100):
        for lam, value in zip(LAMBDAS, values, strict=True):
            exact = closed_form(name, lam, pair(lam))
            near_zero = abs(lam - ZEROS.get(name, -1.0)) < 0.1
            assert abs(mp.mpf(value) - exact) < (1e-14 if near_zero else 1e-13 * abs(exact)), lam
