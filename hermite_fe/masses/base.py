"""What every mass matrix shares: M of a Hermite beam in lower banded form, from element matrices.

The translational part of an element's mass is the same for all of them: a uniform field of velocity v carries
½μlv² per element (patch test). They differ in what the rotations carry.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import HermiteBeam

__all__ = ["Mass"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Mass(ABC):
    """Base of the mass matrices."""

    @abstractmethod
    def element(self, lengths: Array, mass_per_length: float) -> Array:
        """Mₑ of each element, dofs (w₁, θ₁, w₂, θ₂), shape (elements, 4, 4); lengths in m, μ in kg/m."""

    def matrix(self, beam: HermiteBeam) -> Array:
        """M in lower banded form, shape (4, dofs)."""
        return beam.assembled(self.element(beam.lengths, beam.mass_per_length))
