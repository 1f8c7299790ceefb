"""The files of a match: its rows as JSON and CSV, and the matching plots: numerical λ₀, r₀ on the theory's curves
(thesis Figs 3.29, 3.30), and λ₁, r₁ (Figs 2.12, 2.16 with points).

A number that is missing is left out, and the figure says how many were.
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import cycle
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam.as_json import json_text
from bent_beam.files import write_atomically
from comparison.figures import style
from comparison.figures.work_precision import draw_work_precision
from comparison.readable import csv_text
from comparison.rows import First, MatchRow, match_document
from theory import contact_parameters

DASHES = ("-", "--", ":", "-.")  # of theory's curves, a kind for each load
PLOTS = ("leading", "first-order", "work-precision", "work-precision-first-order")


def write_match(rows: Sequence[MatchRow], out: Path) -> list[Path]:
    """``match.json``, ``match.csv`` and the plots of these rows, no earlier ones, in ``out``; returns the files."""
    files = [out / "match.json", out / "match.csv"]
    write_atomically(files[0], json_text(match_document(rows), indent=1) + "\n")
    write_atomically(files[1], csv_text([row.to_dict() for row in rows]))
    files += draw_matching(rows, out) + draw_work_precision(rows, out)
    for old in {out / f"{name}.png" for name in PLOTS} - {*files}:
        old.unlink(missing_ok=True)
    return files


def draw_matching(rows: Sequence[MatchRow], out: Path) -> list[Path]:
    """Every matching plot that the rows have data for; returns the files. The finest refinement is drawn."""
    shown = _best(rows, lambda r: (r.label, r.kappa_over_nu, r.first), lambda r: r.refine)
    files = style.save(leading_figure(shown), out, "leading") if any(r.lambda0.measured for r in shown) else []
    if any(r.r1.measured for r in shown):
        files += draw_first_order(shown, out)
    return files


def _best(rows: Sequence[MatchRow], key: Callable[[MatchRow], Any], by: Callable[[MatchRow], Any]) -> list[MatchRow]:
    """Of the rows of each ``key`` the first of those that are best ``by`` this."""
    found: dict[Any, MatchRow] = {}
    for row in rows:
        found[key(row)] = max(found.get(key(row), row), row, key=by)
    return list(found.values())


def leading_figure(rows: Sequence[MatchRow]) -> Any:
    """λ₀ and r₀ over κ/ν, theory's curve and numerical points, and the relative differences below."""
    leading = _best(rows, lambda r: (r.label, r.kappa_over_nu), lambda r: (r.lambda0.measured, r.refine))
    ratios = [r.kappa_over_nu for r in leading]
    curve = np.geomspace(min(*ratios, 0.1) / 2, max(1.5 * max(ratios), 1.0), 400)
    exact = contact_parameters(curve)
    with style.figure(2, 2, width=style.PAGE, height=4.4, sharex=True, height_ratios=[2, 1]) as (fig, axes):
        for (top, below), what, symbol in zip(axes.T, ("lambda0", "r0"), (r"$\lambda_0$", r"$r_0/\nu$")):
            values = np.asarray(getattr(exact, what), float)
            top.loglog(curve[values > 0], values[values > 0], **style.THEORY)
            style.decades(top.xaxis, curve)
            style.decades(top.yaxis, values[values > 0])
            top.set_ylabel(symbol)
            below.axhline(0.0, **{**style.THEORY, "label": None})
            _compare(top, below, leading, what)
        style.label_panels(*axes[0])
        axes[0, 0].legend()
        _say_what_is_missing(fig, {"left out, no number": [r for r in leading if not r.lambda0.measured]})
        return fig


def _compare(top: Axes, below: Axes, rows: Sequence[MatchRow], what: str) -> None:
    """Points of each method, a little apart from one another below, where they are differences from theory."""
    marks = style.marks(r.label for r in rows)
    limit = 2.0
    for i, (label, mark) in enumerate(marks.items()):
        mine = [(r.kappa_over_nu, getattr(r, what)) for r in rows if r.label == label]
        mine = [(k, c) for k, c in mine if c.measured and c.theory]  # λ₀ = 0 has no place on a logarithmic axis
        if not mine:
            continue
        x = np.array([k for k, _ in mine])
        top.plot(x, [c.value for _, c in mine], **mark)
        off = np.array([100 * c.relative() for _, c in mine])
        bars = np.array([100 * (c.relative_bar() or 0.0) for _, c in mine])
        style.bars(below, x * 1.015 ** (i - (len(marks) - 1) / 2), off, bars, {**mark, "label": None})
        limit = max(limit, 1.5 * float(np.max(np.abs(off) + bars)))  # every point and its bar have their place
    below.set(xlabel=r"$\kappa/\nu$", ylabel="difference  (%)")
    style.linear_within(below, 0.01, " %")
    ticks = (-10, -1, -0.1, 0, 0.1, 1, 10)
    below.set_yticks(ticks, [f"{tick:g}".replace("-", "−") for tick in ticks])
    below.set_ylim(-limit, limit)


