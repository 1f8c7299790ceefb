"""The shown impacts as still pictures in the project's style, for paper and for pages without JavaScript."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.colors import LogNorm

from comparison.figures import style
from comparison.report.impacts import ShownImpact

__all__ = ["draw_acceleration", "draw_impact", "draw_maps"]


def draw_impact(impact: ShownImpact, out: Path) -> list[Path]:
    """Geometry at four instants, and one side's reaction over time."""
    data = impact.data
    x, time = np.array(data["x"]), np.array(data["time"])
    with style.figure(1, 2, width=style.PAGE, height=2.7) as (fig, (left, right)):
        both = np.concatenate([-x[::-1], x])
        for i, k in enumerate(np.linspace(0, time.size - 1, 4).astype(int)):
            gap = np.array(data["gap"][k]) * time[k]
            left.plot(
                both,
                np.concatenate([gap[::-1], gap]),
                color=style.SEQUENCE[i],
                label=rf"$\tau$ = {time[k]:.2g}",
            )
            front = data["front"][k]
            left.plot([-front, front], [0, 0], "|", color=style.SEQUENCE[i], ms=9)
        left.axhline(0.0, **{**style.WALL, "label": None})
        left.set_xlabel(r"$x/l_*$  (1)")
        left.set_ylabel(r"gap $/(V_0t_*)$  (1)")
        left.legend()
        style.panel_label(left, "(a)")
        right.plot(time, data["reaction_theory"], **style.THEORY)
        right.plot(time[::3], np.array(data["reaction"])[::3], **style.HERMITE)
        right.set_xlabel(r"$\tau = t/t_*$  (1)")
        right.set_ylabel(r"one end's reaction / $\mu V_0 l_*/t_*$  (1)")
        right.set_ylim(bottom=0.0)
        right.legend()
        style.panel_label(right, "(b)")
        return style.save(fig, out, f"impact-{impact.shown.name}")


def draw_maps(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """Reaction per length over place and time, a panel an impact."""
    with style.figure(1, len(impacts), width=style.PAGE, height=2.8, sharey=True, squeeze=False) as (
        fig,
        axes,
    ):
        for axis, impact in zip(axes[0], impacts):
            field = impact.data["map"]
            x, root = np.array(field["x"]), np.array(field["root_time"])
            force = np.clip(np.array(field["force"]), 1e-2, None)
            mesh = axis.pcolormesh(
                np.concatenate([-x[::-1], x]),
                root,
                np.concatenate([force[:, ::-1], force], axis=1),
                cmap="viridis",
                norm=LogNorm(1e-2, 1e3),
                shading="nearest",
                rasterized=True,
            )
            axis.set_title(impact.shown.title, fontsize=6.5)
            axis.set_xlabel(r"$x/l_*$  (1)")
            axis.grid(False)
        axes[0][0].set_ylabel(r"$\sqrt{\tau}$  (1)")
        fig.colorbar(mesh, ax=axes[0], label=r"reaction per length / ($\mu V_0/t_*$)")
        return style.save(fig, out, "reaction-map")


def draw_acceleration(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """λ_c/√τ and one end's reaction times √τ of all impacts: theory to first order, and the simulation."""
    with style.figure(1, 2, width=style.PAGE, height=2.6) as (fig, axes):
        for axis, what, power, symbol in zip(
            axes, ("front", "reaction"), (-0.5, 0.5), (r"$\lambda_c/\sqrt{\tau}$", r"$(R/2)\sqrt{\tau}$")
        ):
            for i, impact in enumerate(impacts):
                time = np.array(impact.data["time"])
                colour = style.SEQUENCE[i]
                axis.plot(time, np.array(impact.data[f"{what}_theory"]) * time**power, color=colour)
                axis.plot(
                    time[::3],
                    (np.array(impact.data[what]) * time**power)[::3],
                    **{**style.HERMITE, "color": colour, "label": impact.shown.title},
                )
            axis.set_xlabel(r"$\tau = t/t_*$  (1)")
            axis.set_ylabel(f"{symbol}  (1)")
        axes[0].legend(fontsize=6)
        return style.save(fig, out, "acceleration")
