"""Where and how hard the wall pushes around one instant of a run of any beam, without a model of it.

Both readings take a tenth of the time before and after the instant: a beam without damping swings its front and its
reaction, and what does not converge has at least a mean.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory

__all__ = ["element_at", "half_contact_length", "last_tenth", "mean_reaction"]

AROUND = 0.1  # of the time, before and after
PUSH = 1e-9  # of the largest impulse of a contact point: less is round-off


def last_tenth(time: NDArray[np.float64], k: int) -> int:
    """The saved instant at which the last tenth of the time of instant ``k`` begins."""
    return max(0, min(int(np.searchsorted(time, 0.9 * time[k])), k - 1))


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
