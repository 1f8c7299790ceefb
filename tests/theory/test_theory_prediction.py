"""The prediction in SI units: scales, the direct link to α, and its own validity."""

import math
from collections.abc import Callable
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import erfinv

from bent_beam import Impact
from theory import SelfSimilarWave, contact_parameters, peak_moment, predict, validity
from theory.stopped_beam import StoppedBeam, _cantilever

PIPE = Impact(bending_stiffness=4.0e6, mass_per_length=29.0, length=2000.0, curvature=1.0 / 600.0, velocity=2.0)
POINT = Impact.whole_beam(2.0, relative_damping=1e-3)  # damped
PUSHED = PIPE.replace(acceleration=0.02)


@pytest.mark.parametrize(
    "impact",
    [PUSHED, PIPE.replace(acceleration=-0.02), PUSHED.replace(curvature=0.02), POINT.replace(acceleration=7.0)],
)
def test_impulse_is_the_time_integral_of_the_reaction(impact: Impact) -> None:
    rate = lambda root: 4.0 * root**3 * predict(impact, root**4).times[0].reaction  # noqa: E731
    total, _ = quad(rate, 0.0, 0.4**0.25, epsrel=1e-12)
    assert predict(impact, 0.4).times[0].impulse == pytest.approx(total, rel=1e-11)


def test_contact_length_reaction_and_the_inertia_of_the_load_in_plain_units() -> None:
    start, row = predict(PIPE, [0.0, 0.09]).times
    solved = contact_parameters(PIPE.kappa_over_nu)
    root = (PIPE.bending_stiffness / PIPE.mass_per_length) ** 0.25
    assert row.half_contact_length == pytest.approx(root * 0.3 * solved.lambda0, rel=1e-13)
    expected = 2.0 * math.sqrt(2.0 / math.pi) * PIPE.mass_per_length * PIPE.velocity * root * solved.r0 / 0.3
    assert row.reaction == pytest.approx(expected, rel=1e-13) and row.contact_force_per_length == 0.0
    assert (start.half_contact_length, start.impulse, start.reaction) == (0.0, 0.0, None)
    # a decelerating force a₀ on every part of a beam in contact is carried by the wall: μ a₀
    (pressed,) = predict(PIPE.replace(acceleration=0.05), [0.01]).times
    assert pressed.contact_force_per_length == pytest.approx(29.0 * 0.05, rel=1e-13)


def test_epsilon_does_not_matter() -> None:
    pressed = PIPE.replace(acceleration=0.05)
    one, shorter = predict(pressed, 0.05), predict(pressed.replace(length=900.0), 0.05)
    assert (shorter.times[0].reaction, shorter.times[0].impulse) == (one.times[0].reaction, one.times[0].impulse)
    assert one.epsilon != shorter.epsilon and one.alpha != shorter.alpha
    ours, theirs = ([found.epsilon * found.lambda1, found.epsilon * found.r1] for found in (one, shorter))
    assert ours == pytest.approx(theirs, rel=1e-13)


def test_an_expansion_that_has_broken_down_returns_nothing() -> None:
    early, late = predict(Impact(1.0, 1.0, 50.0, 0.35, 3.5, acceleration=-700.0), [1e-5, 0.1]).times
    assert early.valid and early.reaction is not None
    assert not late.valid
    assert late.half_contact_length is late.reaction is late.impulse is None
    within, beyond = predict(Impact.whole_beam(0.5), [0.95, 1.0]).times  # of the beam
    assert within.half_contact_length < within.peak_moment_place == 1.0 and beyond.half_contact_length is None
    # where the second order is small, a zone counts until it is 30 % longer
    zones = [Impact.dimensionless(0.9, epsilon_alpha=alpha, length=1e4) for alpha in (0.0, 1e4)]
    bare, grown = (predict(zone, predict(zones[1]).valid_until).times[0].half_contact_length for zone in zones)
    assert grown == pytest.approx(1.3 * bare, rel=1e-9)


