"""Lines and panels that several items share."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.studies.outcome import Outcome
from comparison.studies.panels import impulse, reaction, theory_first
from theory import ImpactFields

__all__ = ["BEAM", "FREE", "THEORY", "beam_panel", "dashed", "key_below", "one_panel", "reaction_and_impulse"]

THEORY = {k: v for k, v in style.THEORY.items() if k != "label"}
BEAM = THEORY
FREE: dict[str, Any] = {"color": style.COLOURS["grey"], "lw": 1.0, "ls": "--"}
FAST: dict[str, Any] = {"color": style.COLOURS["sky"], "lw": 1.0, "ls": "-."}


def dashed(colour: str) -> dict[str, Any]:
    """A dashed line in a named colour."""
    return {"color": style.COLOURS[colour], "lw": 1.0, "ls": "--"}


def key_below(fig: Any, axis: Axes, columns: int = 3, **line_style: Any) -> None:
    """One legend under the whole figure, from one axis."""
    handles, labels = theory_first(axis)
    fig.legend(handles, labels, loc="outside lower center", ncols=min(columns, len(labels)), **line_style)


def one_panel(
    sheet: Sheet,
    panel: Callable[..., None],
    outcomes: Sequence[Outcome],
    *,
    columns: int = 2,
    height: float = 3.0,
    width: float = 4.6,
    **options: Any,
) -> None:
    """A figure of one panel of :mod:`comparison.studies.panels` with its legend below."""
    with sheet.figure(width=width, height=height) as (fig, axis):
        panel(sheet, axis, outcomes, **options)
        key_below(fig, axis, columns, fontsize=7.0)


def reaction_and_impulse(sheet: Sheet, outcomes: Sequence[Outcome]) -> None:
    """The reaction, averaged, as the thesis shows it, and its impulse, which lets 1/√t be judged."""
    with sheet.figure(1, 2, width=style.PAGE, height=3.0) as (fig, axes):
        for axis, letter, panel in zip(axes, "ab", (reaction, impulse)):
            panel(sheet, axis, outcomes)
            sheet.panel(axis, letter)
        key_below(fig, axes[1], 4, fontsize=7.0)


def beam_panel(
    sheet: Sheet,
    axis: Axes,
    fields: ImpactFields,
    tau: float,
    *,
    reach: float = 1.5,
    fast: bool = True,
    limits: tuple[float, float] | None = None,
    points: int = 241,
) -> None:
    """Free motion, fast layer and beam over ξ at one time; contact points marked on the wall."""
    xi = np.linspace(-reach, reach, points)
    front = float(fields.half_contact_length(tau))
    xi = np.unique(np.concatenate([xi, [-front, front]]))
    free = fields.slow_motion(xi, tau).deflection
    layer = fields.fast_layer(xi, tau).deflection
    axis.set_xlabel(r"$\xi$  (1)")
    axis.set_ylabel(r"deflection $w$  (1)")
    if limits is None:
        low = float(min((free - layer).min(), free.min()))
        limits = (low - 0.05, 1.15 * float(max(free.max(), layer.max() if fast else 0.0)))
    sheet.line(axis, xi, free, series="free motion", **FREE)
    if fast:
        sheet.line(axis, xi, layer, series=r"fast layer $\eta$", **FAST)
    sheet.line(axis, xi, free - layer, series="beam", **BEAM)
    places = np.unique([-front, front])
    sheet.line(
        axis,
        places,
        np.zeros(places.size),
        series="contact points",
        color=style.COLOURS["vermilion"],
        ls="",
        marker="v",
        ms=5,
        clip_on=False,
    )
    axis.set_xlim(-reach, reach)
    style.wall_below(axis, *limits)
