"""Contact along the segments of the cable with Coulomb friction (Exudyn's ``ObjectContactFrictionCircleCable2D``).

    f_n = k g + d ġ per segment while it enters the wall,   |f_t| ≤ μ_f f_n

Exudyn knows this contact against a circle only, and computes its gap as a difference of lengths of the order of the
radius: too large
a circle drowns it in round-off. So the wall takes over a share of the beam's curvature, against which the beam is
laid flatter: all
of it in the linear limit (gap, load and elastic forces are the same to first order), a quarter with the true
geometry. Friction works along the beam: of second order in
the deflection, it changes nothing in the linear limit and little for a real, axially stiff beam.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import exudyn.itemInterface as items
import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import non_negative, positive
from exudyn_models.contacts.base import ContactRun, Flags, Wall
from exudyn_models.contacts.penalty import penalty_per_length
from exudyn_models.elements import ANCFCable, Beam
from exudyn_models.geometry import Geometry, LinearLimit
from exudyn_models.solvers import NewtonSolver

__all__ = ["SegmentFriction"]

Array = NDArray[np.float64]
TRUE_SHARE = 0.25  # of the curvature, true geometry


class _Run(ContactRun):
    """Contact points are the elements' middles: Exudyn's segment is the chord of an element."""

    def __init__(self, beam: Beam, elements: NDArray[np.int64], stiffness: Array, damping: Array) -> None:
        self.beam, self.elements = beam, elements
        self.stiffness, self.damping = stiffness, damping
        s = beam.shape.s
        self.contact_s = (s[elements] + s[elements + 1]) / 2
        self.wall_y = beam.shape.wall_curvature * self.contact_s**2 / 2

    def _middle(self, values: Array) -> Array:
        nodal = values[self.beam.vertical]
        return np.asarray((nodal[self.elements] + nodal[self.elements + 1]) / 2)

    def depth(self, q: Array) -> Array:
        return np.asarray(self._middle(q) - self.wall_y)

    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        # only how the known total is shared among the contact points: Exudyn reports no force of this connector
        depth = self.depth(q)
        active = depth > 0.0
        force = self.stiffness * depth + self.damping * self._middle(v)
        return np.where(active, force, 0.0), active

    def velocity(self, q: Array, v: Array) -> Array:
        return self._middle(v)


@dataclass(frozen=True)
class SegmentFriction:
    """Penalty on the segments of ANCF cables, with friction.

    friction : Coulomb's coefficient.
    relative_stiffness, relative_damping : as for the nodal penalty, in EI/Δx⁴ and √(EIμ)/Δx².
    relative_friction_damping : tangential force per sliding velocity below Coulomb's limit, in √(EIμ)/Δx².
    """

    friction: float = 0.0
    relative_stiffness: float = 10.0
    relative_damping: float = 3.0
    relative_friction_damping: float = 1.0

    def __post_init__(self) -> None:
        non_negative("exudyn.contact.friction", self.friction)
        positive("exudyn.contact.relative_stiffness", self.relative_stiffness)
        non_negative("exudyn.contact.relative_damping", self.relative_damping)
        positive("exudyn.contact.relative_friction_damping", self.relative_friction_damping)

    def refuses(self, element: Any, integrator: Any) -> str | None:
        if not isinstance(element, ANCFCable):
            return (
                "exudyn.contact.kind segment_friction works on ANCF cables only: take exudyn.element.kind ancf_cable "
                f"(got {type(element).__name__})"
            )
        if integrator.explicit:
            return (
                "exudyn.contact.kind segment_friction needs an implicit exudyn.integrator "
                f"(got {type(integrator).__name__})"
            )
        return None

    def geometry(self) -> LinearLimit:
        """Amplitude that keeps the circle small enough for its round-off, ε·k/K, to stay below the contact force."""
        return LinearLimit(amplitude=0.02)

    def solver(self) -> NewtonSolver:
        """Tolerances above that round-off."""
        return NewtonSolver(absolute_tolerance=1e-3, contact_tolerance=1e-2)

    def wall_share(self, geometry: Geometry) -> float:
        """The share of the beam's curvature that the round wall takes over."""
        return TRUE_SHARE if geometry.true else 1.0

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        mbs, lengths = beam.mbs, beam.lengths
        radius = 1.0 / beam.shape.wall_curvature
        k, d = penalty_per_length(lengths, self.relative_stiffness, self.relative_damping)
        tangential = self.relative_friction_damping / lengths**2
        ground = mbs.AddObject(items.ObjectGround())
        circle = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=[0.0, radius, 0.0]))
        elements = np.arange(max(0, int(wall.nodes[0]) - 1), min(lengths.size, int(wall.nodes[-1]) + 1))
        for e in elements:
            marker = mbs.AddMarker(items.MarkerBodyCable2DShape(bodyNumber=beam.bodies[e], numberOfSegments=1))
            state = mbs.AddNode(
                items.NodeGenericData(numberOfDataCoordinates=3, initialCoordinates=[0.1, -2.0, 0.0])
            )  # open, neither sticking nor slipping
            mbs.AddObject(
                items.ObjectContactFrictionCircleCable2D(
                    markerNumbers=[circle, marker],
                    nodeNumber=state,
                    numberOfContactSegments=1,
                    contactStiffness=k[e] * lengths[e],
                    contactDamping=d[e] * lengths[e],
                    circleRadius=radius,
                    frictionCoefficient=self.friction,
                    frictionVelocityPenalty=tangential[e] * lengths[e] if self.friction else 0.0,
                    useSegmentNormals=False,
                )
            )
        return _Run(beam, elements, (k * lengths)[elements], (d * lengths)[elements])
