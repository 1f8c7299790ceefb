"""Reaction over space and time, with one scale for all maps."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from bent_beam.history import ImpactHistory
from comparison.figures import style
from comparison.figures.force_map import force_map
from comparison.figures.recorder import Sheet
from comparison.studies.exact import Exact
from comparison.studies.panels import unit

__all__ = ["CellForces", "cell_forces", "colour_bar", "map_norm", "reaction_map"]

TIMES, PLACES = 60, 80
DECADES = 4.0  # of the colour scale: below is noise of no consequence, marked as such


class CellForces:
    """Reaction per cell: places and times are edges, m and s; force (times, places), N, of one side of the beam."""

    def __init__(self, places: np.ndarray, times: np.ndarray, force: np.ndarray) -> None:
        self.places, self.times, self.force = places, times, force


def cell_forces(history: ImpactHistory, *, reach: float = 1.25) -> CellForces:
    """Mean over cells even in √t (between the saved instants next to them), sum over cells of place."""
    exact, impact, end = Exact(history.impact), history.impact, float(history.time[-1])
    edge = reach * float(exact.front(np.linspace(0.0, end, 200)).max())
    wanted, places = end * np.linspace(0.0, 1.0, TIMES + 1) ** 2, np.linspace(0.0, edge, PLACES // 2 + 1)
    kept = np.unique(np.searchsorted(history.time, wanted).clip(0, history.time.size - 1))
    force = force_map(history, kept, places / impact.length_scale)
    per_length = impact.mass_per_length * impact.velocity / impact.time_scale
    return CellForces(places, history.time[kept], force * per_length * np.diff(places))


def map_norm(*maps: CellForces) -> LogNorm:
    """A scale that holds the largest cell of all maps and ``DECADES`` below it: nothing is clipped at the top, and
    cells
    below it are pale.
    """
    largest = max(float(m.force.max()) for m in maps)
    return LogNorm(largest / 10.0**DECADES, largest)


def colour_bar(figure: Figure, axes: Any, drawn: QuadMesh) -> None:
    """The one scale of all maps of a figure."""
    figure.colorbar(drawn, ax=axes, label="reaction of a cell  (N)", pad=0.02, extend="min", aspect=30)


def reaction_map(sheet: Sheet, axis: Axes, history: ImpactHistory, cells: CellForces, norm: LogNorm) -> QuadMesh:
    """Reaction (N) of both sides over x and √t (so that the front is a straight line), mirrored about x = 0.

    The CSV holds, for each cell of time, place and reaction of the cells that carry any.
    """
    exact, end = Exact(history.impact), float(history.time[-1])
    places, times, force = cells.places, cells.times, cells.force
    st, mt = unit(end, "s")
    axis.set_xlabel("$x$  (m)")
    axis.set_ylabel(f"$t$  ({mt})")
    whole = np.concatenate([-places[:0:-1], places])
    pushing = np.ma.masked_less_equal(np.hstack([force[:, ::-1], force]), 0.0)
    drawn = axis.pcolormesh(whole, st * times, pushing, norm=norm, cmap="YlGnBu", rasterized=True)
    drawn.cmap.set_under("#F4F4EC")
    middle = 0.5 * (places[1:] + places[:-1])
    for k in range(times.size - 1):
        carried = force[k] > 0.0
        at = st * 0.5 * (times[k] + times[k + 1])
        sheet.record(axis, middle[carried], force[k][carried], f"t = {at:.4g} {mt}", "reaction (N)")
    t = end * np.linspace(0.0, 1.0, 200) ** 2
    for side in (-1.0, 1.0):
        sheet.line(
            axis,
            side * exact.front(t),
            st * t,
            series=f"theory, side {side:+.0f}",
            color=style.COLOURS["vermilion"],
            lw=0.6,
            ls="-",
        )
    axis.set_yscale("function", functions=(lambda v: np.sqrt(np.maximum(v, 0.0)), np.square))
    axis.grid(False)
    axis.set_xlim(-places[-1], places[-1])
    axis.set_ylim(0.0, st * end)
    return drawn
