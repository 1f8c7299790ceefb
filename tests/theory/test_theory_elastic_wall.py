"""Walls and stops that give way: limits, a modal solution, and how the rigid wall's law comes back."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.fft import dct, idct

from benchmarks.wall import settled
from bent_beam import Impact
from theory import contact_parameters, elastic_wall, predict, wall_prediction
from theory.elastic_stop import SwungBeam
from theory.elastic_wall import _loads, flat_limit, largest, peak_force, sharp_limit, wall_history


def largest_force_by_modes(kappa_over_nu, damping_ratio, end, half, dx, damping=0.0):
    """Cosine modes of a long beam, each turned exactly in time between kicks by springs at the points of a grid; with
    a damping of its own (t_k) it loses some speed after each turn."""
    dt = 0.1 * dx
    x = dx * (np.arange(round(half / dx)) + 0.5)
    omega = (np.pi * np.arange(x.size) / half) ** 2
    place, rate, largest = np.zeros(x.size), np.zeros(x.size), 0.0
    cosine, sine = np.cos(omega * dt), np.sin(omega * dt)
    over = np.where(omega > 0.0, sine / np.where(omega > 0.0, omega, 1.0), dt)
    decay = np.exp(-damping * omega**2 * dt)
    for k in range(1, round(end / dt) + 1):
        place, rate = cosine * place + over * rate, decay * (cosine * rate - omega * sine * place)
        p = k * dt - kappa_over_nu * x**2 / 2.0 - idct(place, norm="ortho")
        pressure = np.where(p > 0.0, p + 2.0 * damping_ratio * (1.0 - idct(rate, norm="ortho")), 0.0)
        pressure = np.maximum(pressure, 0.0) / (1.0 + damping_ratio * dt)  # half a kick on
        rate = rate + dt * dct(pressure, norm="ortho")
        largest = max(largest, 2.0 * dx * float(pressure.sum()))
    return largest


@pytest.mark.parametrize(("ratio", "damping", "dx", "agree"), [(0.5, 0.0, 0.04, 3e-4), (2.0, 0.25, 0.01, 4e-3)])
def test_largest_force_is_that_of_the_beams_modes(ratio, damping, dx, agree):
    found = peak_force(ratio, damping)
    modes = largest_force_by_modes(ratio, damping, 1.1 * found.time, 15.0, dx)
    assert found.value == pytest.approx(modes, rel=agree)
    assert 1e-5 * found.value < found.error < 2e-4 * found.value  # some hundred steps are not right to six digits


@pytest.mark.parametrize("damping_ratio", [pytest.param(0.0, marks=pytest.mark.verify), 2.0])
def test_a_flat_beam_lands_as_oscillators(damping_ratio: float) -> None:
    found, (value, time) = peak_force(1e-4, damping_ratio), flat_limit(damping_ratio)
    assert found.value / 100.0 == pytest.approx(value, rel=3e-4)
    assert found.time == pytest.approx(time, rel=0.02)
    assert found.half_contact_length == pytest.approx(math.sqrt(2e4 * found.time), rel=5e-3)  # x lands at κx²/2ν
    assert damping_ratio == 0.0 or found.pressure == pytest.approx(2.0 * damping_ratio)  # V₀ on its dashpot


def test_a_sharp_bow_is_pushed_at_one_point() -> None:
    """f (κ/ν)^{1/8} with its correction of order ν/κ; what is left is of order (ν/κ)^{3/2}."""
    limit, found = sharp_limit(), peak_force(100.0)
    assert found.value * 100.0**0.125 - limit.value == pytest.approx(limit.correction / 100.0, abs=100.0**-1.5)
    assert found.penetration == pytest.approx(limit.penetration * 100.0**0.25, rel=0.01)
    assert found.time == pytest.approx(limit.time * 100.0**0.25, rel=0.01)
    assert found.pressure == pytest.approx(found.penetration, rel=1e-4)
    assert found.half_contact_length == pytest.approx(math.sqrt(found.penetration / 50.0), rel=0.01)  # κx²/2ν


def test_the_steps_of_the_sharp_limit_are_short_enough(monkeypatch: pytest.MonkeyPatch) -> None:
    limit = sharp_limit()
    monkeypatch.setattr(elastic_wall, "_STEPS", elastic_wall._STEPS // 2)
    assert vars(sharp_limit()) == pytest.approx(vars(limit), abs=2e-5)


@pytest.mark.parametrize("shear", [0.0, 0.7, 3.0])
def test_the_rim_is_as_far_ahead_of_the_force_as_on_a_beam_on_springs(shear) -> None:
    """EI w⁗ − (EI k/S) w″ + k w = 0 behind the rim, where w = 0: the force is Σ 1/r behind it, of a rigid wall l_s."""
    roots = np.roots([1.0, 0.0, -(shear**2), 0.0, 1.0])
    behind = float((1.0 / roots[roots.real > 0.0]).sum().real)
    assert wall_prediction.zone_offset(0.5, shear) == pytest.approx(behind - shear)
    wall = (1.2e6 / 2e8) ** 0.25
    pipe = Impact(1.2e6, 29.0, 90.0, 0.002, 0.5, wall_stiffness=2e8)
    pipe = pipe.replace(shear_stiffness=1.2e6 / (shear * wall) ** 2 if shear else None)
    soft, rigid = (predict(one, 0.02).times[0] for one in (pipe, pipe.replace(wall_stiffness=None)))
    assert soft.half_contact_length - rigid.half_contact_length == pytest.approx((behind - shear) * wall)
    assert (soft.reaction, soft.impulse) == (rigid.reaction, rigid.impulse)
    assert predict(Impact.whole_beam(0.5).replace(wall_stiffness=1e4), 0.95).times[0].half_contact_length == 1.0


def test_the_largest_force_is_given_up_where_loads_change_a_rigid_wall_s_by_2_percent() -> None:
    beam = Impact(1.0, 1.0, 400.0, 0.005, 0.01, wall_stiffness=1.0)
    at = predict(beam).wall.peak_force_time
    for load in (1e-6, -1e-6):
        one, other = (predict(beam.replace(wall_stiffness=None, acceleration=a), at).times[0] for a in (load, 0.0))
        enough = load * 0.02 / abs(one.reaction / other.reaction - 1.0)  # linear in small loads
        said = [predict(beam.replace(acceleration=share * enough)).wall.spoiled_by for share in (0.9, 1.1)]
        assert said == [None, "first-order correction"]


@pytest.mark.parametrize(("ratio", "damping", "end"), [(1.0, 0.0, 60.0), (20.0, 0.0, 120.0), (0.7, 0.25, 100.0)])
def test_a_wall_counts_as_rigid_once_impulse_and_force_are_within_2_percent(ratio, damping, end) -> None:
    """And not much later: not after twice the time of one point, whose force comes back last at κ/ν = 1."""
    found = settled(ratio, damping, end, cells=30, steps=400)
    claimed = wall_prediction._rigid_from(ratio, damping, contact_parameters(ratio).lambda0)
    assert found["impulse"] < found["force"] < claimed
    if ratio >= 1.0:
        assert claimed < 1.2 * found["force"]


def test_the_place_of_the_force_reaches_the_rigid_wall_s_later_than_force_and_impulse() -> None:
    """At one multiple of the wall's length, read off a longer zone; as κ/ν → 1 this takes ever longer."""
    found, short = settled(0.8, 0.25, 300.0, cells=40, steps=500), contact_parameters(0.95)
    claimed = short.lambda0 * math.sqrt(wall_prediction._rigid_from(0.95, 0.25, short.lambda0))
    assert found["place"] < claimed < 1.2 * found["place"]


