"""What every contact is given and what it reports.

A flat wall is y = 0, the beam lies in y ≤ 0, the gap is g = −y; ``wall_y`` and ``signs`` tell of a curved wall and of
one opposite. A contact puts its connectors into the Exudyn system once. Between segments of time steps it is asked for
the force at each contact point, and may switch connectors.

A node is *captured* once its contact has closed. A captured node may be *held*, and is then pulled, too, by the wall
(:class:`HeldStrip`):

- at the start. No mesh resolves the node impacts of the first instants, which would lift the zone for a long time. So
  all captured nodes are held for the first share ``START`` of the run. Not in runs that last until waves are back from
  the ends, nor where load, damping or shear lifts the zone, or the beam touches in a point: there a held start makes
  the largest moment 5 % too large at κ/ν = 0.32 with ζ = 0.2 %, 15 % at 1.2;
- behind the front. The exact reaction vanishes there, and a one-sided law turns noise into pushes that lift the beam. A
  ``hold`` of so many elements keeps each captured node until the front is that many elements further on, or waves may
  be back from the ends, which may lift what they will.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

import numpy as np

from bent_beam import Impact
from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from exudyn_models.elements.beam import Beam, Element, shares
from exudyn_models.geometry import Array, Flags, Geometry, Indices, LinearLimit
from exudyn_models.integrators import GeneralizedAlpha, Integrator
from exudyn_models.solvers import USUAL, NewtonSolver

TINY = 1e-30  # written over a gap, tells Exudyn the state by its sign: −TINY closed, TINY open
START = 0.01  # of the end time
Hold = Annotated[
    int, Quantity("", "elements behind the front whose captured nodes are held, until waves may be back", least=0)
]


@dataclass(frozen=True)
class Wall:
    """Where and how the beam may touch, in model units.

    nodes : numbers of the beam's nodes that may touch, ascending; centre : the node at x = 0;
    lengths : of the beam's elements before the wall, 0 of others, (elements,); all are 0 before a stop;
    half : only x ≥ 0 is modelled;
    waves_return : until when (in end times) no wave is back from the ends, and the zone spreads by itself;
    lifts : whether no start may be held: load, damping or shear lifts the zone, or the beam touches in a point;
    plastic : share, 0 to 1, of the damping that keeps nodes from rebounding at a thin front, of a zone that spreads for
        the first time; 0 elsewhere.
    explicit : the integrator takes explicit steps.
    """

    nodes: Indices
    lengths: Array
    centre: int
    half: bool
    waves_return: float
    plastic: float
    lifts: bool
    explicit: bool
    opposite: float | None  # y of a second, flat wall behind the beam
    stiffness: float | None = None  # per length, of a wall that gives way; of a stop itself
    damping: float = 0.0  # beside it

    @property
    def stop(self) -> bool:
        """Whether the wall is a point."""
        return not self.lengths.any()

    @property
    def weights(self) -> Array:
        """Length of wall that each of ``nodes`` stands for, of a stop its share in the modelled beam."""
        if self.stop:
            return np.full(self.nodes.size, 0.5 if self.half and self.nodes[0] == self.centre else 1.0)
        return np.asarray(shares(self.lengths)[self.nodes])


class HeldStrip:
    """Remembers which contact nodes have been captured; all are held until ``start``, those within ``hold`` elements
    behind the front until ``until``, of the end time."""

    def __init__(self, wall: Wall, hold: int, start: float | None = None) -> None:
        usual = 0.0 if wall.explicit or wall.waves_return < 1.0 or wall.lifts else START
        self.hold = hold
        self.start = min(usual if start is None else start, wall.waves_return)
        self.until = wall.waves_return if hold else self.start
        self.captured = np.zeros(wall.nodes.size, bool)
        self._distance = np.abs(wall.nodes - wall.centre)
        self._sides = (wall.nodes >= wall.centre, wall.nodes < wall.centre)

    def wanted(self, time: float) -> Flags:
        """Flags of the contact nodes to hold at ``time``, shape (contacts,)."""
        if time < self.start:
            return self.captured.copy()
        held = np.zeros_like(self.captured)
        if time >= self.until:
            return held
        for side in self._sides:
            caught = self.captured & side
            if caught.any():
                held |= caught & (self._distance > self._distance[caught].max() - self.hold)
        return held


class ContactRun(ABC):
    """A contact at work in one system.

    nodes : of the beam, those that are contact points; coordinates : their y in the system's vectors; wall_y : the wall
        there; signs : +1 on the wall, −1 on an opposite one; along : forces on the beam along x with the last
        ``forces``. Each (contacts,).
    """

    iterated = True  # Exudyn finds the contact state by repeating steps
    states = 1  # data coordinates of a connector, the first a gap: the connector is closed where it is not positive
    imposes = False  # whether ``closed_by`` says which connectors are closed, in the place of the signs of gaps
    assumed: Array | None = None  # the states that the last step was solved with, where Exudyn finds them
    wall_springs: Array | None = None  # stiffness at the contact points of a wall that gives way, (contacts,)
    strip: HeldStrip | None = None  # of a contact that may hold captured nodes
    chosen: Mapping[str, float] = {}  # settings that were left open, as they were chosen
    round_off = 0.0  # force in Exudyn's connectors that means nothing: no residual can be made smaller

    def __init__(self, beam: Beam, nodes: Indices, wall_y: Array, signs: Array | None = None) -> None:
        self.beam, self.nodes, self.wall_y = beam, nodes, wall_y
        self.coordinates, self.along = beam.vertical[nodes], np.zeros(nodes.size)
        self.signs = np.ones(nodes.size) if signs is None else signs
        self.connectors: list[Any] = []  # Exudyn's object numbers

    def depth(self, q: Array) -> Array:
        """Penetration at the contact points, shape (contacts,)."""
        return np.asarray(self.signs * (q[self.coordinates] - self.wall_y))

    @abstractmethod
    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        """Contact forces (off the wall positive, off an opposite one negative) and active flags, shape (contacts,)."""

    def plain_forces(self, q: Array, v: Array) -> Array:
        """Contact forces where Exudyn's own judgement of the states stands, shape (contacts,)."""
        return self.forces(q, v)[0]

    def landing(self, depth: Array, speed: Array) -> Array:
        """Force at each contact point at the instant of a step at which all of a stop or plate lands at once, 0 in
        other steps: (steps, contacts), of depth and speed into the wall, (steps + 1, contacts)."""
        return np.zeros_like(depth[1:])

    def stored_energy(self, q: Array) -> float:
        """Energy that the contact's springs hold."""
        return 0.0

    def closed_by(self, q: Array, v: Array) -> Flags:
        """The connectors that a solution shows to be closed, shape (connectors,), for contacts that ``impose`` them."""
        raise TypeError(f"{type(self).__name__} leaves its states to Exudyn")

    def contradictions(self, q: Array, v: Array, closed: Flags) -> Array:
        """Force, shape (connectors,), by which a solution contradicts the state that it assumed (0 where it does not):
        an open connector has entered the wall, a closed one is off the wall and does not push. For contacts whose state
        Exudyn finds by repeating steps (``iterated``)."""
        raise TypeError(f"{type(self).__name__} is not iterated")

    def between(self, time: float, step: float, q: Array, v: Array) -> bool:
        """Called between segments, ``step`` the length of the next steps; returns whether connectors were switched or
        changed (the Jacobian must then be renewed)."""
        return False

    def stiffness_and_damping(self) -> tuple[Array, Array]:
        """Stiffness and damping of the closed contact at each *beam node*, shape (nodes,): for the stable step."""
        raise InputError("exudyn.contact: this contact does not work with explicit integrators")

    @property
    def held_until(self) -> float:
        """When (of the end time) the last contact point is let go that may have been held; 0: none ever is."""
        return 0.0 if self.strip is None else self.strip.until


@dataclass(frozen=True)
class Contact(Part, ABC):
    """A kind of contact: what it can work with, its connectors.

    integrator, geometry, solver : what goes with it when nothing else is asked for.
    """

    where: ClassVar[str] = "exudyn.contact"
    integrator: ClassVar[Integrator] = GeneralizedAlpha()
    geometry: ClassVar[Geometry] = LinearLimit()
    solver: ClassVar[NewtonSolver] = USUAL

    def refuses(self, impact: Impact, element: Element, integrator: Integrator) -> str | None:
        """Why this contact cannot work with a beam, an element or an integrator (None: it can)."""
        return None

    def wall_share(self, geometry: Geometry) -> float:
        """The share of the beam's curvature that the wall takes over, which is then round."""
        return 0.0

    @abstractmethod
    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        """Add the connectors to the beam's system (before ``Assemble``)."""
