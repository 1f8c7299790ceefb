"""The whole impact by Exudyn: waves back from the ends, the last separation; steps, penalty and solver. Timoshenko's
beam by an explicit code, the Hermite path and Exudyn's own output, in units half length = EI = μ = V₀ = 1."""

import dataclasses
import math
import time

import exudyn as exu
import leapfrog
import numpy as np
import pytest
from markdown_tables import lines_after, stated

import exudyn_models
from benchmarks.figures.shear import over_theory, stopped_run
from bent_beam import Impact, ImpactHistory
from bent_beam.free_flight import acting, is_over
from bent_beam.measure.balance import balance_of
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.meshes import UniformMesh
from comparison.bouncing import bounce
from exudyn_models import ExudynModel
from exudyn_models.assembly import assemble, lay_out
from exudyn_models.contacts import Penalty, SegmentFriction, penalty
from exudyn_models.elements import ANCFCable, GeometricallyExact
from exudyn_models.integrators import GeneralizedAlpha, Trapezoidal
from exudyn_models.resolution import chosen_steps, resolving_step
from exudyn_models.solvers import USUAL, NewtonSolver
from hermite_fe import HermiteFE

PAGE = [  # κ/ν, η/T*, this path's number and the Hermite path's of the finest mesh
    (float(kappa), stated(damping)[0], stated(ours)[0], stated(theirs.split()[-1])[0])
    for kappa, damping, ours, _, theirs in lines_after("docs/exudyn.md", "## The whole impact")[2:]
]
COARSE = ExudynModel(mesh=UniformMesh(1 / 20))
G = 0.2  # κ_sG/E
SHEARED = Impact.whole_beam(0.5, relative_damping=3e-3, shear_length=0.05, shear_ratio=G)
SEED = 46


def restitution(history):
    return history.array("total_impulse")[-1] / 2.0 - 1.0


def closes(history, tolerance=1e-6):
    """The budget closes, and energy falls from instant to instant but for what the contact's springs hold."""
    found = whole_impact(history)
    assert max(found.energy_defect, found.energy_gain) < tolerance
    assert history.array("held_impulse")[-1] == 0.0


def test_a_bounce_ends_when_the_beam_cannot_come_back_and_keeps_its_energy_account():
    """What is left of geometry is the square of the slopes: at amplitude 1e-3 of V₀T it was 8e-6 of the energy."""
    began = time.perf_counter()
    history = COARSE.simulate_to_separation(Impact.whole_beam(2.0, relative_damping=1e-2))
    assert 0.0 < history.seconds < time.perf_counter() - began  # what Exudyn took of it
    assert restitution(history) == pytest.approx(0.5663, abs=2e-3)
    assert history.array("gap")[-1].min() > 0.0
    assert is_over(history) and not is_over(ImpactHistory.of(history.dataset.isel(time=slice(None, -2))))
    assert history.energy_budget()["loss_viscous"] == 0.0 and history.energy_budget()["loss_material"] > 0.4
    closes(history, 1e-7)
    scale = history.settings["amplitude"] / history.settings["amplitude_of_the_real_beam"]
    assert np.abs(history.array("slope")).max() * scale < 3e-4


def test_steps_that_resolve_a_wave_on_an_element_are_taken_unless_they_would_be_too_many() -> None:
    """½Δx²√(μ/EI): 800 to a T* on 20 elements of a half beam; on 2000, half a T* would take four million."""
    beam, open_steps = Impact.whole_beam(2.0), GeneralizedAlpha()
    few = chosen_steps(open_steps, 1.0, UniformMesh(1 / 20), beam, 0.5)
    assert few.time_step == pytest.approx(1 / 800) and few.relative_step is None
    many = chosen_steps(open_steps, 1.0, UniformMesh(1 / 2000), beam, 0.5)
    assert many.time_step is None and many.relative_step == open_steps.default_step
    # elements of a longer run are so much longer that it takes no longer: so many times steps, 4e5
    parts = [(end, ExudynModel().chosen(beam, end)) for end in (0.02, 0.2)]
    work = [(one.mesh.nodes(1.0).size - 1) * end / one.integrator.time_step for end, one in parts]
    assert work == pytest.approx([4e5, 4e5], rel=0.03)


@pytest.mark.parametrize("unit", [1.0, 7.0])
def test_a_thin_front_passes_two_elements_in_the_last_step(unit) -> None:
    """It spreads as √(2V₀t/K) where bending does not hold it back, and a step h of it is ½h/t long."""
    thin = Impact(1.0, 1.0, 40.0 * unit, 0.005 / unit, 1.0 / unit)  # lengths in ``unit`` of l*
    chosen = chosen_steps(GeneralizedAlpha(), 1.0, UniformMesh(0.002 * unit), thin, 0.1 * unit**2)
    front = math.sqrt(2.0 * 0.1 / 0.005) * unit
    assert 0.5 * chosen.relative_step * front == pytest.approx(2.0 * 0.002 * unit, rel=1e-3)


