"""The mesh of the infinite beam: x = ζ l* √(t/t*), fine at the front, which stands still in it."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import at_least, between, positive, whole

__all__ = ["MESHES", "ExpandingMesh"]

Array = NDArray[np.float64]
MAXIMUM_NODES = 100_000


@dataclass(frozen=True)
class ExpandingMesh:
    """Mesh x = ζ l* √(t/t*) of an infinite beam; lengths below are in ζ unless said otherwise.

    front_resolution : element at the front over the front's thickness 2/√(1 + λ²), or over 2λ where that is less.
    growth : growth of elements away from the front, per length (0.02: 2 % an element).
    elements_per_wave : elements per wavelength 4π/ζ of what the impact radiates.
    interior_elements : at least so many elements inside the contact zone.
    absorber_start, absorber_length : clear distance ahead of the front, and length of the absorbing ramp.
    absorber_strength : σ at its end over ζ/length there; the wave leaves with exp(−strength/4) twice.
    step_ratio : h/t of the time steps.
    decades : decades of time simulated before ``end_time``.
    """

    front_resolution: float = 0.01
    growth: float = 0.02
    elements_per_wave: int = 20
    interior_elements: int = 40
    absorber_start: float = 8.0
    absorber_length: float = 16.0
    absorber_strength: float = 40.0
    step_ratio: float = 0.02
    decades: float = 4.0

    def __post_init__(self) -> None:
        between("mesh.front_resolution", positive("mesh.front_resolution", self.front_resolution), 0.0, 0.5)
        between("mesh.growth", positive("mesh.growth", self.growth), 0.0, 0.2)
        whole("mesh.elements_per_wave", self.elements_per_wave, 6)
        whole("mesh.interior_elements", self.interior_elements, 4)
        for name in ("absorber_start", "absorber_length", "absorber_strength"):
            positive(f"mesh.{name}", getattr(self, name))
        between("mesh.step_ratio", positive("mesh.step_ratio", self.step_ratio), 0.0, 0.5)
        between("mesh.decades", at_least("mesh.decades", self.decades, 0.5), 0.5, 12.0)

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
        while front > 0.0 and behind[-1] > 0.0 and len(behind) <= MAXIMUM_NODES:
            behind.append(behind[-1] - size(behind[-1]))
        if len(ahead) + len(behind) > MAXIMUM_NODES:
            raise ValueError(
                f"mesh: more than {MAXIMUM_NODES} elements to follow a front at {front:.3g} sqrt(t) (kappa/nu too "
                "small, or mesh.front_resolution, growth, elements_per_wave, interior_elements or absorber_length)"
            )
        inner = np.array(behind[:0:-1]) if front > 0.0 else np.empty(0)
        if inner.size:  # stretched so that it begins at the centre exactly
            inner = front - (front - inner) * (front / (front - inner[0]))
            inner[0] = 0.0
        return np.concatenate([inner, ahead]), start

    def refined(self, factor: float) -> ExpandingMesh:
        """The same mesh with elements and steps ``factor`` times shorter."""
        return dataclasses.replace(
            self,
            front_resolution=self.front_resolution / factor,
            growth=self.growth / factor,
            elements_per_wave=round(self.elements_per_wave * factor),
            interior_elements=round(self.interior_elements * factor),
            step_ratio=self.step_ratio / factor,
        )


MESHES: dict[str, type] = {"expanding": ExpandingMesh}
"""Kinds of a case file's ``[self_similar.mesh]`` table."""
