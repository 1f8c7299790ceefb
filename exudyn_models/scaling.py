"""Model units, and what may be said of an impact before it is run.

With the end time T as unit of time and Λ = (EI/μ)^{1/4} √T as unit of length the beam equation is

    y_tt + y_xxxx = q₀ + a₀ − r,   0 ≤ t ≤ 1,   μ = EI = 1,                               (thesis 2.1.1 scaled)

whatever the physical size of the problem: the leading order is self-similar, so its one parameter κ/ν = K√(EI/μ)/V₀
is also the initial curvature here when deflections are measured in V₀T. Deflections carry a further factor, the
``amplitude``: V₀T/Λ gives the true geometry, anything small the linear limit (the problem is linear in it).

A bound of the front: without a wall, y₀ = V₀t − Kx²/2 would be inside it up to x = √(2V₀t/K), that is λ₀ < √(2ν/κ).
It serves to choose a resolution, never to make an answer.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from bent_beam import Impact
from exudyn_models.arrays import Array

__all__ = ["Scaling", "front_bound"]


def front_bound(kappa_over_nu: float) -> float:
    """√(2ν/κ) for choosing a resolution, at most 200."""
    return 200.0 if kappa_over_nu <= 0.0 else min(200.0, math.sqrt(2.0 / kappa_over_nu))


@dataclass(frozen=True)
class Scaling:
    """Conversions between SI and model units (model × factor = SI) for one impact followed to ``end_time`` (s)."""

    impact: Impact
    end_time: float
    amplitude: float

    @property
    def length(self) -> float:
        """Λ = (EI/μ)^{1/4} √T, m."""
        return math.sqrt(self.impact.wave_constant * self.end_time)

    @property
    def true_amplitude(self) -> float:
        """V₀T/Λ: the amplitude at which the model has the shape of the real beam."""
        return self.impact.velocity * self.end_time / self.length

    @property
    def deflection(self) -> float:
        return self.impact.velocity * self.end_time / self.amplitude

    @property
    def velocity(self) -> float:
        return self.impact.velocity / self.amplitude

    @property
    def slope(self) -> float:
        return self.deflection / self.length

    @property
    def impulse(self) -> float:
        return self.impact.mass_per_length * self.length * self.velocity

    @property
    def force(self) -> float:
        return self.impulse / self.end_time

    @property
    def energy(self) -> float:
        return self.impact.mass_per_length * self.length * self.velocity**2

    @property
    def stiffness_per_length(self) -> float:
        """Of a foundation, N/m²."""
        return self.impact.bending_stiffness / self.length**4

    @property
    def damping_per_length(self) -> float:
        """Of a foundation, N s/m²."""
        return self.impact.mass_per_length / self.end_time

    # the free motion in model units, y₀/amplitude = t − κx²/2 + αt²/2 + χx²t/2 + ψx⁴/24 --------------------------
    @property
    def kappa(self) -> float:
        """Of the beam against the wall."""
        return self.impact.kappa_over_nu

    @property
    def beam_kappa(self) -> float:
        return self.impact.curvature * self.impact.length_scale

    @property
    def wall_kappa(self) -> float:
        return self.impact.wall_curvature * self.impact.length_scale

    @property
    def axial_force(self) -> float:
        """N Λ²/EI."""
        return self.impact.epsilon_axial * self.duration

    @property
    def spin(self) -> float:
        """ωΛ/V₀."""
        return self.impact.rotation * self.length / self.impact.velocity

    @property
    def first_touch(self) -> float:
        return self.impact.first_touch / self.length

    @property
    def duration(self) -> float:
        """τ at the end: T/t*."""
        return self.end_time / self.impact.time_scale

    @property
    def alpha(self) -> float:
        return self.impact.epsilon_alpha * self.duration

    @property
    def chi(self) -> float:
        return self.impact.epsilon_chi * self.duration

    @property
    def psi(self) -> float:
        return self.impact.epsilon_psi * self.duration

    @property
    def load(self) -> float:
        """Uniform load (EI q₀ + μ a₀ + N K) per unit length over amplitude: without contact y₀ is then the motion."""
        return self.alpha + self.psi + self.axial_force * self.beam_kappa

    def free_deflection(self, x: Array, t: Array | float) -> Array:
        """y₀ at places ``x`` and time ``t`` (model units, amplitude 1), broadcast."""
        spin, x = self.spin * x, x - self.first_touch
        bow = -self.kappa * x**2 / 2 + self.psi * x**4 / 24
        return np.asarray(bow + t * (1 + spin) + self.alpha * t**2 / 2 + self.chi * x**2 * t / 2)
