"""Panels that compare runs of one impact with theory: geometry, contact length, reaction, energies, differences.

Varied settings are thin coloured lines, references the markers of their path, theory is black. The wall is below.
"""

import math
from collections.abc import Callable, Sequence
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam_programs.thesis.sheet import Sheet, legend_below
from bent_beam_programs.thesis.studies.exact import Array, Exact
from bent_beam_programs.thesis.studies.outcome import Outcome
from comparison.figures import style

Panel = Callable[[Sheet, Axes, Sequence[Outcome]], None]
PREFIX = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M"}
REACH = 1.25  # contact lengths shown
MARKS = 18  # markers on the curve of a reference
ALIKE = 0.9  # of the longest run's end: a run that ends from then on, on steps of its own, ends with it
WINDOWS = 30  # means of a reaction
TENTHS = (0.1, 0.9)  # of the filtered reaction, between which a band lies
LINES = [style.COLOURS[c] for c in ("vermilion", "sky", "purple", "orange", "grey", "green", "blue")]
"""Colours of varied settings, those of the references last."""
ROOT = (lambda v: np.sqrt(np.maximum(v, 0.0)), np.square)


def unit(largest: float, name: str) -> tuple[float, str]:
    """(factor, "mm") such that values up to ``largest`` read as 1 … 1000."""
    power = 3 * math.floor(math.log10(largest) / 3 + 1e-9) if largest > 0.0 else 0
    power = min(max(power, -12), 6)
    return 10.0**-power, PREFIX[power] + name


def _finished(outcomes: Sequence[Outcome]) -> list[tuple[Outcome, dict[str, Any]]]:
    """The finished ones with a style each: colours in turn for the varied settings, the path's marker for references.
    Lines get thinner one after the other, so that those that coincide can all be seen."""
    marks = [o.mark for o in outcomes]
    lines = max(1, marks.count(None) - 1)
    found: list[dict[str, Any]] = []
    for i, mark in enumerate(marks):
        before = marks[:i].count(mark)
        dashes = ("-", "--", ":")[before // len(LINES) % 3]
        if mark is None:
            width = 2.2 - 1.5 * before / lines if lines > 1 else 1.6 - 0.8 * before
            found.append({"color": LINES[before % len(LINES)], "ls": dashes, "marker": "", "lw": width})
        elif marks.count(mark) == 1:
            found.append(style.mark(mark))
        else:  # several of one path differ in colour
            colour = style.SEQUENCE[before % len(style.SEQUENCE)]
            found.append({**style.mark(mark), "color": colour, "ls": dashes, "lw": 0.6})
    return [(o, line) for o, line in zip(outcomes, found) if o.failure is None and o.time.size]


def _end(outcomes: Sequence[Outcome]) -> float:
    """When the longest run ends."""
    return max(float(o.time[-1]) for o, _ in _finished(outcomes))


def _thin(along: Array, line: dict[str, Any]) -> Any:
    """All points of a line; some twenty of a marker, about evenly spread ``along``, two paths' apart."""
    if not line["marker"] or along.size <= MARKS:
        return slice(None)
    shift = 0.75 if line["marker"] == style.SELF_SIMILAR["marker"] else 0.25
    wanted = along[0] + (along[-1] - along[0]) / MARKS * (np.arange(MARKS) + shift)
    return np.unique(np.searchsorted(along, wanted).clip(0, along.size - 1))


def geometry(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome]) -> None:
    """Deflection y = −gap over x at the end of the longest runs, others left out; the wall is the grey half plane."""
    finished, end = _finished(outcomes), _end(outcomes)
    runs = [(o, line) for o, line in finished if o.time[-1] > ALIKE * end]
    exact = runs[0][0].exact
    edge = REACH * max(float(exact.front(end)), 0.25 * exact.impact.length_scale * math.sqrt(exact.tau(end)))
    gaps = np.concatenate([o.gap[o.x <= edge / REACH] for o, _ in runs])
    shown = 1.1 * float(exact.gap(np.array([edge]), end)[0])  # more would be empty
    high = max(1.4 * float(gaps.max()), min(shown, 0.01 * float(exact.impact.velocity * end)))
    deep = max(0.25 * high, -1.3 * float(gaps.min()))
    (sx, mx), (sy, my), (st, mt) = unit(edge, "m"), unit(high, "m"), unit(end, "s")
    when = f" at {st * end:.3g} {mt}" if len(runs) < len(finished) else ""
    axis.set(xlabel=f"$x$  ({mx})", ylabel=f"deflection $y${when}  ({my})", xlim=(0.0, sx * edge))
    places = np.linspace(0.0, edge, 400)
    sheet.line(axis, sx * places, -sy * exact.gap(places, end), series="theory", **style.THEORY)
    for o, line in runs:
        near = o.x <= edge
        kept = _thin(o.x[near], line)
        sheet.line(axis, sx * o.x[near][kept], -sy * o.gap[near][kept], series=o.label, **line)
    style.wall_below(axis, -sy * high, sy * deep)


