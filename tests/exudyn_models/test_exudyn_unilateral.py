"""The wall pushes and never pulls, and no energy comes from it: random physical problems, default method."""

import numpy as np
import pytest
from random_beams import beam_with, hold_for_many, never_pulled_nor_driven

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from exudyn_models import ExudynModel
from exudyn_models.integrators import GeneralizedAlpha


def drawn(generator):
    """Damped a little, as steel is."""
    return beam_with(generator, (0.05, 5.0), 1.0, (0.0, 1e-4, 1e-3, 1e-2))


def check(impact, refine=1.0):
    history = ExudynModel(refine=refine).simulate(impact, end_time=0.5 * impact.slow_time_scale, save=200)
    never_pulled_nor_driven(history, 1e-9, 1e-3, 1e-2)


def test_the_wall_never_pulls_and_gives_no_energy():
    check(drawn(np.random.default_rng(1)), refine=0.5)


@pytest.mark.verify
def test_the_wall_never_pulls_and_gives_no_energy_in_many_problems():
    """``BEAMS=300`` for a long run; the seed is printed."""
    hold_for_many(drawn, check, 20)


def test_steps_too_long_for_the_contact_give_energy_and_the_run_says_so():
    """A reaction that a step starts with acts on, half as strong, after the node has left."""
    impact = Impact.dimensionless(1.128, length=2.0)
    method = ExudynModel(mesh=UniformMesh(0.01), integrator=GeneralizedAlpha(relative_step=8e-3))
    history = method.simulate(impact, end_time=0.5, save=100)
    assert history.array("loss_impact").min() < -0.01 * history.energy_budget()["initial_energy"]
    assert any("the contact gave" in warning for warning in history.warnings)
