"""The impact problem: its groups, scales and validation."""

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.checks import affordable
from bent_beam.errors import SimulationError
from bent_beam.fields import Quantity, declared
from bent_beam.loads import Load, Place, loads_of, unmodelled
from bent_beam.method import time_on_wall
from bent_beam.tables import TABLES

THESIS = dict(bending_stiffness=1.0, mass_per_length=1.0, length=50.0, curvature=10.0, velocity=20.0)


def test_groups_of_the_thesis_cases():
    impact = Impact(**THESIS)
    found = (impact.kappa_over_nu, impact.time_scale, impact.length_scale, impact.epsilon)
    assert found == pytest.approx((0.5, 1 / 400, 1 / 20, 4e-6))
    assert not any(getattr(impact, name) for name in loads_of(Impact))  # none that nobody stated
    curved = Impact(**THESIS | {"curvature": 12.0}, wall_curvature=2.0)  # it is bent less against such a wall
    assert (curved.relative_curvature, curved.kappa_over_nu) == pytest.approx((10.0, 0.5))
    impact = Impact(1.0, 1.0, 2.0, 0.35, 3.5, acceleration=700.0, curvature_rate=70.0, fourth_derivative=7.0)
    assert impact.epsilon_alpha == pytest.approx(700 / 3.5**3)  # 16.33 in docs/theory.md, section 1
    assert (impact.epsilon_chi, impact.epsilon_psi) == pytest.approx((70 / 3.5**3, 7 / 3.5**3))  # l* = 1/V₀, t* = 1/V₀²
    assert impact.alpha == pytest.approx(impact.epsilon_alpha / impact.epsilon)
    assert Impact(3.0, 2.0, 2.0, 0.35, 3.5, axial_force=49.0).group("axial_force") == pytest.approx(2.0)  # N/(μV₀²)
    damped = Impact(3.0, 4.0, 2.0, 0.35, 3.5, wall_stiffness=9.0, wall_damping=6.0)
    assert damped.wall_damping_ratio == pytest.approx(0.5) and impact.wall_damping_ratio == 0.0  # c/(2√(kμ))


def test_the_free_motion_is_that_of_the_thesis_and_so_are_its_derivatives():
    """2.2.30, and the rocking about a middle that is not where the bow touches first."""
    impact = Impact(2.0, 3.0, 8.0, 0.5, 1.5, 0.7, -0.3, 0.2, rotation=0.4, first_touch=0.6)
    y, x, t = impact.free_motion(impact.curvature), np.linspace(-1.0, 1.0, 5), 0.8
    exact = 1.5 * t - 0.25 * x**2 + 0.35 * t**2 - 0.15 * x**2 * t + 0.2 * x**4 / 24 + 0.4 * (x + 0.6) * t
    assert y(x, t) == pytest.approx(exact)
    assert y(x, t, by_x=1, by_t=1) == pytest.approx(-0.3 * x + 0.4)
    assert y(x, t, by_x=4) == pytest.approx(0.2) and y(x, t, by_t=2) == pytest.approx(0.7)
    assert y.scaled(2.0, 0.5, 3.0)(x / 2.0, t / 0.5) * 3.0 == pytest.approx(exact)
    assert impact.uniform_pressure == pytest.approx(3.0 * 0.7 + 2.0 * 0.2)


def test_every_load_is_in_case_files_and_what_a_path_does_not_know_is_refused_by_name():
    impact = Impact(**THESIS, curvature_rate=0.1)
    assert unmodelled(impact, ("acceleration", "curvature_rate")) is None
    assert "curvature_rate is not modelled" in unmodelled(impact, ("acceleration",))
    assert loads_of(Impact).keys() <= {name for table in TABLES.values() for name in declared(table)}


def test_a_first_touch_without_a_bow_whose_apex_it_is_is_refused():
    bow = Impact.whole_beam(0.5).replace(first_touch=0.1)
    assert bow.replace(curvature=0.0, fourth_derivative=0.1).first_touch == 0.1
    for touch, room in ((0.0, 0.5), (0.5, 1.125)):  # K s²/2 of the farthest end
        with pytest.raises(ValueError, match=f"opposite_wall must leave room for the bow of {room} m"):
            Impact.whole_beam(1.0).replace(first_touch=touch, opposite_wall=0.99 * room)
        Impact.whole_beam(1.0).replace(first_touch=touch, opposite_wall=room)
    for kappa in (1.0, 0.25):  # K s²/2 − q₀s⁴/24 is highest at s² = 6K/q₀, on the beam
        back = Impact.whole_beam(kappa).replace(fourth_derivative=12.0 * kappa)
        assert back.replace(opposite_wall=kappa / 8.0).opposite_wall == kappa / 8.0
        with pytest.raises(ValueError, match=f"opposite_wall must leave room for the bow of {kappa / 8.0} m"):
            back.replace(opposite_wall=0.99 * kappa / 8.0)
    with pytest.raises(ValueError, match=r"^first_touch, the place of .* has no effect on a straight beam"):
        bow.replace(curvature=0.0)


def test_loads_that_cancel_press_with_nothing_at_all():
    impact = Impact(1.0, 1.0, 2.0, 0.5, 1.0, acceleration=0.1, fourth_derivative=0.2, axial_force=-0.6)
    assert math.fsum((0.1, 0.2, -0.3)) != 0.0  # in binary they do not
    assert impact.uniform_pressure == 0.0 and impact.zone_pressure == 0.0


