r"""An elastic bar against a wall: one wave equation, one contact point, contact that lasts.

    u_tt = c² u_xx,   0 ≤ x ≤ L,   u(0,t) ≥ 0 ⊥ r = −EA u_x(0,t) ≥ 0

`FlyingBar` flies freely and meets the wall at speed v: a compression wave goes to the free end and comes back, the
wall pushes with r = EA v/c for 2L/c, the bar leaves at v, free of strain (d'Alembert; a benchmark in D. Doyen,
A. Ern, S. Piperno, Time-integration schemes for the finite element dynamic Signorini problem, SIAM J. Sci. Comput. 33
(2011) 223–249).

`ReleasedBar` is held at x = L and released from u = (L − x)/(2L): with L = c = EA = 1 it swings with period 3, in
contact for 1 ≤ t ≤ 2 (F. Dabaghi, A. Petrov, J. Pousin, Y. Renard, A robust finite element redistribution approach
for elastodynamic contact problems, hal-00917450; GetFEM's `demo_dynamic_contact_1D.py`). With u = f(t + x) + g(t − x),
g′ = f′ while it flies, g′ = −f′ in contact, and
f′(s) = −g′(s − 2) from the held end:

    f′ = −¼, −¼, +¼   and   g′ = −¼, +¼, +¼   on (0,1), (1,2), (2,3), again from there.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from theory._fresnel import FloatArray


@dataclass(frozen=True)
class FlyingBar:
    """A bar flying at the wall; any consistent units, exact to round-off.

    Attributes:
        length: L.
        stiffness: EA.
        mass_per_length: μ; c = √(EA/μ).
        velocity: v > 0 towards the wall.
        gap: of the near end at t = 0, ≥ 0.

    Positions x (0 the near end) and times t ≥ 0 broadcast.

    Raises:
        ValueError: an attribute out of its range, x off the bar, a negative time.
    """

    length: float = 1.0
    stiffness: float = 1.0
    mass_per_length: float = 1.0
    velocity: float = 1.0
    gap: float = 0.0

    def __post_init__(self) -> None:
        for name in ("length", "stiffness", "mass_per_length", "velocity"):
            if not 0.0 < getattr(self, name) < np.inf:
                raise ValueError(f"{name} must be positive and finite (got {getattr(self, name)!r})")
        if not 0.0 <= self.gap < np.inf:
            raise ValueError(f"gap must be finite and not negative (got {self.gap!r})")

    @property
    def wave_speed(self) -> float:
        """c."""
        return float(np.sqrt(self.stiffness / self.mass_per_length))

    @property
    def contact(self) -> tuple[float, float]:
        """Times of first touch and of separation, 2L/c apart."""
        touch = self.gap / self.velocity
        return touch, touch + 2.0 * self.length / self.wave_speed

    def displacement(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u, the gap of the near end included."""
        position, t = _inside(x, times, self.length)
        touch, release = self.contact
        age = t - touch
        held = -self.velocity * np.minimum(np.minimum(age, position / self.wave_speed), release - t)
        after = np.where(t > release, self.velocity * (t - release), held)
        return np.where(age < 0.0, self.gap - self.velocity * t, after)

    def velocity_at(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_t."""
        position, t = _inside(x, times, self.length)
        touch, release = self.contact
        way = position / self.wave_speed
        return self.velocity * np.where(t - touch < way, -1.0, np.where(release - t < way, 1.0, 0.0))

    def strain(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_x, negative: compression."""
        return np.where(self.velocity_at(x, times) == 0.0, -self.velocity / self.wave_speed, 0.0)

    def reaction(self, times: ArrayLike) -> FloatArray:
        """r ≥ 0, a force."""
        t, (touch, release) = np.asarray(times, dtype=np.float64), self.contact
        return np.where((t >= touch) & (t <= release), self.stiffness * self.velocity / self.wave_speed, 0.0)

    def impulse(self, times: ArrayLike) -> FloatArray:
        """∫r; 2μLv in all."""
        t, (touch, release) = np.asarray(times, dtype=np.float64), self.contact
        age = np.clip(t, touch, release) - touch
        return np.asarray(self.stiffness * self.velocity / self.wave_speed * age)


@dataclass(frozen=True)
class ReleasedBar:
    """The bar of period 3, L = c = EA = 1, exact to round-off; x and times t ≥ 0 broadcast.

    Raises:
        ValueError: x off [0, 1], a negative time.
    """

    def displacement(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u(x,t)."""
        position, t = _inside(x, times, 1.0)
        ahead, back = t + position, t - position
        # f and g less their drift of −¼ and +¼ a period, which is −x/6 together
        f = 0.25 * (-np.mod(ahead, 3.0) + 2.0 * np.maximum(np.mod(ahead, 3.0) - 2.0, 0.0) - np.floor(ahead / 3.0))
        g = 0.25 * (np.abs(np.mod(back, 3.0) - 1.0) - 1.0 + np.floor(back / 3.0))
        return np.asarray(0.5 + f + g)

    def velocity_at(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_t."""
        f, g = self._waves(x, times)
        return np.asarray(f + g)

    def strain(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_x."""
        f, g = self._waves(x, times)
        return np.asarray(f - g)

    def reaction(self, times: ArrayLike) -> FloatArray:
        """r ≥ 0: ½ for 1 ≤ t ≤ 2, and again each 3."""
        phase = np.mod(np.asarray(times, dtype=np.float64), 3.0)
        return np.where((phase >= 1.0) & (phase <= 2.0), 0.5, 0.0)

    def impulse(self, times: ArrayLike) -> FloatArray:
        """∫r."""
        t = np.asarray(times, dtype=np.float64)
        return np.asarray(0.5 * (np.floor(t / 3.0) + np.clip(np.mod(t, 3.0) - 1.0, 0.0, 1.0)))

    def _waves(self, x: ArrayLike, times: ArrayLike) -> tuple[FloatArray, FloatArray]:
        position, t = _inside(x, times, 1.0)
        f = np.where(np.mod(t + position, 3.0) < 2.0, -0.25, 0.25)
        g = np.where(np.mod(t - position, 3.0) < 1.0, -0.25, 0.25)
        return f, g


def _inside(x: ArrayLike, times: ArrayLike, length: float) -> tuple[FloatArray, FloatArray]:
    position, t = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(times, dtype=np.float64))
    if not np.all((position >= 0.0) & (position <= length)):
        raise ValueError(f"x must lie on the bar, [0, {length!r}] (got {x!r})")
    if not np.all(t >= 0.0):
        raise ValueError(f"times must not be negative or NaN (got {times!r})")
    return position, t
