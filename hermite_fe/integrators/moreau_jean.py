"""Moreau–Jean: a θ-scheme for measures, Signorini and the impact law at velocity level.

    M(v⁺ − v) + hC v_θ + hK q_θ = hF_θ + Gᵀp,   q⁺ = q + h v_θ;   0 ≤ p ⊥ Gv⁺ + eGv ≥ 0
    for the constraints with  g + (1 − θ)h ġ ≤ 0

A constraint takes part when closing it now would leave it in the wall or on it; so a closed one stays a candidate.
(Jean 1999, "The non-smooth contact dynamics method"; thesis 3.2.1–4 and Fig. 3.6 for its drift at position level.)
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

__all__ = ["MoreauJean"]


@dataclass(frozen=True)
class MoreauJean(Integrator):
    """A θ-scheme with the impact law at velocity level."""

    holds: ClassVar[bool] = True
    hysteretic: ClassVar[bool] = True
    holds_zone: ClassVar[bool] = True

    theta: Annotated[
        float, Quantity("", "θ; ½ conserves energy between impacts, 1 damps unresolved waves", least=0.5, most=1.0)
    ] = 1.0

    def start(self, problem: Problem, state: State) -> ThetaMemory:
        return theta_memory(problem)

    def advance(
        self, problem: Problem, state: State, memory: ThetaMemory, times: NDArray[np.float64], first: int, last: int
    ) -> tuple[int, int]:
        return take_steps(problem, state, memory, times, first, last, self.theta, False)
