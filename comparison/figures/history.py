"""One run on one sheet: force and stress over time, the beam at several instants, where and when the wall pushes, the
impulse, the energies."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import LogNorm

from bent_beam.history import ImpactHistory
from bent_beam.pictures import draw_force, draw_stress
from comparison.figures import style
from comparison.figures.force_map import force_map

__all__ = ["draw_history"]

SHAPES, ROWS, BINS = 5, 80, 90
DECADES = 4  # of the force map
LOSSES = {
    "loss_impact": "impacts",
    "loss_algorithmic": "integration",
    "loss_viscous": "grid viscosity",
    "loss_material": "material",
    "loss_absorbed": "absorber",
    "loss_wall": "wall",
}


def draw_history(history: ImpactHistory, out: Path, name: str, formats: Sequence[str] = ("png",)) -> list[Path]:
    """``name.png`` in ``out``; returns the files. The theory is drawn where it claims to hold."""
    with style.figure(3, 2, width=style.PAGE, height=7.2) as (fig, axes):
        draw_force(axes[0, 0], history, color=style.COLOURS["blue"])
        draw_stress(axes[0, 1], history, color=style.COLOURS["vermilion"])
        _shapes(axes[1, 0], history)
        _map(fig, axes[1, 1], history)
        _impulse(axes[2, 0], history)
        _energies(axes[2, 1], history)
        style.label_panels(*axes.flat)
        return style.save(fig, out, name, formats)


def _reach(history: ImpactHistory) -> float:
    """Half width to be shown, m: three times where anything was ever pushed, at most the beam."""
    impulse = np.abs(history.array("impulse", -1))
    pushed = impulse > 1e-3 * impulse.max(initial=1e-300)
    places = np.abs(history.contact_positions(-1)[pushed])
    edge = float(np.abs(history.positions(-1)).max())
    wave = 2.0 * np.sqrt(history.impact.wave_constant * history.time[-1])
    return min(edge, 1.5 * max(float(places.max(initial=0.0)), float(wave)))


def _shapes(axis: Any, history: ImpactHistory) -> None:
    reach, end = _reach(history), history.time[-1]
    for i, t in enumerate(np.linspace(0.0, end, SHAPES)):
        k = int(np.argmin(np.abs(history.time - t)))
        x, gap = history.positions(k), history.array("gap", k)
        if x.min() >= 0.0:
            x, gap = np.concatenate([-x[::-1], x]), np.concatenate([gap[::-1], gap])
        inside = np.abs(x) <= reach
        colour = style.SEQUENCE[i % len(style.SEQUENCE)]
        axis.plot(x[inside], 1e3 * gap[inside], color=colour, label=f"{1e3 * history.time[k]:.3g} ms")
    axis.axhline(0.0, **{**style.WALL, "label": None})
    axis.set(xlabel="$x$  (m)", ylabel="gap  (mm)")
    axis.legend(title="$t$", ncols=2, frameon=True, framealpha=0.85, edgecolor="none")


def _map(fig: Any, axis: Any, history: ImpactHistory) -> None:
    impact, time = history.impact, history.time
    if history.contact_positions(-1).size == 1:  # a stop: its force has no length to be spread over
        force = np.diff(history.array("total_impulse")) / np.diff(time)
        axis.plot(0.5 * (time[1:] + time[:-1]), force, color=style.COLOURS["blue"])
        axis.set(xlabel="$t$  (s)", ylabel="reaction  (N)")
        return
    kept = np.unique(np.linspace(0, time.size - 1, min(ROWS, time.size)).astype(int))
    sided = history.contact_positions(-1).min() >= 0.0
    edge = _reach(history)
    edges = np.linspace(0.0 if sided else -edge, edge, BINS + 1)
    force = force_map(history, kept, edges / impact.length_scale)
    force = force * impact.mass_per_length * impact.velocity / impact.time_scale
    top = float(np.abs(force).max(initial=0.0))
    axis.set(xlabel="$x$  (m)", ylabel="$t$  (ms)")
    axis.grid(False)
    if top <= 0.0:
        axis.text(0.5, 0.5, "no push", transform=axis.transAxes, ha="center")
        return
    look = {"norm": LogNorm(top * 10.0**-DECADES, top), "cmap": "YlGnBu", "rasterized": True}
    mesh = axis.pcolormesh(edges, 1e3 * time[kept], np.ma.masked_less_equal(force, 0.0), **look)
    fig.colorbar(mesh, ax=axis, label="reaction per length  (N/m)", pad=0.02, extend="min")


def _impulse(axis: Any, history: ImpactHistory) -> None:
    from comparison.simulating import comparable
    from theory import predict

    axis.plot(1e3 * history.time, history.array("total_impulse"), color=style.COLOURS["blue"], label=history.path)
    if comparable(history.impact):
        found = predict(history.impact, history.time[1:])
        shown = [(1e3 * row.time, row.impulse) for row in found.times if row.valid and row.impulse is not None]
        if shown:
            axis.plot(*zip(*shown), **{**style.THEORY, "ls": "--"})
    axis.set(xlabel="$t$  (ms)", ylabel="impulse  (N s)")
    axis.legend()


def _energies(axis: Any, history: ImpactHistory) -> None:
    time = 1e3 * history.time
    for name, label, colour in (("kinetic_energy", "kinetic", "blue"), ("strain_energy", "strain", "vermilion")):
        values = history.array(name)
        axis.plot(time, values - values[0], color=style.COLOURS[colour], label=f"change of {label} energy")
    colours = iter(style.SEQUENCE[2:])
    for name, label in LOSSES.items():
        if name in history and np.any(history.array(name)):
            axis.plot(time, history.array(name), ls="--", color=next(colours), label=f"lost in {label}")
    if np.any(history.energy("contact_energy")):
        axis.plot(time, history.array("contact_energy"), color=style.COLOURS["green"], label="energy in the wall")
    if "work_of_loads" in history and np.any(history.array("work_of_loads")):
        axis.plot(time, history.array("work_of_loads"), ls=":", color="black", label="work of loads")
    axis.set(xlabel="$t$  (ms)", ylabel="energy  (J)")
    axis.legend(frameon=True, framealpha=0.85, edgecolor="none", fontsize=6.5)
