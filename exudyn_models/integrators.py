"""Exudyn's time integrators; ``INTEGRATORS`` names them for ``[exudyn.integrator]``.

The impact has no time scale of its own: implicit steps grow with the time since impact, h = c·t, so that every decade
is resolved alike, starting from the time in which the front crosses the first element. Those of a whole beam are
constant at the wall (:mod:`exudyn_models.whole_beam`).

The explicit methods, the fourth-order Runge–Kutta rule, Dormand–Prince 5(4) and velocity Verlet, are stable while the
step is below limit/ω, where ω bounds the frequencies (and decay rates) of the mesh with every contact closed: for
bending ω ~ 91.7 √(EI/μ)/Δx² of the smallest element. ``simulate`` computes the bound and refuses a larger step.
"""

import dataclasses
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self

import exudyn as exu
import numpy as np

from bent_beam.checks import between
from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from exudyn_models.geometry import Array
from exudyn_models.segments import Segment, growing_segments

__all__ = [
    "DOPRI5", "INTEGRATORS", "RK44", "Averages", "GeneralizedAlpha", "Integrator", "Newmark", "Trapezoidal",
    "VelocityVerlet",
]  # fmt: skip


@dataclass(frozen=True)
class Averages:
    """How a scheme turns forces at the ends of a step into its impulse (Chung & Hulbert 1993; Newmark: αm = αf = 0, in
    Exudyn both ½, which is the same, φ = f, as runs start with a = v̇):

    Δp = h[(1−γ) φ₀ + γ φ₁],   (1−αm) φ₁ + αm φ₀ = (1−αf) f₁ + αf f₀.
    """

    gamma: float = 0.5
    alpha_m: float = 0.0
    alpha_f: float = 0.0

    def impulses(self, forces: Array, averaged: Array) -> tuple[Array, Array]:
        """Impulse of forces over the length of each step, (steps, points), and the last average φ₁.

        forces : at the ends of the steps, (steps + 1, points). averaged : the first φ₀, (points,).
        """
        averages = np.empty_like(forces)
        averages[0] = averaged
        averages[1:] = ((1.0 - self.alpha_f) * forces[1:] + self.alpha_f * forces[:-1]) / (1.0 - self.alpha_m)
        for k in range(1, len(averages)):
            averages[k] -= self.alpha_m / (1.0 - self.alpha_m) * averages[k - 1]
        return (1.0 - self.gamma) * averages[:-1] + self.gamma * averages[1:], averages[-1]


@dataclass(frozen=True)
class Integrator(Part, ABC):
    """Base of the integrators."""

    where: ClassVar[str] = "exudyn.integrator"
    explicit: ClassVar[bool] = False
    limit: ClassVar[float] = math.inf  # of step × largest frequency
    time_step: float | None

    def refined(self, factor: float) -> Self:
        """A copy with steps ``factor`` times shorter; what is not chosen yet stays open."""
        steps = {name: getattr(self, name, None) for name in ("time_step", "relative_step", "flight_step")}
        return dataclasses.replace(self, **{name: step / factor for name, step in steps.items() if step is not None})

    def averages(self) -> Averages:
        """What forces at the ends of a step make of its impulse; the mean where nothing better is known."""
        return Averages()

    @abstractmethod
    def configure(self, settings: Any) -> None:
        """Write this integrator's choices into Exudyn's ``SimulationSettings``."""

    @abstractmethod
    def segments(self, first: float, unit: float, stable: float) -> list[Segment]:
        """The plan of steps in model units: ``first`` the time the front needs for the first element, ``unit`` the
        model's time unit in s, ``stable`` the largest stable step of an explicit method."""


