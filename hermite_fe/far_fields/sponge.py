"""A sponge: bending viscosity that rises towards the ends, next to that at grid scale.

    C = Σ_e η_e Kₑ,    η_e = (c Δx_e² + b w² s³)·√(μ/EI),    s = 1 − (distance to the end)/w ∈ [0, 1] within w of an end

A wave of number k decays over the sponge by exp(−b (kw)³/16) on its way out, and as much on its way back; how
little the onset itself sends back depends on how many waves fit into the sponge. Measured with the default b:
1e-4 of the amplitude for waves shorter than w/8, 1e-2 for w/4 (tests/hermite_fe). Viscosity of bending,
unlike drag, takes no momentum and leaves rigid motion alone.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import between, non_negative
from bent_beam.impact import Impact
from hermite_fe.beam import HermiteBeam
from hermite_fe.far_fields.base import FarField

__all__ = ["Sponge"]


@dataclass(frozen=True)
class Sponge(FarField):
    """viscosity : c at grid scale; strength : b, dimensionless; width : w over the half length of the
    beam."""

    viscosity: float = 0.3
    strength: float = 0.03
    width: float = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        non_negative("far_field.viscosity", self.viscosity)
        non_negative("far_field.strength", self.strength)
        between("far_field.width", self.width, 0.0, 1.0)

    def damping(self, beam: HermiteBeam, impact: Impact) -> NDArray[np.float64]:
        (_, grid), (_, absorber) = self.dampings(beam, impact)
        return grid + absorber

    def dampings(self, beam: HermiteBeam, impact: Impact) -> tuple[tuple[str, NDArray[np.float64]], ...]:
        middles = 0.5 * (beam.nodes[:-1] + beam.nodes[1:])
        width = self.width * impact.half_length
        grid, absorber = self.viscosity * beam.lengths**2, np.zeros(middles.size)
        if width > 0.0:
            depth = np.clip(1.0 - (impact.half_length - np.abs(middles)) / width, 0.0, 1.0)
            absorber = self.strength * width**2 * depth**3
        return (
            ("viscous", beam.stiffness(weight=grid / impact.wave_constant)),
            ("absorbed", beam.stiffness(weight=absorber / impact.wave_constant)),
        )
