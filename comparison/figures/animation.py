"""An impact as an animation: beam, wall and moving contact points above, the reaction so far below."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory
from comparison.figures import style
from comparison.figures.gif import Film, write_gif
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome, outcome_of
from comparison.studies.panels import unit

__all__ = ["Frame", "animate", "impact_frames"]

Array = NDArray[np.float64]


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


def impact_frames(
    history: ImpactHistory, count: int = 60, *, reach: float | None = None, points: int = 241
) -> list[Frame]:
    """``count`` instants evenly spread in time; ``reach`` is the half width shown, m (three contact lengths, if not
    given).
    """
    outcome = outcome_of(history, "", mark=history.path)
    end = float(history.time[-1])
    edge = reach or 3.0 * max(float(outcome.front.max()), 0.4 * np.sqrt(history.impact.wave_constant * end))
    edge = min(edge, history.impact.half_length)
    x = np.linspace(-edge, edge, points)
    times = end * (np.arange(count) + 1.0) / count
    return [_frame(history, outcome, float(t), end / count, x) for t in times]


def _frame(history: ImpactHistory, outcome: Outcome, time: float, step: float, x: Array) -> Frame:
    k = int(np.argmin(np.abs(history.time - time)))
    p, t = history.impact, float(history.time[k])
    free = (
        p.velocity * t
        - 0.5 * p.relative_curvature * x**2
        + 0.5 * p.acceleration * t**2
        + 0.5 * p.curvature_rate * x**2 * t
        + p.fourth_derivative * x**4 / 24.0
    )
    places, gap = history.positions(k), history.array("gap", k)
    half = places >= 0.0
    known = np.abs(x) <= places[half][-1]
    y = np.where(known, -np.interp(np.abs(x), places[half], gap[half]), free)
    gathered = np.interp(
        [max(time - step, 0.0), min(time + step, outcome.time[-1])], outcome.time, outcome.side_impulse
    )
    width = min(time + step, float(outcome.time[-1])) - max(time - step, 0.0)
    return Frame(t, x, y, free, float(outcome.front[k]), float(np.diff(gathered)[0] / width))


def animate(history: ImpactHistory, file: Path | str, *, frames: int = 60, per_second: int = 15) -> list[Frame]:
    """Write the impact as an animated GIF; returns the frames shown, for a table or a page of one's own."""
    shown = impact_frames(history, frames)
    pictures: list[Any] = []
    with style.figure(2, 1, width=4.6, height=4.2, height_ratios=[1.5, 1]) as (fig, axes):
        scene = _Scene(axes, shown, Exact(history.impact), style.mark(history.path))
        film = Film(fig, scene.moving)
        for number in range(len(shown)):
            scene.show(number)
            pictures.append(film.picture())
    write_gif(pictures, Path(file), per_second)
    return shown


class _Scene:
    """The artists of the animation, moved from frame to frame; ``line_style`` is the mark of the path."""

    def __init__(self, axes: Sequence[Any], frames: Sequence[Frame], exact: Exact, line_style: dict[str, Any]) -> None:
        self.frames, self.exact, self.line_style, last = frames, exact, line_style, frames[-1]
        self.sx, mx = unit(float(last.x[-1]), "m")
        low = 0.6 * float(-last.y.min())
        self.sy, my = unit(low, "m")
        self.st, mt = unit(last.time, "s")
        top, below = axes
        high = 0.4 * low
        top.set_xlim(self.sx * last.x[0], self.sx * last.x[-1])
        style.wall_below(top, -self.sy * low, self.sy * high)
        top.set_xlabel(f"$x$  ({mx})")
        top.set_ylabel(f"deflection $y$  ({my})")
        (self.free,) = top.plot([], [], color=style.COLOURS["grey"], ls="--", lw=0.9, label="without the wall")
        (self.beam,) = top.plot([], [], color=line_style["color"], lw=1.8, label="beam")
        (self.points,) = top.plot(
            [], [], color=style.COLOURS["vermilion"], ls="", marker="v", ms=6, label="contact points"
        )
        self.clock = top.text(0.5, 0.94, "", transform=top.transAxes, ha="center", va="top")  # the beam is below
        top.legend(loc="lower center", ncols=3, bbox_to_anchor=(0.5, 1.0))
        self._reaction(below, mt)
        self.moving = (self.free, self.beam, self.points, self.clock, self.past, self.now)

    def _reaction(self, below: Any, mt: str) -> None:
        times = np.array([f.time for f in self.frames])
        forces = np.array([f.reaction for f in self.frames])
        force = self.exact.side_reaction(times)
        largest = 1.5 * float(force[max(1, times.size // 12)])
        self.sf, mf = unit(largest, "N")
        self.times, self.forces = self.st * times, self.sf * forces
        below.plot(self.times, self.sf * force, **style.THEORY)
        (self.past,) = below.plot([], [], **{**self.line_style, "ms": 3.5}, label="simulation")
        (self.now,) = below.plot([], [], **{**self.line_style, "ms": 6.0, "mfc": self.line_style["color"]})
        below.set_xlim(0.0, self.times[-1] * 1.01)
        below.set_ylim(0.0, self.sf * largest)
        below.set_xlabel(f"$t$  ({mt})")
        below.set_ylabel(f"reaction of one side  ({mf})")
        below.legend(loc="upper right")
        self.unit = mt

    def show(self, number: int) -> None:
        f = self.frames[number]
        self.free.set_data(self.sx * f.x, self.sy * f.free)
        self.beam.set_data(self.sx * f.x, self.sy * f.y)
        self.points.set_data([-self.sx * f.front, self.sx * f.front], [0.0, 0.0])
        self.clock.set_text(f"$t$ = {self.st * f.time:.3g} {self.unit}")
        self.past.set_data(self.times[: number + 1], self.forces[: number + 1])
        self.now.set_data(self.times[number : number + 1], self.forces[number : number + 1])
