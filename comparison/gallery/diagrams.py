"""The thesis's sketches, drawn clean: the problem (2.1), kinds of contact (2.4–2.6), statics (3.1, 3.2, 3.4), nodes
and middles (3.22).
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY, key_below
from hermite_fe.beam import shape_functions

ARROW = {"arrowstyle": "-|>", "color": style.COLOURS["vermilion"], "lw": 1.2, "shrinkA": 0, "shrinkB": 0}
THIN = {"arrowstyle": "-|>", "color": "black", "lw": 0.7, "shrinkA": 0, "shrinkB": 0}
BOTH = {"arrowstyle": "<|-|>", "color": "black", "lw": 0.6, "shrinkA": 0, "shrinkB": 0}


def bare(axis: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    """An axis without frame for a sketch; y grows downwards, into the wall."""
    axis.set_xlim(*x)
    axis.set_ylim(y[1], y[0])
    axis.axis("off")


def arrow(axis: Axes, start: tuple[float, float], end: tuple[float, float], line_style: dict[str, object]) -> None:
    axis.annotate("", xy=end, xytext=start, arrowprops=line_style)


def ground(axis: Axes, x: tuple[float, float], level: float = 0.0, deep: float = 0.12) -> None:
    """A hatched wall below ``level``."""
    axis.fill_between(x, level, level + deep, facecolor="#DDDDDD", edgecolor=style.COLOURS["grey"], hatch="////", lw=0)
    axis.plot(x, (level, level), color="black", lw=0.8)


@item(
    "fig-2.1",
    "The problem",
    group="diagrams",
    caption="A beam of natural curvature K arrives at a rigid wall with velocity V₀; y is positive into the wall.",
)
def problem(sheet: Sheet) -> None:
    x = np.linspace(-2.0, 2.0, 101)
    with sheet.figure(width=4.2, height=2.0) as (_, axis):
        bare(axis, (-2.6, 2.6), (-1.35, 0.45))
        ground(axis, (-2.3, 2.3), 0.0, 0.16)
        sheet.line(axis, x, -0.18 - 0.2 * x**2, series="beam", color=style.COLOURS["blue"], lw=2.5)
        for place in (-1.2, -0.4, 0.4, 1.2):
            base = -0.18 - 0.2 * place**2
            arrow(axis, (place, base - 0.42), (place, base - 0.06), ARROW)
        axis.text(0.48, -0.5, "$V_0$", color=style.COLOURS["vermilion"])
        arrow(axis, (0.0, 0.0), (2.55, 0.0), THIN)
        arrow(axis, (0.0, -1.2), (0.0, 0.4), THIN)
        axis.text(2.47, -0.07, "$x$")
        axis.text(0.08, 0.36, "$y$")
        axis.text(1.75, -0.62, "$EI$, $\\mu$, $K$", ha="left")
        axis.text(-2.25, 0.33, "rigid wall", fontsize=7)


def contact_sketch(sheet: Sheet, edges: tuple[float, ...], symbol: str, uniform: bool) -> None:
    """Beam on the wall with its reactions."""
    edge = max(edges)
    x = np.linspace(-2.0, 2.0, 201)
    y = -0.72 * np.clip((np.abs(x) - edge) / (2.0 - edge), 0.0, None) ** 2
    with sheet.figure(width=4.0, height=1.7) as (_, axis):
        bare(axis, (-2.4, 2.6), (-0.95, 0.75))
        ground(axis, (-2.2, 2.2), 0.0, 0.1)
        sheet.line(axis, x, y - 0.02, series="beam", color=style.COLOURS["blue"], lw=2.2)
        places = np.linspace(-edge, edge, 9) if uniform else np.array(edges)
        for place in places:
            arrow(axis, (place, 0.42 if uniform else 0.55), (place, 0.01), ARROW)
        if uniform:
            axis.plot([-edge, edge], [0.42, 0.42], color=style.COLOURS["vermilion"], lw=0.8)
            axis.text(0.0, 0.62, symbol, ha="center", color=style.COLOURS["vermilion"])
        else:
            for place in edges:
                axis.text(place + 0.07, 0.52, symbol, color=style.COLOURS["vermilion"])
        arrow(axis, (-2.3, 0.0), (2.5, 0.0), THIN)
        axis.text(2.42, -0.08, r"$\xi$")
        if edge > 0.0:
            for place, name in ((edge, r"$\lambda_c(\tau)$"), (-edge, r"$-\lambda_c(\tau)$")):
                axis.plot([place, place], [-0.5, -0.02], color="black", lw=0.5, ls=":")
                axis.text(place, -0.55, name, ha="center", va="bottom", fontsize=7.5)  # clear of the beam
        sheet.record(axis, places, np.zeros(places.size), "reactions")


@item(
    "fig-2.4",
    "Discrete contact",
    group="diagrams",
    caption="Discrete contact at ξ = 0 with the reaction R̃(τ): κ/ν ≥ 1.",
)
def discrete(sheet: Sheet) -> None:
    contact_sketch(sheet, (0.0,), r"$\tilde R(\tau)$", False)


@item(
    "fig-2.5",
    "Double contact",
    group="diagrams",
    caption=("Contact with two concentrated reactions, half of R̃(τ) each, at ξ = ±λ_c(τ): κ/ν < 1 at leading order."),
)
def double(sheet: Sheet) -> None:
    contact_sketch(sheet, (-0.9, 0.9), r"$\frac{1}{2}\tilde R(\tau)$", False)


@item(
    "fig-2.6",
    "Continuous contact",
    group="diagrams",
    caption="Continuous contact on |ξ| ≤ λ_c(τ) with a uniform reaction r̃: first order, α + ψ > 0.",
)
def continuous(sheet: Sheet) -> None:
    contact_sketch(sheet, (-0.9, 0.9), r"$\tilde r$", True)


@item(
    "fig-3.1",
    "Degrees of freedom of an element",
    group="diagrams",
    caption="Euler–Bernoulli element of length l_e with deflections w and slopes θ at both ends (3.1.1).",
)
def element(sheet: Sheet) -> None:
    xi = np.linspace(0.0, 1.0, 101)
    dofs = np.array([0.32, -0.9, 0.12, 0.7])
    bent = -shape_functions(xi, 1.0) @ dofs
    with sheet.figure(width=4.2, height=2.6) as (_, axis):
        bare(axis, (-0.2, 1.5), (-0.75, 0.28))
        axis.set_aspect("equal")
        axis.plot([0, 1], [0, 0], color=style.COLOURS["grey"], lw=0.8, ls="--")
        sheet.line(axis, xi, bent, series="element", color=style.COLOURS["blue"], lw=2.2)
        for place, name in ((0.0, "1"), (1.0, "2")):
            high = bent[0] if place == 0.0 else bent[-1]
            arrow(axis, (place, 0.0), (place, float(high)), ARROW)
            side = -1.0 if place == 0.0 else 1.0
            axis.text(place + 0.03 * side, high / 2, f"$w_{name}$", ha="right" if side < 0 else "left", va="center")
            slope = -dofs[1] if place == 0.0 else -dofs[3]
            along = 0.3 * np.array([1.0, slope]) / np.hypot(1.0, slope)
            axis.plot([place, place + 0.3], [high, high], color="black", lw=0.5, ls=":")
            axis.plot([place, place + along[0]], [high, high + along[1]], color="black", lw=0.5)
            angles = np.linspace(0.0, np.arctan(slope), 21)
            axis.plot(place + 0.24 * np.cos(angles), high + 0.24 * np.sin(angles), color="black", lw=0.8)
            axis.text(place + 0.33, high + 0.14 * slope, rf"$\theta_{name}$", ha="left", va="center")
            axis.text(place, 0.09, f"({name})", ha="center", va="center", fontsize=7)
        axis.plot([0, 1], [bent[0], bent[-1]], "o", ms=4, color=style.COLOURS["blue"])
        arrow(axis, (0.0, 0.2), (1.0, 0.2), BOTH)
        axis.text(0.5, 0.17, "$l_e$", ha="center", va="bottom")
        arrow(axis, (0.0, 0.0), (1.25, 0.0), THIN)
        axis.text(1.22, -0.05, "$x$")


def beam_and_moment(sheet: Sheet, moment: np.ndarray, label: str, sign: str) -> Axes:
    """Upper axis for the beam, lower one with the bending moment over x/L."""
    x = np.linspace(0.0, 1.0, moment.size)
    axes: list[Axes]
    with sheet.figure(2, 1, width=3.8, height=2.5, sharex=True) as (_, axes):
        bare(axes[0], (-0.12, 1.12), (-0.7, 0.45))
        axes[0].plot([0, 1], [0, 0], color=style.COLOURS["blue"], lw=3)
        axes[1].axhline(0.0, color="black", lw=0.7)
        axes[1].set_xlabel("$x/L$  (1)")
        axes[1].set_ylabel("$M/(PL)$  (1)")
        axes[1].fill_between(x, 0.0, moment, color=style.COLOURS["sky"], alpha=0.4, lw=0)
        sheet.line(axes[1], x, moment, series="bending moment", **THEORY)
        k = int(np.argmax(np.abs(moment)))
        axes[1].annotate(
            label,
            (x[k], moment[k]),
            xytext=(4, 2 if moment[k] > 0 else 6),
            textcoords="offset points",
            ha="left" if x[k] < 0.9 else "right",
        )
        axes[1].text(0.5 if k != moment.size // 2 else 0.35, moment[k] / 4, sign, ha="center", va="center", fontsize=10)
    return axes[0]


@item(
    "fig-3.2",
    "A beam on two supports",
    group="diagrams",
    caption="Beam on two supports under a force P in its middle, with its bending moment (largest PL/4).",
)
def supported(sheet: Sheet) -> str:
    x = np.linspace(0.0, 1.0, 101)
    axis = beam_and_moment(sheet, 0.5 * np.minimum(x, 1.0 - x), r"$\frac{PL}{4}$", "+")
    for place in (0.0, 1.0):
        axis.plot([place, place - 0.04, place + 0.04, place], [0.04, 0.3, 0.3, 0.04], color="black", lw=0.8)
        axis.plot([place - 0.06, place + 0.06], [0.34, 0.34], color="black", lw=0.8)
    arrow(axis, (0.5, -0.6), (0.5, -0.04), ARROW)
    axis.text(0.52, -0.45, "$P$", color=style.COLOURS["vermilion"])
    return (
        'The thesis calls it "fixed at both ends"; its moment and its solution (3.1.12) are those of simple supports.'
    )


@item(
    "fig-3.4",
    "A cantilever",
    group="diagrams",
    caption=(
        "Cantilever under a force P at its free end x = 0, with its bending moment (largest PL, at the clamp x = L)."
    ),
)
def cantilever(sheet: Sheet) -> str:
    x = np.linspace(0.0, 1.0, 101)
    axis = beam_and_moment(sheet, -x, r"$-PL$", "−")
    axis.fill_between(
        [1.0, 1.06], -0.35, 0.35, facecolor="#DDDDDD", edgecolor=style.COLOURS["grey"], hatch="////", lw=0
    )
    axis.plot([1.0, 1.0], [-0.35, 0.35], color="black", lw=0.9)
    arrow(axis, (0.0, -0.6), (0.0, -0.04), ARROW)
    axis.text(0.02, -0.45, "$P$", color=style.COLOURS["vermilion"])
    return (
        "The thesis's text and its caption disagree about the clamped end; its solution (3.1.15) is clamped at x "
        "= L, as drawn."
    )


@item(
    "fig-3.22",
    "Contact at nodes and at middles",
    group="diagrams",
    caption=(
        "Nodes (circles) and middles (crosses) of the elements next to the centre of a bent beam at first "
        "contact at nodes, and when the middle method closes: the central node has then entered the wall by "
        "KΔx²/8."
    ),
)
def nodes_and_middles(sheet: Sheet) -> str:
    x = np.linspace(-2.0, 2.0, 161)
    nodes, middles = np.arange(-2, 3, dtype=float), np.arange(-1.5, 2.0)
    with sheet.figure(1, 2, width=style.PAGE, height=2.3) as (fig, axes):
        for axis, shift, letter, name in zip(axes, (0.0, 0.25), "ab", ("node method", "middle method")):
            bare(axis, (-2.3, 2.3), (-4.3, 1.0))
            ground(axis, (-2.2, 2.2), 0.0, 0.35)
            sheet.line(axis, x, shift - x**2, series="beam", color=style.COLOURS["blue"], lw=1.6)
            sheet.line(
                axis, nodes, shift - nodes**2, series="nodes", color=style.COLOURS["blue"], ls="", marker="o", ms=5
            )
            sheet.line(
                axis,
                middles,
                shift - middles**2,
                series="middles",
                color=style.COLOURS["vermilion"],
                ls="",
                marker="x",
                ms=5.5,
                mew=1.4,
            )
            axis.text(-2.2, 0.95, name, fontsize=7.5, va="bottom")
            sheet.panels[id(axis)] = letter
        key_below(fig, axes[1])
    return (
        "With the Hermite shape functions a middle lies on the bent beam; the thesis's estimate of twice this "
        "penetration joins the nodes by straight lines."
    )
