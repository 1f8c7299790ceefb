"""What is refused, how failures end, and that nothing is printed."""

import math
import warnings

import numpy as np
import pytest

import exudyn_models
from bent_beam import Impact, InputError, SimulationError
from bent_beam.meshes import NodesMesh, UniformMesh
from bent_beam.method import method_from_tables
from exudyn_models import ExudynModel
from exudyn_models.contacts import Penalty, Rigid, SegmentFriction
from exudyn_models.elements import GeometricallyExact
from exudyn_models.geometry import TrueGeometry
from exudyn_models.integrators import RK44, GeneralizedAlpha, Trapezoidal, VelocityVerlet
from exudyn_models.solvers import NewtonSolver

HINGED = {"left_end": "hinged", "right_end": "hinged"}
SHORT = Impact.dimensionless(0.5, length=8.0)
MESH = UniformMesh(0.1)


@pytest.mark.parametrize("integrator", [RK44, VelocityVerlet])
def test_unstable_explicit_step_is_refused_with_the_stable_one(integrator):
    with pytest.raises(ValueError, match="stable step") as refusal:
        exudyn_models.simulate(SHORT, mesh=MESH, integrator=integrator(time_step=1e-2))
    stable = float(str(refusal.value).split("stable step ")[1].split()[0])
    history = exudyn_models.simulate(SHORT, mesh=MESH, integrator=integrator(time_step=0.99 * stable), save=5)
    assert np.isfinite(history.array("gap")).all()


@pytest.mark.parametrize(
    ("parts", "message"),
    [
        ({"contact": Rigid(), "integrator": GeneralizedAlpha()}, "newmark"),
        ({"contact": Rigid(), "integrator": Trapezoidal()}, "gamma above 0.5"),
        ({"contact": SegmentFriction(), "element": GeometricallyExact()}, "ancf_cable"),
        ({"contact": SegmentFriction(), "integrator": RK44()}, "implicit"),
        ({"save": 0}, "save"),
        ({"mesh": NodesMesh((0.0, 1.0, 2.0)), "end_time": 5.0}, r"mesh.places .* 4.0 .*got 2.0"),
        ({"mesh": NodesMesh((0.0, 1.0, 2.0)), "end_time": 5.0, "integrator": RK44()}, r"mesh.places .* 4.0 .*got 2.0"),
        ({"mesh": UniformMesh(1e-5)}, "200000 are the most"),
        ({"end_time": math.nan}, "end_time"),
        ({"impact": Impact.dimensionless(0.5, length=100.0), "geometry": TrueGeometry()}, "right angle"),
    ],
)
def test_parts_that_cannot_work_are_refused(parts, message):
    with pytest.raises(ValueError, match=message):
        exudyn_models.simulate(**({"impact": SHORT, "mesh": MESH} | parts))


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({"integrator": {"kind": "generalized_alpha", "spectral_radus": 0.5}}, "spectral_radius"),
        ({"integrator": {"kind": "newmark", "gamma": 1e300}}, "integrator.gamma"),
        ({"contact": {"kind": "penalty", "relative_stiffness": -1.0}}, "relative_stiffness must be positive"),
        ({"geometry": {"kind": "linear", "amplitude": 0.0}}, "amplitude"),
        ({"solver": {"kind": "newton", "halve_steps": 1}}, "halve_steps must be true or false"),
    ],
)
def test_case_file_tables_name_what_is_wrong(table, message):
    with pytest.raises(InputError, match=message):
        method_from_tables("exudyn", table)


@pytest.mark.parametrize(
    ("parts", "changes", "message"),
    [
        ({}, {"rotation": 0.1}, "full_beam"),
        ({"contact": Rigid()}, {"opposite_wall": 1.0}, "one wall"),
        ({"contact": SegmentFriction()}, {"opposite_wall": 1.0}, "one wall"),
        ({"contact": Penalty()}, {"wall_stiffness": 1e4}, "exudyn.contact has no effect"),
        ({}, {"wall_stiffness": 1e4, "opposite_wall": 1.0}, "opposite_wall"),
        ({"contact": Rigid()}, HINGED | {"wall_to": 0.1}, "must be penalty"),
        ({"geometry": TrueGeometry()}, HINGED, "free ends only"),
        ({}, HINGED | {"axial_force": 1.0}, "axial_force is not modelled together with ends"),
        ({}, HINGED | {"opposite_wall": 1.0}, "opposite_wall is not modelled together with ends"),
    ],
)
def test_what_a_part_cannot_model_is_refused(parts, changes, message):
    assert message in ExudynModel(**parts).refuses(Impact.whole_beam(0.5).replace(**changes))


@pytest.mark.parametrize(
    ("solver", "advice"),
    [
        (NewtonSolver(absolute_tolerance=1e-18, relative_tolerance=1e-18, iterations=1), "; try"),
        (NewtonSolver(contact_iterations=1), "settled.*contact_iterations"),
    ],
    ids=["Newton", "contact"],
)
def test_a_step_that_fails_carries_time_advice_and_partial_history(solver, advice, capfd):
    with pytest.raises(SimulationError, match=advice) as failure:
        exudyn_models.simulate(SHORT, mesh=MESH, solver=solver)
    error = failure.value
    assert error.time >= 0.0 and error.history is not None and not error.history.completed
    assert np.isfinite(error.history.array("gap")).all()
    assert not any(capfd.readouterr())


def test_divergence_ends_as_an_error_and_never_as_a_history(monkeypatch):
    monkeypatch.setattr(RK44, "limit", 40.0)  # a stability bound that lies
    with pytest.raises(SimulationError, match=r"finite|unstable"):
        exudyn_models.simulate(SHORT, mesh=MESH, integrator=RK44(safety=1.0))


def test_nothing_is_printed_and_nothing_deprecated_is_used(capfd):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        exudyn_models.simulate(SHORT, mesh=MESH, save=5, integrator=RK44())
        exudyn_models.simulate(SHORT, mesh=MESH, save=5, element=GeometricallyExact(), contact=Rigid())
    printed = capfd.readouterr()
    assert printed.out == "" and printed.err == ""
