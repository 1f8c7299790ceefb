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
from comparison.gallery.looks import THEORY, wall
from comparison.gallery.runs import case
from comparison.studies.exact import Exact
from comparison.studies.thesis import Settings
from hermite_fe import simulate

CURVATURE, DURATION, ELEMENT = 25.0, 0.01, 5e-2
FINE = (5e-2, 1e-2, 2.5e-3, 5e-4)


@functools.cache
def run(contact: str, element: float, length: float, end: float, step: float) -> ImpactHistory:
    """A run on a uniform mesh, the thesis's other settings, its first steps saved one by one."""
    given = case(CURVATURE, DURATION)
    settings = Settings(element_length=element, time_step=step, zone=1.0, growth=1.0, contact=contact)
    times = np.unique(np.concatenate([np.arange(11) * step, np.linspace(0.0, end, 201)]))
    return simulate(
        given.impact.replace(length=length),
        end_time=end,
        save=times,
        **{**settings.parts(), "mesh": UniformMesh(element)},
    )


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
    wall(axis, 30.0)
    axis.legend(fontsize=7, loc="lower left")


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
        "middles; (c) energy, nodes; (d) reaction over the first steps and after for several element lengths (L "
        "= 1 m)."
    ),
)
def discrete(sheet: Sheet) -> str:
    end = DURATION * 2.5e-3
    node = run("node", ELEMENT, 50.0, end, 2.5e-8)
    starts, predicted = middle_starts()
    with sheet.figure(2, 2, width=style.PAGE, height=5.2) as (_, axes):
        geometry(sheet, axes[0, 0], node, (0.0, end))
        axes[0, 0].set_ylim(-340, 30)
        geometry(
            sheet, axes[0, 1], run("middle", ELEMENT, 50.0, 1.6e-3, 2.5e-7), (0.0, 0.5 * predicted, predicted, 1.6e-3)
        )
        axes[0, 1].set_ylim(-60, 18)
        axes[0, 1].set_xlim(0, 0.11)
        lost = _energy(sheet, axes[1, 0], node)
        first = _impulses(sheet, axes[1, 1], end)
        for axis, letter in zip(axes.flat, "abcd"):
            sheet.panel(axis, letter)
    masses = ", ".join(f"{i:.3g}" for i in first)
    return (
        f"The contact stays at x = 0, as theory says. Middles close after {starts:.2e} s, KΔx²/(8V₀) = "
        f"{predicted:.2e} s (the thesis expects 7.85·10⁻⁴ s, joining nodes by straight lines). The first impact "
        f"takes {lost:.3g} J (thesis: 10 J, ½μΔxV₀²): the mass that moves with a node is the consistent one, not "
        f"μΔx. Impulse of the first step for the element lengths of (d): {masses} N s (thesis: μΔxV₀, 1 and 0.2 N "
        "s for the first two). Theory needs neither: as Δx → 0 this impulse vanishes and R = 2√(2/π) r₀/√τ from "
        "the start."
    )


def _energy(sheet: Sheet, axis: Axes, history: ImpactHistory) -> float:
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    axis.set_xlabel("$t$  (µs)")
    axis.set_ylabel("$E - E(0)$  (J)")
    sheet.line(axis, 1e6 * history.time, energy - energy[0], series="contact at nodes", color=style.COLOURS["blue"])
    sheet.line(axis, [0.0, 1e6 * float(history.time[-1])], [0.0, 0.0], series="theory", **THEORY)
    axis.set_xlim(-0.5, 1e6 * history.time[-1])
    axis.legend(fontsize=7, loc="center right")
    return float(energy[0] - energy[2])


def _impulses(sheet: Sheet, axis: Axes, end: float) -> list[float]:
    """R(t) of the whole beam for several element lengths; returns the impulse of the first step of each, N s."""
    first = []
    step = 2.5e-8
    axis.set_xlabel("$t$  (µs)")
    axis.set_ylabel("reaction $R$  (kN)")
    for element, colour in zip(FINE, style.SEQUENCE):
        history = run("node", element, 1.0, end, step)
        total, time = history.array("total_impulse"), history.time
        first.append(float(total[np.argmax(total > 0.0)]))
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
    return first