def steel(yield_stress):
    return SimpleNamespace(area=3.4e-3, section_modulus=9.2e-5, yield_stress=yield_stress)


@pytest.mark.parametrize(
    ("impact", "section", "limited_by"),
    [
        (PIPE, None, validity.ENDS),
        (PIPE.replace(acceleration=20.0), None, validity.FIRST_ORDER),
        (PIPE.replace(axial_force=2e6), None, validity.TENSION),
        (Impact.dimensionless(0.5, epsilon_alpha=1e4, epsilon_axial=1e2, length=1e6), None, validity.FIRST_ORDER),
        (Impact.dimensionless(0.5, epsilon_alpha=1e4, epsilon_axial=1e6, length=1e6), None, validity.TENSION),
        (PIPE.replace(length=1e5, velocity=300.0), None, validity.SLOPE),
        (PIPE.replace(length=4.0, curvature=0.1, shear_stiffness=2e7), None, validity.SHEAR),
        (PIPE.replace(shear_stiffness=2e9), None, validity.ENDS),
        (PIPE, steel(1e8), validity.SECTION),
        (PIPE.replace(hysteretic_loss=0.1, loss_frequency=1.0), None, "hysteretic loss"),
    ],
)
def test_what_ends_it_is_one_thing_and_rows_never_contradict_it(impact, section, limited_by):
    whole = predict(impact, section=section)
    until, early = whole.valid_until, 0.9 * whole.valid_from or 1e-6
    assert whole.valid_from <= until  # both 0 where it never holds
    if limited_by == validity.SLOPE:  # where an arch is 2 % lower than its parabola, θ²/12
        wave, c = SelfSimilarWave(contact_parameters(whole.kappa_over_nu)), math.sqrt(4.0e6 / 29.0)
        steepest = np.abs(wave.slope(np.linspace(0.0, whole.lambda0 + 5.0, 2001))).max()
        assert (300.0 * math.sqrt(until / c) * steepest) ** 2 / 12.0 == pytest.approx(0.02, rel=1e-3)
    times = [0.0, early, 0.5 * until, until, until * (1.0 + 1e-9) + 1e-300, 2.0 * until, 50.0]
    found = predict(impact, times, section=section)
    assert found.limited_by == found.times[4].spoiled_by == limited_by
    assert [row.valid for row in found.times] == [found.valid_from <= t <= until and until > 0.0 for t in times]
    after = validity.SHEAR if 0.0 < found.valid_from < until else None
    assert found.valid_after == after and found.times[1].spoiled_by == (after if until > early else limited_by)


def off(impact: Impact, name: str, exact: Callable[..., np.ndarray], begin: float, end: float) -> float:
    """Largest error of what is predicted between two times, a share."""
    times = np.linspace(begin, end, 250)
    found = [getattr(row, name) for row in predict(impact, times).times]
    return float(np.abs(found / exact(times) - 1.0).max())


@pytest.mark.parametrize("damping", [0.0, 1e-4, 3e-3])
def test_one_point_is_the_stopped_beam_to_two_per_cent_until_the_limit(damping: float) -> None:
    """A beam of finite length by its modes; for the undamped one with so little damping that nothing is left of it."""
    impact, beam = Impact.whole_beam(2.0, relative_damping=damping), StoppedBeam(damping or 1e-6)
    until = predict(impact).valid_until
    begin = (0.2 if damping == 0.0 else 0.01) * until
    assert off(impact, "impulse", beam.impulse, begin, until) < 0.02
    if damping > 0.0:  # without, the force swings from the first instant on
        assert off(impact, "reaction", beam.reaction, begin, until) < 0.02
        last = predict(impact, until * (1.0 - 1e-9)).times[0]  # the moment grows until then
        assert predict(impact).peak_moment == last.peak_moment
    else:
        assert off(impact, "impulse", beam.impulse, until, 2.0 * until) > 0.02


