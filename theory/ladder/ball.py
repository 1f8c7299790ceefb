r"""A ball dropped on a floor, with Newton's restitution and infinitely many impacts in a finite time.

    q″ = −g + Σ p_k δ(t − t_k),   q ≥ 0,   q′(t_k⁺) = −e q′(t_k⁻)

It lands at t₁ with speed u₁; flight k = 1, 2, … begins at t_k with speed u₁eᵏ, lasts 2u₁eᵏ/g, and

    t_k = t₁ + (2u₁/g) e(1 − e^{k−1})/(1 − e)  →  t₁ + (2u₁/g) e/(1 − e),   after which it rests.

Source: any text on nonsmooth mechanics, e.g. B. Brogliato, Nonsmooth Mechanics, Springer 2016, section 1.1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from theory._fresnel import FloatArray


@dataclass(frozen=True)
class BouncingBall:
    """A ball of unit mass; any consistent units.

    Attributes:
        height: of the start, ≥ 0.
        velocity: at the start, upwards positive.
        gravity: g > 0.
        restitution: e in [0, 1].

    Relative error 1e-13; times t ≥ 0 of any shape. At an impact the values are those after it.

    Raises:
        ValueError: an attribute out of its range, a start on the floor without an upward velocity, a negative time.
    """

    height: float = 1.0
    velocity: float = 0.0
    gravity: float = 1.0
    restitution: float = 0.5

    def __post_init__(self) -> None:
        for name in ("height", "velocity", "gravity", "restitution"):
            if not np.isfinite(getattr(self, name)):
                raise ValueError(f"{name} must be finite (got {getattr(self, name)!r})")
        if self.height < 0.0 or (self.height == 0.0 and self.velocity <= 0.0):
            raise ValueError(f"height must be positive, or the velocity upwards (got {self.height!r})")
        if self.gravity <= 0.0:
            raise ValueError(f"gravity must be positive (got {self.gravity!r})")
        if not 0.0 <= self.restitution <= 1.0:
            raise ValueError(f"restitution must lie in [0, 1] (got {self.restitution!r})")

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
        later = np.maximum(age * (speed - self.gravity * age / 2.0), 0.0)
        return np.where(count == 0.0, np.maximum(first, 0.0), later)

    def velocity_at(self, times: ArrayLike) -> FloatArray:
        """Velocity, upwards positive; after the impact where there is one."""
        count, age, speed = self._flight(times)
        t = np.asarray(times, dtype=np.float64)
        later = np.where(speed > 0.0, speed - self.gravity * age, 0.0)
        return np.where(count == 0.0, self.velocity - self.gravity * t, later)

    def energy(self, times: ArrayLike) -> FloatArray:
        """Kinetic and potential energy per mass."""
        count, _, speed = self._flight(times)
        start = self.velocity**2 / 2.0 + self.gravity * self.height
        return np.where(count == 0.0, start, speed**2 / 2.0)

    def impulse(self, times: ArrayLike) -> FloatArray:
        """What the floor has given per mass, impacts and support at rest: change of momentum plus gt."""
        t = np.asarray(times, dtype=np.float64)
        return np.asarray(self.velocity_at(t) - self.velocity + self.gravity * t)

    def _flight(self, times: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        """(impacts so far, time since the last, speed after it); speed 0 at rest."""
        t = np.asarray(times, dtype=np.float64)
        if not np.all(t >= 0.0):
            raise ValueError(f"times must not be negative or NaN (got {times!r})")
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
        inside: NDArray[np.bool_] = (count > 0.0) & ~resting
        k = np.where(inside, count, 1.0)
        return count, np.where(inside, t - self.impact_time(k), 0.0), np.where(inside, speed * e**k, 0.0)
