"""``simulate``: the thesis's numbers with nothing set by hand, and what a user may get wrong."""

import math
from functools import cache, partial

import numpy as np
import pytest

from bent_beam import Impact, SimulationError
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.instant import instant
from bent_beam.measure.moments import moments
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE, simulate
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Midpoint, MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.resolution import chosen_domain
from hermite_fe.warnings_of_run import end_warnings

SHORT = Impact.dimensionless(0.5, length=40.0)


@pytest.mark.parametrize(
    ("curvature", "lambda0", "r0", "within"),  # κ/ν = 0.5, 0.1; one point, that bears ν
    [(20.0, 1.01886591389, 1.17721208090, 5e-4), (4.0, 4.25760478009, 2.74499113477, 1e-3), (50.0, 0.0, 1.0, 1e-3)],
)
def test_auto_finds_the_leading_order_of_a_case_in_si_units(curvature, lambda0, r0, within):
    history = simulate(Impact(2.0, 8.0, 50.0, curvature, 20.0))  # t* = 1.25 ms, l* = 25 mm
    assert history.warnings == [] and history.completed
    found = leading_order(moments(history))
    assert found.r0.value == pytest.approx(r0, rel=within)
    assert found.lambda0.value == pytest.approx(lambda0, rel=within)
    assert history.time[-1] == pytest.approx(1.25e-4)
    inside = history.dataset.x.values < 0.9 * lambda0 * math.sqrt(0.1) * 0.025
    assert np.abs(history.array("gap")[-1][inside]).max(initial=0.0) < 2e-3 * 20.0 * 1.25e-4
    assert (history.array("in_contact").sum(axis=1).max() == 1) == (lambda0 == 0.0)


@pytest.mark.parametrize("shear", [None, 400.0])
def test_moments_are_those_of_the_shape_also_of_a_bow_that_is_not_free_of_stress(shear) -> None:
    """A straight beam, bent to its bow: EI K before it strikes, and what the impact adds has a sign."""
    impact = Impact.whole_beam(2.0).replace(natural_curvature=0.0, shear_stiffness=shear)
    parts = {"mesh": UniformMesh(1 / 20), "integrator": MoreauJean(0.01 / 8, 0.0)}
    history = simulate(impact, end_time=0.01, save=np.linspace(0.0, 0.01, 9)[1:], **parts)
    ends, _ = history.bending_moments(slice(None))
    assert -ends[0] == pytest.approx(impact.curvature) and history.steps == 8
    within = 1e-9 if shear is None else 0.03  # nodes have the means of both elements there, steps the larger one
    assert history.moment[1:] == pytest.approx(np.abs(ends[1:]).max(axis=(1, 2)), rel=within)
    assert history.moment[-1] > 1.1 * impact.curvature


def test_the_largest_moments_are_those_of_all_steps_between_saved_instants() -> None:
    parts = {"mesh": UniformMesh(0.05), "integrator": MoreauJean(1e-3)}
    beam = Impact.whole_beam(0.3, relative_damping=0.01)
    few, every = (simulate(beam, end_time=0.4, save=np.linspace(0.0, 0.4, k + 1), **parts) for k in (8, 400))
    middle = np.abs(every.bending_moments(slice(1, None))[0][:, 0, 0])
    assert every.array("largest_midspan_moment")[1:] == pytest.approx(middle, rel=1e-9)
    for name in ("largest_moment", "largest_midspan_moment"):
        most = every.array(name)[1:].reshape(8, 50).max(axis=1)
        assert few.array(name)[1:] == pytest.approx(most, rel=1e-12) and np.any(np.diff(most) < 0.0)
        whole = simulate(beam, end_time=0.4, save=few.time, full_beam=True, **parts)
        assert whole.array(name)[1:] == pytest.approx(most, rel=1e-6)


