"""The leading order in closed form: gap, momentum, energy, far field and largest moment."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from many_digits import row, wave

from theory import SelfSimilarWave, contact_parameters, peak_moment


@pytest.mark.parametrize("ratio", [1e-6, 1 / 1600, 0.05, 0.5, 0.9999, 1.0, 2.0, 50.0])
def test_momentum_equals_impulse_and_the_impact_conserves_energy(ratio: float) -> None:
    # beam: ½∫[(1−η_τ)² − 1] + ½∫η_ξξ² = energy of the fast layer − its momentum
    wave = SelfSimilarWave(contact_parameters(ratio))
    assert wave.momentum == pytest.approx(wave.impulse, rel=1e-12)
    assert wave.energy == pytest.approx(wave.impulse, rel=1e-11)


@settings(max_examples=50)
@given(ratio=st.floats(1e-4, 50.0), beyond=st.floats(1e-2, 100.0))
def test_the_gap_is_open_outside_the_zone_and_closed_inside(ratio: float, beyond: float) -> None:
    wave = SelfSimilarWave(contact_parameters(ratio))
    front = wave.parameters.lambda0
    assert wave.gap(front + beyond * max(front, 1.0))[0] > 0.0
    assert wave.gap(front / (1.0 + beyond))[0] == 0.0


@pytest.mark.parametrize("ratio", [0.05, 0.5, 2.0])
def test_the_far_field_dies_like_the_third_and_second_power(ratio: float) -> None:
    wave = SelfSimilarWave(contact_parameters(ratio))
    deflection, slope = wave.far_field
    x = np.linspace(30.0, 60.0, 20001)
    for values, bound, power in ((wave.deflection(x), deflection, 3), (wave.slope(x), slope, 2)):
        peak = np.max(np.abs(values) * x**power)
        assert peak < bound * (1.0 + 1e-2)
        assert peak == pytest.approx(bound, rel=2e-2)


@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 0.03, 0.2, 0.59, 0.9, 0.999])
def test_moment_ahead_in_many_digits(ratio: float) -> None:
    """B from λ₀ and the slow motion alone, the extremum by a root search of E‴."""
    found = peak_moment(ratio)
    with mp.workdps(60):
        x, e = mp.mpf(contact_parameters(ratio).lambda0), wave(2)
        b = mp.matrix([-mp.mpf(ratio) * x, -mp.mpf(ratio)])
        amplitude = mp.mpc(*mp.lu_solve(mp.matrix([row(e(x, 1)), row(e(x, 2))]), b))
        place = mp.findroot(lambda y: mp.re(amplitude * e(y, 3)), mp.mpf(found.place))
        moment = mp.re(amplitude * e(place, 2))
    # λ₀ itself is known to a rounding only, hence not 1e-15
    assert found.place == pytest.approx(float(place), rel=1e-10)
    assert found.ahead == pytest.approx(float(moment), rel=1e-10)


@given(st.floats(1e-4, 3.0))
def test_nowhere_is_the_curvature_larger(ratio: float) -> None:
    parameters, found = contact_parameters(ratio), peak_moment(ratio)
    x = parameters.lambda0 + np.geomspace(1e-6, 50.0, 4000)
    bending = SelfSimilarWave(parameters).curvature(x)
    assert np.max(bending) <= found.ahead * (1.0 + 1e-12)
    assert np.max(np.abs(bending)) <= found.largest * (1.0 + 1e-12)
    assert SelfSimilarWave(parameters).curvature(found.place) == pytest.approx(found.ahead, rel=1e-11)


def test_one_point_bends_by_the_velocity_however_curved_the_beam_is_and_a_flat_beam_hardly_less() -> None:
    found = peak_moment([1.0, 2.0, 1e4])
    np.testing.assert_array_equal(found.largest, 1.0)
    np.testing.assert_array_equal(found.place_of_largest, 0.0)
    np.testing.assert_allclose(found.place, np.sqrt(2.0 * np.pi), rtol=1e-14)
    assert peak_moment(1e-7).largest == pytest.approx(1.0 - np.pi / 2.0 * 1e-7, abs=1e-12)
    nearly, point = peak_moment(1.0 - 1e-12), peak_moment(1.0)
    assert (nearly.largest, nearly.ahead) == pytest.approx((point.largest, point.ahead), rel=1e-11)
    assert peak_moment(0.597).place_of_largest > 0.0 == peak_moment(0.6).place_of_largest
