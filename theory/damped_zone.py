r"""A contact zone with Kelvin and Voigt's damping: how half length, force and impulse start (measured; no closed form).

On an endless beam without loads the damped impact has two numbers, κ/ν and the age T = t/η. Every contact starts as
one point: the wall takes the curvature κ/ν out of it only by

    T_p = erf⁻¹(κ/ν)²                    (elastic part of the moment of a point: erf √T, `theory.damped_point`)

and spreads from then on as λ_c = λ₀√(ct)(1 − T_p/T) g(T). g and the ratios of force and impulse to the undamped theory
were measured on an endless finite-element beam (`damped_zone.json`, error about 0.3 %) and are interpolated linearly
in ln κ/ν and ln T. Between κ/ν = 0.25 and 0.45 the middle, which the first instants have lifted, comes back to the wall
with a pulse of up to 15 % in the force at T = 150 … 10; there rows are compared at equal times over its age, which
leaves some per cent of error for a moment. g, force and impulse → 1 for large T, slowly in the impulse where κ/ν is
small: what the first instants took stays in it.

Loads act on a damped zone otherwise than on an undamped one. What the product of the two laws misses is measured too,
as a rate. Where a pressure acts on a flat zone it is part of the prediction; otherwise it ends its validity.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from statistics import NormalDist

import numpy as np
from numpy.typing import ArrayLike

from theory import damped_point
from theory._fresnel import FloatArray

#: Made anew by `python -m comparison.whole_impact.damped`.
DATA = Path(__file__).with_name("damped_zone.json")
#: The loads whose interaction with damping is known: pressing and lifting, χ, ψ (with α = −ψ), tension (with α = −nκ).
LOADS = ("press", "lift", "chi", "psi", "axial")


#: κ/ν between which what damping changes of the answer to loads falls below its own noise and ceases to count.
QUIET = (0.4, 0.5)
#: Over the age of spreading: before, a zone is too short for relative changes of its length to say anything.
SHORT = 3.0
#: κ/ν between which what damping changes of the answer to a pressure ceases to be part of the prediction: beyond, the
#: middle may come back to the wall at any time, and its pulse makes the rates wild.
FLAT = (0.2, 0.25)
#: Of what is part of it, what is not known: rates on elements half as long differ by 6 % in the median, 20 % at most.
UNSURE = 0.15
#: What loads make of a short zone's length waits less for the age of spreading than what is there without them: the
#: part of λ₁τ T_p/(T − T_p) that is missing (0.2 to 0.5 for α, χ, n at κ/ν = 0.8, 0.9, 0.96, T = 5 … 15).
WAITING = 0.35

@dataclass(frozen=True)
class _Table:
    """Values over ln κ/ν (rows) and ln T (columns)."""

    ratio: FloatArray
    age: FloatArray
    values: FloatArray

    touch: tuple[FloatArray, FloatArray]

    def at(self, ratio: float, age: FloatArray) -> FloatArray:
        """Bilinear in the logarithms, the outermost values beyond; shape (..., n) for values (rows, ..., columns)."""
        x = np.log(self.ratio)
        here = float(np.clip(np.log(ratio), x[0], x[-1]))
        i = int(np.clip(np.searchsorted(x, here) - 1, 0, x.size - 2))
        share = (here - x[i]) / (x[i + 1] - x[i])
        touch = self._touch(ratio)
        # from a tenth of the age of the touch on rows move with it, from half of it altogether
        moved = np.clip((np.log(age) - touch + np.log(10.0)) / np.log(5.0), 0.0, 1.0)
        low, high = (self._row(k, np.log(age) + moved * (self._touch(self.ratio[k]) - touch)) for k in (i, i + 1))
        return np.asarray((1.0 - share) * low + share * high)

    def _touch(self, ratio: float) -> float:
        """Logarithm of the age at which the lifted middle comes back to the wall."""
        return float(np.interp(ratio, self.touch[0], np.log(self.touch[1])))

    def _row(self, k: int, log_age: FloatArray) -> FloatArray:
        y = np.log(self.age)
        at = np.clip(log_age, y[0], y[-1])
        j = np.clip(np.searchsorted(y, at) - 1, 0, y.size - 2)
        part = (at - y[j]) / (y[j + 1] - y[j])
        return np.asarray((1.0 - part) * self.values[k][..., j] + part * self.values[k][..., j + 1])


@cache
def _tables() -> tuple[_Table, _Table]:
    stored = json.loads(DATA.read_text(encoding="utf-8"))
    names = ("half_length", "reaction", "impulse")
    base = np.array([stored[name] for name in names]).transpose(1, 0, 2)
    loads = stored["loads"]
    rates = np.array([[loads[load][name] for name in names] for load in LOADS]).transpose(2, 0, 1, 3)
    touch = np.array(stored["touch"]["kappa_over_nu"]), np.array(stored["touch"]["age"])
    return (
        _Table(np.array(stored["kappa_over_nu"]), np.array(stored["age"]), base, touch),
        _Table(np.array(loads["kappa_over_nu"]), np.array(loads["age"]), rates, touch),
    )


def flattest() -> float:
    """κ/ν of the flattest zone that was measured."""
    return float(_tables()[0].ratio[0])


def shortest() -> float:
    """κ/ν of the shortest zone that was measured: what comes nearer to one point."""
    return float(_tables()[0].ratio[-1])


def age_of_spreading(kappa_over_nu: float) -> float:
    """T_p = erf⁻¹(κ/ν)², until which the contact is one point; κ/ν < 1."""
    return 0.5 * NormalDist().inv_cdf(0.5 * (1.0 - kappa_over_nu)) ** 2


def touch_age(kappa_over_nu: float) -> float | None:
    """T at which the lifted middle comes back to the wall with a pulse; None outside the measured κ/ν, 0.25–0.45."""
    ratios, ages = _tables()[0].touch
    if not ratios[0] <= kappa_over_nu <= ratios[-1]:
        return None
    return float(np.exp(np.interp(kappa_over_nu, ratios, np.log(ages))))


def earliest_age(kappa_over_nu: float) -> float:
    """t/η from which the ratios are known: 0 where the point lasts until the table begins."""
    first = float(_tables()[0].age[0])
    return 0.0 if age_of_spreading(kappa_over_nu) >= first else first


def ratios(kappa_over_nu: float, r0: float, age: ArrayLike) -> FloatArray:
    """Half length, reaction and impulse over those of the undamped zone at T = t/η > 0, shape (3, n).

    Args:
        kappa_over_nu: below 1; below `flattest()` the flattest row is returned.
        r0: of the undamped zone.
        age: T, shape (n,).
    """
    ages = np.atleast_1d(np.asarray(age, dtype=np.float64))
    table = _tables()[0]
    spread, reaction, impulse = table.at(kappa_over_nu, ages)
    point = age_of_spreading(kappa_over_nu)
    last = float(table.age[-1])
    late = np.sqrt(np.where(ages > last, last / ages, 1.0))
    spread, reaction, impulse = (1.0 + (ratio - 1.0) * late for ratio in (spread, reaction, impulse))
    before = ages <= point
    if np.any(before):
        one = np.where(before, ages, point)
        reaction = np.where(before, damped_point.reaction_ratio(one) / r0, reaction)
        impulse = np.where(before, damped_point.impulse_ratio(one) / r0, impulse)
    return np.array([spread * np.where(before, 0.0, 1.0 - point / ages), reaction, impulse])


def _quiet(kappa_over_nu: float) -> float:
    return float(np.interp(kappa_over_nu, QUIET, (0.0, 1.0)))


def load_rates(kappa_over_nu: float, age: ArrayLike) -> FloatArray:
    """What damping changes of the answer to a load, per unit of load times τ: relative, (loads, 3, n), `LOADS`."""
    ages = np.atleast_1d(np.asarray(age, dtype=np.float64))
    table = _tables()[1]
    last = float(table.age[-1])
    counts = (ages >= SHORT * age_of_spreading(kappa_over_nu)) * (1.0 - _quiet(kappa_over_nu))
    return np.asarray(table.at(kappa_over_nu, ages) * np.sqrt(np.where(ages > last, last / ages, 1.0)) * counts)


def known_press(kappa_over_nu: float) -> float:
    """Share of what damping changes of the answer to a pressure that is part of the prediction."""
    return float(np.interp(kappa_over_nu, FLAT, (1.0, 0.0)))


def press_factors(kappa_over_nu: float, age: ArrayLike, press: ArrayLike) -> FloatArray:
    """Half length, reaction and impulse of a pressed zone over the product of the damped and the loaded law, (3, n).

    Args:
        press: (α′ + ψ)ετ, shape (n,), at least 0. The middle, which the first instants have lifted, bears nothing
            of the pressure until it is back.
    """
    rates = load_rates(kappa_over_nu, age)[LOADS.index("press")]
    return np.asarray(1.0 + known_press(kappa_over_nu) * rates * np.atleast_1d(press))


def waiting(kappa_over_nu: float, age: ArrayLike) -> FloatArray:
    """What the half length lacks of λ₁τ/λ₀ since damping delays it, relative, shape (n,).

    0 where `load_rates` tell; within `QUIET` the share that these leave.
    """
    ages = np.atleast_1d(np.asarray(age, dtype=np.float64))
    point = age_of_spreading(kappa_over_nu)
    counts = (ages > point) * _quiet(kappa_over_nu)
    return np.asarray(WAITING * point / (np.maximum(ages, SHORT * point) - point) * counts)
