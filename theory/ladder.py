r"""Exact solutions of simpler impacts, the rungs below the beam, one thing to get right on each.

A ball (restitution, infinitely many impacts), a bar (a wave, contact that lasts: `theory.bars`), a string (contact
everywhere at once), and the stopped beam (bending waves, one fixed point: `theory.stopped_beam`). The bent beam's
moving front is `theory.similarity`. All are exact to round-off unless they say otherwise; times t ≥ 0 and
places broadcast. The open benchmark holds codes against them, the gallery draws the ball; docs/theory.md, section 10.

**Ball** dropped on a floor, with Newton's restitution and infinitely many impacts in a finite time:

    q″ = −g + Σ p_k δ(t − t_k),   q ≥ 0,   q′(t_k⁺) = −e q′(t_k⁻)

It lands at t₁ with speed u₁; flight k = 1, 2, … begins at t_k with speed u₁eᵏ, lasts 2u₁eᵏ/g, and

    t_k = t₁ + (2u₁/g) e(1 − e^{k−1})/(1 − e)  →  t₁ + (2u₁/g) e/(1 − e),   after which it rests

(any text on nonsmooth mechanics, e.g. B. Brogliato, Nonsmooth Mechanics, Springer 2016, section 1.1).

**String** that lands on a flat obstacle, the line through its ends, all at once; the impacts are elastic:

    u_tt = u_xx + r,   0 ≤ x ≤ 1,   u(0,t) = u(1,t) = 0,   u ≥ 0,   u = f(x) = 4x(1 − x), u_t = 0 at t = 0.

For a shape f that is concave and symmetric about the middle the free motion

    w = ½[F(x + t) + F(x − t)],   F the odd continuation of f with period 2,

is positive for |t| < ½ and vanishes everywhere at t = ½: the whole string lands, its velocity is reversed, and

    u(x,t) = |w(x,t)|,   impulse per length −2w_t at t = ½, 3/2, …, period 1

(H. Cabannes, Formulas for vibrating strings with obstacles (2001), henri.cabannes.free.fr/strings.html, a fixed
straight line, here through the string's ends (his h = 0); L. Amerio, Continuous solutions of the problem of a string
vibrating against an obstacle, Rend. Sem. Mat. Univ. Padova 59 (1978) 67–96, for the law of impact).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from bent_beam.checks import between, finite, non_negative, positive
from theory._fresnel import FloatArray
from theory.bars import DroppedBar as DroppedBar
from theory.bars import FlyingBar as FlyingBar
from theory.bars import ReleasedBar as ReleasedBar
from theory.bars import placed


@dataclass(frozen=True)
class BouncingBall:
    """A ball of unit mass that starts at ``height`` ≥ 0 with ``velocity``, upwards positive; any consistent units.
    Relative error 1e-13. At an impact the values are those after it. ``ValueError`` for an attribute out of its range,
    a start on the floor without an upward velocity, a negative time."""

    height: float = 1.0
    velocity: float = 0.0
    gravity: float = 1.0
    restitution: float = 0.5

    def __post_init__(self) -> None:
        non_negative("height", self.height)
        positive("gravity", self.gravity)
        between("restitution", self.restitution, 0.0, 1.0)
        if finite("velocity", self.velocity) <= 0.0 == self.height:
            raise ValueError(f"height must be positive, or the velocity upwards (got {self.height!r})")

    @property
    def landing_speed(self) -> float:
        """u₁, of the first impact."""
        return float(np.sqrt(self.velocity**2 + 2.0 * self.gravity * self.height))

    @property
    def first_impact(self) -> float:
        """t₁."""
        return (self.velocity + self.landing_speed) / self.gravity

    @property
    def rest(self) -> float:
        """The time at which infinitely many impacts are over; infinite for e = 1."""
        if self.restitution == 1.0:
            return np.inf
        e = self.restitution
        return self.first_impact + 2.0 * self.landing_speed / self.gravity * e / (1.0 - e)

    def impact_time(self, number: ArrayLike) -> FloatArray:
        """t_k of impact k = 1, 2, …, any shape."""
        k = np.asarray(number, dtype=np.float64) - 1.0
        e = self.restitution
        # e(1 − eᵏ)/(1 − e) = e + e² + … + eᵏ
        flights = k if e == 1.0 else np.where(k > 0.0, e * (1.0 - e**k) / (1.0 - e), 0.0)
        return np.asarray(self.first_impact + 2.0 * self.landing_speed / self.gravity * flights)

    def impacts(self, times: ArrayLike) -> FloatArray:
        """Number of impacts until t, that at t included; infinite from `rest` on (1 for e = 0)."""
        return self._flight(times)[0]

    def position(self, times: ArrayLike) -> FloatArray:
        """Height above the floor."""
        count, age, speed = self._flight(times)
        t = np.asarray(times, dtype=np.float64)
        first = self.height + self.velocity * t - self.gravity * t**2 / 2.0
        later = age * (speed - self.gravity * age / 2.0)
        return np.maximum(np.where(count == 0.0, first, later), 0.0)

    def velocity_at(self, times: ArrayLike) -> FloatArray:
        """Velocity, upwards positive; after the impact where there is one."""
        count, age, speed = self._flight(times)
        later = np.where(speed > 0.0, speed - self.gravity * age, 0.0)
        return np.where(count == 0.0, self.velocity - self.gravity * np.asarray(times, dtype=np.float64), later)

    def impulse(self, times: ArrayLike) -> FloatArray:
        """What the floor has given per mass, impacts and support at rest: change of momentum plus gt."""
        return np.asarray(self.velocity_at(times) - self.velocity + self.gravity * np.asarray(times, dtype=np.float64))

    def _flight(self, times: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        """(impacts so far, time since the last, speed after it); speed 0 at rest."""
        _, t = placed(0.0, times)
        e, first, speed = self.restitution, self.first_impact, self.landing_speed
        since = np.maximum(t - first, 0.0) * self.gravity / (2.0 * speed)
        if e == 1.0:
            count = np.floor(since) + 1.0
        elif e == 0.0:
            count = np.ones_like(t)
        else:
            # eᵏ⁻¹ = what is left of the way to rest
            left = np.maximum(1.0 - since * (1.0 - e) / e, 0.0)
            with np.errstate(divide="ignore"):
                count = np.floor(np.log(left) / np.log(e)) + 1.0
        if e > 0.0:  # rounding may be one impact off
            known = np.where(np.isfinite(count), count, 1.0)
            count = np.where(self.impact_time(known + 1.0) <= t, count + 1.0, count)
            count = np.where((known > 1.0) & (self.impact_time(known) > t), count - 1.0, count)
        resting = t >= self.rest
        count = np.where(t < first, 0.0, np.where(resting & (e > 0.0), np.inf, count))
        inside = (count > 0.0) & ~resting
        k = np.where(inside, count, 1.0)
        return count, np.where(inside, t - self.impact_time(k), 0.0), np.where(inside, speed * e**k, 0.0)


class StringOnObstacle:
    """A parabola of height 1 released above a flat obstacle; ``ValueError`` for x off [0, 1] or a negative time. At an
    impact the velocity is that after it."""

    def displacement(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u(x,t) ≥ 0."""
        position, t = placed(x, times)
        return np.abs(0.5 * (self._shape(position + t) + self._shape(position - t)))

    def velocity_at(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_t(x,t)."""
        position, t = placed(x, times)
        return self._side(t) * 0.5 * (self._slope(position + t) - self._slope(position - t))

    def strain(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_x(x,t)."""
        position, t = placed(x, times)
        return self._side(t) * 0.5 * (self._slope(position + t) + self._slope(position - t))

    def impulse(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """What the obstacle has given per length until t: 2|w_t| for each landing."""
        position, t = placed(x, times)
        landing = np.abs(self._slope(position + 0.5) - self._slope(position - 0.5))
        return landing * np.floor(t + 0.5)

    @staticmethod
    def _side(t: FloatArray) -> FloatArray:
        """Sign of the free motion between its zeros at t = ½, 3/2, …"""
        return np.where(np.mod(np.floor(t + 0.5), 2.0) == 0.0, 1.0, -1.0)

    @staticmethod
    def _shape(s: FloatArray) -> FloatArray:
        """F(s), s = −1 … 1 being x and −x."""
        phase = np.mod(s + 1.0, 2.0) - 1.0
        return 4.0 * phase * (1.0 - np.abs(phase))

    @staticmethod
    def _slope(s: FloatArray) -> FloatArray:
        """F′(s)."""
        return 4.0 - 8.0 * np.abs(np.mod(s + 1.0, 2.0) - 1.0)
