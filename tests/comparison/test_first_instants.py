"""The first instants of a beam on both paths: what its contact, its start and its mesh must not add."""

import json
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.figures.moment import FOLDER, KAPPAS, PATHS, MeasuredMoment, measure_moment
from bent_beam import Impact, ImpactHistory, SimulationError
from bent_beam.measure.instant import instant
from bent_beam.measure.moments import first_front
from bent_beam.measure.reduction import peak_moment
from bent_beam.meshes import UniformMesh
from comparison.bouncing import case_of
from comparison.questions import Question
from comparison.simulating import simulate_case
from exudyn_models import ExudynModel
from exudyn_models.contacts import Penalty
from exudyn_models.elements import ANCFCable
from exudyn_models.geometry import LinearLimit
from exudyn_models.integrators import GeneralizedAlpha
from exudyn_models.solvers import NewtonSolver
from hermite_fe import HermiteFE
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import GeneralizedAlphaPenalty
from theory import peak_moment as largest_moment
from theory import predict


def simulated(end: float, kappa_over_nu: float, **beam: float) -> list[ImpactHistory]:
    """By Hermite elements and by Exudyn, at half the resolution, up to ``end``, T* of the beam of half length 1. Few
    saved instants move no front and no moment."""
    impact, methods = Impact.whole_beam(kappa_over_nu).replace(**beam), (HermiteFE(refine=0.5), ExudynModel(refine=0.5))
    return [method.simulate(impact, end_time=end, save=[0.1 * end, end]) for method in methods]


@pytest.mark.parametrize(("damping", "gaps", "impulse"), [(1e-3, 1e-6, 1e-9), (1e2, 0.11, 1e-3)])
def test_on_one_mesh_with_one_contact_law_both_codes_give_the_same_gaps_node_by_node(damping, gaps, impulse):
    """In the linear limit an ANCF cable is the Hermite element with consistent mass. Dashpots of Exudyn's path grip
    before the wall and let go before they would pull, those of the Hermite path act inside the wall alone: gaps differ
    by a tenth of V₀t at first, by a hundredth at the end, the impulse hardly."""
    impact, mesh, step, stiffness = Impact.dimensionless(0.5, length=10.0), UniformMesh(0.05), 2e-4, 1e4
    springs = {"stiffness": stiffness, "damping": damping}  # per unit length of beam
    scaled = {"relative_stiffness": stiffness * 0.05**4, "relative_damping": damping * 0.05**2}
    penalty = GeneralizedAlphaPenalty(step, spectral_radius=0.5, contact_rounds=20, **springs)
    hermite = HermiteFE(mesh=mesh, integrator=penalty, far_field=GridViscosity(viscosity=0.0))
    alpha = GeneralizedAlpha(spectral_radius=0.5, time_step=step)
    solver = NewtonSolver(contact_iterations=20, contact_tolerance=1e-10, initial_accelerations=False)
    linear = {"geometry": LinearLimit(amplitude=1e-5), "element": ANCFCable(viscosity=0.0), "solver": solver}
    exudyn = ExudynModel(mesh=mesh, integrator=alpha, contact=Penalty(hold_start=0.0, **scaled), **linear)
    ours, theirs = (m.simulate(impact, end_time=0.1, save=np.linspace(0.0, 0.1, 26)) for m in (hermite, exudyn))
    assert np.allclose(ours.time, theirs.time, rtol=1e-9)
    difference = np.abs(ours.array("gap") - theirs.array("gap"))[1:] / ours.time[1:, None]  # V₀ = 1
    assert ours.array("in_contact").any()
    assert float(difference.max()) < gaps and float(difference[-1].max()) < 0.1 * gaps
    assert ours.array("total_impulse")[-1] == pytest.approx(theirs.array("total_impulse")[-1], rel=impulse)


def numbers(impact: Impact, until: float, path: str = "hermite", **more: object) -> dict:
    """What ``simulate`` says of a time, with bars, on a mesh and by parts that are chosen unless given."""
    return simulate_case(replace(case_of(impact), **more), path, until=until).numbers


