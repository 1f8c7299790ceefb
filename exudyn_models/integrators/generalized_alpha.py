"""Generalised-α (Chung and Hulbert 1993): second order, implicit; what the step cannot resolve is damped to ρ∞."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import exudyn as exu

from bent_beam.checks import between
from exudyn_models.integrators.base import Averages, Implicit

__all__ = ["GeneralizedAlpha"]


@dataclass(frozen=True)
class GeneralizedAlpha(Implicit):
    """The default.

    spectral_radius : ρ∞ in [0, 1]; 1 damps nothing and lets contact rattle, 0 annihilates what is unresolved.
    """

    relative_step: float = 8e-3  # second order: 4e-3 moves λ₀ and r₀ by 6e-6 at κ/ν = 0.1, 0.25 and 0.5
    spectral_radius: float = 0.5

    def __post_init__(self) -> None:
        super().__post_init__()
        between("exudyn.integrator.spectral_radius", self.spectral_radius, 0.0, 1.0)

    def averages(self) -> Averages:
        rho = self.spectral_radius
        alpha_m, alpha_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
        return Averages(gamma=0.5 + alpha_f - alpha_m, alpha_m=alpha_m, alpha_f=alpha_f)

    def configure(self, settings: Any) -> None:
        settings.timeIntegration.solverType = exu.DynamicSolverType.GeneralizedAlpha
        settings.timeIntegration.generalizedAlpha.spectralRadius = self.spectral_radius
