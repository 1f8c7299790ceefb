"""A force at a point, as docs/guide/add-load.md adds one: a field, its place, and their names in ``MODELLED``."""

import sys
from dataclasses import dataclass
from typing import Annotated

import numpy as np
import pytest
from twins import in_units

from bent_beam import Impact
from bent_beam.loads import SIMULATED, Load, Place
from bent_beam.meshes import NodesMesh, UniformMesh
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE


@dataclass(frozen=True)
class Pushed(Impact):
    push: Annotated[float, Load("N", "F towards the wall", instead=SIMULATED)] = 0.0
    push_at: Annotated[float, Place("m", "where F acts", instead=SIMULATED, load="push")] = 0.0


@pytest.fixture(autouse=True)
def known(monkeypatch):
    monkeypatch.setattr("bent_beam.history.Impact", Pushed)
    for path in (sys.modules["hermite_fe.simulate"], sys.modules["exudyn_models.method"]):
        monkeypatch.setattr(path, "MODELLED", (*path.MODELLED, "push", "push_at"))


def pushed(force, place, **others):
    """In units of the half length."""
    return Pushed(1.0, 1.0, 2.0, 0.5, 1.0, damping=0.01, push=force, push_at=place, **others)


@pytest.mark.parametrize(
    ("beam", "alike"),
    [
        (pushed(2.0, 0.0), 5e-3),
        pytest.param(pushed(-1e5, 0.2), 5e-3, marks=pytest.mark.verify),  # in the end as fast as 1e4 V₀, and as steep
        (pushed(1.0, -1.0, shear_stiffness=400.0, rotary_inertia=1e-3), 2e-2),
    ],
)
def test_force_and_wall_move_and_turn_the_beam_and_both_paths_agree(beam, alike) -> None:
    """∫μ v dx = mV₀ + Ft − J and ∫μ x v dx = F x_F t − Σ x_i J_i, but for what turns the sections."""
    found, given = [], beam.push * 0.2
    assert beam.lifts == (given < 0.0), "a pull lifts the zone"
    assert beam.load_within(1.0, 2) == pytest.approx(beam.push * beam.push_at**2), "∫x²p dx"
    for path in (HermiteFE(refine=0.5), ExudynModel(refine=0.5)):
        history = path.for_whole_beam(beam).simulate(beam, end_time=0.2, save=400)
        assert not [text for text in history.warnings if "mesh" in text]
        found.append(float(history.array("total_impulse")[-1]))
        x, v = history.positions(-1), history.array("velocity")[-1]
        mean = np.trapezoid(v, x) * 2.0 / history.sides
        assert mean == pytest.approx(2.0 + given - found[-1], rel=1e-3, abs=1e-3 * abs(given))
        if beam.push_at:
            turned = np.trapezoid(x * v, x) + history.array("impulse")[-1] @ history.contact_positions(-1)
            assert turned == pytest.approx(given * beam.push_at, rel=1e-2)
    assert found[0] == pytest.approx(found[1], rel=alike, abs=1e-2)


@pytest.mark.parametrize("path", [HermiteFE, ExudynModel])
def test_a_force_acts_alike_in_whatever_units_it_is_given(path) -> None:
    """Lengths are three, times two and masses five times as large."""
    one, impulses = pushed(2.0, -0.4), []
    for beam in (one, in_units(one, {"kg": 5.0, "m": 3.0, "s": 2.0})):
        mesh = UniformMesh(0.05 * beam.length)
        run = path(mesh=mesh).for_whole_beam(beam).simulate(beam, end_time=0.1 * beam.slow_time_scale, save=10)
        impulses.append(run.array("total_impulse"))
    assert impulses[1] == pytest.approx(7.5 * impulses[0], rel=1e-6, abs=1e-6)


@pytest.mark.verify
@pytest.mark.parametrize(("refine", "within"), [(1.0, 0.1), (2.0, 0.02)])
def test_a_force_far_from_the_first_touch_brings_the_beam_to_the_wall_there(refine, within) -> None:
    """Without one Exudyn models no more of a beam than the first touch needs, and lets it touch there alone. Its usual
    elements there are too coarse for nodes as fast as 1e3 V₀, which then enter the wall: it says so."""
    methods = (HermiteFE(), ExudynModel(refine=refine))
    hermite, exudyn = (method.simulate(pushed(1e6, 0.6), end_time=3e-4, save=50) for method in methods)
    far = [run.array("impulse")[-1][np.abs(run.contact_positions(-1) - 0.6) < 0.1].sum() for run in (hermite, exudyn)]
    assert far[0] > 200.0 and far[1] == pytest.approx(far[0], rel=within)
    assert hermite.warnings == [] and any("enters the wall" in said for said in exudyn.warnings)


def test_a_force_without_effect_or_beyond_the_mesh_is_refused() -> None:
    with pytest.raises(ValueError, match="push_at: push has no effect on an end that is held"):
        pushed(1.0, 1.0, right_end="hinged")
    with pytest.raises(ValueError, match="push_at has no effect without push"):
        pushed(0.0, 0.5)
    with pytest.raises(ValueError, match=r"mesh must reach as far as the force at 0\.9 m"):
        ExudynModel(mesh=NodesMesh((0.0, 0.2, 0.4))).simulate(pushed(1.0, 0.9), end_time=1e-3)
