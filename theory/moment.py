r"""The largest bending moment at leading order: constant in time, M = V₀√(EIμ) m(κ/ν).

    E″(x) = Re[B (e^{−iπ/4}/2)² erfc z],  z = e^{−iπ/4}x/2,  x = ξ/√τ ≥ λ₀: the wave of `theory.similarity`,
    E‴(x) = ρ cos((x² − λ₀²)/4 + θ),   with E″ = −κ and E‴ = √(2/π) r₀ at x = λ₀.

In the zone the beam is straightened, so the wall bends it by κ. Ahead of it E‴ is a pure oscillation in x²/4: E″ has
its extrema at known places, the first where (x_p² − λ₀²)/4 = π/2 − θ. The arches of E‴ shrink with x, so the
extrema lie nested around 0 and the first, which bends the beam further, is the largest (docs/theory.md; not in
the thesis). At one point, κ/ν ≥ 1, the largest is at the contact: ν.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from theory import phi
from theory._fresnel import FloatArray, scaled_erfc
from theory.contact import ContactParameters, contact_parameters

_TURN = np.exp(-0.25j * np.pi) / 2.0
_JUMP = -2.0 / np.sqrt(np.pi) * _TURN**3  # E‴ of a wave with amplitude 1 at the front
_SLOPE = np.sqrt(2.0 / np.pi)


@dataclass(frozen=True)
class PeakMoment:
    """Bending moments of one impact or of many, in V₀√(EIμ); floats for a scalar κ/ν, arrays otherwise.

    Attributes:
        at_contact: what straightens the beam in the contact zone: κ, or ν where the beam touches in one point.
        ahead: the largest ahead of the zone, of opposite sign: there the beam bends further.
        place: where that is, x = ξ/√τ > λ₀.
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


def peak_moment(kappa_over_nu: ArrayLike, nu: ArrayLike = 1.0) -> PeakMoment:
    """Largest bending moments at leading order; relative error below 1e-12.

    Args:
        kappa_over_nu: curvature over velocity κ/ν > 0.
        nu: velocity ν > 0; both moments are proportional to it.

    Raises:
        ValueError: as `theory.contact_parameters`.

    >>> from theory import peak_moment
    >>> round(float(peak_moment(0.5).largest), 5)  # over V₀√(EIμ)
    0.62406
    """
    return peak_moment_of(contact_parameters(kappa_over_nu, nu=nu))


def peak_moment_of(parameters: ContactParameters) -> PeakMoment:
    """`peak_moment` of an impact that has been solved already."""
    lam = np.atleast_1d(np.asarray(parameters.lambda0, dtype=np.float64))
    r0 = np.atleast_1d(np.asarray(parameters.r0, dtype=np.float64))
    spreads = lam > 0.0
    at_contact = np.where(spreads, parameters.kappa, parameters.nu)
    place, ahead = _ahead(lam, r0, np.asarray(r0 * phi.phi_kappa(lam)))
    scalar = np.ndim(parameters.lambda0) == 0
    return PeakMoment(*(v.item() if scalar else v for v in (at_contact, ahead, place)))


def _ahead(lam: FloatArray, r0: FloatArray, kappa: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Place and size of the first extremum of E″ ahead of the front.

    With a, the wave's amplitude at the front, times `jump`: real part √(2/π)r₀ by E‴, imaginary part by E″ = −κ.
    One point is the limit λ₀ = 0, κ = ν.
    """
    row = _TURN**2 * scaled_erfc(lam) / _JUMP
    rise = _SLOPE * r0
    # Re[row (rise + i turn)] = −κ
    turn = (rise * row.real + kappa) / row.imag
    # phase from the front to the zero of Re[(rise + i·turn) e^{iφ}]
    phase = np.arctan2(rise, turn)
    place = np.sqrt(lam**2 + 4.0 * phase)
    size = np.hypot(rise, turn)
    ahead = size * (1j * _TURN**2 * scaled_erfc(place) / _JUMP).real
    return place, ahead
