"""Axial force: λ_N, r_N against patched waves in many digits, the regimes, the limits, the curved wall's rule."""

from __future__ import annotations

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from many_digits import iterated_erfc, row

from theory import ImpactFields, contact_parameters, kernel

COEFFICIENTS = st.integers(-1000, 1000).map(lambda n: n / 100.0)


def patched_waves(ratio: float, guess: float, digits: int) -> tuple[mp.mpf, mp.mpf]:
    """(λ_N, r_N) of free flight under tension, ν = 1, from waves ahead of the front; no φ and no integral.

    Leading order: Re[B i²erfc z] with deflection, slope and curvature of the slow motion at x = λ₀, which also
    gives λ₀. First order in nτ²: Re[B₁ i⁴erfc z] + ½ Im[B i²erfc z] has the slow motion's −κ/2 and slope 0; the
    front that has moved by nλ_Nτ turns the jump s r₀ of the third derivative into one of the curvature.
    """
    with mp.workdps(digits):
        kappa, step = mp.mpf(ratio), mp.exp(-1j * mp.pi / 4) / 2

        def amplitude(x: mp.mpf) -> mp.mpc:
            e = iterated_erfc(step * x, 2)
            b = mp.lu_solve(mp.matrix([row(-step * e[1]), row(step**2 * e[0])]), mp.matrix([-kappa * x, -kappa]))
            return mp.mpc(b[0], b[1])

        def misfit(x: mp.mpf) -> mp.mpf:
            return mp.re(amplitude(x) * iterated_erfc(step * x, 2)[2]) - (1 - kappa * x**2 / 2)

        x = mp.findroot(misfit, (mp.mpf(guess), mp.mpf(guess) * (1 + mp.mpf("1e-9"))), tol=mp.mpf(10) ** (-50))
        b, e = amplitude(x), iterated_erfc(step * x, 4)
        gauss = 2 / mp.sqrt(mp.pi) * mp.exp(-((step * x) ** 2))  # −d erfc/dz
        second = [b * e[2], -b * step * e[1], b * step**2 * e[0], -b * step**3 * gauss]
        third = mp.re(second[3])
        first = [e[4], -step * e[3], step**2 * e[2], -(step**3) * e[1]]
        slow = [-kappa / 2, mp.mpf(0), mp.mpf(0), mp.mpf(0)]
        matrix = [
            [*row(first[0]), 0, 0],
            [*row(first[1]), 0, 0],
            [*row(first[2]), third, 0],
            [*row(first[3]), 0, -mp.sqrt(2 / mp.pi)],
        ]
        right = [s - mp.im(g) / 2 for s, g in zip(slow, second, strict=True)]
        solution = mp.lu_solve(mp.matrix(matrix), mp.matrix(right))
        return solution[2], solution[3]


RATIOS = [1e-8, 1e-7, 3e-5, 1 / 1600, 0.01, 0.05, 0.15, 0.3, 0.38, 0.39, 0.45, 0.7, 0.95, 0.9999, 1 - 1e-6]


@pytest.mark.parametrize("ratio", RATIOS)
def test_tension_in_free_flight_is_exact(ratio: float) -> None:
    found = contact_parameters(ratio, axial=1.0)
    lambda_axial, r_axial = patched_waves(ratio, found.lambda0, 60 if ratio > 1e-3 else 120)
    assert found.lambda_axial == pytest.approx(float(lambda_axial), rel=1e-12, abs=0.0)
    assert found.r_axial == pytest.approx(float(r_axial), rel=1e-12, abs=0.0)
    # a stress-free bow in flight: tension's own part is all there is, and the zone rests without reaction
    flight = contact_parameters(ratio, alpha=-ratio, axial=1.0)
    assert (flight.lambda1, flight.r1) == pytest.approx((found.lambda_axial, found.r_axial), rel=1e-9)
    assert (flight.regime, flight.uniform_reaction) == ("continuous", 0.0)


def test_limits_of_the_flat_and_of_the_strongly_curved_beam() -> None:
    flat, nearly = contact_parameters(1e-10, axial=1.0), contact_parameters(1.0 - 1e-9, axial=1.0)
    assert flat.lambda_axial == pytest.approx(-0.5 / flat.lambda0, rel=1e-8)
    assert flat.r_axial == pytest.approx(-3.75e-10 * flat.r0, rel=1e-8)
    assert (nearly.lambda_axial, nearly.r_axial) == pytest.approx((-np.sqrt(np.pi / 2.0), -1.5), rel=1e-8)
    # one point: the tension acts on the wave alone when the load keeps the bow from accelerating
    point = contact_parameters(40.0, nu=3.0, axial=0.5)
    assert (point.lambda1, point.lambda_axial) == (0.0, 0.0)
    assert point.r1 == 0.75
    assert point.r_axial == pytest.approx(1.5 - 240.0, rel=1e-15)


@given(ratio=st.floats(1e-8, 1e4), axial=COEFFICIENTS, psi=COEFFICIENTS, chi=COEFFICIENTS, nu=st.floats(0.1, 10.0))
def test_wave_and_free_motion_add_up(ratio: float, axial: float, psi: float, chi: float, nu: float) -> None:
    # the loads enter with α′ = α + axial·κ, the wave operator on its own
    alpha = 0.7
    whole = contact_parameters(ratio, alpha, psi, chi, nu, axial)
    loads = contact_parameters(ratio, alpha + axial * whole.kappa, psi, chi, nu)
    assert whole.regime == loads.regime
    assert whole.uniform_reaction == pytest.approx(loads.uniform_reaction, rel=1e-14, abs=1e-13)
    for name, part in (("lambda1", "lambda_axial"), ("r1", "r_axial")):
        of_loads, of_wave = getattr(loads, name), axial * getattr(whole, part)
        scale = abs(of_loads) + abs(of_wave)
        assert abs(getattr(whole, name) - of_loads - of_wave) <= 1e-12 * scale


@given(ratio=st.floats(1e-8, 1.0, exclude_max=True), axial=COEFFICIENTS, psi=COEFFICIENTS)
def test_a_zone_at_rest_without_reaction_is_continuous_whatever_the_rounding(
    ratio: float, axial: float, psi: float
) -> None:
    alpha = -(psi + axial * ratio) * (1.0 + 4.0 * np.finfo(float).eps)
    found = contact_parameters(ratio, alpha, psi, axial=axial)
    assert (found.regime, found.uniform_reaction) == ("continuous", 0.0)


@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.5, 0.9, 2.0])
@pytest.mark.parametrize("alpha", [0.0, 0.4])
def test_the_zone_stays_on_the_wall_at_first_order_in_the_tension(ratio: float, alpha: float) -> None:
    places, e = np.array([0.0, 0.3, 0.6, 0.9, 1.0]) * (ratio < 1.0), 1e-4

    def residual(axial: float) -> np.ndarray:
        parameters = contact_parameters(ratio, alpha - axial * ratio, axial=axial)
        return ImpactFields(parameters, e).complementarity_residual(places, 1.0)

    with_, without, against = residual(1.0), residual(0.0), residual(-1.0)
    linear = (with_ - against) / (2.0 * e)
    assert np.max(np.abs(linear)) < 2e-7 + 3.0 * e
    # what is left is of second order, and the kernel's change is of first: without it this fails by 0.1
    assert np.max(np.abs(with_ - without)) < 3.0 * e**2


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
