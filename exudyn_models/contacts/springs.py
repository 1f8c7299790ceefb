"""The springs and dashpots of a wall that gives way, at the nodes:

    R_i = max(0, k b_i y_i + c w_i ẏ_i) where y_i > 0, 0 elsewhere,   b_i the length of wall that node i stands for.

They are the wall's own, not a numerical device: k and c do not change with the mesh, what the springs hold is an
energy. A dashpot pushes as soon as it is touched: with w_i = b_i each node that lands would add c b_i V₀ at once. So
w_i is the length that is covered. Of an element with both nodes in the wall each has Δx/2, and node i alone has sΔx,
s = y_i/(y_i − y_{i+1}), where the velocities carry the beam by the end of the next step.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from bent_beam import Impact
from exudyn_models.arrays import Array, Flags
from exudyn_models.contacts.base import Contact, ContactRun, HeldStrip, Wall
from exudyn_models.contacts.penalty import PenaltyRun
from exudyn_models.elements import Beam, Element
from exudyn_models.integrators import Integrator, Trapezoidal
from exudyn_models.solvers import NewtonSolver

__all__ = ["Springs"]


def covered(depth: Array, lengths: Array) -> Array:
    """w of all nodes, (nodes,), at such depths, elements of ``lengths``, (nodes − 1,), between them."""
    left, right, found = depth[:-1], depth[1:], np.zeros(depth.size)
    with np.errstate(divide="ignore", invalid="ignore"):
        for node, other, end in ((left, right, found[:-1]), (right, left, found[1:])):
            share = np.where(other > 0.0, 0.5, node / (node - other))
            end += np.where(node > 0.0, share, 0.0) * lengths
    return found


class _Run(PenaltyRun):
    def __init__(self, beam: Beam, wall: Wall, stiffness: float) -> None:
        strip = HeldStrip(wall, hold=0, start=0.0)
        super().__init__(beam, wall, stiffness * wall.weights, wall.damping * wall.weights, strip, {})
        self.wall, self.wall_springs = wall, self.stiffness

    def between(self, time: float, step: float, q: Array, v: Array) -> bool:
        if self.wall.damping and not self.wall.stop:
            at, wall_y = self.beam.vertical, self.beam.shape.wall_y
            share = covered(q[at] + step * v[at] - wall_y, self.wall.lengths)
            damping = self.wall.damping * share[self.nodes]
            for k in np.flatnonzero(damping != self.damping):
                self.beam.mbs.SetObjectParameter(self.contacts[k], "contactDamping", float(damping[k]))
            self.damping = damping
        return False

    def closed_by(self, q: Array, v: Array) -> Flags:
        return np.asarray((self.depth(q) > 0.0) & super().closed_by(q, v))


@dataclass(frozen=True)
class Springs(Contact):
    """What stands in the place of a contact where the wall has a stiffness; it has no settings of its own."""

    integrator: ClassVar[Integrator] = Trapezoidal()  # conserves energy: an elastic wall gives back what it took
    # what elements much shorter than the zone leave as round-off is no residual
    solver: ClassVar[NewtonSolver] = NewtonSolver(absolute_tolerance=1e-6)

    def refuses(self, impact: Impact, element: Element, integrator: Integrator) -> str | None:
        if impact.opposite_wall is not None:
            return f"wall_stiffness is modelled without opposite_wall only (got {impact.opposite_wall!r})"
        if integrator.explicit:
            return f"wall_stiffness needs an implicit exudyn.integrator (got {type(integrator).__name__})"
        return None

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        assert wall.stiffness is not None
        return _Run(beam, wall, wall.stiffness)
