"""The whole impact by Exudyn: waves back from the ends, the last separation; its steps, penalty and solver."""

import dataclasses
import math
import time

import numpy as np
import pytest
from markdown_tables import lines_after, stated

from bent_beam import Impact, ImpactHistory
from bent_beam.free_flight import acting, is_over
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from exudyn_models.contacts import Penalty, SegmentFriction, penalty
from exudyn_models.elements import GeometricallyExact
from exudyn_models.integrators import GeneralizedAlpha, Trapezoidal
from exudyn_models.resolution import chosen_steps
from exudyn_models.solvers import USUAL, NewtonSolver

PAGE = [  # κ/ν, η/T*, this path's number and the Hermite path's of the finest mesh
    (float(kappa), stated(damping)[0], stated(ours)[0], stated(theirs.split()[-1])[0])
    for kappa, damping, ours, _, theirs in lines_after("docs/exudyn.md", "## The whole impact")[2:]
]
COARSE = ExudynModel(mesh=UniformMesh(1 / 20))


def restitution(history):
    return history.array("total_impulse")[-1] / 2.0 - 1.0


def closes(history, tolerance=1e-6):
    """The budget closes, and energy falls from instant to instant but for what the contact's springs hold."""
    budget = history.energy_budget()
    energy = sum(history.array(name) for name in ("kinetic_energy", "strain_energy", "contact_energy"))
    energy = energy - history.array("work_of_loads")
    assert abs(budget["defect"]) < tolerance * budget["initial_energy"]
    assert np.diff(energy).max() < tolerance * energy[0]
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


def test_another_element_is_damped_no_more_than_the_cable():
    """Named without its viscosity, it brought that of long beams with it."""
    method = ExudynModel(element=GeometricallyExact()).for_whole_beam(Impact.whole_beam(0.7, relative_damping=3e-3))
    assert method.element.viscosity == 0.0


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