@pytest.mark.verify
def test_a_zone_that_bounces_counts_as_rigid_late() -> None:
    assert 0.9 * wall_prediction.ZONE_TIME < settled(0.35, 0.25, 300.0)["force"] < wall_prediction.ZONE_TIME


def test_the_beam_s_own_damping_spoils_the_largest_force_from_2_percent_on() -> None:
    beam, end = Impact(1.0, 1.0, 1e3, 5e-3, 1e-3, wall_stiffness=0.25), 1.2 * peak_force(5.0).time
    undamped, little, more = (largest_force_by_modes(5.0, 0.0, end, 12.0, 0.04, eta) for eta in (0.0, 0.17, 0.2))
    assert little < 1.02 * undamped < more
    spoiled = [predict(beam.replace(damping=2.0 * eta)).wall.spoiled_by for eta in (0.17, 0.2)]  # t_k = 2
    assert spoiled == [None, "damping"]


def test_prediction_in_si_units() -> None:
    pipe = Impact(1.2e6, 29.0, 90.0, 0.002, 2.0, wall_stiffness=2e8, wall_damping=3e4)
    found, f = predict(pipe), peak_force(pipe.kappa_over_nu, 3e4 / (2.0 * math.sqrt(2e8 * 29.0)))
    wall, t_k = found.wall, math.sqrt(29.0 / 2e8)
    assert found.peak_force == pytest.approx(2.0 * math.sqrt(29.0) * (1.2e6 * 2e8) ** 0.25 * f.value, rel=1e-12)
    times = (t_k * f.time, 2.0 * t_k * f.penetration)  # V₀ = 2
    assert (wall.peak_force_time, wall.penetration) == pytest.approx(times, rel=1e-12)
    assert wall.pressure == pytest.approx(2.0 * math.sqrt(2e8 * 29.0) * f.pressure, rel=1e-12)
    assert (found.limited_by, wall.spoiled_by) == ("wall", None)  # so flat a zone remembers how it landed
    assert predict(pipe.replace(length=4.0)).wall.spoiled_by == "waves back from the ends"
    rigid = predict(pipe.replace(wall_stiffness=None, wall_damping=0.0))
    assert (rigid.peak_force, rigid.wall) == (None, None) and rigid.valid_until > 0.0


