"""One point stopped, of a beam with its own damping: Laplace inversion, the beam without ends, its release, moments; of
Timoshenko's beam in its first instants: transforms, limits, and what the whole prediction makes of them."""

import itertools
import math
from functools import cache

import numpy as np
import pytest
from mpmath import mp

from bent_beam import Impact
from theory import contact_parameters, damped_point, peak_moment, predict
from theory.shear import StoppedPoint, early_until, early_zone, first_instants, forgotten_after, rim
from theory.stopped_beam import StoppedBeam


@cache
def transformed(damping: float, s: mp.mpc) -> dict[str, mp.mpc]:
    """Half a beam at complex frequency s, without modes: y⁗ ~ −s²y, y(0) = 1/s², y′(0) = 0, y″(1) = y‴(1) = 0."""
    stiffness = 1 + mp.mpf(damping) * s
    k = mp.sqrt(mp.sqrt(-s * s / stiffness))
    sin, cos, sinh, cosh = mp.sin(k), mp.cos(k), mp.sinh(k), mp.cosh(k)
    unit = stiffness * k**2 / (1 + cos * cosh) / s**2
    push = -2 * unit * k * (sin * cosh + cos * sinh)
    return {"impulse": push / s, "reaction": push, "midspan_moment": -unit * sin * sinh}


@pytest.mark.parametrize("damping", [3.0, 2.0 / 3.51601526850015, 1e-2])  # the second: a mode damped critically
def test_modes_give_what_laplace_inversion_by_talbots_contour_gives(damping: float) -> None:
    """With the last no wave is back from an end at 1e-4. In the end the wall has all of the momentum, 2μℓV₀."""
    beam = StoppedBeam(damping)
    for time, kind in itertools.product((1e-4, 1e-3, 0.02, 0.3), ("impulse", "reaction", "midspan_moment")):
        with mp.workdps(30):
            transform = lambda s, kind=kind: transformed(damping, s)[kind]  # noqa: E731
            exact = mp.invertlaplace(transform, time, method="talbot", degree=50)
        assert float(getattr(beam, kind)(time)) == pytest.approx(float(exact), rel=1e-12, abs=1e-13)
    assert beam.impulse(np.array([[0.0, 600.0]])) == pytest.approx(np.array([[0.0, 2.0]]), abs=1e-9)


@pytest.mark.parametrize("damping", [0.0246, 1e-2, 3e-3, 1e-3, 1e-4])  # the first: shorter than between two looks
def test_first_release_is_where_the_reaction_first_changes_sign(damping: float) -> None:
    beam = StoppedBeam(damping)
    found = beam.release()
    assert found.impulse == pytest.approx(float(beam.impulse(found.time)), rel=1e-12)
    before = np.append(np.linspace(0.02, 1.0 - 1e-6, 400), 1.0 - 1e-9) * found.time
    assert np.all(beam.reaction(before) > 0.0) and beam.reaction(found.time * (1.0 + 1e-9)) < 0.0


AGEING = [("reaction_ratio", 0.25, 0.5), ("impulse_ratio", 0.25, 1.5), ("impulse_ratio_of_acceleration", 0.25, 2.5)]


@pytest.mark.parametrize(("name", "p", "q"), [*AGEING, ("moment_ratio", 0.5, 1.0)])
def test_a_damped_point_is_the_inverse_of_its_laplace_transform_at_every_age(name: str, p: float, q: float) -> None:
    """That of (1 + s)ᵖ/s^q, over what 1/s^q gives without damping."""
    for age in (1e-4, 1e-3, 0.1, 1.0, 3.0, 7.0, 50.0, 60.0):
        with mp.workdps(30):
            exact = mp.invertlaplace(lambda s: (1 + s) ** p / s**q, age, method="talbot")
            ratio = exact / (mp.mpf(age) ** (q - 1) / mp.gamma(q))
        assert float(getattr(damped_point, name)(age)) == pytest.approx(float(ratio), rel=1e-8), age


