"""The beam as a system: axial force, damping of the material, curved walls, and what a free end under a force is."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from bent_beam import Impact
from bent_beam.meshes import ScaleFreeMesh, UniformMesh
from hermite_fe import simulate
from hermite_fe.beam import HermiteBeam, banded_product, element_geometric_stiffness, shape_functions
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Integrator, MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.model import beam_model

INTEGRATORS: list[Integrator] = [
    MoreauJean(theta=0.5, time_step=2e-4),
    SignoriniPosition(time_step=2e-4),
    NonsmoothGeneralizedAlpha(time_step=2e-4),
]
FREE = NodeContact(hold=0, hold_until=0.0)
QUIET = GridViscosity(viscosity=0.0)


def test_geometric_stiffness_is_the_integral_of_the_slopes() -> None:
    points, weights = leggauss(4)
    slope = shape_functions(0.5 * (points + 1.0), 0.37, 1)
    expected = slope.T @ (0.5 * 0.37 * weights[:, None] * slope)
    assert np.allclose(element_geometric_stiffness(np.array([0.37]))[0], expected)


@pytest.mark.parametrize("axial_force", [-3.0, 8.0])
def test_a_pinned_beam_under_tension_vibrates_faster(axial_force: float) -> None:
    """ω² = (π/L)⁴EI/μ + (π/L)²N/μ: the half beam from its middle (slope 0) to the pin, by Rayleigh's quotient."""
    beam = HermiteBeam(np.linspace(0.0, 1.0, 21), 2.0, 3.0)  # L = 2
    k = math.pi / 2.0
    q = beam.interpolate(np.cos(k * beam.nodes), -k * np.sin(k * beam.nodes))
    stiffness = beam.stiffness() + axial_force * beam.geometric_stiffness()
    found = (q @ banded_product(stiffness, q)) / (q @ banded_product(beam.mass(), q))
    assert found == pytest.approx((2.0 * k**4 + axial_force * k**2) / 3.0, rel=1e-6)


@pytest.mark.parametrize("full", [False, True])
def test_a_free_bow_under_tension_accelerates_without_waves_from_its_ends(full: bool) -> None:
    """The ends keep the direction of N: nothing but the uniform load is left, and a₀ is the whole beam's."""
    impact = Impact.dimensionless(0.5, length=4.0, epsilon_axial=0.3, epsilon_alpha=-0.2)
    model = beam_model(impact, UniformMesh(0.1).nodes(2.0), FREE, QUIET, full=full)
    moved = banded_product(model.system.mass, model.beam.interpolate(np.full(model.beam.nodes.size, -0.2), 0.0))
    assert np.allclose(model.system.load[0], moved, atol=1e-14)


@pytest.mark.parametrize("integrator", INTEGRATORS, ids=lambda i: type(i).__name__)
def test_momentum_under_an_axial_force_is_what_wall_and_load_give(integrator: Integrator) -> None:
    impact = Impact.dimensionless(0.5, length=4.0, epsilon_axial=0.5, epsilon_alpha=0.1, damping=1e-3)
    history = simulate(
        impact, end_time=0.05, mesh=UniformMesh(0.05), contact=FREE, far_field=QUIET, integrator=integrator, save=5
    )
    model = beam_model(impact, history.array("x"), FREE, QUIET, full=False)
    rigid = model.beam.interpolate(np.ones(history.array("x").size), 0.0)
    weights = banded_product(model.system.mass, rigid)[0::2]  # ∫N₁, the slopes' part is small on fine elements
    momentum = 2.0 * history.array("velocity") @ weights
    given = 0.1 * 4.0 * history.time - history.array("total_impulse")
    assert momentum - momentum[0] == pytest.approx(given, abs=2e-3)
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-11 * budget["initial_energy"]
    assert budget["loss_material"] > 0.0
    assert budget["loss_viscous"] == 0.0


def test_the_materials_damping_takes_a_mode_down_by_half_eta_omega_squared() -> None:
    """No contact: a free–free bow rings at ω = 22.3733/L² and decays like exp(−½ηω²t)."""
    eta, shape = 2e-3, 4.730040744862704
    omega = (shape / 2.0) ** 2  # L = 2
    impact = Impact(1.0, 1.0, 2.0, 0.5, 1e-9, acceleration=-1.0, damping=eta)
    nodes = UniformMesh(0.02).nodes(1.0)
    model = beam_model(impact, nodes, FREE, QUIET, full=False)
    ratio = math.cos(shape / 2.0) / math.cosh(shape / 2.0)
    k = shape / 2.0
    q = model.beam.interpolate(
        np.cos(k * nodes) + ratio * np.cosh(k * nodes), k * (-np.sin(k * nodes) + ratio * np.sinh(k * nodes))
    )
    force = banded_product(dict(model.system.dampings)["material"], q)
    assert (q @ force) / (q @ banded_product(model.system.mass, q)) == pytest.approx(eta * omega**2, rel=1e-5)


def test_a_uniform_natural_curvature_strains_nothing() -> None:
    """A bow that only translates has no strain energy, whatever K, N and η."""
    impact = Impact.dimensionless(0.7, length=4.0, damping=1e-2, epsilon_axial=0.2)
    history = simulate(impact, end_time=1e-3, mesh=UniformMesh(0.1), integrator=MoreauJean(time_step=1e-4))
    assert history.array("strain_energy")[0] == 0.0


@pytest.mark.parametrize("integrator", INTEGRATORS, ids=lambda i: type(i).__name__)
def test_a_bulging_wall_is_a_beam_bent_so_much_more(integrator: Integrator) -> None:
    bent = Impact.dimensionless(0.5, length=8.0)
    parts = {"mesh": ScaleFreeMesh(0.01, 1.02), "integrator": integrator, "end_time": 0.02, "save": 5}
    straight = bent.replace(curvature=0.0, wall_curvature=-0.5)
    one, other = simulate(bent, **parts), simulate(straight, **parts)  # type: ignore[arg-type]
    for name in ("gap", "total_impulse", "strain_energy"):
        assert np.array_equal(one.array(name), other.array(name)), name
    assert np.allclose(one.array("slope") - other.array("slope"), -0.5 * one.array("x"))
