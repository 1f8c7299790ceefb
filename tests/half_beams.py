"""Half of a bent beam on equal elements, as tests of steps take it."""

from __future__ import annotations

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Integrator
from hermite_fe.model import BeamModel, beam_model
from hermite_fe.run import Stepper

__all__ = ["NODES", "half_beam", "stepper"]

NODES = NodeContact(hold=0, hold_until=0.0)


def half_beam(contact: Contact = NODES, *, kappa: float, half_length: float, nodes: int) -> BeamModel:
    """In units of the fast layer, with viscosity at grid scale."""
    impact = Impact.dimensionless(kappa, length=2.0 * half_length)
    mesh = UniformMesh(half_length / (nodes - 1)).nodes(half_length)
    return beam_model(impact, mesh, contact, GridViscosity(), full=False)


def stepper(model: BeamModel, integrator: Integrator, end_time: float = 1.0) -> Stepper:
    """A run from the first touch on."""
    return Stepper(model.system, model.displacement, model.velocity, integrator, end_time)
