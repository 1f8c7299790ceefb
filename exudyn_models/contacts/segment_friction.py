"""Contact along the segments of the cable with Coulomb friction (Exudyn's ``ObjectContactFrictionCircleCable2D``).

    f_n = k g + d ġ per segment while it enters the wall,   |f_t| ≤ μ_f f_n

Exudyn knows this contact against a circle only, and too large a circle drowns the gap in round-off. So the wall takes
over a share of the beam's curvature, against which the beam is laid flatter: all of it in the linear limit (gap, load
and elastic forces are the same to first order; an axial force is refused, as it acts on the bow), a quarter with the
true geometry. Friction works along the beam: of second order in the deflection, it changes nothing in the linear
limit and little for an axially stiff beam.
"""

from dataclasses import dataclass, replace
from typing import Annotated, ClassVar

import exudyn.itemInterface as items
import numpy as np

from bent_beam import Impact
from bent_beam.fields import Quantity
from bent_beam.loads import UNSHEARED
from exudyn_models.contacts.base import Contact, ContactRun, Wall
from exudyn_models.elements import ANCFCable, Beam, Element
from exudyn_models.geometry import Array, Flags, Geometry, Indices, LinearLimit
from exudyn_models.integrators import Integrator
from exudyn_models.solvers import USUAL, NewtonSolver

TRUE_SHARE = 0.25  # of the curvature, true geometry
OPEN = [0.1, -2.0, 0.0]  # an open segment: gap, code (Exudyn's: 0 sticks, ±1 slips, −2 neither), where it sticks


class _Run(ContactRun):
    """Contact points are the nodes: Exudyn's segment is the chord of an element, touches where it comes closest to the
    centre of the circle, and hands the force there to its two ends by the lever rule. Exudyn reports no force of this
    connector; what is computed here is its own law from the same state."""

    states = 3  # as in OPEN; what sticks is held by a force in proportion to its speed

    def __init__(
        self, beam: Beam, elements: Indices, stiffness: Array, damping: Array, friction: float, sliding: Array
    ) -> None:
        nodes = np.append(elements, elements[-1] + 1)
        super().__init__(beam, nodes, beam.shape.wall_y[nodes])
        self.elements, self.stiffness, self.damping = elements, stiffness, damping
        self.friction, self.sliding = friction, sliding
        self.radius = 1.0 / beam.shape.wall_curvature
        self.round_off = float(np.finfo(float).eps * self.radius * stiffness.max())

    def _closest(self, q: Array) -> tuple[Array, Array, Array, Array]:
        """Gap of each segment, where on it (0 … 1), and the normals away from the wall there and at the nodes, each of
        shape (2, segments or nodes)."""
        beam, r = self.beam, self.radius
        x = (beam.shape.s + q[beam.horizontal])[self.nodes]
        y = q[beam.vertical][self.nodes]
        dx, dy = np.diff(x), np.diff(y)
        at = np.clip((-x[:-1] * dx + (r - y[:-1]) * dy) / (dx**2 + dy**2), 0.0, 1.0)
        px, py = x[:-1] + at * dx, y[:-1] + at * dy
        distance = np.hypot(px, py - r)
        gap = (px**2 + py**2 - 2.0 * r * py) / (distance + r)  # distance − r without the difference of large numbers
        return gap, at, np.stack([px, py - r]) / distance, np.stack([x, y - r]) / np.hypot(x, y - r)

    def _pushes(self, q: Array, v: Array) -> tuple[Array, Array, Array]:
        """Gap of each segment, the push that it has when closed, and how fast it slides."""
        gap, at, normal, _ = self._closest(q)
        ends = np.stack([v[self.beam.horizontal], v[self.beam.vertical]])[:, self.nodes]
        velocity = ends[:, :-1] * (1.0 - at) + ends[:, 1:] * at
        push = -(self.stiffness * gap + self.damping * (velocity * normal).sum(axis=0))
        return gap, push, normal[0] * velocity[1] - normal[1] * velocity[0]

    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        gap, push, speed = self._pushes(q, v)
        states = np.stack([gap, 0.0 * gap, 0.0 * gap], axis=1).ravel() if self.assumed is None else self.assumed
        closed, slips = states[:: self.states] <= 0.0, states[1 :: self.states]
        rubs = np.where(np.abs(slips) == 1.0, self.friction * np.abs(push) * slips, self.sliding * speed)
        _, at, _, normals = self._closest(q)
        shares = np.stack([1.0 - at, at]) * closed
        push, rubs = (np.pad(f[0], (0, 1)) + np.pad(f[1], (1, 0)) for f in (push * shares, rubs * shares))
        self.along = push * normals[0] + rubs * normals[1]
        across = rubs * normals[0] - push * normals[1]
        return across, across != 0.0

    def stored_energy(self, q: Array) -> float:
        return float((self.stiffness * np.minimum(self._closest(q)[0], 0.0) ** 2).sum() / 2)

    def contradictions(self, q: Array, v: Array, closed: Flags) -> Array:
        gap, push, _ = self._pushes(q, v)
        wrong = np.where(gap <= 0.0, ~closed, closed & (push <= 0.0))
        return np.where(wrong, self.stiffness * np.abs(gap), 0.0)


