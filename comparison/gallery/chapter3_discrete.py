"""Chapter 3, section 3.4: discrete contact (K = 25 1/m, κ/ν = 1.25) with nodes and with middles, and how it depends
on the mesh.
"""

from __future__ import annotations

import functools

import numpy as np
from matplotlib.axes import Axes

from bent_beam.history import ImpactHistory
from bent_beam.meshes import UniformMesh
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY
from comparison.gallery.runs import case
from comparison.studies.exact import Exact
from comparison.studies.sentences import number
from comparison.studies.thesis import CONSISTENT, THESIS_MASS, Settings
from hermite_fe.masses import Mass

CURVATURE, DURATION, ELEMENT = 25.0, 0.01, 5e-2
FINE = (5e-2, 1e-2, 2.5e-3, 5e-4)


@functools.cache
def run(contact: str, element: float, length: float, end: float, step: float, mass: Mass = CONSISTENT) -> ImpactHistory:
    """A run on a uniform mesh, the thesis's other settings, its first steps saved one by one."""
    given = case(CURVATURE, DURATION)
    settings = Settings(
        element_length=element,
        time_step=step,
        zone=1.0,
        growth=1.0,
        contact=contact,
        mass=mass,
        mesh=UniformMesh(element),
    )
    times = np.unique(np.concatenate([np.arange(11) * step, np.linspace(0.0, end, 201)]))
    return settings.method().simulate(given.impact.replace(length=length), end_time=end, save=times)


def first_impact(element: float, mass: Mass, step: float = 2.5e-8) -> tuple[float, float]:
    """(impulse, N s; energy lost, J) of the step in which the first node touches, contact at nodes."""
    history = run("node", element, 1.0, DURATION * 2.5e-3 if step > 1e-9 else 100.0 * step, step, mass)
    total = history.array("total_impulse")
    k = int(np.argmax(total > 0.0))
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    return float(total[k]), float(energy[0] - energy[k])


def geometry(sheet: Sheet, axis: Axes, history: ImpactHistory, times: tuple[float, ...]) -> None:
    x, gap = history.positions(-1), history.array("gap")
    near = x <= 0.16
    axis.set_xlabel("$x$  (m)")
    axis.set_ylabel("deflection $y$  (mm)")
    for t, colour in zip(times, style.SEQUENCE):
        k = int(np.argmin(np.abs(history.time - t)))
        sheet.line(
            axis,
            x[near],
            -1e3 * gap[k][near],
            series=f"t = {1e6 * t:.4g} µs",
            color=colour,
            marker="o",
            ms=3,
            mfc="none",
            lw=2.2 - 0.4 * times.index(t),
        )
    axis.legend(fontsize=7, loc="upper left")


def middle_starts() -> tuple[float, float]:
    """(observed, predicted) time after which the middle method first pushes, s."""
    history = run("middle", ELEMENT, 50.0, 1.6e-3, 2.5e-7)
    first = float(history.time[np.argmax(history.array("total_impulse") > 0.0)])
    return first, CURVATURE * ELEMENT**2 / 8.0 / 20.0