@dataclass(frozen=True)
class Implicit(Integrator):
    """Base of the implicit integrators. Steps that are left open are chosen for the problem."""

    default_step: ClassVar[float] = 2e-3  # h/t

    time_step: Annotated[
        float | None, Quantity("s", "constant step", above=0.0, absent="grows with the time since impact")
    ] = None
    relative_step: Annotated[
        float | None, Quantity("", "h/t, where steps grow", above=0.0, absent="2e-3 (generalized_alpha: 8e-3) or less")
    ] = None
    flight_step: Annotated[
        float | None, Quantity("s", "longest step of a beam off the wall", above=0.0, absent="time_step")
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.time_step is not None and self.relative_step is not None:
            raise InputError(
                "exudyn.integrator.time_step and relative_step exclude each other: give one "
                f"(got {self.time_step!r} and {self.relative_step!r})"
            )
        if self.flight_step is not None and self.flight_step < (self.time_step or math.inf):
            raise InputError(
                f"exudyn.integrator.flight_step must be as long as a time_step that is given, at least (got "
                f"{self.flight_step!r} and {self.time_step!r})"
            )

    @property
    def is_open(self) -> bool:
        """Whether nobody asked for steps."""
        return self.time_step is None and self.relative_step is None

    def segments(self, first: float, unit: float, stable: float) -> list[Segment]:
        if self.time_step is None:
            relative = self.relative_step or self.default_step
            return growing_segments(first if self.relative_step is None else min(first, relative), relative)
        return [Segment(0.0, 1.0, round(1.0 / max(min(1.0, self.time_step / unit), 1e-300)))]


@dataclass(frozen=True)
class GeneralizedAlpha(Implicit):
    """Generalised-α (Chung and Hulbert 1993), of second order: what the step cannot resolve is damped to ρ∞."""

    default_step: ClassVar[float] = 8e-3  # second order: 4e-3 moves λ₀ and r₀ by 6e-6 at κ/ν = 0.1, 0.25 and 0.5

    spectral_radius: Annotated[
        float, Quantity("", "ρ∞; 1: no damping, contact without dashpots rattles; 0: full damping", least=0.0, most=1.0)
    ] = 0.5

    def averages(self) -> Averages:
        rho = self.spectral_radius
        alpha_m, alpha_f = (2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0)
        return Averages(gamma=0.5 + alpha_f - alpha_m, alpha_m=alpha_m, alpha_f=alpha_f)

    def configure(self, settings: Any) -> None:
        settings.timeIntegration.solverType = exu.DynamicSolverType.GeneralizedAlpha
        settings.timeIntegration.generalizedAlpha.spectralRadius = self.spectral_radius


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
        settings.timeIntegration.solverType = exu.DynamicSolverType.GeneralizedAlpha
        rule = settings.timeIntegration.generalizedAlpha
        rule.useNewmark = rule.useIndex2Constraints = True
        rule.newmarkGamma = self.gamma
        rule.newmarkBeta = (self.gamma + 0.5) ** 2 / 4 if self.beta is None else self.beta


@dataclass(frozen=True)
class Trapezoidal(Implicit):
    """The implicit trapezoidal rule, v⁺ = v + h(a + a⁺)/2, u⁺ = u + h(v + v⁺)/2; constraints at velocity level.

    It damps nothing: what quiets the contact is the penalty's damping and the grid-scale viscosity.
    """

    def configure(self, settings: Any) -> None:
        Newmark(gamma=0.5, beta=0.25).configure(settings)  # Exudyn's TrapezoidalIndex2


@dataclass(frozen=True)
class _Explicit(Integrator):
    time_step: Annotated[
        float | None, Quantity("s", "not above the stable step", above=0.0, absent="safety × the stable step")
    ] = None
    safety: Annotated[float, Quantity("", "time step over the stable one", least=1e-6, most=1.0)] = 0.8

    explicit: ClassVar[bool] = True
    method: ClassVar[Any]

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.time_step is not None and self.safety != type(self).safety:
            raise InputError(
                f"exudyn.integrator.safety has no effect next to time_step: give one of them (got {self.safety!r})"
            )

    def configure(self, settings: Any) -> None:
        settings.timeIntegration.solverType = self.method
        settings.timeIntegration.automaticStepSize = False
        settings.timeIntegration.explicit.computeEndOfStepAccelerations = True  # the energy budget needs them
        # the contact state at the start of a step serves all of it: a repetition would put Exudyn's own in its place
        settings.timeIntegration.discontinuous.maxIterations = 1

    def segments(self, first: float, unit: float, stable: float) -> list[Segment]:
        step = self.safety * stable if self.time_step is None else self.time_step / unit
        if step > stable:
            raise InputError(
                f"exudyn.integrator.time_step must not exceed the stable step {stable * unit:.4g} s of this "
                f"mesh and contact (got {self.time_step!r})"
            )
        return [Segment(0.0, 1.0, math.ceil(1.0 / max(step, 1e-300)))]


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


INTEGRATORS: dict[str, type] = {
    "generalized_alpha": GeneralizedAlpha,
    "newmark": Newmark,
    "trapezoidal": Trapezoidal,
    "rk44": RK44,
    "dopri5": DOPRI5,
    "velocity_verlet": VelocityVerlet,
}
