"""Adhesion with a largest pull, a contact law of somebody's own: one part says how hard closed rows may pull."""

from dataclasses import dataclass
from typing import Annotated

import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory
from bent_beam.fields import Quantity
from bent_beam.meshes import UniformMesh
from hermite_fe import simulate
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.integrators import Integrator, MoreauJean, SignoriniPosition
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System

STEP, ELEMENT = 1e-4, 0.02
SCHEMES = pytest.mark.parametrize("scheme", [SignoriniPosition(STEP), MoreauJean(STEP, theta=0.5)], ids=str)


@dataclass(frozen=True)
class AdhesiveContact(NodeContact):
    """Contact at nodes; the wall pulls those that have touched, with so much at most."""

    pull: Annotated[float, Quantity("N/m", "largest pull per length of beam", least=0.0)] = 0.0

    def law(self, rows: ContactRows, hold_ends: float) -> ContactLaw:
        return super().law(rows, hold_ends)._replace(strength=self.pull * rows.tributary)


def run(scheme: Integrator, contact: Contact, end: float = 0.004) -> ImpactHistory:
    """A whole beam, step by step; by itself it leaves the wall at 0.2 T*, and nothing else is held after 0.005 T*."""
    every = np.linspace(0.0, end, round(end / STEP) + 1)[1:]
    mesh = UniformMesh(ELEMENT)
    return simulate(Impact.whole_beam(0.3), end_time=end, mesh=mesh, integrator=scheme, contact=contact, save=every)


@SCHEMES
def test_adhesion_lies_between_a_wall_that_only_pushes_and_one_that_holds(scheme: Integrator) -> None:
    """To the last digit it is the one without strength, the other beyond any pull. In between no pull exceeds it, and
    what gives way gains no energy."""
    for pull, other in ((0.0, NodeContact()), (1e9, NodeContact(hold_until=1.0))):
        one, two = run(scheme, AdhesiveContact(pull=pull)), run(scheme, other)
        assert all(np.array_equal(one.array(name), two.array(name)) for name in ("gap", "impulse", "held_impulse"))
        assert (one.array("held_impulse")[-1] < 0.0) == (pull > 0.0)
    history = run(scheme, AdhesiveContact(pull=300.0), 0.3)
    force = np.diff(history.array("impulse"), axis=0)[:, 1:-1] / STEP
    assert 0.95 * 300.0 < -force.min() / ELEMENT < 300.0 * (1.0 + 1e-9)
    assert not history.array("in_contact")[-1].any()
    assert abs(history.energy_budget()["defect"]) < 1e-11
    assert run(scheme, AdhesiveContact(pull=1e9), 0.3).array("in_contact")[-1].any()


@SCHEMES
@pytest.mark.parametrize("strength", [0.0, 1.0, 3.0])
def test_a_weight_that_is_lifted_leaves_when_the_lift_exceeds_the_strength(scheme: Integrator, strength: float) -> None:
    """The load −2 + 4t on a mass on the wall: it leaves at t = (2 + F)/4, and has been pulled by F²/8 until then."""
    system = System([[1.0]], [[0.0]], ContactRows([[0]], [[1.0]], [0.0]), load=[[-2.0], [4.0]])
    law = ContactLaw(strength=np.array([strength]))
    found = integrate(system, np.zeros(1), np.zeros(1), scheme, 1.5, law=law, save=1500)
    assert found.time[found.closed[:, 0]].max() == pytest.approx((2.0 + strength) / 4.0, abs=3e-3)
    assert found.held_impulse[-1, 0] == pytest.approx(-(strength**2) / 8.0, abs=2e-3)
