"""Sketches of the thesis: the problem (2.1), contact (2.4–2.6), statics (3.1, 3.2, 3.4), nodes and middles (3.22)."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam_programs.thesis.sheet import Sheet, item, items
from comparison.figures import style
from hermite_fe.beam import shape_functions

BLUE, RED, GREY = (style.COLOURS[name] for name in ("blue", "vermilion", "grey"))
Point = tuple[float, float]


def bare(axis: Axes, x: Point, y: Point) -> None:
    """An axis without frame for a sketch; y grows downwards, into the wall."""
    axis.set(xlim=x, ylim=y[::-1])
    axis.axis("off")


def arrow(axis: Axes, start: Point, end: Point, colour: str = "black", ends: str = "-|>") -> None:
    """A force (red, thicker) or an axis (black)."""
    width = 1.2 if colour == RED else 0.7
    line: dict[str, Any] = {"arrowstyle": ends, "color": colour, "lw": width, "shrinkA": 0, "shrinkB": 0}
    axis.annotate("", xy=end, xytext=start, arrowprops=line)


def stroke(axis: Axes, x: Any, y: Any, colour: str = "black", width: float = 0.8, **drawn: Any) -> None:
    axis.plot(x, y, color=colour, lw=width, **drawn)


def ground(axis: Axes, x: Point, deep: float) -> None:
    """A hatched wall below y = 0."""
    axis.fill_between(x, 0.0, deep, facecolor="#DDDDDD", edgecolor=GREY, hatch="////", lw=0)
    stroke(axis, x, (0.0, 0.0))


@item("fig-2.1")
def problem(sheet: Sheet) -> None:
    """The problem

    A beam of natural curvature K under the load p arrives at a rigid wall with velocity V₀; the wall's reaction r
    pushes back. y is positive into the wall.
    """
    x = np.linspace(-2.0, 2.0, 101)
    with sheet.figure(width=4.2, height=2.0) as (_, axis):
        bare(axis, (-2.6, 2.6), (-1.35, 0.45))
        ground(axis, (-2.3, 2.3), 0.16)
        sheet.line(axis, x, -0.18 - 0.2 * x**2, series="beam", color=BLUE, lw=2.5)
        for place in (-1.2, -0.4, 0.4, 1.2):
            base = -0.18 - 0.2 * place**2
            arrow(axis, (place, base - 0.36), (place, base - 0.06), RED)
        axis.text(0.48, -0.5, "$p$", color=RED)
        for place in (-0.2, 0.2):
            arrow(axis, (place, 0.32), (place, 0.02), RED)
        axis.text(0.28, 0.3, "$r$", color=RED)
        arrow(axis, (1.9, -1.25), (1.9, -1.0), GREY)
        axis.text(1.98, -1.08, "$V_0$")
        arrow(axis, (0.0, 0.0), (2.55, 0.0))
        arrow(axis, (0.0, -1.2), (0.0, 0.4))
        axis.text(2.47, -0.07, "$x$")
        axis.text(0.08, 0.36, "$y$")
        axis.text(1.75, -0.62, "$EI$, $\\mu$, $K$")
        axis.text(-2.25, 0.33, "rigid wall", fontsize=7)


def contact_sketch(sheet: Sheet, edge: float, symbol: str, uniform: bool = False) -> None:
    """A beam on the wall with its reactions at ±edge, or uniform between."""
    x = np.linspace(-2.0, 2.0, 201)
    y = -0.72 * np.clip((np.abs(x) - edge) / (2.0 - edge), 0.0, None) ** 2
    places = np.linspace(-edge, edge, 9) if uniform else np.unique([-edge, edge])
    with sheet.figure(width=4.0, height=1.7) as (_, axis):
        bare(axis, (-2.4, 2.6), (-0.95, 0.75))
        ground(axis, (-2.2, 2.2), 0.1)
        sheet.line(axis, x, y - 0.02, series="beam", color=BLUE, lw=2.2)
        for place in places:
            arrow(axis, (place, 0.42 if uniform else 0.55), (place, 0.01), RED)
            if not uniform:
                axis.text(place + 0.07, 0.52, symbol, color=RED)
        if uniform:
            stroke(axis, [-edge, edge], [0.42, 0.42], RED)
            axis.text(0.0, 0.62, symbol, ha="center", color=RED)
        arrow(axis, (-2.3, 0.0), (2.5, 0.0))
        axis.text(2.42, -0.08, r"$\xi$")
        if edge > 0.0:
            for side, name in ((1.0, r"$\lambda_c(\tau)$"), (-1.0, r"$-\lambda_c(\tau)$")):
                stroke(axis, [side * edge] * 2, [-0.5, -0.02], width=0.5, ls=":")
                axis.text(side * edge, -0.55, name, ha="center", va="bottom", fontsize=7.5)  # clear of the beam
        sheet.record(axis, places, np.zeros(places.size), "reactions")


items(__name__, contact_sketch, (
    ("fig-2.4", "Discrete contact",
     "Discrete contact at ξ = 0 with the reaction R̃(τ): κ/ν ≥ 1.", 0.0, r"$\tilde R(\tau)$"),
    ("fig-2.5", "Double contact",
     "Contact with two concentrated reactions, half of R̃(τ) each, at ξ = ±λ_c(τ): κ/ν < 1 at leading order.",
     0.9, r"$\frac{1}{2}\tilde R(\tau)$"),
    ("fig-2.6", "Continuous contact",
     "Continuous contact on |ξ| ≤ λ_c(τ) with a uniform reaction r̃: first order, α + ψ > 0.", 0.9, r"$\tilde r$", True),
))  # fmt: skip


@item("fig-3.1")
def element(sheet: Sheet) -> None:
    """Degrees of freedom of an element

    Euler–Bernoulli element of length l_e with deflections w and slopes θ at both ends (3.1.1).
    """
    xi = np.linspace(0.0, 1.0, 101)
    dofs = np.array([0.32, -0.9, 0.12, 0.7])
    bent = -shape_functions(xi, 1.0) @ dofs
    with sheet.figure(width=4.2, height=2.6) as (_, axis):
        bare(axis, (-0.2, 1.5), (-0.75, 0.28))
        axis.set_aspect("equal")
        stroke(axis, [0, 1], [0, 0], GREY, ls="--")
        sheet.line(axis, xi, bent, series="element", color=BLUE, lw=2.2)
        for place, high, slope, name, side, off in (
            (0.0, float(bent[0]), -dofs[1], "1", "right", -0.03),
            (1.0, float(bent[-1]), -dofs[3], "2", "left", 0.03),
        ):
            arrow(axis, (place, 0.0), (place, high), RED)
            axis.text(place + off, high / 2, f"$w_{name}$", ha=side, va="center")
            along = 0.3 * np.array([1.0, slope]) / np.hypot(1.0, slope)
            stroke(axis, [place, place + 0.3], [high, high], width=0.5, ls=":")
            stroke(axis, [place, place + along[0]], [high, high + along[1]], width=0.5)
            angles = np.linspace(0.0, np.arctan(slope), 21)
            stroke(axis, place + 0.24 * np.cos(angles), high + 0.24 * np.sin(angles))
            axis.text(place + 0.33, high + 0.14 * slope, rf"$\theta_{name}$", ha="left", va="center")
            axis.text(place, 0.09, f"({name})", ha="center", va="center", fontsize=7)
        axis.plot([0, 1], [bent[0], bent[-1]], "o", ms=4, color=BLUE)
        arrow(axis, (0.0, 0.2), (1.0, 0.2), ends="<|-|>")
        axis.text(0.5, 0.17, "$l_e$", ha="center", va="bottom")
        arrow(axis, (0.0, 0.0), (1.25, 0.0))
        axis.text(1.22, -0.05, "$x$")


def beam_and_moment(sheet: Sheet, moment: np.ndarray, label: str, sign: str, load: float) -> Axes:
    """Upper axis with the beam and its load at x/L, returned; lower one with the bending moment over x/L."""
    x = np.linspace(0.0, 1.0, moment.size)
    k = int(np.argmax(np.abs(moment)))
    upper: Axes
    with sheet.figure(2, 1, width=3.8, height=2.5, sharex=True, letters=False) as (_, (upper, lower)):
        bare(upper, (-0.12, 1.12), (-0.7, 0.45))
        stroke(upper, [0, 1], [0, 0], BLUE, 3)
        arrow(upper, (load, -0.6), (load, -0.04), RED)
        upper.text(load + 0.02, -0.45, "$P$", color=RED)
        lower.axhline(0.0, color="black", lw=0.7)
        lower.set(xlabel="$x/L$  (1)", ylabel="$M/(PL)$  (1)")
        lower.fill_between(x, 0.0, moment, color=style.COLOURS["sky"], alpha=0.4, lw=0)
        sheet.line(lower, x, moment, series="bending moment", **style.THEORY)
        off, side = (4, 2 if moment[k] > 0 else 6), "left" if x[k] < 0.9 else "right"
        lower.annotate(label, (x[k], moment[k]), xytext=off, textcoords="offset points", ha=side)
        lower.text(0.35 if x[k] == 0.5 else 0.5, moment[k] / 4, sign, ha="center", va="center", fontsize=10)
    return upper


@item("fig-3.2")
def supported(sheet: Sheet) -> None:
    """A beam on two supports

    Beam on two supports under a force P in its middle, with its bending moment (largest PL/4). The thesis calls it
    "fixed at both ends", but blocks the deflection alone: its moment and its solution (3.1.12) are of simple supports.
    """
    x = np.linspace(0.0, 1.0, 101)
    axis = beam_and_moment(sheet, 0.5 * np.minimum(x, 1.0 - x), r"$\frac{PL}{4}$", "+", 0.5)
    for place in (0.0, 1.0):
        stroke(axis, [place, place - 0.04, place + 0.04, place], [0.04, 0.3, 0.3, 0.04])
        stroke(axis, [place - 0.06, place + 0.06], [0.34, 0.34])


@item("fig-3.4")
def cantilever(sheet: Sheet) -> None:
    """A cantilever

    Cantilever under a force P at its free end x = 0, with its bending moment (largest PL, at the clamp x = L). The
    thesis's text clamps x = 0, the caption of its Fig. 3.5 x = L; its solution (3.1.15) is clamped at x = L, as drawn.
    """
    axis = beam_and_moment(sheet, -np.linspace(0.0, 1.0, 101), r"$-PL$", "−", 0.0)
    axis.fill_between([1.0, 1.06], -0.35, 0.35, facecolor="#DDDDDD", edgecolor=GREY, hatch="////", lw=0)
    stroke(axis, [1.0, 1.0], [-0.35, 0.35], width=0.9)


@item("fig-3.22")
def nodes_and_middles(sheet: Sheet) -> None:
    """Contact at nodes and at middles

    Nodes (circles) and middles (crosses) of the elements next to the centre of a bent beam at first contact at nodes,
    and when the middle method closes: the central node has then entered the wall by KΔx²/8. With the Hermite shape
    functions a middle lies on the bent beam. Squares: middles of straight lines between nodes, on which the thesis
    estimates twice this penetration (3.3.5).
    """
    curves: tuple[tuple[str, np.ndarray, dict[str, Any]], ...] = (
        ("beam", np.linspace(-2.0, 2.0, 161), {"color": BLUE, "lw": 1.6}),
        ("nodes", np.arange(-2, 3, dtype=float), {"color": BLUE, "ls": "", "marker": "o", "ms": 5}),
        ("middles", np.arange(-1.5, 2.0), {"color": RED, "ls": "", "marker": "x", "ms": 5.5, "mew": 1.4}),
    )
    with sheet.figure(1, 2, height=2.3, texts=["node method", "middle method"], legend=3) as (_, axes):
        for axis, shift in zip(axes, (0.0, 0.25)):
            bare(axis, (-2.3, 2.3), (-4.3, 1.0))
            ground(axis, (-2.2, 2.2), 0.35)
            for name, x, line in curves:
                sheet.line(axis, x, shift - x**2, series=name, **line)
            x = np.arange(-1.5, 2.0)
            straight = shift - 0.5 * ((x - 0.5) ** 2 + (x + 0.5) ** 2)
            square: dict[str, Any] = {"color": GREY, "ls": "", "marker": "s", "ms": 4.5, "mfc": "none"}
            sheet.line(axis, x, straight, series="middles, straight lines", **square)
