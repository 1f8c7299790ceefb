"""The matching plots: numerical λ₀, r₀ on the theory's curves (thesis Figs 3.29, 3.30), and λ₁, r₁ (Figs 2.12, 2.16
with points).

A number that is missing is left out, and the figure says how many were.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from comparison.figures import style
from comparison.rows import First, MatchRow
from theory import contact_parameters

__all__ = ["draw_first_order", "draw_leading", "draw_matching"]


DASHES = ("-", "--", ":", "-.")
"""Of theory's curves, a kind for each load."""


def draw_matching(rows: Sequence[MatchRow], out: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Every matching plot that the rows have data for; returns the files. The finest refinement is drawn."""
    finest: dict[Any, MatchRow] = {}
    for row in rows:
        key = (row.label, row.kappa_over_nu, row.first)
        if key not in finest or row.refine > finest[key].refine:
            finest[key] = row
    shown = list(finest.values())
    files = draw_leading(shown, out, formats) if any(r.lambda0.measured for r in shown) else []
    if any(r.lambda1.measured for r in shown):
        files += draw_first_order(shown, out, formats)
    return files


def draw_leading(
    rows: Sequence[MatchRow], out: Path, formats: Sequence[str] = ("png",), name: str = "leading"
) -> list[Path]:
    """λ₀ and r₀ over κ/ν, theory's curve and numerical points, and the relative differences below."""
    leading = list({(r.label, r.kappa_over_nu): r for r in rows}.values())
    marks = style.marks(r.label for r in leading)
    ratios = np.array([r.kappa_over_nu for r in leading])
    curve = np.geomspace(min(ratios.min() / 2, 0.05), max(ratios.max() * 1.5, 1.0), 400)
    exact = contact_parameters(curve)
    shift = dict(zip(marks, 1.015 ** (np.arange(len(marks)) - (len(marks) - 1) / 2)))
    with style.figure(2, 2, width=style.PAGE, height=4.4, sharex=True, height_ratios=[2, 1]) as (fig, axes):
        for column, (what, symbol) in enumerate((("lambda0", r"$\lambda_0$"), ("r0", r"$r_0/\nu$"))):
            top, below = axes[0, column], axes[1, column]
            values = np.asarray(getattr(exact, what), float)
            shown = values > 0
            top.loglog(curve[shown], values[shown], **style.THEORY)
            below.axhline(0.0, **{**style.THEORY, "label": None})
            for label, mark in marks.items():
                mine = [
                    (r.kappa_over_nu, getattr(r, what))
                    for r in leading
                    if r.label == label and getattr(r, what).measured
                ]
                mine = [(k, c) for k, c in mine if c.theory]  # λ₀ = 0 has no place on a logarithmic axis
                if not mine:
                    continue
                x = np.array([k for k, _ in mine])
                top.plot(x, [c.value for _, c in mine], **mark)
                below.errorbar(
                    x * shift[label],
                    [100 * c.relative() for _, c in mine],
                    yerr=[100 * (c.relative_error() or 0.0) for _, c in mine],
                    elinewidth=0.8,
                    capsize=2,
                    **{**mark, "label": None},
                )
            top.set_ylabel(f"{symbol}  (1)")
            below.set_ylabel("difference  (%)")
            below.set_yscale("symlog", linthresh=1e-2)
            below.set_yticks([-10, -1, -0.1, 0, 0.1, 1, 10], ["−10", "−1", "−0.1", "0", "0.1", "1", "10"])
            compared = [getattr(r, what) for r in leading]
            reach = [abs(c.relative() or 0.0) + (c.relative_error() or 0.0) for c in compared if c.theory]
            limit = max(2.0, 150 * max(reach, default=0.0))  # every point and its bar have their place
            below.set_ylim(-limit, limit)
            below.set_xlabel(r"$\kappa/\nu$  (1)")
            style.panel_label(top, "(a)" if column == 0 else "(b)")
        axes[0, 0].legend()
        _say_what_is_missing(fig, [r for r in leading if not r.lambda0.measured])
        return style.save(fig, out, name, formats)


def draw_first_order(
    rows: Sequence[MatchRow], out: Path, formats: Sequence[str] = ("png",), name: str = "first-order"
) -> list[Path]:
    """λ₁ and r₁ over κ/ν for every (α, ψ, χ, N) among the rows, λ_N and r_N where it is tension alone: a curve of the
    theory each, and the points."""
    asked = [r for r in rows if r.of_first_order]
    # in free flight α differs with κ/ν, and λ₁, r₁ are λ_N, r_N times the axial force: one curve
    firsts: list[First | None] = [*sorted({r.first for r in asked if not r.of_tension_alone})]
    firsts += [None] if any(r.of_tension_alone for r in asked) else []
    marks = style.marks(r.label for r in asked)
    tension = any(first[3] for first in firsts if first)
    curve = np.linspace(0.05, 0.9999, 400)  # λ₁ jumps to 0 at κ/ν = 1
    columns = (
        ("lambda1", r"$\lambda_1$", "lambda_axial", r"$\lambda_N$"),
        ("r1", r"$r_1$", "r_axial", r"$r_N$"),
    )
    with style.figure(1, 2, width=style.PAGE, height=3.6) as (fig, axes):
        for column, (what, symbol, tensile, of_tension) in enumerate(columns):
            axis = axes[column]
            largest = 1.0
            for i, first in enumerate(firsts):
                mine = [r for r in asked if (None if r.of_tension_alone else r.first) == first]
                shown = curve[curve >= 0.8 * min(r.kappa_over_nu for r in mine)]
                if first is None:
                    values = getattr(contact_parameters(shown), tensile)
                    named = r"tension alone: $\lambda_N$, $r_N$"
                else:
                    values = getattr(contact_parameters(shown, *first[:3], axial=first[3]), what)
                    named = f"({', '.join(f'{v:g}' for v in first[: 4 if tension else 3])})".replace("-", "−")
                line = {**style.THEORY, "lw": 0.9, "ls": DASHES[i % len(DASHES)]}
                axis.plot(shown, values, **{**line, "label": named if column == 0 else None})
                for label, mark in marks.items():
                    points = [
                        (r.kappa_over_nu, getattr(r, what), r.axial if first is None else 1.0)
                        for r in mine
                        if r.label == label and getattr(r, what).measured
                    ]
                    if points:
                        axis.errorbar(
                            [k for k, _, _ in points],
                            [c.value / unit for _, c, unit in points],
                            yerr=[(c.error or 0.0) / abs(unit) for _, c, unit in points],
                            elinewidth=0.8,
                            capsize=2,
                            **{**mark, "label": None},
                        )
                        largest = max(largest, *(abs(c.value / unit) for _, c, unit in points))
            axis.set_yscale("symlog", linthresh=1.0) if largest > 30 else None
            axis.set_xlabel(r"$\kappa/\nu$  (1)")
            axis.set_ylabel(f"{', '.join([symbol] * any(firsts) + [of_tension] * (None in firsts))}  (1)")
            style.panel_label(axis, "(a)" if column == 0 else "(b)")
        symbols = r"($\alpha$, $\psi$, $\chi$, $N$)" if tension else r"($\alpha$, $\psi$, $\chi$)"
        axes[0].legend(title=symbols if any(firsts) else None, ncols=1 if None in firsts else 2)
        for mark in [*marks.values(), style.THEORY]:
            axes[1].plot([], [], **mark)
        axes[1].legend()
        _say_what_is_missing(fig, [r for r in asked if not r.lambda1.measured])
        return style.save(fig, out, name, formats)


def _say_what_is_missing(fig: Any, lost: Sequence[MatchRow]) -> None:
    if lost:
        labels = ", ".join(dict.fromkeys(r.label for r in lost))
        rows = f"{len(lost)} row{'s' if len(lost) > 1 else ''}"
        fig.supxlabel(f"left out, no number: {rows} ({labels[:120]})", fontsize=6.5)