@pytest.mark.verify
@pytest.mark.parametrize(("kappa_over_nu", "damping", "ours", "theirs"), PAGE)
def test_restitution_is_that_of_the_hermite_path_and_of_the_page(kappa_over_nu, damping, ours, theirs):
    history = ExudynModel().simulate_to_separation(Impact.whole_beam(kappa_over_nu, relative_damping=damping))
    within = 3e-4 if damping == 1e-2 else 1e-3
    if (kappa_over_nu, damping) == (0.8, 1e-3):
        within = 4e-3  # Hermite's 0.5876 to 0.5932: nothing has converged there
    assert restitution(history) == pytest.approx(theirs, abs=within)
    # hits that follow one another amplify round-off, which differs from processor to processor
    assert restitution(history) == pytest.approx(ours, abs=1e-4)
    closes(history)


@pytest.mark.verify
def test_another_element_bounces_as_the_cable_does():
    """With the cable's tolerance Newton's method stalled in its first step."""
    impact, kinds = Impact.whole_beam(0.7, relative_damping=3e-3), (None, GeometricallyExact())
    cable, other = (ExudynModel(element=kind).simulate_to_separation(impact) for kind in kinds)
    assert other.energy_budget()["loss_viscous"] == 0.0
    assert restitution(other) == pytest.approx(restitution(cable), abs=2e-3)
    closes(other, 1e-5)


def test_a_stopped_beam_gathers_its_exact_impulse_until_the_first_release():
    """Modes of the clamped–free half beam with Kelvin–Voigt damping η = 1e-3 (9 digits): t_s, J(t_s)."""
    release, impulse = 0.080315740, 0.912963645
    impact = Impact.whole_beam(2.0, relative_damping=1e-3)
    method = ExudynModel().for_whole_beam(impact)
    step = method.integrator.time_step
    count = round(1.03 * release / step)
    times = step * np.arange(round(0.97 * release / step), count + 1)
    history = method.simulate(impact, end_time=count * step, save=times)
    gathered, time = history.array("total_impulse")[1:], history.time[1:]
    assert np.interp(release, time, gathered) == pytest.approx(impulse, abs=1e-3)
    let_go = time[int(np.argmin(acting(gathered)))]
    assert abs(let_go - release) <= 2.0 * step


def test_steps_grow_in_flight_and_keep_the_energy_and_the_impulse():
    """The trapezoidal rule with states that fulfil equilibrium keeps a free beam's energy whatever its step."""
    impact, step = Impact.whole_beam(2.0, relative_damping=1e-2), 1e-3
    alike, grown = (
        ExudynModel(mesh=UniformMesh(1 / 20), integrator=Trapezoidal(time_step=step, flight_step=longest))
        .simulate_to_separation(impact, save=200)
        for longest in (None, 10.0 * step)
    )  # fmt: skip
    assert grown.steps < 0.7 * alike.steps
    assert restitution(grown) == pytest.approx(restitution(alike), abs=1e-5)
    assert abs(grown.array("loss_algorithmic")[-1]) < 1e-12 * grown.array("kinetic_energy")[0]
    closes(grown, 1e-7)


def test_steps_that_are_stated_are_refined_at_the_wall_and_in_flight():
    stated, fine = Trapezoidal(time_step=2.0, flight_step=4.0), Trapezoidal(time_step=1.0, flight_step=2.0)
    assert stated.refined(2.0) == fine
    beam, meant = Impact.whole_beam(2.0), ExudynModel(mesh=UniformMesh(0.05), integrator=fine)
    asked = ExudynModel(mesh=UniformMesh(0.1), integrator=stated, refine=2.0)
    for one, other in ((asked, meant), (asked.for_whole_beam(beam), meant.for_whole_beam(beam))):
        found, wanted = (method.chosen(beam, 10.0) for method in (one, other))
        assert (found.mesh, found.integrator) == (wanted.mesh, wanted.integrator)