@pytest.mark.parametrize("damping", [1e-7, 3e-6, 1e-5])
def test_the_momentary_force_holds_until_short_waves_are_back_from_the_ends(damping: float) -> None:
    impact, beam = Impact.whole_beam(2.0, relative_damping=damping), StoppedBeam(damping)
    until = predict(impact).force_until
    swing = 2.0 * math.sqrt(2.0) * math.exp(-damping / (2.0 * until**3))
    assert swing == pytest.approx(0.01) and off(impact, "reaction", beam.reaction, 0.3 * until, until) < 0.02
    if damping < 1e-5:
        assert off(impact, "reaction", beam.reaction, until, 1.2 * until) > 0.02
    assert until < predict(impact).valid_until


def test_without_damping_the_force_over_a_tenth_of_the_time_holds_as_long_as_its_waves_cancel() -> None:
    impact, beam = Impact.whole_beam(2.0), StoppedBeam(1e-10)  # so little that its waves cancel as without

    def mean(times: np.ndarray) -> np.ndarray:
        return (beam.impulse(1.1 * times) - beam.impulse(0.9 * times)) / (0.2 * times)

    until = predict(impact).force_until
    assert off(impact, "reaction", mean, 0.5 * until, until) < 0.02
    assert off(impact, "reaction", mean, 1.5 * until, 3.0 * until) > 0.02
    for kappa in (0.5, 2.0):  # in proportion to ct/d²
        end = predict(Impact.whole_beam(kappa)).force_until
        distance = 1.0 - float(contact_parameters(kappa).lambda0) * math.sqrt(end)
        assert end / distance**2 == pytest.approx(until, rel=1e-9)
    assert 20.0 * math.sqrt(2.0) * until == pytest.approx(0.01)


def test_a_quartic_bow_sends_waves_from_its_ends() -> None:
    bare = predict(Impact.whole_beam(0.5)).valid_until
    bows = (Impact.whole_beam(0.5).replace(fourth_derivative=q, acceleration=-q) for q in (1e-3, 0.1, 10.0))
    small, some, large = (predict(bow).valid_until for bow in bows)
    assert bare == small > some > large > 0.0
    share = 2.0 * math.sqrt(2.0) * 10.0 * large / float(contact_parameters(0.5).r0)  # of the impulse (docs/theory.md)
    assert share == pytest.approx(0.02)


def test_a_force_along_x_swings_the_reaction_by_two_per_cent_at_the_limit() -> None:
    """It pushes each end across by NK. What the middle feels of a push is what the end moves less when the middle is
    stopped (Betti), 1 − v(t) at speed 1, over the force of a stop, 2√(2/πt): by the modes of a cantilever."""
    beam, pull = Impact.whole_beam(2.0), 0.4
    until = predict(beam.replace(axial_force=pull)).valid_until
    b, sigma = _cantilever(400)
    end = 4.0 * sigma / b * (-1.0) ** np.arange(b.size) * np.exp(-5e-8 * b**4 * until)  # short waves die

    def swing(time: float) -> float:
        t = np.linspace(0.5 * time, time, 2000)
        moved = np.cos(np.outer(t, b**2)) @ end
        return float(np.max(2.0 * pull * beam.curvature * np.abs(1.0 - moved) / (2.0 * np.sqrt(2.0 / (np.pi * t)))))

    assert swing(until) < 0.02 < swing(1.4 * until) and until < predict(beam).valid_until
    strong = predict(beam.replace(axial_force=300.0)).valid_until  # when the impulse swings, 2ct/ℓ² as much
    assert 2.0 * strong * 4.0 * math.sqrt(2.0) * 300.0 * beam.curvature * strong == pytest.approx(0.02)
    zone = predict(Impact.whole_beam(0.5).replace(axial_force=1.6))  # whose force is r₀ times as large
    assert 4.0 * math.sqrt(2.0) * 1.6 * 0.5 * zone.valid_until / zone.r0 == pytest.approx(0.02)


