"""Exudyn's explicit methods: the fourth-order Runge–Kutta rule, Dormand–Prince 5(4), and velocity Verlet.

They are stable while the step is below limit/ω, where ω bounds the frequencies (and decay rates) of the mesh with
every contact closed: for bending ω ~ 91.7 √(EI/μ)/Δx² of the smallest element. ``simulate`` computes the bound and
refuses a larger step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

import exudyn as exu

from bent_beam.fields import Quantity
from exudyn_models.integrators.base import Integrator, Segment, checked_steps

__all__ = ["DOPRI5", "RK44", "VelocityVerlet"]


@dataclass(frozen=True)
class _Explicit(Integrator):
    time_step: Annotated[
        float | None, Quantity("s", "not above the stable step", above=0.0, absent="safety × the stable step")
    ] = None
    safety: Annotated[float, Quantity("", "time step over the stable one", least=1e-6, most=1.0)] = 0.8

    explicit: ClassVar[bool] = True
    method: ClassVar[Any]

    def configure(self, settings: Any) -> None:
        settings.timeIntegration.solverType = self.method
        settings.timeIntegration.automaticStepSize = False
        settings.timeIntegration.explicit.computeEndOfStepAccelerations = True  # the energy budget needs them
        # the contact state at the start of a step serves all of it: a repetition would put Exudyn's own in its place
        settings.timeIntegration.discontinuous.maxIterations = 1

    def segments(self, first: float, unit: float, stable: float) -> list[Segment]:
        step = self.safety * stable
        if self.time_step is not None:
            step = self.time_step / unit
            if step > stable:
                raise ValueError(
                    f"exudyn.integrator.time_step must not exceed the stable step {stable * unit:.4g} s of this "
                    f"mesh and contact (got {self.time_step!r})"
                )
        checked_steps(1.0 / max(step, 1e-300))
        return [Segment(0.0, 1.0, math.ceil(1.0 / step))]


@dataclass(frozen=True)
class RK44(_Explicit):
    """The classical Runge–Kutta method."""

    limit: ClassVar[float] = 2.6
    method: ClassVar[Any] = exu.DynamicSolverType.RK44


@dataclass(frozen=True)
class DOPRI5(_Explicit):
    """Dormand–Prince 5(4), at a fixed step: its error control would chase every contact event."""

    limit: ClassVar[float] = 1.0
    method: ClassVar[Any] = exu.DynamicSolverType.DOPRI5


@dataclass(frozen=True)
class VelocityVerlet(_Explicit):
    """Velocity Verlet (leap-frog), second order, one evaluation a step."""

    limit: ClassVar[float] = 1.6
    method: ClassVar[Any] = exu.DynamicSolverType.VelocityVerlet