def test_a_free_motion_that_meets_the_wall_elsewhere_is_said_of_ends_that_follow_it() -> None:
    """q₀ > 0 bends the far ends into the wall: V₀t − Kx²/2 + q₀x⁴/24 = 0 again at x² = 12K/q₀."""
    impact, nodes = Impact.dimensionless(0.5, length=60.0).replace(fourth_derivative=0.02), np.linspace(0.0, 30.0, 601)

    def said(impact: Impact, end: str) -> list[str]:
        return [w for w in end_warnings(impact, 0.1, nodes, GridViscosity(end=end)) if "meets the wall away" in w]

    (found,) = said(impact, "following")
    assert f"x = {math.ceil(math.sqrt(12.0 * 0.5 / 0.02) / 0.05) * 0.05:.3g} m" in found
    nodes = nodes[nodes < 17.4]  # where it is 0.8 m inside the wall
    assert said(impact, "following") == [found]
    assert said(impact, "free") == said(impact.replace(fourth_derivative=-0.02), "following") == []


def test_without_contact_the_free_motion_is_reproduced() -> None:
    impact = Impact.dimensionless(3.0, epsilon_alpha=0.4, epsilon_psi=0.3, epsilon_chi=-0.2, length=4.0)
    impact = impact.replace(velocity=1e-3, acceleration=-0.4)  # leaves before it touches anything
    parts = {"far_field": GridViscosity(end="following"), "integrator": NonsmoothGeneralizedAlpha(time_step=1e-2)}
    history = simulate(impact, end_time=0.4, mesh=UniformMesh(0.1), contact=NodeContact(), **parts)
    t, x = history.time[:, None], history.dataset.x.values[None, 1:]
    exact = impact.velocity * t - 0.5 * impact.curvature * x**2 + impact.fourth_derivative * x**4 / 24.0
    exact += 0.5 * impact.acceleration * t**2 + 0.5 * impact.curvature_rate * x**2 * t
    slope = x * (impact.curvature_rate * t - impact.curvature) + impact.fourth_derivative * x**3 / 6.0
    assert np.abs(history.array("slope")[:, 1:] - slope).max() < 2e-3
    assert np.abs(history.array("gap")[:, 1:] + exact).max() < 2e-4  # the middle node's first touch is all there is


def test_a_straight_beam_lands_all_at_once_on_parts_that_are_chosen() -> None:
    """κ = 0: no front, the wall takes the momentum μLV₀ of a beam without bounce."""
    history = simulate(Impact(1.0, 1.0, 2.0, 0.0, 1.0), end_time=0.01, refine=0.5)
    assert np.all(history.array("gap")[0] == 0.0)
    assert history.array("total_impulse")[-1] == pytest.approx(2.0, rel=1e-3)
    assert not any("front" in warning for warning in history.warnings)


def test_a_run_of_minutes_says_once_how_many_are_left(monkeypatch, caplog) -> None:
    for name in ("SOON", "LONG"):
        monkeypatch.setattr(f"hermite_fe.run.{name}", 0.0)
    simulate(Impact.whole_beam(2.0, relative_damping=0.1), end_time=0.1, mesh=UniformMesh(0.1), save=8)
    (said,) = caplog.record_tuples
    assert said[0] == "bent_beam" and "about" in said[2] and "minutes more" in said[2]


def test_a_run_that_fails_keeps_its_partial_history() -> None:
    class Breaking(MoreauJean):
        def advance(self, problem, state, memory, times, first, last):
            status, reached = super().advance(problem, state, memory, times, first, last)
            if times[reached] > 0.03:
                state.q[3] = np.nan
            return status, reached

    with pytest.raises(SimulationError, match="not finite") as caught:
        simulate(SHORT, end_time=0.05, integrator=Breaking(time_step=1e-3), save=20)
    partial = caught.value.history
    assert partial is not None and not partial.completed
    assert 0.0 < partial.time[-1] <= 0.03 < caught.value.time
    assert caught.value.step > 0


def test_the_part_of_a_long_beam_that_is_modelled_grows_as_bending_spreads() -> None:
    early, late = (chosen_domain(SHORT.replace(length=1e4), time) for time in (0.01, 0.09))
    assert early is not None and late == pytest.approx(3.0 * early) and 10.0 < early / 0.1 < 50.0
    bent_up = Impact.dimensionless(0.3, length=1e4, epsilon_psi=0.5)  # meets the wall again where y₀ = 0
    cut = chosen_domain(bent_up, 0.1)
    assert cut is not None
    assert (bent_up.free_motion(0.3)(np.array([0.7, 1.2, 1.26]) * cut, 0.0) > 0.0).tolist() == [False, False, True]


