"""Hits of a beam that rocks on a wall or goes back and forth between two: impulse and energy of each.

A hit is what one wall gives without a break of :data:`LONGEST_BREAK` T* and without the other wall in between.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from bent_beam.history import ImpactHistory
from measure.whole_impact import mean_velocity, pushes

__all__ = ["Hit", "hits"]

LONGEST_BREAK = 0.5
"""Break without a push that ends a hit, T*: half a period of the lowest mode, as long as one lasts."""


@dataclass(frozen=True)
class Hit:
    """wall : "front" or "opposite"; begin, end : s; place : mean |x| of the push, m; impulse : N s, always positive.

    velocity : of the centre of mass after it, m/s, positive towards the front wall; energy : kinetic, strain and in
    springs of the wall after it, J; lost : what the energy fell by between its begin and its end, J.
    """

    wall: str
    begin: float
    end: float
    place: float
    impulse: float
    velocity: float
    energy: float
    lost: float


def hits(history: ImpactHistory, *, longest_break: float = LONGEST_BREAK) -> list[Hit]:
    """All hits of a run, in order of time."""
    impact, time = history.impact, history.time
    copies = 2.0 / history.sides
    names = {"front": "impulse", "opposite": "opposite_impulse"}
    rows = {wall: copies * history.array(name) for wall, name in names.items() if name in history}
    sums = {wall: values.sum(axis=1) for wall, values in rows.items()}
    parts = [(i, k, wall) for wall, total in sums.items() for i, k in pushes(time, total, 0.0)]
    spans: list[tuple[int, int, str]] = []
    for i, k, wall in sorted(parts):
        broken = time[i] - time[spans[-1][1]] > longest_break * impact.slow_time_scale if spans else True
        if spans and spans[-1][2] == wall and not broken:
            spans[-1] = (spans[-1][0], k, wall)
        else:
            spans.append((i, k, wall))
    work = history.energy("work_of_loads")
    energy = history.array("kinetic_energy") + history.array("strain_energy") - work + history.energy("contact_energy")
    mass = impact.mass_per_length * impact.length
    carried = history.array("total_impulse")
    found = []
    for i, k, wall in spans:
        given = rows[wall][k] - rows[wall][i]
        place = float(given @ np.abs(history.contact_positions(0))) / float(given.sum())
        momentum = float(carried[k]) - impact.uniform_pressure * impact.length * float(time[k])
        found.append(
            Hit(
                wall,
                float(time[i]),
                float(time[k]),
                place,
                float(given.sum()),
                mean_velocity(history, k) if impact.supported else impact.velocity - momentum / mass,
                float(energy[k] + work[k]),
                float(energy[i] - energy[k]),
            )
        )
    return found
