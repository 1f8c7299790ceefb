"""A history reduced to moments of one side's impulse: what the estimators read.

The uniform reaction p that a pressed zone bears is measured well inside the zone, and ∫pλ_c dτ and ∫pλ_c²/2 dτ are
taken out of the impulse and its first moment.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory
from measure.front import last_tenth

__all__ = ["Moments", "local_front", "moments", "one_side"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Moments:
    """A history reduced to what the estimators need, in fast-layer units, each of shape (times,).

    tau; impulse I(τ) and first moment J(τ) of one side's concentrated reaction; pressure p(τ), the uniform reaction;
    front λ_c(τ); lift, the largest gap inside nine tenths of the contact zone over V₀t.
    """

    tau: Array
    impulse: Array
    moment: Array
    pressure: Array
    front: Array
    lift: Array


# --- reading a history -------------------------------------------------------------------------------------------


def one_side(history: ImpactHistory) -> tuple[Array, Array]:
    """Total impulse of one side (N s) and its first moment (N s m) at the saved instants."""
    total = history.array("total_impulse") / 2.0
    if "impulse_moment" in history:
        return total, history.array("impulse_moment")
    if "contact_position" in history:  # each contact point gathers on its way: what it got is taken halfway
        impulse = history.array("impulse")
        places = np.abs(np.stack([history.contact_positions(k) for k in range(history.time.size)]))
        pushes = np.diff(impulse, axis=0, prepend=0.0 * impulse[:1])
        moment = np.cumsum((pushes * 0.5 * (places + np.concatenate([places[:1], places[:-1]]))).sum(axis=1))
    else:
        places = np.abs(history.contact_positions(0))
        moment = history.array("impulse") @ places
    return total, moment / history.sides


ZONE = 0.7  # of the front, within which the uniform reaction is read off


def _outwards(history: ImpactHistory) -> Iterator[tuple[Array, Array, Array]]:
    """Of each interval between saved instants, contact points from the centre outwards: place (m), impulse gathered up
    to there on one side (N s), and length that is the point's own (m)."""
    moving = "contact_position" in history
    before = history.array("impulse", 0)
    for k in range(1, history.time.size):
        if moving or k == 1:  # a moving contact point has gathered its impulse on the way: take its place halfway
            places = np.abs(0.5 * (history.contact_positions(k - 1) + history.contact_positions(k)))
            order = np.argsort(places)
            places = places[order]
            own = np.gradient(places) if places.size > 1 else np.zeros(places.size)
        impulse = history.array("impulse", k)
        gathered = (impulse - before)[order] / history.sides
        before = impulse
        upto = np.cumsum(gathered) - 0.5 * gathered
        upto[places == 0.0] = 0.0  # the centre carries for one side of it
        yield places, upto, own


def _pressure(time: Array, outwards: Iterable[tuple[Array, Array, Array]], front: Array) -> Array:
    """Uniform reaction (N/m) over each interval: the slope of the impulse gathered from the centre outwards, by least
    squares over the contact points within :data:`ZONE` of the front.

    Few of these may carry the load at a time, each for its neighbours: a sum over them, divided by the length between
    the outermost, is off by what one of them carries; the slope hardly feels it.
    """
    found = np.zeros(time.size)
    for k, (places, upto, own) in enumerate(outwards, 1):
        inside = places < ZONE * front[k]
        if inside.sum() < 3:
            continue
        share = own[inside]
        off = places[inside] - np.average(places[inside], weights=share)
        found[k] = (share * off) @ upto[inside] / ((share * off) @ off) / (time[k] - time[k - 1])
    return found


def moments(history: ImpactHistory, *, uniform: bool | None = None) -> Moments:
    """Concentrated impulse and first moment of one side. ``uniform``: a uniform reaction may act and is taken out
    (``None``: where something presses the zone)."""
    impact = history.impact
    uniform = impact.zone_pressure > 0.0 if uniform is None else uniform
    total, moment = one_side(history)
    time = history.time
    step = np.diff(time, prepend=time[0])
    pressure = np.zeros(time.size)
    front = np.zeros(time.size)
    force, torque = np.diff(total, prepend=total[0]), np.diff(moment, prepend=moment[0])
    carrying = np.maximum.accumulate(np.maximum(total, 0.0)) > 0.0
    front[1:] = np.where(force[1:] > 0.0, torque[1:] / np.where(force[1:] > 0.0, force[1:], 1.0), 0.0)
    front = np.where(carrying, np.clip(front, 0.0, None), 0.0)
    if uniform:
        kept = list(_outwards(history))
        for _ in range(6):  # the front and the part of the uniform reaction depend on each other: contracts fast
            pressure = _smooth(time, _pressure(time, kept, front))
            part, turn = pressure * front * step, pressure * front**2 / 2.0 * step
            left = force - part
            front = np.where(left > 0.0, (torque - turn) / np.where(left > 0.0, left, 1.0), front)
            front = np.clip(front, 0.0, None)
        total = np.cumsum(force - pressure * front * step) + total[0]
        moment = np.cumsum(torque - pressure * front**2 / 2.0 * step) + moment[0]
    unit = impact.mass_per_length * impact.length_scale * impact.velocity
    # the centroid so far is the mean over an interval, that is of √t: carry it to the interval's end
    before = np.sqrt(np.concatenate([time[:1], time[:-1]]))
    front = front * np.sqrt(time) / np.where(time > 0.0, 0.5 * (np.sqrt(time) + before), 1.0)
    return Moments(
        tau=time / impact.time_scale,
        impulse=total / unit,
        moment=moment / (unit * impact.length_scale),
        pressure=pressure / (unit / impact.length_scale / impact.time_scale),
        front=front / impact.length_scale,
        lift=_lift(history),
    )


def _smooth(time: Array, values: Array) -> Array:
    """Running average over the times from a quarter of each to as much beyond: the uniform reaction is steady, its
    measurement is not."""
    out = values.copy()
    gathered = np.concatenate([[0.0], np.cumsum(values[1:] * np.diff(time))])
    for k in range(1, time.size):
        first = int(np.searchsorted(time, 0.25 * time[k]))
        last = min(int(np.searchsorted(time, 1.75 * time[k])), time.size - 1)
        if last > first:
            out[k] = (gathered[last] - gathered[first]) / (time[last] - time[first])
    return out


def _lift(history: ImpactHistory) -> Array:
    """Largest gap inside nine tenths of the contact zone over V₀t at the saved instants (0 without a zone)."""
    front = local_front(history.time, *one_side(history))
    lift = np.zeros(history.time.size)
    for k, t in enumerate(history.time):
        inside = np.abs(history.positions(k)) <= 0.9 * front[k]
        if t > 0.0 and inside.any():
            lift[k] = max(0.0, float(history.array("gap", k)[inside].max())) / (history.impact.velocity * t)
    return lift


def local_front(time: Array, impulse: Array, moment: Array) -> Array:
    """λ_c at the instants ``time`` from one side's ``impulse`` and its first ``moment``, all of shape (times,), in the
    unit of moment/impulse: the centroid of what was gathered over the last tenth of each instant's time.

    That lies where the front was at the mean of √t, and is carried to the instant: exact for λ_c ~ √t.
    """
    front = np.zeros(time.size)
    for k in range(1, time.size):
        j = last_tenth(time, k)
        if impulse[k] > impulse[j]:
            roots = np.sqrt(time[[j, k]])
            centroid = (moment[k] - moment[j]) / (impulse[k] - impulse[j])
            front[k] = max(centroid * roots[1] / roots.mean(), 0.0)
    return front
