"""What every contact is given and what it reports.

The wall is y = 0, the beam lies in y ≤ 0, the gap is g = −y. A contact puts its connectors into the Exudyn system
once and is then asked, between segments of time steps, for the force at each contact point; it may switch connectors
there.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from bent_beam import Impact
from bent_beam.fields import Part
from exudyn_models.arrays import Array, Flags, Indices
from exudyn_models.elements import Beam, Element
from exudyn_models.geometry import Geometry, LinearLimit
from exudyn_models.integrators import GeneralizedAlpha, Integrator
from exudyn_models.solvers import NewtonSolver

__all__ = ["Contact", "ContactRun", "Wall"]

TINY = 1e-30  # a gap that is a state and no length


@dataclass(frozen=True)
class Wall:
    """Where and how the beam may touch, in model units.

    nodes : numbers of the beam's nodes that may touch, ascending; centre : the node at x = 0;
    lengths : of the beam's elements before the wall, 0 of others, (elements,); all are 0 before a stop;
    half : only x ≥ 0 is modelled;
    front : rough estimate of where contact ends at the end;
    first_spread : until when (in end times) nothing but the first spread of the zone moves it: waves are back later;
    lifts : load or damping lifts the zone from the first, or the beam touches in a point: no start is held;
    plastic : the front is thin, so that nodes that hit must not rebound, and nothing but the first spread moves it: how
        much of the damping that such hits take the run asks for; 0 elsewhere;
    """

    nodes: Indices
    lengths: Array
    centre: int
    half: bool
    front: float
    first_spread: float
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
        half = np.append(self.lengths, 0.0) / 2
        half[1:] += self.lengths / 2
        return np.asarray(half[self.nodes])


class ContactRun(ABC):
    """A contact at work in one system.

    nodes : of the beam, those that are contact points; contact_s : their arc lengths; wall_y : the wall there; signs :
        +1 for those on the wall, −1 for those on an opposite one. Each of shape (contacts,).
    """

    iterated = True  # Exudyn finds the contact state by repeating steps
    states = 1  # data coordinates of a connector, the first a gap: the connector is closed where it is not positive
    imposes = False  # states are those of ``closed_by``, not of Exudyn's gaps
    wall_springs: Array | None = None  # stiffness at the contact points of a wall that gives way, (contacts,)
    round_off = 0.0  # force in Exudyn's connectors that means nothing: no residual can be made smaller

    def __init__(self, beam: Beam, nodes: Indices, wall_y: Array, signs: Array | None = None) -> None:
        self.beam, self.nodes, self.wall_y = beam, nodes, wall_y
        self.contact_s = beam.shape.s[nodes]
        self.signs = np.ones(nodes.size) if signs is None else signs

    def depth(self, q: Array) -> Array:
        """Penetration at the contact points, shape (contacts,)."""
        return np.asarray(q[self.beam.vertical[self.nodes]] - self.wall_y)

    @abstractmethod
    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        """Contact forces (off the wall positive, off an opposite one negative) and active flags, shape (contacts,)."""

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
        """Called between segments, ``step`` the length of the next steps; returns whether connectors were switched (the
        Jacobian must then be renewed)."""
        return False

    def stiffness_and_damping(self) -> tuple[Array, Array]:
        """Stiffness and damping of the closed contact at each *beam node*, shape (nodes,): for the stable step."""
        raise ValueError("exudyn.contact: this contact does not work with explicit integrators")

    @property
    def held_until(self) -> float:
        """When (of the end time) the last contact point is let go that may have been held; 0: none ever is."""
        return 0.0

    def settings(self) -> dict[str, Any]:
        """What was chosen, JSON-ready."""
        return {}


@dataclass(frozen=True)
class Contact(Part, ABC):
    """A kind of contact: what it can work with, what goes with it when nothing else is asked for, its connectors."""

    where: ClassVar[str] = "exudyn.contact"

    def refuses(self, impact: Impact, element: Element, integrator: Integrator) -> str | None:
        """Why this contact cannot work with a beam, an element or an integrator (None: it can)."""
        return None

    def integrator(self) -> Integrator:
        """The integrator that goes with it."""
        return GeneralizedAlpha()

    def geometry(self) -> Geometry:
        """The geometry that goes with it."""
        return LinearLimit()

    def solver(self) -> NewtonSolver:
        """The solver settings that go with it."""
        return NewtonSolver()

    def wall_share(self, geometry: Geometry) -> float:
        """The share of the beam's curvature that a round wall takes over."""
        return 0.0

    @abstractmethod
    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        """Add the connectors to the beam's system (before ``Assemble``)."""
