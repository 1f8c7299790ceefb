"""Implicit θ-stepping with Signorini's condition at the new position: no drift, inelastic.

    M(v⁺ − v) + hC v_θ + hK q_θ = hF_θ + Gᵀp,   q⁺ = q + h v_θ;   0 ≤ p ⊥ g⁺ = g₀ + Gq⁺ ≥ 0

A row that reaches the wall within a step is brought to the wall exactly, at rest a step later; the scheme has
no impact law.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import between
from hermite_fe.integrators.base import Integrator
from hermite_fe.kernels import theta
from hermite_fe.kernels.problem import ContactLaw, Problem, State, Work

__all__ = ["SignoriniPosition"]


@dataclass(frozen=True)
class SignoriniPosition(Integrator):
    """theta : θ ∈ [½, 1]; 1 (implicit Euler) is the one to use: θ near ½ makes closed rows rattle."""

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
        if law.restitution > 0.0:
            raise ValueError(
                f"signorini_position has no impact law: restitution must be 0 (got {law.restitution!r})"
            )
        return theta.steps(problem, law, state, works[0], times, first, last, self.theta, True)
