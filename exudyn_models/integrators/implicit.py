"""Exudyn's implicit methods: generalised-α, Newmark and the trapezoidal rule."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

import exudyn as exu

from bent_beam.checks import between
from bent_beam.fields import Quantity
from exudyn_models.integrators.base import Averages, Integrator, Segment, growing_segments

__all__ = ["GeneralizedAlpha", "Implicit", "Newmark", "Trapezoidal"]

RelativeStep = Annotated[float, Quantity("", "h/t, where steps grow", above=0.0)]


@dataclass(frozen=True)
class Implicit(Integrator):
    """Base of the implicit integrators."""

    time_step: Annotated[
        float | None, Quantity("s", "constant step", above=0.0, absent="grows with the time since impact")
    ] = None
    relative_step: RelativeStep = 2e-3

    def segments(self, first: float, unit: float, stable: float) -> list[Segment]:
        step = first if self.time_step is None else min(1.0, self.time_step / unit)
        return growing_segments(step, self.relative_step, constant=self.time_step is not None)


@dataclass(frozen=True)
class GeneralizedAlpha(Implicit):
    """Generalised-α (Chung and Hulbert 1993), of second order: what the step cannot resolve is damped to ρ∞."""

    relative_step: RelativeStep = 8e-3  # second order: 4e-3 moves λ₀ and r₀ by 6e-6 at κ/ν = 0.1, 0.25 and 0.5
    spectral_radius: Annotated[
        float, Quantity("", "ρ∞; 1: no damping, and contact rattles; 0: full damping", least=0.0, most=1.0)
    ] = 0.5

    def averages(self) -> Averages:
        rho = self.spectral_radius
        alpha_m, alpha_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
        return Averages(gamma=0.5 + alpha_f - alpha_m, alpha_m=alpha_m, alpha_f=alpha_f)

    def configure(self, settings: Any) -> None:
        settings.timeIntegration.solverType = exu.DynamicSolverType.GeneralizedAlpha
        settings.timeIntegration.generalizedAlpha.spectralRadius = self.spectral_radius


def _configure_newmark(settings: Any, kind: Any, gamma: float, beta: float) -> None:
    """Newmark's method with constraints at velocity level (index 2)."""
    settings.timeIntegration.solverType = kind
    rule = settings.timeIntegration.generalizedAlpha
    rule.useNewmark = rule.useIndex2Constraints = True
    rule.newmarkGamma, rule.newmarkBeta = gamma, beta


@dataclass(frozen=True)
class Newmark(Implicit):
    """Newmark's method: v⁺ = v + h[(1−γ)a + γa⁺], u⁺ = u + hv + h²[(½−β)a + βa⁺]; constraints at velocity level."""

    gamma: Annotated[
        float, Quantity("", "γ; above ½ unresolved waves are damped, at first order", least=0.5, most=2.0)
    ] = 0.6
    beta: Annotated[
        float | None, Quantity("", "β, γ/2 at least", least=0.25, most=2.0, absent="(γ+½)²/4, which damps most")
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.beta is not None:
            between("exudyn.integrator.beta", self.beta, self.gamma / 2, 2.0)

    def averages(self) -> Averages:
        return Averages(gamma=self.gamma)

    def configure(self, settings: Any) -> None:
        beta = (self.gamma + 0.5) ** 2 / 4 if self.beta is None else self.beta
        _configure_newmark(settings, exu.DynamicSolverType.GeneralizedAlpha, self.gamma, beta)


@dataclass(frozen=True)
class Trapezoidal(Implicit):
    """The implicit trapezoidal rule, v⁺ = v + h(a + a⁺)/2, u⁺ = u + h(v + v⁺)/2; constraints at velocity level.

    It damps nothing: what quiets the contact is the penalty's damping and the grid-scale viscosity.
    """

    def configure(self, settings: Any) -> None:
        _configure_newmark(settings, exu.DynamicSolverType.TrapezoidalIndex2, 0.5, 0.25)
