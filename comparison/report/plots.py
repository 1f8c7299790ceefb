"""The report's interactive plots as plain plotly dictionaries: ``{"data": […], "layout": {…}}``.

Every trace carries ``meta.label`` ("theory" or a method's label), which the page's switches act on.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

import numpy as np

from comparison.figures.style import SEQUENCE, marks
from comparison.report.impacts import ShownImpact, theory_of
from comparison.report.rows import Cell, TableRow, labels
from theory import contact_parameters

__all__ = [
    "bounce_plot",
    "convergence_plot",
    "error_plot",
    "first_order_plot",
    "leading_plot",
    "noise_plots",
    "plots",
    "seconds_plot",
]

Plot = dict[str, Any]
OPEN = ("circle", "square", "diamond", "triangle-up", "triangle-down", "cross", "x", "star", "hexagon", "pentagon")


def marks_of(rows: Sequence[TableRow]) -> dict[str, dict[str, Any]]:
    """Marker of each method, by its label."""
    colours = {label: str(mark["color"]) for label, mark in marks(labels(r.row for r in rows)).items()}
    return {
        label: {
            "symbol": f"{OPEN[i % len(OPEN)]}-open",
            "size": 9,
            "line": {"width": 1.8, "color": colour},
            "color": colour,
        }
        for i, (label, colour) in enumerate(colours.items())
    }


SYMBOLS = {
    "lambda0": "λ<sub>0</sub>",
    "r0": "r<sub>0</sub>",
    "lambda1": "λ<sub>1</sub>",
    "r1": "r<sub>1</sub>",
}


def layout(x: str, y: str, **more: Any) -> Plot:
    """The common layout: axis titles ``x`` and ``y``, anything else laid over it."""
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


def plots(
    leading: Sequence[TableRow], first: Sequence[TableRow], convergence: Sequence[TableRow] = ()
) -> dict[str, Plot]:
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
    if convergence:
        found["convergence"] = convergence_plot(convergence)
    return found


def convergence_plot(rows: Sequence[TableRow]) -> Plot:
    """|error| of λ₀ and r₀ over the refinement of elements and steps, a line a method and number."""
    data: list[Plot] = []
    for label, marker in marks_of(rows).items():
        for what in ("lambda0", "r0"):
            both = [(r, c) for r in rows if r.row.label == label for c in r.cells if c.what == what]
            if both:
                data.append(
                    {
                        "x": [r.row.refine for r, _ in both],
                        "y": [max(100.0 * abs(c.error), 1e-5) for _, c in both],
                        "mode": "lines+markers",
                        "name": f"{escape(label)} {SYMBOLS[what]}",
                        "line": {"color": marker["color"], "width": 1, "dash": "dot" if what == "lambda0" else "solid"},
                        "marker": {
                            **marker,
                            "symbol": marker["symbol"] if what == "lambda0" else marker["symbol"].replace("-open", ""),
                        },
                        "customdata": [[c.error_text, f"{r.row.seconds or 0.0:.2g}"] for r, c in both],
                        "hovertemplate": "refinement %{x:g}: error %{customdata[0]}, %{customdata[1]} s<extra></extra>",
                        "meta": {"label": label},
                    }
                )
    refinements = sorted({r.row.refine for r in rows})
    return {
        "data": data,
        "layout": layout(
            "refinement of elements and steps",
            "|error| (%)",
            xaxis={"type": "log", "tickvals": refinements, "ticktext": [f"{v:g}" for v in refinements]},
            yaxis={"type": "log", "exponentformat": "power", "dtick": 1},
            legend={"font": {"size": 11}},
        ),
    }


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
            "name": "Theory",
            "line": {"color": "#000", "width": 1.8},
            "meta": {"label": "theory"},
            "legendgroup": "theory",
            "hovertemplate": "κ/ν = %{x:.5g}<br>theory: %{y:.6g}<extra></extra>",
        }
    ]
    for label, marker in marks_of(rows).items():
        mine = [(r, c) for r in rows if r.row.label == label for c in r.cells if c.what == what and c.exact > 0.0]
        if mine:
            data.append(points(label, [r for r, _ in mine], [c for _, c in mine], marker=marker))
    top: Plot = {"type": "log", "exponentformat": "power", "dtick": 1}
    if what == "r0":
        top |= {"dtick": None, "tickvals": [1, 2, 5, 10, 20, 50, 100, 200, 500]}
    return {
        "data": data,
        "layout": layout("κ/ν", SYMBOLS[what] + ("/ν" if what == "r0" else ""), xaxis=LOG_RATIO, yaxis=top),
    }


def points(label: str, rows: Sequence[TableRow], cells: Sequence[Cell], **more: Any) -> Plot:
    """Measured values with error bars, and all about them on hovering."""
    return {
        "x": [r.row.kappa_over_nu for r in rows],
        "y": [c.value for c in cells],
        "mode": "markers",
        "name": escape(label),
        "error_y": {"array": [c.bar_absolute for c in cells], "thickness": 1.2, "width": 4},
        "customdata": [
            [r.first_text, c.value_text, f"{c.exact:.6g}", c.error_text, f"{r.row.seconds or 0.0:.1f}", r.ratio_text]
            for r, c in zip(rows, cells)
        ],
        "hovertemplate": "<b>" + escape(label) + "</b>, κ/ν = %{customdata[5]}, (α,ψ,χ,N) = %{customdata[0]}<br>"
        "%{customdata[1]}<br>theory %{customdata[2]}, error %{customdata[3]}<br>"
        "computed in %{customdata[4]} s<extra></extra>",
        "meta": {"label": label},
        "legendgroup": label,
        **more,
    }


def first_order_plot(rows: Sequence[TableRow], what: str) -> Plot:
    """λ₁ or r₁ over κ/ν: a curve of theory for each (α, ψ, χ), and every method's points on it."""
    firsts = list(dict.fromkeys(r.row.first for r in rows))
    data: list[Plot] = []
    for i, first in enumerate(firsts):
        colour = SEQUENCE[i % len(SEQUENCE)]
        mine = [r for r in rows if r.row.first == first]
        smallest = min(r.row.kappa_over_nu for r in mine)
        ratio = np.linspace(0.1 if smallest < 0.2 else 0.25, 0.99, 120)
        exact = np.asarray(getattr(contact_parameters(ratio, *first[:3], axial=first[3]), what), float)
        load = mine[0].first_text
        dash = ("solid", "dash")[i // len(SEQUENCE) % 2]
        data.append(
            {
                "x": ratio.round(5).tolist(),
                "y": exact.round(6).tolist(),
                "mode": "lines",
                "name": load,
                "legendgroup": load,
                "line": {"color": colour, "width": 1.5, "dash": dash},
                "meta": {"label": "theory"},
                "hovertemplate": load + "<br>κ/ν = %{x:.3f}: %{y:.5g}<extra>theory</extra>",
            }
        )
        for label, marker in marks_of(rows).items():
            both = [(r, c) for r in mine if r.row.label == label for c in r.cells if c.what == what]
            if both:
                data.append(
                    points(
                        label,
                        [r for r, _ in both],
                        [c for _, c in both],
                        marker={**marker, "color": colour, "line": {"width": 1.8, "color": colour}},
                        legendgroup=load,
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
            legend={"title": {"text": "(α, ψ, χ, N)"}, "font": {"size": 11}},
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
    for label, marker in marks_of(rows).items():
        for what in names:
            both = [(r, c) for r in rows if r.row.label == label for c in r.cells if c.what == what]
            if not both:
                continue
            cells = [c for _, c in both]
            size = [max(100.0 * abs(c.error), 1e-5) for c in cells]
            trace = points(
                label,
                [r for r, _ in both],
                cells,
                marker={
                    **marker,
                    "symbol": marker["symbol"] if what.startswith("lambda") else marker["symbol"].replace("-open", ""),
                },
                name=f"{escape(label)} {SYMBOLS[what]}",
                legendgroup=f"{label}-{what}",
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
    for label, marker in marks_of(rows).items():
        limits = sorted(
            {
                (r.row.kappa_over_nu, 100.0 * max(c.tolerance for c in r.cells))
                for r in rows
                if r.row.label == label and r.cells
            }
        )
        if limits:
            (first, low), (last, high) = limits[0], limits[-1]
            limits = [(0.9 * first, low), *limits, (1.1 * last, high)]  # all marks of the outermost κ/ν lie between
            data.append(
                {
                    "x": [x for x, _ in limits],
                    "y": [y for _, y in limits],
                    "mode": "lines",
                    "name": "tolerance",
                    "showlegend": label == next(iter(marks_of(rows))),
                    "hovertemplate": "tolerance %{y:g} %<extra></extra>",
                    "line": {"color": marker["color"], "width": 1, "dash": "dot", "shape": "hv"},
                    "meta": {"label": label},
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
    for label, marker in marks_of(rows).items():
        for order, chosen in (("leading order", False), ("first order", True)):
            mine = [r for r in rows if r.row.label == label and r.row.of_first_order == chosen]
            mine = [r for r in mine if r.row.seconds is not None]
            if mine:
                data.append(
                    {
                        "x": [r.row.kappa_over_nu for r in mine],
                        "y": [r.row.seconds for r in mine],
                        "mode": "markers",
                        "name": f"{escape(label)}, {order}",
                        "meta": {"label": label},
                        "marker": {
                            **marker,
                            "symbol": marker["symbol"] if chosen else marker["symbol"].replace("-open", ""),
                        },
                        "customdata": [[r.ratio_text, r.first_text] for r in mine],
                        "hovertemplate": "κ/ν = %{customdata[0]}, (α,ψ,χ,N) = %{customdata[1]}<br>"
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


def noise_plots(before: ShownImpact, after: ShownImpact) -> dict[str, Plot]:
    """One end's reaction over theory's, and the gap of the zone at the end, before and after."""
    theory = theory_of(after.shown)
    time, x = np.array(theory["time"]), np.array(theory["x"]) / theory["front"][-1]
    shown = x < 1.4
    force: list[Plot] = []
    gap: list[Plot] = []
    for run, line in ((before, {"color": "#777777", "width": 1.3}), (after, {"color": SEQUENCE[0], "width": 2})):
        ratio = np.array(run.data["reaction"]) / np.array(theory["reaction"])
        common = {"mode": "lines", "name": escape(run.label), "line": line, "meta": {"label": run.label}}
        force.append({**common, "x": np.sqrt(time).round(5).tolist(), "y": ratio.round(5).tolist()})
        profile = 1000.0 * np.array(run.data["gap"][-1], float)
        gap.append({**common, "x": x[shown].round(5).tolist(), "y": profile[shown].round(5).tolist()})
    black = {"mode": "lines", "name": "Theory", "line": {"color": "#000", "width": 1.2, "dash": "dot"}}
    ends = [float(np.sqrt(time[0])), float(np.sqrt(time[-1]))]
    force.append({**black, "x": ends, "y": [1.0, 1.0], "meta": {"label": "theory"}})
    exact = 1000.0 * np.array(theory["gap"][-1])
    gap.append({**black, "x": x[shown].round(5).tolist(), "y": exact[shown].round(5).tolist(),
                "meta": {"label": "theory"}})  # fmt: skip
    return {
        "noise-force": {"data": force, "layout": layout("√τ", "reaction / theory")},
        "noise-gap": {
            "data": gap,
            "layout": layout("x/λ<sub>c</sub>", "gap (‰ of V<sub>0</sub>t)", yaxis={"range": [-2.0, 25.0]}),
        },
    }


def bounce_plot(stored: Mapping[str, Any]) -> Plot:
    """Restitution of the whole impact over κ/ν, a curve for each damping, error bars; the band without damping."""
    data: list[Plot] = []
    for i, damping in enumerate(stored["damping"]):
        mine = sorted((p["kappa_over_nu"], *p["numbers"]["restitution"]) for p in stored["points"]
                      if p["damping"] == damping and p["numbers"]["restitution"][0] is not None)  # fmt: skip
        data.append(
            {
                "x": [k for k, _, _ in mine],
                "y": [v for _, v, _ in mine],
                "error_y": {"array": [e for _, _, e in mine], "thickness": 1, "width": 2},
                "mode": "lines+markers",
                "name": f"η/T* = {damping:g}",
                "line": {"color": SEQUENCE[i % len(SEQUENCE)], "width": 1.5},
                "marker": {"size": 4},
                "meta": {"label": f"damping {damping:g}"},
                "hovertemplate": "κ/ν = %{x:g}: e = %{y:.4f}<extra></extra>",
            }
        )
    bands = sorted((b["kappa_over_nu"], *b["band"]["restitution"]) for b in stored["bands"])
    if bands:
        data.append(
            {
                "x": [k for k, _, _ in bands] + [k for k, _, _ in reversed(bands)],
                "y": [m - s for _, m, s in bands] + [m + s for _, m, s in reversed(bands)],
                "mode": "lines",
                "line": {"width": 0},
                "fill": "toself",
                "fillcolor": "rgba(119,119,119,0.25)",
                "name": "no damping, ± one standard deviation",
                "hoverinfo": "skip",
                "meta": {"label": "no damping"},
            }
        )
    return {
        "data": data,
        "layout": layout(
            "κ/ν", "restitution e", xaxis={"type": "log", "tickvals": [0.05, 0.1, 0.2, 0.5, 1, 2]},
            yaxis={"range": [0.0, 1.0]}, legend={"font": {"size": 11}},
        ),
    }  # fmt: skip