def test_an_ensemble_has_penalties_from_a_quarter_of_the_usual_on_and_coarser_elements():
    impact, random = Impact.whole_beam(2.0), np.random.default_rng(3)
    drawn = [ExudynModel().varied(impact, random) for _ in range(20)]
    shares = [one.contact.relative_stiffness / penalty.STIFFNESS for one in drawn]
    assert 0.25 <= min(shares) < 0.5 < max(shares) <= 1.0
    usual = ExudynModel().for_whole_beam(impact).mesh.element_length
    assert all(usual < one.mesh.element_length < 3.0 * usual for one in drawn)
    steps = [one.integrator.time_step / resolving_step(one.mesh, impact) for one in drawn]
    assert 2.0**-0.5 <= min(steps) < 0.9 and 1.1 < max(steps) <= 2.0**0.5


@pytest.mark.parametrize("form", ["", "relative_"])
def test_the_penalty_that_stands_beside_for_error_bars_is_softer_as_its_steps_are_longer(form):
    """kh² and dh stay what they are."""
    law, softer = (Penalty(**{f"{form}stiffness": k, f"{form}damping": d}) for k, d in ((8.0, 2.0), (2.0, 1.0)))
    beam, method = Impact.whole_beam(0.5), ExudynModel(contact=law)
    (other,) = method.cross_checks(beam).values()
    assert other.integrator == method.for_whole_beam(beam).integrator.refined(0.5) and other.contact == softer


def test_where_a_zone_spreads_the_penalty_is_softer_as_the_steps_are_longer_for_an_element() -> None:
    point, zone = (ExudynModel().for_whole_beam(Impact.whole_beam(kappa)) for kappa in (2.0, 0.5))
    steps = [one.integrator.time_step / one.mesh.element_length**2 for one in (point, zone)]
    assert steps == pytest.approx([0.5, 2.0**0.5])
    assert zone.contact.relative_stiffness == pytest.approx(penalty.STIFFNESS * (steps[0] / steps[1]) ** 2)


def test_a_law_of_one_s_own_may_say_a_part_of_how_its_steps_are_solved() -> None:
    hurried = type("Hurried", (Penalty,), {"solver": NewtonSolver(contact_iterations=1)})()  # all else is open
    chosen = ExudynModel(contact=hurried).chosen(Impact.dimensionless(0.5), 0.1).solver
    assert chosen == dataclasses.replace(USUAL, contact_iterations=1)


def test_one_setting_of_the_solver_leaves_the_others_as_they_are_chosen() -> None:
    beam = Impact.whole_beam(2.0, relative_damping=1e-2)
    usual = USUAL.absolute_tolerance  # which beam and wall ask for otherwise
    for name, value in (("iterations", 50), ("relative_tolerance", 1e-4), ("absolute_tolerance", usual)):
        stated = NewtonSolver(**{name: value})
        for contact, impact in ((None, beam), (SegmentFriction(), beam), (None, beam.replace(wall_stiffness=1e4))):
            free, held = ExudynModel(contact=contact), ExudynModel(contact=contact, solver=stated)
            for method, other in ((free, held), (free.for_whole_beam(impact), held.for_whole_beam(impact))):
                chosen, found = (one.chosen(impact, 0.1).solver for one in (method, other))
                assert found == dataclasses.replace(chosen, **{name: value})


def test_the_whole_impact_is_that_of_an_explicit_code_and_so_is_that_of_plain_solve_dynamic() -> None:
    method = ExudynModel(mesh=UniformMesh(0.03))
    restitution, impulse, moment = leapfrog.whole_impact(0.5, 3e-3, 0.05, G, 50, 1.1)
    history = method.simulate_to_separation(SHEARED, save=500)
    found, balance = whole_impact(history), balance_of(history)
    assert (found.restitution, found.impulse) == pytest.approx((restitution, impulse), abs=5e-3)
    assert found.peak_moment == pytest.approx(moment, rel=0.04)  # without shear 1.40
    closes(history, 1e-8)
    assert balance.momentum < 1e-9 and balance.second_moment < 5e-3 and balance.warnings == []
    model = exudyn_models.build(SHEARED, end_time=1.1, mesh=UniformMesh(0.03))
    model.mbs.SolveDynamic(model.settings)
    gathered = model.mbs.GetSensorStoredData(model.sensors["impulse"])[-1, 1]
    assert gathered / 2.0 - 1.0 == pytest.approx(restitution, abs=5e-3)


def test_without_rotary_inertia_a_load_acts_from_the_first_step_on() -> None:
    """Of a stop that is not reached no impulse, and a₀t of the middle."""
    beam = Impact.whole_beam(0.4, shear_length=0.1, shear_ratio=0.0)
    beam = beam.replace(acceleration=20.0, wall_from=0.5, wall_to=0.5)
    history = ExudynModel(mesh=UniformMesh(0.05)).simulate(beam, end_time=0.01, save=5)
    middle = int(np.argmin(np.abs(history.positions(0))))
    assert history.array("velocity", -1)[middle] == pytest.approx(1.2, rel=1e-9)
    assert not history.array("total_impulse").any()


