"""Where and how hard the wall pushes around one instant of a run.

Places and forces are read over the tenth of the time before the instant, those of any beam also a tenth after it: a
beam without damping swings its front and its reaction, and what does not converge has at least a mean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory

__all__ = ["element_at", "first_front", "half_contact_length", "last_tenth", "mean_reaction"]

AROUND = 0.1  # of the time, before and after
ZONE = 0.7  # of the front: what pushes there is what the zone behind the front bears
PUSH = 1e-9  # of the largest impulse of a contact point: less is round-off


def last_tenth(time: NDArray[np.float64], k: int) -> int:
    """The saved instant at which the last tenth of the time of instant ``k`` begins."""
    return max(0, min(int(np.searchsorted(time, 0.9 * time[k])), k - 1))


def first_front(history: ImpactHistory, k: int) -> float:
    """Half contact length, m, at instant ``k`` of the first spread of a zone, of contact points that stay where they
    are: the centroid of what was pushed over the last tenth of the time, less what the zone behind bears; 0 without a
    push.

    The zone bears as much per length everywhere as within :data:`ZONE` of where the front was at first, where it is
    summed as it was pushed: nothing is assumed of a zone that damping or its start keeps off the wall. The centroid
    lies where the front was at the mean of √t, and is carried to the instant: exact for λ_c ~ √t.
    """
    if k == 0:
        return 0.0
    first = last_tenth(history.time, k)
    roots = np.sqrt(history.time[[first, k]])
    share = ZONE * float(roots[0] / roots.mean())
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
    return max(front * float(roots[1] / roots.mean()), 0.0)


def half_contact_length(history: ImpactHistory, k: int) -> float:
    """Distance of the outermost push from the middle, m: the median over the saved intervals around instant ``k`` in
    which the wall pushes; 0 without one. Nothing is assumed about what presses inside, and a middle that has lifted
    off does not count less."""
    time = history.time
    first = last_tenth(time, k)
    last = max(int(np.searchsorted(time, (1.0 + AROUND) * time[k], side="right")), k + 1)
    impulse = np.stack([history.array("impulse", j) for j in range(first, min(last, time.size))])
    pushed = np.diff(impulse, axis=0) > PUSH * float(np.abs(history.array("impulse", -1)).max(initial=0.0))
    places = np.abs(history.contact_positions(k))
    outermost = np.where(pushed, places, -1.0).max(axis=1)
    return float(np.median(outermost[outermost >= 0.0])) if np.any(outermost >= 0.0) else 0.0


def mean_reaction(history: ImpactHistory, k: int) -> float | None:
    """Mean reaction around instant ``k``, N: of a force that falls like 1/√t it is 0.1 % too large. ``None`` at the
    first instant, and where the record ends before."""
    time, total = history.time, history.array("total_impulse")
    span = time[k] * np.array([1.0 - AROUND, 1.0 + AROUND])
    if k == 0 or span[1] > time[-1] * (1.0 + 1e-9):
        return None
    before, after = np.interp(span, time, total)
    return float((after - before) / (span[1] - span[0]))


def element_at(history: ImpactHistory, k: int, place: float) -> float:
    """Length of the element at ``place`` from the middle, m: a half length is no surer."""
    x = np.unique(np.abs(history.positions(k)))
    at = min(max(int(np.searchsorted(x, place)), 1), x.size - 1)
    return float(x[at] - x[at - 1])
