"""The report's interactive plots as plain plotly dictionaries: ``{"data": […], "layout": {…}}``.

Every trace carries ``meta.label`` ("theory" or a method's label), which the page's switches act on. A method has its
marker and colour of the still pictures; marks are open, so that those of one place can all be seen, and filled for r
where they stand beside those of λ.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from bent_beam_programs.report.rows import Cell, TableRow, labels
from comparison.figures.style import marks
from theory import contact_parameters

Plot = dict[str, Any]
Points = list[tuple[TableRow, Cell]]
SYMBOLS = {"lambda0": "λ<sub>0</sub>", "r0": "r<sub>0</sub>/ν", "lambda1": "λ<sub>1</sub>", "r1": "r<sub>1</sub>"}
SHAPES = {"o": "circle", "D": "diamond", "s": "square", "^": "triangle-up", "v": "triangle-down", "P": "cross",
          "<": "triangle-left", ">": "triangle-right", "X": "x", "h": "hexagon", "d": "diamond-tall", "*": "star",
          "p": "pentagon"}  # fmt: skip
"""Marker of the still pictures → the same of plotly."""
LOG: Plot = {"type": "log", "exponentformat": "power", "dtick": 1}
LOG_RATIO: Plot = {**LOG, "minor": {"ticks": "outside", "ticklen": 3}}
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
SMALLEST = 1e-5  # per cent; smaller errors are drawn there
SMALLEST_RATIO = 0.08  # κ/ν, where curves of first order begin


def plots(leading: Sequence[TableRow], first: Sequence[TableRow]) -> dict[str, Plot]:
    """Every matching plot that the rows have data for, by the name of its place in the page."""
    found: dict[str, Plot] = {}
    if leading:
        found |= {name: leading_plot(leading, name) for name in ("lambda0", "r0")}
        found["leading-error"] = error_plot(leading, ("lambda0", "r0"))
    if first:
        found |= {name: first_order_plot(first, name) for name in ("lambda1", "r1")}
        found["first-error"] = error_plot(first, ("lambda1", "r1"))
    return found


def layout(x: str, y: str, **more: Any) -> Plot:
    """The common layout: axis titles ``x`` and ``y``, anything else laid over it."""
    axis = {"gridcolor": "#e4e7eb", "linecolor": "#9aa5b1", "zerolinecolor": "#cbd2d9", "ticks": "outside",
            "tickcolor": "#9aa5b1", "automargin": True}  # fmt: skip
    base: Plot = {
        "font": {"family": "system-ui, sans-serif", "size": 13, "color": "#1f2933"},
        "margin": {"l": 62, "r": 12, "t": 10, "b": 46},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "#fff",
        "hoverlabel": {"font": {"size": 13}},
        "hovermode": "closest",
        "legend": {"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 0, "font": {"size": 11}},
        "xaxis": {**axis, "title": {"text": x}},
        "yaxis": {**axis, "title": {"text": y}},
    }
    return base | {key: {**base[key], **value} if key in base else value for key, value in more.items()}


def curve(x: ArrayLike, y: ArrayLike, name: str, line: Plot, **more: Any) -> Plot:
    """A curve of the theory."""
    return {
        "x": np.round(np.asarray(x, float), 8).tolist(),
        "y": np.round(np.asarray(y, float), 8).tolist(),
        "mode": "lines",
        "name": name,
        "line": line,
        "meta": {"label": "theory"},
        "hovertemplate": "κ/ν = %{x:.5g}: %{y:.6g}<extra>theory</extra>",
        **more,
    }


def series(rows: Sequence[TableRow], what: str, fill: str = "-open") -> Iterator[tuple[str, Plot, Points]]:
    """Label, marker and points of each method that has the number ``what``; fill : "" for filled markers."""
    for label, mark in marks(labels(r.row for r in rows)).items():
        both = [(r, c) for r in rows if r.row.label == label for c in r.cells if c.what == what]
        shape = SHAPES[mark["marker"]] + fill
        colour = str(mark["color"])
        if both:
            yield label, {"symbol": shape, "size": 9, "color": colour, "line": {"width": 1.8, "color": colour}}, both


def points(label: str, both: Points, **more: Any) -> Plot:
    """Number values with error bars, and all about them on hovering."""
    return {
        "x": [r.row.kappa_over_nu for r, _ in both],
        "y": [c.number.value for _, c in both],
        "mode": "markers",
        "name": escape(label),
        "error_y": {"array": [c.number.bar for _, c in both], "thickness": 1.2, "width": 4},
        "customdata": [
            [r.first_text, c.value_text, c.theory_text, c.error_text, f"{r.row.seconds or 0.0:.1f}", r.ratio_text]
            for r, c in both
        ],
        "hovertemplate": "<b>" + escape(label) + "</b>, κ/ν = %{customdata[5]}, (α,ψ,χ,N) = %{customdata[0]}<br>"
        "%{customdata[1]}<br>theory %{customdata[2]}, error %{customdata[3]}<br>"
        "computed in %{customdata[4]} s<extra></extra>",
        "meta": {"label": label},
        "legendgroup": label,
        **more,
    }


def leading_plot(rows: Sequence[TableRow], what: str) -> Plot:
    """λ₀ or r₀ over κ/ν on the theory's curve (thesis Figs 3.29, 3.30)."""
    smallest = min(r.row.kappa_over_nu for r in rows)
    ratio = np.concatenate([np.geomspace(smallest / 1.5, 0.9, 200), 1.0 - np.geomspace(0.1, 1e-3, 40)[1:]])
    data = [curve(ratio, getattr(contact_parameters(ratio), what), "Theory", {"color": "#000", "width": 1.8})]
    data += [points(label, both, marker=marker) for label, marker, both in series(rows, what)]
    top = LOG if what == "lambda0" else {"type": "log", "tickvals": [1, 2, 5, 10, 20, 50, 100, 200, 500]}
    return {"data": data, "layout": layout("κ/ν", SYMBOLS[what], xaxis=LOG_RATIO, yaxis=top)}


