"""Walls that give way, held ends, plates and stops, by Exudyn: closed forms, the theory, the Hermite path."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from bent_beam import Impact
from bent_beam.free_flight import has_left
from bent_beam.measure.balance import balance_of
from bent_beam.measure.reduction import wall_peaks
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel, simulate
from hermite_fe import HermiteFE

verify = pytest.mark.verify
HINGED = {"left_end": "hinged", "right_end": "hinged"}


def test_the_function_follows_a_supported_beam_as_a_whole_impact() -> None:
    impact = Impact(1.0, 1.0, 2.0, 0.0, 1.0, left_end="hinged", wall_stiffness=300.0, wall_from=1.0, wall_to=1.0)
    history = simulate(impact, end_time=1e-3, save=1)
    assert history.settings["element"]["viscosity"] == 0.0 and history.settings["integrator"]["kind"] == "Trapezoidal"
    lengths = np.diff(history.positions(0))
    assert lengths.size >= 200 and lengths == pytest.approx(lengths[0])


def test_a_rigid_stop_and_a_plate_hold_their_part_of_the_beam_and_let_the_rest_pass() -> None:
    stop = Impact(1.0, 1.0, 2.0, 0.0, 1.0, damping=1e-2, wall_from=0.0, wall_to=0.0, **HINGED)
    plate = Impact(1.0, 1.0, 2.0, 0.3, 1.0, damping=1e-2, wall_from=-0.3, wall_to=0.2)
    for impact, where in ((stop, [0.0, 0.0]), (plate, [-0.3, 0.2])):
        runs = [kind(refine=0.35).simulate(impact, end_time=0.15, save=40) for kind in (ExudynModel, HermiteFE)]
        for name in ("total_impulse", "largest_moment"):
            ours, theirs = (run.array(name).max() for run in runs)
            assert ours == pytest.approx(theirs, rel=0.01), name
        for run, depth in zip(runs, (1e-3, 1e-12)):
            places, gap, budget = run.contact_positions(0), run.array("gap"), run.energy_budget()
            assert_allclose(places[[0, -1]], where, atol=1e-12)
            assert gap[:, np.searchsorted(run.positions(0), places - 1e-9)].min() > -depth and gap[-1].min() < -0.02
            assert abs(budget["defect"]) < 1e-6 * budget["initial_energy"]
    assert max(balance_of(run).momentum for run in runs) < 0.01


def test_a_clamped_beam_meets_a_plate_at_its_tip_with_all_points_that_stand_before_it() -> None:
    """The tip moves at 2.95 V₀, where y₀ does not take it, in a run that ends before waves return."""
    beam = Impact(1.0, 1.0, 2.0, 0.052, 1.0, wall_from=0.6, wall_to=1.0, left_end="clamped")
    touched = ExudynModel(refine=0.25).simulate(beam, end_time=0.01, save=10)
    assert touched.contact_positions(0)[-1] == 1.0 and touched.array("gap")[:, -1].min() > -1e-6
    missed = ExudynModel(refine=0.25).simulate(beam.replace(curvature=0.8), end_time=0.008, save=10)
    assert not missed.array("total_impulse").any() and not missed.array("impulse").any()


@pytest.mark.parametrize("velocity", [1e-3, 1e-6])
def test_a_load_bends_a_hinged_beam_to_its_rest_however_slowly_it_came(velocity: float) -> None:
    """5pL⁴/(384 EI), away from the wall: what the load makes of the velocity is no instability."""
    impact = Impact.whole_beam(1.0).replace(curvature=0.0, damping=0.3, acceleration=-1.0, velocity=velocity, **HINGED)
    history = ExudynModel(mesh=UniformMesh(0.1)).simulate(impact, end_time=12.0, save=5)
    assert history.array("gap", -1).max() == pytest.approx(5.0 * 16.0 / 384.0, rel=2e-5)


WITHIN = {"peak_force": 5e-4, "peak_force_time": 8e-3, "peak_penetration": 5e-4, "peak_pressure": 1e-3,
          "total_impulse": 2e-4, "loss_wall": 5e-3, "contact_energy": 5e-3}  # fmt: skip


@pytest.mark.parametrize(("seed", "refine"), [(44, 0.7), *(pytest.param(n, 1.0, marks=verify) for n in (45, 46))])
def test_both_paths_agree_on_every_number_of_a_damped_wall(seed: int, refine: float) -> None:
    """The pressure is that of spring and dashpot. A penalty of the elements' own would grow with 1/Δx, and dashpots of
    whole elements would push 2.6 % more."""
    draw = np.random.default_rng(seed)
    drawn = kappa_over_nu, ratio = float(draw.uniform(0.1, 2.0)), float(draw.uniform(0.1, 1.0))
    impact = Impact.dimensionless(kappa_over_nu).replace(wall_stiffness=1e4, wall_damping=200.0 * ratio)
    runs = [kind(refine=refine).simulate(impact, end_time=0.04, save=40) for kind in (ExudynModel, HermiteFE)]
    for name, within in WITHIN.items():
        ours, theirs = (run.array(name)[-1] for run in runs)
        assert ours == pytest.approx(theirs, rel=within), (name, drawn)


SHEARS = {"shear_stiffness": 400.0, "rotary_inertia": 5e-4}  # √(κ_sGA μ) = 20


@pytest.mark.parametrize(("path", "within"), [(HermiteFE, 1e-8), (ExudynModel, 2e-4)])  # of the mode, by nodes
@pytest.mark.parametrize(
    ("about", "force"),
    [
        ({"wall_from": 0.0, "wall_to": 0.0}, 40.0),  # c V₀ of a stop
        ({"wall_from": -0.05, "wall_to": 0.05}, 4.0),  # c b V₀ of a plate
        ({"wall_from": 0.0, "wall_to": 0.0, "damping": 1e-4} | SHEARS, 40.0),
        (HINGED, 160.0 / math.pi),  # c∫φV₀ of the mode, the hinges at rest
    ],
)
def test_a_dashpot_is_pushed_hardest_before_the_beam_has_slowed_down(path, within, about, force) -> None:
    """V₀ is 3. Steps see less: the force falls at once, with shear within η."""
    impact = Impact(1.0, 1.0, 2.0, 0.0, 3.0, wall_stiffness=1.0, wall_damping=40.0, **about)
    history = path(mesh=UniformMesh(1.0 / 40)).simulate(impact, end_time=0.02, save=40)
    assert history.array("peak_force")[-1] == pytest.approx(3.0 * force, rel=within)
    assert history.array("peak_pressure")[-1] == pytest.approx(120.0, rel=1e-9)
    assert history.array("peak_force_time")[-1] < 1e-3 and wall_peaks(history).sharp > 0.0


@pytest.mark.parametrize("path", [HermiteFE, ExudynModel])
def test_a_bowed_beam_lands_on_a_plate_bit_by_bit_however_long_the_step(path) -> None:
    """38.71 by steps that resolve it, of Hermite elements; 40 is c b V₀."""
    bowed = Impact(1.0, 1.0, 2.0, 0.1, 1.0, wall_stiffness=1e3, wall_damping=400.0, damping=1e-3)
    bowed = bowed.replace(wall_from=-0.05, wall_to=0.05)
    history = path(mesh=UniformMesh(1.0 / 40)).simulate(bowed, end_time=0.05, save=20)
    assert history.array("peak_force")[-1] < 38.8


def test_a_beam_that_leaves_a_soft_wall_under_a_load_has_its_restitution() -> None:
    """What a contact that changes by little pushes on would end the run before its time; Hermite has the number."""
    found = []
    for method in (ExudynModel(mesh=UniformMesh(1.0 / 20)), HermiteFE(mesh=UniformMesh(1.0 / 20))):
        impact = Impact.whole_beam(0.5, relative_damping=1e-2).replace(wall_stiffness=20.0, acceleration=0.3)
        run = method.simulate_to_separation(impact)
        assert has_left(run) and balance_of(run).warnings == []
        found.append(whole_impact(run))
    assert found[0].restitution == pytest.approx(found[1].restitution, abs=2e-3)
    assert found[0].last_contact == pytest.approx(found[1].last_contact, abs=5e-3)


@verify
def test_the_edge_of_a_damped_plate_lets_go_when_spring_and_dashpot_do() -> None:
    """Literal values of an explicit code with 600 nodes: the last contact 12.567 s, 10.151 % dissipated."""
    impact = Impact(
        7.7737719754314165, 0.024782017163759006, 30.0, 0.16655347140413423, 4.916431704077783,
        damping=0.23258460796437663, shear_stiffness=3.4550097668584074, rotary_inertia=0.011151907723691554,
        wall_stiffness=0.07654609727540396, wall_damping=0.1 * math.sqrt(0.07654609727540396 * 0.024782017163759006),
        wall_from=4.5, wall_to=5.25,
    )  # fmt: skip
    found = whole_impact(ExudynModel().simulate_to_separation(impact))
    assert found.last_contact * impact.slow_time_scale == pytest.approx(12.567, abs=0.01)
    assert found.dissipated == pytest.approx(0.10151, abs=1.5e-4)
