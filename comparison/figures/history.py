"""One run on one sheet (:mod:`comparison.figures.panels`), with its impulse beside the theory, and its energies."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.history import ImpactHistory
from comparison.figures import style
from comparison.figures.panels import impulse_given, sheet

__all__ = ["draw_history"]

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
    from comparison.simulating import comparable
    from theory import predict

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
