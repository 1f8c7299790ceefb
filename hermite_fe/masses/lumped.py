"""The lumped (diagonal) mass matrix Mₑ = diag(½μl, r μl³, ½μl, r μl³).

Half of an element's mass sits at each node; what the rotation there carries is not fixed by the mass of the
beam, and the literature has several values of r:

| r | from |
| --- | --- |
| 1/24 | half the element as a rod that turns about its end (Cook, Malkus, Plesha, Witt 2002, § 11.3) |
| 1/78 | the diagonal of the consistent matrix, scaled to the element's mass (Hinton, Rock, Zienkiewicz 1976) |
| 1/105 | the diagonal of the consistent matrix as it is |
| 1/420 | the row sum of its rotational block |
| → 0 | rotations without inertia |

As r → 0 the matrix becomes singular and with it the accelerations: r must be positive, small values show the limit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import positive
from hermite_fe.masses.base import Mass

__all__ = ["LumpedMass"]


@dataclass(frozen=True)
class LumpedMass(Mass):
    """rotary : r, the rotary inertia that an element gives to each of its nodes over μl³."""

    rotary: float = 1.0 / 78.0

    def __post_init__(self) -> None:
        positive("mass.rotary", self.rotary)

    def element(self, lengths: NDArray[np.float64], mass_per_length: float) -> NDArray[np.float64]:
        share = np.stack([np.full(lengths.size, 0.5), self.rotary * lengths**2], axis=1)
        diagonal = mass_per_length * lengths[:, None] * np.tile(share, 2)
        return np.asarray(diagonal[:, :, None] * np.eye(4))
