"""Work and precision: the errors of r₀, λ₀ (r₁, λ₁) and the lift over the seconds that they took, a line a method.

It answers which integrator and which contact law, at what cost. A point lies at its error against the theory; below the
error bar of the estimate an error means nothing, so the bar is drawn upwards from the point.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from comparison.figures import style
from comparison.match import MatchRow

__all__ = ["draw_work_precision"]

SMALLEST = 1e-7  # errors below are drawn here


def draw_work_precision(rows: Sequence[MatchRow], out: Path, formats: Sequence[str] = ("png",)) -> list[Path]:
    """``work-precision.png`` (leading order) and ``work-precision-first-order.png``, where at least one method was run
    at two refinements; returns the files."""
    files = []
    for name, first in (("work-precision", False), ("work-precision-first-order", True)):
        mine = [r for r in rows if r.of_first_order == first and r.reason is None and r.seconds]
        if len({(r.label, r.refine) for r in mine}) > len({r.label for r in mine}):
            files += _draw(mine, out, name, first, formats)
    return files


def _draw(rows: Sequence[MatchRow], out: Path, name: str, first: bool, formats: Sequence[str]) -> list[Path]:
    names = ("r1", "lambda1") if first else ("r0", "lambda0")
    least = 1.0 if first else 0.0

    def error(what: str) -> Callable[[MatchRow], float | None]:
        def read(row: MatchRow) -> float | None:
            off = getattr(row, what).relative(least)
            return None if off is None else abs(off)

        return read

    symbols = {"r0": "$r_0$", "lambda0": r"$\lambda_0$", "r1": "$r_1$", "lambda1": r"$\lambda_1$"}
    panels: list[tuple[str, Callable[[MatchRow], float | None]]] = [
        (f"error of {symbols[what]}  (1)", error(what)) for what in names
    ]
    panels.append((r"lift $/(V_0t)$  (1)", lambda row: row.lift))
    cases = sorted({(r.kappa_over_nu, r.first) for r in rows})
    marks = style.marks(r.label for r in rows)
    below = 0.16 * -(-len(marks) // 2) + 0.2
    with style.figure(len(cases), 3, width=style.PAGE, height=2.4 * len(cases) + below, squeeze=False) as (fig, axes):
        for line, (kappa, load) in enumerate(cases):
            for axis, (title, read) in zip(axes[line], panels):
                for label, mark in marks.items():
                    mine = [r for r in rows if (r.label, r.kappa_over_nu, r.first) == (label, kappa, load)]
                    points = [(r.seconds, read(r)) for r in sorted(mine, key=lambda r: r.refine)]
                    drawn = [(s, max(e, SMALLEST)) for s, e in points if s is not None and e is not None]
                    if drawn:
                        axis.plot(*zip(*drawn), **{**mark, "ls": "-", "lw": 0.7})
                axis.set_xscale("log")
                axis.set_yscale("log")
                axis.set_ylabel(title)
                if line == len(cases) - 1:
                    axis.set_xlabel("seconds  (s)")
            heading = rf"$\kappa/\nu$ = {kappa:g}" + (f", ({', '.join(f'{v:g}' for v in load)})" if first else "")
            axes[line][0].set_title(heading, loc="left")
        handles: list[Any] = axes[0][0].get_legend_handles_labels()[0]
        fig.legend(handles, list(marks), loc="outside lower center", ncols=2, fontsize=6.5)
        return style.save(fig, out, name, formats)
