"""Chapter 3, sections 3.1 and 3.2: statics of the Hermite beam, the bouncing ball; and the shape functions (A.6)."""

from __future__ import annotations

import numpy as np

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY, key_below
from hermite_fe import INTEGRATORS
from hermite_fe.beam import HermiteBeam, shape_functions
from hermite_fe.run import integrate
from hermite_fe.system import ContactRows, System

LENGTH, STIFFNESS, ELEMENTS = 5.0, 9.345e3, 52
NODES = np.linspace(0.0, LENGTH, ELEMENTS + 1)
AXIS_STIFFNESS = 500.0 * STIFFNESS
"""EI, N m², that fits the printed axes of both figures; the captions print a five-hundredth of it."""
PRINTED = (
    "Drawn with EI = 4.67·10⁶ N m², which puts the largest deflection at {:.3g} m, where the thesis's axis has "
    "it ({}); with the "
    "printed EI = 9.345·10³ N m² it would be {:.3g} m, five hundred times as much, against both printed axes."
)


def static(
    sheet: Sheet, force: float, node: int, supports: dict[int, float], exact: np.ndarray, axis_of_thesis: str
) -> str:
    """Deflection of 52 elements under a nodal force against the exact solution at the nodes."""
    beam = HermiteBeam(NODES, AXIS_STIFFNESS, 1.0)
    load = np.zeros(beam.dofs)
    load[2 * node] = force
    found = beam.static(load, supports)[0::2]
    with sheet.figure() as (_, axis):
        axis.set_xlabel("$x$  (m)")
        axis.set_ylabel("$w$  (m)")
        sheet.line(axis, beam.nodes, -exact, series="theory", **THEORY)
        line_style = style.mark("hermite")
        sheet.line(axis, beam.nodes, -found, series="Hermite", **line_style, markevery=2)
        axis.set_xlim(0, LENGTH)
        axis.legend()
    error = float(np.abs(found - exact).max() / np.abs(exact).max())
    largest = float(np.abs(exact).max())
    note = PRINTED.format(largest, axis_of_thesis, 500.0 * largest)
    return f"{note} Hermite elements are exact at the nodes: here within {error:.0e}."