def test_an_acceleration_pushes_a_damped_point_by_its_share_of_the_impulse() -> None:
    """Duhamel: the answer to V₀ + a₀t is that to V₀ and a₀/V₀ times the integral of it over time."""
    loaded, bare = (predict(impact, 4e-3).times[0] for impact in (POINT.replace(acceleration=7.0), POINT))
    assert loaded.reaction - bare.reaction == pytest.approx(7.0 * bare.impulse, rel=1e-9)
    # what tension does in free flight is known only without damping: good until it changes the force by 2 %
    flights = [{"axial_force": n, "acceleration": -2.0 * n} for n in (4.0, 0.0)]
    pulled = predict(POINT.replace(**flights[0]))
    one, other = (predict(Impact.whole_beam(2.0).replace(**flight), pulled.valid_until).times[0] for flight in flights)
    assert (one.reaction / other.reaction, pulled.limited_by) == (pytest.approx(0.98, rel=1e-9), validity.DAMPING)


def test_a_damped_zone_starts_as_one_point() -> None:
    # the wall takes the curvature κ/ν out of the point after η erf⁻¹(κ/ν)²; until then nothing tells it from a point
    impact, age = Impact.whole_beam(0.5, relative_damping=1e-3), float(erfinv(0.5)) ** 2
    found = predict(impact, [0.0, 0.99e-3 * age, 1.01e-3 * age])
    start, early, late = found.times
    assert (start.half_contact_length, start.impulse, start.reaction) == (0.0, 0.0, None)
    point, later = predict(POINT, [early.time, 3e-3]).times
    assert (early.half_contact_length, early.valid, late.valid) == (0.0, True, False)
    assert (early.reaction, early.impulse) == pytest.approx((point.reaction, point.impulse), rel=1e-12)
    assert early.peak_moment == pytest.approx(point.peak_moment, rel=1e-12)
    assert later.peak_moment == pytest.approx(math.erf(math.sqrt(3.0)), rel=1e-12)  # of strain
    assert (found.valid_until, found.limited_by) == (pytest.approx(1e-3 * age, rel=1e-12), validity.DAMPING)
    for kappa in (0.2, 0.5):  # it spreads once the bow is bent straight, and nothing ahead is bent further
        touch = predict(Impact.whole_beam(kappa, relative_damping=1e-3), 0.0)
        assert touch.peak_moment == pytest.approx(kappa, rel=1e-6)


def test_one_point_spreads_once_the_loads_have_taken_its_curvature() -> None:
    # gap's curvature κ − ν − (χ + α)τ; the reaction goes as 1 + 2ατ
    impact = Impact.dimensionless(1.02, epsilon_alpha=20.0, epsilon_chi=10.0, length=4.0)
    assert predict(impact).valid_until == pytest.approx(0.02 / 30.0, rel=1e-9)
    assert predict(impact).limited_by == validity.FIRST_ORDER
    assert predict(impact.replace(acceleration=-11.0)).limited_by == validity.ENDS
    assert predict(Impact.dimensionless(2.0, epsilon_alpha=-1e4, length=100.0)).valid_until == pytest.approx(5e-5)


@pytest.mark.parametrize("ratio", [1e-7, 0.3, 0.999, 2.0])
@pytest.mark.parametrize("loads", [(1, 0, 0, 0), (-3, 1, 2, 0), (0, 0, -1, 1), (1, 1, 1, -2)])
def test_ten_times_the_load_ends_validity_ten_times_earlier(ratio: float, loads: tuple[float, ...]) -> None:
    def until(size: float) -> float:
        sizes = {f"epsilon_{name}": size * load for name, load in zip(("alpha", "psi", "chi", "axial"), loads)}
        return predict(Impact.dimensionless(ratio, **sizes, length=1e12)).valid_until

    assert until(1e6) == pytest.approx(10.0 * until(1e7), rel=1e-6)
    assert until(1e6) < until(0.0)


