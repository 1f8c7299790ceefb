"""The theory's own special functions against scipy's: they are written out so that a start need not import those."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import erf, erfinv, fresnel, gamma, hyp1f1, wofz

from theory import damped_point, damped_zone
from theory._fresnel import SWITCH, fresnel_integrals, scaled_erfc
from theory._iterated_erfc import iterated_erfc_of_wave, scaled_iterated_erfc

TURN = np.exp(-0.25j * np.pi) / 2.0


def test_fresnel_integrals_keep_all_digits_up_to_where_the_moments_take_over() -> None:
    lam = np.concatenate([np.geomspace(1e-12, 1.0, 200), np.linspace(1.0, SWITCH, 200, endpoint=False)])
    for own, known in zip(fresnel_integrals(lam), fresnel(lam / np.sqrt(2.0 * np.pi)), strict=True):
        np.testing.assert_allclose(own, known, rtol=2e-15)


def test_waves_are_made_of_the_complementary_error_function_on_a_diagonal() -> None:
    x = np.concatenate([[0.0], np.geomspace(1e-10, 1e8, 3998)]).reshape(-1, 3)
    known = wofz(1j * TURN * x)
    np.testing.assert_allclose(np.abs(scaled_erfc(x) / known - 1.0), 0.0, atol=2e-14)
    assert complex(scaled_erfc(2.0)) == pytest.approx(complex(wofz(2j * TURN)), rel=1e-14)
    for own, of_any in zip(iterated_erfc_of_wave(x), scaled_iterated_erfc(TURN * x), strict=True):
        np.testing.assert_allclose(own, of_any, rtol=1e-11, atol=1e-13)  # own: 5e-15 off, of_any: 6e-14


@pytest.mark.parametrize(("ratio", "c"), [(damped_point.impulse_ratio, 1.25), (damped_point.reaction_ratio, 0.25)])
def test_a_damped_point_follows_kummers_function_at_every_age(ratio, c: float) -> None:
    age = np.concatenate([np.geomspace(1e-30, 1e12, 500), np.linspace(30.0, 42.0, 120)])
    known = gamma(c + 0.25) / gamma(c) * age**-0.25 * hyp1f1(-0.25, c, -age)
    np.testing.assert_allclose(ratio(age), known, rtol=1e-13)
    assert ratio(age.reshape(2, -1)).shape == (2, 310)
    assert float(ratio(40.0)) == pytest.approx(float(ratio([40.0])[0]), rel=1e-15)


def test_the_moment_of_a_damped_point_and_the_age_at_which_a_zone_spreads() -> None:
    age = np.geomspace(1e-6, 1e3, 50).reshape(5, 10)
    known = np.exp(-age) / np.sqrt(np.pi * age) + erf(np.sqrt(age))
    np.testing.assert_allclose(damped_point.moment_ratio(age), known, rtol=1e-14)
    for kappa in (1e-3, 0.05, 0.5, 0.9, 1.0 - 1e-10, np.nextafter(1.0, 0.0)):
        assert damped_zone.age_of_spreading(kappa) == pytest.approx(erfinv(kappa) ** 2, rel=1e-12)
