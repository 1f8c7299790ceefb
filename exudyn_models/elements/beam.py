"""What every element makes of a beam: its nodes and bodies in an Exudyn system, and the quantities read off its state.

Coordinates are Exudyn's: displacements from a straight reference along x, where node i lies at its arc length s_i.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, Protocol

import exudyn.itemInterface as items
import numpy as np
from numpy.typing import NDArray

from exudyn_models.geometry import Shape

__all__ = ["Beam", "Element", "Section"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Section:
    """Of the beam in its model's units."""

    bending_stiffness: float = 1.0
    mass_per_length: float = 1.0
    axial_stiffness: float = 1.0


class Beam(ABC):
    """A beam in an Exudyn system ``mbs``. ``vertical`` and ``rotation`` number the coordinates within a node."""

    horizontal_coordinate = 0
    vertical_coordinate = 1
    rotation_coordinate: int

    def __init__(self, mbs: Any, shape: Shape, section: Section, viscosity: Array) -> None:
        self.mbs, self.shape, self.section, self.viscosity = mbs, shape, section, viscosity
        self.lengths = shape.lengths
        self.nodes: list[Any] = []
        self.bodies: list[Any] = []
        ground = mbs.AddNode(items.NodePointGround())
        self.ground_marker = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))

    @property
    def tributary(self) -> Array:
        """Length of beam that each node stands for, shape (nodes,)."""
        half = np.zeros(self.shape.s.size)
        half[:-1] += self.lengths / 2
        half[1:] += self.lengths / 2
        return half

    def marker(self, node: int, coordinate: int) -> Any:
        """A marker on one coordinate of the ``node``-th node."""
        return self.mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=self.nodes[node], coordinate=coordinate))

    def fix(self, node: int, *coordinates: int) -> None:
        """Hold coordinates of a node at zero displacement."""
        for coordinate in coordinates:
            self.mbs.AddObject(
                items.CoordinateConstraint(markerNumbers=[self.ground_marker, self.marker(node, coordinate)])
            )

    def burden(self, node: int, *coordinates: int, inertia: float = 1e9) -> None:
        """Hold coordinates of a node by an inertia too large to move.

        Exudyn's explicit solvers set constrained accelerations to zero *after* solving with the unconstrained mass
        matrix,
        which destabilises a consistent one.
        """
        size = self.rotation_coordinate + 1
        mass = np.zeros((size, size))
        mass[list(coordinates), list(coordinates)] = inertia
        none = np.zeros((size, size))
        self.mbs.AddObject(
            items.ObjectGenericODE2(
                nodeNumbers=[self.nodes[node]],
                massMatrix=mass,
                stiffnessMatrix=none,
                dampingMatrix=none,
                forceVector=np.zeros(size),
            )
        )

    def load_uniformly(self, acceleration: float) -> None:
        """A load μ·``acceleration`` per unit length along y."""
        for body in self.bodies:
            marker = self.mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
            self.mbs.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=[0.0, acceleration, 0.0]))

    def locate(self) -> None:
        """After ``mbs.Assemble()``: where the coordinates stand in the system's vectors."""
        first = np.array([self.mbs.GetNodeODE2Index(node) for node in self.nodes])
        self.horizontal = first + self.horizontal_coordinate
        self.vertical = first + self.vertical_coordinate
        self.rotation = first + self.rotation_coordinate

    def deflection(self, q: Array) -> Array:
        """y at the nodes (the reference lies on y = 0)."""
        return q[self.vertical]

    @abstractmethod
    def slope(self, q: Array) -> Array:
        """dy/dx at the nodes."""

    @abstractmethod
    def momentum(self, v: Array) -> float:
        """Momentum along y."""

    @abstractmethod
    def kinetic_energy(self, v: Array) -> float: ...

    @abstractmethod
    def strain_energy(self, q: Array) -> float: ...

    @abstractmethod
    def viscous_power(self, q: Array, v: Array) -> float:
        """Power that the bending viscosity takes out."""

    @abstractmethod
    def element_matrices(self) -> tuple[Array, Array, Array]:
        """Linearised mass, stiffness and damping matrices in (y₁, rotation₁, y₂, rotation₂), each (elements, 4, 4)."""

    def axial_frequency(self) -> float:
        """Upper bound of the axial angular frequencies."""
        return float(np.sqrt(60.0 * self.section.axial_stiffness / self.section.mass_per_length) / self.lengths.min())


class Element(Protocol):
    """What ``simulate`` asks of an element. ``viscosity`` in units of √(EIμ)·Δx² (None: chosen with the integrator)."""

    @property
    def viscosity(self) -> float | None: ...

    @property
    def axial_stiffness(self) -> float | None: ...

    def build(self, mbs: Any, shape: Shape, section: Section, viscosity: Array) -> Beam:
        """Add the beam to ``mbs``; ``viscosity`` is that of each element, shape (elements,)."""
        ...
