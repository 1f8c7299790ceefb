"""What every element makes of a beam: its nodes and bodies in an Exudyn system, and the quantities read off its state.

In model units EI = μ = 1. Coordinates are Exudyn's: displacements from a straight reference along x, where node i lies
at its arc length s_i.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, ClassVar

import exudyn.itemInterface as items
import numpy as np
from scipy.sparse import csr_matrix

from bent_beam import Impact
from bent_beam.fields import Part, Quantity
from exudyn_models.geometry import Array, Indices, Scaling, Shape, Units, element_times

VISCOSITY = 0.15  # of √(EIμ)Δx² of an element, λ₀ is off in proportion; tests/comparison/test_constants.py
VISCOSITY_SHEARED = 0.015  # of an element shorter than l_s, in its own time; with 0.15 the first moments are 7 % low
VISCOSITY_EXPLICIT = 0.003  # more would shorten the stable step
ROUNDED = 16.0  # times the rounding of one node's force: a residual gathers those of all nodes (seen: 2 to 8)
MOST_ROUNDED = 1e-5  # with 1e-3 a damped run to a ten-thousandth of η is accepted, and has 6 % less impulse
CHOSEN_VISCOSITY = f"{VISCOSITY:g} (shear: {VISCOSITY_SHEARED:g}; explicit: {VISCOSITY_EXPLICIT:g}; whole beam: 0)"
INERTIA = 1e9  # that no load moves
Matrix = Any  # SciPy's sparse matrices carry no types


def shares(lengths: Array) -> Array:
    """Length that each node stands for of elements of ``lengths``, shape (nodes,)."""
    half = np.pad(lengths / 2, 1)
    return np.asarray(half[:-1] + half[1:])


class Beam(ABC):
    """A beam in an Exudyn system ``mbs``, whose first nodes are the beam's.

    axial_stiffness : EAΛ²/EI; grid_viscosity, viscosity : of each element without and with the material's, (elements,);
        units : of Exudyn's items; stretch : strain under the axial force; shears : whether elements are short enough
        for shear waves to be what they resolve.
    size : coordinates of the system; horizontal, vertical, rotation : those of the nodes, (nodes,).
    load, load_rate : forces on them, (size,), at t = 0 and by time; upward : 1 where they are y.
    """

    horizontal_coordinate = 0
    vertical_coordinate = 1
    rotation_coordinate: int
    stiffer: Array | float = 0.0  # of an element across the beam, (elements,), beyond that of bending

    def __init__(
        self, mbs: Any, shape: Shape, scaling: Scaling, axial_stiffness: float, grid_viscosity: Array, units: Units
    ) -> None:
        self.mbs, self.shape, self.scaling, self.units = mbs, shape, scaling, units
        self.axial_stiffness, self.stretch = axial_stiffness, scaling.axial_force / axial_stiffness
        self.grid_viscosity, self.viscosity = grid_viscosity, grid_viscosity + scaling.material_damping
        self.lengths = shape.lengths
        self.tributary, self.shears = shares(self.lengths), float(self.lengths.min()) < scaling.shear_length
        each = self.rotation_coordinate + 1
        self.size = each * shape.s.size
        self.horizontal = np.arange(0, self.size, each)
        self.vertical = self.horizontal + self.vertical_coordinate
        self.rotation = self.horizontal + self.rotation_coordinate
        self.upward, self.load, self.load_rate = np.zeros((3, self.size))
        self.upward[self.vertical] = 1.0  # the shape functions of deflections add up to one
        self.nodes = [mbs.AddNode(self.node(i)) for i in range(shape.s.size)]
        self.bodies = [mbs.AddObject(self.body(i)) for i in range(self.lengths.size)]
        ground = mbs.AddNode(items.NodePointGround())
        self.ground_marker = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))

    def at_first(self, i: int) -> tuple[list[float], list[float]]:
        """Displacement and velocity along x and y of node ``i`` at the first contact, for Exudyn's item."""
        shape, length = self.shape, self.units.length
        speed, stretched = length * (1.0 / self.units.time), 1.0 + self.stretch
        place = [(stretched * shape.x[i] - shape.s[i]) * length, stretched * shape.y[i] * length]
        return place, [shape.velocity_x[i] * speed, shape.velocity_y[i] * speed]

    @abstractmethod
    def node(self, i: int) -> Any:
        """Exudyn's item."""

    @abstractmethod
    def body(self, i: int) -> Any:
        """Exudyn's item between the nodes ``i`` and ``i`` + 1."""

    def round_off(self, velocity: float) -> float:
        """Force that means nothing, of the deflections of the laid bow (elastic) and of velocities of this size
        (viscous): no residual of a step can be made smaller.

        At most ``MOST_ROUNDED`` times ``velocity``, the amplitude of the model: where it is larger, Newton's method
        stops, and nothing is hidden.
        """
        stiffness = 12.0 * self.lengths / element_times(self.lengths, self.scaling.shear_length) ** 2 + self.stiffer
        deflections = np.abs(self.shape.y)
        forces = stiffness * (np.maximum(deflections[:-1], deflections[1:]) + self.viscosity * velocity)
        return min(float(ROUNDED * np.finfo(float).eps * forces.max()), MOST_ROUNDED * velocity)

    def axial_round_off(self) -> float:
        """Force along a stiff beam that means nothing: a strain is a difference of places. 0 of a soft one, as in the
        linear limit without an axial force."""
        if not (self.scaling.axial_force or self.shape.slender):
            return 0.0
        places = float(np.abs(self.shape.s).max()) / self.lengths.min()
        return float(ROUNDED * np.finfo(float).eps * self.axial_stiffness * places)

    def marker(self, node: int, coordinate: int) -> Any:
        """A marker on one coordinate of the ``node``-th node."""
        return self.mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=self.nodes[node], coordinate=coordinate))

    def fix(self, node: int, *coordinates: int) -> None:
        """Hold coordinates of a node where they are at first."""
        for coordinate in coordinates:
            place = float(self.node(node).initialCoordinates[coordinate])
            markers = [self.ground_marker, self.marker(node, coordinate)]
            self.mbs.AddObject(items.CoordinateConstraint(markerNumbers=markers, offset=place))

    def hold_by_inertia(self, node: int, *coordinates: int) -> None:
        """Hold coordinates of a node, at the middle or at an end, by an inertia too large to move: why explicit solvers
        need it, docs/exudyn.md."""
        mass = np.zeros(self.rotation_coordinate + 1)
        mass[list(coordinates)] = INERTIA * self.units.mass_per_length * self.units.length
        self.mbs.AddObject(items.ObjectGenericODE2(nodeNumbers=[self.nodes[node]], massMatrix=np.diag(mass)))

    def load_uniformly(self, acceleration: float) -> None:
        """A load μ·``acceleration`` per unit length along y."""
        self.load += self.mass @ (acceleration * self.upward)
        load = [0.0, acceleration * self.units.length / self.units.time**2, 0.0]
        for body in self.bodies:
            marker = self.mbs.AddMarker(items.MarkerBodyMass(bodyNumber=body))
            self.mbs.AddLoad(items.LoadMassProportional(markerNumber=marker, loadVector=load))

    def load_node(self, node: int, coordinate: int, constant: float, rate: float = 0.0) -> None:
        """A force (or moment) ``constant`` + ``rate``·t on one coordinate of the ``node``-th node."""
        if constant == 0.0 == rate:
            return
        place = self.horizontal[node] + coordinate
        self.load[place] += constant
        self.load_rate[place] += rate
        unit = self.units.force * (self.units.length if coordinate == self.rotation_coordinate else 1.0)
        at_first, growth = constant * unit, rate * unit / self.units.time
        grows = {"loadUserFunction": lambda mbs, t, load: at_first + growth * t} if rate else {}
        self.mbs.AddLoad(items.LoadCoordinate(markerNumber=self.marker(node, coordinate), load=at_first, **grows))

    def loads(self, times: Array) -> Array:
        """All loads as forces on the system's coordinates, (times, size)."""
        return self.load + np.multiply.outer(times, self.load_rate)

    def _assembled(self, matrices: Array, first: Indices, second: Indices) -> Matrix:
        """The system's matrix of element matrices in (first, second) of the left node, then of the right."""
        pairs = [first, second][: matrices.shape[1] // 2]
        at = np.stack([c[s] for s in (slice(None, -1), slice(1, None)) for c in pairs], axis=1)
        rows, columns = (np.broadcast_to(m, matrices.shape) for m in (at[:, :, None], at[:, None, :]))
        return csr_matrix((matrices.ravel(), (rows.ravel(), columns.ravel())), shape=(self.size, self.size))

    @cached_property
    def mass(self) -> Matrix:
        """Consistent mass matrix of the system."""
        across, last = self.element_matrices()[0], self.horizontal + self.rotation_coordinate - 1
        along = self._assembled(self.axial_mass(), self.horizontal, last)
        return along + self._assembled(across, self.vertical, self.rotation)

    @cached_property
    def momentum(self) -> Array:
        """Along y, of velocities: momentum @ v, (size,)."""
        return np.asarray(self.mass @ self.upward)

    def kinetic_energy(self, v: Array) -> Array:
        """Of one state, or of each of several, v (states, coordinates)."""
        return np.asarray((v * (self.mass @ v.T).T).sum(axis=-1) / 2)

    @cached_property
    def _damping(self) -> tuple[Matrix, Matrix]:
        """Matrices of the system, of the viscosity at grid scale and of the material's."""
        _, _, damped = self.element_matrices()
        grid, material = self.grid_viscosity[:, None, None] * damped, self.scaling.material_damping * damped
        where = self.vertical, self.rotation
        return self._assembled(grid, *where), self._assembled(material, *where)

    def damping_work(self, q: Array, v: Array) -> tuple[Array, Array]:
        """What the viscosity at grid scale and that of the material take between neighbouring rows, each (rows − 1,);
        here for small slopes."""
        moved, mean = np.diff(q, axis=0), (v[1:] + v[:-1]) / 2
        grid, material = ((mean * (matrix @ moved.T).T).sum(axis=1) for matrix in self._damping)
        return grid, material

    @abstractmethod
    def slope(self, q: Array) -> Array:
        """dy/dx at the nodes; of a beam that shears the angle of its sections."""

    @abstractmethod
    def bending_energy(self, q: Array) -> Array:
        """With that of shear. Of one state, or of each of several, q (states, coordinates)."""

    @abstractmethod
    def bending_moments(self, q: Array) -> Array:
        """EI(κ − κ₀) of the element's own curvature at both its ends, shape (…, elements, 2)."""

    @abstractmethod
    def axial_energy(self, q: Array) -> Array:
        """Less that of the stretch under the axial force."""

    def strain_energy(self, q: Array) -> Array:
        """What the beam holds but for :meth:`stretch_energy`."""
        bending = self.bending_energy(q)
        return bending if self.scaling.axial_force else bending + self.axial_energy(q)

    def stretch_energy(self, q: Array) -> Array:
        """What an axial force keeps in the beam that it stretches, the same along all of it; 0 without one."""
        return self.axial_energy(q) if self.scaling.axial_force else np.zeros(q.shape[:-1])

    @abstractmethod
    def element_matrices(self) -> tuple[Array, Array, Array]:
        """Linearised mass and stiffness matrices in (y₁, rotation₁, y₂, rotation₂), and the part of the latter that is
        damped, each (elements, 4, 4)."""

    @abstractmethod
    def axial_mass(self) -> Array:
        """Mass matrices along x, (elements, 2, 2) in (x₁, x₂) or (elements, 4, 4) in (x₁, x₁′, x₂, x₂′)."""


@dataclass(frozen=True)
class Element(Part, ABC):
    """What every element may be told. Viscosity shortens the stable step of explicit integrators; the axial stiffness
    has no effect in the linear limit without an axial force."""

    where: ClassVar[str] = "exudyn.element"
    beam: ClassVar[type[Beam]]

    viscosity: Annotated[
        float | None,
        Quantity(
            "", "of its shape, in each element's time: Δx²√(μ/EI) without shear", least=0.0, absent=CHOSEN_VISCOSITY
        ),
    ] = None
    axial_stiffness: Annotated[
        float | None, Quantity("N", "EA", above=0.0, absent="12EI/d² (true), EI/Λ² or less (linear), 1e4 of it with N")
    ] = None

    def refuses(self, impact: Impact) -> str | None:
        """Why this element cannot model a beam (None: it can)."""
        return None
