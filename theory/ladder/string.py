r"""A string that lands on a flat obstacle all at once: contact without a contact point.

    u_tt = u_xx + r,   0 ≤ x ≤ 1,   u(0,t) = u(1,t) = 0,   u ≥ 0,   u = f(x), u_t = 0 at t = 0,

the obstacle being the line through the string's ends, and the impacts elastic (energy is kept). For a shape f that is
concave and symmetric about the middle the free motion

    w = ½[F(x + t) + F(x − t)],   F the odd continuation of f with period 2,

is positive for |t| < ½ and vanishes everywhere at t = ½: the whole string lands, its velocity is reversed, and

    u(x,t) = |w(x,t)|,   impulse per length −2w_t at t = ½, 3/2, …, period 1.

Source: H. Cabannes, Formulas for vibrating strings with obstacles (2001), henri.cabannes.free.fr/strings.html, a fixed
straight line, here through the string's ends (his h = 0); L. Amerio, Continuous solutions of the problem of a string
vibrating against an obstacle, Rend. Sem. Mat. Univ. Padova 59 (1978) 67–96, for the law of impact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from theory._fresnel import FloatArray


def _parabola(x: FloatArray) -> FloatArray:
    return 4.0 * x * (1.0 - x)


def _parabola_slope(x: FloatArray) -> FloatArray:
    return 4.0 - 8.0 * x


@dataclass(frozen=True)
class StringOnObstacle:
    """A string released from a concave symmetric shape above a flat obstacle; exact to round-off.

    Attributes:
        shape: f on [0, 1], arrays to arrays; a parabola of height 1 unless given.
        slope: f′.

    x in [0, 1] and times t ≥ 0 broadcast. At an impact the velocity is that after it.

    Raises:
        ValueError: a shape that is not 0 at its ends, not symmetric, or not concave; x off the string; t < 0.
    """

    shape: Callable[[FloatArray], FloatArray] = _parabola
    slope: Callable[[FloatArray], FloatArray] = _parabola_slope

    def __post_init__(self) -> None:
        x = np.linspace(0.0, 1.0, 257)
        f = np.asarray(self.shape(x))
        size = float(np.max(np.abs(f)))
        if not (np.isfinite(size) and size > 0.0 and max(abs(f[0]), abs(f[-1])) <= 1e-12 * size):
            raise ValueError(f"shape must be 0 at the ends and positive between (got {f[0]!r}, {f[-1]!r})")
        if np.max(np.abs(f - f[::-1])) > 1e-12 * size:
            raise ValueError("shape must be symmetric about x = 1/2: only then the whole string lands at once")
        if np.max(f[2:] - 2.0 * f[1:-1] + f[:-2]) > 1e-12 * size:
            raise ValueError("shape must be concave: else a part of the string lands before the rest")

    def displacement(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u(x,t) ≥ 0."""
        position, t = self._inside(x, times)
        return np.abs(0.5 * (self._shape(position + t) + self._shape(position - t)))

    def velocity_at(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_t(x,t)."""
        position, t = self._inside(x, times)
        return self._side(t) * 0.5 * (self._slope(position + t) - self._slope(position - t))

    def strain(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_x(x,t)."""
        position, t = self._inside(x, times)
        return self._side(t) * 0.5 * (self._slope(position + t) + self._slope(position - t))

    def impulse(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """What the obstacle has given per length until t: 2|w_t| for each landing."""
        position, t = self._inside(x, times)
        landing = np.abs(self._slope(position + 0.5) - self._slope(position - 0.5))
        return landing * np.floor(t + 0.5)

    @staticmethod
    def _side(t: FloatArray) -> FloatArray:
        """Sign of the free motion between its zeros at t = ½, 3/2, …"""
        return np.where(np.mod(np.floor(t + 0.5), 2.0) == 0.0, 1.0, -1.0)

    def _shape(self, s: FloatArray) -> FloatArray:
        phase = np.mod(s, 2.0)
        return np.where(phase <= 1.0, 1.0, -1.0) * self.shape(np.where(phase <= 1.0, phase, 2.0 - phase))

    def _slope(self, s: FloatArray) -> FloatArray:
        phase = np.mod(s, 2.0)
        return np.asarray(self.slope(np.where(phase <= 1.0, phase, 2.0 - phase)))

    def _inside(self, x: ArrayLike, times: ArrayLike) -> tuple[FloatArray, FloatArray]:
        position, t = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(times, dtype=np.float64))
        if not np.all((position >= 0.0) & (position <= 1.0)):
            raise ValueError(f"x must lie on the string, [0, 1] (got {x!r})")
        if not np.all(t >= 0.0):
            raise ValueError(f"times must not be negative or NaN (got {times!r})")
        return position, t
