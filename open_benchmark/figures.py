"""Work–precision figures: relative error against the runner's wall seconds, a line a code from coarse to fine mesh.

A code has the same colour and mark in every figure; a point whose contact zone is lifted off is open, one whose wall
pulls is crossed out.
"""

from __future__ import annotations

import io
from collections.abc import Sequence

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from open_benchmark.adapter import RESOLUTIONS, shipped_adapters
from open_benchmark.campaign import Row
from open_benchmark.problem import problem

__all__ = ["MEASURES", "svg", "work_precision_figures"]

MEASURES = {"lambda0": "λ₀", "r0": "r₀", "lambda1": "λ₁", "r1": "r₁", "restitution": "e", "impulse_error": "J(t)"}
MEASURES |= {"peak_force": "the largest force", "peak_time": "its time"}
MARKS = "osD^vP*<>hp8d"
LEAST = 1e-7  # relative error that a figure still shows


def work_precision_figures(rows: Sequence[Row], name: str, solvers: Sequence[str]) -> dict[str, Figure]:
    """Measured number → figure of a problem.

    A faint line above a point ends at the error plus the error bar.
    """
    own = [row for row in rows if row.problem == name]
    wanted = ("lambda1", "r1") if problem(name).kind == "first" else MEASURES
    return {measure: _panel(own, measure, solvers) for measure in wanted if any(_point(row, measure) for row in own)}


def _panel(rows: Sequence[Row], measure: str, solvers: Sequence[str]) -> Figure:
    figure = Figure(figsize=(5.2, 4.3), layout="constrained")
    axis = figure.subplots()
    styles = {name: k for k, name in enumerate([*shipped_adapters(), *sorted(set(solvers) - set(shipped_adapters()))])}
    for solver in solvers:
        k = styles[solver]
        own = [r for name in RESOLUTIONS for r in rows if r.solver == solver and r.resolution == name]
        points = [p for row in own if (p := _point(row, measure))]
        if points:
            seconds, errors, tops = zip(*points)
            color, style = f"C{k % 10}", "-" if k < 10 else "--"
            axis.vlines(seconds, errors, tops, color=color, lw=0.8, alpha=0.35)
            mark = MARKS[k % len(MARKS)]
            axis.loglog(seconds, errors, marker=mark, ms=5, lw=1.2, color=color, ls=style, label=solver)
            for word, over in (("lifted", {"marker": mark, "mfc": "white"}), ("adhesive", {"marker": "x"})):
                marked = [p[:2] for row in own if word in row.score.outcome and (p := _point(row, measure))]
                axis.loglog(
                    *np.array(marked).reshape(-1, 2).T, ls="", ms=5, color=color if over.get("mfc") else "k", **over
                )
    for (low, high), bound in ((axis.get_ylim(), axis.set_ylim), (axis.get_xlim(), axis.set_xlim)):
        bound(10.0 ** np.floor(np.log10(low)), 10.0 ** np.ceil(np.log10(high)))
    axis.xaxis.set_minor_formatter("")
    axis.set(xlabel="wall clock of the whole process, s", ylabel=f"relative error of {MEASURES[measure]}")
    axis.grid(True, which="major", lw=0.4, color="0.85")
    axis.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside lower center", ncols=3, frameon=False, fontsize=8)
    return figure


def _point(row: Row, measure: str) -> tuple[float, float, float] | None:
    """Seconds, relative error, and that with the error bar on top."""
    found, seconds = row.score.measured.get(measure), row.seconds
    if found is None or found.difference is None or seconds is None or (found.theory == 0.0 and measure == "lambda0"):
        return None
    error = max(abs(found.relative() or 0.0), LEAST)
    return seconds, error, error + (found.relative_error() or 0.0)


def svg(figure: Figure) -> str:
    """The figure as an SVG element, the same bits for the same numbers."""
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "beam-impact", "svg.fonttype": "path"}):
        figure.savefig(stream, format="svg", metadata={"Date": None})
    text = stream.getvalue()
    return text[text.index("<svg") :]
