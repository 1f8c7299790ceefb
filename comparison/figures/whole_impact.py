"""The whole impact on one sheet, and as an animation, in the units of the case: ``bentbeam predict`` and ``bounce``,
with ``--out FOLDER``, draw them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.cases import Case
from bent_beam.history import ImpactHistory
from bent_beam.measure.numbers import Band, Number
from comparison.figures import style
from comparison.figures.panels import contacts, draw_force, draw_wall, heights, sheet
from comparison.figures.style import Film, write_gif
from comparison.readable import in_unit, largest_of

__all__ = ["animate", "impact_figure"]

FRAMES, PER_SECOND = 90, 18


def impact_figure(history: ImpactHistory, case: Case, numbers: Mapping[str, Number | Band], end: float) -> Any:
    """A run of a case on one sheet. numbers : SI, by name, for what is marked; end : s, of the axes."""
    impact, section, limit = history.impact, case.section, None if case.section is None else case.section.yield_stress
    largest, _, unit = largest_of(section)
    marked: dict[str, Any] = {
        "force": _words(numbers.get("peak_force"), "N"),
        "stress": _words(numbers.get(largest), unit),
    }
    groups = rf"$\kappa/\nu$ = {impact.kappa_over_nu:.4g}, $\eta/T^*$ = {impact.relative_damping:.3g}"
    groups += rf", $T^*$ = {1e3 * impact.slow_time_scale:.4g} ms"
    known = history.described(case.title, section)
    return sheet(known, case.title or groups, min(end, float(history.time[-1])), **marked, yield_stress=limit)


def _words(number: Number | Band | None, unit: str) -> str:
    """A largest value beside its mark."""
    if number is None or not (isinstance(number, Band) or number.measured):
        return ""
    value, written = in_unit(number, unit)
    if isinstance(number, Band):
        return f"largest {value.partition(' (')[0]} {written}, band of {number.runs} runs"
    return f"largest {value} {written}"


def animate(history: ImpactHistory, file: Path, end: float) -> Path:
    """The beam over the wall with the points that push, and the force so far, until ``end``, s, as an animated GIF."""
    end = min(end, float(history.time[-1]))
    chosen = [int(np.argmin(np.abs(history.time - t))) for t in np.linspace(0.0, end, FRAMES)]
    when, place = contacts(history)
    shapes = [heights(history, k) for k in chosen]
    high = 1e3 * max(float(height.max()) for _, height in shapes)
    pictures: list[Any] = []
    with style.figure(2, 1, width=4.6, height=4.0, height_ratios=[1.5, 1]) as (fig, (top, below)):
        draw_wall(top, history, 0.0, 0.2e-3 * high, 1e3)
        half = 0.525 * history.impact.length
        top.set(xlabel="$x$  (m)", ylabel="height  (mm)", xlim=(-half, half), ylim=(-0.2 * high, 1.1 * high))
        (beam,) = top.plot([], [], color=style.COLOURS["blue"], lw=1.8)
        (touch,) = top.plot([], [], color=style.COLOURS["vermilion"], ls="", marker="^", ms=5)
        clock = top.text(0.99, 0.97, "", transform=top.transAxes, ha="right", va="top")
        draw_force(below, history, end)
        below.set_xlabel("time  (ms)")
        past = below.axvline(0.0, color="black", lw=1.0)
        film = Film(fig, (beam, touch, clock, past))
        for k, (x, height) in zip(chosen, shapes):
            time = history.time[k]
            beam.set_data(x, 1e3 * height)
            near = np.abs(when - time) <= 0.5 * end / FRAMES
            touch.set_data(place[near], np.zeros(int(near.sum())))
            clock.set_text(f"{1e3 * time:.3g} ms")
            past.set_xdata([1e3 * time, 1e3 * time])
            pictures.append(film.picture())
    write_gif(pictures, file, PER_SECOND)
    return file
