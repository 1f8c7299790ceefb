"""Where and how hard the wall pushes: a history reduced to moments of one side's impulse, which the estimators read,
and the front, the half length and the reaction around one instant.

The uniform reaction p that a pressed zone bears is measured well inside the zone, and ∫pλ_c dτ and ∫pλ_c²/2 dτ are
taken out of the impulse and its first moment. A centroid of what was pushed in a time lies where the front was at the
mean of √t, and is carried to the end of the time: exact for λ_c ~ √t.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import Array, ImpactHistory

__all__ = [
    "Moments", "element_at", "first_front", "half_contact_length", "jump_of_rim", "lift", "local_front",
    "mean_reaction", "moments", "one_side", "unresolved", "unresolved_at_end", "unsure",
]  # fmt: skip

ZONE = 0.7  # of the front: what pushes within is the zone's uniform reaction
AROUND = 0.1  # of the time, before and after
JUMP, MOVES = 0.02, 4.0  # a rim jumps by more than this share of it, and this many times what one ~ √t moves by
FEW, UNSURE = 3, 0.5  # elements; of what a front differs from one ~ √t by
PUSH = 1e-9  # of the largest impulse of a contact point: less is round-off


@dataclass(frozen=True)
class Moments:
    """A history reduced to what the estimators need, in fast-layer units, each of shape (times,).

    tau; impulse I(τ) and first moment J(τ) of one side's concentrated reaction; pressure p(τ), the uniform reaction
    (where it was not taken out, what the zone bears of I); front λ_c(τ); lift, as of :func:`lift`."""

    tau: Array
    impulse: Array
    moment: Array
    pressure: Array
    front: Array
    lift: Array


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
        moment = history.array("impulse") @ np.abs(history.contact_positions(0))
    return total, moment / history.sides


def _outwards(history: ImpactHistory) -> Iterator[tuple[Array, Array, Array]]:
    """Of each interval between saved instants, contact points from the centre outwards: place (m), impulse gathered up
    to there on one side (N s), length that is the point's own (m). A point that moves is taken halfway."""
    for k in range(1, history.time.size):
        places = np.abs(0.5 * (history.contact_positions(k - 1) + history.contact_positions(k)))
        order = np.argsort(places)
        places = places[order]
        own = np.gradient(places) if places.size > 1 else np.zeros(places.size)
        gathered = (history.array("impulse", k) - history.array("impulse", k - 1))[order] / history.sides
        upto = np.cumsum(gathered) - 0.5 * gathered
        upto[places == 0.0] = 0.0  # the centre carries for one side of it
        yield places, upto, own


def _pressure(time: Array, outwards: Iterable[tuple[Array, Array, Array]], front: Array) -> Array:
    """Uniform reaction (N/m) over each interval: the slope of the impulse gathered from the centre outwards, by least
    squares over the contact points within :data:`ZONE` of the front.

    At any time only a few of these points may carry the load, each for its neighbours. A sum over them, divided by the
    length between the outermost, is off by what one of them carries; the slope hardly is."""
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
    impact, time = history.impact, history.time
    uniform = impact.zone_pressure > 0.0 if uniform is None else uniform
    total, moment = one_side(history)
    step, force, torque = (np.diff(values, prepend=values[0]) for values in (time, total, moment))
    carrying = np.maximum.accumulate(np.maximum(total, 0.0)) > 0.0
    front = np.where(carrying, _centroids(torque, force, 0.0 * time), 0.0)
    if uniform:
        kept = list(_outwards(history))
        for _ in range(6):  # the front and the part of the uniform reaction depend on each other: contracts fast
            pressure = _smooth(time, _pressure(time, kept, front))
            left, turned = force - pressure * front * step, torque - pressure * front**2 / 2.0 * step
            front = _centroids(turned, left, front)
        total = np.cumsum(force - pressure * front * step) + total[0]
        moment = np.cumsum(torque - pressure * front**2 / 2.0 * step) + moment[0]
    else:  # a zone that should bear nothing
        pressure = _smooth(time, _pressure(time, _outwards(history), front))
    unit = impact.mass_per_length * impact.length_scale * impact.velocity
    return Moments(
        tau=time / impact.time_scale,
        impulse=total / unit,
        moment=moment / (unit * impact.length_scale),
        pressure=pressure / (unit / impact.length_scale / impact.time_scale),
        front=_carried(front, np.concatenate([time[:1], time[:-1]]), time) / impact.length_scale,
        lift=lift(history),
    )


def _centroids(moment: Array, impulse: Array, otherwise: Array) -> Array:
    """moment/impulse, not negative, where there is an impulse."""
    return np.maximum(np.where(impulse > 0.0, moment / np.where(impulse > 0.0, impulse, 1.0), otherwise), 0.0)


