"""The report's interactive plots as plain plotly dictionaries: ``{"data": […], "layout": {…}}``.

Every trace carries ``meta.path`` ("theory", "hermite" or "exudyn"), which the page's switches act on.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from comparison.figures.style import COLOURS, SEQUENCE
from comparison.matching import MatchRow
from comparison.report.rows import Cell, TableRow, first_of, table_row
from theory import contact_parameters

__all__ = ["error_plot", "first_order_plot", "leading_plot", "plots", "seconds_plot"]

Plot = dict[str, Any]
MARKS: dict[str, dict[str, Any]] = {
    "hermite": {
        "symbol": "circle-open",
        "size": 9,
        "line": {"width": 1.8, "color": COLOURS["blue"]},
        "color": COLOURS["blue"],
    },
    "exudyn": {
        "symbol": "square-open",
        "size": 9,
        "line": {"width": 1.8, "color": COLOURS["vermilion"]},
        "color": COLOURS["vermilion"],
    },
}
NAMES = {"theory": "Theory", "hermite": "Hermite", "exudyn": "Exudyn"}
SYMBOLS = {
    "lambda0": "λ<sub>0</sub>",
    "r0": "r<sub>0</sub>",
    "lambda1": "λ<sub>1</sub>",
    "r1": "r<sub>1</sub>",
}


def layout(x: str, y: str, **more: Any) -> Plot:
    """The common look: axis titles ``x`` and ``y``, anything else laid over it."""
    axis = {
        "gridcolor": "#e4e7eb",
        "linecolor": "#9aa5b1",
        "zerolinecolor": "#cbd2d9",
        "ticks": "outside",
        "tickcolor": "#9aa5b1",
        "automargin": True,
    }
    base: Plot = {
        "font": {"family": "system-ui, sans-serif", "size": 13, "color": "#1f2933"},
        "margin": {"l": 62, "r": 12, "t": 10, "b": 46},
        "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "#fff",
        "hoverlabel": {"font": {"size": 13}},
        "hovermode": "closest",
        "legend": {"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 0},
        "xaxis": {**axis, "title": {"text": x}},
        "yaxis": {**axis, "title": {"text": y}},
    }
    for key, value in more.items():
        base[key] = {**base[key], **value} if isinstance(value, dict) and key in base else value
    return base


LOG_RATIO = {
    "type": "log",
    "dtick": 1,
    "exponentformat": "power",
    "minor": {"ticks": "outside", "ticklen": 3},
}


def plots(leading: Sequence[TableRow], first: Sequence[TableRow]) -> dict[str, Plot]:
    """Every matching plot that the rows have data for, by the name of its place in the page."""
    found: dict[str, Plot] = {}
    if leading:
        found |= {"lambda0": leading_plot(leading, "lambda0"), "r0": leading_plot(leading, "r0")}
        found["leading-error"] = error_plot(leading, ("lambda0", "r0"))
    if first:
        found |= {"lambda1": first_order_plot(first, "lambda1"), "r1": first_order_plot(first, "r1")}
        found["first-error"] = error_plot(first, ("lambda1", "r1"))
    if leading or first:
        found["seconds"] = seconds_plot([*leading, *first])
    return found


def leading_plot(rows: Sequence[TableRow], what: str) -> Plot:
    """λ₀ or r₀ over κ/ν on the theory's curve (thesis Figs 3.29, 3.30)."""
    smallest = min(r.row.kappa_over_nu for r in rows)
    ratio = np.concatenate([np.geomspace(smallest / 1.5, 0.9, 200), 1.0 - np.geomspace(0.1, 1e-3, 40)[1:], [1.0, 1.5]])
    exact = np.asarray(getattr(contact_parameters(ratio), what), float)
    shown = exact > 0.0
    data: list[Plot] = [
        {
            "x": ratio[shown].round(8).tolist(),
            "y": exact[shown].round(8).tolist(),
            "mode": "lines",
            "name": NAMES["theory"],
            "line": {"color": "#000", "width": 1.8},
            "meta": {"path": "theory"},
            "legendgroup": "theory",
            "hovertemplate": "κ/ν = %{x:.5g}<br>theory: %{y:.6g}<extra></extra>",
        }
    ]
    for path, marker in MARKS.items():
        mine = [(r, c) for r in rows if r.row.path == path for c in r.cells if c.what == what and c.exact > 0.0]
        if mine:
            data.append(points(path, [r for r, _ in mine], [c for _, c in mine], marker=marker))
    top: Plot = {"type": "log", "exponentformat": "power", "dtick": 1}
    if what == "r0":
        top |= {"dtick": None, "tickvals": [1, 2, 5, 10, 20, 50, 100, 200, 500]}
    return {
        "data": data,
        "layout": layout("κ/ν", SYMBOLS[what] + ("/ν" if what == "r0" else ""), xaxis=LOG_RATIO, yaxis=top),
    }


