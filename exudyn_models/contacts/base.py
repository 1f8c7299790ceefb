"""What every contact is given and what it reports.

The wall is y = 0, the beam lies in y ≤ 0, the gap is g = −y. A contact puts its connectors into the Exudyn system
once and is
then asked, between segments of time steps, for the force at each contact point; it may switch connectors there.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from exudyn_models.elements import Beam

__all__ = ["Contact", "ContactRun", "Wall"]

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Wall:
    """Where and how the beam may touch, in model units.

    nodes : numbers of the beam's nodes that may touch, ascending; centre : the node at x = 0;
    half : only x ≥ 0 is modelled; pulled_off : the load draws the beam off the wall (detached regime);
    point_contact : κ/ν ≥ 1, only the centre stays in contact;
    stiffness_unit, damping_unit : N/m² and N s/m² of the model units.
    """

    nodes: NDArray[np.int64]
    centre: int
    half: bool
    pulled_off: bool
    point_contact: bool
    explicit: bool
    curvature: float
    stiffness_unit: float
    damping_unit: float


class ContactRun(ABC):
    """A contact at work in one system. ``contact_s`` are the arc lengths of the contact points, shape (contacts,)."""

    contact_s: Array
    longest_segment: int | None = None  # steps after which it must be asked again

    @abstractmethod
    def depth(self, q: Array) -> Array:
        """Penetration at the contact points, shape (contacts,)."""

    @abstractmethod
    def forces(self, q: Array, v: Array) -> tuple[Array, Flags]:
        """Contact forces (positive: pushing the beam off the wall) and active flags, each of shape (contacts,)."""

    @abstractmethod
    def velocity(self, q: Array, v: Array) -> Array:
        """Velocity of the beam at the contact points, positive into the wall, shape (contacts,)."""

    def between(self, time: float, q: Array, v: Array) -> bool:
        """Called between segments; returns whether connectors were switched (the Jacobian must then be renewed)."""
        return False

    def stiffness_and_damping(self) -> tuple[Array, Array]:
        """Stiffness and damping of the closed contact at each *beam node*, shape (nodes,): for the stable step."""
        raise ValueError("exudyn.contact: this contact does not work with explicit integrators")

    def settings(self) -> dict[str, Any]:
        """What was chosen, JSON-ready."""
        return {}


class Contact(Protocol):
    """What ``simulate`` asks of a contact."""

    def attach(self, beam: Beam, wall: Wall) -> ContactRun:
        """Add the connectors to the beam's system (before ``Assemble``)."""
        ...

    def refuses(self, element: Any, integrator: Any) -> str | None:
        """Why this contact cannot work with an element or integrator (None: it can)."""
        ...
