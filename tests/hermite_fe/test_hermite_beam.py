"""The element (thesis A.6, 3.1.5, 3.1.8), masses, and the beam as a system."""

import numpy as np
import pytest
from scipy.linalg import solveh_banded

from bent_beam import Impact
from bent_beam.meshes import GradedMesh, UniformMesh
from hermite_fe import simulate
from hermite_fe.beam import HermiteBeam, shape_functions
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import MoreauJean
from hermite_fe.masses import ConsistentMass, LumpedMass, Mass
from hermite_fe.model import beam_model

FREE, QUIET = NodeContact(), GridViscosity(viscosity=0.0)


def test_interpolation_is_exact_for_cubics() -> None:
    cubic, x = np.poly1d([2.0, -1.0, 0.5, 0.25]), np.linspace(0.0, 0.37, 9)
    q = [cubic(0.0), cubic.deriv()(0.0), cubic(0.37), cubic.deriv()(0.37)]
    for d in range(4):
        assert np.allclose(shape_functions(x / 0.37, 0.37, d) @ q, cubic.deriv(d)(x))


def test_hinton_rock_and_zienkiewicz_scale_the_diagonal_of_the_consistent_matrix() -> None:
    beam = HermiteBeam(np.array([0.0, 0.7, 1.9]), 1.0, 5.0)
    ours, full = LumpedMass(rotary=1.0 / 78.0).matrix(beam), ConsistentMass().matrix(beam)
    assert ours[0] == pytest.approx(full[0] * 420.0 / 312.0, rel=1e-14)
    assert not ours[1:].any() and ours[0, 0::2].sum() == pytest.approx(5.0 * 1.9, rel=1e-12)


@pytest.mark.parametrize("mass", [ConsistentMass(), LumpedMass()])
@pytest.mark.parametrize("full", [False, True])
def test_a_free_bow_under_load_and_tension_accelerates_without_waves_from_its_ends(mass: Mass, full: bool) -> None:
    """The ends keep the direction of N: nothing but the uniform load is left, and a₀ is the whole beam's."""
    impact = Impact.dimensionless(0.5, length=2.0, epsilon_axial=0.3, epsilon_alpha=3.0)
    model = beam_model(impact, GradedMesh(0.01, 1.3, zone=0.1).nodes(1.0), FREE, QUIET, full=full, mass=mass)
    acceleration = solveh_banded(model.system.mass, model.system.load[0], lower=True)
    assert acceleration[0::2] == pytest.approx(3.0, rel=1e-8)
    assert acceleration[1::2] == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("full", [False, True])
def test_half_a_model_has_half_of_the_work_the_loads_and_the_stop_of_a_whole_beam(full: bool) -> None:
    """−½N∫u′² dx is the work of N on the axis that bending shortens; along the axis it pushes each end by NK|x|."""
    beam = Impact.whole_beam(0.5).replace(axial_force=0.3, wall_stiffness=7.0, wall_from=0.0, wall_to=0.0)
    model, other = (beam_model(beam.replace(tension_direction=to), UniformMesh(0.1).nodes(1.0), FREE, QUIET, full=full)
                    for to in ("axis", "tangent"))  # fmt: skip
    loads, x = model.system.load - other.system.load, model.beam.nodes
    bent = model.beam.interpolate(0.5 * x**2, x)
    assert model.copies * model.work_of_tension(bent[None]) == pytest.approx(-0.1)
    assert loads[0, -2] == pytest.approx(0.15) and model.copies * loads.sum() == pytest.approx(0.3)
    assert model.copies * model.system.springs.stiffness == 7.0


@pytest.mark.parametrize("mass", [LumpedMass(1.0 / 24.0), LumpedMass(1e-3), ConsistentMass()])
def test_the_first_impact_stops_the_mass_that_moves_with_a_node(mass: Mass) -> None:
    """Thesis 3.4: μΔxV₀ = 1 N s and ½μΔxV₀² = 10 J of a lumped mass; of the consistent matrix 1/(M⁻¹)₀₀ V₀."""
    impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=1.0, curvature=25.0, velocity=20.0)
    parts = {"mesh": UniformMesh(0.05), "integrator": MoreauJean(1e-10), "far_field": QUIET, "mass": mass}
    history = simulate(impact, end_time=1e-9, save=2, **parts)
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    beam = HermiteBeam(np.linspace(-0.5, 0.5, 21), 1.0, 1.0)
    moved = 20.0 / solveh_banded(mass.matrix(beam), np.eye(42)[20], lower=True)[20]
    if isinstance(mass, LumpedMass):
        assert moved == pytest.approx(1.0)
    assert history.array("total_impulse")[-1] == pytest.approx(moved, rel=1e-4)
    assert energy[0] - energy[-1] == pytest.approx(10.0 * moved, rel=1e-4)
