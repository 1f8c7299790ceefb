"""Force and stress of a run (:meth:`bent_beam.ImpactHistory.plot`); `comparison.figures` draws answers."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

CUT_OFF = 0.01  # of the run


def force_and_stress(history: Any) -> Any:
    """Both, one above the other, as a Matplotlib figure: the mean force of the wall between saved instants, cut off at
    the very start, where it falls like 1/√t; the largest stress along the beam, without a section the largest bending
    moment."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(6.0, 5.0), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True)
    force, stress = history.force, history.stress
    top = 1.2 * float(force[history.time >= CUT_OFF * history.time[-1]].max())
    scale = _draw(upper, history, np.minimum(force, top), "force of the wall", "N")
    if top > 0.0:
        upper.set_ylim(top=scale * top)
    if stress is None:
        _draw(lower, history, history.moment, "largest bending moment", "N m")
    else:
        _draw(lower, history, 1e-6 * stress, "largest stress", "MPa")
    return figure


def _draw(axis: Any, history: Any, values: NDArray[np.float64], title: str, unit: str) -> float:
    """Over intervals between saved instants, of which the values are; returns the scale of the axis."""
    large = unit.startswith("N") and float(np.abs(values).max()) >= 1e2  # as bentbeam writes them
    scale, prefix = (1e-3, "k") if large else (1.0, "")
    axis.plot(1e3 * history.time[1:], scale * values[1:], drawstyle="steps-pre")
    axis.set_xlabel("$t$  (ms)")
    axis.set_ylabel(f"{title}  ({prefix}{unit})")
    return scale