def _smooth(time: Array, values: Array) -> Array:
    """Running average from a quarter of each time to as much beyond: the reaction is steady, its measurement is not."""
    gathered = np.concatenate([[0.0], np.cumsum(values[1:] * np.diff(time))])
    first = np.searchsorted(time, 0.25 * time)
    last = np.minimum(np.searchsorted(time, 1.75 * time), time.size - 1)
    last[0] = first[0]  # nothing was measured before the first instant
    span = np.where(last > first, time[last] - time[first], 1.0)
    return np.where(last > first, (gathered[last] - gathered[first]) / span, values)


def lift(history: ImpactHistory) -> Array:
    """Largest gap inside nine tenths of the zone over V₀t at the saved instants, shape (times,); 0 without a zone."""
    front = local_front(history.time, *one_side(history))
    found = np.zeros(history.time.size)
    for k, t in enumerate(history.time):
        inside = np.abs(history.positions(k)) <= 0.9 * front[k]
        if t > 0.0 and inside.any():
            found[k] = max(0.0, float(history.array("gap", k)[inside].max())) / (history.impact.velocity * t)
    return found


def _last_tenth(time: Array) -> NDArray[np.intp]:
    """The saved instants at which the last tenth of the time of each begins."""
    return np.maximum(0, np.minimum(np.searchsorted(time, 0.9 * time), np.arange(time.size) - 1))


def _carried(centroid: Any, begin: Any, end: Any) -> Any:
    """The front at the times ``end`` from centroids of what was pushed since ``begin`` (see the module's head)."""
    mean = 0.5 * (np.sqrt(begin) + np.sqrt(end))
    return centroid * np.sqrt(end) / np.where(mean > 0.0, mean, 1.0)


def local_front(time: Array, impulse: Array, moment: Array) -> Array:
    """λ_c at the instants ``time`` from one side's ``impulse`` and its first ``moment``, all of shape (times,), in the
    unit of moment/impulse: the centroid of what was gathered over the last tenth of each instant's time."""
    first = _last_tenth(time)
    centroids = _centroids(moment - moment[first], impulse - impulse[first], 0.0 * time)
    return np.asarray(_carried(centroids, time[first], time))


def first_front(history: ImpactHistory, time: float) -> tuple[float, float]:
    """Half contact length, m, at ``time``, s, in the first spread of a zone, and by how much it differs from that of a
    front ~ √t, m; 0 without a push. The centroids of what was pushed over the tenth of the time before, and the tenth
    after, lie where the front was at the means of √t: between them it is a power of time, or straight in √t where the
    zone ends or begins. At the end of a record it is carried on as √t."""
    instants = history.time
    k = int(np.argmin(np.abs(instants - time)))
    if k == 0:
        return 0.0, 0.0
    windows = [(int(_last_tenth(instants)[k]), k)]
    if k + 1 < instants.size:
        windows.append((k, max(int(np.searchsorted(instants, (1.0 + AROUND) * instants[k], side="right")) - 1, k + 1)))
    if "contact_position" in history:  # points that move with the contact gather on their way
        found, length = moments(history), history.impact.length_scale
        pushes = [found.impulse[end] - found.impulse[begin] for begin, end in windows]
        turns = [found.moment[end] - found.moment[begin] for begin, end in windows]
        fronts = [length * max(turn / push, 0.0) if push > 0.0 else 0.0 for turn, push in zip(turns, pushes)]
    else:
        fronts = [_zone_end(history, *window) for window in windows]
    means = [float(np.sqrt(instants[list(window)]).mean()) for window in windows]
    steady = fronts[0] * time**0.5 / means[0]
    if len(windows) == 1:
        return steady, 0.0
    if min(fronts) <= 0.0:  # no power of time leads to, or from, nothing
        return float(np.interp(time**0.5, means, fronts)), abs(fronts[1] - fronts[0])
    power = np.log(fronts[1] / fronts[0]) / np.log(means[1] / means[0])
    front = fronts[0] * float((time**0.5 / means[0]) ** power)
    return front, abs(front - steady)


def _zone_end(history: ImpactHistory, first: int, k: int) -> float:
    """The centroid, m, of what was pushed between two saved instants, less what the zone behind the front bears. Within
    :data:`ZONE` of where the front was at first, what was pushed is summed; the rest of the zone is taken to bear as
    much per length. Nothing is assumed of a zone that damping or its start keeps off the wall."""
    share = ZONE * float(_carried(1.0, history.time[k], history.time[first]))  # the front at first over the centroid
    pushed = history.array("impulse", k) - history.array("impulse", first)
    places = np.abs(history.contact_positions(k))
    force, moment = float(pushed.sum()), float(pushed @ places)
    front = moment / force if force > 0.0 else 0.0
    for _ in range(6):  # the front and what lies behind it depend on each other: contracts fast
        behind = places < share * front
        borne = float(pushed[behind].sum())
        ahead = borne * (1.0 - share) / share if share else 0.0
        if force - borne - ahead <= 0.0:
            break
        left = moment - float(pushed[behind] @ places[behind]) - ahead * 0.5 * (1.0 + share) * front
        front = left / (force - borne - ahead)
    return max(front, 0.0)


