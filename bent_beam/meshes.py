"""One-dimensional meshes of the half beam 0 ≤ x ≤ L/2, used by the Hermite and the Exudyn path.

A mesh is a small frozen object; ``mesh.nodes(half_length)`` lays its nodes. A full beam mirrors them
(:func:`mirrored`). Grading reflects the short waves that an impact radiates (docs/numerics.md): grow by a
few per cent an element at most, or add an absorbing far field.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Annotated, ClassVar, Protocol, Self, runtime_checkable

import numpy as np

from bent_beam.checks import at_least, finite, shortened
from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from bent_beam.loads import Array

__all__ = [
    "MESHES", "GradedMesh", "Mesh", "NodesMesh", "ScaleFreeMesh", "SquareMesh", "UniformMesh", "checked_nodes",
    "mirrored", "snapped",
]  # fmt: skip

NEAR = 1e-9  # of the half length: a place so near the middle or an end of the beam lies there
SLIVER = 0.01  # of an element: a place that leaves less of it asks for other elements
MAXIMUM_NODES = 2_000_000  # beyond this a mesh is a typing error, not a wish


@runtime_checkable
class Mesh(Protocol):
    """What Hermite and Exudyn ask of a mesh."""

    def nodes(self, half_length: float) -> Array:
        """Node places from 0 to ``half_length``, m, strictly increasing, shape (n,)."""

    def refined(self, factor: float) -> Mesh:
        """The same mesh with elements ``factor`` times shorter everywhere."""


def checked_nodes(nodes: Array) -> Array:
    """Validate node places: finite, strictly increasing, at least two elements; ``ValueError`` otherwise."""
    x = np.ascontiguousarray(nodes, dtype=np.float64)
    if x.ndim != 1 or x.size < 3:
        raise InputError(f"mesh must have at least two elements (got {max(x.size - 1, 0)})")
    if not np.all(np.isfinite(x)):
        raise InputError("mesh.nodes must be finite")
    if not np.all(np.diff(x) > 0.0):
        raise InputError(f"mesh.nodes must increase strictly (element {int(np.argmin(np.diff(x)))} does not)")
    return x


def snapped(nodes: Array, places: Iterable[float]) -> Array:
    """``nodes`` of the half beam with those nearest to ``places`` of either half, m from the middle, moved onto them.

    Raises ``ValueError`` where the elements are too large to have a node at every place.
    """
    moved, near, wanted = nodes.copy(), NEAR * nodes[-1], np.unique(np.abs([*places]))
    wanted = wanted[(wanted > near) & (wanted < nodes[-1] - near)]
    wanted = wanted[np.diff(wanted, prepend=-np.inf) > near]  # of both halves, but for round-off
    for place in wanted:  # between two that are as near, but for round-off, onto the inner
        moved[1 + np.argmin(np.round(np.abs(nodes[1:-1] - place) / nodes[-1], 9))] = place
    if not np.all(np.isin(wanted, moved)) or np.any(np.diff(moved) < SLIVER * np.diff(nodes)):
        told = ", ".join(f"{place:g}" for place in wanted)
        raise InputError(f"mesh has too large elements: a node of its own stands at each edge of the wall and each "
                         f"place of a force, here {told} m from the middle")  # fmt: skip
    return moved


def node_at(nodes: Array, place: float) -> int:
    """The node on which :func:`snapped` has put the ``place`` of a force, m. ``ValueError`` beyond the last."""
    if abs(place) > nodes[-1] * (1.0 + NEAR):
        raise InputError(f"mesh must reach as far as the force at {place!r} m (got {float(nodes[-1])!r} m)")
    return int(np.argmin(np.abs(nodes - place)))


def mirrored(nodes: Array) -> Array:
    """Nodes of the full beam from those of its right half: −x_n … 0 … x_n, exactly symmetric."""
    return np.concatenate([-nodes[:0:-1], nodes])


def _count(half_length: float, element_length: float) -> int:
    if half_length / element_length > MAXIMUM_NODES:
        raise InputError(
            f"mesh.element_length is too small for the beam: more than {MAXIMUM_NODES} elements "
            f"(got {element_length!r} for a half length of {half_length!r})"
        )
    return max(2, math.ceil(half_length / element_length - 1e-9))


Length = Annotated[float, Quantity("m", "Δx, shortest element", above=0.0)]
Growth = Annotated[float, Quantity("", "ratio of neighbouring elements where they grow", least=1.0)]
SizeRatio = Annotated[float, Quantity("", "largest element over the smallest of the zone, at most", least=1.0)]


class _Mesh(Part):
    where: ClassVar[str] = "mesh"

    def refined(self, factor: float) -> Self:
        """The same mesh with elements ``factor`` times shorter everywhere. A mesh with lengths of other names says
        itself what becomes of them."""
        given = {name: value for name, value in vars(self).items() if value is not None}
        shorter = {name: given[name] / factor for name in ("element_length", "largest") if name in given}
        slower = {name: given[name] ** (1.0 / factor) for name in ("growth", "growth_outside") if name in given}
        return dataclasses.replace(self, **shorter, **slower)


@dataclass(frozen=True)
class UniformMesh(_Mesh):
    """Elements of one length (adjusted down so that a whole number of them fits)."""

    element_length: Length

    def nodes(self, half_length: float) -> Array:
        return np.linspace(0.0, half_length, _count(half_length, self.element_length) + 1)


def _grown(start: float, first: float, growth: float, end: float, largest: float) -> Array:
    """Nodes after ``start`` up to ``end``: elements first·growth^i, none above ``largest``, rescaled to fit."""
    sizes: list[float] = []
    size, total = first, 0.0
    while total < (end - start) * (1.0 - 1e-12):
        if len(sizes) > MAXIMUM_NODES:
            raise InputError(f"mesh would have more than {MAXIMUM_NODES} elements: enlarge element_length or growth")
        size = min(size, largest)
        sizes.append(size)
        total += size
        size *= growth
    if not sizes:
        return np.empty(0)
    nodes = start + np.cumsum(sizes) * ((end - start) / total)
    nodes[-1] = end
    return nodes


@dataclass(frozen=True)
class GradedMesh(_Mesh):
    """Uniform elements over the contact zone, then each larger than the last (thesis 3.3.3). The thesis lets elements
    grow by 1.25, which reflects: 1.02 is better. It caps their size at 10³ against ill-conditioning, and has 25
    elements in the zone (Table 3.2)."""

    element_length: Length
    growth: Growth = 1.02
    zone: Annotated[float | None, Quantity("m", "half length of the zone", above=0.0, absent="25 elements")] = None
    size_ratio: SizeRatio = 1e3

    @property
    def _zone(self) -> float:
        return 25 * self.element_length if self.zone is None else self.zone

    def nodes(self, half_length: float) -> Array:
        shortest = self.element_length
        count = _count(min(self._zone, half_length), shortest)
        end = min(count * shortest, half_length)
        if half_length - end < 0.5 * shortest:  # no sliver at the end of the beam
            end = half_length
        outer = _grown(end, shortest * self.growth, self.growth, half_length, shortest * self.size_ratio)
        return checked_nodes(np.concatenate([np.linspace(0.0, end, count + 1), outer]))

    def refined(self, factor: float) -> Self:
        return dataclasses.replace(super().refined(factor), zone=self._zone)


@dataclass(frozen=True)
class SquareMesh(_Mesh):
    """The thesis's "square" mesh (3.3.5–9): x_i = first_element·√i, so a front x ∝ √t spends the same time in each."""

    first_element: Annotated[float, Quantity("m", "thesis: λ₀√(ah), so that a steps fit into each", above=0.0)]
    zone: Annotated[float, Quantity("m", "half length over which the rule holds; elements grow outside", above=0.0)]
    growth: Growth = 1.25
    size_ratio: SizeRatio = 1e3

    def nodes(self, half_length: float) -> Array:
        end = min(self.zone, half_length)
        if end / self.first_element > math.sqrt(MAXIMUM_NODES):
            raise InputError(
                f"mesh.first_element is too small: more than {MAXIMUM_NODES} elements in the zone "
                f"(got {self.first_element!r} for a zone of {end!r})"
            )
        count = max(2, math.ceil((end / self.first_element) ** 2 - 1e-9))
        inner = self.first_element * np.sqrt(np.arange(count + 1))
        inner *= end / inner[-1]
        inner[-1] = end
        last = inner[-1] - inner[-2]
        outer = _grown(inner[-1], last * self.growth, self.growth, half_length, last * self.size_ratio)
        return checked_nodes(np.concatenate([inner, outer]))

    def refined(self, factor: float) -> Self:
        # x_i = a√i has elements a²/2x: half as long with a/√2
        return dataclasses.replace(super().refined(factor), first_element=self.first_element / math.sqrt(factor))


