r"""A hinged beam that swings onto an elastic stop at its other end, by the modes of its two states.

The beam turns about x = 0 with ω when its end x = L meets the stop, a spring of stiffness k that never pulls. With
w(L,t) = Σ q_j the equations are

    m_j q̈_j + m_j ω_j² q_j = −k max(w(L,t), 0),      ω_j = (β_j/L)²√(EI/μ),  tan β_j = tanh β_j,

where m_0 = μL/3 and β_0 = 0 (rotation), and m_j = μL/4 for every other mode that is one at L: the integral of the
square of a mode is ¼L times its square at a free end, and a hinged end adds nothing. In either state the system is
linear: from one change of state to the next the solution is exact but for the number of modes. This is the case of
Code_Aster's test SDNL32 (V5.02.032), here without damping. The open benchmark asks for it, and a test of the Hermite
path is held against it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import brentq

from bent_beam.checks import positive
from theory._fresnel import FloatArray
from theory.elastic_wall import largest

MODES = 120
SAMPLES = 4000  # of a record, between which the end is looked for on either side of the stop


@dataclass(frozen=True)
class SwungBeam:
    """EI (N m²), μ (kg/m), L (m), ω (rad/s) and k (N/m), with the number of modes beside the rotation."""

    bending_stiffness: float
    mass_per_length: float
    length: float
    angular_velocity: float
    stop_stiffness: float
    modes: int = MODES

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            positive(name, value)

    def tip(self, end: float) -> tuple[FloatArray, FloatArray]:
        """Times from 0 to ``end``, s, and the displacement of the end of the beam into the stop then, m."""
        beta = np.pi * np.arange(self.modes + 1.0)
        for _ in range(4):  # tanh β is 1 but for 4e-4 at the first root
            beta[1:] = np.pi * np.arange(1, self.modes + 1) + np.arctan(np.tanh(beta[1:]))
        masses = np.r_[1.0 / 3.0, np.full(self.modes, 0.25)] * self.mass_per_length * self.length
        square = (beta / self.length) ** 4 * self.bending_stiffness / self.mass_per_length
        root = 1.0 / np.sqrt(masses)  # of coordinates whose mass is one
        spring = self.stop_stiffness * np.outer(root, root)
        states = [np.linalg.eigh(np.diag(square) + pushed * spring) for pushed in (False, True)]
        z, v = np.zeros(beta.size), np.zeros(beta.size)
        v[0] = self.angular_velocity * self.length / root[0]
        time, found, now, pushed = np.linspace(0.0, end, SAMPLES + 1), np.zeros(SAMPLES + 1), 0.0, True
        while now < end:
            values, shapes = states[pushed]
            motion = np.sqrt(np.maximum(values, 0.0)), shapes.T @ z, shapes.T @ v
            at_tip = root @ shapes
            later = np.flatnonzero(time > now)
            ahead = _tip(time[later] - now, at_tip, *motion)
            wrong = np.flatnonzero((ahead < 0.0) == pushed)
            count = int(wrong[0]) if wrong.size else later.size
            found[later[:count]] = ahead[:count]
            if not wrong.size:
                break
            begin = float(time[later[count - 1]]) - now if count else 1e-9 * end
            until = float(time[later[count]]) - now
            step = brentq(_tip, begin, until, args=(at_tip, *motion), xtol=1e-16 * end)
            z, v = (shapes @ part for part in _moved(step, *motion))
            now, pushed = now + step, not pushed
        return time, found

    def peak_force(self, end: float) -> tuple[float, float]:
        """The largest force of the stop until ``end``, N, and when it acts, s.

        Raises ``ValueError`` where the force still grows at ``end``: it is then not the largest.
        """
        time, found = self.tip(end)
        if found.argmax() == found.size - 1:
            raise ValueError(f"end must lie after the largest force, which still grows (got {end!r})")
        at, deepest = largest(time, found)
        return self.stop_stiffness * deepest, at


def _moved(t: Any, rate: FloatArray, place: FloatArray, speed: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Places and speeds of oscillators of these rates after t, of shape (…, 1) or a scalar; a rate of 0 is free."""
    cosine, sine = np.cos(rate * t), t * np.sinc(rate * t / np.pi)
    return place * cosine + speed * sine, speed * cosine - rate**2 * place * sine


def _tip(t: Any, at_tip: FloatArray, *motion: FloatArray) -> Any:
    return _moved(np.asarray(t)[..., None], *motion)[0] @ at_tip