early = cache(partial(HermiteFE().simulate, end_time=0.1, save=20))  # others share the one at the middle
OTHERS = {"first_touch": 3.0}, {"rotation": 1e-4}, {"opposite_wall": 1000.0}, {"wall_from": -20.0, "wall_to": 25.0}


@pytest.mark.parametrize("kappa_over_nu", [0.4, *(pytest.param(k, marks=pytest.mark.verify) for k in (0.1, 1.5))])
@pytest.mark.parametrize("other", OTHERS, ids=str)
def test_an_early_impact_of_another_kind_has_the_impulse_of_one_at_the_middle(kappa_over_nu, other) -> None:
    """Before waves are back from its ends a beam does not know where its middle is, nor what else is there."""
    middle = Impact.dimensionless(kappa_over_nu, length=60.0)
    one, two = early(middle), early(middle.replace(**other))
    assert two.array("total_impulse")[-1] == pytest.approx(one.array("total_impulse")[-1], rel=4e-3)
    assert two.warnings == []
    lengths = [instant(history, 0.09).half_contact_length for history in (one, two)]
    assert lengths[1] == pytest.approx(lengths[0], rel=0.03, abs=0.02)


def test_an_early_impact_beside_the_middle_is_refused_where_even_elements_would_be_too_many() -> None:
    beside = Impact.dimensionless(0.4, length=60.0).replace(first_touch=3.0)
    with pytest.raises(ValueError, match=r"^end_time: before .* s the contact is shorter than even elements resolve"):
        HermiteFE().simulate(beside, end_time=1e-6)
    given = HermiteFE(mesh=UniformMesh(0.1)).simulate(beside, end_time=1e-6)  # a mesh that is given is taken
    assert given.array("total_impulse")[-1] >= 0.0
    with pytest.raises(ValueError, match=r"^domain cuts .* leave it out here \(got 10\.0\)"):
        HermiteFE(domain=10.0).simulate(beside, end_time=0.1)


SHEAR = {"shear_stiffness": 1e4, "rotary_inertia": 1e-5}


@pytest.mark.parametrize(
    ("kappa", "damping", "more", "elements", "step", "scheme"),
    [
        (0.5, 1e-3, {}, 200, 0.5 / 200**2, SignoriniPosition),
        (0.36, 3.1e-4, SHEAR, 100, 1.0 / 80.0 / 100, MoreauJean),
        (0.5, 2.9e-4, SHEAR, 200, 1.0 / 80.0 / 200, MoreauJean),  # little damping
        (0.34, 1e-3, SHEAR, 200, 1.0 / 80.0 / 200, MoreauJean),  # a thin front
        (2.0, 1e-3, SHEAR | {"acceleration": 0.4}, 100, 1.0 / 80.0 / 100, SignoriniPosition),  # one point
        (2.0, 1e-3, SHEAR | {"acceleration": 0.6}, 100, 1.0 / 80.0 / 100, MoreauJean),  # pressed on
        (0.5, 1e-3, {"wall_stiffness": 1e2}, 200, 0.01 / 1e1, Midpoint),
        (0.5, 1e-3, {"wall_stiffness": 1e8}, 400, 0.01 / 1e4, Midpoint),  # ¼ (EI/k)^¼ long
        (0.5, 1e-3, {"wall_stiffness": 1e14}, 2000, 0.01 / 1e7, Midpoint),
    ],
)
def test_whole_beams_have_elements_and_steps_that_resolve_what_they_bear(kappa, damping, more, elements, step, scheme):
    impact = Impact.whole_beam(kappa, relative_damping=damping).replace(**more)
    method = HermiteFE().for_whole_beam(impact)
    assert method.mesh.nodes(impact.half_length).size == elements + 1
    assert type(method.integrator) is scheme and method.integrator.time_step == pytest.approx(step)
    assert getattr(method.integrator, "theta", 0.5) == 0.5 and method.far_field.viscosity == 0.0
