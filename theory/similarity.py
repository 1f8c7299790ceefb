r"""The leading order in closed form: a bending wave outside the contact zone, nothing inside (new).

At ε = 0 the impact is self-similar, η = τE(x) with x = ξ/√τ, and ∂²/∂τ² + ∂⁴/∂ξ⁴ factors into two Schrödinger
operators. The wave that decays ahead of the front is therefore one iterated error function,

    E(x) = 1 − κx²/2,  |x| ≤ λ₀,        E(x) = Re[B i²erfc(z)],  z = e^{−iπ/4}|x|/2,  |x| ≥ λ₀,

and at the front E, E′, E″ are continuous while E‴ jumps by √(2/π) r₀. This solves (2.6.37) without an integral. With it

    ∫η_τ dξ = ∫R̃ dτ = 4√(2/π) r₀ √τ                                      momentum = impulse,
    ½∫(η_τ² + η_ξξ²) dξ = ∫R̃ dτ                                        energy,

the second because the contact moves with ν = 1 in the fast layer, at rest in the beam: the reactions do no work.
Ahead of the front η_τ² + η_ξξ² = |B erfc(z)|²/16 does not oscillate.

The largest bending moment is constant in time, M = V₀√(EIμ) m(κ/ν) (docs/theory.md, section 7):

    E″(x) = Re[B (e^{−iπ/4}/2)² erfc z],   E‴(x) = √(2/π) r₀ cos((x² − λ₀²)/4),   E″ = −κ at x = λ₀.

In the zone the beam is straightened, so the wall bends it by κ. Ahead of it the first extremum of E″, where
x_p² = λ₀² + 2π, bends the beam further and is the largest. At one point, κ/ν ≥ 1, the largest is at the contact: 1.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from theory import phi
from theory._fresnel import TURN, ComplexArray, FloatArray, scaled_erfc, scaled_iterated_erfc
from theory.contact import ContactParameters, contact_parameters

_JUMP = -2.0 / np.sqrt(np.pi) * TURN**3  # E‴ of a wave with amplitude 1 at the front


def wave_amplitude(parameters: ContactParameters) -> ComplexArray:
    """B e^{−z²} at the front, from E″ = −κ and E‴ = √(2/π)r₀ there; of one point the limit λ₀ = 0, κ = 1."""
    lam, rise = np.asarray(parameters.lambda0), np.sqrt(2.0 / np.pi) * np.asarray(parameters.r0)
    row = TURN**2 * scaled_erfc(lam) / _JUMP
    # the amplitude times `_JUMP` is rise + i turn, Re[row (rise + i turn)] = −κ
    turn = (rise * row.real + parameters.r0 * phi.phi_kappa(lam)) / row.imag
    return np.asarray((rise + 1j * turn) / _JUMP)


@dataclass(frozen=True)
class SelfSimilarWave:
    """η(ξ,τ) = τE(ξ/√τ) of one impact (scalar parameters) at leading order, any regime. Fields are functions of
    x = ξ/√τ: η/τ, η_ξ/√τ, η_ξξ and η_τ. Absolute error below 1e-13 r₀."""

    parameters: ContactParameters

    @cached_property
    def _amplitude(self) -> complex:
        return complex(wave_amplitude(self.parameters))

    def _wave(self, x: FloatArray) -> tuple[ComplexArray, ...]:
        """B iⁿerfc(z), n = 0…3, at x ≥ λ₀."""
        wave = self._amplitude * np.exp(0.25j * (x**2 - self.parameters.lambda0**2))
        return tuple(wave * values for values in scaled_iterated_erfc(TURN * np.atleast_1d(x)))

    def _field(self, x: ArrayLike, n: int, factor: complex, inside: ArrayLike) -> FloatArray:
        """Re[factor·B iⁿerfc(z)] ahead of the front, `inside` in the zone."""
        s, front = np.abs(np.asarray(x, dtype=np.float64)), self.parameters.lambda0
        outside = (factor * self._wave(np.maximum(s, front))[n]).real
        return np.where(s >= front, outside, inside)

    def deflection(self, x: ArrayLike) -> FloatArray:
        """η/τ at x = ξ/√τ."""
        p = self.parameters
        return self._field(x, 2, 1.0, 1.0 - p.kappa_over_nu * np.asarray(x) ** 2 / 2.0)

    def slope(self, x: ArrayLike) -> FloatArray:
        """η_ξ/√τ at x = ξ/√τ."""
        side = np.copysign(1.0, x)
        return side * self._field(x, 1, -TURN, -self.parameters.kappa_over_nu * np.abs(x))

    def curvature(self, x: ArrayLike) -> FloatArray:
        """η_ξξ at x = ξ/√τ."""
        return self._field(x, 0, TURN**2, -self.parameters.kappa_over_nu)

    def velocity(self, x: ArrayLike) -> FloatArray:
        """η_τ at x = ξ/√τ."""
        return self._field(x, 0, 1j * TURN**2, 1.0)

    def gap(self, x: ArrayLike) -> FloatArray:
        """−w/τ at x = ξ/√τ: 0 in the contact zone, positive outside."""
        p, s = self.parameters, np.abs(np.asarray(x, dtype=np.float64))
        return np.where(s > p.lambda0, self.deflection(s) - 1.0 + p.kappa_over_nu * s**2 / 2.0, 0.0)

    @property
    def impulse(self) -> float:
        """∫₀^τ R̃/√τ = 4√(2/π) r₀."""
        return float(4.0 * np.sqrt(2.0 / np.pi) * self.parameters.r0)

    @property
    def momentum(self) -> float:
        """∫η_τ dξ/√τ = (3/2)∫E dx, the outside part of it being B i³erfc at the front over e^{−iπ/4}/2."""
        p = self.parameters
        i3erfc = self._wave(np.asarray(p.lambda0))[3][0]
        inside = p.lambda0 - p.kappa_over_nu * p.lambda0**3 / 6.0
        return float(3.0 * (inside + (i3erfc / TURN).real))

    @property
    def energy(self) -> float:
        """½∫(η_τ² + η_ξξ²)dξ/√τ, kinetic and bending energy of the fast layer; relative error 1e-11."""
        from scipy.integrate import quad  # slow to load

        p = self.parameters

        def outside(y: float) -> float:
            # x = λ₀ + y/(1−y) takes the tail, which falls like 1/x², to a finite interval
            erfc = self._wave(np.asarray(p.lambda0 + y / (1.0 - y)))[0][0]
            return float(np.abs(erfc) ** 2) / 16.0 / (1.0 - y) ** 2

        tail, _ = quad(outside, 0.0, 1.0, epsabs=0.0, epsrel=1e-12, limit=400)
        return float(p.lambda0 * (1.0 + p.kappa_over_nu**2) + tail)

    @property
    def far_field(self) -> tuple[float, float]:
        """(A, A′): |η/τ| < A/|x|³ and |η_ξ/√τ| < A′/|x|² ahead of the front, tight as x → ∞ (2.2.37)."""
        size = abs(self._amplitude)
        return 2.0 * size / np.sqrt(np.pi), size / np.sqrt(np.pi)


@dataclass(frozen=True)
class PeakMoment:
    """Bending moments of one impact or of many, in V₀√(EIμ); floats for a scalar κ/ν, arrays otherwise.

    at_contact : what straightens the beam in the contact zone: κ, or 1 where the beam touches in one point.
    ahead : the largest ahead of the zone, of opposite sign: there the beam bends further.
    place : where that is, x = ξ/√τ > λ₀.
    """

    at_contact: Any
    ahead: Any
    place: Any

    @property
    def largest(self) -> Any:
        """m, the larger of the two."""
        return np.maximum(self.at_contact, self.ahead)[()]

    @property
    def place_of_largest(self) -> Any:
        """x = ξ/√τ of the larger of the two, 0 for the contact zone (all of which bears κ)."""
        return np.where(np.asarray(self.ahead) > self.at_contact, self.place, 0.0)[()]


def peak_moment(kappa_over_nu: ArrayLike) -> PeakMoment:
    """Largest bending moments at leading order, for κ/ν > 0; relative error below 1e-12.

    Raises ``ValueError`` as `theory.contact_parameters` does.

    >>> from theory import peak_moment
    >>> round(float(peak_moment(0.5).largest), 5)  # over V₀√(EIμ)
    0.62406
    """
    return peak_moment_of(contact_parameters(kappa_over_nu))


def peak_moment_of(parameters: ContactParameters) -> PeakMoment:
    """`peak_moment` of an impact that has been solved already."""
    lam = np.asarray(parameters.lambda0)
    at_contact = np.where(lam > 0.0, parameters.kappa_over_nu, 1.0)
    place = np.sqrt(lam**2 + 2.0 * np.pi)  # where the phase of E‴ has turned by a quarter
    ahead = np.sqrt(2.0 / np.pi) * np.asarray(parameters.r0) * (1j * TURN**2 * scaled_erfc(place) / _JUMP).real
    return PeakMoment(*(v if lam.ndim else v.item() for v in (at_contact, ahead, place)))
