"""Ends that are held, plates and stops, by Exudyn: closed forms, and the Hermite path's, held to the same."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from bent_beam import Impact
from bent_beam.measure.balance import balance_of
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from exudyn_models.contacts.penalty import covered
from hermite_fe import HermiteFE

HINGED = {"left_end": "hinged", "right_end": "hinged"}


def agree(impact: Impact, end: float, tolerance: float, refine: float = 0.25):
    """Both codes' histories, whose impulses, moments and forces agree within ``tolerance``."""
    histories = [kind(refine=refine).simulate(impact, end_time=end, save=40) for kind in (ExudynModel, HermiteFE)]
    names = ["total_impulse", "largest_moment"] + ["peak_force"] * (impact.wall_stiffness is not None)
    for name in names:
        exudyn, hermite = (float(np.abs(history.array(name)).max()) for history in histories)
        assert exudyn == pytest.approx(hermite, rel=tolerance), name
    for history in histories:
        assert abs(history.energy_budget()["defect"]) < 1e-6 * history.energy_budget()["initial_energy"]
    return histories


@pytest.mark.parametrize("method", [ExudynModel(refine=0.15), HermiteFE(refine=0.2)], ids=lambda method: method.path)
def test_a_hinged_beam_swings_in_its_first_mode_and_a_clamped_one_in_its_own(method) -> None:
    for ends, beta in ((HINGED, np.pi), (dict.fromkeys(HINGED, "clamped"), 4.730040744862704)):
        impact = Impact(1.0, 1.0, 2.0, 1e-3, 1e-6, wall_from=0.5, wall_to=0.6, **ends)  # the wall is out of reach
        omega = beta**2 / 4.0
        history = method.simulate(impact, end_time=1.0 / omega, save=10)
        moved = history.array("gap", 0) - history.array("gap")
        middle = int(np.argmin(np.abs(history.positions(0))))
        assert moved[:, middle] == pytest.approx(1e-6 * np.sin(omega * history.time) / omega, rel=1e-3, abs=1e-12)
        assert np.abs(moved[:, [0, -1]]).max() < 1e-15
        with pytest.raises(ValueError, match="supports bring the beam back"):
            method.simulate_to_separation(impact)


def test_a_beam_swung_on_an_elastic_stop_and_a_hinged_one_on_a_plate_are_those_of_the_other_path() -> None:
    stop = Impact(1.0, 1.0, 2.0, 0.0, 1.0, left_end="hinged", wall_stiffness=300.0, wall_from=1.0, wall_to=1.0)
    agree(stop, 0.5, 4e-3, refine=0.35)
    agree(stop.replace(wall_from=0.0, wall_to=0.0, **HINGED), 0.2, 4e-3)  # half of it before half of the beam
    plate = Impact(1.0, 1.0, 2.0, 0.1, 1.0, wall_from=-0.2, wall_to=0.2, wall_stiffness=3e3, **HINGED)
    agree(plate.replace(wall_damping=30.0), 0.3, 4e-3, refine=0.35)


def test_a_rigid_stop_and_a_plate_hold_their_part_of_the_beam_and_let_the_rest_pass() -> None:
    stop = Impact(1.0, 1.0, 2.0, 0.0, 1.0, damping=1e-2, wall_from=0.0, wall_to=0.0, **HINGED)
    plate = Impact(1.0, 1.0, 2.0, 0.3, 1.0, damping=1e-2, wall_from=-0.3, wall_to=0.2)
    for impact, where in ((stop, [0.0, 0.0]), (plate, [-0.3, 0.2])):
        histories = agree(impact, 0.15, 0.01, refine=0.35)
        for history, depth in zip(histories, (1e-3, 1e-12)):
            places, gap = history.contact_positions(0), history.array("gap")
            assert_allclose(places[[0, -1]], where, atol=1e-12)
            assert gap[:, np.searchsorted(history.positions(0), places - 1e-9)].min() > -depth
            assert gap[-1].min() < -0.02
    assert max(balance_of(history).momentum for history in histories) < 0.01


def test_a_clamped_beam_meets_a_plate_at_its_tip_with_all_points_that_stand_before_it() -> None:
    """The tip moves at 2.95 V₀, where y₀ does not take it, in a run that ends before waves return."""
    beam = Impact(1.0, 1.0, 2.0, 0.052, 1.0, wall_from=0.6, wall_to=1.0, left_end="clamped")
    touched = ExudynModel(refine=0.25).simulate(beam, end_time=0.01, save=10)
    assert touched.contact_positions(0)[-1] == 1.0 and touched.array("gap")[:, -1].min() > -1e-6
    missed = ExudynModel(refine=0.25).simulate(beam.replace(curvature=0.8), end_time=0.008, save=10)
    assert not missed.array("total_impulse").any() and not missed.array("impulse").any()


def test_the_covered_length_of_a_straight_rim_is_exact_and_grows_without_jumps() -> None:
    x = np.array([-1.0, -0.7, -0.2, 0.0, 0.5, 1.0])
    for rim in np.linspace(-0.9, 0.9, 37):
        assert covered(rim - x, np.diff(x)).sum() == pytest.approx(1.0 + rim)
        assert covered(x - rim, np.diff(x)).sum() == pytest.approx(1.0 - rim)


@pytest.mark.parametrize("velocity", [1e-3, 1e-6])
def test_a_load_bends_a_hinged_beam_to_its_rest_however_slowly_it_came(velocity: float) -> None:
    """5pL⁴/(384 EI), away from the wall: what the load makes of the velocity is no instability."""
    impact = Impact.whole_beam(1.0).replace(curvature=0.0, damping=0.3, acceleration=-1.0, velocity=velocity, **HINGED)
    history = ExudynModel(mesh=UniformMesh(0.1)).simulate(impact, end_time=12.0, save=5)
    assert history.array("gap", -1).max() == pytest.approx(5.0 * 16.0 / 384.0, rel=2e-5)
