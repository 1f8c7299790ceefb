"""Implicit θ-stepping with Signorini's condition at the new position: no drift.

    M(v⁺ − v) + hC v_θ + hK q_θ = hF_θ + Gᵀp,   q⁺ = q + h v_θ;   0 ≤ p ⊥ g⁺ = g₀ + Gq⁺ ≥ 0

A constraint that reaches the wall within a step ends it on the wall exactly. The scheme has no impact law: with θ = 1
the constraint is at rest a step later, with θ = ½ it keeps a share of its speed that depends on when in the step it
lands.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from bent_beam.fields import Quantity
from hermite_fe.integrators.base import Integrator
from hermite_fe.integrators.theta import ThetaMemory, take_steps, theta_memory
from hermite_fe.stepping import Problem, State

__all__ = ["SignoriniPosition"]


@dataclass(frozen=True)
class SignoriniPosition(Integrator):
    """A θ-scheme with Signorini's condition at the new position.

    For the infinite beam's first instants θ = 1: θ near ½ makes closed constraints rattle. For a whole beam with
    damping of its own ½, which damps nothing but impacts.
    """

    holds: ClassVar[bool] = True
    hysteretic: ClassVar[bool] = True
    holds_zone: ClassVar[bool] = True
    elements_in_first_front: ClassVar[float] = 3.0

    theta: Annotated[float, Quantity("", "θ; 1: implicit Euler", least=0.5, most=1.0)] = 1.0

    def start(self, problem: Problem, state: State) -> ThetaMemory:
        e = problem.law.restitution
        if e > 0.0:
            raise ValueError(f"signorini_position has no impact law: restitution must be 0 (got {e!r})")
        return theta_memory(problem)

    def advance(
        self, problem: Problem, state: State, memory: ThetaMemory, times: NDArray[np.float64], first: int, last: int
    ) -> tuple[int, int]:
        return take_steps(problem, state, memory, times, first, last, self.theta, True)