@item(
    "fig-3.32",
    "Discrete contact",
    group="discrete",
    caption=(
        "Discrete contact, κ/ν = 1.25, uniform mesh Δx = 5·10⁻² m, τ = 0.01: (a) geometry, nodes; (b) geometry, "
        "middles; (c) energy, nodes, both masses; (d) reaction over the first steps and after for several "
        "element lengths "
        "(L = 1 m), lumped masses."
    ),
)
def discrete(sheet: Sheet) -> str:
    end = DURATION * 2.5e-3
    starts, predicted = middle_starts()
    with sheet.figure(2, 2, width=style.PAGE, height=5.2) as (_, axes):
        geometry(sheet, axes[0, 0], run("node", ELEMENT, 50.0, end, 2.5e-8, THESIS_MASS), (0.0, end))
        style.wall_below(axes[0, 0], -340, 30)
        geometry(
            sheet, axes[0, 1], run("middle", ELEMENT, 50.0, 1.6e-3, 2.5e-7), (0.0, 0.5 * predicted, predicted, 1.6e-3)
        )
        style.wall_below(axes[0, 1], -60, 18)
        axes[0, 1].set_xlim(0, 0.11)
        energies(sheet, axes[1, 0], end)
        first = impulses(sheet, axes[1, 1], end)
        for axis, letter in zip(axes.flat, "abcd"):
            sheet.panel(axis, letter)
    lumped, consistent = (first_impact(ELEMENT, mass) for mass in (THESIS_MASS, CONSISTENT))
    tiny = first_impact(ELEMENT, THESIS_MASS, 1e-10)
    masses = ", ".join(number(i) for i in first)
    return (
        f"The contact stays at x = 0, as theory says. Middles close after {starts:.2e} s, KΔx²/(8V₀) = "
        f"{predicted:.2e} s (the thesis expects 7.85·10⁻⁴ s, joining nodes by straight lines). The first impact "
        f"takes {lumped[1]:.3g} J and {lumped[0]:.3g} N s with lumped masses, which is the thesis's 10 J, ½μΔxV₀², and "
        f"1 N s, μΔxV₀, and {consistent[1]:.3g} J and {consistent[0]:.3g} N s with the consistent matrix "
        "(3.1.8) that it "
        f"prints; with h = 10⁻¹⁰ s, {tiny[0]:.4g} N s, the same, as it says. Impulses of the first step for "
        "the element "
        f"lengths of (d): {masses} N s (thesis: 1 and 0.2 N s for the first two). Theory needs none of it: as "
        "Δx → 0 this "
        "impulse vanishes and R = 2√(2/π) r₀/√τ from the start."
    )


def energies(sheet: Sheet, axis: Axes, end: float) -> None:
    """Energy over time with both masses, contact at nodes."""
    axis.set_xlabel("$t$  (µs)")
    axis.set_ylabel("$E - E(0)$  (J)")
    for name, mass, colour in (("lumped", THESIS_MASS, "vermilion"), ("consistent", CONSISTENT, "sky")):
        history = run("node", ELEMENT, 50.0, end, 2.5e-8, mass)
        energy = history.array("kinetic_energy") + history.array("strain_energy")
        sheet.line(axis, 1e6 * history.time, energy - energy[0], series=f"nodes, {name}", color=style.COLOURS[colour])
    sheet.line(axis, [0.0, 1e6 * end], [0.0, 0.0], series="theory", **THEORY)
    axis.set_xlim(-0.5, 1e6 * end)
    axis.legend(fontsize=7, loc="center right", bbox_to_anchor=(1.0, 0.75))


def impulses(sheet: Sheet, axis: Axes, end: float) -> list[float]:
    """R(t) of the whole beam for several element lengths; returns the impulse of the first step of each, N s."""
    step = 2.5e-8
    axis.set_xlabel("$t$  (µs)")
    axis.set_ylabel("reaction $R$  (kN)")
    for element, colour in zip(FINE, style.SEQUENCE):
        history = run("node", element, 1.0, end, step, THESIS_MASS)
        total, time = history.array("total_impulse"), history.time
        edges = np.concatenate([time[:11], np.linspace(time[10], end, 41)[1:]])
        gathered = np.interp(edges, time, total)
        middle = 0.5 * (edges[1:] + edges[:-1])
        sheet.line(
            axis,
            1e6 * middle,
            1e-3 * np.diff(gathered) / np.diff(edges),
            series=f"Δx = {element:g} m",
            color=colour,
            lw=0.9,
        )
    exact = Exact(case(CURVATURE, DURATION).impact)
    t = np.geomspace(0.5 * step, end, 200)
    sheet.line(axis, 1e6 * t, 2e-3 * exact.side_reaction(t), series="theory", **THEORY)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.set_ylim(1.0, 1e6)
    axis.set_xlim(1e-2, 25)
    axis.legend(fontsize=6.5, loc="upper right", ncols=2)
    return [first_impact(element, THESIS_MASS)[0] for element in FINE]
