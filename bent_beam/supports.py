"""How the ends of the beam are held, and the motion that they allow.

    free       EI y_xx = EI y_xxx = 0        hinged     y = const., EI y_xx = 0        clamped     y, y_x = const.

The beam arrives unbent from its bow, in the lowest mode φ that its ends allow, with V₀ in its middle: a beam without
supports moves without rotation, one on a single hinge swings about it, any other passes its rest position in its first
bending mode

    φ ∝ cosh βξ − cos βξ − σ(sinh βξ − sin βξ),    ξ = 0 … 1 from the clamp,    φ = sin πξ on two hinges

(Blevins 1979, Formulas for Natural Frequency and Mode Shape, table 8-1).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["ENDS", "lowest_mode"]

Array = NDArray[np.float64]

ENDS = ("free", "hinged", "clamped")
CLAMPED = {"clamped": 4.730040744862704, "hinged": 3.926602312047919, "free": 1.875104068711961}
"""β of a beam with one end clamped, by its other end: cos β cosh β = 1, tan β = tanh β, cos β cosh β = −1."""


def lowest_mode(left: str, right: str, half_length: float, x: Array) -> tuple[Array, Array]:
    """φ, 1 in the middle, and φ′, 1/m, at the places x, m from the middle; ends out of :data:`ENDS`."""
    length = 2.0 * half_length
    if left == right == "free":
        return np.ones_like(x), np.zeros_like(x)
    if left == right == "hinged":
        return np.cos(np.pi * x / length), -np.pi / length * np.sin(np.pi * x / length)
    if ENDS.index(right) > ENDS.index(left):  # the end that is held more firmly on the left
        shape, slope = lowest_mode(right, left, half_length, -x)
        return shape, -slope
    if left == "hinged":  # and free on the right
        return 1.0 + x / half_length, np.full_like(x, 1.0 / half_length)
    beta, sign = CLAMPED[right], 1.0 if right == "free" else -1.0
    sigma = (np.cosh(beta) + sign * np.cos(beta)) / (np.sinh(beta) + sign * np.sin(beta))

    def shape_of(z: Array) -> Array:
        return np.asarray(np.cosh(z) - np.cos(z) - sigma * (np.sinh(z) - np.sin(z)))

    z = beta * (0.5 + x / length)
    slope = beta / length * (np.sinh(z) + np.sin(z) - sigma * (np.cosh(z) - np.cos(z)))
    middle = shape_of(np.array(0.5 * beta))
    return shape_of(z) / middle, slope / middle
