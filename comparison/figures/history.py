"""One run on one sheet (:mod:`comparison.figures.panels`) in the units of its case: a history of any kind
(``bentbeam plot``), with its impulse beside the theory and its energies; a whole impact (``predict``, ``bounce`` with
``--out``), with its numbers, and as an animation."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam import Case, ImpactHistory, InputError
from bent_beam.measure.numbers import MISSING, Band, Number
from comparison.doubts import comparable
from comparison.figures import style
from comparison.figures.panels import contacts, draw_force, draw_wall, heights, impulse_given, sheet
from comparison.readable import in_unit, largest_of
from theory import predict

FRAMES, PER_SECOND = 90, 18
MARGIN = 1.15  # times the last push, or the largest moment: the end of the axes
NEARLY = 0.7  # of the record: where that is later, all of it is drawn
GIVEN = 0.999  # of the impulses: what comes later is none of the last push
SEEN = 0.02  # of the axis: less of a theory's time is no line
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
    if history.time.size < 2:
        raise InputError(f"{name}: one saved instant is nothing to draw")
    end, reach = _window(history)
    title = str(history.attrs.get("title", name))
    return style.save(sheet(history, title, end, reach=reach, below=(_impulse, _energies)), out, name, formats)


def _window(history: ImpactHistory) -> tuple[float, float]:
    """Until when a run is drawn, s: somewhat beyond its last push and its largest moment; and how far from the middle,
    m: beyond the pushes and the waves that left them."""
    time, names = history.time, [name for name in ("impulse", "opposite_impulse") if name in history]
    pushed = impulse_given(history)
    last = float(time[np.searchsorted(pushed, GIVEN * pushed[-1])])
    end = MARGIN * max(last, float(time[np.argmax(history.moment)]))
    end = float(time[-1]) if end == 0.0 or end > NEARLY * time[-1] else end
    given = np.abs(np.sum([history.array(name, -1) for name in names], axis=0))
    places = np.abs(history.contact_positions(-1)[given > 1e-3 * given.max(initial=1e-300)])
    wave = 2.0 * float(np.sqrt(history.impact.wave_constant * end))
    return end, 1.5 * max(float(places.max(initial=0.0)), wave)


def _impulse(axis: Any, history: ImpactHistory, end: float) -> None:
    axis.plot(1e3 * history.time, history.array("total_impulse"), color=style.COLOURS["blue"], label=history.path)
    if comparable(history.impact):
        found = predict(history.impact, history.time[(history.time > 0.0) & (history.time <= end)])
        shown = [(1e3 * row.time, row.impulse) for row in found.times if row.valid and row.impulse is not None]
        if shown and shown[-1][0] > SEEN * 1e3 * end:
            axis.plot(*zip(*shown), **{**style.THEORY, "ls": "--"})
    axis.set(xlabel="time  (ms)", ylabel="impulse  (N s)", xlim=(0.0, 1e3 * end))
    axis.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=2, borderpad=0.0)


def _energies(axis: Any, history: ImpactHistory, end: float) -> None:
    """Changes since the first touch, and losses by cause: a colour each."""
    curves = [("kinetic_energy", "kinetic", "-"), ("strain_energy", "strain", "-"), ("contact_energy", "wall", "-")]
    curves += [(name, f"lost: {label}", "--") for name, label in LOSSES.items()]
    curves += [("work_of_loads", "work of loads", ":")]
    shown = [(name, label, dashes) for name, label, dashes in curves if np.any(history.energy(name))]
    for (name, label, dashes), colour in zip(shown, (*style.SEQUENCE, style.COLOURS["black"], style.COLOURS["yellow"])):
        values = history.array(name)
        axis.plot(1e3 * history.time, values - values[0], ls=dashes, color=colour, label=label)
    axis.set(xlabel="time  (ms)", ylabel="change of energy  (J)", xlim=(0.0, 1e3 * end))
    axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.32), ncols=3, fontsize=6.5, columnspacing=1.0)


def impact_figure(history: ImpactHistory, case: Case, numbers: Mapping[str, Number | Band], end: float) -> Any:
    """A run of a case on one sheet. numbers : SI, by name, for what is marked; end : s, of the axes."""
    impact, section, limit = history.impact, case.section, None if case.section is None else case.section.yield_stress
    largest, _, unit = largest_of(section)
    force, stress = _words(numbers.get("peak_force", MISSING), "N"), _words(numbers.get(largest, MISSING), unit)
    groups = rf"$\kappa/\nu$ = {impact.kappa_over_nu:.4g}, $\eta/T^*$ = {impact.relative_damping:.3g}"
    groups += rf", $T^*$ = {1e3 * impact.slow_time_scale:.4g} ms"
    known = history.described(case.title, section)
    end = min(end, float(history.time[-1]))
    return sheet(known, case.title or groups, end, force=force, stress=stress, yield_stress=limit)


def _words(number: Number | Band, unit: str) -> str:
    """A largest value beside its mark; nothing where there is none."""
    value, written = in_unit(number, unit)
    if isinstance(number, Band):
        return f"largest {value.partition(' (')[0]} {written}, band of {number.runs} runs"
    return f"largest {value} {written}" if number.measured else ""


def animate(history: ImpactHistory, file: Path, end: float) -> Path:
    """The beam over the wall with the points that push, and the force so far, until ``end``, s, as an animated GIF."""
    end = min(end, float(history.time[-1]))
    chosen = [int(np.argmin(np.abs(history.time - t))) for t in np.linspace(0.0, end, FRAMES)]
    when, place = contacts(history)
    shapes = [heights(history, k) for k in chosen]
    high = 1e3 * max(float(height.max()) for _, height in shapes)
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

        def frames() -> Iterator[None]:
            for k, (x, height) in zip(chosen, shapes):
                time = history.time[k]
                beam.set_data(x, 1e3 * height)
                near = np.abs(when - time) <= 0.5 * end / FRAMES
                touch.set_data(place[near], np.zeros(int(near.sum())))
                clock.set_text(f"{1e3 * time:.3g} ms")
                past.set_xdata([1e3 * time, 1e3 * time])
                yield

        style.write_gif(fig, (beam, touch, clock, past), frames(), file, PER_SECOND)
    return file