def test_moments_of_two_paths_stored_and_of_a_quick_run_are_within_half_a_percent_of_theory() -> None:
    points = [MeasuredMoment(**p) for p in json.loads((FOLDER / "peak-moment.json").read_text())["points"]]
    assert {p.kappa_over_nu for p in points} == set(KAPPAS)
    assert len({p.label for p in points}) == len(PATHS)
    for p in points:
        assert p.theory == pytest.approx(largest_moment(p.kappa_over_nu).largest)
        assert abs(p.value / p.theory - 1.0) < 0.005, p
    found = measure_moment(HermiteFE(refine=0.5), 0.5)
    assert abs(found.value / found.theory - 1.0) < 0.005 and found.error < 0.01 * found.theory


@pytest.mark.parametrize("change", [{}, {"rotation": 0.2, "first_touch": 0.05}], ids=["middle", "beside it"])
def test_before_a_curved_wall_the_slope_is_that_of_the_deflection_and_both_paths_find_the_same_moment(change) -> None:
    impact, moments = Impact.whole_beam(0.4, relative_damping=1e-2).replace(wall_curvature=0.1, **change), []
    for kind in (HermiteFE, ExudynModel):
        history = kind(mesh=UniformMesh(1 / 100)).simulate(impact, end_time=0.01, save=20)  # both halves if it rocks
        x, slope = history.positions(-1), history.array("slope", -1)
        deflection = -history.array("gap", -1) - 0.5 * impact.wall_curvature * (x - impact.first_touch) ** 2
        assert np.diff(deflection) / np.diff(x) == pytest.approx(0.5 * (slope[1:] + slope[:-1]), abs=5e-4)
        moments.append(peak_moment(history).moment)
    assert moments[0] == pytest.approx(moments[1], rel=0.05)


def test_both_paths_agree_on_moment_and_front_of_a_zone_that_damping_lifts():
    """Damping keeps the zone off the wall from the first instant on: all of the reaction is at the front."""
    hermite, exudyn = simulated(0.004, 0.29, damping=3e-3, acceleration=4.9)
    assert peak_moment(exudyn).moment == pytest.approx(peak_moment(hermite).moment, rel=0.01)
    fronts = [first_front(history, history.time[-1])[0] for history in (hermite, exudyn)]
    assert fronts[1] == pytest.approx(fronts[0], rel=0.01)


def test_a_pressed_zone_ends_where_theory_says_with_its_impulse() -> None:
    histories = simulated(0.0032, 0.1325, acceleration=5.25)
    theory = predict(histories[0].impact, [0.0032]).times[0]
    for history in histories:
        assert first_front(history, 0.0) == (0.0, 0.0)
        assert first_front(history, history.time[-1])[0] == pytest.approx(theory.half_contact_length, rel=2e-3)
        assert history.array("total_impulse")[-1] == pytest.approx(theory.impulse, rel=0.005)


def test_a_tension_along_x_bends_the_ends_of_a_bow() -> None:
    """N κ L/2 across the ends: the beam is modelled up to there. The largest moment is there, too."""
    hermite, exudyn = simulated(0.002, 2.1, damping=2.4e-3, axial_force=56.0)
    assert peak_moment(exudyn).moment == pytest.approx(peak_moment(hermite).moment, rel=0.03)
    assert abs(peak_moment(exudyn).place) > 0.8


def test_a_run_too_short_for_its_damping_stops() -> None:
    """To a ten-thousandth of η viscous round-off is as large as the forces: no answer, rather than 6 % less impulse."""
    with pytest.raises(SimulationError):
        ExudynModel().simulate(Impact.whole_beam(0.3, relative_damping=1e-3), end_time=1e-7, save=10)


