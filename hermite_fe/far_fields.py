"""The far field: the damping matrix that takes waves out before the end of the mesh, and what holds that end.

Waves whose length approaches the element are slowed, trapped and, where elements grow, sent back. A bending
viscosity in proportion to the element's length squared,

    C = Σ_e c Δx_e² √(μ/EI) Kₑ,

damps a wave of number k with the ratio ζ = ½c(kΔx)², that is, only what the mesh cannot carry anyway: the
same in every element whatever its size, and gone under refinement like Δx².

A sponge: bending viscosity that rises towards the ends, next to that at grid scale.

    C = Σ_e η_e Kₑ,    η_e = (c Δx_e² + b w² s³)·√(μ/EI),    s = 1 − (distance to the end)/w ∈ [0, 1] within w of an end

A wave of number k decays over the sponge by exp(−b (kw)³/16) on its way out, and as much on its way back; how
little the onset itself sends back depends on how many waves fit into the sponge. Measured with the default b:
1e-4 of the amplitude for waves shorter than w/8, 1e-2 for w/4 (tests/hermite_fe). Viscosity of bending,
unlike drag, takes no momentum and leaves rigid motion alone.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from bent_beam.fields import Part, Quantity
from bent_beam.impact import Impact
from hermite_fe.beam import HermiteBeam
from hermite_fe.compiled import Array

__all__ = ["ENDS", "FAR_FIELDS", "Dampings", "FarField", "GridViscosity", "Sponge"]

ENDS = ("free", "following")
Dampings = tuple[tuple[str, Array], ...]


@dataclass(frozen=True)
class FarField(Part, ABC):
    """Base of the far fields.

    The end is "free", as the ends of a real beam are; or "following": the end forces and moments that y₀ needs are
    applied, as if the beam went on, so that without contact the motion is y₀ everywhere (for a comparison with the
    theory of the infinite beam).
    """

    where: ClassVar[str] = "hermite.far_field"

    absorbs: ClassVar[bool] = False
    """Whether it takes waves that the mesh carries, and that the ends of a beam send back."""

    end: Annotated[
        str,
        Quantity("", "of the beam: free, or with the end forces of the free motion, as if it went on", choices=ENDS),
    ] = "free"

    @property
    def damper(self) -> str:
        """What damps waves, in words ("": nothing)."""
        return "the far field" if self.absorbs else ""

    @abstractmethod
    def dampings(self, beam: HermiteBeam, impact: Impact) -> Dampings:
        """C by cause, as :class:`hermite_fe.system.System` takes it."""


@dataclass(frozen=True)
class GridViscosity(FarField):
    """Bending viscosity in proportion to the square of the elements' length."""

    viscosity: Annotated[float, Quantity("", "c at grid scale; 0: none", least=0.0)] = 0.3

    @property
    def damper(self) -> str:
        return "grid viscosity" if self.viscosity else super().damper

    def dampings(self, beam: HermiteBeam, impact: Impact) -> Dampings:
        return (("viscous", beam.stiffness(weight=self.viscosity * beam.lengths**2 / impact.wave_constant)),)


@dataclass(frozen=True)
class Sponge(GridViscosity):
    """Bending viscosity that rises towards the ends."""

    absorbs: ClassVar[bool] = True

    strength: Annotated[float, Quantity("", "b", above=0.0)] = 0.03
    width: Annotated[float, Quantity("", "width over the modelled half length", above=0.0, most=1.0)] = 0.5

    @property
    def damper(self) -> str:
        return "a sponge"

    def dampings(self, beam: HermiteBeam, impact: Impact) -> Dampings:
        middles, half_length = 0.5 * (beam.nodes[:-1] + beam.nodes[1:]), float(beam.nodes[-1])
        width = self.width * half_length
        depth = np.clip(1.0 - (half_length - np.abs(middles)) / width, 0.0, 1.0)
        absorber = self.strength * width**2 * depth**3
        return (*super().dampings(beam, impact), ("absorbed", beam.stiffness(weight=absorber / impact.wave_constant)))


FAR_FIELDS: dict[str, type] = {"viscosity": GridViscosity, "sponge": Sponge}
"""Kinds of a case file's ``[hermite.far_field]`` table."""
