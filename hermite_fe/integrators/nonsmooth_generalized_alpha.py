"""Nonsmooth generalised-α: second order in smooth motion, first order across impacts (thesis 3.2, 3.3.10–16).

    v⁺ = v + h(1 − γ)a + hγa⁺ + W,    q⁺ = q + hv + h²(½ − β)a + h²βa⁺ + U
    α_m = (2ρ∞ − 1)/(ρ∞ + 1),  α_f = ρ∞/(ρ∞ + 1),  γ = ½ + α_f − α_m,  β = ¼(γ + ½)²

Where the constraints are asked for:

- ``velocity`` : the impact law at velocity level; positions drift (after Chen, Acary, Virlez, Brüls 2013,
  Int. J. Numer. Meth. Eng. 96, 487);
- ``position_velocity`` : gaps and velocities, one after the other, no drift (after Brüls, Acary, Cardona
  2014, CMAME 281, 131);
- ``position_velocity_acceleration`` : also the smooth motion carries the reactions of rows at rest on the
  wall, so that lasting contact is second order as well (after Brüls, Acary, Cardona 2018, Multibody Syst.
  Dyn. 44): the thesis's solver.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import between, one_of
from hermite_fe.integrators.base import Integrator
from hermite_fe.kernels import generalized_alpha
from hermite_fe.kernels.problem import ContactLaw, Problem, State, Work

__all__ = ["LEVELS", "NonsmoothGeneralizedAlpha"]

LEVELS = ("velocity", "position_velocity", "position_velocity_acceleration")


@dataclass(frozen=True)
class NonsmoothGeneralizedAlpha(Integrator):
    """spectral_radius : ρ∞ ∈ [0, 1] at infinite frequency (1: none is damped). levels : where constraints are
    asked for."""

    solves: ClassVar[int] = 3

    spectral_radius: float = 0.8
    levels: str = "position_velocity_acceleration"

    def __post_init__(self) -> None:
        super().__post_init__()
        between("integrator.spectral_radius", self.spectral_radius, 0.0, 1.0)
        one_of("integrator.levels", self.levels, LEVELS)

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
        if self.levels == "velocity":
            return generalized_alpha.velocity_steps(
                problem, law, state, works[0], works[1], times, first, last, self.spectral_radius
            )
        return generalized_alpha.sequential_steps(
            problem,
            law,
            state,
            works[0],
            works[1],
            works[2],
            times,
            first,
            last,
            self.spectral_radius,
            self.levels == "position_velocity_acceleration",
        )