def test_a_zone_spreads_at_the_age_at_which_the_moment_has_taken_its_curvature() -> None:
    for kappa in (1e-3, 0.5, 1.0 - 1e-10):
        assert np.sqrt(damped_point.age_of_spreading(kappa)) == pytest.approx(float(mp.erfinv(kappa)), rel=1e-9)
    assert damped_point.age_of_spreading(1.0) == damped_point.age_of_spreading(3.0) == np.inf


def test_the_moment_ahead_of_a_damped_point_has_no_number_in_its_first_75_damping_times() -> None:
    # at first 0.24 of that at the contact, in the end 0.56 of it: where it may be the largest nothing is said
    for elastic, known in ((0.0, True), (0.4, False), (1.0, False), (-3.0, True)):  # curvature of the bow, of 2
        point = Impact.whole_beam(2.0, relative_damping=1e-5).replace(natural_curvature=2.0 - elastic)
        touch, early, late = predict(point, [0.0, 7.4e-4, 7.6e-4]).times
        assert touch.peak_moment == pytest.approx(abs(elastic))  # before it
        assert (early.peak_moment is not None, early.peak_moment_place is not None) == (known, known)
        undamped = predict(point.replace(damping=0.0), 7.6e-4).times[0]
        assert late.peak_moment == pytest.approx(undamped.peak_moment, rel=1e-12)
    (spread,) = predict(Impact.whole_beam(0.3, relative_damping=1e-5), 6e-4).times  # no point any more: as without
    assert spread.peak_moment == pytest.approx(peak_moment(0.3).largest, rel=1e-12) and not spread.valid


@pytest.mark.parametrize(
    ("age", "near", "share"), [(1e-3, 12.25, 0.24), (damped_point.AHEAD_FROM, 2.5, 0.98 * 0.5597868)]
)
def test_the_elastic_moment_ahead_of_a_damped_point_becomes_that_without_damping(age, near, share) -> None:
    """Over that at the contact; times in η, places in √(cη), the largest near a multiple of the root of the age. The
    inverse of e^{−aX}(cos aX − sin aX)/(s√(1 + s))."""

    def moment(place: float) -> float:
        def transform(s: mp.mpc) -> mp.mpc:
            a = place * mp.sqrt(s / 2) / (1 + s) ** 0.25
            return mp.exp(-a) * (mp.cos(a) - mp.sin(a)) / (s * mp.sqrt(1 + s))

        return float(mp.invertlaplace(transform, age, method="talbot"))

    with mp.workdps(20):
        ahead = max(-moment(place) for place in np.linspace(0.7, 1.3, 7) * near * math.sqrt(age))
    assert ahead / float(damped_point.elastic_moment_ratio(age)) == pytest.approx(share, rel=5e-3)


@pytest.mark.parametrize(("g", "damping"), [(0.2, 0.3), (0.33, 0.0)])
def test_a_stopped_point_is_the_inverse_of_its_transform_by_another_method(g: float, damping: float) -> None:
    """De Hoog's quotient-difference in many digits, of waves found as roots of Timoshenko's dispersion relation."""

    def impulse(s: mp.mpc) -> mp.mpc:
        """Waves e^{−ax}, e^{−bx}: D²a⁴ − (1 + g)s²Da² + gs⁴ + s²D = 0; φ = (s²/(Da) − a)w; φ(0) = 0, w(0) = 1/s²."""
        stiff = 1 + mp.mpf(damping) * s
        product = s * mp.sqrt(g * s**2 + stiff) / stiff  # ab
        total = mp.sqrt((1 + g) * s**2 / stiff + 2 * product)  # a + b
        return 2 * stiff * total / (s**2 + stiff * product) / s

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
    held, point = first_instants(3.0, solved, 0.2, 0.3 * turn, 1.0), StoppedPoint(0.2, 1.0)  # no zone as yet
    assert held[1:] == (float(point.reaction(0.3 * turn)), float(point.impulse(0.3 * turn)))
    assert held[0] < 0.5 * early_zone(3.0, 0.3 * turn)[0] and held[2] > 1.2 * early_zone(3.0, 0.3 * turn)[2]
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
