"""An impact in motion: beam, wall and moving contact points above, the reaction so far below."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory
from bent_beam_programs.thesis.gallery.drawing import FREE, nearest
from bent_beam_programs.thesis.gallery.runs import reference_history
from bent_beam_programs.thesis.sheet import Sheet, item
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.outcome import Outcome, outcome_of
from bent_beam_programs.thesis.studies.panels import unit
from comparison.figures import style
from comparison.figures.style import Film, write_gif
from self_similar_fe import SelfSimilarFE

Array = NDArray[np.float64]
CURVATURE, DURATION = 5.0, 0.1
FRAMES, PER_SECOND, POINTS = 60, 15, 241
COLUMNS = ("time (s)", "half contact length (m)", "reaction of one side (N)", "x (m)", "y (m)")


@dataclass(frozen=True)
class Frame:
    """One instant, SI units.

    x, y : (points,) places of the whole beam and deflections from the wall (positive into it); free : the motion
        without the wall at x; front : half contact length; reaction : of one side, N (averaged up to the
        neighbouring frames).
    """

    time: float
    x: Array
    y: Array
    free: Array
    front: float
    reaction: float


def impact_frames(history: ImpactHistory, count: int = FRAMES) -> list[Frame]:
    """``count`` instants evenly spread in time, over three contact lengths."""
    outcome = outcome_of(history, "", mark=history.path)
    end = float(history.time[-1])
    edge = 3.0 * max(float(outcome.front.max()), 0.4 * np.sqrt(history.impact.wave_constant * end))
    edge = min(edge, history.impact.half_length)
    x = np.linspace(-edge, edge, POINTS)
    return [_frame(history, outcome, t, end / count, x) for t in end * (np.arange(count) + 1.0) / count]


def _frame(history: ImpactHistory, outcome: Outcome, time: float, step: float, x: Array) -> Frame:
    k = nearest(history.time, time)
    p, t = history.impact, float(history.time[k])
    free = p.free_motion(p.relative_curvature)(x, t)
    places, gap = history.positions(k), history.array("gap", k)
    half = places >= 0.0
    known = np.abs(x) <= places[half][-1]
    y = np.where(known, -np.interp(np.abs(x), places[half], gap[half]), free)
    between = np.array([max(time - step, 0.0), min(time + step, float(outcome.time[-1]))])
    impulse = np.interp(between, outcome.time, outcome.side_impulse)
    return Frame(t, x, y, free, float(outcome.front[k]), float(np.diff(impulse)[0] / np.diff(between)[0]))


def animate(history: ImpactHistory, frames: list[Frame], file: Path) -> None:
    """Write frames of an impact as an animated GIF."""
    last, mark, red = frames[-1], style.mark(history.path), style.COLOURS["vermilion"]
    times, force = (np.array([getattr(f, name) for f in frames]) for name in ("time", "reaction"))
    exact = Exact(history.impact).side_reaction(times)
    low, largest = 0.6 * float(-last.y.min()), 1.5 * float(exact[max(1, times.size // 12)])
    (sx, mx), (sy, my), (st, mt), (sf, mf) = (
        unit(v, name) for v, name in ((float(last.x[-1]), "m"), (low, "m"), (last.time, "s"), (largest, "N"))
    )
    pictures = []
    with style.figure(2, 1, width=4.6, height=4.2, height_ratios=[1.5, 1]) as (fig, (top, below)):
        top.set(xlabel=f"$x$  ({mx})", ylabel=f"deflection $y$  ({my})", xlim=sx * last.x[[0, -1]])
        style.wall_below(top, -sy * low, 0.4 * sy * low)
        (free,) = top.plot([], [], **FREE, label="without the wall")
        (beam,) = top.plot([], [], color=mark["color"], lw=1.8, label="beam")
        (points,) = top.plot([], [], color=red, ls="", marker="v", ms=6, label="contact points")
        clock = top.text(0.5, 0.94, "", transform=top.transAxes, ha="center", va="top")  # the beam is below
        top.legend(loc="lower center", ncols=3, bbox_to_anchor=(0.5, 1.0))
        below.plot(st * times, sf * exact, **style.THEORY)
        (past,) = below.plot([], [], **{**mark, "ms": 3.5}, label="simulation")
        (now,) = below.plot([], [], **{**mark, "ms": 6.0, "mfc": mark["color"]})
        below.set(xlabel=f"$t$  ({mt})", ylabel=f"reaction of one side  ({mf})")
        below.set(xlim=(0.0, 1.01 * st * last.time), ylim=(0.0, sf * largest))
        below.legend(loc="upper right")
        film = Film(fig, (free, beam, points, clock, past, now))
        for k, f in enumerate(frames):
            free.set_data(sx * f.x, sy * f.free)
            beam.set_data(sx * f.x, sy * f.y)
            points.set_data([-sx * f.front, sx * f.front], [0.0, 0.0])
            clock.set_text(f"$t$ = {st * f.time:.3g} {mt}")
            past.set_data(st * times[: k + 1], sf * force[: k + 1])
            now.set_data(st * times[[k]], sf * force[[k]])
            pictures.append(film.picture())
    write_gif(pictures, file, PER_SECOND)


@item("animation")
def animation(sheet: Sheet) -> None:
    """An impact in motion

    K = 5 1/m (κ/ν = 0.25), V₀ = 20 m/s, Self-similar: beam, wall and contact points; below, the reaction against
    theory.
    """
    history = reference_history(CURVATURE, DURATION, SelfSimilarFE.path)
    frames = impact_frames(history)
    rows = []
    for f in frames:
        near = np.abs(f.x) <= 2.0 * max(f.front, 1e-9) + f.x[-1] / 8.0
        rows += [[f"{v:.9g}" for v in (f.time, f.front, f.reaction, *point)] for point in zip(f.x[near], f.y[near])]
    sheet.data(COLUMNS, rows)
    sheet.files[".gif"] = lambda file: animate(history, frames, file)
    sheet.numbers["half contact length at the end (mm)"] = 1e3 * frames[-1].front
