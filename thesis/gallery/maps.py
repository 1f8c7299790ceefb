"""Reaction over space and time, with one scale for all maps of a figure."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm

from bent_beam.history import ImpactHistory
from comparison.figures import style
from comparison.figures.force_map import force_map
from thesis.gallery.drawing import plain_line
from thesis.sheet import Sheet
from thesis.studies.exact import Exact
from thesis.studies.panels import ROOT, unit

TIMES, PLACES = 60, 80
DECADES = 4.0  # of the colour scale: below is noise of no consequence, pale
REACH = 1.25  # contact lengths shown


@dataclass(frozen=True)
class CellForces:
    """Reaction per cell: places and times are edges, m and s; force (times, places), N, of one side of the beam."""

    places: np.ndarray
    times: np.ndarray
    force: np.ndarray


def cell_forces(history: ImpactHistory) -> CellForces:
    """Mean over cells even in √t (between the saved instants next to them), sum over cells of place."""
    exact, impact, end = Exact(history.impact), history.impact, float(history.time[-1])
    edge = REACH * float(exact.front(np.linspace(0.0, end, 200)).max())
    wanted, places = end * np.linspace(0.0, 1.0, TIMES + 1) ** 2, np.linspace(0.0, edge, PLACES // 2 + 1)
    kept = np.unique(np.searchsorted(history.time, wanted).clip(0, history.time.size - 1))
    force = force_map(history, kept, places / impact.length_scale)
    per_length = impact.mass_per_length * impact.velocity / impact.time_scale
    return CellForces(places, history.time[kept], force * per_length * np.diff(places))


def draw_maps(sheet: Sheet, histories: Mapping[str, ImpactHistory], rows: int, height: float) -> list[CellForces]:
    """A map of each history, two in a row, its name beside the letter; returns their cells."""
    cells = [cell_forces(history) for history in histories.values()]
    largest = max(float(c.force.max()) for c in cells)
    norm = LogNorm(largest / 10.0**DECADES, largest)
    with sheet.figure(rows, 2, width=style.PAGE, height=height, sharex=rows > 1, sharey=True) as (fig, axes):
        for axis, history, found in zip(axes.flat, histories.values(), cells):
            drawn = one_map(sheet, axis, history, found, norm)
            if rows > 1:
                axis.label_outer()
        sheet.letter(axes, list(histories))
        fig.colorbar(drawn, ax=axes, label="reaction of a cell  (N)", pad=0.02, extend="min", aspect=30)
    return cells


def one_map(sheet: Sheet, axis: Axes, history: ImpactHistory, cells: CellForces, norm: LogNorm) -> QuadMesh:
    """Reaction (N) of both sides over x and √t (so that the front is a straight line), mirrored about x = 0.

    The CSV holds, for each cell of time, place and reaction of the cells that carry any.
    """
    exact, end = Exact(history.impact), float(history.time[-1])
    places, times, force = cells.places, cells.times, cells.force
    st, mt = unit(end, "s")
    whole = np.concatenate([-places[:0:-1], places])
    pushing = np.ma.masked_less_equal(np.hstack([force[:, ::-1], force]), 0.0)
    colours = colormaps["YlGnBu"].with_extremes(under="#F4F4EC")
    drawn = axis.pcolormesh(whole, st * times, pushing, norm=norm, cmap=colours, rasterized=True)
    axis.set(xlabel="$x$  (m)", ylabel=f"$t$  ({mt})")
    middle = 0.5 * (places[1:] + places[:-1])
    for row, at in zip(force, st * 0.5 * (times[1:] + times[:-1])):
        carried = row > 0.0
        sheet.record(axis, middle[carried], row[carried], f"t = {at:.4g} {mt}", "reaction (N)")
    t = end * np.linspace(0.0, 1.0, 200) ** 2
    for side in (-1.0, 1.0):
        line = plain_line("vermilion", width=0.6)
        sheet.line(axis, side * exact.front(t), st * t, series=f"theory, side {side:+.0f}", **line)
    axis.set_yscale("function", functions=ROOT)
    axis.grid(False)
    axis.set(xlim=(-places[-1], places[-1]), ylim=(0.0, st * end))
    return drawn
