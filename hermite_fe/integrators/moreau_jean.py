"""Moreau–Jean: a θ-scheme for measures, Signorini and the impact law at velocity level.

    M(v⁺ − v) + hC v_θ + hK q_θ = hF_θ + Gᵀp,   q⁺ = q + h v_θ;   0 ≤ p ⊥ Gv⁺ + eGv ≥ 0
    for the rows with  g + (1 − θ)h ġ ≤ 0

A row takes part when closing it now would leave it in the wall or on it; so a closed row stays a candidate. (Jean
1999, "The non-smooth contact dynamics method"; thesis 3.2.1–4 and Fig. 3.6 for its drift at position level.)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import between
from hermite_fe.integrators.base import Integrator
from hermite_fe.kernels import theta
from hermite_fe.kernels.problem import ContactLaw, Problem, State, Work

__all__ = ["MoreauJean"]


@dataclass(frozen=True)
class MoreauJean(Integrator):
    """theta : θ ∈ [½, 1]; ½ keeps smooth motion's energy, 1 damps most at grid scale."""

    theta: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        between("integrator.theta", self.theta, 0.5, 1.0)

    def advance(
        self,
        problem: Problem,
        law: ContactLaw,
        state: State,
        works: tuple[Work, ...],
        times: NDArray[np.float64],
        first: int,
        last: int,
    ) -> tuple[int, int]:
        return theta.steps(problem, law, state, works[0], times, first, last, self.theta, False)
