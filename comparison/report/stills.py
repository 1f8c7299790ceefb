"""The shown impacts as still pictures in the project's style, for paper and for pages without JavaScript."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import LogNorm
from numpy.typing import NDArray

from comparison.figures import style
from comparison.report.impacts import Shown, ShownImpact, theory_of

__all__ = ["draw_acceleration", "draw_impact", "draw_maps", "draw_noise", "grouped"]

Array = NDArray[np.float64]


def grouped(impacts: Sequence[ShownImpact]) -> dict[Shown, list[ShownImpact]]:
    """The runs of each impact, in order."""
    found: dict[Shown, list[ShownImpact]] = {}
    for impact in impacts:
        found.setdefault(impact.shown, []).append(impact)
    return found


def _both(x: Array, values: Array) -> tuple[Array, Array]:
    return np.concatenate([-x[::-1], x]), np.concatenate([values[::-1], values])


def draw_impact(shown: Shown, runs: Sequence[ShownImpact], out: Path) -> list[Path]:
    """Shape at four instants and one end's reaction over time: theory's lines, every method's points."""
    theory = theory_of(shown)
    x, time = np.array(theory["x"]), np.array(theory["time"])
    marks = style.marks(run.label for run in runs)
    with style.figure(1, 2, width=style.PAGE, height=2.9) as (fig, (left, right)):
        for i, k in enumerate(np.linspace(0, time.size - 1, 4).astype(int)):
            name = rf"$\tau$ = {time[k]:.2g}"
            left.plot(*_both(x, np.array(theory["gap"][k]) * time[k]), color=style.SEQUENCE[i], lw=1.0, label=name)
            for j, run in enumerate(runs):
                gap = np.array(run.data["gap"][k], float) * time[k]
                mark = {**marks[run.label], "color": style.SEQUENCE[i], "label": None, "ms": 2.5}
                left.plot(*(v[3 * j :: 12] for v in _both(x, gap)), **mark)
        left.axhline(0.0, **{**style.WALL, "label": None})
        left.set_xlabel(r"$x/l_*$  (1)")
        left.set_ylabel(r"gap $/(V_0t_*)$  (1)")
        left.legend()
        style.panel_label(left, "(a)")
        right.plot(time, theory["reaction"], **style.THEORY)
        for j, run in enumerate(runs):
            right.plot(time[j::3], np.array(run.data["reaction"])[j::3], **marks[run.label])
        right.set_xlabel(r"$\tau = t/t_*$  (1)")
        right.set_ylabel(r"one end's reaction / $\mu V_0 l_*/t_*$  (1)")
        right.set_ylim(bottom=0.0)
        right.legend()
        style.panel_label(right, "(b)")
        return style.save(fig, out, f"impact-{shown.name}")


def draw_maps(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """Reaction per length over place and time: an impact a column, a method a row."""
    groups = grouped(impacts)
    labels = list(dict.fromkeys(i.label for i in impacts))
    with style.figure(
        len(labels), len(groups), width=style.PAGE, height=1.9 * len(labels) + 0.4, sharey=True, squeeze=False
    ) as (fig, axes):
        mesh = None
        for column, (shown, runs) in enumerate(groups.items()):
            axes[0][column].set_title(shown.title, fontsize=6.5)
            axes[-1][column].set_xlabel(r"$x/l_*$  (1)")
            for run in runs:
                axis = axes[labels.index(run.label)][column]
                field = run.data["map"]
                force = np.clip(np.array(field["force"]), 1e-2, None)
                x = np.array(field["x"])
                mesh = axis.pcolormesh(
                    np.concatenate([-x[::-1], x]),
                    np.array(field["root_time"]),
                    np.concatenate([force[:, ::-1], force], axis=1),
                    cmap="viridis",
                    norm=LogNorm(1e-2, 1e3),
                    shading="nearest",
                    rasterized=True,
                )
                axis.grid(False)
        for row, label in enumerate(labels):
            axes[row][0].set_ylabel(f"{label}\n" + r"$\sqrt{\tau}$  (1)")
        assert mesh is not None  # there is an impact, or nobody would draw
        fig.colorbar(mesh, ax=axes, label=r"reaction per length / ($\mu V_0/t_*$)")
        return style.save(fig, out, "reaction-map")


def draw_acceleration(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """λ_c/√τ and one end's reaction times √τ of all impacts: theory to first order, and every method."""
    marks = style.marks(i.label for i in impacts)
    with style.figure(1, 2, width=style.PAGE, height=2.8) as (fig, axes):
        for axis, what, power, symbol in zip(
            axes, ("front", "reaction"), (-0.5, 0.5), (r"$\lambda_c/\sqrt{\tau}$", r"$(R/2)\sqrt{\tau}$")
        ):
            for i, (shown, runs) in enumerate(grouped(impacts).items()):
                theory, colour = theory_of(shown), style.SEQUENCE[i]
                time = np.array(theory["time"])
                axis.plot(
                    time,
                    np.array(theory[what]) * time**power,
                    color=colour,
                    label=shown.title if what == "front" else None,
                )
                for j, run in enumerate(runs):
                    mark = {**marks[run.label], "color": colour, "label": None}
                    axis.plot(time[2 * j :: 7], (np.array(run.data[what]) * time**power)[2 * j :: 7], **mark)
            axis.set_xlabel(r"$\tau = t/t_*$  (1)")
            axis.set_ylabel(f"{symbol}  (1)")
        for mark in marks.values():
            axes[1].plot([], [], **{**mark, "color": style.COLOURS["black"]})
        axes[0].legend(fontsize=6)
        axes[1].legend(fontsize=6)
        return style.save(fig, out, "acceleration")


def draw_noise(before: ShownImpact, after: ShownImpact, out: Path) -> list[Path]:
    """One end's reaction over theory's, and the gap of the zone at the end: the thesis's settings and today's."""
    theory = theory_of(after.shown)
    time, x = np.array(theory["time"]), np.array(theory["x"])
    drawn: list[tuple[ShownImpact, Mapping[str, Any]]] = [
        (before, {**style.OLD, "label": before.label}),
        (after, {"color": style.COLOURS["blue"], "lw": 1.2, "label": after.label}),
    ]
    with style.figure(1, 2, width=style.PAGE, height=2.7) as (fig, (left, right)):
        front = theory["front"][-1]
        for run, line in drawn:
            left.plot(np.sqrt(time), np.array(run.data["reaction"]) / np.array(theory["reaction"]), **line)
            right.plot(x / front, 1000.0 * np.array(run.data["gap"][-1], float), **line)
        left.axhline(1.0, **style.THEORY)
        right.plot(x / front, 1000.0 * np.array(theory["gap"][-1]), **style.THEORY)
        left.set_xlabel(r"$\sqrt{\tau}$  (1)")
        left.set_ylabel("reaction / theory  (1)")
        left.legend()
        right.set_xlim(0.0, 1.3)
        right.set_ylim(-3.0, 25.0)
        right.set_xlabel(r"$x/\lambda_c$  (1)")
        right.set_ylabel(r"gap  (‰ of $V_0t$)")
        style.panel_label(left, "(a)")
        style.panel_label(right, "(b)")
        return style.save(fig, out, "noise")
