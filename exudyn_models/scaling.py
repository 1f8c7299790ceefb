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
    """Conversions between SI and model units (model × factor = SI) for one impact followed to ``end_time`` (s).

    length : Λ = (EI/μ)^{1/4} √T, m; true_amplitude : V₀T/Λ, at which the model has the shape of the real beam.
    deflection (m), velocity (m/s), slope, impulse (N s), energy (J), and of a foundation stiffness_per_length (N/m²)
        and damping_per_length (N s/m²): factors.
    kappa : of the beam against the wall; beam_kappa, wall_kappa, spin, alpha, chi, psi : of the free motion
        y₀/amplitude = t(1 + spin x) − κx²/2 + αt²/2 + χx²t/2 + ψx⁴/24, x measured from first_touch (Λ).
    axial_force : N Λ²/EI; load : uniform load (EI q₀ + μ a₀ + N K) per unit length over amplitude, under which y₀ is
        the motion without contact.
    """

    impact: Impact
    end_time: float
    amplitude: float
    true_amplitude: float
    length: float
    deflection: float
    velocity: float
    slope: float
    impulse: float
    energy: float
    stiffness_per_length: float
    damping_per_length: float
    kappa: float
    beam_kappa: float
    wall_kappa: float
    first_touch: float
    spin: float
    alpha: float
    chi: float
    psi: float
    axial_force: float
    load: float

    @classmethod
    def of(cls, impact: Impact, end_time: float, amplitude: float = 1.0) -> Scaling:
        length = math.sqrt(impact.wave_constant * end_time)
        deflection = impact.velocity * end_time / amplitude
        velocity = impact.velocity / amplitude
        duration = end_time / impact.time_scale
        beam_kappa = impact.curvature * impact.length_scale
        alpha, psi = impact.epsilon_alpha * duration, impact.epsilon_psi * duration
        axial_force = impact.epsilon_axial * duration
        return cls(
            impact=impact,
            end_time=end_time,
            amplitude=amplitude,
            true_amplitude=impact.velocity * end_time / length,
            length=length,
            deflection=deflection,
            velocity=velocity,
            slope=deflection / length,
            impulse=impact.mass_per_length * length * velocity,
            energy=impact.mass_per_length * length * velocity**2,
            stiffness_per_length=impact.bending_stiffness / length**4,
            damping_per_length=impact.mass_per_length / end_time,
            kappa=impact.kappa_over_nu,
            beam_kappa=beam_kappa,
            wall_kappa=impact.wall_curvature * impact.length_scale,
            first_touch=impact.first_touch / length,
            spin=impact.rotation * length / impact.velocity,
            alpha=alpha,
            chi=impact.epsilon_chi * duration,
            psi=psi,
            axial_force=axial_force,
            load=alpha + psi + axial_force * beam_kappa,
        )

    def free_deflection(self, x: Array, t: Array | float) -> Array:
        """y₀ at places ``x`` and time ``t`` (model units, amplitude 1), broadcast."""
        spin, x = self.spin * x, x - self.first_touch
        bow = -self.kappa * x**2 / 2 + self.psi * x**4 / 24
        return np.asarray(bow + t * (1 + spin) + self.alpha * t**2 / 2 + self.chi * x**2 * t / 2)
