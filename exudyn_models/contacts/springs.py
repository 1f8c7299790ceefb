"""The springs of a wall that gives way, at the nodes: R_i = b_i max(0, k y_i), b_i the length of beam of node i.

They are the wall's own, not a numerical device: k does not change with the mesh, and what they hold is an energy.
"""

from __future__ import annotations

from dataclasses import dataclass

from bent_beam import Impact
from exudyn_models.contacts.base import Contact, ContactRun, Wall
from exudyn_models.contacts.holding import HeldStrip
from exudyn_models.contacts.penalty import PenaltyRun
from exudyn_models.elements import Beam, Element
from exudyn_models.integrators import Integrator, Trapezoidal

__all__ = ["Springs"]


@dataclass(frozen=True)
class Springs(Contact):
    """What stands in the place of a contact where the wall has a stiffness; it has no settings of its own."""

    def refuses(self, impact: Impact, element: Element, integrator: Integrator) -> str | None:
        if impact.opposite_wall is not None:
            return f"wall_stiffness is modelled without opposite_wall only (got {impact.opposite_wall!r})"
        if integrator.explicit:
            return f"wall_stiffness needs an implicit exudyn.integrator (got {type(integrator).__name__})"
        return None

    def integrator(self) -> Integrator:
        """It conserves energy: an elastic wall gives back what it took."""
        return Trapezoidal()

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        assert wall.stiffness is not None
        length = beam.tributary[wall.nodes]
        strip = HeldStrip(wall, hold=0, start=0.0)
        return PenaltyRun(beam, wall, wall.stiffness * length, 0.0 * length, strip, {})
