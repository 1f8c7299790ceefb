"""Reaction per length over place and time, from the impulses that the contact points gather."""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import Array, ImpactHistory


def force_map(history: ImpactHistory, kept: NDArray[np.int64], edges: Array) -> Array:
    """Reaction per length (frames − 1, bins): impulse between two kept instants, per length and time."""
    impact = history.impact
    unit = impact.mass_per_length * impact.velocity  # impulse per length
    width = np.diff(edges)
    rows = np.zeros((kept.size - 1, width.size))
    for row, (first, last) in enumerate(pairwise(kept)):
        pushes = np.diff(history.array("impulse", slice(first, last + 1)), axis=0) / (unit * impact.length_scale)
        for k, push in enumerate(pushes, first + 1):
            places = 0.5 * (history.contact_positions(k - 1) + history.contact_positions(k)) / impact.length_scale
            rows[row] += spread(places, push, edges)
        rows[row] /= width * (history.time[last] - history.time[first]) / impact.time_scale
    return rows


def spread(places: Array, amounts: Array, edges: Array) -> Array:
    """Amounts of contact points put into bins, each evenly over its share of the beam, the outermost up to itself."""
    middles = 0.5 * (places[1:] + places[:-1])
    begin = float(places[0])
    if 0.0 < begin < float(np.diff(places).min(initial=0.0)):  # the middle of the first element of a half beam
        begin = 0.0
    borders = np.concatenate([[begin], middles, [places[-1]]])
    gathered = np.concatenate([[0.0], np.cumsum(amounts)])
    return np.diff(np.interp(edges, borders, gathered))
