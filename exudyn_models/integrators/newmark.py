"""Newmark's method: v⁺ = v + h[(1−γ)a + γa⁺], u⁺ = u + hv + h²[(½−β)a + βa⁺]; γ > ½ damps, at first order."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import exudyn as exu

from bent_beam.checks import between
from exudyn_models.integrators.base import Averages, Implicit

__all__ = ["Newmark"]


@dataclass(frozen=True)
class Newmark(Implicit):
    """Constraints hold at velocity level (index 2).

    gamma : γ from ½ to 2; above ½ it damps what the step cannot resolve, and the accuracy is of first order.
    beta : β from γ/2 to 2; None: (γ+½)²/4, which damps high frequencies most.
    """

    gamma: float = 0.6
    beta: float | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        between("exudyn.integrator.gamma", self.gamma, 0.5, 2.0)
        if self.beta is not None:
            between("exudyn.integrator.beta", self.beta, self.gamma / 2, 2.0)

    def averages(self) -> Averages:
        return Averages(gamma=self.gamma)

    def configure(self, settings: Any) -> None:
        settings.timeIntegration.solverType = exu.DynamicSolverType.GeneralizedAlpha
        rule = settings.timeIntegration.generalizedAlpha
        rule.useNewmark = True
        rule.useIndex2Constraints = True
        rule.newmarkGamma = self.gamma
        rule.newmarkBeta = (self.gamma + 0.5) ** 2 / 4 if self.beta is None else self.beta