@pytest.mark.parametrize(("name", "power"), [("alpha", 0), ("chi", 1), ("psi", 2), ("axial", -1)])
def test_the_flatter_a_contact_the_earlier_a_load_that_bends_ends_validity_and_the_later_tension(name, power):
    """In proportion to κ^power, also where formulas of a contact of κ/ν = 0.003 stand for those of a flatter one."""
    one, other = (predict(Impact.dimensionless(kappa, **{f"epsilon_{name}": 1e6}, length=1e12)).valid_until
                  for kappa in (3.1e-3, 3e-4))  # fmt: skip
    assert one / other == pytest.approx((3.1e-3 / 3e-4) ** power, rel=0.01)


def test_bending_moment_and_stress() -> None:
    # κ/ν = 0.31: m = 0.712 ahead of the zone; a third of the bow is a set of stress beforehand
    plain = predict(PIPE, [0.0, 0.1])
    unit = PIPE.velocity * math.sqrt(PIPE.bending_stiffness * PIPE.mass_per_length)
    moments = peak_moment(plain.kappa_over_nu)
    assert plain.peak_moment == pytest.approx(unit * moments.ahead, rel=1e-13)
    assert plain.times[1].peak_moment == plain.peak_moment and plain.peak_stress is None
    root = math.sqrt(math.sqrt(PIPE.bending_stiffness / PIPE.mass_per_length) * 0.1)
    assert plain.times[1].peak_moment_place == pytest.approx(moments.place * root, rel=1e-13)
    # bent to K from straight: the wall bends it back in the zone, further ahead of it
    bent = predict(PIPE.replace(natural_curvature=0.0))
    assert bent.peak_moment == pytest.approx(unit * moments.ahead + 4.0e6 / 600.0, rel=1e-13)
    pulled = predict(PIPE.replace(axial_force=1e5), section=steel(4e8))
    assert pulled.peak_stress == pytest.approx(pulled.peak_moment / 9.2e-5 + 1e5 / 3.4e-3, rel=1e-13)
    assert pulled.yields is False


def test_tension_and_a_curved_wall_act_through_the_groups() -> None:
    # a straight beam on a bulging wall is the bent beam on a flat one
    straight = predict(PIPE.replace(curvature=0.0, wall_curvature=-PIPE.curvature), [0.1]).times[0]
    assert straight.half_contact_length == pytest.approx(predict(PIPE, [0.1]).times[0].half_contact_length, rel=1e-14)
    held = predict(PIPE.replace(axial_force=1e5), [0.05])  # by the load p = NK, which the zone bears
    assert held.times[0].contact_force_per_length == pytest.approx(1e5 * PIPE.curvature, rel=1e-13)
    n_tau = 1e5 * 0.05 / math.sqrt(PIPE.bending_stiffness * PIPE.mass_per_length)
    flight = predict(PIPE.replace(axial_force=1e5, acceleration=-1e5 * PIPE.curvature / 29.0), [0.05])
    lengths = [found.times[0].half_contact_length for found in (flight, predict(PIPE, [0.05]))]
    assert lengths[0] / lengths[1] - 1.0 == pytest.approx(flight.lambda_axial * n_tau / flight.lambda0, rel=1e-10)


OF_ENDS = [(0.05, 0.0, 1.0), (0.2, 0.01, 2.0), (0.2, 1e-4, 1.0), (0.5, 0.0, 1.0), (0.9, 0.0, 1.0), (2.0, 0.0, 1.0)]


@pytest.mark.parametrize(("kappa", "quartic", "times"), OF_ENDS)
def test_the_theory_ends_ten_lengths_of_bending_before_the_beam_does_twice_as_many_under_q0(kappa, quartic, times):
    """For a flat bow it ends earlier: when the zone covers a third of the beam, half of what is left."""
    impact = Impact.dimensionless(kappa, length=10.0).replace(fourth_derivative=quartic)
    found = predict(impact, [1e-3])
    spread = math.sqrt(found.valid_until / impact.slow_time_scale)  # √(ct)/ℓ
    zone = float(contact_parameters(kappa).lambda0) * spread
    assert 1.0 - zone == pytest.approx(max(10.0 * times * spread, 2.0 * zone), rel=1e-9) and "ends" in found.limited_by
