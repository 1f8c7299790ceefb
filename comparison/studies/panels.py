"""Panels that hold several runs of one impact against theory: geometry, contact length, reaction, energy.

Varied settings are thin coloured lines, references the markers of their path, theory is the black line. The wall is
below.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.studies.outcome import Outcome

__all__ = [
    "contact_length",
    "draw_outcomes",
    "energy",
    "geometry",
    "impulse",
    "line_styles",
    "reaction",
    "strain",
    "theory_first",
    "unit",
]

Array = NDArray[np.float64]
PREFIX = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M"}
MARKS = 18  # markers on the curve of a reference
LINES = [style.COLOURS[c] for c in ("vermilion", "sky", "purple", "orange", "grey", "green", "blue")]
"""Colours of varied settings, those of the references last."""


def unit(largest: float, name: str) -> tuple[float, str]:
    """(factor, "mm") such that values up to ``largest`` read as 1 … 1000."""
    power = 3 * math.floor(math.log10(largest) / 3 + 1e-9) if largest > 0.0 else 0
    power = min(max(power, -12), 6)
    return 10.0**-power, PREFIX[power] + name


def line_styles(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    """A style each: colours in turn for the varied settings, the path's marker for references.

    Lines get thinner one after the other, so that those that coincide can all be seen.
    """
    found: list[dict[str, Any]] = []
    drawn = 0
    lines = max(1, sum(not o.reference for o in outcomes) - 1)
    for o in outcomes:
        if o.mark is not None:
            style_of_path = style.mark(o.mark)
            if sum(p.mark == o.mark for p in outcomes) > 1:  # several of one path: told apart by colour
                place = sum(p.mark == o.mark for p in outcomes[: len(found)])
                style_of_path.update(color=style.SEQUENCE[place % len(style.SEQUENCE)], ls="-", lw=0.6)
            found.append(style_of_path)
        else:
            dashes = ("-", "--", ":")[drawn // len(style.SEQUENCE) % 3]
            found.append(
                {
                    "color": LINES[drawn % len(LINES)],
                    "ls": dashes,
                    "marker": "",
                    "lw": 2.2 - 1.5 * drawn / lines if lines > 1 else 1.6 - 0.8 * drawn,
                }
            )
            drawn += 1
    return found


def _finished(outcomes: Sequence[Outcome]) -> list[tuple[Outcome, dict[str, Any]]]:
    return [(o, line) for o, line in zip(outcomes, line_styles(outcomes)) if o.failure is None and o.time.size]


def _curves(sheet: Sheet, axis: Axes, curves: Sequence[tuple[str, Array, Array, dict[str, Any]]], legend: bool) -> None:
    for label, x, y, line in curves:
        sheet.line(axis, x, y, series=label, legend=legend, **line)


def _evenly(x: Array, shift: float = 0.0, count: int = MARKS) -> NDArray[np.int64]:
    """Indices of points about evenly spread over x; ``shift`` (of a spacing) keeps the marks of two runs apart."""
    spacing = (x[-1] - x[0]) / count
    return np.unique(np.searchsorted(x, x[0] + spacing * (np.arange(count) + 0.25 + shift)).clip(0, x.size - 1))


def _shift(line: dict[str, Any]) -> float:
    return 0.5 if line["marker"] == style.SELF_SIMILAR["marker"] else 0.0


def geometry(
    sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome], *, legend: bool = True, reach: float = 1.25
) -> None:
    """Deflection y = −gap over x at the end of the run; the wall is the grey half plane below."""
    runs = _finished(outcomes)
    exact, end = runs[0][0].exact, float(runs[0][0].time[-1])
    edge = reach * max(float(exact.front(end)), 0.25 * exact.impact.length_scale * math.sqrt(exact.tau(end)))
    gaps = np.concatenate([o.gap[o.x <= edge / reach] for o, _ in runs])
    shown = 1.1 * float(exact.gap(np.array([edge]), end)[0])  # more would be empty
    high = max(1.4 * float(gaps.max()), min(shown, 0.01 * float(exact.impact.velocity * end)))
    deep = max(0.25 * high, -1.3 * float(gaps.min()))
    sx, mx = unit(edge, "m")
    sy, my = unit(high, "m")
    axis.set_xlabel(f"$x$  ({mx})")
    axis.set_ylabel(f"deflection $y$  ({my})")
    places = np.linspace(0.0, edge, 400)
    _theory(sheet, axis, sx * places, -sy * exact.gap(places, end), legend)
    curves = []
    for o, line in runs:
        near = o.x <= edge
        x, y = o.x[near], -o.gap[near]
        if line.get("marker"):
            kept = _evenly(x, _shift(line))
            x, y = x[kept], y[kept]
        curves.append((o.label, sx * x, sy * y, line))
    _curves(sheet, axis, curves, legend)
    axis.set_xlim(0.0, sx * edge)
    style.wall_below(axis, -sy * high, sy * deep)


def contact_length(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome], *, legend: bool = True) -> None:
    """λ_c over t."""
    runs = _finished(outcomes)
    exact, end = runs[0][0].exact, float(runs[0][0].time[-1])
    times = end * np.linspace(0.0, 1.0, 300) ** 2
    front = exact.front(times)
    st, mt = unit(end, "s")
    sx, mx = unit(max(float(front.max()), *(float(o.front.max()) for o, _ in runs), 1e-12), "m")
    axis.set_xlabel(f"$t$  ({mt})")
    axis.set_ylabel(rf"$\lambda_c$  ({mx})")
    _theory(sheet, axis, st * times, sx * front, legend)
    curves = []
    for o, line in runs:
        touching = (
            (o.front > 0.0) | (o.time == o.time[0]) | (not line.get("marker"))
        )  # nothing to mark once it has left
        curves.append((o.label, *_thin(st * o.time[touching], sx * o.front[touching], line), line))
    _curves(sheet, axis, curves, legend)
    axis.set_xlim(0.0, st * end)
    axis.set_ylim(bottom=0.0)


def reaction(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome], *, legend: bool = True, windows: int = 30) -> None:
    """Reaction of one side over t, averaged over ``windows`` even in √t."""
    runs = _finished(outcomes)
    exact, end = runs[0][0].exact, float(runs[0][0].time[-1])
    times = end * np.linspace(0.0, 1.0, 201)[1:] ** 2
    top = 1.2 * float(exact.side_reaction(0.02 * end))
    st, mt = unit(end, "s")
    sf, mf = unit(top, "N")
    axis.set_xlabel(f"$t$  ({mt})")
    axis.set_ylabel(f"reaction of one side  ({mf})")
    for o, line in runs:
        t, f = o.reaction(MARKS if line.get("marker") else windows)
        sheet.line(axis, st * t, sf * f, series=o.label, legend=legend, **line)
    _theory(sheet, axis, st * times, sf * exact.side_reaction(times), legend)
    axis.set_xlim(0.0, st * end)
    axis.set_ylim(0.0, sf * top)


def impulse(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome], *, legend: bool = True) -> None:
    """Impulse of one side, ∫R dt, over t on an axis of √t: a straight line where R ∝ 1/√t, with the slope 2R√t. Nothing
    is averaged.
    """
    runs = _finished(outcomes)
    exact, end = runs[0][0].exact, float(runs[0][0].time[-1])
    st, mt = unit(end, "s")
    times = end * np.linspace(0.0, 1.0, 200) ** 2
    values = 0.5 * exact.impulse(times)
    si, mi = unit(float(values.max()), "N s")
    axis.set_xlabel(f"$t$  ({mt}), scaled as $\\sqrt{{t}}$")
    axis.set_ylabel(f"impulse of one side  ({mi})")
    for o, line in runs:
        t, y = o.time - min(float(o.time[0]), 0.0), o.side_impulse
        if line.get("marker"):
            kept = _evenly(np.sqrt(t), _shift(line))
            t, y = t[kept], y[kept]
        sheet.line(axis, st * t, si * y, series=o.label, legend=legend, **line)
    _theory(sheet, axis, st * times, si * values, legend)
    axis.set_xscale("function", functions=(lambda v: np.sqrt(np.maximum(v, 0.0)), np.square))
    axis.set_xlim(0.0, st * end)
    axis.set_ylim(bottom=0.0)


def energy(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome], *, legend: bool = True) -> None:
    """Energy of the whole beam over its value at the first contact: exactly conserved by the theory."""
    runs = _finished(outcomes)
    end = float(runs[0][0].time[-1])
    low = max(float(np.abs(o.energy).max()) for o, _ in runs)
    st, mt = unit(end, "s")
    se, me = unit(low, "J")
    axis.set_xlabel(f"$t$  ({mt})")
    axis.set_ylabel(rf"$E - E(0)$  ({me})")
    _theory(sheet, axis, st * np.array([0.0, end]), np.zeros(2), legend)
    _curves(sheet, axis, [(o.label, *_thin(st * o.time, se * o.energy, line), line) for o, line in runs], legend)
    axis.set_xlim(0.0, st * end)


def strain(sheet: Sheet, axis: Axes, outcomes: Sequence[Outcome], *, legend: bool = True, theory: bool = True) -> None:
    """Strain energy of the whole beam over t; ``theory`` = False leaves its line out where it is far above."""
    runs = [(o, line) for o, line in _finished(outcomes)]
    exact, end = runs[0][0].exact, float(runs[0][0].time[-1])
    times = end * np.linspace(0.0, 1.0, 200) ** 2
    values = exact.strain_energy(times)
    st, mt = unit(end, "s")
    largest = float(values.max()) if theory else max(float(o.strain.max()) for o, _ in runs)
    se, me = unit(largest, "J")
    axis.set_xlabel(f"$t$  ({mt})")
    axis.set_ylabel(f"strain energy  ({me})")
    if theory:
        _theory(sheet, axis, st * times, se * values, legend)
    _curves(sheet, axis, [(o.label, *_thin(st * o.time, se * o.strain, line), line) for o, line in runs], legend)
    axis.set_xlim(0.0, st * end)
    axis.set_ylim(bottom=0.0)


def _thin(t: Array, values: Array, line: dict[str, Any]) -> tuple[Array, Array]:
    """All of a line, some twenty points of a marker."""
    if not line.get("marker"):
        return t, values
    kept = _evenly(t, _shift(line))
    return t[kept], values[kept]


def _theory(sheet: Sheet, axis: Axes, x: Array, y: Array, legend: bool) -> None:
    sheet.line(axis, x, y, series="theory", legend=legend, **{k: v for k, v in style.THEORY.items() if k != "label"})


def theory_first(axis: Axes) -> tuple[list[Any], list[str]]:
    """Handles and labels of a legend, theory's first."""
    pairs = sorted(zip(*axis.get_legend_handles_labels()), key=lambda pair: not pair[1].startswith("theory"))
    return [p[0] for p in pairs], [p[1] for p in pairs]


def draw_outcomes(sheet: Sheet, outcomes: Sequence[Outcome]) -> None:
    """The picture of a study: geometry, contact length, reaction, energy; one legend."""
    usable = [o for o in outcomes if o.failure is None]
    if not usable:
        return
    drawn = [geometry, contact_length, reaction, *([energy] if usable[0].exact.leading else [])]
    rows = 2 if len(drawn) == 4 else 1
    with sheet.figure(rows, len(drawn) // rows, width=style.PAGE, height=2.5 * rows + 0.3) as (fig, axes):
        for axis, draw, letter in zip(axes.flat, drawn, "abcd"):
            draw(sheet, axis, usable)
            sheet.panel(axis, letter)
        handles, labels = theory_first(axes.flat[0])
        fig.legend(handles, labels, loc="outside upper center", ncols=min(3, len(labels)), fontsize=7.0)
