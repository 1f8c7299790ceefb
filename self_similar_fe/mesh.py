"""The mesh of the infinite beam: x = ζ l* √(t/t*), fine at the front, which stands still in it."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity

Array = NDArray[np.float64]
MAXIMUM_NODES = 100_000


@dataclass(frozen=True)
class ExpandingMesh(Part):
    """Mesh x = ζ l* √(t/t*) of an infinite beam; lengths are in ζ unless said otherwise."""

    where: ClassVar[str] = "self_similar.mesh"

    front_resolution: Annotated[
        float,
        Quantity("", "element at the front over its thickness 2/√(1 + λ²), or over 2λ where less", above=0.0, most=0.5),
    ] = 0.01
    growth: Annotated[
        float, Quantity("", "of elements away from the front, per length (0.02: 2 % an element)", above=0.0, most=0.2)
    ] = 0.02
    elements_per_wave: Annotated[int, Quantity("", "elements per radiated wavelength 4π/ζ", least=6)] = 20
    interior_elements: Annotated[int, Quantity("", "at least, inside the contact zone", least=4)] = 40
    absorber_start: Annotated[float, Quantity("", "clear distance ahead of the front", above=0.0)] = 8.0
    absorber_length: Annotated[float, Quantity("", "of the absorbing ramp", above=0.0)] = 16.0
    absorber_strength: Annotated[
        float, Quantity("", "σ at its end over ζ/length; the wave leaves with exp(−strength/4) twice", above=0.0)
    ] = 40.0
    step_ratio: Annotated[float, Quantity("", "h/t of the time steps", above=0.0, most=0.5)] = 0.02
    decades: Annotated[float, Quantity("", "decades of time simulated before the end time", least=0.5, most=12.0)] = 4.0

    def lay(self, front: float) -> tuple[Array, float]:
        """Nodes ζ (n,) from 0 around a front at ``front``, fine there, and where the absorber starts."""
        thickness = 2.0 / math.sqrt(1.0 + front**2)
        coarsest_inside = front / self.interior_elements if front > 0.0 else math.inf
        fine = self.front_resolution * (min(thickness, 2.0 * front) if front > 0.0 else thickness)
        start = front + self.absorber_start
        end = start + self.absorber_length

        def size(place: float) -> float:
            grown = fine + self.growth * max(abs(place - front) - 3.0 * fine, 0.0)
            if place > front:
                return min(grown, 4.0 * math.pi / max(place, 1.0) / self.elements_per_wave)
            return min(grown, coarsest_inside)

        ahead = [front]
        while ahead[-1] < end and len(ahead) <= MAXIMUM_NODES:
            ahead.append(ahead[-1] + size(ahead[-1]))
        behind = [front]
        while behind[-1] > 0.0 and len(behind) <= MAXIMUM_NODES:
            behind.append(behind[-1] - size(behind[-1]))
        if len(ahead) + len(behind) > MAXIMUM_NODES:
            raise InputError(
                f"mesh: more than {MAXIMUM_NODES} elements to follow a front at {front:.3g} sqrt(t) (kappa/nu too "
                "small, or mesh.front_resolution, growth, elements_per_wave, interior_elements or absorber_length)"
            )
        inner = np.array(behind[:0:-1])
        if inner.size:  # stretched so that it begins at the centre exactly
            inner = front - (front - inner) * (front / (front - inner[0]))
            inner[0] = 0.0
        return np.concatenate([inner, ahead]), start

    def refined(self, factor: float) -> ExpandingMesh:
        """The same mesh with elements and steps ``factor`` times shorter."""
        return dataclasses.replace(
            self,
            front_resolution=min(0.5, self.front_resolution / factor),
            growth=min(0.2, self.growth / factor),
            elements_per_wave=max(6, round(self.elements_per_wave * factor)),
            interior_elements=max(4, round(self.interior_elements * factor)),
            step_ratio=min(0.5, self.step_ratio / factor),
        )


MESHES: dict[str, type] = {"expanding": ExpandingMesh}
"""Kinds of a case file's ``[self_similar.mesh]`` table."""