def _over_time(
    sheet: Sheet,
    axis: Axes,
    outcomes: Sequence[Outcome],
    *,
    label: str,
    name: str,
    curve: Callable[[Outcome, dict[str, Any]], tuple[Array, Array]],
    theory: Callable[[Exact, Array], Array] | None,
    largest: Callable[[Exact, float], float] | None = None,
    root: bool = False,
    bottom: float | None = 0.0,
    before: float = 0.0,
    thin: bool = False,
) -> None:
    """A quantity of every run over t, theory's on top.

    name : of the SI unit. curve : times and values of a run. largest : value that sets the unit and ends
    the axis, if not the largest of theory and runs. root : an axis of √t, along which marks are even. before : share of
    the run that is drawn before the first contact, in free flight. thin : where lines would hide one another.
    """
    runs = [(o, line, *curve(o, line)) for o, line in _finished(outcomes)]
    exact, end = runs[0][0].exact, _end(outcomes)
    times = end * np.linspace(0.0, 1.0, 301)[1:] ** 2
    values = np.zeros(0) if theory is None else theory(exact, times)
    every = (values, *(y for *_, y in runs))
    top = largest(exact, end) if largest else max(float(np.abs(y).max(initial=0.0)) for y in every)
    (st, mt), (sy, my) = unit(end, "s"), unit(max(top, 1e-12), name)
    axis.set(xlabel=f"$t$  ({mt})" + (", scaled as $\\sqrt{t}$" if root else ""), ylabel=f"{label}  ({my})")
    for o, line, t, y in runs:
        if before and not line["marker"]:
            t, y = np.concatenate([[-before * end, 0.0], t]), np.concatenate([y[:1], y[:1], y])
        kept = _thin(np.sqrt(t) if root else t, line)
        if thin and not line["marker"]:
            line = {**line, "lw": 0.6}
        sheet.line(axis, st * t[kept], sy * y[kept], series=o.label, **line)
    if theory is not None:
        sheet.line(axis, st * times, sy * values, series="theory", **style.THEORY)
    if root:
        axis.set_xscale("function", functions=ROOT)
    axis.set_xlim(-before * st * end, st * end)
    axis.set_ylim(bottom, sy * top if largest else None)


def _front(o: Outcome, line: dict[str, Any]) -> tuple[Array, Array]:
    """A reference that has left the wall has no contact length."""
    touching = (o.front > 0.0) | (o.time == o.time[0]) | (not line["marker"])
    return o.time[touching], o.front[touching]


contact_length: Panel = partial(_over_time, label=r"$\lambda_c$", name="m", curve=_front, theory=Exact.front)

reaction: Panel = partial(
    _over_time, label="reaction of one side", name="N", theory=Exact.side_reaction,
    curve=lambda o, line: o.reaction(MARKS if line["marker"] else WINDOWS),
    largest=lambda exact, end: 1.2 * float(exact.side_reaction(0.02 * end)),
)  # fmt: skip
"""Mean reaction of one side over t, in windows even in √t; peaks of the start are cut."""

energy: Panel = partial(
    _over_time, label=r"$E - E(0)$", name="J", theory=lambda exact, t: 0.0 * t, bottom=None, before=0.04,
    curve=lambda o, line: (o.time, o.energy),
)  # fmt: skip
"""Energy of the whole beam over its value at the first contact: exactly conserved by the theory."""

strain = partial(
    _over_time, label="strain energy", name="J", theory=Exact.strain_energy, before=0.04,
    curve=lambda o, line: (o.time, o.strain),
)  # fmt: skip
"""Strain energy of the whole beam over t; ``theory`` = None leaves its line out where it is far above."""

filtered: Panel = partial(
    _over_time, label="reaction of one side", name="N", theory=Exact.side_reaction, thin=True,
    curve=lambda o, line: (o.steps.time, o.steps.filtered()) if o.steps else o.reaction(MARKS),
    largest=lambda exact, end: 2.4 * float(exact.side_reaction(0.02 * end)),
)  # fmt: skip
"""Reaction of one side of every step, filtered as the thesis does; references in windows. Peaks are cut."""


