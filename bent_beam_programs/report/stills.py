"""The shown impacts as still pictures in the project's style, for paper and for pages without JavaScript."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.colors import LogNorm

from bent_beam_programs.report.impacts import Shown, ShownImpact, theory_of
from comparison.figures import style


def grouped(impacts: Sequence[ShownImpact]) -> dict[Shown, list[ShownImpact]]:
    """The runs of each impact, in order."""
    return {shown: [i for i in impacts if i.shown == shown] for shown in dict.fromkeys(i.shown for i in impacts)}


def draw_maps(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """Reaction per length over place and time: an impact a column, a method a row. There is at least one impact."""
    groups = grouped(impacts)
    labels = list(dict.fromkeys(i.label for i in impacts))
    size = {"width": style.PAGE, "height": 1.9 * len(labels) + 0.4}
    with style.figure(len(labels), len(groups), **size, sharey=True, squeeze=False) as (fig, axes):
        for column, (shown, runs) in enumerate(groups.items()):
            axes[0][column].set_title(shown.title, fontsize=6.5)
            axes[-1][column].set_xlabel(r"$x/l_*$  (1)")
            for run in runs:
                axis, field = axes[labels.index(run.label)][column], run.data["map"]
                x, force = np.array(field["x"]), np.clip(np.array(field["force"]), 1e-2, None)
                mesh = axis.pcolormesh(
                    np.concatenate([-x[::-1], x]), np.array(field["root_time"]), np.hstack([force[:, ::-1], force]),
                    cmap="viridis", norm=LogNorm(1e-2, 1e3), shading="nearest", rasterized=True,
                )  # fmt: skip
                axis.grid(False)
        for row, label in zip(axes, labels):
            row[0].set_ylabel(f"{label}\n" + r"$\sqrt{\tau}$  (1)")
        fig.colorbar(mesh, ax=axes, label=r"reaction per length / ($\mu V_0/t_*$)")
        return style.save(fig, out, "reaction-map")


def draw_acceleration(impacts: Sequence[ShownImpact], out: Path) -> list[Path]:
    """λ_c/√τ and one end's reaction times √τ of all impacts: theory to first order, and every method."""
    marks = style.marks(i.label for i in impacts)
    with style.figure(1, 2, width=style.PAGE, height=2.8) as (fig, axes):
        drawn = (("front", -0.5, r"$\lambda_c/\sqrt{\tau}$"), ("reaction", 0.5, r"$(R/2)\sqrt{\tau}$"))
        for axis, (what, power, symbol) in zip(axes, drawn):
            for i, (shown, runs) in enumerate(grouped(impacts).items()):
                theory, dash = theory_of(shown), ("-", "--", ":")[i % 3]
                time = np.array(theory["time"])
                line = {**style.THEORY, "ls": dash, "label": shown.title if what == "front" else None}
                axis.plot(time, np.array(theory[what]) * time**power, **line)
                for j, run in enumerate(runs):
                    mark = {**marks[run.label], "label": None}
                    axis.plot(time[2 * j :: 7], (np.array(run.data[what]) * time**power)[2 * j :: 7], **mark)
            axis.set(xlabel=r"$\tau = t/t_*$  (1)", ylabel=f"{symbol}  (1)")
        for mark in marks.values():
            axes[1].plot([], [], **mark)
        fig.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=3, fontsize=6)
        axes[1].legend(fontsize=6)
        return style.save(fig, out, "acceleration")
