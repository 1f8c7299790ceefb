"""Lines, panels and maps of the reaction that several items share."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from bent_beam.history import ImpactHistory
from bent_beam.measure.force_map import force_map
from bent_beam_programs.thesis.gallery.runs import Series
from bent_beam_programs.thesis.sheet import Sheet
from bent_beam_programs.thesis.studies import panels as studied
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.outcome import MEASURES, Outcome, scatter
from bent_beam_programs.thesis.studies.panels import Panel, banded, filtered, unit
from bent_beam_programs.thesis.studies.thesis import MASSES
from comparison.figures import style
from theory import ImpactFields

NUMBERS: dict[Panel, tuple[str, ...]] = {  # measures that go with a panel
    studied.geometry: ("lift",),
    studied.contact_length: ("contact_length_error",),
    filtered: ("reaction_error",),
    banded: ("reaction_error",),
    studied.energy: ("lost_impact", "lost_damping"),
}
TIMES, PLACES = 60, 80
DECADES = 4.0  # of the colour scale: below is noise of no consequence, pale


def plain_line(colour: str, dashes: str = "-", width: float = 1.0, **drawn: Any) -> dict[str, Any]:
    return {"color": style.COLOURS[colour], "lw": width, "ls": dashes, **drawn}


NIL, GUIDE = plain_line("grey", width=0.5), plain_line("grey", ":", 0.6)
"""Thin lines across an axis: where a quantity is nil, and at a place."""


def beam_at_times(
    sheet: Sheet, axis: Axes, history: ImpactHistory, times: Iterable[float], edge: float, name: Callable[[float], str]
) -> None:
    """Deflections (mm) up to x = ``edge`` (m) at the saved instants nearest to some times; ``name`` : of an instant."""
    x, gap = history.positions(-1), history.array("gap")
    axis.set(xlabel="$x$  (m)", ylabel="deflection $y$  (mm)", xlim=(0, edge))
    for t, colour in zip(times, style.SEQUENCE):
        k, near = int(np.abs(history.time - t).argmin()), x <= edge
        sheet.line(axis, x[near], -1e3 * gap[k][near], series=name(float(history.time[k])), color=colour, lw=0.9)


def numbers_of(sheet: Sheet, outcomes: Sequence[Outcome], *names: str) -> None:
    """Measures of each run beside the figure."""
    for name in names:
        sheet.numbers |= {f"{MEASURES[name]}, {o.label}": o.measures.get(name) for o in outcomes}


def run_figure(sheet: Sheet, series: Series, panels: Sequence[Panel]) -> None:
    """Panels of the runs below one another, a column a mass; one legend, and the runs' numbers beside them."""
    rows = len(panels)
    height, texts = 2.3 * rows + 0.4, [f"{mass} mass" for mass in MASSES] * rows
    with sheet.figure(rows, 2, height=height, sharex="row", texts=texts, legend=4, legend_size=7.0) as (_, axes):
        grid = np.reshape(axes, (rows, 2))
        for i, (column, mass) in enumerate(zip(grid.T, MASSES)):
            outcomes = series.outcomes(mass)
            for axis, panel in zip(column, panels):
                panel(sheet, axis, outcomes)
                numbers_of(sheet, named(outcomes, mass, only_own=i > 0), *NUMBERS.get(panel, ()))
            if {filtered, banded} & {*panels}:
                scatters_of(sheet, named(outcomes, mass, only_own=True))
        for left, right in grid:
            (low, high), (one, other) = left.get_ylim(), right.get_ylim()
            if left.get_ylabel() == right.get_ylabel() and low < high:  # one unit, and no wall below
                for axis in (left, right):
                    axis.set_ylim(min(low, one), max(high, other))


def filtered_scatter(outcome: Outcome) -> float | None:
    s = outcome.steps
    return None if s is None else scatter(s.time, s.filtered(), outcome.exact.side_reaction(s.time))


def scatters_of(sheet: Sheet, outcomes: Sequence[Outcome]) -> None:
    sheet.numbers |= {f"filtered reaction, scatter about theory, {o.label}": filtered_scatter(o) for o in outcomes}


def named(outcomes: Sequence[Outcome], mass: str, only_own: bool) -> list[Outcome]:
    """Outcomes of the thesis's settings with the mass in their labels; references as they are, if at all."""
    own = [replace(o, label=f"{o.label}, {mass}") for o in outcomes if o.mark is None]
    return own if only_own else own + [o for o in outcomes if o.mark is not None]


LEGEND = (
    "contact at element middles, lumped (r = 1/105) and consistent mass (3.1.8); the thesis's other settings (lines), "
    "Hermite (circles; for κ/ν < 1/200 half as fine) and Self-similar (diamonds) with their own choices, theory (black)"
)
FILTER = "every step, filtered as in 3.3.1 (above), and the impulse less theory's, unfiltered (below)"
REACTION: tuple[Panel, ...] = (filtered, studied.impulse_off)
NOISY: tuple[Panel, ...] = (banded, studied.impulse_off)
BAND = (
    "means in windows; the band holds eight tenths of the reaction of every step, filtered as in 3.3.1 (above), and "
    "the impulse less theory's, unfiltered (below)"
)


