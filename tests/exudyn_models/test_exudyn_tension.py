"""Axial force and curved walls: the model itself carries them."""

import pytest
from numpy.testing import assert_allclose

import exudyn_models
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from exudyn_models.geometry import LinearLimit, TrueGeometry
from exudyn_models.method import held_for
from exudyn_models.resolution import chosen_half_length
from hermite_fe import HermiteFE


def test_a_straight_beam_on_a_bulging_wall_is_the_bent_beam_on_a_flat_one():
    bent = Impact.dimensionless(0.5, length=16.0)
    straight = bent.replace(curvature=0.0, wall_curvature=-0.5)
    both = bent.replace(curvature=0.8, wall_curvature=0.3)
    mesh = exudyn_models.chosen_mesh(bent).refined(1 / 8)
    flat, *curved = (exudyn_models.simulate(i, mesh=mesh, save=20) for i in (bent, straight, both))
    for history in curved:
        assert_allclose(history.array("total_impulse"), flat.array("total_impulse"), rtol=1e-4, atol=1e-6)
        assert_allclose(history.array("gap"), flat.array("gap"), rtol=5e-5, atol=1e-6)


@pytest.mark.parametrize(("kappa_over_nu", "force"), [(2.0, 1.8), (2.0, -1.8), (0.3, -1.0), (2.0, 0.01)])
def test_the_budget_of_a_whole_impact_closes_under_axial_force(kappa_over_nu, force):
    """In units of EI/ℓ²; such a beam buckles at −2.47."""
    beam = Impact.whole_beam(kappa_over_nu, relative_damping=1e-2)
    impact = beam.replace(axial_force=force, acceleration=-force * kappa_over_nu, tension_direction="tangent")
    history = ExudynModel(mesh=UniformMesh(1 / 25)).for_whole_beam(impact).simulate(impact, end_time=0.4)
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-6 * budget["initial_energy"]
    if kappa_over_nu < 1.0:
        return  # 25 elements do not resolve its zone
    other = HermiteFE(refine=0.5).for_whole_beam(impact).simulate(impact, end_time=0.4)
    for name in ("strain_energy", "work_of_loads"):  # without the stretch that keeps the force
        assert history.array(name)[-1] == pytest.approx(other.array(name)[-1], rel=0.02, abs=1e-3)


@pytest.mark.parametrize(("end", "refine"), [(0.005, 0.25), pytest.param(0.1, 1.0, marks=pytest.mark.verify)])
def test_a_very_small_axial_force_changes_nothing(end, refine):
    """Its stiff bar has a round-off far above the residual of an unpulled beam."""
    beam, method = Impact.whole_beam(2.0), ExudynModel(refine=refine)
    pulled, free = (method.simulate(beam.replace(axial_force=n), end_time=end, save=5) for n in (1e-8, 0.0))
    assert pulled.array("total_impulse")[-1] == pytest.approx(free.array("total_impulse")[-1], rel=1e-6)


def test_a_beam_that_is_nearly_buckled_gets_more_elements():
    beams = [Impact.whole_beam(2.0).replace(axial_force=force) for force in (0.0, 1.8, -1.8)]
    free, taut, pressed = (ExudynModel().for_whole_beam(beam).mesh.nodes(1.0).size for beam in beams)
    assert free == taut < pressed


def test_what_no_theory_of_a_zone_needs_is_left_alone():
    """One point is not held, and a load that bends the ends up does not shorten the beam; they do not touch."""
    point, zone = (Impact.dimensionless(kappa, epsilon_psi=0.3) for kappa in (1.1, 0.3))
    assert held_for(None, point).hold == 0 < held_for(None, zone).hold
    assert chosen_half_length(zone, 0.1) == chosen_half_length(Impact.dimensionless(0.3), 0.1)
    mesh = exudyn_models.chosen_mesh(zone, 0.1).refined(1 / 4)
    history = exudyn_models.simulate(zone, mesh=mesh, end_time=0.1, save=5)
    assert history.array("gap")[-1].min() < -1.0  # of what would be inside the wall without one, and far away
    assert not any("enters the wall" in warning for warning in history.warnings)


@pytest.mark.verify
def test_a_real_beam_under_tension_gives_the_impulse_of_the_linear_limit():
    impact = Impact.dimensionless(0.5, epsilon_axial=20.0, epsilon_alpha=-10.0).replace(section_height=1e-2)
    end = 1e-3
    kinds = LinearLimit(), TrueGeometry()
    linear, true = (exudyn_models.simulate(impact, end_time=end, geometry=g, save=50) for g in kinds)
    assert true.array("total_impulse")[-1] == pytest.approx(linear.array("total_impulse")[-1], rel=5e-3)
