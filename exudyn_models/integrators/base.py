"""What every integrator says of itself, and the plan of steps common to the implicit ones.

The impact has no time scale of its own: implicit steps grow with the time since impact, h = c·t, so that every decade
is resolved alike, starting from the time in which the front crosses the first element.
"""

from __future__ import annotations

import dataclasses
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, cast

import exudyn as exu
import numpy as np

from bent_beam.fields import Part
from exudyn_models.arrays import Array

__all__ = ["Averages", "Integrator", "Segment", "checked_steps", "growing_segments"]

MAXIMUM_STEPS = 5_000_000
EVEN = 12.5  # steps of one length at least, while steps grow …
CHANGE = 1.05  # … or as many as it takes them to grow by this factor


@dataclass(frozen=True)
class Segment:
    """``steps`` equal time steps from ``start`` to ``end`` (model units), taken inside Exudyn without interruption."""

    start: float
    end: float
    steps: int

    @property
    def length(self) -> float:
        """Of one step."""
        return (self.end - self.start) / self.steps


@dataclass(frozen=True)
class Averages:
    """How a scheme turns forces at the ends of a step into its impulse (Chung & Hulbert 1993; Newmark: αm = αf = 0):

    Δp = h[(1−γ) φ₀ + γ φ₁],   (1−αm) φ₁ + αm φ₀ = (1−αf) f₁ + αf f₀.
    """

    gamma: float = 0.5
    alpha_m: float = 0.0
    alpha_f: float = 0.0

    def impulses(self, forces: Array, averaged: Array) -> tuple[Array, Array]:
        """Impulse of forces over the length of each step, (steps, points), and the last average φ₁.

        forces : at the ends of the steps, (steps + 1, points). averaged : the first φ₀, (points,).
        """
        steps = forces.shape[0] - 1
        averages = np.empty((steps + 1, forces.shape[1]))
        averages[0] = averaged
        averages[1:] = ((1.0 - self.alpha_f) * forces[1:] + self.alpha_f * forces[:-1]) / (1.0 - self.alpha_m)
        if self.alpha_m:
            apart = np.subtract.outer(np.arange(steps + 1), np.arange(steps + 1))
            averages = np.tril((-self.alpha_m / (1.0 - self.alpha_m)) ** np.maximum(apart, 0)) @ averages
        return (1.0 - self.gamma) * averages[:-1] + self.gamma * averages[1:], averages[-1]


def checked_steps(count: float) -> None:
    """``ValueError`` when a plan has more steps than any run takes."""
    if not count <= MAXIMUM_STEPS:
        raise ValueError(
            f"exudyn.integrator.time_step or relative_step is too small: {count:.3g} steps, {MAXIMUM_STEPS:.2g} are "
            "the most"
        )


def growing_segments(first: float, relative: float, constant: bool = False) -> list[Segment]:
    """Segments over 0 ≤ t ≤ 1: steps of ``first``, then of ``relative``·t (``constant``: of ``first`` throughout).

    A new step size costs a factorisation: it changes by ``CHANGE`` at a time, or by what ``EVEN`` steps make of it.
    """
    even, grown = 1.0 / max(first, 1e-300), 0.0
    if not constant:
        even, grown = min(even, 1.0 / relative), math.log(max(relative * even, 1.0)) / math.log1p(relative)
    checked_steps(even + grown)
    if constant:
        return [Segment(0.0, 1.0, max(1, round(even)))]
    segments: list[Segment] = []
    t, step, change = 0.0, first, max(CHANGE, 1.0 + EVEN * relative)
    while t < 1.0 - 1e-12:
        count = max(1, math.ceil((change * step / relative - t) / step - 1e-9))
        if t + count * step > 1.0 - step * 1e-6:
            count = max(1, round((1.0 - t) / step + 0.499))
            segments.append(Segment(t, 1.0, count))
            break
        segments.append(Segment(t, t + count * step, count))
        t += count * step
        step = max(step, relative * t)
    return segments


class Integrator(Part, ABC):
    """Base of the integrators."""

    where: ClassVar[str] = "exudyn.integrator"
    explicit: ClassVar[bool] = False
    limit: ClassVar[float] = math.inf  # of step × largest frequency
    time_step: float | None

    def refined(self, factor: float) -> Integrator:
        """A copy with steps ``factor`` times shorter; what is not chosen yet stays open."""
        shorter = {
            name: getattr(self, name) / factor
            for name in ("time_step", "relative_step")
            if getattr(self, name, None) is not None
        }
        return cast(Integrator, dataclasses.replace(cast(Any, self), **shorter))

    def averages(self) -> Averages:
        """What forces at the ends of a step make of its impulse; the mean where nothing better is known."""
        return Averages()

    def solver(self) -> Any:
        """A fresh Exudyn solver object."""
        return exu.MainSolverExplicit() if self.explicit else exu.MainSolverImplicitSecondOrder()

    @abstractmethod
    def configure(self, settings: Any) -> None:
        """Write this integrator's choices into Exudyn's ``SimulationSettings``."""

    @abstractmethod
    def segments(self, first: float, unit: float, stable: float) -> list[Segment]:
        """The plan of steps in model units: ``first`` the time the front needs for the first element, ``unit`` the
        model's time unit in s, ``stable`` the largest stable step of an explicit method."""