def beam_panel(
    sheet: Sheet, axis: Axes, fields: ImpactFields, tau: float, limits: tuple[float, float], zoom: float | None = None
) -> None:
    """Free motion, fast layer and beam over ξ at one time; contact points marked on the wall. ``zoom`` : half width of
    a picture without the fast layer."""
    reach, front = zoom or 1.5, float(fields.half_contact_length(tau))
    half = np.unique(np.concatenate([np.linspace(0.0, reach, 121), [front]]))
    xi = np.concatenate([-half[:0:-1], half])
    free, layer = fields.slow_motion(xi, tau).deflection, fields.fast_layer(xi, tau).deflection
    axis.set(xlabel=r"$\xi$  (1)", ylabel=r"deflection $w$  (1)", xlim=(-reach, reach))
    sheet.line(axis, xi, free, series="free motion", **plain_line("grey", "--"))
    if zoom is None:
        sheet.line(axis, xi, layer, series=r"fast layer $\eta$", **plain_line("sky", "-."))
    sheet.line(axis, xi, free - layer, series="beam", **style.THEORY)
    mark = plain_line("vermilion", "", marker="v", ms=5, clip_on=False)
    sheet.line(axis, np.unique([-front, front]), 0.0, series="contact points", **mark)
    style.wall_below(axis, *limits)


class CellForces(NamedTuple):
    """Reaction per cell: places and times are edges, m and s; force (times, places), N, of one side of the beam."""

    places: np.ndarray
    times: np.ndarray
    force: np.ndarray


def cell_forces(history: ImpactHistory) -> CellForces:
    """Mean over cells even in √t (between the saved instants next to them), sum over cells of place."""
    exact, impact, end = Exact(history.impact), history.impact, float(history.time[-1])
    edge = studied.REACH * float(exact.front(np.linspace(0.0, end, 200)).max())
    wanted, places = end * np.linspace(0.0, 1.0, TIMES + 1) ** 2, np.linspace(0.0, edge, PLACES // 2 + 1)
    kept = np.unique(np.searchsorted(history.time, wanted).clip(0, history.time.size - 1))
    force = force_map(history, kept, places / impact.length_scale)
    per_length = impact.mass_per_length * impact.velocity / impact.time_scale
    return CellForces(places, history.time[kept], force * per_length * np.diff(places))


def draw_maps(sheet: Sheet, histories: Mapping[str, ImpactHistory], rows: int, height: float) -> list[CellForces]:
    """A map of each history, two in a row, its name beside the letter; returns their cells. Reaction (N) of both sides
    over x and √t (so that the front is a straight line), mirrored about x = 0. The CSV has, for each cell of time,
    place and reaction of the cells that carry any."""
    cells = [cell_forces(history) for history in histories.values()]
    largest = max(float(c.force.max()) for c in cells)
    norm, line = LogNorm(largest / 10.0**DECADES, largest), plain_line("vermilion", width=0.6)
    colours = colormaps["YlGnBu"].with_extremes(under="#F4F4EC")
    with sheet.figure(rows, 2, height=height, texts=list(histories)) as (fig, axes):
        for axis, history, found in zip(axes.flat, histories.values(), cells):
            exact, end = Exact(history.impact), float(history.time[-1])
            places, times, force = found
            st, mt = unit(end, "s")
            whole = np.concatenate([-places[:0:-1], places])
            pushing = np.ma.masked_less_equal(np.hstack([force[:, ::-1], force]), 0.0)
            drawn = axis.pcolormesh(whole, st * times, pushing, norm=norm, cmap=colours, rasterized=True)
            middle = 0.5 * (places[1:] + places[:-1])
            for row, at in zip(force, st * 0.5 * (times[1:] + times[:-1])):
                carried = row > 0.0
                sheet.record(axis, middle[carried], row[carried], f"t = {at:.4g} {mt}", "reaction (N)")
            t = min(end, exact.end_of_contact) * np.linspace(0.0, 1.0, 200) ** 2
            for side in (-1.0, 1.0):
                sheet.line(axis, side * exact.front(t), st * t, series=f"theory, side {side:+.0f}", **line)
            axis.set_yscale("function", functions=studied.ROOT)
            axis.grid(False)
            axis.set(xlabel="$x$  (m)", ylabel=f"$t$  ({mt})", xlim=(-places[-1], places[-1]), ylim=(0.0, st * end))
        fig.colorbar(drawn, ax=axes, label="reaction of a cell  (N)", pad=0.02, extend="min", aspect=30)
    return cells