def first_order_plot(rows: Sequence[TableRow], what: str) -> Plot:
    """λ₁ or r₁ over κ/ν: a curve of theory for each (α, ψ, χ, N), and every method's points on it."""
    data: list[Plot] = []
    for i, first in enumerate(dict.fromkeys(r.row.first for r in rows)):
        line = {"color": "#000", "width": 1.3, "dash": DASHES[i % len(DASHES)]}
        mine = [r for r in rows if r.row.first == first]
        ratio = np.linspace(SMALLEST_RATIO, 0.99, 180)
        exact = getattr(contact_parameters(ratio, *first[:3], axial=first[3]), what)
        load = mine[0].first_text
        data.append(curve(ratio, exact, load, line, legendgroup=load))
        for label, marker, both in series(mine, what):
            data.append(points(label, both, marker=marker, showlegend=i == 0))
    return {
        "data": data,
        "layout": layout(
            "κ/ν",
            SYMBOLS[what] + " (ν = 1)",
            xaxis={"range": [SMALLEST_RATIO, 1.0]},
            yaxis={"range": visible(rows, what)},
            legend={"title": {"text": "(α, ψ, χ, N)"}},
        ),
    }


def visible(rows: Sequence[TableRow], what: str) -> list[float]:
    """The range that shows all points but those at small κ/ν, where λ₁ and r₁ grow without bound."""
    every = [(r.row.kappa_over_nu, c.number.theory or 0.0) for r in rows for c in r.cells if c.what == what]
    most = [value for kappa, value in every if kappa >= 0.25] or [value for _, value in every]
    room = 0.15 * max(max(most) - min(most), 1.0)
    return [min(most) - room, max(most) + room]


def error_plot(rows: Sequence[TableRow], names: Sequence[str]) -> Plot:
    """|error| in per cent of theory over κ/ν, error bars upwards, and the tolerance."""
    data: list[Plot] = []
    logarithmic = "lambda0" in names
    for what in names:
        for label, marker, both in series(rows, what, "-open" if what.startswith("lambda") else ""):
            shift = len(data) - 1.5  # beside one another, so that points do not hide others
            trace = points(label, both, marker=marker, legendgroup=f"{label}-{what}")
            data.append(
                {
                    **trace,
                    "name": f"{escape(label)} {SYMBOLS[what]}",
                    "x": [x * 1.03**shift if logarithmic else x + 0.007 * shift for x in trace["x"]],
                    "y": [max(100.0 * abs(c.error), SMALLEST) for _, c in both],
                    "error_y": {"array": [100.0 * c.bar for _, c in both], "arrayminus": [0.0] * len(both),
                                "symmetric": False, "thickness": 1.0, "width": 3},
                }
            )  # fmt: skip
    limits = sorted({(r.row.kappa_over_nu, 100.0 * c.tolerance) for r in rows for c in r.cells})
    if limits:
        (low, at_low), (high, at_high) = limits[0], limits[-1]
        limits = [(0.85 * low, at_low), *limits, (1.15 * high, at_high)]  # all marks of the outermost κ/ν lie between
        line = {"color": "#52606d", "width": 1, "dash": "dot", "shape": "hv"}
        hover = "tolerance %{y:g} %<extra></extra>"
        data.append(curve([x for x, _ in limits], [y for _, y in limits], "tolerance", line, hovertemplate=hover))
    return {"data": data, "layout": layout("κ/ν", "|error| (%)", xaxis=LOG_RATIO if logarithmic else {}, yaxis=LOG)}
