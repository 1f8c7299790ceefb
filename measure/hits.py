"""Hits of a beam that comes back to a wall, rocks on it or goes back and forth between two: impulse and energy of each.

A hit is a time of contact with one wall whose gaps are shorter than a period of the first mode, without the other wall
in between.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.history import ImpactHistory
from measure.whole_impact import mean_velocity, pushes

__all__ = ["Hit", "hits"]


@dataclass(frozen=True)
class Hit:
    """wall : "front" or "opposite"; begin, end : s, the end in the middle of its saved interval; place : mean |x| of
    the push, m; impulse : N s, always positive.

    before, after : velocities of the centre of mass, m/s, positive towards the front wall; energy : kinetic, strain and
    in springs of the wall after it, J; lost : what the energy and the work of the loads fell by meanwhile, J.
    """

    wall: str
    begin: float
    end: float
    place: float
    impulse: float
    before: float
    after: float
    energy: float
    lost: float

    @property
    def restitution(self) -> float:
        """−after/before."""
        return -self.after / self.before


def hits(history: ImpactHistory) -> list[Hit]:
    """All hits of a run, in order of time; the last may not be over yet."""
    impact, time = history.impact, history.time
    copies = 2.0 / history.sides
    names = {"front": "impulse", "opposite": "opposite_impulse"}
    rows = {wall: copies * history.array(name) for wall, name in names.items() if name in history}
    sums = {wall: values.sum(axis=1) for wall, values in rows.items()}
    parts = [(i, k, wall) for wall, total in sums.items() for i, k in pushes(time, total, 0.0)]
    spans: list[tuple[int, int, str]] = []
    for i, k, wall in sorted(parts):
        broken = time[i] - time[spans[-1][1]] >= LOWEST_PERIOD * impact.slow_time_scale if spans else True
        if spans and spans[-1][2] == wall and not broken:
            spans[-1] = (spans[-1][0], k, wall)
        else:
            spans.append((i, k, wall))
    work = history.energy("work_of_loads")
    energy = history.array("kinetic_energy") + history.array("strain_energy") - work + history.energy("contact_energy")
    mass = impact.mass_per_length * impact.length
    gained = impact.load_within(impact.half_length) * time - history.array("total_impulse")
    velocity = impact.velocity + gained / mass
    if impact.supported:  # by forces that no history holds
        velocity = np.array([mean_velocity(history, k) for k in range(time.size)])
    found = []
    for i, k, wall in spans:
        given = rows[wall][k] - rows[wall][i]
        place = float(given @ np.abs(history.contact_positions(0))) / float(given.sum())
        numbers = (place, given.sum(), velocity[i], velocity[k], energy[k] + work[k], energy[i] - energy[k])
        found.append(Hit(wall, float(time[i]), 0.5 * float(time[k - 1] + time[k]), *map(float, numbers)))
    return found
