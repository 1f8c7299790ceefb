"""A step goes on when its contact state has settled, and a run that never settles says so."""

import numpy as np
import pytest

import exudyn_models
from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from exudyn_models.contacts import SegmentFriction
from exudyn_models.settling import ANY, Settling
from exudyn_models.solvers import NewtonSolver

SHORT = Impact.dimensionless(0.5, length=8.0)
MESH = UniformMesh(0.1)


def test_a_run_whose_contact_need_not_settle_says_how_often_it_did_not():
    """Where it must, the run fails (``test_exudyn_refusals.py``)."""
    solver = NewtonSolver(contact_iterations=1, contact_must_settle=False)
    history = exudyn_models.simulate(SHORT, mesh=MESH, solver=solver, save=20)
    assert history.settings["unsettled_steps"] > 0
    assert any("had not settled" in warning for warning in history.warnings)


@pytest.mark.parametrize("contact", [None, SegmentFriction()])
def test_with_no_setting_every_step_settles(contact):
    history = exudyn_models.simulate(SHORT, mesh=MESH, contact=contact, save=20)
    assert history.settings["unsettled_steps"] == 0
    assert history.settings["contact_cycles"] < 0.05 * history.steps


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
        settling = Settling(contact, 300, 1e-9)
        contact.solve()
        while settling(contact, 1.0)[0] > ANY and not settling.unsettled:
            contact.solve()
        assert settling.unsettled == 0
        assert settling.cycles or min(contact.forces.min(), contact.gaps.min()) >= -1e-9