@dataclass(frozen=True)
class SegmentFriction(Contact):
    """Penalty on the segments of ANCF cables, with friction."""

    # keeps the circle small: its round-off, ε·k/K, then stays far below the contact force
    geometry: ClassVar[Geometry] = LinearLimit(amplitude=0.02)
    # steps are halved where the point of contact runs along its chord faster than Newton's method can follow; and as
    # it runs, chords at rest on the wall open and close by forces of no consequence
    solver: ClassVar[NewtonSolver] = replace(USUAL, halve_steps=True, contact_tolerance=1e-2)

    friction: Annotated[float, Quantity("", "Coulomb's coefficient", least=0.0)] = 0.0
    relative_stiffness: Annotated[float, Quantity("", "as for the nodal penalty, in EI/Δx⁴", above=0.0)] = 10.0
    relative_damping: Annotated[float, Quantity("", "likewise, in √(EIμ)/Δx²", least=0.0)] = 10.0
    relative_friction_damping: Annotated[
        float, Quantity("", "tangential force per sliding velocity below Coulomb's limit, in √(EIμ)/Δx²", above=0.0)
    ] = 1.0

    def refuses(self, impact: Impact, element: Element, integrator: Integrator) -> str | None:
        reason = None
        if impact.opposite_wall is not None:
            reason = "knows one wall only: take penalty (opposite_wall is given)"
        elif impact.wall_curvature:
            reason = f"knows a flat wall only: take penalty (got wall_curvature {impact.wall_curvature})"
        elif impact.first_touch:
            reason = f"knows a wall about the beam's middle only: take penalty (got first_touch {impact.first_touch})"
        elif impact.axial_force:
            reason = "lays the bow into the wall, and an axial force does not act on it there: take penalty "
            reason += f"(got axial_force {impact.axial_force})"
        elif impact.shear_stiffness is not None:
            reason = f"works on cables, which do not shear (got shear_stiffness {impact.shear_stiffness!r}){UNSHEARED}"
        elif impact.curvature == 0.0:
            reason = "needs a bent beam (got curvature 0)"
        elif not isinstance(element, ANCFCable):
            reason = f"works on ANCF cables only: take exudyn.element.kind ancf_cable (got {type(element).__name__})"
        elif integrator.explicit:
            reason = f"needs an implicit exudyn.integrator (got {type(integrator).__name__})"
        elif not self.friction and self.relative_friction_damping != type(self).relative_friction_damping:
            damping = self.relative_friction_damping
            reason = f"without friction: relative_friction_damping has no effect, leave it out (got {damping!r})"
        return None if reason is None else f"exudyn.contact.kind segment_friction {reason}"

    def wall_share(self, geometry: Geometry) -> float:
        return TRUE_SHARE if geometry.true else 1.0

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        mbs, units, last = beam.mbs, beam.units, beam.lengths.size
        elements = np.arange(max(0, int(wall.nodes[0]) - 1), min(last, int(wall.nodes[-1]) + 1))
        lengths, radius = beam.lengths[elements], units.length / beam.shape.wall_curvature
        times = lengths**2
        k, d = self.relative_stiffness / times**2 * lengths, self.relative_damping / times * lengths
        sliding = (self.relative_friction_damping if self.friction else 0.0) / times * lengths
        run = _Run(beam, elements, k, d, self.friction, sliding)
        ground = mbs.AddObject(items.ObjectGround())
        circle = mbs.AddMarker(items.MarkerBodyRigid(bodyNumber=ground, localPosition=[0.0, radius, 0.0]))
        for i, e in enumerate(elements):
            marker = mbs.AddMarker(items.MarkerBodyCable2DShape(bodyNumber=beam.bodies[e], numberOfSegments=1))
            state = items.NodeGenericData(numberOfDataCoordinates=_Run.states, initialCoordinates=OPEN)
            connector = items.ObjectContactFrictionCircleCable2D(
                markerNumbers=[circle, marker],
                nodeNumber=mbs.AddNode(state),
                numberOfContactSegments=1,
                contactStiffness=run.stiffness[i] * units.stiffness,
                contactDamping=run.damping[i] * units.damping,
                circleRadius=radius,
                frictionCoefficient=self.friction,
                frictionVelocityPenalty=run.sliding[i] * units.damping,
                useSegmentNormals=False,
            )
            run.connectors.append(mbs.AddObject(connector))
        return run
