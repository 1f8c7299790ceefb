"""Mass matrices: the same beam, whatever its rotations carry."""

import numpy as np
import pytest
from scipy.linalg import solveh_banded

import hermite_fe
from bent_beam import Impact
from bent_beam.meshes import GradedMesh, UniformMesh
from hermite_fe.beam import HermiteBeam, banded_product
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import INTEGRATORS, Integrator, MoreauJean
from hermite_fe.masses import ConsistentMass, LumpedMass, Mass
from hermite_fe.model import beam_model

MASSES = (ConsistentMass(), LumpedMass(), LumpedMass(rotary=1.0 / 24.0))
UNRESOLVED = NodeContact(hold=0, hold_until=0.0)


@pytest.mark.parametrize("mass", MASSES)
def test_a_shift_moves_the_whole_mass_of_the_beam(mass: Mass) -> None:
    beam = HermiteBeam(np.array([0.0, 0.3, 1.0, 2.0]), 1.0, 5.0)
    shift = beam.interpolate(np.ones(4), np.zeros(4))
    assert shift @ banded_product(mass.matrix(beam), shift) == pytest.approx(10.0, rel=1e-13)


def test_hinton_rock_and_zienkiewicz_scale_the_diagonal_of_the_consistent_matrix() -> None:
    beam = HermiteBeam(np.array([0.0, 0.7, 1.4]), 1.0, 2.0)
    ours, full = LumpedMass(rotary=1.0 / 78.0).matrix(beam), ConsistentMass().matrix(beam)
    assert ours[0] == pytest.approx(full[0] * 420.0 / 312.0, rel=1e-14)
    assert not ours[1:].any()


@pytest.mark.parametrize("mass", MASSES)
def test_under_a_uniform_load_a_free_beam_accelerates_as_a_rigid_body(mass: Mass) -> None:
    impact = Impact.dimensionless(0.5, length=2.0).replace(acceleration=3.0)
    nodes = GradedMesh(0.01, 1.3, zone=0.1).nodes(1.0)
    system = beam_model(impact, nodes, UNRESOLVED, GridViscosity(), full=False, mass=mass).system
    acceleration = solveh_banded(system.mass, system.load[0], lower=True)
    assert acceleration[0::2] == pytest.approx(3.0, rel=1e-9)
    assert acceleration[1::2] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("kind", sorted(INTEGRATORS))
def test_with_lumped_masses_the_contact_takes_up_the_momentum_of_the_nodes(kind: str) -> None:
    """Impulse = −Δ(ΣMv) of the whole beam, on every integrator."""
    integrator: Integrator = INTEGRATORS[kind](time_step=2e-5)
    mesh, mass = UniformMesh(0.02), LumpedMass()
    history = hermite_fe.simulate(
        Impact.dimensionless(0.5, length=4.0), end_time=0.01, mesh=mesh, integrator=integrator,
        contact=UNRESOLVED, far_field=GridViscosity(), mass=mass,
    )  # fmt: skip
    beam = HermiteBeam(mesh.nodes(2.0), 1.0, 1.0)
    nodal = mass.matrix(beam)[0, 0::2]
    lost = 2.0 * nodal @ (history.array("velocity")[0] - history.array("velocity")[-1])
    assert history.array("total_impulse")[-1] == pytest.approx(lost, rel=1e-9)


def first_impact(mass: Mass) -> tuple[float, float]:
    """Impulse (N s) and energy (J) that the first node takes, in an instant."""
    impact = Impact(bending_stiffness=1.0, mass_per_length=1.0, length=1.0, curvature=25.0, velocity=20.0)
    history = hermite_fe.simulate(
        impact,
        end_time=1e-9,
        mesh=UniformMesh(0.05),
        integrator=MoreauJean(theta=1.0, time_step=1e-10),
        contact=UNRESOLVED,
        far_field=GridViscosity(viscosity=0.0),
        mass=mass,
        save=2,
    )
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    return float(history.array("total_impulse")[-1]), float(energy[0] - energy[-1])


@pytest.mark.parametrize("rotary", [1.0 / 24.0, 1.0 / 105.0, 1e-3])
def test_the_first_impact_stops_the_lumped_mass_of_a_node(rotary: float) -> None:
    """Thesis 3.4: μΔxV₀ = 1 N s and ½μΔxV₀² = 10 J for Δx = 0.05 m."""
    impulse, energy = first_impact(LumpedMass(rotary))
    assert impulse == pytest.approx(1.0, rel=1e-4)
    assert energy == pytest.approx(10.0, rel=1e-4)


def test_with_the_consistent_matrix_the_first_impact_stops_less() -> None:
    """Neighbours and rotations give way: 1/(M⁻¹)₀₀ of a long beam, 0.4 μΔx or so, not μΔx."""
    impulse, energy = first_impact(ConsistentMass())
    beam = HermiteBeam(np.linspace(-0.5, 0.5, 21), 1.0, 1.0)
    one = np.eye(42)[20]
    carried = 20.0 / solveh_banded(ConsistentMass().matrix(beam), one, lower=True)[20]
    assert impulse == pytest.approx(carried, rel=1e-4)
    assert energy == pytest.approx(10.0 * carried, rel=1e-4)


def test_rotations_without_inertia_are_refused() -> None:
    with pytest.raises(ValueError, match=r"mass\.rotary must be positive"):
        LumpedMass(rotary=0.0)