def test_a_zone_that_its_scheme_throws_off_the_wall_is_pushed_too_hard_and_the_bar_says_so() -> None:
    """A companion that is thrown off alike does not show it. A damped beam lifts off by itself: no bar for that."""
    impact, end = Impact.whole_beam(0.06), 0.0025
    parts = {"mesh": UniformMesh(0.01), "tables": {"hermite": {"integrator": {"kind": "moreau_jean", "theta": 1.0}}}}
    bare, damped = (numbers(one, end, **parts)["impulse"] for one in (impact, impact.replace(damping=1e-3)))
    exact = predict(impact, [end]).times[0].impulse
    assert 0.01 * exact < abs(bare.known - exact) < bare.bar < 0.3 * exact
    assert bare.parts["lift"] > 0.0 == damped.parts["lift"]


@pytest.mark.parametrize(("kappa", "peak", "end"), [(0.6, 0.7577, 0.002), (0.43, 0.6524, 0.016)])
def test_the_largest_moment_so_far_holds_that_of_a_damped_start(kappa, peak, end) -> None:
    """Damping lifts the bow at first: its middle moment rises, at about η, to a value of κ/ν alone, and falls."""
    found = numbers(Impact.whole_beam(kappa, relative_damping=1.3e-4), end)["peak_moment"]
    assert abs(found.known - peak) <= found.spread or found.known > peak
    assert end > 0.01 or found.spread < 0.01 * peak


@pytest.mark.parametrize(("path", "load"), [("hermite", 0.2), ("hermite", -0.2), ("self_similar", -0.2)])
def test_a_zone_that_does_not_spread_as_the_root_of_time_is_as_long_as_by_another_code(path, load):
    """By another code's active set, converged; the pushes of a tenth of the time carried as √t are 3 % off."""
    half, error = (1.277, 0.006) if load > 0.0 else (0.760, 0.003)
    impact = Impact.dimensionless(0.5, length=40.0).replace(acceleration=load)
    found = numbers(impact, 1.0, path)["half_contact_length"]
    assert abs(found.known - half) <= found.spread + error and found.spread < 0.04 * half


def test_a_zone_within_few_elements_has_no_sure_length() -> None:
    """λ₀ = 0.00125 at κ/ν = 0.999, which no element of the first instants resolves."""
    impact = Impact.dimensionless(0.999)
    found, exact = numbers(impact, 0.1), predict(impact, [0.1])
    assert abs(found["lambda0"].known - exact.lambda0) <= found["lambda0"].spread < 0.02
    assert abs(found["half_contact_length"].known - exact.times[0].half_contact_length) <= found["lambda0"].spread


def test_a_beam_off_the_wall_has_no_contact() -> None:
    found = numbers(Impact.dimensionless(0.5, length=40.0).replace(acceleration=-0.6), 3.0)
    assert found["half_contact_length"].value is None and found["reaction"].known == 0.0


@pytest.mark.parametrize("time", [1e-3, 0.1])
def test_a_penalty_that_is_chosen_suits_the_run(time: float) -> None:
    """In units of t*: a front at 1e-3 t* is ten times thinner than at 0.1 t*."""
    tables = {"hermite": {"integrator": {"kind": "generalized_alpha_penalty"}, "refine": 0.5}}
    impact = Impact.dimensionless(0.5)
    found, exact = numbers(impact, time, tables=tables), predict(impact, [time]).times[0]
    assert found["impulse"].known == pytest.approx(exact.impulse, rel=0.01)
    assert found["half_contact_length"].known == pytest.approx(exact.half_contact_length, rel=0.02)


def test_a_run_that_is_read_at_a_time_goes_a_tenth_of_it_beyond_and_a_shorter_one_has_no_reaction_then() -> None:
    impact, method = Impact.whole_beam(2.0, relative_damping=0.02), HermiteFE(mesh=UniformMesh(0.1))
    question = Question(impact, method, until=0.05)
    run = question.run(question.run_by)
    assert run.time[-1] == pytest.approx(0.055) and np.isclose(run.time, 0.05).any()
    known = instant(run, 0.05).reaction
    gained = run.impulse_at(np.array([0.045, 0.055]))
    assert known == pytest.approx((gained[1] - gained[0]) / 0.01) and known > 0.0
    assert instant(run.until(0.05), 0.05).reaction is None
