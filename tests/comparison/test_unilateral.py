"""Whole beams drawn at random, by the default methods: no wall pulls, and none gives energy."""

from functools import partial

import numpy as np
import pytest
from random_beams import beam_with, hold_for_many, never_pulled_nor_driven

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from exudyn_models.integrators import GeneralizedAlpha
from hermite_fe import HermiteFE
from hermite_fe.integrators import SignoriniPosition

# Beams (κ/ν, load and dampings of ``beam_with``; steel damps a little), instants, what is let pass: pull, gain, defect
PATHS = {
    HermiteFE: (((0.01, 3.0), 3.0), 100, (1e-6, 1e-9, 1e-9)),
    ExudynModel: (((0.05, 5.0), 1.0, (0.0, 1e-4, 1e-3, 1e-2)), 200, (1e-9, 1e-3, 1e-2)),
}


def drawn(path, generator):
    return beam_with(generator, *PATHS[path][0])


def check(path, impact, refine=1.0):
    _, save, within = PATHS[path]
    never_pulled_nor_driven(
        path(refine=refine).simulate(impact, end_time=0.5 * impact.slow_time_scale, save=save), *within
    )


@pytest.mark.parametrize(
    ("path", "seed", "refine"),
    [*((HermiteFE, [11, number], 1.0) for number in (1, 2, 4, 5)), (ExudynModel, 1, 0.5)],
    ids=["lifted", "pressed", "a lifted thin front", "free", "Exudyn"],
)
def test_the_wall_never_pulls_and_gives_no_energy(path, seed, refine):
    check(path, drawn(path, np.random.default_rng(seed)), refine)


@pytest.mark.verify
@pytest.mark.parametrize(("path", "count"), [(HermiteFE, 300), (ExudynModel, 20)])
def test_the_wall_never_pulls_and_gives_no_energy_in_many_problems(path, count):
    """``BEAMS=10000`` for a long run; the seed is printed."""
    hold_for_many(partial(drawn, path), partial(check, path), count)


@pytest.mark.parametrize("length", [1.0, 2.0, 3.0])
def test_long_steps_on_a_short_beam_settle(length):
    """Exchanging many rows at once runs in a circle there; the fall-back does not."""
    impact = Impact.dimensionless(0.5, length=length)
    history = HermiteFE(integrator=SignoriniPosition(growth=0.01)).simulate(impact, end_time=0.1, save=20)
    assert history.completed
    assert abs(history.energy_budget()["defect"]) < 1e-9


def test_steps_too_long_for_the_contact_give_energy_and_the_run_says_so():
    """On the Exudyn path: a reaction that a step starts with acts on, half as strong, after the node has left."""
    impact = Impact.dimensionless(1.128, length=2.0)
    method = ExudynModel(mesh=UniformMesh(0.01), integrator=GeneralizedAlpha(relative_step=8e-3))
    history = method.simulate(impact, end_time=0.5, save=100)
    assert history.array("loss_impact").min() < -0.01 * history.energy_budget()["initial_energy"]
    assert any("the contact gave" in warning for warning in history.warnings)
