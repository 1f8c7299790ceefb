"""Hits of a beam that comes back to its wall, followed by one run, and as a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from bent_beam import Impact, ImpactHistory
from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.measure.whole_impact import Hit, hits
from bent_beam.method import Method, for_whole_beam
from comparison.readable import text_table

__all__ = ["BETWEEN_WALLS", "OF_ONE_WALL", "follow_hits", "hits_table"]

LONGEST = 100.0  # T*: the longest run that follows hits
INSTANTS = 200  # saved a T* of it
TITLES = {
    "wall": "wall",
    "begin": "from, s",
    "end": "to, s",
    "place": "mean |x|, m",
    "impulse": "impulse, N s",
    "before": "V before, m/s",
    "after": "after, m/s",
    "restitution": "restitution",
    "energy": "energy, J",
    "lost": "lost, J",
}
BETWEEN_WALLS = tuple(name for name in TITLES if name != "restitution")
OF_ONE_WALL = ("begin", "end", "impulse", "before", "after", "restitution")


def follow_hits(impact: Impact, method: Method, count: int, *, first: ImpactHistory) -> list[Hit]:
    """The first ``count`` hits of a beam on its wall by one run, fewer where it does not come back.

    first : the run that a first hit has been read from: the first row is its own.
    Raises ``ValueError`` for what the method refuses, and between two walls.
    """
    if impact.opposite_wall is not None:
        raise ValueError("--hits: follows one wall; between two, bentbeam simulate lists the hits")
    chosen, period = for_whole_beam(method, impact), LOWEST_PERIOD * impact.slow_time_scale
    fall = impact.net_load / impact.mass_per_length  # acceleration back to the wall, m/s²
    end, longest = 2.0 * period, LONGEST * impact.slow_time_scale
    while True:
        save = round(INSTANTS * end / impact.slow_time_scale)
        found = hits(chosen.simulate(impact, end_time=end, save=save))
        over = [hit for hit in found if end - hit.end >= period]
        if len(over) >= count or end >= longest or (over and fall <= 0.0):
            return [*hits(first)[:1], *over[1:count]]
        flight = 2.0 * max(-over[-1].after, 0.0) / fall if over else end
        end = min(end + flight + 2.0 * period, longest)


def hits_table(rows: Sequence[Mapping[str, Any]], names: Sequence[str]) -> str:
    """Hits by their fields ``names``, a line each."""
    cells = [[row[name] if isinstance(row[name], str) else f"{row[name]:.5g}" for name in names] for row in rows]
    head = ["hit", *(TITLES[name] for name in names)]
    return text_table(head, [[str(number), *line] for number, line in enumerate(cells, 1)])
