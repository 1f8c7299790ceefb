"""Timoshenko's beam in its first instants: transforms, limits, and what the whole prediction makes of them."""

import numpy as np
import pytest
from mpmath import mp

from bent_beam import Impact
from theory import contact_parameters, predict
from theory.shear import StoppedPoint, early_until, early_zone, first_instants, forgotten_after, rim


@pytest.mark.parametrize(("g", "damping"), [(0.2, 0.3), (0.33, 0.0)])
def test_a_stopped_point_is_the_inverse_of_its_transform_by_another_method(g: float, damping: float) -> None:
    """De Hoog's quotient-difference in many digits, of waves found as roots of Timoshenko's dispersion relation."""

    def impulse(s: mp.mpc) -> mp.mpc:
        """Waves e^{−ax}: D²a⁴ − (1 + g)s²D a² + g s⁴ + s²D = 0; φ = (s²/(Da) − a) w over −1; φ(0) = 0, w(0) = 1/s²."""
        stiff = 1 + mp.mpf(damping) * s
        half, product = (1 + g) * s**2 / (2 * stiff), (g * s**4 + s**2 * stiff) / stiff**2
        squares = [half + sign * mp.sqrt(half**2 - product) for sign in (1, -1)]
        a, b = (mp.sqrt(square) for square in squares)
        turn = [s**2 / (stiff * k) - k for k in (a, b)]
        first, second = turn[1] / (turn[1] - turn[0]), -turn[0] / (turn[1] - turn[0])  # shares of w(0)
        angle_free = first * a + second * b  # −w_x(0) = −Q/(SD)
        return 2 * stiff * angle_free / s**2 / s

    point = StoppedPoint(g, damping)
    for time in (0.1, 1.0, 6.0):
        with mp.workdps(30):
            exact = float(mp.invertlaplace(impulse, time, method="dehoog", degree=40))
        assert float(point.impulse(time)) == pytest.approx(exact, rel=2e-6)
    times = np.array([0.5, 5.0, 50.0])
    rate = (point.impulse(times * 1.0001) - point.impulse(times * 0.9999)) / (2e-4 * times)
    assert point.reaction(times) == pytest.approx(rate, rel=1e-4)


def test_a_stopped_point_begins_with_shear_waves_and_ends_as_euler_and_bernoulli_s() -> None:
    for g in (0.2, 0.33):
        point = StoppedPoint(g)
        assert float(point.reaction(1e-3)) == pytest.approx(2.0, rel=1e-5)
        assert float(point.moment(1e-3)) == pytest.approx(1e-3 / (1.0 + np.sqrt(g)), rel=1e-3)
        late = 4.0 * np.sqrt(600.0 / np.pi) * (1.0 - (3.0 - g) / 2400.0)
        assert float(point.impulse(300.0)) == pytest.approx(late, rel=1e-5)
        assert float(point.moment(300.0)) == pytest.approx(1.0, abs=1e-4)
    assert float(StoppedPoint(0.2, 0.06).reaction(1e-5)) == pytest.approx(2.0 * np.sqrt(0.06 / np.pi / 1e-5), rel=1e-3)


@pytest.mark.parametrize("kappa", [0.1, 0.5, 0.9])
def test_the_rim_is_one_shear_length_ahead_in_the_end_and_the_early_zone_keeps_its_momentum(kappa: float) -> None:
    lambda0 = contact_parameters(kappa).lambda0
    assert rim(kappa, lambda0, 1e4) - lambda0 * 100.0 == pytest.approx(1.0, abs=1e-3)
    time = early_until(kappa)
    place, force, impulse = early_zone(kappa, time)
    assert impulse == pytest.approx(2.0 * place) and force == pytest.approx(impulse / (2.0 * time))
    assert place == pytest.approx(1.0 / kappa) and force == pytest.approx(2.0)  # R of a stopped point's first instant
    assert rim(1.2, 0.0, 1e4) < rim(1.0, 0.0, 1e4) == pytest.approx(1.19968, abs=1e-5)


def test_shear_and_damping_turn_one_point_s_series_over_without_a_jump() -> None:
    solved = contact_parameters(3.0)
    for damping in (0.0, 0.5):
        before, after = (first_instants(3.0, solved, 0.2, t, damping) for t in (499.9, 500.1))
        assert after == pytest.approx(before, rel=1e-3)
    before, after = (first_instants(3.0, solved, 0.1, 500.0 * (1.0 + past)) for past in (0.0, 1e-9))
    assert after == pytest.approx(before, rel=1e-5)
    for time in (0.1, 0.3, 2.0, 400.0, 600.0):  # the least damping is as good as none
        assert first_instants(3.0, solved, 0.2, time, 1e-9) == pytest.approx(first_instants(3.0, solved, 0.2, time))
    turn = early_until(3.0)
    before, after = (first_instants(3.0, solved, 0.2, share * turn)[0] for share in (0.999, 1.001))
    assert after == pytest.approx(before, rel=0.03)  # the zone does not leap ahead where its own law takes over


def test_a_damped_point_that_shears_little_has_the_force_and_impulse_of_one_that_does_not() -> None:
    plain = Impact.dimensionless(3.0).replace(damping=0.05)
    sheared = plain.replace(shear_stiffness=1e4, rotary_inertia=1e-5)
    one, other = (predict(impact, [0.1]).times[0] for impact in (plain, sheared))
    assert (other.reaction, other.impulse) == pytest.approx((one.reaction, one.impulse), rel=3e-3)


def test_a_prediction_of_a_sheared_beam_is_its_own_and_euler_and_bernoulli_s_in_the_end() -> None:
    plain = Impact(1.0, 1.0, 2e4, 5e-4, 1e-3)  # slopes of a thousandth
    sheared = plain.replace(shear_stiffness=1.0, rotary_inertia=0.2)
    early, late = (predict(sheared, t).times[0] for t in (0.5, 1e5))
    assert (early.half_contact_length, early.impulse) == pytest.approx((2.0**0.5, 2e-3 * 2.0**0.5))
    assert early.spoiled_by == "shear" and predict(sheared).valid_from == pytest.approx(10.0)
    of_flat = [forgotten_after(kappa) for kappa in (0.049, 0.05, 3.0)]  # (ν/κ)² t_s, ten at least (docs/shear.md)
    assert of_flat == pytest.approx([np.inf, 0.05**-2, 10.0])
    bare = predict(plain, 1e5).times[0]
    assert late.impulse == pytest.approx(bare.impulse, rel=1e-9) and late.reaction == pytest.approx(bare.reaction)
    assert late.half_contact_length - bare.half_contact_length == pytest.approx(1.0, abs=1e-2)  # l_s
