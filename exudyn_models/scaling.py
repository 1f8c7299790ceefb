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

from bent_beam import Impact
from bent_beam.loads import FreeMotion

__all__ = ["Scaling", "front_bound"]


def front_bound(kappa_over_nu: float) -> float:
    """√(2ν/κ) for choosing a resolution, at most 200."""
    return 200.0 if kappa_over_nu <= 0.0 else min(200.0, math.sqrt(2.0 / kappa_over_nu))


@dataclass(frozen=True)
class Scaling:
    """Conversions between SI and model units (model × factor = SI) for one impact followed to ``end_time`` (s).

    length : Λ = (EI/μ)^{1/4} √T, m; true_amplitude : V₀T/Λ, at which the model has the shape of the real beam.
    deflection (m), velocity (m/s), slope, impulse (N s), energy (J) : factors.
    kappa : of the beam against the wall; beam_kappa, wall_kappa : of each.
    motion : y₀ − y_w over amplitude, x from first_touch (Λ); loads : its terms by which the ends are loaded.
    axial_force : N Λ²/EI; load : uniform load per unit length over amplitude, under which y₀ is the motion without
        contact.
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
    kappa: float
    beam_kappa: float
    wall_kappa: float
    first_touch: float
    motion: FreeMotion
    axial_force: float
    load: float

    @classmethod
    def of(cls, impact: Impact, end_time: float, amplitude: float = 1.0) -> Scaling:
        length = math.sqrt(impact.wave_constant * end_time)
        deflection = impact.velocity * end_time / amplitude
        velocity = impact.velocity / amplitude
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
            kappa=impact.kappa_over_nu,
            beam_kappa=impact.curvature * impact.length_scale,
            wall_kappa=impact.wall_curvature * impact.length_scale,
            first_touch=impact.first_touch / length,
            motion=impact.free_motion(impact.relative_curvature).scaled(length, end_time, impact.velocity * end_time),
            axial_force=impact.epsilon_axial * end_time / impact.time_scale,
            load=impact.uniform_pressure * end_time / (impact.mass_per_length * impact.velocity),
        )

    def motion_of(self, kappa: float) -> FreeMotion:
        """``motion`` of a beam of curvature ``kappa``."""
        return FreeMotion({**self.motion.terms, (2, 0): -kappa})

    @property
    def loads(self) -> FreeMotion:
        return self.motion_of(0.0).bending()
