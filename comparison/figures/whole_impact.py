"""Figures of a whole impact: force, contact zone and shapes; the animation. ``bentbeam bounce … --out FOLDER`` draws
both."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.free_flight import pushing
from bent_beam.history import ImpactHistory
from comparison.bounce_text import bounce_document
from comparison.bouncing import Bounce
from comparison.figures import style
from comparison.figures.style import Film, write_gif
from comparison.readable import json_text
from comparison.store import write_atomically

__all__ = ["animate_bounce", "bounce_figure", "draw_bounce", "write_bounce"]

Array = NDArray[np.float64]
WINDOWS = 160  # of the force: what is quicker is noise of the reader's eye
SHAPES = 7
FRAMES, PER_SECOND = 90, 18


def write_bounce(found: Bounce, out: Path) -> list[Path]:
    """``bounce.json``, ``bounce.png`` and ``bounce.gif`` in ``out``."""
    document = out / "bounce.json"
    write_atomically(document, json_text(bounce_document(found), indent=1) + "\n")
    return [document, *draw_bounce(found, out), animate_bounce(found.history, out / "bounce.gif")]


def _force(history: ImpactHistory, end: float) -> tuple[Array, Array]:
    """Edges of windows in time, T*, and the wall's mean force in each, μℓV₀/T*."""
    impact = history.impact
    unit = impact.mass_per_length * impact.half_length * impact.velocity
    time = history.time / impact.slow_time_scale
    edges = np.linspace(0.0, end, WINDOWS + 1)
    return edges, np.diff(np.interp(edges, time, history.array("total_impulse") / unit)) / np.diff(edges)


def _top(force: Array) -> float:
    """Of an axis of forces: the first window holds the start, which is infinite."""
    return 1.1 * float(force[1:].max())


def _contacts(history: ImpactHistory) -> tuple[Array, Array]:
    """Times (T*) and places (x/ℓ, both halves) at which the wall pushed."""
    impact = history.impact
    k, j = np.nonzero(pushing(history.array("impulse")))
    time = 0.5 * (history.time[:-1] + history.time[1:])[k] / impact.slow_time_scale
    place = history.contact_positions(0)[j] / impact.half_length
    if place.size and place.min() >= 0.0:
        time, place = np.concatenate([time, time]), np.concatenate([place, -place])
    return time, place


def _whole(history: ImpactHistory, k: int) -> tuple[Array, Array]:
    """x/ℓ and y/(V₀T*) of the whole beam at a saved instant."""
    impact = history.impact
    x, gap = history.positions(k), history.array("gap", k)
    if x[0] >= 0.0:
        x, gap = np.concatenate([-x[:0:-1], x]), np.concatenate([gap[:0:-1], gap])
    return x / impact.half_length, -gap / (impact.velocity * impact.slow_time_scale)


def draw_bounce(found: Bounce, out: Path) -> list[Path]:
    """``bounce.png`` in ``out``."""
    return style.save(bounce_figure(found), out, "bounce")


def bounce_figure(found: Bounce) -> Any:
    """Force and contact zone over time, and the beam's shapes, one below the other as time goes on."""
    history, impact = found.history, found.impact
    end = min(1.25 * found.outcome.last_contact, float(history.time[-1]) / impact.slow_time_scale)
    edges, force = _force(history, end)
    time, place = _contacts(history)
    with style.figure(2, 2, width=style.PAGE, height=4.0, width_ratios=[1.35, 1.0]) as (fig, axes):
        (push, _), (zone, _) = axes
        for axis in axes[:, 1]:
            axis.remove()
        shapes = fig.add_subplot(push.get_gridspec()[:, 1])
        push.stairs(force, edges, fill=True, color=style.COLOURS["sky"], lw=0.0)
        push.stairs(force, edges, color=style.COLOURS["blue"], lw=0.8)
        push.set(xlim=(0.0, end), ylim=(0.0, _top(force)), ylabel=r"force of the wall  ($\mu\ell V_0/T^*$)")
        push.tick_params(labelbottom=False)
        zone.plot(time, place, ls="", marker=".", ms=2.0, color=style.COLOURS["vermilion"], rasterized=True)
        zone.axhline(0.0, color=style.COLOURS["grey"], lw=0.5)
        zone.set(xlabel=r"$t/T^*$", ylabel=r"contact at $x/\ell$", xlim=(0.0, end), ylim=(-1.05, 1.05))
        _draw_shapes(shapes, history, end)
        style.label_panels(push, zone, shapes)
        title = rf"$\kappa/\nu$ = {impact.kappa_over_nu:.4g}, $\eta/T^*$ = {impact.relative_damping:.3g}"
        push.set_title(title, loc="right", pad=3.0)
        return fig


