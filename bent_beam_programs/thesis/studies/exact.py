"""What the theory says of one impact, as functions of time in SI units: the black line of every study.

    λ_c(t) = (EI/μ)^{1/4} √t (λ₀ + ελ₁ t/t*),   R(t)/2 = √(2/π) μV₀(EI/μ)^{1/4} (r₀ + εr₁ t/t*)/√t + uniform part

Energies (leading order) are of the whole beam: the fast layer holds all the energy that the wall takes out of the free
motion, V₀∫R dt; a part of it is strain energy, the rest is kinetic. Nothing is lost.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from bent_beam.impact import Impact
from bent_beam.loads import beyond_first_order
from theory import ContactParameters, ImpactFields, SelfSimilarWave, contact_parameters

Array = NDArray[np.float64]
TAIL = 60.0  # ζ up to which strain and kinetic energy of the waves are told apart; beyond, they are equal


@dataclass(frozen=True)
class Exact:
    """Theory of ``impact``; first order included where the impact has a₀, c₀, q₀ or an axial force."""

    impact: Impact

    def __post_init__(self) -> None:
        reason = beyond_first_order(self.impact)
        if reason is not None:
            raise ValueError(reason.replace("this method", "the theory"))

    @cached_property
    def parameters(self) -> ContactParameters:
        """ε = 1: α, ψ, χ and the axial force are the products εα, εψ, εχ and n, and so are λ₁, r₁."""
        i = self.impact
        loads = (i.epsilon_alpha, i.epsilon_psi, i.epsilon_chi)
        return contact_parameters(i.kappa_over_nu, *loads, axial=i.epsilon_axial)

    @property
    def leading(self) -> bool:
        return not self.impact.loaded_to_first_order

    @cached_property
    def wave(self) -> SelfSimilarWave:
        return SelfSimilarWave(contact_parameters(self.impact.kappa_over_nu))

    @property
    def unit(self) -> float:
        """μ l* V₀, N s: impulse of the fast layer."""
        return self.impact.mass_per_length * self.impact.length_scale * self.impact.velocity

    def tau(self, time: ArrayLike) -> Array:
        return np.asarray(time, float) / self.impact.time_scale

    def front(self, time: ArrayLike) -> Array:
        """Half contact length, m."""
        tau, p = self.tau(time), self.parameters
        return np.asarray(self.impact.length_scale * np.sqrt(tau) * (p.lambda0 + p.lambda1 * tau))

    @property
    def end_of_contact(self) -> float:
        """When the concentrated reactions of first order have fallen to 0, s; never where r₁ ≥ 0."""
        p = self.parameters
        return float(-p.r0 / p.r1) * self.impact.time_scale if p.r1 < 0.0 else math.inf

    def side_reaction(self, time: ArrayLike) -> Array:
        """Reaction of one side, N: one concentrated force and half of the uniform reaction."""
        tau, p = self.tau(time), self.parameters
        with np.errstate(divide="ignore"):
            force = math.sqrt(2.0 / math.pi) * (p.r0 + p.r1 * tau) / np.sqrt(tau)
        uniform = max(float(p.uniform_reaction), 0.0) * self.front(time) / self.impact.length_scale
        return np.asarray((force + uniform) * self.unit / self.impact.time_scale)

    def impulse(self, time: ArrayLike) -> Array:
        """Impulse of the whole reaction since t = 0, N s."""
        tau, p = self.tau(time), self.parameters
        root = np.sqrt(tau)
        total = 4.0 * math.sqrt(2.0 / math.pi) * root * (p.r0 + p.r1 * tau / 3.0)
        uniform = 2.0 * max(float(p.uniform_reaction), 0.0)
        total = total + uniform * root * tau * (p.lambda0 / 1.5 + p.lambda1 * tau / 2.5)
        return np.asarray(total * self.unit)

    def gap(self, x: ArrayLike, time: float) -> Array:
        """Distance to the wall, m, at places x, m."""
        tau = float(self.tau(time))
        xi = np.asarray(x, float) / self.impact.length_scale
        if self.leading:
            return np.asarray(self.wave.gap(xi / math.sqrt(tau)) * tau * self.impact.deflection_scale)
        beam = ImpactFields(self.parameters, epsilon=1.0).beam(xi, tau)
        return -beam.deflection * self.impact.deflection_scale

    def fast_energy(self, time: ArrayLike) -> Array:
        """V₀∫R dt = energy of the fast layer, J."""
        return np.asarray(self.wave.energy * np.sqrt(self.tau(time)) * self.unit * self.impact.velocity)

    @cached_property
    def strain_share(self) -> float:
        """Strain energy over the energy of the fast layer."""
        wave, front = self.wave, float(self.wave.parameters.lambda0)
        x = np.linspace(front, front + TAIL, 240_001)
        difference = np.trapezoid(wave.curvature(x) ** 2 - wave.velocity(x) ** 2, x)
        difference += front * (self.impact.kappa_over_nu**2 - 1.0)
        return float(0.5 * (wave.energy + difference) / wave.energy)

    def strain_energy(self, time: ArrayLike) -> Array:
        """Bending energy relative to the stress-free beam, J: nil at the first contact."""
        return self.strain_share * self.fast_energy(time)