def draw_first_order(rows: Sequence[MatchRow], out: Path) -> list[Path]:
    """λ₁ and r₁ over κ/ν for every (α, ψ, χ, N) among the rows, λ_N and r_N of tension alone: theory and points."""
    asked = [r for r in rows if r.of_first_order]
    # in free flight α differs with κ/ν, and λ₁, r₁ are λ_N, r_N times the axial force: one curve
    groups: dict[First | None, list[MatchRow]] = {}
    for row in sorted(asked, key=lambda r: (r.of_tension_alone, r.first)):
        groups.setdefault(None if row.of_tension_alone else row.first, []).append(row)
    marks = style.marks(r.label for r in asked)
    tension = any(first[3] for first in groups if first)
    with style.figure(1, 2, width=style.PAGE, height=3.6) as (fig, axes):
        for axis, what, symbol in zip(axes, ("lambda1", "r1"), (r"$\lambda_{}$", "$r_{}$")):
            largest = 1.0
            for (first, mine), dashes in zip(groups.items(), cycle(DASHES)):
                named = _named(first, tension) if axis is axes[0] else None
                line = {**style.THEORY, "lw": 0.9, "ls": dashes, "label": named}
                axis.plot(*_curve(mine, first, what), **line)
                for label, mark in marks.items():
                    own = [r for r in mine if r.label == label and getattr(r, what).measured]
                    found = [getattr(r, what).scaled(1.0 / r.axial if first is None else 1.0) for r in own]
                    if own:
                        values, bars = [n.known for n in found], [n.bar or 0.0 for n in found]
                        style.bars(axis, [r.kappa_over_nu for r in own], values, bars, {**mark, "label": None})
                        largest = max(largest, *map(abs, values))
            if largest > 30:
                style.linear_within(axis, 1.0)
            symbols = [symbol.format(1)] * any(groups) + [symbol.format("N")] * (None in groups)
            axis.set(xlabel=r"$\kappa/\nu$", ylabel=", ".join(symbols))
        style.label_panels(*axes)
        loads = r"($\alpha$, $\psi$, $\chi$, $N$)" if tension else r"($\alpha$, $\psi$, $\chi$)"
        axes[0].legend(title=loads if any(groups) else None, ncols=1 if None in groups else 2)
        for mark in [*marks.values(), style.THEORY]:
            axes[1].plot([], [], **mark)
        axes[1].legend()
        unseen = [r for r in asked if r.r1.measured and not r.lambda1.measured]
        _say_what_is_missing(fig, {"left out, no number": [r for r in asked if not r.r1.measured], "no λ₁": unseen})
        return style.save(fig, out, "first-order")


def _named(first: First | None, tension: bool) -> str:
    if first is None:
        return r"tension alone: $\lambda_N$, $r_N$"
    return f"({', '.join(f'{v:g}' for v in first[: 4 if tension else 3])})".replace("-", "−")


def _curve(rows: Sequence[MatchRow], first: First | None, what: str) -> tuple[Any, Any]:
    """Theory's numbers over κ/ν, from a little below the rows'; λ₁ jumps to 0 at κ/ν = 1."""
    curve = np.linspace(0.05, 0.9999, 400)
    curve = curve[curve >= 0.8 * min(r.kappa_over_nu for r in rows)]
    if first is None:
        return curve, getattr(contact_parameters(curve), {"lambda1": "lambda_axial", "r1": "r_axial"}[what])
    return curve, getattr(contact_parameters(curve, *first[:3], axial=first[3]), what)


def _say_what_is_missing(fig: Any, lost: Mapping[str, Sequence[MatchRow]]) -> None:
    said = []
    for what, rows in lost.items():
        if rows:
            labels = ", ".join(dict.fromkeys(r.label for r in rows))
            said.append(f"{what}: {len(rows)} row{'s' if len(rows) > 1 else ''} ({labels[:120]})")
    if said:
        fig.supxlabel("; ".join(said), fontsize=6.5)
