"""The element (thesis A.6, 3.1.5, 3.1.8), masses, the beam as a system; Timoshenko's beam: element, balances, modes,
and its whole impact beside another code.

With shear, units half length = EI = μ = V₀ = 1; s = l_s, the shear length, g = κ_sG/E."""

import leapfrog
import numpy as np
import pytest
from numpy.polynomial import Polynomial
from numpy.polynomial.legendre import leggauss
from scipy.linalg import solveh_banded

from bent_beam import Impact
from bent_beam.measure.balance import balance_of
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.meshes import GradedMesh, UniformMesh
from bent_beam.modes import lowest_frequency, lowest_mode
from hermite_fe import HermiteFE, simulate
from hermite_fe.beam import HermiteBeam, shape_functions
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import MoreauJean
from hermite_fe.masses import ConsistentMass, LumpedMass, Mass
from hermite_fe.model import beam_model

FREE, QUIET = NodeContact(), GridViscosity(viscosity=0.0)
S, G = 0.05, 0.2
BEAM = Impact.whole_beam(0.5, relative_damping=3e-3, shear_length=S, shear_ratio=G)


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


@pytest.mark.parametrize("s", [0.0, 0.2])
def test_element_matrices_are_integrals_of_the_shape_functions_of_friedman_and_kosmatka(s: float) -> None:
    """Cubics w whose sections turn by w′ + s²w‴, each of one end's deflection or angle; without shear of thesis A.6."""
    length, bending, mass = 0.3, 3.0, 5.0
    stiff, inertia = (bending / s**2, 0.33 * mass * s**2) if s else (None, 0.0)
    powers = [Polynomial(row) for row in np.eye(4)]
    slopes = [w.deriv() for w in powers]
    angles = [w.deriv() + s**2 * w.deriv(3) for w in powers]
    shapes = np.linalg.inv([[w(0.0), turn(0.0), w(length), turn(length)] for w, turn in zip(powers, angles)])
    points, weights = leggauss(6)

    def integral(functions: list[Polynomial]) -> np.ndarray:
        values = shapes @ [f(0.5 * length * (points + 1.0)) for f in functions]
        return (values * 0.5 * length * weights) @ values.T

    beam = HermiteBeam(np.array([0.0, length, 2.0 * length]), bending, mass, stiff, inertia)
    for found, expected in (
        (beam.stiffness(), bending * integral([turn.deriv() for turn in angles])
         + (stiff or 0.0) * integral([slope - turn for slope, turn in zip(slopes, angles)])),
        (ConsistentMass().matrix(beam), mass * integral(powers) + inertia * integral(angles)),
        (beam.geometric_stiffness(), integral(slopes)),
    ):  # fmt: skip
        assert found == pytest.approx(beam.assembled(np.stack([expected] * 2)), rel=1e-12, abs=1e-13)


@pytest.mark.parametrize("s", [0.01, 0.3])
def test_a_cantilever_is_exact_at_its_nodes_and_follows_its_clamp(s: float) -> None:
    """F(x²/2 − x³/6) bent and F x s² sheared, from the clamp; its sections turn by F(x − x²/2)."""
    beam = HermiteBeam(GradedMesh(0.05, 1.4, zone=0.1).nodes(1.0), 1.0, 1.0, s**-2, G * s**2)
    load, x = np.zeros(beam.dofs), beam.nodes
    load[-2] = 2.0
    q = beam.static(load, {0: 0.1, 1: 0.04})
    assert q[0::2] == pytest.approx(0.1 + 0.04 * x + 2.0 * (x**2 / 2 - x**3 / 6 + s**2 * x), rel=1e-12)
    assert q[1::2] == pytest.approx(0.04 + 2.0 * (x - x**2 / 2), rel=1e-12)


@pytest.mark.parametrize("change", [{}, {"acceleration": 4.0}, {"fourth_derivative": 2.0}, {"wall_stiffness": 1e4}])
def test_momentum_and_energy_close_and_half_the_beam_is_half_of_it(change: dict[str, float]) -> None:
    impact = BEAM.replace(**change)
    runs = [HermiteFE(mesh=UniformMesh(0.02), full_beam=full).for_whole_beam(impact) for full in (False, True)]
    half, full = (run.simulate(impact, end_time=0.1, save=200) for run in runs)
    budget, balance = half.energy_budget(), balance_of(half)
    assert abs(budget["defect"]) < 1e-9 * budget["initial_energy"] and budget["loss_material"] > 0.0
    assert balance.momentum < 1e-9 and balance.second_moment < 5e-3 and balance.warnings == []
    assert full.array("total_impulse") == pytest.approx(half.array("total_impulse"), abs=1e-5)
    middle = full.positions(0).size // 2
    assert full.array("bending_moment")[:, middle:] == pytest.approx(half.array("bending_moment"), abs=1e-3)
    assert np.abs(half.array("bending_moment")).max() <= half.moment.max() * (1.0 + 1e-9)


@pytest.mark.parametrize(("kappa", "g"), [(0.5, 0.2), (1.5, 0.33)])
def test_an_explicit_code_of_its_own_finds_the_same_whole_impact(kappa: float, g: float) -> None:
    impact = Impact.whole_beam(kappa, relative_damping=3e-3, shear_length=S, shear_ratio=g)
    method = HermiteFE(mesh=UniformMesh(0.02), integrator=MoreauJean(theta=0.5, time_step=1e-4, growth=0.0))
    found = whole_impact(method.for_whole_beam(impact).simulate(impact, end_time=1.1, save=300))
    restitution, impulse, moment = leapfrog.whole_impact(kappa, 3e-3, S, g, 50, 1.1)
    assert (0.5 * found.impulse - 1.0, found.impulse) == pytest.approx((restitution, impulse), abs=2e-3)
    assert found.peak_moment == pytest.approx(moment, rel=1e-2)


@pytest.mark.parametrize("ends", [("clamped", "clamped"), ("clamped", "hinged"), ("free", "clamped")])
@pytest.mark.parametrize("pull", [0.0, 30.0])
def test_a_held_beam_swings_in_the_mode_in_which_it_starts(ends, pull) -> None:
    """With shear and tension, the wall out of reach: 1.5e-5 of its swing, 1e-2 if it starts in bending's alone."""
    left, right = ends
    held = BEAM.replace(curvature=0.0, damping=0.0, left_end=left, right_end=right, axial_force=pull)
    impact = held.replace(wall_clearance=9.0, wall_stiffness=1e3)
    run = HermiteFE(mesh=UniformMesh(1 / 50)).simulate(impact, end_time=0.8, save=40)
    mode, _ = lowest_mode(impact, run.positions(0))
    moved = 9.0 - run.array("gap")[1:]
    assert np.abs(moved[:, -1]).max() < 1e-14  # a held end stays
    swing = moved @ mode / (mode @ mode)
    assert moved == pytest.approx(np.outer(swing, mode), abs=5e-5 * np.abs(moved).max())
    omega = 2.0 * np.pi * lowest_frequency(impact)
    assert swing == pytest.approx(np.sin(omega * run.time[1:]) / omega, rel=1e-3, abs=1e-4 / omega)
