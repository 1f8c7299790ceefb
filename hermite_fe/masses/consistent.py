"""The consistent mass matrix Mₑ = μ ∫ NᵀN dx (thesis 3.1.7–8)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import element_mass
from hermite_fe.masses.base import Mass

__all__ = ["ConsistentMass"]


@dataclass(frozen=True)
class ConsistentMass(Mass):
    """Kinetic energy of the interpolated velocity, exactly; a full 4 × 4 matrix an element."""

    def element(self, lengths: NDArray[np.float64], mass_per_length: float) -> NDArray[np.float64]:
        return element_mass(lengths, mass_per_length)
