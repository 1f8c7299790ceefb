"""What a run by Exudyn warns of: each threshold, a little below it and a little beyond."""

from types import SimpleNamespace

import numpy as np
import pytest
from histories import history_of

from bent_beam import Impact
from exudyn_models import ExudynModel
from exudyn_models.contacts import Penalty
from exudyn_models.geometry import Scaling
from exudyn_models.resolution import far_field
from exudyn_models.warnings_of_run import warnings_of_run

IMPACT = Impact.dimensionless(0.5, length=1000.0)
STOP = IMPACT.replace(wall_from=0.0, wall_to=0.0)
PLACES, FEW = np.linspace(0.0, 40.0, 401), np.linspace(0.0, 40.0, 41)  # Λ
CUT = 0.5 * far_field(Scaling(IMPACT, 1.0))  # Λ: a shorter half beam sends waves back too early
ENDED = {"half_length": 0.99 * CUT}


def stated(*, impact=IMPACT, places=PLACES, given=True, half_length=40.0, lost=0.0, slender=True, settles=True, **run):
    """The warnings of a sound run but for what is given: ``in_wall`` is a place, Λ, of a beam that is else 1 before its
    wall; ``velocity_y``, ``wall_y`` and ``wall_slope`` are those of its shape; ``lost`` is given back, J, and taken."""
    parts = {"step": 1e-3, "unsettled": 0, "cycles": 0, "deepest": 0.0, "held": 0.0, "slope": 0.0, "in_wall": 0.0} | run
    scaling, flat, time = Scaling(impact, 1.0), np.zeros(places.size), np.linspace(0.0, 1.0, run.get("instants", 2))
    shape = {name: flat + run.get(name, 0.0) for name in ("velocity_y", "wall_y", "wall_slope")}
    shape = SimpleNamespace(s=places, y=flat - 1.0, slender=slender, **shape)
    record = {"time": time, "y": [2.0 * np.isclose(places, parts["in_wall"]) - 1.0], "slope": [flat - parts["slope"]]}
    stepping = SimpleNamespace(
        segments=[SimpleNamespace(length=0.2), SimpleNamespace(length=parts["step"])],
        settling=SimpleNamespace(unsettled=parts["unsettled"], cycles=parts["cycles"], steps=1000) if settles else None,
        chosen=SimpleNamespace(mesh_given=given),
        layout=SimpleNamespace(places=places, half_length=half_length, scaling=scaling),
        run=SimpleNamespace(
            record=record, scaling=scaling, deepest=parts["deepest"], sums={"held_impulse": parts["held"]}, total=-2.0,
            beam=SimpleNamespace(shape=shape), contact=SimpleNamespace(nodes=np.arange(80)),
        ),
    )  # fmt: skip
    books = history_of(
        [0.0, 0.5, 0.7, 1.0], [0.0, 1.0], loss_impact=np.array([0.0, 1.0, 1.0 - lost, 1.0]),
        kinetic_energy=np.full(4, 3.0), strain_energy=np.full(4, 1.0),
    )  # fmt: skip
    return warnings_of_run(stepping, books)


def graded(growth, first=0.05):
    """``places`` whose elements grow by a factor from 0 to beyond 40 Λ."""
    return np.concatenate([[0.0], np.cumsum(first * growth ** np.arange(150))])


@pytest.mark.parametrize(
    ("sound", "amiss", "says"),
    [
        ({"step": 0.049}, {"step": 0.051}, "time steps of 0.051 end_time"),
        ({"settles": False}, {"unsettled": 1}, "in 1 of 1000 steps the contact state had not settled"),
        ({"cycles": 49}, {"cycles": 51}, "in 51 of 1000 steps no contact state was consistent"),
        ({"deepest": 0.0099}, {"deepest": 0.0101}, "enters the wall by up to 1.01% of V0 t"),
        ({"deepest": 1.0, "impact": IMPACT.replace(wall_stiffness=1.0)}, {"deepest": 1.0}, "enters the wall"),
        ({"lost": 3.9e-3}, {"lost": 4.1e-3}, "the contact gave 0.001 of the initial energy"),  # of 4 J
        ({"held": -1.9}, {"held": -2.2}, "pulled by 1.1 times the total impulse"),  # of -2 N s
        ({"places": graded(1.0205)}, {"places": graded(1.0215)}, "the mesh grows by 2% an element"),
        ({"half_length": 1.01 * CUT}, ENDED, "the end lies at"),
        (ENDED | {"impact": IMPACT.replace(length=1.98 * CUT)}, ENDED, "come back before the end time"),
        ({"places": FEW, "instants": 1}, {"places": FEW}, "bending length"),
        ({"places": FEW, "impact": STOP}, {"places": FEW}, "bending length"),
        ({"places": graded(1.0215), "given": False}, {"places": graded(1.0215)}, "an element"),
        ({"slope": 0.099}, {"slope": 0.101}, "slopes up to 0.1: linear theory"),
        ({"slope": 0.099, "slender": False}, {"slope": 0.101, "slender": False}, "the model's slopes reach 0.1"),
        ({"slope": 0.12, "wall_slope": 0.03}, {"slope": -0.08, "wall_slope": 0.03}, "slopes up to 0.11"),
        ({"in_wall": 8.1, "velocity_y": 1.1}, {"in_wall": 8.1, "velocity_y": 0.9}, "outside the zone"),  # freely, too
        ({"in_wall": 8.1, "wall_y": -1.1}, {"in_wall": 8.1, "wall_y": 1.1}, "outside the zone given contact points"),
        ({"in_wall": 8.0}, {"in_wall": 8.1}, "outside the zone given contact points"),  # to 7.9, and an element
    ],
)
def test_a_threshold_is_where_it_is_said_to_be(sound, amiss, says) -> None:
    assert stated(**sound) == []
    (said,) = stated(**amiss)
    assert says in said


def test_a_penalty_that_is_too_soft_is_told_by_how_deep_the_beam_is_in_the_wall() -> None:
    """In shares of V₀t, from a hundredth of the run on."""
    method = ExudynModel(refine=0.25, contact=Penalty(relative_stiffness=0.1))
    run = method.simulate(Impact.dimensionless(0.5).replace(velocity=3.0), end_time=0.02, save=200)
    late = run.time > 0.01 * run.time[-1]
    deepest = (-run.array("gap")[late].min(axis=1) / (3.0 * run.time[late])).max()
    assert deepest > 0.02 and f"enters the wall by up to {deepest:.2%} of V0 t" in run.warnings[0]


@pytest.mark.parametrize(
    ("near", "far", "says"),
    [(0.1, 0.33, []), (0.1, 0.35, ["2.85 elements at the end time"]), (0.109, 0.1, ["2.9 elements at 0.1 of"])],
)
def test_the_bending_length_of_the_front_needs_three_elements_at_both_times(near, far, says) -> None:
    """It is 1 Λ at the end time, with the front at 2 Λ, and √0.1 of both at a tenth of it."""
    said = stated(places=np.concatenate([np.arange(0.0, 1.0, near), np.arange(1.0, 40.0, far)]), given=False)
    assert len(said) == len(says) and all(text in line for text, line in zip(says, said))


def test_waves_of_a_long_front_are_waited_for_farther_out() -> None:
    """Of its length: ten times as flat a bow lays on √10 as much in the same time."""
    beyond = [far_field(Scaling(Impact.dimensionless(kappa), 1.0)) - 12.0 for kappa in (0.02, 0.2)]
    assert beyond[0] / beyond[1] == pytest.approx(np.sqrt(10.0)) and beyond[1] > 20.0
