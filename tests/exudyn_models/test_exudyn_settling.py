"""A step goes on when its contact state has settled, and a run that never settles says so."""

from types import SimpleNamespace

import numpy as np
import pytest

import exudyn_models
from bent_beam import Impact, SimulationError
from bent_beam.meshes import UniformMesh
from exudyn_models.contacts import SegmentFriction
from exudyn_models.settling import Settling
from exudyn_models.solvers import NewtonSolver

SHORT = Impact.dimensionless(0.5, length=8.0)
MESH = UniformMesh(0.1)


class Scripted:
    """A system and its contact: solutions that assume the given states and contradict them at the given connectors."""

    states, imposes = 1, False

    def __init__(self, *steps):
        self.steps, self.systemData = iter(steps), self

    def GetDataCoordinates(self):
        state, self.forces = next(self.steps)
        return -np.array(state, float) + 0.5

    def GetODE2Coordinates(self):
        return np.zeros(0)

    GetODE2Coordinates_t = GetODE2Coordinates

    def contradictions(self, q, v, closed):
        return np.array(self.forces)


def judged(*steps, iterations=10, time=1.0):
    """Repetitions until the step was accepted or its repetitions had run out."""
    solver = SimpleNamespace(it=SimpleNamespace(discontinuousIteration=0))
    script = Scripted(*steps)
    settling = Settling(script, solver, iterations, 0.5, must_settle=True)
    for count in range(1, iterations + 1):
        settling(script, time)
        if solver.it.discontinuousIteration == iterations - 1:
            return settling, count
    return settling, iterations


def test_a_state_that_its_gaps_confirm_is_accepted_at_once():
    settling, count = judged(((1, 0), (0.4, 0.0)))
    assert (count, settling.cycles, settling.unsettled) == (1, 0, 0)


def test_a_state_that_settles_later_takes_as_many_repetitions():
    settling, count = judged(((0, 0), (9.0, 0.0)), ((1, 0), (0.0, 3.0)), ((1, 1), (0.1, 0.0)))
    assert (count, settling.cycles, settling.unsettled) == (3, 0, 0)


def test_of_a_cycle_the_state_that_contradicts_itself_least_is_accepted():
    """Neither the state before the cycle counts, which never returns, nor a connector that hovers without force."""
    settling, count = judged(
        ((0, 0, 0), (0.6, 0.6, 0.0)),
        ((1, 0, 1), (0.0, 4.0, 0.1)),
        ((1, 1, 0), (0.0, 2.0, 0.1)),
        ((1, 0, 0), (0.0, 4.001, 0.1)),
        ((1, 1, 1), (0.0, 2.001, 0.1)),
    )
    assert (count, settling.cycles, settling.unsettled) == (5, 1, 0)


def test_repetitions_that_run_out_are_counted_and_described():
    settling, _ = judged(
        ((0, 0, 0), (4.0, 0.0, 0.0)), ((1, 0, 0), (0.0, 3.0, 0.0)), ((1, 1, 0), (0.0, 0.0, 2.0)), iterations=3
    )
    assert settling.unsettled == 1 and "3 repetitions" in settling.failure() and "4 contact_tol" in settling.failure()


def test_a_run_whose_contact_does_not_settle_fails_with_what_to_change_and_the_history_so_far():
    with pytest.raises(SimulationError, match="settled") as failure:
        exudyn_models.simulate(SHORT, mesh=MESH, solver=NewtonSolver(contact_iterations=1))
    error = failure.value
    assert "contact_iterations" in str(error)
    assert error.history is not None and not error.history.completed
    assert np.isfinite(error.history.array("gap")).all()


def test_a_run_that_need_not_settle_goes_on_and_counts():
    history = exudyn_models.simulate(
        SHORT, mesh=MESH, solver=NewtonSolver(contact_iterations=1, contact_must_settle=False), save=20
    )
    assert history.settings["unsettled_steps"] > 0
    assert any("had not settled" in warning for warning in history.warnings)


@pytest.mark.parametrize("contact", [None, SegmentFriction()])
def test_with_no_setting_every_step_settles(contact):
    history = exudyn_models.simulate(SHORT, mesh=MESH, contact=contact, save=20)
    assert history.settings["unsettled_steps"] == 0
    assert history.settings["contact_cycles"] < 0.05 * history.steps


@pytest.mark.parametrize("where", ["__call__", "_impose"])
def test_an_interrupt_while_exudyn_calls_back_is_an_interrupt_and_no_failure_of_the_run(where, monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(Settling, where, interrupted)
    with pytest.raises(KeyboardInterrupt):
        exudyn_models.simulate(SHORT, mesh=MESH, save=20)
