"""The springs and dashpots of a wall that gives way, at the nodes:

    R_i = b_i max(0, k y_i + c ẏ_i) where y_i > 0, 0 elsewhere,   b_i the length of beam that node i stands for.

They are the wall's own, not a numerical device: k and c do not change with the mesh, what the springs hold is an
energy. With c each node that lands adds b c V₀ at once: the largest force is too high by a part that falls like Δx.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bent_beam import Impact
from exudyn_models.arrays import Array, Flags
from exudyn_models.contacts.base import Contact, ContactRun, Wall
from exudyn_models.contacts.holding import HeldStrip
from exudyn_models.contacts.penalty import PenaltyRun
from exudyn_models.elements import Beam, Element
from exudyn_models.integrators import Integrator, Trapezoidal
from exudyn_models.solvers import NewtonSolver

__all__ = ["Springs"]


class _Run(PenaltyRun):
    @property
    def wall_springs(self) -> Array:  # type: ignore[override]
        return self.stiffness

    def closed_by(self, q: Array, v: Array) -> Flags:
        return np.asarray((self.depth(q) > 0.0) & super().closed_by(q, v))


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

    def solver(self) -> NewtonSolver:
        """What elements much shorter than the zone leave as round-off is no residual."""
        return NewtonSolver(absolute_tolerance=1e-6)

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        assert wall.stiffness is not None
        length = beam.tributary[wall.nodes]
        strip = HeldStrip(wall, hold=0, start=0.0)
        return _Run(beam, wall, wall.stiffness * length, wall.damping * length, strip, {})
