"""The matching plots: numerical λ₀, r₀ on the theory's curves (thesis Figs 3.29, 3.30), and λ₁, r₁ (Figs 2.12, 2.16
with points).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from comparison.figures import style
from comparison.matching import MatchRow
from theory import contact_parameters

__all__ = ["draw_first_order", "draw_leading", "draw_matching"]


def draw_matching(rows: Sequence[MatchRow], out: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """Every matching plot that the rows have data for; returns the files."""
    files = draw_leading(rows, out, formats) if rows else []
    if any(r.lambda1 is not None for r in rows):
        files += draw_first_order(rows, out, formats)
    return files


def draw_leading(
    rows: Sequence[MatchRow], out: Path, formats: Sequence[str] = ("png",), name: str = "leading"
) -> list[Path]:
    """λ₀ and r₀ over κ/ν, theory's curve and numerical points, and the relative differences below."""
    leading = list({(r.path, r.kappa_over_nu): r for r in rows}.values())
    ratios = np.array([r.kappa_over_nu for r in leading])
    curve = np.geomspace(min(ratios.min() / 2, 0.05), max(ratios.max() * 1.5, 1.0), 400)
    exact = contact_parameters(curve)
    with style.figure(2, 2, width=style.PAGE, height=4.2, sharex=True, height_ratios=[2, 1]) as (fig, axes):
        for column, (what, symbol) in enumerate((("lambda0", r"$\lambda_0$"), ("r0", r"$r_0/\nu$"))):
            top, below = axes[0, column], axes[1, column]
            values = np.asarray(getattr(exact, what), float)
            shown = values > 0
            top.loglog(curve[shown], values[shown], **style.THEORY)
            below.axhline(0.0, **{**style.THEORY, "label": None})
            for path, marker in style.MARKERS.items():
                mine = [r for r in leading if r.path == path and getattr(r, f"{what}_theory") > 0]
                if not mine:
                    continue
                x = [r.kappa_over_nu for r in mine]
                y = np.array([getattr(r, what) for r in mine])
                e = np.array([getattr(r, f"{what}_error") for r in mine])
                t = np.array([getattr(r, f"{what}_theory") for r in mine])
                top.plot(x, y, **marker)
                below.errorbar(
                    x, 100 * (y / t - 1), yerr=100 * e / t, elinewidth=0.8, capsize=2, **{**marker, "label": None}
                )
            top.set_ylabel(f"{symbol}  (1)")
            below.set_ylabel("difference  (%)")
            below.set_yscale("symlog", linthresh=1e-3)
            below.set_yticks([-1, -1e-2, 0, 1e-2, 1], ["−1", "−0.01", "0", "0.01", "1"])
            below.set_ylim(-2, 2)
            below.set_xlabel(r"$\kappa/\nu$  (1)")
            style.panel_label(top, "(a)" if column == 0 else "(b)")
        axes[0, 0].legend()
        return style.save(fig, out, name, formats)


def draw_first_order(
    rows: Sequence[MatchRow], out: Path, formats: Sequence[str] = ("png",), name: str = "first-order"
) -> list[Path]:
    """λ₁ and r₁ over κ/ν for every (α, ψ, χ) among the rows: a curve of the theory each, and the numerical points."""
    firsts = sorted({(r.alpha, r.psi, r.chi) for r in rows if r.lambda1 is not None})
    curve = np.linspace(0.05, 0.9999, 400)  # λ₁ jumps to 0 at κ/ν = 1
    with style.figure(1, 2, width=style.PAGE, height=3.4) as (fig, axes):
        for column, (what, symbol) in enumerate((("lambda1", r"$\lambda_1$"), ("r1", r"$r_1$"))):
            axis = axes[column]
            largest = 1.0
            for i, first in enumerate(firsts):
                colour = style.SEQUENCE[i % len(style.SEQUENCE)]
                mine = [r for r in rows if r.lambda1 is not None and (r.alpha, r.psi, r.chi) == first]
                shown = curve[curve >= 0.8 * min(r.kappa_over_nu for r in mine)]
                values = getattr(contact_parameters(shown, *first), what)
                label = "({:g}, {:g}, {:g})".format(*first) if column == 0 else None
                axis.plot(shown, values, lw=1.1, color=colour, label=label)
                for path, marker in style.MARKERS.items():
                    points = [r for r in mine if r.path == path]
                    if points:
                        axis.errorbar(
                            [r.kappa_over_nu for r in points],
                            [getattr(r, what) for r in points],
                            yerr=[getattr(r, f"{what}_error") for r in points],
                            elinewidth=0.8,
                            capsize=2,
                            **{**marker, "color": colour, "label": None},
                        )
                        largest = max(largest, *(abs(getattr(r, what)) for r in points))
            axis.set_yscale("symlog", linthresh=1.0) if largest > 30 else None
            axis.set_xlabel(r"$\kappa/\nu$  (1)")
            axis.set_ylabel(f"{symbol}  (1)")
            style.panel_label(axis, "(a)" if column == 0 else "(b)")
        axes[0].legend(title=r"($\alpha$, $\psi$, $\chi$)", ncols=2)
        for path, marker in style.MARKERS.items():
            if any(r.path == path and r.lambda1 is not None for r in rows):
                axes[1].plot([], [], **{**marker, "color": style.COLOURS["black"]})
        axes[1].plot([], [], **style.THEORY)
        axes[1].legend()
        return style.save(fig, out, name, formats)
