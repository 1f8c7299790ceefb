"""A wall that gives way: springs that never pull, over partly covered elements, and a stop. Held ends stand in
``test_hermite_beam.py``; plates, stops and landings of both paths in ``exudyn_models/test_exudyn_supports.py``."""

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.measure.balance import balance_of
from bent_beam.measure.reduction import wall_peaks
from bent_beam.measure.whole_impact import hits
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE
from hermite_fe.elastic_wall import Springs, add_zeros, push, stored_energy
from hermite_fe.integrators import Midpoint
from theory.elastic_stop import SwungBeam

COARSE = HermiteFE(refine=0.5)


@pytest.mark.parametrize(("ratio", "exact", "pressure"), [(0.0, 3.364318, 1.0), (0.25, 2.533837, 0.8107)])
def test_the_largest_force_of_a_nearly_straight_beam_is_that_of_oscillators_side_by_side(ratio, exact, pressure):
    """κ/ν → 0: bending plays no part, and f√κ = 2√2 max ∫₀^√T R(T − s²) ds, R of an oscillator at V₀."""
    impact = Impact(1.0, 1.0, 120.0, 0.005, 1.0, wall_stiffness=1.0, wall_damping=2.0 * ratio)
    peaks = wall_peaks(COARSE.simulate(impact, end_time=2.6, save=9))
    assert peaks is not None and peaks.force * np.sqrt(0.005) == pytest.approx(exact, rel=2e-4)
    assert peaks.pressure == pytest.approx(pressure, rel=0.02)


def test_an_element_is_in_the_wall_between_the_roots_of_its_cubic_wherever_they_are() -> None:
    """All three in the first tenth, too."""
    springs, random = Springs(1.0, 0.0, np.zeros(4), np.ones(1), np.zeros(1), 0, 1, -1), np.random.default_rng(5)
    for roots in (*random.uniform(-0.2, 1.2, (50, 3)), *random.uniform(0.0, 0.1, (20, 3))):
        cubic, found = np.poly1d(roots, r=True), np.zeros(3)
        q = np.array([cubic(0.0), cubic.deriv()(0.0), cubic(1.0), cubic.deriv()(1.0)])
        count = add_zeros(springs, q, 0, found, 0)
        inside = roots[(roots > 0.0) & (roots < 1.0)]
        assert np.sort(found[:count]) == pytest.approx(np.sort(inside), abs=1e-6)


@pytest.mark.parametrize(("share", "damping"), [(0.0, 0.7), (0.8, 0.2)])
def test_a_partly_covered_element_pushes_point_by_point_and_a_stop_as_one_spring(share, damping) -> None:
    """share : σ of shear, by which the cubic's slopes differ from the sections' angles."""
    random = np.random.default_rng(3)
    springs = Springs(2.0, damping, np.zeros(4), np.array([0.8]), np.array([share]), 0, 1, -1)
    at = (np.arange(200_000) + 0.5) / 200_000
    cubics = 1 - 3 * at**2 + 2 * at**3, at - 2 * at**2 + at**3, 3 * at**2 - 2 * at**3, at**3 - at**2
    N = np.array([1.0, 0.8, 1.0, 0.8])[:, None] * cubics
    N += share * np.outer([-1 / 0.8, -0.5, 1 / 0.8, -0.5], N[1] + N[3])
    thrice = np.array([[-0.1, 3.0, 0.1, 3.0], [0.2, -3.0, -0.1, -2.0]])  # so often these change sign
    for q, new in (*random.normal(size=(20, 2, 4)), thrice):
        force, peaks = np.zeros(4), np.full(4, 9.0)
        total, loss, _ = push(springs, q, new, 0.3, force, np.zeros((4, 4)), peaks)
        p, after = np.maximum(q @ N, 0.0), np.maximum(new @ N, 0.0)
        spring = (after**2 - p**2) / (new @ N - q @ N)  # k/2 = 1
        pressure = np.maximum(spring + damping * (after - p) / 0.3, 0.0)
        assert total == pytest.approx(0.8 * pressure.mean(), rel=1e-2, abs=1e-2)  # kinks where it would pull
        assert force == pytest.approx(0.8 * (N * pressure).mean(axis=1), rel=1e-2, abs=1e-2)
        for found, most in zip(peaks[2:], (after.max(), pressure.max())):  # of the points where it is integrated
            assert 0.8 * most <= found <= 1.0001 * most
        held = stored_energy(springs, new)
        gained = held - stored_energy(springs, q)
        assert (held, gained) == pytest.approx((0.8 * (after**2).mean(), 0.8 * (after**2 - p**2).mean()), abs=1e-6)
        assert loss >= 0.0 and force @ (new - q) == pytest.approx(gained + loss, abs=1e-12)
        for dof in (0, 2):  # one spring, at either node
            stop = springs._replace(last=0, stop=dof)
            total, loss, _ = push(stop, q, new, 0.3, force, np.zeros((4, 4)), peaks)
            held = stored_energy(stop, new)
            assert (np.sqrt(held), peaks[2]) == pytest.approx((max(new[dof], 0.0),) * 2)
            assert (new - q)[dof] * total == pytest.approx(held - stored_energy(stop, q) + loss, abs=1e-12)
            assert force == pytest.approx(np.where(np.arange(4) == dof, total, 0.0)) and peaks[3] == total


