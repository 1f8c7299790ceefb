r"""The leading order in closed form: a bending wave outside the contact zone, nothing inside.

At ε = 0 the impact is self-similar, η = τE(x) with x = ξ/√τ, and ∂²/∂τ² + ∂⁴/∂ξ⁴ factors into two Schrödinger
operators. The wave that decays ahead of the front is therefore one iterated error function,

    E(x) = ν − κx²/2,  |x| ≤ λ₀,        E(x) = Re[B i²erfc(z)],  z = e^{−iπ/4}|x|/2,  |x| ≥ λ₀,

and at the front E, E′, E″ are continuous while E‴ jumps by √(2/π) r₀. This is not in the thesis; it
solves (2.6.37) without an integral and gives independently the λ₀ and r₀ of (2.6.21), (2.6.22). With it

    ∫η_τ dξ = ∫R̃ dτ = 4√(2/π) r₀ √τ                                      momentum = impulse,
    ½∫(η_τ² + η_ξξ²) dξ = ν ∫R̃ dτ                                        energy,

the second because the contact moves with ν in the fast layer, at rest in the beam: the reactions do no work
and the beam's energy is conserved. Ahead of the front η_τ² + η_ξξ² = |B erfc(z)|²/16 does not oscillate.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import quad

from theory import phi
from theory._fresnel import ComplexArray, FloatArray, scaled_erfc
from theory._iterated_erfc import iterated_erfc_of_wave
from theory.contact import ContactParameters

_TURN = np.exp(-0.25j * np.pi) / 2.0


@dataclass(frozen=True)
class SelfSimilarWave:
    """η(ξ,τ) = τE(ξ/√τ) of one impact (scalar parameters) at leading order, any regime.

    Fields are functions of x = ξ/√τ: η/τ, η_ξ/√τ, η_ξξ and η_τ. Absolute error below 1e-13 r₀.
    """

    parameters: ContactParameters

    @cached_property
    def _amplitude(self) -> complex:
        """B e^{−z²} at the front, from E″ = −κ = −r₀φ_κ and E‴ = √(2/π)r₀ there.

        In the discrete regime E′(0) = 0 takes the place of E″, which the front's zone no longer sets.
        """
        p = self.parameters
        front = complex(scaled_erfc(p.lambda0))
        if p.lambda0 > 0.0:
            row, value = _TURN**2 * front, -p.r0 * float(phi.phi_kappa(p.lambda0))
        else:
            row, value = -_TURN / np.sqrt(np.pi), 0.0
        jump = -2.0 / np.sqrt(np.pi) * _TURN**3
        # Re[A row] = value, Re[A jump] = √(2/π) r₀ for the real and imaginary part of A
        matrix = np.array([[row.real, -row.imag], [jump.real, -jump.imag]])
        real, imaginary = np.linalg.solve(matrix, [value, np.sqrt(2.0 / np.pi) * p.r0])
        return complex(real, imaginary)

    def _wave(self, x: FloatArray) -> tuple[ComplexArray, ...]:
        """B iⁿerfc(z), n = 0…3, at x ≥ λ₀."""
        wave = self._amplitude * np.exp(0.25j * (x**2 - self.parameters.lambda0**2))
        return tuple(wave * values for values in iterated_erfc_of_wave(np.atleast_1d(x)))

    def deflection(self, x: ArrayLike) -> FloatArray:
        """η/τ at x = ξ/√τ."""
        p, s = self.parameters, np.abs(np.asarray(x, dtype=np.float64))
        outside = self._wave(np.maximum(s, p.lambda0))[2].real
        return np.where(s >= p.lambda0, outside, p.nu - p.kappa * s**2 / 2.0)

    def slope(self, x: ArrayLike) -> FloatArray:
        """η_ξ/√τ at x = ξ/√τ."""
        p, position = self.parameters, np.asarray(x, dtype=np.float64)
        s = np.abs(position)
        outside = -(_TURN * self._wave(np.maximum(s, p.lambda0))[1]).real
        return np.copysign(1.0, position) * np.where(s >= p.lambda0, outside, -p.kappa * s)

    def curvature(self, x: ArrayLike) -> FloatArray:
        """η_ξξ at x = ξ/√τ."""
        p, s = self.parameters, np.abs(np.asarray(x, dtype=np.float64))
        outside = (_TURN**2 * self._wave(np.maximum(s, p.lambda0))[0]).real
        return np.where(s >= p.lambda0, outside, -p.kappa)

    def velocity(self, x: ArrayLike) -> FloatArray:
        """η_τ at x = ξ/√τ."""
        p, s = self.parameters, np.abs(np.asarray(x, dtype=np.float64))
        outside = -(_TURN**2 * self._wave(np.maximum(s, p.lambda0))[0]).imag
        return np.where(s >= p.lambda0, outside, p.nu)

    def gap(self, x: ArrayLike) -> FloatArray:
        """−w/τ at x = ξ/√τ: 0 in the contact zone, positive outside."""
        p, s = self.parameters, np.abs(np.asarray(x, dtype=np.float64))
        return np.where(s > p.lambda0, self.deflection(s) - p.nu + p.kappa * s**2 / 2.0, 0.0)

    @property
    def impulse(self) -> float:
        """∫₀^τ R̃/√τ = 4√(2/π) r₀."""
        return float(4.0 * np.sqrt(2.0 / np.pi) * self.parameters.r0)

    @property
    def momentum(self) -> float:
        """∫η_τ dξ/√τ = (3/2)∫E dx, the outside part of it being B i³erfc at the front over e^{−iπ/4}/2."""
        p = self.parameters
        i3erfc = self._wave(np.asarray(p.lambda0))[3][0]
        inside = p.nu * p.lambda0 - p.kappa * p.lambda0**3 / 6.0
        return float(3.0 * (inside + (i3erfc / _TURN).real))

    @property
    def energy(self) -> float:
        """½∫(η_τ² + η_ξξ²)dξ/√τ, kinetic and bending energy of the fast layer; relative error 1e-11."""
        p = self.parameters

        def outside(y: float) -> float:
            # x = λ₀ + y/(1−y) takes the tail, which falls like 1/x², to a finite interval
            erfc = self._wave(np.asarray(p.lambda0 + y / (1.0 - y)))[0][0]
            return float(np.abs(erfc) ** 2) / 16.0 / (1.0 - y) ** 2

        tail, _ = quad(outside, 0.0, 1.0, epsabs=0.0, epsrel=1e-12, limit=400)
        return float(p.lambda0 * (p.nu**2 + p.kappa**2) + tail)

    @property
    def far_field(self) -> tuple[float, float]:
        """(A, A′): |η/τ| < A/|x|³ and |η_ξ/√τ| < A′/|x|² ahead of the front, tight as x → ∞ (2.2.37)."""
        size = abs(self._amplitude)
        return 2.0 * size / np.sqrt(np.pi), size / np.sqrt(np.pi)