@dataclass(frozen=True)
class ScaleFreeMesh(_Mesh):
    """Elements in proportion to the distance from the centre, so that every decade of time is resolved alike."""

    element_length: Length
    growth: Growth = 1.01
    largest: Annotated[float | None, Quantity("m", "no element above this", above=0.0, absent="-")] = None
    zone: Annotated[
        float | None, Quantity("m", "half length; beyond it elements grow by growth_outside", above=0.0, absent="-")
    ] = None
    growth_outside: Annotated[
        float | None, Quantity("", "ratio of neighbours outside the zone", least=1.0, absent="-")
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.largest is not None:
            at_least("mesh.largest", self.largest, self.element_length)
        if (self.zone is None) != (self.growth_outside is None):
            raise InputError(
                "mesh.zone and mesh.growth_outside go together: neither has an effect without the other "
                f"(got {self.zone!r} and {self.growth_outside!r})"
            )

    def nodes(self, half_length: float) -> Array:
        if self.growth == 1.0:
            _count(half_length, self.element_length)
        first = min(self.element_length, 0.5 * half_length)
        largest = math.inf if self.largest is None else self.largest
        end = half_length if self.zone is None else min(self.zone, half_length)
        inner = np.concatenate([[0.0], _grown(0.0, min(first, end), self.growth, end, largest)])
        if self.growth_outside is None or end == half_length:
            return checked_nodes(inner)
        last = min(float(inner[-1] - inner[-2]) * self.growth_outside, half_length - end)
        outer = _grown(end, last, self.growth_outside, half_length, max(largest, last))
        return checked_nodes(np.concatenate([inner, outer]))


@dataclass(frozen=True)
class NodesMesh(_Mesh):
    """Node places given one by one."""

    places: Annotated[tuple[float, ...], Quantity("m", "strictly increasing from 0 to the half length")]

    def __post_init__(self) -> None:
        if not isinstance(self.places, list | tuple):
            raise InputError(f"mesh.places must be a list of numbers (got {shortened(self.places)})")
        places = [finite("mesh.places", place) for place in self.places]
        object.__setattr__(self, "places", tuple(checked_nodes(np.array(places)).tolist()))
        if self.places[0] != 0.0:
            raise InputError(f"mesh.places must start at 0 (got {self.places[0]!r})")

    def nodes(self, half_length: float) -> Array:
        places = np.asarray(self.places)
        if abs(places[-1] - half_length) > 1e-9 * half_length:
            raise InputError(f"mesh.places must end at the half length {half_length!r} (got {self.places[-1]!r})")
        return places

    def refined(self, factor: float) -> Self:
        number = np.arange(len(self.places))
        count = max(2, round(factor * number[-1]))
        return type(self)(tuple(np.interp(np.linspace(0.0, number[-1], count + 1), number, self.places).tolist()))


MESHES: dict[str, type] = {
    "uniform": UniformMesh,
    "graded": GradedMesh,
    "square": SquareMesh,
    "scale_free": ScaleFreeMesh,
    "nodes": NodesMesh,
}
"""Kinds of a case file's ``[mesh]`` table."""