def points(path: str, rows: Sequence[TableRow], cells: Sequence[Cell], **more: Any) -> Plot:
    """Measured values with error bars, and all about them on hovering."""
    return {
        "x": [r.row.kappa_over_nu for r in rows],
        "y": [c.value for c in cells],
        "mode": "markers",
        "name": NAMES[path],
        "error_y": {"array": [c.bar_absolute for c in cells], "thickness": 1.2, "width": 4},
        "customdata": [
            [r.first_text, c.value_text, f"{c.exact:.6g}", c.error_text, f"{r.row.seconds:.1f}", r.ratio_text]
            for r, c in zip(rows, cells)
        ],
        "hovertemplate": "<b>" + NAMES[path] + "</b>, κ/ν = %{customdata[5]}, (α,ψ,χ) = %{customdata[0]}<br>"
        "%{customdata[1]}<br>theory %{customdata[2]}, error %{customdata[3]}<br>"
        "computed in %{customdata[4]} s<extra></extra>",
        "meta": {"path": path},
        "legendgroup": path,
        **more,
    }


def first_order_plot(rows: Sequence[TableRow], what: str) -> Plot:
    """λ₁ or r₁ over κ/ν: a curve of theory for each (α, ψ, χ), and the points of both paths on it."""
    firsts = list(dict.fromkeys(first_of(r.row) for r in rows))
    data: list[Plot] = []
    for i, first in enumerate(firsts):
        colour = SEQUENCE[i % len(SEQUENCE)]
        mine = [r for r in rows if first_of(r.row) == first]
        smallest = min(r.row.kappa_over_nu for r in mine)
        ratio = np.linspace(0.1 if smallest < 0.2 else 0.25, 0.99, 120)
        exact = np.asarray(getattr(contact_parameters(ratio, *first), what), float)
        label = mine[0].first_text
        dash = ("solid", "dash")[i // len(SEQUENCE) % 2]
        data.append(
            {
                "x": ratio.round(5).tolist(),
                "y": exact.round(6).tolist(),
                "mode": "lines",
                "name": label,
                "legendgroup": label,
                "line": {"color": colour, "width": 1.5, "dash": dash},
                "meta": {"path": "theory"},
                "hovertemplate": label + "<br>κ/ν = %{x:.3f}: %{y:.5g}<extra>theory</extra>",
            }
        )
        for path, marker in MARKS.items():
            both = [(r, c) for r in mine if r.row.path == path for c in r.cells if c.what == what]
            if both:
                data.append(
                    points(
                        path,
                        [r for r, _ in both],
                        [c for _, c in both],
                        marker={**marker, "color": colour, "line": {"width": 1.8, "color": colour}},
                        legendgroup=label,
                        showlegend=False,
                    )
                )
    return {
        "data": data,
        "layout": layout(
            "κ/ν",
            SYMBOLS[what] + " (ν = 1)",
            xaxis={"range": [0.08, 1.0]},
            yaxis={"range": visible(rows, what)},
            legend={"title": {"text": "(α, ψ, χ)"}, "font": {"size": 11}},
        ),
    }


def visible(rows: Sequence[TableRow], what: str) -> list[float]:
    """The range that shows all points but those at small κ/ν, where λ₁ and r₁ grow without bound."""
    every = [c.exact for r in rows for c in r.cells if c.what == what]
    most = [c.exact for r in rows for c in r.cells if c.what == what and r.row.kappa_over_nu >= 0.25] or every
    room = 0.15 * max(max(most) - min(most), 1.0)
    return [min(most) - room, max(most) + room]


def error_plot(rows: Sequence[TableRow], names: Sequence[str]) -> Plot:
    """|error| in per cent of theory over κ/ν, error bars upwards, and the tolerances."""
    data: list[Plot] = []
    for path, marker in MARKS.items():
        for what in names:
            both = [(r, c) for r in rows if r.row.path == path for c in r.cells if c.what == what]
            if not both:
                continue
            cells = [c for _, c in both]
            size = [max(100.0 * abs(c.error), 1e-5) for c in cells]
            trace = points(
                path,
                [r for r, _ in both],
                cells,
                marker={
                    **marker,
                    "symbol": marker["symbol"] if what.startswith("lambda") else marker["symbol"].replace("-open", ""),
                },
                name=f"{NAMES[path]} {SYMBOLS[what]}",
                legendgroup=f"{path}-{what}",
            )
            data.append(
                {
                    **trace,
                    "x": beside(trace["x"], len(data), logarithmic="lambda0" in names),
                    "y": size,
                    "error_y": {
                        "array": [100.0 * c.bar for c in cells],
                        "arrayminus": [0.0] * len(cells),
                        "symmetric": False,
                        "thickness": 1.0,
                        "width": 3,
                    },
                }
            )
    for path in MARKS:
        limits = sorted(
            {
                (r.row.kappa_over_nu, 100.0 * max(c.tolerance for c in r.cells))
                for r in rows
                if r.row.path == path and r.cells
            }
        )
        if limits:
            data.append(
                {
                    "x": [x for x, _ in limits],
                    "y": [y for _, y in limits],
                    "mode": "lines+markers" if len(limits) == 1 else "lines",
                    "name": "tolerance",
                    "showlegend": path == "hermite",
                    "hovertemplate": "tolerance %{y:g} %<extra></extra>",
                    "line": {"color": MARKS[path]["color"], "width": 1, "dash": "dot", "shape": "hv"},
                    "marker": {"symbol": "line-ew-open", "size": 16, "color": MARKS[path]["color"]},
                    "meta": {"path": path},
                }
            )
    return {
        "data": data,
        "layout": layout(
            "κ/ν",
            "|error| (%)",
            xaxis=LOG_RATIO if "lambda0" in names else {},
            legend={"font": {"size": 11}},
            yaxis={"type": "log", "exponentformat": "power", "dtick": 1},
        ),
    }


def beside(ratios: Sequence[float], place: int, *, logarithmic: bool) -> list[float]:
    """κ/ν moved a little by the number of the curve, so that points of several do not hide one another."""
    shift = place - 1.5
    return [x * 1.03**shift if logarithmic else x + 0.007 * shift for x in ratios]


def seconds_plot(rows: Sequence[TableRow]) -> Plot:
    """Measured seconds of every row."""
    data: list[Plot] = []
    for path, marker in MARKS.items():
        for order, chosen in (("leading order", False), ("first order", True)):
            mine = [r for r in rows if r.row.path == path and (r.row.lambda1 is not None) == chosen]
            if mine:
                data.append(
                    {
                        "x": [r.row.kappa_over_nu for r in mine],
                        "y": [r.row.seconds for r in mine],
                        "mode": "markers",
                        "name": f"{NAMES[path]}, {order}",
                        "meta": {"path": path},
                        "marker": {
                            **marker,
                            "symbol": marker["symbol"] if chosen else marker["symbol"].replace("-open", ""),
                        },
                        "customdata": [[r.ratio_text, r.first_text] for r in mine],
                        "hovertemplate": "κ/ν = %{customdata[0]}, (α,ψ,χ) = %{customdata[1]}<br>"
                        "%{y:.2f} s<extra></extra>",
                    }
                )
    return {
        "data": data,
        "layout": layout(
            "κ/ν",
            "seconds a row",
            xaxis=LOG_RATIO,
            yaxis={"type": "log", "exponentformat": "power", "dtick": 1},
        ),
    }


def row_plots(rows: Sequence[MatchRow]) -> dict[str, Plot]:
    """:func:`plots` from rows as the matching gives them."""
    both = [table_row(r) for r in rows]
    return plots([r for r in both if r.row.lambda1 is None], [r for r in both if r.row.lambda1 is not None])