@pytest.mark.parametrize("impact", [SHEARED, SHEARED.unsheared], ids=lambda impact: impact.model)
def test_recorded_moments_are_those_that_exudyn_puts_out(impact: Impact) -> None:
    """At a state without velocities, in the middle of each element."""
    chosen = ExudynModel(mesh=UniformMesh(0.1)).chosen(impact, 0.1)
    assert isinstance(chosen.element, ANCFCable) == (impact is not SHEARED)
    beam, _ = assemble(lay_out(impact, 0.1, chosen), chosen)
    data, bent = beam.mbs.systemData, np.random.default_rng(SEED)
    q = data.GetODE2Coordinates(configuration=exu.ConfigurationType.Initial)
    q[beam.vertical] += 1e-6 * bent.standard_normal(beam.vertical.size)
    q[beam.rotation] += 1e-5 * bent.standard_normal(beam.vertical.size)
    data.SetODE2Coordinates(q)
    data.SetODE2Coordinates_t(np.zeros_like(q))
    kind = exu.OutputVariableType.TorqueLocal
    middles = np.zeros(beam.lengths.size) if beam.scaling.shear_length else beam.lengths / 2  # as Exudyn counts places
    torques = (beam.mbs.GetObjectOutputBody(body, kind, [at, 0.0, 0.0]) for body, at in zip(beam.bodies, middles))
    theirs = np.array([np.ravel(torque)[-1] for torque in torques])
    assert beam.bending_moments(q).mean(axis=-1) == pytest.approx(theirs, rel=1e-6, abs=1e-7 * np.abs(theirs).max())
    assert np.abs(theirs).max() > 1e-5


@pytest.mark.parametrize(("finest", "within"), [(0.06, 0.02), pytest.param(0.03, 0.01, marks=pytest.mark.verify)])
def test_a_stopped_point_converges_to_the_transform(finest: float, within: float) -> None:
    """The penalty is as soft as an element in shear: what the impulse lacks falls with the element. Bars are twice what
    half of the elements change; the coarse runs' moments cross the exact one. At 3 and 10 t_s."""
    runs = [stopped_run("exudyn", times * finest, 10.0) for times in (4, 2, 1)]
    impulse, moment = ([np.interp((3.0, 10.0), run.time, over_theory(run, name) - 1.0) for run in runs]
                       for name in ("impulse", "moment"))  # fmt: skip
    assert np.abs([impulse[2], moment[2]]).max() < within
    for _, middle, fine in (impulse, moment) if finest == 0.03 else (impulse,):
        assert (np.abs(fine) <= 2.0 * np.abs(fine - middle)).all()
    assert (np.abs(impulse[2]) < 0.5 * np.abs(impulse[1]))[0] and (np.abs(impulse[1]) < 0.5 * np.abs(impulse[0]))[0]


def drawn() -> list[tuple[float, float, float, float]]:
    """κ/ν, η/T*, l_s and g, stratified: each size once with each other where they go round."""
    random, cases = np.random.default_rng(SEED), []
    for k, kappa in enumerate((0.1, 0.2, 0.5, 1.0)):
        for j, damping in enumerate((7e-5, 7e-4, 3e-3)):
            length = (0.02, 0.08)[(k + j) % 2]
            spread = 2.0 ** random.uniform(-0.2, 0.2, 3)
            cases.append((kappa * spread[0], damping * spread[1], length * spread[2], random.uniform(0.2, 0.33)))
    return [*cases, (0.5, 3e-3, 0.002, G)]  # the last: no element resolves the shear length


@pytest.mark.verify
@pytest.mark.parametrize(("kappa", "damping", "length", "g"), drawn())
def test_drawn_beams_agree_with_the_hermite_path_and_the_explicit_code_within_bars(kappa, damping, length, g) -> None:
    impact = Impact.whole_beam(kappa, relative_damping=damping, shear_length=length, shear_ratio=g)
    exudyn, hermite = (bounce(impact, method) for method in (ExudynModel(), HermiteFE()))
    names = ("restitution", "impulse", "peak_moment")
    for name in names:
        ours, theirs = exudyn.numbers[name], hermite.numbers[name]
        assert abs(ours.value - theirs.value) <= ours.bar + theirs.bar, name
    if length > 0.01:
        fine, half = (leapfrog.whole_impact(kappa, damping, length, g, n, 1.3) for n in (200, 100))
        for name, explicit, coarser in zip(names, fine, half):
            ours = exudyn.numbers[name]
            assert abs(ours.value - explicit) <= ours.bar + 2.0 * abs(explicit - coarser), name