@pytest.mark.parametrize("value", [0.0, -1.0, math.nan, math.inf, "1", None, True])
def test_numbers_that_are_none_or_of_the_wrong_sign_are_refused_by_name(value):
    for field in ("bending_stiffness", "mass_per_length", "length", "velocity", "section_height", "curvature"):
        if not (field == "curvature" and value == 0.0):
            with pytest.raises(ValueError, match=field):
                Impact(**{**THESIS, field: value})


def test_scales_beyond_floating_point_are_refused():
    refused = {"velocity must be at least 1e-60 .*1e-300": {"velocity": 1e-300}, "time_scale": {"velocity": 1e40}}
    refused |= {r"section_height must not exceed 1e\+60 .*1e\+61": {"section_height": 1e61}}  # in none of the scales
    for message, value in refused.items():
        with pytest.raises(ValueError, match=message):
            Impact(**THESIS | value)


def test_the_dimensionless_impact_has_the_groups_it_is_asked_for_and_no_others():
    groups = ("epsilon_alpha", "epsilon_psi", "epsilon_chi", "epsilon_axial")
    for asked in groups:
        impact = Impact.dimensionless(0.5, **{asked: 0.25})
        assert impact.kappa_over_nu == 0.5
        assert [getattr(impact, group) for group in groups] == [0.25 * (group == asked) for group in groups]


def test_what_is_asked_without_a_time_ends_before_waves_are_back():
    long, short = Impact(**THESIS), Impact(**THESIS | {"length": 1.0, "velocity": 0.1})
    assert long.checked_end_time() == 0.1 * long.time_scale
    assert short.checked_end_time() == 0.01 * short.slow_time_scale < 0.1 * short.time_scale


def test_what_a_run_keeps_is_instants_times_nodes_and_what_it_does_is_steps_times_nodes():
    affordable("mesh", 1e4, 1_000, 10_000, most=1e7)  # both at their bounds or below
    for steps, instants, message in ((1.1e4, 10_000, "mesh ask for"), (1e4, 60_001, "save asks for 60001 instants")):
        with pytest.raises(ValueError, match=message):
            affordable("mesh", steps, 1_000, instants, most=1e7)


def test_a_number_obeys_its_bounds_and_an_error_without_advice_says_none():
    with pytest.raises(ValueError, match=r"n must be more than 1 \(got 1.0\)"):
        Quantity("", "of somebody's", above=1.0).checked_number("n", 1.0, whole=False)
    count = Quantity("", "of somebody's", least=2, most=5)
    assert [count.checked_number("n", value, whole=True) for value in (2, 5)] == [2, 5]
    for value in (1, 6):
        with pytest.raises(ValueError, match=rf"n must .*got {value}"):
            count.checked_number("n", value, whole=True)
    assert "try" not in str(SimulationError("it diverged", time=1.0)) != str(SimulationError("it diverged"))


def test_a_wall_from_end_to_end_of_the_beam_is_the_whole_wall() -> None:
    beam = Impact.whole_beam(0.5)
    assert beam.replace(wall_from=-1.0, wall_to=1.0) == beam.replace(wall_to=1.0) == beam


def test_a_stop_s_dashpot_slows_at_once_a_beam_that_shears_and_has_no_damping_of_its_own() -> None:
    """F = c(V − F/2√(κ_sGAμ)): it sends off two shear waves, at an end one; any damping spreads the jump."""
    middle = Impact.whole_beam(0.5).replace(wall_stiffness=1e3, wall_damping=4.0, wall_from=0.0, wall_to=0.0)
    sheared = middle.replace(shear_stiffness=400.0)
    end = sheared.replace(wall_from=1.0, wall_to=1.0)
    forces = [4.0, 4.0 / (1.0 + 4.0 / 40.0), 4.0 / (1.0 + 4.0 / 20.0), 4.0, 4.0]
    kinds = (middle, sheared, end, sheared.replace(damping=1e-6), sheared.replace(wall_to=0.5))
    assert [impact.damping_at_landing for impact in kinds] == pytest.approx(forces)


def test_a_straight_bar_is_on_its_wall_for_half_a_period_and_a_bow_as_long_as_hertz_has_it() -> None:
    """m δ'' = −k∫(δ − Kx²/2)dx, which is (4/3)k√(2/K) δ^{3/2}: on the wall for 2∫dδ/δ' until δ' = 0."""
    bar = Impact(1.0, 3.0, 2.0, 0.0, 1.5).replace(wall_stiffness=8.0)
    assert time_on_wall(bar) == pytest.approx(math.pi * math.sqrt(6.0 / 16.0))
    bow = bar.replace(curvature=200.0)  # no longer than that where it lies on all of its wall
    x, depth, velocity, time, step = np.linspace(0.0, 1.0, 401), 0.0, 1.5, 0.0, 1e-3
    while depth >= 0.0:
        force = 8.0 * 2.0 * float(np.trapezoid(np.maximum(depth - 100.0 * x**2, 0.0), x))
        velocity -= step * force / 6.0
        depth, time = depth + step * velocity, time + step
    assert time_on_wall(bow) == pytest.approx(time, rel=2e-3)
    assert time_on_wall(bow.replace(wall_stiffness=None)) == 0.0


@dataclass(frozen=True)
class Turned(Impact):
    couple: Annotated[float, Load("N m", "a couple")] = 0.0
    push: Annotated[float, Load("N", "a force")] = 0.0
    at: Annotated[float, Place("m", "where the couple acts", load="couple")] = 0.0
    push_at: Annotated[float, Place("m", "where the force acts", load="push")] = 0.0


def test_a_load_at_a_place_is_a_force_if_it_is_in_newtons() -> None:
    assert Turned(1.0, 1.0, 2.0, 0.5, 1.0, couple=3.0, push=5.0, at=0.1, push_at=0.2).forces == [(0.2, 5.0)]
