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


class Pressed:
    """0 ≤ p ⊥ M p − c ≥ 0 in the place of a system and its contact: p are forces, M p − c gaps."""

    states, imposes = 1, True

    def __init__(self, flexibility, penetration):
        self.flexibility, self.penetration, self.systemData = flexibility, penetration, self
        self.data, self.hook = np.ones(penetration.size), lambda *_: None

    def SetPreNewtonResidualUserFunction(self, hook):
        self.hook = hook

    def SetDataCoordinates(self, data):
        self.data = data

    def GetDataCoordinates(self):
        return self.data

    def solve(self):
        self.hook(self, 0.0, 0, 0)
        closed = self.data <= 0.0
        self.forces = np.zeros(closed.size)
        self.forces[closed] = np.linalg.solve(self.flexibility[np.ix_(closed, closed)], self.penetration[closed])
        self.gaps = np.where(closed, 0.0, self.flexibility @ self.forces - self.penetration)

    def GetODE2Coordinates(self):
        return self.forces

    def GetODE2Coordinates_t(self):
        return self.gaps

    def closed_by(self, forces, gaps):
        return (forces > 0.0) | (gaps < 0.0)

    def contradictions(self, forces, gaps, closed):
        return np.maximum(np.where(closed, -forces, -gaps), 0.0)


def test_a_stiff_chain_pressed_at_random_settles():
    """Sixty contacts a fourth derivative apart: one at a time from the last on, and never all again, runs out."""
    count = 60
    bending = np.diff(np.eye(count + 4), 4, axis=0)[:, :count]
    flexibility = np.linalg.inv(1e-3 * np.eye(count) + bending.T @ bending)
    for seed in range(10):
        contact = Pressed(flexibility, np.random.default_rng(seed).normal(size=count))
        solver = SimpleNamespace(it=SimpleNamespace(discontinuousIteration=0))
        settling = Settling(contact, solver, 300, 1e-9, must_settle=True)
        while not (solver.it.discontinuousIteration or settling.unsettled):
            contact.solve()
            settling(contact, 1.0)
        assert settling.unsettled == 0
        assert settling.cycles or min(contact.forces.min(), contact.gaps.min()) >= -1e-9