def _draw_shapes(axis: Any, history: ImpactHistory, end: float) -> None:
    """The beam above its own piece of wall at even times, the first on top."""
    time = history.time / history.impact.slow_time_scale
    wanted = np.linspace(0.0, end, SHAPES)
    shown = [_whole(history, int(np.argmin(np.abs(time - t)))) for t in wanted]
    step = 1.25 * max(float(-y.min()) for _, y in shown) or 1.0
    for number, ((x, y), t) in enumerate(zip(shown, wanted)):
        base = -number * step
        axis.plot([-1.0, 1.0], [base, base], color=style.COLOURS["grey"], lw=0.8)
        axis.plot(x, base - y, color=style.COLOURS["blue"], lw=1.4)
        axis.text(1.06, base, f"{t:.2f}", va="center", fontsize=7.0)
    axis.text(1.06, 0.62 * step, r"$t/T^*$", va="center", fontsize=7.5)
    axis.set(xlabel=r"$x/\ell$", xlim=(-1.05, 1.3), ylim=(-(SHAPES - 0.7) * step, step), yticks=[])
    axis.grid(False)
    axis.spines["left"].set_visible(False)


def animate_bounce(history: ImpactHistory, file: Path) -> Path:
    """The beam over the wall with the points that push, and the force so far, as an animated GIF."""
    time = history.time / history.impact.slow_time_scale
    end = float(time[-1])
    chosen = [int(np.argmin(np.abs(time - t))) for t in np.linspace(0.0, end, FRAMES)]
    edges, force = _force(history, end)
    when, place = _contacts(history)
    shapes = [_whole(history, k) for k in chosen]
    low = max(float(-y.min()) for _, y in shapes)
    pictures: list[Any] = []
    with style.figure(2, 1, width=4.6, height=4.0, height_ratios=[1.5, 1]) as (fig, (top, below)):
        top.axhspan(0.0, 0.25 * low, color="#E4E4E4", lw=0)
        top.axhline(0.0, color=style.COLOURS["grey"], lw=0.8)
        top.set(
            xlabel=r"$x/\ell$", ylabel=r"deflection  ($V_0T^*$)", xlim=(-1.05, 1.05), ylim=(-1.05 * low, 0.25 * low)
        )
        (beam,) = top.plot([], [], color=style.COLOURS["blue"], lw=1.8)
        (touch,) = top.plot([], [], color=style.COLOURS["vermilion"], ls="", marker="^", ms=5)
        clock = top.text(0.99, 0.03, "", transform=top.transAxes, ha="right", va="bottom")
        below.set(xlabel=r"$t/T^*$", ylabel=r"force  ($\mu\ell V_0/T^*$)", xlim=(0.0, end), ylim=(0.0, _top(force)))
        below.stairs(force, edges, fill=True, color="#E4E4E4", lw=0.0)
        past = below.axvline(0.0, color=style.COLOURS["blue"], lw=1.2)
        film = Film(fig, (beam, touch, clock, past))
        for k, (x, y) in zip(chosen, shapes):
            beam.set_data(x, y)
            near = np.abs(when - time[k]) <= 0.5 * end / FRAMES
            touch.set_data(place[near], np.zeros(int(near.sum())))
            clock.set_text(f"$t/T^*$ = {time[k]:.3f}")
            past.set_xdata([time[k], time[k]])
            pictures.append(film.picture())
    write_gif(pictures, file, PER_SECOND)
    return file
