"""The impact as an Exudyn system for plain ``SolveDynamic``."""

import dataclasses
import gc
import weakref

import exudyn.itemInterface as items
import numpy as np
import pytest
from exudyn.utilities import LoadSolutionFile
from twins import in_units

import exudyn_models
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import method_from_tables
from exudyn_models import ExudynModel
from exudyn_models.contacts import Penalty, SegmentFriction
from exudyn_models.elements import GeometricallyExact
from exudyn_models.geometry import TrueGeometry
from exudyn_models.integrators import GeneralizedAlpha, Newmark
from theory import contact_parameters

STEEL = Impact(bending_stiffness=2.1e3, mass_per_length=1.6, length=3.0, curvature=0.02, velocity=2.0)
SHORT = Impact.dimensionless(0.5, length=8.0)
MESH, COARSE = UniformMesh(0.1), UniformMesh(0.15)


def solved(impact, **parts):
    """The system after Exudyn's own solver, and what its sensors stored, without the times' column."""
    model = exudyn_models.build(impact, **parts)
    model.mbs.SolveDynamic(model.settings)
    return model, {name: model.mbs.GetSensorStoredData(number)[:, 1:] for name, number in model.sensors.items()}


def impulse_of_theory(kappa_over_nu, time=0.1):
    return 4.0 * np.sqrt(2.0 * time / np.pi) * float(contact_parameters(kappa_over_nu).r0)


def test_a_second_wall_pushes_the_other_way():
    """The force that the sensor reads is what changes the momentum: behind the beam a wall takes from it."""
    between = Impact.whole_beam(0.5, relative_damping=1e-2).replace(opposite_wall=0.3)
    _, read = solved(between, mesh=UniformMesh(0.05), end_time=0.65)
    force, impulse = read["force"][:, 0], read["impulse"][:, 0]
    late = int(np.argmax(impulse)) + 1
    assert impulse[-1] < 0.9 * impulse.max() and force[:late].min() > -0.01 * force.max()
    assert force[late:].max() < 0.01 * force.max() and force[late:].min() < -0.05 * force.max()


def test_the_true_arc_is_not_stretched_by_its_first_velocities():
    bent = STEEL.replace(curvature=0.3, curvature_rate=0.5, section_height=0.01)
    model = exudyn_models.build(bent, mesh=MESH, geometry=TrueGeometry())
    stiffness = model.mbs.GetObject(model.bodies[0])["axialStiffness"]
    assert stiffness == pytest.approx(12.0 * 2.1e3 / 0.01**2)  # I = Ad²/12
    nodes = [model.mbs.GetNode(node) for node in model.nodes]
    x = np.array([node["referenceCoordinates"][:2] + node["initialCoordinates"][:2] for node in nodes])
    along, apart = np.diff(x, axis=0), np.diff([node["initialVelocities"][:2] for node in nodes], axis=0)
    sizes = np.linalg.norm(along, axis=1) * np.linalg.norm(apart, axis=1)
    assert np.abs((along * apart).sum(axis=1) / sizes).max() < 0.01
    at_first = "initialCoordinates", "initialVelocities"
    tangent, turning = (np.array([node[name][2:] for node in nodes]) for name in at_first)
    tangent[:, 0] += 1.0
    assert np.abs((tangent * turning).sum(axis=1)).max() < 1e-12 < np.abs(turning[:, 0]).max()


