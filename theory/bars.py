r"""An elastic bar (no error bar) hits a wall with its end: one wave equation, one contact point, contact that lasts.
Exact to round-off; rungs of `theory.ladder`, which says who uses them.

    u_tt = c² u_xx,   0 ≤ x ≤ L,   u(0,t) ≥ 0 ⊥ r = −EA u_x(0,t) ≥ 0

`FlyingBar` flies freely and meets the wall at speed v: a compression wave goes to the free end and comes back, the
wall pushes with r = EA v/c for 2L/c, the bar leaves at v, free of strain (d'Alembert; a benchmark in D. Doyen,
A. Ern, S. Piperno, Time-integration schemes for the finite element dynamic Signorini problem, SIAM J. Sci. Comput. 33
(2011) 223–249).

`DroppedBar` falls from rest under gravity g and meets the wall at v. Its wave p(t) = v + gt raises the reaction
to r = Z(v + gt), Z = √(EAμ), until it is back at T = 2L/c; there r would be Z(gT − v) < 0, and the bar leaves with the
uniform speed v and the strain −2g(L − x)/c². Its fundamental period is T, too: after the flight of 2v/g, a whole number
of T, it lands with that strain, contact runs backwards, r = Z(v + g(T − t)), and it leaves free of strain as it fell.
So the motion has the period 2(T + 2v/g), in which the wall gives 2Z(vT + gT²/2) = μLg·2(T + 2v/g) (the bouncing bar of
Doyen, Ern and Piperno: L = 10, EA = 900, μ = 1, g = 10, height 5: period 16/3, impulse 533.3).

`ReleasedBar` is held at x = L and released from u = (L − x)/(2L): with L = c = EA = 1 it swings with period 3, in
contact for 1 ≤ t ≤ 2 (F. Dabaghi, A. Petrov, J. Pousin, Y. Renard, A robust finite element redistribution approach
for elastodynamic contact problems, hal-00917450; GetFEM's `demo_dynamic_contact_1D.py`). With u = f(t + x) + g(t − x),
g′ = f′ while it flies, g′ = −f′ in contact, and f′(s) = −g′(s − 2) from the held end:

    f′ = −¼, −¼, +¼   and   g′ = −¼, +¼, +¼   on (0,1), (1,2), (2,3), again from there.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from bent_beam.checks import non_negative, positive
from theory._fresnel import FloatArray


@dataclass(frozen=True)
class FlyingBar:
    """A bar flying at the wall at ``velocity`` > 0, its near end (x = 0) ``gap`` ≥ 0 away; any consistent units.
    ``stiffness`` is EA, ``mass_per_length`` μ; c = √(EA/μ). ``ValueError`` for an attribute out of its range, x off the
    bar, a negative time."""

    length: float = 1.0
    stiffness: float = 1.0
    mass_per_length: float = 1.0
    velocity: float = 1.0
    gap: float = 0.0

    def __post_init__(self) -> None:
        for name in ("length", "stiffness", "mass_per_length", "velocity"):
            positive(name, getattr(self, name))
        non_negative("gap", self.gap)

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
        position, t = placed(x, times, self.length)
        touch, release = self.contact
        return self.velocity * np.maximum(np.maximum(touch - t, -position / self.wave_speed), t - release)

    def velocity_at(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_t."""
        position, t = placed(x, times, self.length)
        touch, release = self.contact
        way = position / self.wave_speed
        return self.velocity * np.where(t - touch < way, -1.0, np.where(release - t < way, 1.0, 0.0))

    def strain(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u_x, negative: compression."""
        return np.where(self.velocity_at(x, times) == 0.0, -self.velocity / self.wave_speed, 0.0)

    def reaction(self, times: ArrayLike) -> FloatArray:
        """r ≥ 0, a force."""
        (_, t), (touch, release) = placed(0.0, times), self.contact
        return np.where((t >= touch) & (t <= release), self.stiffness * self.velocity / self.wave_speed, 0.0)

    def impulse(self, times: ArrayLike) -> FloatArray:
        """∫r; 2μLv in all."""
        (_, t), (touch, release) = placed(0.0, times), self.contact
        return np.asarray(self.stiffness * self.velocity / self.wave_speed * (np.clip(t, touch, release) - touch))


@dataclass(frozen=True)
class DroppedBar:
    """A bar dropped from a height; any consistent units, the defaults those of Doyen, Ern, Piperno. ``ValueError``
    where the flight is no whole number of 2L/c, or the bar is so soft that it stays for longer."""

    length: float = 10.0
    stiffness: float = 900.0
    mass_per_length: float = 1.0
    gravity: float = 10.0
    height: float = 5.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            positive(name, value)
        periods = self.flight / self.contact
        if abs(periods - round(periods)) > 1e-9 or self.gravity * self.contact >= self.landing_speed:
            raise ValueError(f"height: the flight must be a whole number of 2L/c, longer than 2 (got {periods:g})")

    @property
    def contact(self) -> float:
        """T = 2L/c, of each contact."""
        return 2.0 * self.length / float(np.sqrt(self.stiffness / self.mass_per_length))

    @property
    def landing_speed(self) -> float:
        """v."""
        return float(np.sqrt(2.0 * self.gravity * self.height))

    @property
    def flight(self) -> float:
        """2v/g, from contact to contact; the first fall takes half of it."""
        return 2.0 * self.landing_speed / self.gravity

    def impulse(self, times: ArrayLike) -> FloatArray:
        """∫r."""
        v, g, T = self.landing_speed, self.gravity, self.contact
        count, age = np.divmod(placed(0.0, times)[1] - self.flight / 2.0, T + self.flight)
        t = np.clip(age, 0.0, T)
        forward, backward = v * t + g * t**2 / 2.0, v * t + g * (T * t - t**2 / 2.0)
        one = np.where(count % 2.0 == 0.0, forward, backward)
        whole = np.maximum(count, 0.0) * (v * T + g * T**2 / 2.0)
        impedance = float(np.sqrt(self.stiffness * self.mass_per_length))
        return np.asarray(impedance * np.where(count < 0.0, 0.0, whole + one))


class ReleasedBar:
    """The bar of period 3, L = c = EA = 1; ``ValueError`` for x off [0, 1] or a negative time."""

    def displacement(self, x: ArrayLike, times: ArrayLike) -> FloatArray:
        """u(x,t)."""
        position, t = placed(x, times)
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
        phase = np.mod(placed(0.0, times)[1], 3.0)
        return np.where((phase >= 1.0) & (phase <= 2.0), 0.5, 0.0)

    def impulse(self, times: ArrayLike) -> FloatArray:
        """∫r."""
        _, t = placed(0.0, times)
        return np.asarray(0.5 * (np.floor(t / 3.0) + np.clip(np.mod(t, 3.0) - 1.0, 0.0, 1.0)))

    def _waves(self, x: ArrayLike, times: ArrayLike) -> tuple[FloatArray, FloatArray]:
        position, t = placed(x, times)
        f = np.where(np.mod(t + position, 3.0) < 2.0, -0.25, 0.25)
        g = np.where(np.mod(t - position, 3.0) < 1.0, -0.25, 0.25)
        return f, g


def placed(x: ArrayLike, times: ArrayLike, length: float = 1.0) -> tuple[FloatArray, FloatArray]:
    """x in [0, length] and t ≥ 0, broadcast."""
    position, t = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(times, dtype=np.float64))
    if not np.all((position >= 0.0) & (position <= length)):
        raise ValueError(f"x must lie in [0, {length!r}] (got {x!r})")
    if not np.all(t >= 0.0):
        raise ValueError(f"times must not be negative or NaN (got {times!r})")
    return position, t
