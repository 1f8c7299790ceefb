"""Rigid contact: constraints switched with the contact state (Exudyn's ``CoordinateConstraint``), no penalty.

    ẏ_i = −c y_i/h while captured,   R_i = λ_i ≥ 0,   0 ≤ R_i ⊥ −y_i ≥ 0

λ_i is Exudyn's multiplier: a force −λ_i along y, so off the wall. Every node that may touch carries a constraint on its
velocity (index 2), inactive until, between two steps, the node is found at the wall; its velocity then vanishes within
one step, the impact of restitution e = 0. It is released when it pulls, but not before the front is ``hold`` elements
further on (:mod:`exudyn_models.contacts.base`). In each step it is led back by the share c of its depth (Baumgarte
1972, Comput. Methods Appl. Mech. Eng. 1, 1). Why, and why only Newmark with γ > ½ is accepted: docs/exudyn.md.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import exudyn.itemInterface as items
import numpy as np

from bent_beam import Impact
from exudyn_models.contacts.base import Contact, ContactRun, HeldStrip, Hold, Wall
from exudyn_models.elements import Beam, Element
from exudyn_models.geometry import Array, Flags, Indices
from exudyn_models.integrators import Integrator, Newmark

RETURN = 0.2  # of its depth in a step: how fast a captured node is led back to the wall


class _Run(ContactRun):
    iterated = False

    def __init__(self, beam: Beam, wall: Wall, hold: int) -> None:
        super().__init__(beam, wall.nodes, beam.shape.wall_y[wall.nodes])
        self.strip: HeldStrip = HeldStrip(wall, hold)
        self.active = np.zeros(wall.nodes.size, bool)
        self.back = np.zeros(wall.nodes.size)  # speed asked of each closed node
        for node in wall.nodes:
            markers = [beam.ground_marker, beam.marker(int(node), beam.vertical_coordinate)]
            constraint = items.CoordinateConstraint(markerNumbers=markers, velocityLevel=True, activeConnector=False)
            self.connectors.append(beam.mbs.AddObject(constraint))

    @cached_property
    def _multipliers(self) -> Indices:
        """Of the constraints in the system's vectors, known once it is assembled."""
        return np.array([self.beam.mbs.systemData.GetObjectLTGAE(number)[0] for number in self.connectors])

    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        force = self.beam.mbs.systemData.GetAECoordinates()[self._multipliers]
        return np.where(self.active, force, 0.0), self.active.copy()

    def between(self, time: float, step: float, q: Array, v: Array) -> bool:
        force, _ = self.forces(q, v)
        depth = self.depth(q)
        touching = (depth >= 0.0) & ~self.active
        if time == 0.0:
            touching &= v[self.coordinates] > 0.0
        self.strip.captured |= touching
        wanted = (self.active & (force >= 0.0)) | touching | self.strip.wanted(time)
        changed = np.flatnonzero(wanted != self.active)
        for k in changed:
            self.beam.mbs.SetObjectParameter(self.connectors[k], "activeConnector", bool(wanted[k]))
        self.active = wanted
        back = -RETURN * depth / step
        for k in np.flatnonzero(wanted & (back != self.back)):
            self.beam.mbs.SetObjectParameter(self.connectors[k], "offset", float(back[k]))
        self.back = np.where(wanted, back, self.back)
        return bool(changed.size)


@dataclass(frozen=True)
class Rigid(Contact):
    """Constraints switched with the contact state; needs the Newmark integrator with γ > ½."""

    integrator: ClassVar[Integrator] = Newmark()

    hold: Hold = 0

    def refuses(self, impact: Impact, element: Element, integrator: Integrator) -> str | None:
        if impact.opposite_wall is not None:
            return "exudyn.contact.kind rigid knows one wall only: take penalty (opposite_wall is given)"
        if isinstance(integrator, Newmark) and integrator.gamma > 0.5:
            return None
        return (
            "exudyn.contact.kind rigid needs exudyn.integrator.kind newmark with gamma above 0.5: constraints at "
            f"velocity level, and damping (got {type(integrator).__name__})"
        )

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        return _Run(beam, wall, self.hold)
