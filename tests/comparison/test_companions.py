"""Which companions a question has, and at which instants they are read."""

import dataclasses

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from comparison.bouncing import problem
from comparison.questions import Question
from hermite_fe import HermiteFE
from hermite_fe.contacts import NodeContact
from hermite_fe.integrators import MoreauJean

COARSE = HermiteFE(mesh=UniformMesh(1.0 / 25))


def test_few_saved_instants_hold_the_time_that_is_asked_for() -> None:
    for save in (8, 10, 21, 200):
        question = Question(Impact.whole_beam(2.0, relative_damping=1e-2), COARSE, 0.05, save)
        history = question.run(question.run_by)
        assert np.abs(history.time - 0.05).min() < 5e-4 and history.time[-1] == pytest.approx(0.055, abs=5e-4)


def test_the_companion_that_absorbs_no_waves_has_ten_elements_in_the_root_of_time() -> None:
    """It is run of hardly any damping, η < 3e-5 T*, from 1e-5 T* on, and until waves have run: 3e-3 T*."""
    _, other = Question(problem(0.5, 0.0), HermiteFE(), 1e-4).companions()["waves_absorbed"]
    assert other.mesh.element_length == pytest.approx(0.1 * 1e-4**0.5)
    asked = ((2.9e-5, 1.1e-5), (2.9e-5, 2.9e-3), (3.1e-5, 1e-4), (2.9e-5, 0.9e-5), (2.9e-5, 3.1e-3))
    found = [Question(problem(0.5, damping), HermiteFE(), until).companions() for damping, until in asked]
    assert ["waves_absorbed" in one for one in found] == [True, True, False, False, False]


def test_the_companion_of_nodes_that_rebound_has_nodes_that_do_not() -> None:
    impact = problem(0.5, 1e-3)
    rebounding = dataclasses.replace(COARSE, integrator=MoreauJean(theta=0.5), contact=NodeContact(restitution=0.5))
    (other,) = rebounding.cross_checks(impact).values()
    assert isinstance(other.contact, NodeContact) and other.contact.restitution == 0.0
