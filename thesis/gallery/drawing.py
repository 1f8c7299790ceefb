"""Lines and panels that several items share."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam.history import ImpactHistory
from comparison.figures import style
from theory import ImpactFields
from thesis.sheet import Sheet
from thesis.studies.outcome import MEASURES, Outcome
from thesis.studies.panels import THEORY, Panel, contact_length, energy, geometry, impulse, legend_below, reaction

NUMBERS: dict[Panel, tuple[str, ...]] = {
    geometry: ("lift",),
    contact_length: ("contact_length_error",),
    reaction: ("reaction_error", "noise"),
    energy: ("lost_impact", "lost_damping"),
}
"""Measures that go with a panel."""


def plain_line(colour: str, dashes: str = "-", width: float = 1.0, **drawn: Any) -> dict[str, Any]:
    """A line in a named colour."""
    return {"color": style.COLOURS[colour], "lw": width, "ls": dashes, **drawn}


FREE, FAST = plain_line("grey", "--"), plain_line("sky", "-.")


def guide(axis: Axes, *, x: float | None = None, y: float | None = None) -> None:
    """A thin grey line across an axis."""
    if x is not None:
        axis.axvline(x, color=style.COLOURS["grey"], lw=0.6, ls=":")
    if y is not None:
        axis.axhline(y, color=style.COLOURS["grey"], lw=0.5)


def nearest(times: np.ndarray, wanted: float) -> int:
    """Index of the saved instant nearest to a time."""
    return int(np.argmin(np.abs(times - wanted)))


def beam_at_times(
    sheet: Sheet, axis: Axes, history: ImpactHistory, times: Iterable[float], edge: float, name: Callable[[float], str]
) -> None:
    """Deflections (mm) up to x = ``edge`` (m) at the saved instants nearest to some times; ``name`` : of an instant."""
    x, gap = history.positions(-1), history.array("gap")
    axis.set(xlabel="$x$  (m)", ylabel="deflection $y$  (mm)", xlim=(0, edge))
    for t, colour in zip(times, style.SEQUENCE):
        k, near = nearest(history.time, t), x <= edge
        label = name(float(history.time[k]))
        sheet.line(axis, x[near], -1e3 * gap[k][near], series=label, color=colour, lw=0.9)


def numbers_of(sheet: Sheet, outcomes: Sequence[Outcome], *names: str) -> None:
    """Measures of each run beside the figure."""
    for name in names:
        sheet.numbers |= {f"{MEASURES[name]}, {o.label}": o.measures.get(name) for o in outcomes}


def run_figure(sheet: Sheet, runs: Callable[[], Sequence[Outcome]], panels: Sequence[Panel], columns: int = 0) -> None:
    """Panels of the runs in a row, one legend below and the runs' numbers beside them.

    columns : of the legend, two a panel if not given.
    """
    outcomes = runs()
    width = 4.6 if len(panels) == 1 else style.PAGE
    with sheet.figure(1, len(panels), width=width, height=3.0) as (fig, axes):
        for axis, panel in zip(np.ravel(axes), panels):
            panel(sheet, axis, outcomes)
            numbers_of(sheet, outcomes, *NUMBERS.get(panel, ()))
        legend_below(fig, np.ravel(axes)[-1], columns or 2 * len(panels), fontsize=7.0)


REACTION = (reaction, impulse)
"""The reaction, averaged, as the thesis shows it, and its impulse, on which 1/√t is a straight line."""


def beam_panel(
    sheet: Sheet,
    axis: Axes,
    fields: ImpactFields,
    tau: float,
    limits: tuple[float, float],
    *,
    reach: float = 1.5,
    fast: bool = True,
) -> None:
    """Free motion, fast layer and beam over ξ at one time; contact points marked on the wall."""
    front = float(fields.half_contact_length(tau))
    xi = np.unique(np.concatenate([np.linspace(-reach, reach, 241), [-front, front]]))
    free, layer = fields.slow_motion(xi, tau).deflection, fields.fast_layer(xi, tau).deflection
    axis.set(xlabel=r"$\xi$  (1)", ylabel=r"deflection $w$  (1)", xlim=(-reach, reach))
    sheet.line(axis, xi, free, series="free motion", **FREE)
    if fast:
        sheet.line(axis, xi, layer, series=r"fast layer $\eta$", **FAST)
    sheet.line(axis, xi, free - layer, series="beam", **THEORY)
    mark = plain_line("vermilion", "", marker="v", ms=5, clip_on=False)
    sheet.line(axis, np.unique([-front, front]), 0.0, series="contact points", **mark)
    style.wall_below(axis, *limits)
