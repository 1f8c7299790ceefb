"""The fields: contact where there should be contact, derivatives of one another, and the closed form."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.integrate import simpson

from theory import ImpactFields, SelfSimilarWave, contact_parameters, kernel

slow = pytest.mark.verify


@pytest.mark.parametrize(
    ("ratio", "loads", "tau"),
    [
        (0.5, (1, 1, 0, 0), 0.3),
        (0.05, (-1, 0, 0, 0), 0.3),  # the middle lifts off
        (0.5, (-0.1, 0, 0, 1), 1.0),  # tension, which changes the kernel
        (2.0, (-1.6, 0, 0, 1), 1.0),
        pytest.param(0.8, (0, 2, 0, 0), 0.5, marks=slow),
        pytest.param(0.1, (4, 0, 1, 0), 0.1, marks=slow),
        pytest.param(0.5, (-1, -1, 0, 0), 0.3, marks=slow),
        pytest.param(0.05, (-0.05, 0, 0, 1), 1.0, marks=slow),
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


@pytest.mark.parametrize("ratio", [1 / 1600, 0.5, pytest.param(0.999, marks=slow), 3.0])
def test_convolution_equals_the_closed_form_everywhere(ratio: float) -> None:
    parameters = contact_parameters(ratio)
    wave, tau = SelfSimilarWave(parameters), 0.7
    ahead = parameters.lambda0 + np.logspace(-10, 2, 5)
    x = np.unique([*np.linspace(-0.7, 1.0, 3) * parameters.lambda0, *ahead])
    fast = ImpactFields(parameters).fast_layer(x * np.sqrt(tau), tau)
    for name, scale in {"deflection": tau, "slope": np.sqrt(tau), "curvature": 1.0, "velocity": 1.0}.items():
        np.testing.assert_allclose(getattr(fast, name), scale * getattr(wave, name)(x), rtol=0.0, atol=1e-11)


@slow
@pytest.mark.parametrize(("ratio", "loads"), [(0.5, (1, 1, 0, 0.5)), (0.5, (-1, -1, 1, 0)), (2.0, (-2, 0, 0, 1))])
def test_convolution_equals_the_integral_as_it_stands(ratio: float, loads: tuple[float, ...]) -> None:
    """(2.7.3) after √s = √τ sin θ, on the real axis, to tan θ = 60 where little is left."""
    p, e, tau = contact_parameters(ratio, *loads[:3], axial=loads[3]), 0.1, 0.4
    fields, (nodes, weights) = ImpactFields(p, epsilon=e), np.polynomial.legendre.leggauss(10)
    v = (np.linspace(0.0, 60.0, 3001)[:-1, None] + 0.01 * (nodes + 1.0)).ravel()
    s, root = tau * v**2 / (1.0 + v**2), np.sqrt(tau / (1.0 + v**2))
    front = np.sqrt(s) * (p.lambda0 + e * p.lambda1 * s)
    for xi in (0.2, 1.2, 1.9):
        left, right = (xi + front) / root, (xi - front) / root
        of_points = sum(kernel.H(beta) + e * p.axial * root**2 * kernel.H_axial(beta) for beta in (left, right))
        point = 2.0 / np.pi * (p.r0 + e * p.r1 * s) * root**2 * of_points
        zone = fields.uniform_reaction / np.sqrt(2.0 * np.pi) * root**2 * (kernel.P(left) - kernel.P(right))
        values = (point + zone * 2.0 * np.sqrt(s) * root) / (1.0 + v**2)
        # where P(left) − P(right) tends to √(2π), which does not oscillate, the rest is known
        rest = fields.uniform_reaction * tau**2 / 2.0 / 3601.0**2 if xi < fields.half_contact_length(tau) else 0.0
        integral = 0.01 * np.tile(weights, 3000) @ values + rest
        assert fields.fast_layer(xi, tau).deflection == pytest.approx(integral, abs=1e-10)


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
    p = fields.parameters
    assume(p.lambda0 == 0.0 or p.lambda0 + 4.0 * fields.epsilon * p.lambda1 * tau > 0.0)
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
    fields = ImpactFields(contact_parameters(0.5, 1.0, 1.0), epsilon=e)
    p = fields.parameters
    xi = np.linspace(0.0, 12.0, 201)
    found = 2.0 * simpson(fields.fast_layer(xi, tau).deflection, x=xi)
    point = 8.0 / 3.0 * np.sqrt(2.0 / np.pi) * tau**1.5 * (p.r0 + e * p.r1 * tau / 5.0)
    zone = fields.uniform_reaction * 8.0 * tau**2.5 * (p.lambda0 / 15.0 + e * p.lambda1 * tau / 35.0)
    assert found == pytest.approx(point + zone, rel=1e-4)


def test_fields_are_even_in_the_place_and_slopes_odd() -> None:
    fields = ImpactFields(contact_parameters(0.3))
    right, left = fields.beam([0.4, 3.0], 0.5), fields.beam([-0.4, -3.0], 0.5)
    np.testing.assert_array_equal(right.deflection, left.deflection)
    np.testing.assert_array_equal(right.slope, -left.slope)