def test_a_damped_wall_gives_longest_after_its_force_and_a_beam_may_have_ended_by_then() -> None:
    """κ/ν = 3, ζ = 4.5: the force is largest at .15 t_k, the penetration at 8 t_k; waves are back at some .01 T*."""
    found, whole = peak_force(3.0, 4.5), wall_history(3.0, 4.5, end=12.0, cells=30, steps=120)
    deepest = whole.time[whole.penetration.argmax()]
    assert found.time < 0.2 < 7.0 < deepest < 10.0 and found.penetration_time == pytest.approx(deepest, rel=0.05)
    assert found.penetration == pytest.approx(whole.penetration.max(), rel=1e-2)
    for share, known in ((0.01, False), (0.001, True)):  # t_k over T*
        beam = Impact.whole_beam(3.0).replace(wall_stiffness=share**-2.0, wall_damping=9.0 / share)
        wall = predict(beam).wall
        assert wall.spoiled_by is None and (wall.penetration is not None) == known


def test_a_section_that_would_yield_on_a_rigid_wall_does_not_on_one_that_never_acts_as_one() -> None:
    beam = Impact(1.2e6, 29.0, 90.0, 0.002, 20.0)
    section = SimpleNamespace(area=3.4e-3, section_modulus=9.2e-5, yield_stress=1e8)
    rigid, soft = (predict(beam.replace(wall_stiffness=k), section=section) for k in (None, 2e6))
    assert (rigid.limited_by, soft.limited_by) == ("section", "wall") and rigid.valid_until == soft.valid_until == 0.0
    hard = predict(beam.replace(curvature=0.2, wall_stiffness=1e12), section=section)
    assert hard.limited_by == "section"  # it acts as a rigid one before waves are back


@pytest.mark.parametrize(("kappa_over_nu", "times"), [(0.5, 3.0), (2.0, 10.0)])
def test_shear_spoils_the_largest_force_of_a_wall_that_is_fast_beside_it(kappa_over_nu: float, times: float) -> None:
    """t_k = 1; measured beside a Timoshenko beam by benchmarks.shear."""
    beam = Impact(1.0, 1.0, 1e3, 1e-3 * kappa_over_nu, 1e-3, wall_stiffness=1.0)
    beams = (beam.replace(shear_stiffness=share * times) for share in (0.99, 1.01))
    assert [predict(one).wall.spoiled_by for one in beams] == ["shear", None]


PUBLISHED = {  # displacements of the tip at 1, 2, … 12 ms, mm, by the stop's stiffness in N/m
    18e3: [2.66, 4.33, 4.92, 4.78, 3.82, 2.87, 2.71, 3.09, 3.41, 3.36, 2.64, 0.742],
    45e3: [2.25, 2.66, 1.96, 1.15, 0.124, 0.364, 2.01, 2.74, 1.89, 0.352, -1.70, -4.99],
}


@pytest.mark.parametrize("stiffness", PUBLISHED)
def test_both_stops_of_code_aster_s_test_are_where_they_are_published(stiffness):
    """SDNL32, file astest/sdnl32a.comm, with E = 67 GPa; its modes have 1 % of damping, the exact record has none."""
    rod = SwungBeam(6.7e10 * 0.014**4 / 12.0, 2400.0 * 0.014**2, 0.783, 3.8, stiffness)
    time, exact = rod.tip(0.012)
    undamped = 1e3 * np.interp(1e-3 * np.arange(1, 13), time, exact)
    assert np.sqrt(np.mean((undamped - PUBLISHED[stiffness]) ** 2)) < 0.08
    force, when = rod.peak_force(0.012)
    assert exact.max() < force / stiffness < (1.0 + 1e-6) * exact.max()
    assert abs(when - time[exact.argmax()]) <= 0.5 * time[1]


def test_a_pressure_that_begins_or_ends_between_two_points_acts_from_there_on():
    """A triangle of height 1 on half an element, on both sides: its resultant is a third of it from its foot."""
    for pressure, rim, place in ((np.array([-1.0, 1.0]), 0.1, 5 / 6), (np.array([1.0, -1.0]), 0.05, 1 / 6)):
        loads, force, found = _loads(pressure, pressure, 0.1)
        assert (force, found) == pytest.approx((2.0 * 0.1 * 0.25, rim))
        assert (loads[0], 2.0 * loads[1]) == pytest.approx((force * (1.0 - place), force * place))
    assert _loads(-np.ones(2), -np.ones(2), 0.1)[1:] == (0.0, 0.0)


def test_the_largest_value_is_the_top_of_the_parabola_through_its_neighbours() -> None:
    time = np.linspace(0.0, 1.0, 11)
    assert largest(time, 2.0 - (time - 0.37) ** 2) == pytest.approx((0.37, 2.0), rel=1e-12)
