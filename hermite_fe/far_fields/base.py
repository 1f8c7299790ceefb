"""What happens to the waves that leave: nothing comes back, by a damping matrix, and what holds the far end.

Waves whose length approaches the element are slowed, trapped and, where elements grow, sent back. A bending
viscosity in proportion to the element's length squared,

    C = Σ_e c Δx_e² √(μ/EI) Kₑ,

damps a wave of number k with the ratio ζ = ½c(kΔx)², that is, only what the mesh cannot carry anyway: the
same in every element whatever its size, and gone under refinement like Δx².
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import one_of
from bent_beam.impact import Impact
from hermite_fe.beam import HermiteBeam

__all__ = ["ENDS", "FarField"]

ENDS = ("free", "following")


@dataclass(frozen=True)
class FarField(ABC):
    """Base of the far fields.

    end : "free", as the ends of a real beam are; or "following": the end forces and moments that a₀, c₀, q₀
        need are applied, as if the beam went on, so that without contact the motion is y₀ everywhere (for a
        comparison with the theory of the infinite beam).
    """

    end: str = "free"

    def __post_init__(self) -> None:
        one_of("far_field.end", self.end, ENDS)

    @abstractmethod
    def damping(self, beam: HermiteBeam, impact: Impact) -> NDArray[np.float64]:
        """C in lower banded form, shape (4, dofs)."""

    def dampings(self, beam: HermiteBeam, impact: Impact) -> tuple[tuple[str, NDArray[np.float64]], ...]:
        """The parts of C by cause, as :class:`hermite_fe.system.System` takes them: all viscous unless said
        otherwise."""
        return (("viscous", self.damping(beam, impact)),)
