"""Contact points without mass: nothing impacts, nothing is lost, and what no impact takes throws the zone off."""

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.contacts import AlternateContact, NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import MasslessBoundary, SignoriniPosition
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System

QUIET, ELEMENT = GridViscosity(viscosity=0.0), 0.04
IMPACT = Impact.dimensionless(0.5, length=8.0)
SCHEME = MasslessBoundary(time_step=2.5e-4, growth=0.0)


def run(impact=IMPACT, **parts):
    parts = {"integrator": SCHEME, "contact": AlternateContact(), "far_field": QUIET} | parts
    return HermiteFE(mesh=UniformMesh(ELEMENT), **parts).simulate(impact, end_time=0.1, save=200)


@pytest.mark.parametrize("step", [0.02, 0.01])
def test_a_mass_behind_a_spring_without_mass_bounces_in_half_a_sine(step):
    """J = mV(1 − cos ωt) while it touches, for π/ω, and off at the speed it came with: second order in the step."""
    chain = System(mass=[[0.5, 1.5]], stiffness=[[9.0, 9.0], [-9.0, 0.0]], contacts=ContactRows([[0]], [[1.0]], [0.3]))
    omega, J = np.sqrt(9.0 / 2.0), []
    for h in (step, step / 2.0):
        found = integrate(chain, np.zeros(2), -np.ones(2), MasslessBoundary(h, growth=0.0), 2.5, save=251)
        touching = np.clip(found.time - 0.3, 0.0, np.pi / omega)
        J.append(np.abs(found.impulse[:, 0] - 2.0 * (1.0 - np.cos(omega * touching))).max())
        assert found.v[-1] == pytest.approx([1.0, 1.0], abs=step**2 * 5.0)
    assert J[0] < 3.0 * step**2 and J[1] < J[0] / 3.0


def test_contact_points_stay_off_the_wall_are_never_pulled_and_take_the_momentum_of_the_masses():
    history = run()
    assert history.array("smallest_gap").min() > -1e-12
    assert np.diff(history.array("impulse"), axis=0).min() >= 0.0 and history.array("held_impulse")[-1] == 0.0
    assert history.array("complementarity_product").max() < 1e-12
    moved = 2.0 * ELEMENT * (1.0 - history.array("velocity")[:, 1::2]).sum(axis=1)  # of the nodes that keep mass
    assert 2.0 * moved == pytest.approx(history.array("total_impulse"), abs=1e-10)


def test_energy_is_kept_but_for_what_points_that_come_and_go_leave():
    for acceleration in (0.0, 0.5):
        history = run(IMPACT.replace(acceleration=acceleration, axial_force=0.1))
        budget, total = history.energy_budget(), history.array("total_impulse")[-1]
        assert abs(budget["defect"]) < 1e-11 * budget["initial_energy"]
        assert abs(budget["loss_impact"]) < 0.01 * total and abs(budget["loss_algorithmic"]) < 2e-3 * total


def test_what_no_impact_takes_throws_the_zone_off_the_wall():
    """At κ/ν = 0.1, where no mesh resolves the first instants; a law that dissipates leaves the zone on it."""
    thin = IMPACT.replace(curvature=0.1)
    strict = run(thin, integrator=SignoriniPosition(time_step=2.5e-4, growth=0.0), contact=NodeContact())
    lifts = [one.array("gap")[-1, one.dataset.x.values < 1.0].max() / 0.1 for one in (run(thin), strict)]
    assert lifts[0] > 0.3 and lifts[1] < 0.2 * lifts[0]


def test_half_and_full_beam_agree():
    half, full = run(), run(full_beam=True)
    nodes = half.dataset.sizes["x"]
    assert np.abs(full.array("gap")[:, nodes - 1 :] - half.array("gap")).max() < 1e-9
    for name in ("total_impulse", "kinetic_energy", "strain_energy", "loss_impact", "loss_algorithmic"):
        assert full.array(name) == pytest.approx(half.array(name), abs=1e-9)