@item(
    "fig-3.3",
    "Deflection of a beam on two supports",
    group="statics",
    caption="Beam on two supports, L = 5 m, P = 5·10⁵ N in the middle, 52 elements, against (3.1.12).",
)
def supported(sheet: Sheet) -> str:
    s, force = np.minimum(NODES, LENGTH - NODES), 5e5
    exact = force * s * (3.0 * LENGTH**2 - 4.0 * s**2) / (48.0 * AXIS_STIFFNESS)
    note = static(sheet, force, ELEMENTS // 2, {0: 0.0, 2 * ELEMENTS: 0.0}, exact, "to −0.3")
    return f'{note} The thesis\'s "fixed at both ends" is simply supported.'


@item(
    "fig-3.5",
    "Deflection of a cantilever",
    group="statics",
    caption="Cantilever clamped at x = L, P = 8·10⁵ N at x = 0, L = 5 m, 52 elements, against (3.1.15).",
)
def cantilever(sheet: Sheet) -> str:
    force = 8e5
    exact = force * (NODES**3 / 6.0 - LENGTH**2 * NODES / 2.0 + LENGTH**3 / 3.0) / AXIS_STIFFNESS
    return static(sheet, force, 0, {2 * ELEMENTS: 0.0, 2 * ELEMENTS + 1: 0.0}, exact, "to −8")


def ball(step: float, end: float) -> tuple[np.ndarray, np.ndarray]:
    """Height (m) of a bouncing ball, q₀ = 0.5 m, restitution 0.9, by Moreau–Jean with θ = 1 (implicit Euler)."""
    system = System(
        mass=np.ones((1, 1)),
        stiffness=np.zeros((1, 1)),
        load=np.array([[-9.81]]),
        contacts=ContactRows(dofs=np.array([[0]]), factors=np.array([[1.0]]), gap=np.zeros(1)),
    )
    run = integrate(
        system,
        np.array([0.5]),
        np.zeros(1),
        INTEGRATORS["moreau_jean"](time_step=step, theta=1.0),
        end,
        restitution=0.9,
        save=[float(t) for t in np.arange(round(end / step) + 1) * step],
    )
    return run.time, run.q[:, 0]


def exact_ball(times: np.ndarray) -> np.ndarray:
    """Height of the ball, free fall between bounces."""
    gravity, start, speed = 9.81, 0.0, 0.0
    height = np.full_like(times, 0.5)
    high = 0.5
    while start < times[-1]:
        flight = (speed + np.sqrt(speed**2 + 2.0 * gravity * high)) / gravity
        here = (times >= start) & (times <= start + flight)
        s = times[here] - start
        height[here] = high + speed * s - 0.5 * gravity * s**2
        start, speed, high = start + flight, 0.9 * np.sqrt(speed**2 + 2.0 * gravity * high), 0.0
    return height


def ball_with_bounces(end: float) -> tuple[np.ndarray, np.ndarray]:
    """Times (s) and heights (m) of the exact flight, its bounces among them: there it is at the wall."""
    flight = np.sqrt(2.0 * 0.5 / 9.81)
    bounces = [flight]
    while bounces[-1] < end and len(bounces) < 60:
        bounces.append(bounces[-1] + 2.0 * 0.9 ** len(bounces) * flight)
    times = np.unique(np.concatenate([np.linspace(0.0, end, 3001), [b for b in bounces if b <= end]]))
    heights = exact_ball(times)
    heights[np.isin(times, bounces)] = 0.0
    return times, heights


@item(
    "fig-3.6",
    "Bouncing ball",
    group="statics",
    caption=(
        "Bouncing ball, q₀ = 0.5 m, v₀ = 0, h = 10⁻³ s, restitution 0.9, Moreau–Jean with implicit Euler: the "
        "law acts on velocities, so positions drift by up to a step (zoom on the right)."
    ),
)
def bouncing(sheet: Sheet) -> str:
    times, height = ball(1e-3, 3.0)
    dense, exact = ball_with_bounces(3.0)
    with sheet.figure(1, 2, width=style.PAGE, height=2.5) as (fig, axes):
        for axis, letter in zip(axes, "ab"):
            axis.set_xlabel("$t$  (s)")
            axis.set_ylabel("$q$  (m)")
            sheet.line(axis, dense, exact, series="theory", **THEORY)
            sheet.line(
                axis,
                times,
                height,
                series="Moreau–Jean",
                color=style.COLOURS["blue"],
                lw=0.9,
                marker="." if letter == "b" else "",
                ms=4,
            )
            sheet.panel(axis, letter, text="zoom" if letter == "b" else "")
        hit = float(np.sqrt(1.0 / 9.81))
        axes[0].set_xlim(0, 3)
        axes[0].set_ylim(0, 0.52)
        axes[1].set_xlim(hit - 0.012, hit + 0.012)
        axes[1].set_ylim(-0.005, 0.04)
        axes[1].axhline(0.0, color=style.COLOURS["grey"], lw=0.6)
        key_below(fig, axes[0])
    first = float(height[(times > 0.2) & (times < 0.5)].min())
    where = (
        "inside the wall: the gap is tested before the step, where the thesis tests the predicted one and "
        "turns above it"
    )
    return (
        f"At the first bounce it turns {1e3 * abs(first):.2g} mm {where if first < 0.0 else 'above the wall'}; "
        f"either way within the {1e3 * hit * 9.81e-3:.2g} mm that it moves in a step, and smaller steps bring it "
        "to the wall."
    )


@item(
    "fig-A.1",
    "Hermite shape functions",
    group="statics",
    caption="Cubic Hermite shape functions N₁ … N₄ (A.6.1–4) over ξ = x/l_e; N₂ and N₄ over l_e.",
)
def shapes(sheet: Sheet) -> str:
    xi = np.linspace(0.0, 1.0, 101)
    values = shape_functions(xi, 1.0)
    with sheet.figure(2, 2, width=4.6, height=3.6, sharex=True) as (_, axes):
        for i, axis in enumerate(axes.flat):
            if i > 1:
                axis.set_xlabel(r"$\xi$  (1)")
            axis.set_ylabel(f"$N_{i + 1}$  (1)" if i % 2 == 0 else f"$N_{i + 1}/l_e$  (1)")
            sheet.line(axis, xi, values[:, i], series=f"N{i + 1}", **THEORY)
            sheet.panel(axis, "abcd"[i])
            axis.set_xlim(0, 1)
    return "N₂ = l_e ξ(1 − ξ)² and N₄ = l_e ξ²(ξ − 1)."
