"""The fields: contact where there should be contact, derivatives of one another; the leading order in closed form: gap,
momentum, energy, far field and largest moment."""

import mpmath as mp
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from many_digits import row, wave
from scipy.integrate import simpson

from theory import ImpactFields, SelfSimilarWave, contact_parameters, peak_moment


@pytest.mark.parametrize(
    ("ratio", "loads", "tau"),
    [
        (0.5, (1, 1, 1, 0), 0.3),
        (0.05, (-1, -0.1, 0, 0), 0.3),  # the middle lifts off
        (0.5, (-0.1, 0, 0, 1), 1.0),  # tension, which changes the kernel
        (2.0, (-1.6, 0, 0, 1), 1.0),
    ],
)
def test_first_order_touches_up_to_epsilon_squared(ratio: float, loads: tuple[float, ...], tau: float) -> None:
    parameters = contact_parameters(ratio, *loads[:3], axial=loads[3])
    touching = 1.0 if parameters.regime == "detached" else np.linspace(0.0, 1.0, 6)
    fields = (ImpactFields(parameters, e) for e in (0.01, 0.005))
    residuals = [np.max(np.abs(field.complementarity_residual(touching, tau))) for field in fields]
    assert 3.7 < residuals[0] / residuals[1] < 4.2


def test_leading_order_and_one_point_at_every_order_touch_to_round_off_and_a_detached_middle_lifts_off() -> None:
    for ratio in (0.05, 0.8):
        zone = ImpactFields(contact_parameters(ratio)).complementarity_residual(np.linspace(-1.0, 1.0, 21), 0.5)
        assert np.max(np.abs(zone)) < 1e-9 * 0.5
    for loads in ((0, 0, 0), (1, 1, 0), (-2, 0, 1)):
        point = ImpactFields(contact_parameters(2.0, *loads), epsilon=0.1)
        assert np.max(np.abs(point.complementarity_residual(0.0, [0.1, 0.5, 3.0]))) < 1e-10
    detached = ImpactFields(contact_parameters(0.5, -1.0, -1.0), epsilon=0.1)
    assert np.all(detached.complementarity_residual([0.0, 0.3, 0.6], 0.3) < -1e-4)


@pytest.mark.parametrize("ratio", [1 / 1600, 0.5, pytest.param(0.999, marks=pytest.mark.verify), 3.0])
def test_convolution_equals_the_closed_form_everywhere(ratio: float) -> None:
    parameters = contact_parameters(ratio)
    wave, tau = SelfSimilarWave(parameters), 0.7
    ahead = parameters.lambda0 + np.logspace(-10, 2, 5)
    x = np.unique([*np.linspace(-0.7, 1.0, 3) * parameters.lambda0, *ahead])
    fast = ImpactFields(parameters).fast_layer(x * np.sqrt(tau), tau)
    for name, scale in {"deflection": tau, "slope": np.sqrt(tau), "curvature": 1.0, "velocity": 1.0}.items():
        np.testing.assert_allclose(getattr(fast, name), scale * getattr(wave, name)(x), rtol=0.0, atol=1e-11)


@settings(max_examples=4)
@given(
    ratio=st.sampled_from([0.02, 0.4, 0.9, 1.5]),
    loads=st.tuples(*[st.sampled_from([-1.0, 0.0, 0.5])] * 4),
    xi=st.floats(0.05, 4.0),
    tau=st.floats(0.2, 0.6),
)
def test_slope_curvature_and_velocity_are_derivatives_of_the_deflection(ratio, loads, xi, tau):
    parameters = contact_parameters(ratio, *loads[:3], axial=loads[3])
    fields, h = ImpactFields(parameters, epsilon=0.01), 1e-3
    assume(parameters.lambda0 == 0.0 or parameters.lambda0 + 0.04 * parameters.lambda1 * tau > 0.0)
    assume(abs(xi - fields.half_contact_length(tau)) > 0.05)
    at = fields.beam(xi, tau)
    along = fields.beam(xi + h * np.array([-2, -1, 1, 2]), tau)
    later = fields.beam(xi, tau + 0.1 * h * np.array([-2, -1, 1, 2])).deflection
    first = np.array([1.0, -8.0, 8.0, -1.0]) / 12.0
    assert at.slope == pytest.approx(first @ along.deflection / h, abs=1e-6)
    assert at.curvature == pytest.approx(first @ along.slope / h, abs=1e-6)
    assert at.velocity == pytest.approx(first @ later / (0.1 * h), abs=1e-6)


def test_momentum_equals_impulse_at_first_order() -> None:
    # ∫η dξ = ∬(R̃ + 2λ_c r̃) dτ dτ; ahead of the front η oscillates and falls like ξ⁻³
    tau, e = 0.3, 0.1
    fields = ImpactFields(contact_parameters(0.5, 1.0, 1.0, axial=2.0), epsilon=e)  # whose part has no momentum
    p = fields.parameters
    xi = np.linspace(0.0, 12.0, 121)
    found = 2.0 * simpson(fields.fast_layer(xi, tau).deflection, x=xi)
    point = 8.0 / 3.0 * np.sqrt(2.0 / np.pi) * tau**1.5 * (p.r0 + e * p.r1 * tau / 5.0)
    zone = fields.uniform_reaction * 8.0 * tau**2.5 * (p.lambda0 / 15.0 + e * p.lambda1 * tau / 35.0)
    assert found == pytest.approx(point + zone, rel=1e-4)


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