def half_contact_length(history: ImpactHistory, k: int) -> float | None:
    """Distance of the outermost push from the first touch, m: the median, by time, over the saved intervals around
    instant ``k`` in which the wall pushes; ``None`` without one. A middle that has lifted off does not count less."""
    rims, durations = _rims(history, k)
    if not rims.size:
        return None
    order = np.argsort(rims)
    share = np.cumsum(durations[order]) - 0.5 * durations[order]
    return float(np.interp(0.5 * durations.sum(), share, rims[order]))


def jump_of_rim(history: ImpactHistory, k: int) -> float:
    """How far the rim jumps about instant ``k``, m, where the median of :func:`half_contact_length` may as well be the
    next interval's; 0 of one that moves on (:data:`JUMP`, :data:`MOVES`)."""
    rims = np.sort(_rims(history, k)[0])
    middle = rims[max((rims.size - 1) // 2 - 1, 0) : rims.size // 2 + 2]
    widest = float(np.diff(middle).max(initial=0.0))
    moves = 1.0 - math.sqrt(history.time[k - 1] / history.time[k]) if k else 1.0  # of a rim ~ √t
    return widest if rims.size and widest > max(JUMP, MOVES * moves) * middle[-1] else 0.0


def _rims(history: ImpactHistory, k: int) -> tuple[Array, Array]:
    """Distance of the outermost push from the first touch, m, in each saved interval around ``k`` that has one, and
    how much of the interval, s, lies within :data:`AROUND` of the time."""
    begin, end = (1.0 - AROUND) * history.time[k], (1.0 + AROUND) * history.time[k]
    first = max(int(np.searchsorted(history.time, begin, side="right")) - 1, 0)
    last = max(int(np.searchsorted(history.time, end)), k) + 1
    within = np.clip(history.time[first:last], begin, end)
    least = PUSH * float(np.abs(history.array("impulse", -1)).max(initial=0.0))
    pushes = np.diff(history.array("impulse", slice(first, last)), axis=0) > least
    distances = np.abs(history.contact_positions(k) - history.impact.first_touch)
    outermost = np.where(pushes, distances, -1.0).max(axis=1)
    has_one = outermost >= 0.0
    return outermost[has_one], np.diff(within)[has_one]


def mean_reaction(history: ImpactHistory, at: float) -> float | None:
    """Mean reaction over a tenth of the time ``at``, s, before and after, N: of a force that falls like 1/√t it is
    0.1 % too large. ``None`` at the first touch, and where the record ends before."""
    span = at * np.array([1.0 - AROUND, 1.0 + AROUND])
    if at <= 0.0 or span[1] > history.time[-1] * (1.0 + 1e-9):
        return None
    return float(np.diff(history.impulse_at(span))[0] / (span[1] - span[0]))


def unsure(history: ImpactHistory, k: int, front: float | None, bent: float | None) -> float:
    """What a half length ``front`` at instant ``k`` may be off by for its mesh and its reading, m. bent : of a
    :func:`first_front`, what it differs by from one ~ √t; ``None`` of a :func:`half_contact_length`."""
    if front is None:
        return 0.0
    if bent is None:
        return max(element_beside(history, k, front), jump_of_rim(history, k))
    return max(UNSURE * bent, unresolved(history, k, front))


def unresolved(history: ImpactHistory, k: int, front: float) -> float:
    """Length, m, of the elements of which a front at ``front`` m has passed less than :data:`FEW`; 0 of others."""
    element = element_beside(history, k, front)
    return element if front < FEW * element else 0.0


def unresolved_at_end(history: ImpactHistory, found: Moments) -> float:
    """The same at the last instant, l*, and what springs of k_c in place of a rigid wall leave: half of √(EI/k_c) over
    the front, the size of their error at κ/ν = 0.5, where runs of other k_c may agree by chance."""
    impact, front = history.impact, float(found.front[-1]) * history.impact.length_scale
    integrator = history.settings.get("integrator")
    spring = integrator.get("stiffness") if isinstance(integrator, dict) else None
    soft = 0.5 * math.sqrt(impact.bending_stiffness / spring) / front if spring and front else 0.0
    return (unresolved(history, -1, front) + soft) / impact.length_scale


def element_beside(history: ImpactHistory, k: int, front: float) -> float:
    """Length of the element ``front`` m from the first touch, with a node there: by which it may be off."""
    nodes, touch = history.positions(k), history.impact.first_touch
    sides = (touch + front, touch - (1.0 - 1e-9) * front)[: history.sides]  # at a node the inner element
    inside = [x for x in sides if nodes[0] <= x <= nodes[-1]]
    return element_at(history, k, min(inside, key=lambda x: float(np.abs(nodes - x).min()), default=touch + front))


def element_at(history: ImpactHistory, k: int, x: float) -> float:
    """Length of the element at ``x``, m, or of the last one before it."""
    nodes = history.positions(k)
    at = min(max(int(np.searchsorted(nodes, x)), 1), nodes.size - 1)
    return float(nodes[at] - nodes[at - 1])
