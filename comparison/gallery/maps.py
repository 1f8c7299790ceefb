"""Reaction over space and time."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam.history import ImpactHistory
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.studies.exact import Exact
from comparison.studies.panels import unit

__all__ = ["reaction_map"]

TIMES, PLACES = 60, 80


def reaction_map(
    sheet: Sheet, axis: Axes, history: ImpactHistory, norm: Any, *, reach: float = 1.25, bar: bool = True
) -> None:
    """Reaction (N) of both sides over x and t: mean over cells of time, summed over cells of place, mirrored about x
    = 0.

    The CSV holds, for each cell of time, place and reaction of the cells that carry any.
    """
    exact, end = Exact(history.impact), float(history.time[-1])
    front = exact.front(np.linspace(0.0, end, 200))
    edge = reach * float(front.max())
    times, places = np.linspace(0.0, end, TIMES + 1), np.linspace(0.0, edge, PLACES // 2 + 1)
    x, impulse = np.abs(history.contact_positions(-1)), history.array("impulse")
    share = 0.5 if history.dataset.attrs["symmetry"] == "full" else 1.0
    cell = np.digitize(x, places) - 1
    force = np.zeros((TIMES, places.size - 1))
    for j in range(places.size - 1):
        gathered = share * impulse[:, cell == j].sum(axis=1)
        force[:, j] = np.diff(np.interp(times, history.time, gathered)) / np.diff(times)
    st, mt = unit(end, "s")
    axis.set_xlabel("$x$  (m)")
    axis.set_ylabel(f"$t$  ({mt})")
    whole = np.concatenate([-places[:0:-1], places])
    drawn = axis.pcolormesh(
        whole,
        st * times,
        np.ma.masked_less_equal(np.hstack([force[:, ::-1], force]), 0.0),
        norm=norm,
        cmap="YlGnBu",
        rasterized=True,
    )
    if bar:
        axis.figure.colorbar(drawn, ax=axis, label="reaction  (N)", pad=0.02)
    middle = 0.5 * (places[1:] + places[:-1])
    for k in range(TIMES):
        carried = force[k] > 0.0
        at = st * 0.5 * (times[k] + times[k + 1])
        sheet.record(axis, middle[carried], force[k][carried], f"t = {at:.4g} {mt}", "reaction (N)")
    t = np.linspace(0.0, end, 200)
    for side in (-1.0, 1.0):
        sheet.line(
            axis,
            side * exact.front(t),
            st * t,
            series=f"theory, side {side:+.0f}",
            color=style.COLOURS["vermilion"],
            lw=0.9,
            ls="-",
        )
    axis.grid(False)
    axis.set_xlim(-edge, edge)
    axis.set_ylim(0.0, st * end)
