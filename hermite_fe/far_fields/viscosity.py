"""Bending viscosity at grid scale: ζ = ½c(kΔx)² (:mod:`hermite_fe.far_fields.base`)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import non_negative
from bent_beam.impact import Impact
from hermite_fe.beam import HermiteBeam
from hermite_fe.far_fields.base import FarField

__all__ = ["GridViscosity"]


@dataclass(frozen=True)
class GridViscosity(FarField):
    """viscosity : c, dimensionless (0 switches it off)."""

    viscosity: float = 0.3

    def __post_init__(self) -> None:
        super().__post_init__()
        non_negative("far_field.viscosity", self.viscosity)

    def damping(self, beam: HermiteBeam, impact: Impact) -> NDArray[np.float64]:
        return beam.stiffness(weight=self.viscosity * beam.lengths**2 / impact.wave_constant)
