"""Generalised-α (Chung & Hulbert 1993) with penalty contact: the discretisation of the Exudyn model.

    M v̇⁺ + C v⁺ + K q⁺ = F⁺ + Gᵀλ,    λ_j = −(k_c g_j + d_c ġ_j)·(tributary length of j)  where g_j ≤ 0

that is one spring and damper a node, acting on penetration only, which may pull while it does (Exudyn's
``ObjectContactCoordinate`` with linear damping). Contact rows must touch one dof each: contact at nodes.
Measured at κ/ν = 0.5 and 0.1, τ = 0.1: with k = 10⁵, d = 10³ λ₀ is 1.6 and 1.1 % off, with the 10⁷ and 3·10⁴ chosen
here 0.12 and 0.03 %, with 10⁸ and 10⁵ 0.05 and 0.003 %. There is no impact law and no hold; what the rows take in,
stored or dissipated, is booked as loss in impacts.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import between, non_negative, positive, whole
from bent_beam.impact import Impact
from hermite_fe.integrators.base import Integrator
from hermite_fe.kernels import generalized_alpha
from hermite_fe.kernels.problem import ContactLaw, Problem, State, Work

__all__ = ["GeneralizedAlphaPenalty"]


@dataclass(frozen=True)
class GeneralizedAlphaPenalty(Integrator):
    """spectral_radius : ρ∞ ∈ [0, 1].

    stiffness : k_c, N/m per metre of beam (``None``: chosen, 1e7 μ/t*²).
    damping : d_c, N s/m per metre of beam (``None``: chosen, 3e4 μ/t*).
    contact_rounds : most re-solutions a step until contact and penetration agree.
    """

    holds: ClassVar[bool] = False

    spectral_radius: float = 0.8
    stiffness: float | None = None
    damping: float | None = None
    contact_rounds: int = 20

    def __post_init__(self) -> None:
        super().__post_init__()
        between("integrator.spectral_radius", self.spectral_radius, 0.0, 1.0)
        if self.stiffness is not None:
            positive("integrator.stiffness", self.stiffness)
        if self.damping is not None:
            non_negative("integrator.damping", self.damping)
        whole("integrator.contact_rounds", self.contact_rounds, 0)

    def refined(self, factor: float) -> GeneralizedAlphaPenalty:
        """Steps shorter, the contact stiffer in proportion to their square: a soft penalty is an error like others."""
        shorter = super().refined(factor)
        assert isinstance(shorter, GeneralizedAlphaPenalty)
        return dataclasses.replace(
            shorter,
            stiffness=None if self.stiffness is None else self.stiffness * factor**2,
            damping=None if self.damping is None else self.damping * factor,
        )

    def suited(self, impact: Impact) -> GeneralizedAlphaPenalty:
        mass, time = impact.mass_per_length, impact.time_scale
        return dataclasses.replace(
            self,
            stiffness=1e7 * mass / time**2 if self.stiffness is None else self.stiffness,
            damping=3e4 * mass / time if self.damping is None else self.damping,
        )

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
        if self.stiffness is None or self.damping is None:
            raise ValueError("integrator.stiffness and integrator.damping are not chosen yet")
        if problem.dofs.shape[1] != 1:
            raise ValueError('generalized_alpha_penalty takes contact.kind = "node" only')
        if law.restitution > 0.0:
            raise ValueError(
                "generalized_alpha_penalty has no impact law: "
                f"restitution must be 0 (got {law.restitution!r})"
            )
        return generalized_alpha.penalty_steps(
            problem,
            state,
            works[0],
            times,
            first,
            last,
            self.spectral_radius,
            self.stiffness,
            self.damping,
            self.contact_rounds,
        )