def banded(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome]) -> None:
    """Where filtered reactions are so noisy that they would hide one another: means in windows, and a band that holds
    eight tenths of the filtered reaction."""
    reaction(sheet, axis, outcomes)
    runs, end = _finished(outcomes), _end(outcomes)
    (st, _), (sy, _) = unit(end, "s"), unit(1.2 * float(runs[0][0].exact.side_reaction(0.02 * end)), "N")
    for o, line in runs:
        if o.steps is None:
            continue
        found, edges = o.steps.filtered(), end * np.linspace(0.0, 1.0, WINDOWS + 1) ** 2
        cuts = np.searchsorted(o.steps.time, edges)
        low, high = np.array([np.quantile(found[i : max(j, i + 1)], TENTHS) for i, j in pairwise(cuts)]).T
        middle = 0.5 * (edges[1:] + edges[:-1])
        axis.fill_between(st * middle, sy * low, sy * high, color=line["color"], alpha=0.18, lw=0.0)
        for name, values in (("a tenth is below", low), ("a tenth is above", high)):
            sheet.record(axis, st * middle, sy * values, f"{o.label}, {name}")


_NOTHING: dict[str, Any] = {"theory": lambda exact, t: 0.0 * t, "bottom": None, "thin": True}

length_off: Panel = partial(
    _over_time, label=r"$\lambda_c$ $-$ theory", name="m", **_NOTHING,
    curve=lambda o, line: (_front(o, line)[0], _front(o, line)[1] - o.exact.front(_front(o, line)[0])),
)  # fmt: skip

impulse_off: Panel = partial(
    _over_time, label="impulse $-$ theory", name="N s", root=True, **_NOTHING,
    curve=lambda o, line: (o.time, o.side_impulse - o.side_impulse[0] - 0.5 * (
        o.exact.impulse(np.maximum(o.time, 0.0)) - o.exact.impulse(max(float(o.time[0]), 0.0)))),
)  # fmt: skip


def less(base: str, what: str, label: str, name: str) -> Panel:
    """A curve (a field of :class:`Outcome`) less that of the run ``base``; label, name : its symbol and unit."""

    def draw(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome]) -> None:
        (first,) = (o for o in outcomes if o.label == base)

        def curve(o: Outcome, line: dict[str, Any]) -> tuple[Array, Array]:
            return o.time, getattr(o, what) - np.interp(o.time, first.time, getattr(first, what))

        lines, title = [o for o in outcomes if o.mark is None], f"{label} $-$ that of {base}"
        _over_time(sheet, axis, lines, label=title, name=name, curve=curve, theory=None, bottom=None)

    return draw


def geometry_off(base: str) -> Panel:
    """Deflection at the end less that of the run labelled ``base``, inside the contact zone."""

    def draw(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome]) -> None:
        (first,) = (o for o in outcomes if o.label == base)
        edge = REACH * float(first.exact.front(float(first.time[-1])))
        runs = [(o, line, o.x <= edge) for o, line in _finished(outcomes) if o.mark is None]
        off = [np.interp(o.x[near], first.x, first.gap) - o.gap[near] for o, _, near in runs]
        largest = max(float(np.abs(y).max()) for y in off)
        (sx, mx), (sy, my) = unit(edge, "m"), unit(max(largest, 1e-12), "m")
        axis.set(xlabel=f"$x$  ({mx})", ylabel=f"$y$ $-$ that of {base}  ({my})", xlim=(0.0, sx * edge))
        for (o, line, near), y in zip(runs, off):
            sheet.line(axis, sx * o.x[near], sy * y, series=o.label, **line)

    return draw


def draw_outcomes(sheet: Sheet, outcomes: Sequence[Outcome]) -> None:
    """The picture of a study: geometry, contact length, reaction, energy; one legend."""
    usable = [o for o in outcomes if o.failure is None]
    if not usable:
        return
    drawn: list[Panel] = [geometry, contact_length, reaction, *([energy] if usable[0].exact.leading else [])]
    rows = 2 if len(drawn) == 4 else 1
    with sheet.figure(rows, len(drawn) // rows, height=2.5 * rows + 0.3) as (fig, axes):
        for axis, draw in zip(axes.flat, drawn):
            draw(sheet, axis, usable)
        legend_below(fig, axes, 3, loc="outside upper center", fontsize=7.0)
