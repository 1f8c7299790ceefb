"""Lines and panels that several items share."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam.history import ImpactHistory
from comparison.figures import style
from theory import ImpactFields
from thesis.gallery.base import ITEMS, Item
from thesis.gallery.runs import Series
from thesis.sheet import Sheet
from thesis.studies.outcome import MEASURES, Outcome
from thesis.studies.panels import THEORY, Panel, contact_length, energy, filtered, geometry, impulse_off, legend_below
from thesis.studies.steps import scatter
from thesis.studies.thesis import MASSES

RunFigure = tuple[str, str, Sequence[Panel], Callable[[], Series], str]
"""Id, title, panels, runs and caption of a figure of runs."""

NUMBERS: dict[Panel, tuple[str, ...]] = {
    geometry: ("lift",),
    contact_length: ("contact_length_error",),
    filtered: ("reaction_error",),
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


def run_figure(sheet: Sheet, series: Series, panels: Sequence[Panel]) -> None:
    """Panels of the runs below one another, a column a mass; one legend, and the runs' numbers beside them."""
    rows, reference = len(panels), False
    with sheet.figure(rows, 2, width=style.PAGE, height=2.3 * rows + 0.4, sharex="row") as (fig, axes):
        grid = np.reshape(axes, (rows, 2))
        for column, mass in zip(grid.T, MASSES):
            outcomes = series.outcomes(mass)
            for axis, panel in zip(column, panels):
                panel(sheet, axis, outcomes)
            for panel in panels:
                numbers_of(sheet, named(outcomes, mass, reference), *NUMBERS.get(panel, ()))
            for o in outcomes:
                if o.steps is not None and filtered in panels:
                    sheet.numbers[f"filtered reaction, scatter about theory, {o.label}, {mass}"] = filtered_scatter(o)
            reference = True
        for left, right in grid:
            (low, high), (one, other) = left.get_ylim(), right.get_ylim()
            if left.get_ylabel() == right.get_ylabel() and low < high:  # one unit, and no wall below
                for axis in (left, right):
                    axis.set_ylim(min(low, one), max(high, other))
                right.set_ylabel("")
        sheet.letter(grid, [f"{mass} mass" for mass in MASSES] * rows)
        legend_below(fig, grid[0, 0], 4, fontsize=7.0)


def filtered_scatter(outcome: Outcome) -> float | None:
    """Of the filtered reaction about theory."""
    s = outcome.steps
    return None if s is None else scatter(s.time, s.filtered(), outcome.exact.side_reaction(s.time))


def run_items(module: str, figures: Iterable[RunFigure]) -> None:
    """Register figures of runs under their numbers."""
    for name, title, panels, series, caption in figures:
        draw = functools.partial(_late_figure, series=series, panels=panels)
        ITEMS[name] = Item(name, title, caption, module, draw)


def _late_figure(sheet: Sheet, series: Callable[[], Series], panels: Sequence[Panel]) -> None:
    run_figure(sheet, series(), panels)


def named(outcomes: Sequence[Outcome], mass: str, only_own: bool) -> list[Outcome]:
    """Outcomes of the thesis's settings with the mass in their labels; references as they are, if at all."""
    own = [replace(o, label=f"{o.label}, {mass}") for o in outcomes if o.mark is None]
    return own if only_own else own + [o for o in outcomes if o.mark is not None]


LEGEND = (
    "contact at element middles, lumped (r = 1/105) and consistent mass (3.1.8); the thesis's other settings (lines), "
    "Hermite (circles; for κ/ν < 1/200 half as fine) and Self-similar (diamonds) with their own choices, theory (black)"
)
FILTER = "every step, filtered as in 3.3.1 (above), and the impulse less theory's, unfiltered (below)"
REACTION: tuple[Panel, ...] = (filtered, impulse_off)


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
    half = np.unique(np.concatenate([np.linspace(0.0, reach, 121), [front]]))
    xi = np.concatenate([-half[:0:-1], half])
    free, layer = (
        np.concatenate([y[:0:-1], y])
        for y in (fields.slow_motion(half, tau).deflection, fields.fast_layer(half, tau).deflection)
    )
    axis.set(xlabel=r"$\xi$  (1)", ylabel=r"deflection $w$  (1)", xlim=(-reach, reach))
    sheet.line(axis, xi, free, series="free motion", **FREE)
    if fast:
        sheet.line(axis, xi, layer, series=r"fast layer $\eta$", **FAST)
    sheet.line(axis, xi, free - layer, series="beam", **THEORY)
    mark = plain_line("vermilion", "", marker="v", ms=5, clip_on=False)
    sheet.line(axis, np.unique([-front, front]), 0.0, series="contact points", **mark)
    style.wall_below(axis, *limits)