def test_items_are_in_si_units_and_sensors_agree_with_one_another():
    """Momentum is lost to the force."""
    model, read = solved(STEEL, mesh=UniformMesh(0.015), save=1500)
    pulled, stretched = STEEL.replace(axial_force=50.0), GeometricallyExact(axial_stiffness=4e6)  # N
    pulled = exudyn_models.build(pulled, mesh=UniformMesh(0.015), element=stretched)
    assert pulled.mbs.GetObject(pulled.bodies[0])["axialStiffness"] == pytest.approx(4e6)
    contact = model.mbs.GetObject(model.contacts[1])
    assert contact["contactStiffness"] == pytest.approx(10.0 * 2.1e3 / 0.015**3)  # C EI/Δx⁴ over Δx of beam
    given = exudyn_models.build(STEEL, mesh=UniformMesh(0.015), contact=Penalty(stiffness=2e9, damping=3e4))
    law = given.mbs.GetObject(given.contacts[1])  # N/m² and N s/m² of the wall, over Δx
    assert (law["contactStiffness"], law["contactDamping"]) == pytest.approx((2e9 * 0.015, 3e4 * 0.015))
    rubbing = exudyn_models.build(STEEL, mesh=UniformMesh(0.015), contact=SegmentFriction(friction=0.2))
    law, dashpot = rubbing.mbs.GetObject(rubbing.contacts[0]), (2.1e3 * 1.6) ** 0.5 / 0.015
    assert law["contactStiffness"] == pytest.approx(10.0 * 2.1e3 / 0.015**3)
    assert (law["contactDamping"], law["frictionVelocityPenalty"]) == pytest.approx((10.0 * dashpot, dashpot))
    assert law["circleRadius"] * rubbing.scale == pytest.approx(1.0 / 0.02)  # the bow's own, as it is scaled
    end = model.settings.timeIntegration.endTime
    times = np.linspace(0.0, end, read["force"].size)
    assert np.trapezoid(read["force"][:, 0], times) == pytest.approx(read["impulse"][-1, 0], rel=0.05)
    exact = impulse_of_theory(STEEL.kappa_over_nu, end / STEEL.time_scale)
    unit = STEEL.mass_per_length * STEEL.velocity * STEEL.length_scale
    assert read["impulse"][-1, 0] == pytest.approx(unit * exact, rel=5e-3)


def test_one_setting_is_swapped_without_its_kind_and_the_rest_stays_chosen():
    table = {"integrator": {"spectral_radius": 0.9}, "contact": {"stiffness": 3e4, "damping": 20.0}}
    made = method_from_tables("exudyn", table)
    assert made.integrator == GeneralizedAlpha(spectral_radius=0.9)
    assert made.contact == Penalty(stiffness=3e4, damping=20.0)
    assert method_from_tables("exudyn", {"integrator": {"gamma": 0.7}}).integrator == Newmark(gamma=0.7)
    impact = Impact.whole_beam(0.05)  # a thin front
    for end in (1e-3, 0.1):  # steps that grow, and steps that are constant
        chosen, open_ones = (method.chosen(impact, end).integrator for method in (made, ExudynModel()))
        assert chosen == dataclasses.replace(open_ones, spectral_radius=0.9)


def test_a_zone_of_exact_elements_is_solved_in_any_unit_and_no_force_acts_at_the_first_touch():
    """Of 1 µg on 1 mm: what Newton leaves of a force must be small beside these."""
    small = in_units(Impact.dimensionless(0.5), {"kg": 1e-9, "m": 1e-3, "s": 1.0})
    _, read = solved(small, element=GeometricallyExact())
    assert read["impulse"][-1, 0] == pytest.approx(1e-12 * impulse_of_theory(0.5), rel=1e-5, abs=0.0)
    assert read["force"][0, 0] == 0.0


def test_sensors_and_solution_file_are_those_of_the_beam_where_a_user_adds_a_mass_on_a_spring(tmp_path):
    model = exudyn_models.build(SHORT, mesh=COARSE, save=10, file=str(tmp_path / "solution.txt"))
    mass = model.mbs.AddNode(items.NodePoint2D())
    model.mbs.AddObject(items.MassPoint2D(mass=1e-3, nodeNumber=mass))
    ends = [(model.nodes[0], 1), (mass, 1)]
    marks = [model.mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=n, coordinate=k)) for n, k in ends]
    model.mbs.AddObject(items.ObjectConnectorCoordinateSpringDamper(markerNumbers=marks, stiffness=1e-3))
    model.mbs.Assemble()
    model.mbs.SolveDynamic(model.settings)
    impulse = model.mbs.GetSensorStoredData(model.sensors["impulse"])[-1, 1]
    assert impulse == pytest.approx(impulse_of_theory(0.5), rel=0.02)
    assert LoadSolutionFile(str(tmp_path / "solution.txt"))["nRows"] == 11


def test_nothing_holds_the_system_of_a_run_that_is_over():
    """Exudyn's system holds the functions that it calls, and these hold it."""
    kept = []
    note = {"until": lambda run, *_: kept.append(weakref.ref(run.contact))}
    exudyn_models.simulate(SHORT, mesh=COARSE, save=2, **note)
    gc.collect()
    assert kept and all(one() is None for one in kept)