def test_a_beam_that_comes_to_rest_on_its_wall_pushes_with_its_weight() -> None:
    """At rest nothing moves but the last digits: a step converges within these."""
    wall = {"wall_stiffness": 1e3, "wall_damping": 44.0}
    impact = Impact.whole_beam(0.5, relative_damping=0.05).replace(acceleration=5.0, **wall)
    method = HermiteFE(mesh=UniformMesh(0.1), integrator=Midpoint(time_step=1e-3))
    rest = method.simulate(impact, end_time=8.0, save=100)
    assert np.abs(rest.array("velocity", -1)).max() < 1e-10
    force = np.diff(rest.array("total_impulse"))[-1] / np.diff(rest.time)[-1]
    assert force == pytest.approx(5.0 * impact.mass_per_length * impact.length, rel=1e-9)


def test_a_hinged_beam_swung_on_an_elastic_stop_is_its_modes() -> None:
    """Code_Aster's test SDNL32 (V5.02.032), whose published displacements the modes have (theory's tests)."""
    side, length = 0.014, 0.783
    impact = Impact(
        6.7e10 * side**4 / 12.0, 2400.0 * side**2, length, 0.0, 3.8 * length / 2.0, left_end="hinged",
        wall_stiffness=18e3, wall_from=length / 2.0, wall_to=length / 2.0,
    )  # fmt: skip
    history = HermiteFE(refine=0.5).simulate(impact, end_time=0.012, save=np.linspace(5e-5, 0.012, 240))
    time, tip = SwungBeam(impact.bending_stiffness, impact.mass_per_length, length, 3.8, 18e3).tip(0.012)
    found, exact = -history.array("gap")[:, -1], np.interp(history.time, time, tip)
    assert np.abs(found - exact).max() < 1e-3 * np.abs(exact).max()
    assert abs(history.energy_budget()["defect"]) < 1e-8 * history.energy_budget()["initial_energy"]


def test_a_straight_beam_flies_between_two_elastic_walls_like_a_point_mass() -> None:
    """Every point stays on a wall for half a period, π√(μ/k), flies the clearance at V₀ and gives each 2μLV₀."""
    impact = Impact(1.0, 1.0, 2.0, 0.0, 1.0, wall_stiffness=400.0, opposite_wall=0.5)
    history = COARSE.simulate(impact, end_time=2.5, save=2000)
    found, stay = hits(history), np.pi / 20.0
    assert [hit.wall for hit in found] == ["front", "opposite", "front", "opposite"]
    assert [hit.begin for hit in found] == pytest.approx([k * (stay + 0.5) for k in range(4)], abs=3e-3)
    assert [hit.end - hit.begin for hit in found] == pytest.approx([stay] * 4, abs=5e-3)
    assert [hit.impulse for hit in found] == pytest.approx([4.0] * 4, rel=1e-9)
    peaks = wall_peaks(history)
    assert peaks.force == pytest.approx(2.0 * 20.0, rel=1e-3) and peaks.penetration == pytest.approx(0.05, rel=1e-3)
    assert balance_of(history).energy < 1e-9


@pytest.mark.parametrize("stiffness", [None, 2e5])
def test_a_beam_in_a_hole_with_clearance_swings_up_to_either_wall(stiffness) -> None:
    """It reaches c at asin(ωc/V₀)/ω of its lowest mode, hits the walls in turn, and no energy is lost unseen."""
    impact = Impact(1.0, 1.0, 1.0, 0.0, 1.0, left_end="hinged", right_end="hinged", wall_from=-0.05, wall_to=0.05,
                    wall_stiffness=stiffness, wall_clearance=0.02, opposite_wall=0.02, damping=1e-3)  # fmt: skip
    history = COARSE.simulate(impact, end_time=0.4, save=2000)
    found, omega = hits(history), np.pi**2
    assert found[0].begin == pytest.approx(np.arcsin(0.02 * omega) / omega, rel=0.02)
    assert [hit.wall for hit in found[:3]] == ["front", "opposite", "front"]
    assert all(hit.place < 0.05 for hit in found)
    budget = balance_of(history)
    assert budget.energy < 1e-9 and (budget.pull or 0.0) < 1e-9


def test_a_plate_is_pressed_hardest_at_its_edge_whatever_the_elements() -> None:
    """The beam hangs over it to the right."""
    over = Impact(1.0, 1.0, 2.0, 0.0, 1.0, left_end="clamped", wall_stiffness=1e3, wall_from=-0.5, wall_to=0.1)
    runs = [HermiteFE(mesh=UniformMesh(length)).simulate(over, end_time=0.3, save=30) for length in (0.1, 0.025)]
    for name in ("peak_penetration", "peak_pressure"):
        coarse, fine = (run.array(name)[-1] for run in runs)
        assert coarse == pytest.approx(fine, rel=2e-3) and fine > 0.0


@pytest.mark.parametrize(("place", "waves"), [(0.0, 2), (1.0, 1)])
def test_shear_waves_take_their_part_of_the_first_force_on_a_stop_from_a_beam_without_damping(place, waves) -> None:
    """F = c(V₀ − F/(2√(κ_sGA μ))), one wave where the stop is at an end: the mean force soon after the touch, too."""
    impact = Impact(1.0, 1.0, 2.0, 0.0, 1.0, wall_stiffness=1.0, wall_damping=40.0, wall_from=place, wall_to=place)
    impact, exact = impact.replace(shear_stiffness=400.0, rotary_inertia=5e-4), 40.0 / (1.0 + 40.0 / (20.0 * waves))
    history = HermiteFE(mesh=UniformMesh(1.0 / 800)).simulate(impact, end_time=1e-3, save=2)
    assert history.array("peak_force")[-1] == pytest.approx(exact, rel=1e-9)
    assert history.array("total_impulse")[-1] / history.time[-1] == pytest.approx(exact, rel=0.04)
