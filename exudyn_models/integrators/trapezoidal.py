"""The implicit trapezoidal rule, v⁺ = v + h(a + a⁺)/2, u⁺ = u + h(v + v⁺)/2, constraints at velocity level (index 2).

It damps nothing: what quiets the contact is the penalty's damping and the grid-scale viscosity.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import exudyn as exu

from exudyn_models.integrators.base import Implicit

__all__ = ["Trapezoidal"]


@dataclass(frozen=True)
class Trapezoidal(Implicit):
    """Exudyn's ``TrapezoidalIndex2``."""

    def configure(self, settings: Any) -> None:
        settings.timeIntegration.solverType = exu.DynamicSolverType.TrapezoidalIndex2
        rule = settings.timeIntegration.generalizedAlpha
        rule.useNewmark = True
        rule.useIndex2Constraints = True
        rule.newmarkGamma, rule.newmarkBeta = 0.5, 0.25
