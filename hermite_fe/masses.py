"""Mass matrices, consistent and lumped: M of a Hermite beam in lower banded form, from element matrices.

The translational part of an element's mass is the same for all of them: a uniform field of velocity v carries
½μlv² per element (patch test). They differ in what the rotations carry.

**Consistent**: Mₑ = μ ∫ NᵀN dx (thesis 3.1.7–8). **Lumped**: Mₑ = diag(½μl, r μl³, ½μl, r μl³).
Half of an element's mass sits at each node; what the rotation there carries is not fixed by the mass of the
beam, and the literature has several values of r:

| r | from |
| --- | --- |
| 1/24 | half the element as a rod that turns about its end (Cook, Malkus, Plesha, Witt 2002, § 11.3) |
| 1/78 | the diagonal of the consistent matrix, scaled to the element's mass (Hinton, Rock, Zienkiewicz 1976) |
| 1/105 | the rotary diagonal of the consistent matrix, unscaled |
| 1/420 | the row sum of its rotational block |
| → 0 | rotations without inertia |

As r → 0 the matrix becomes singular and with it the accelerations: r must be positive, small values show the limit.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from bent_beam.fields import Part, Quantity
from hermite_fe.beam import HermiteBeam
from hermite_fe.compiled import Array

__all__ = ["MASSES", "ConsistentMass", "LumpedMass", "Mass"]


@dataclass(frozen=True)
class Mass(Part, ABC):
    """Base of the mass matrices."""

    where: ClassVar[str] = "hermite.mass"

    @abstractmethod
    def element(self, beam: HermiteBeam) -> Array:
        """Mₑ of each element, dofs (w₁, θ₁, w₂, θ₂), shape (elements, 4, 4), kg, kg m and kg m²."""

    def matrix(self, beam: HermiteBeam) -> Array:
        """M in lower banded form, shape (4, dofs)."""
        return beam.assembled(self.element(beam))


@dataclass(frozen=True)
class ConsistentMass(Mass):
    """Kinetic energy of the interpolated velocity, exactly; a full 4 × 4 matrix an element."""

    def element(self, beam: HermiteBeam) -> Array:
        return beam.element_masses()


@dataclass(frozen=True)
class LumpedMass(Mass):
    """Half of an element's mass at each node, with a rotary inertia, to which that of the sections is added."""

    rotary: Annotated[
        float, Quantity("", "r: rotary inertia of an element at each of its nodes over μl³", above=0.0)
    ] = 1.0 / 78.0

    def element(self, beam: HermiteBeam) -> Array:
        lengths, mass = beam.lengths, beam.mass_per_length * beam.lengths
        share = np.stack([0.5 * mass, mass * (self.rotary * lengths**2)], axis=1)
        share[:, 1] += 0.5 * beam.rotary_inertia * lengths
        return np.asarray(np.tile(share, 2)[:, :, None] * np.eye(4))


MASSES: dict[str, type] = {"consistent": ConsistentMass, "lumped": LumpedMass}
"""Kinds of a case file's ``[hermite.mass]`` table."""
