"""One impact by Exudyn, from its chosen parts to its history.

    μ y_tt + EI y_xxxx = EI q₀ + μ a₀ − r,   0 ≤ r ⊥ −y ≥ 0                       (thesis 2.1.1–2)

The beam is modelled in the units of :mod:`exudyn_models.geometry`, with the initial shape, velocity field and load for
which, without contact, y₀ of :class:`bent_beam.Impact` is the motion.
"""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable
from dataclasses import is_dataclass
from typing import Any

import numpy as np

from bent_beam import Impact, ImpactHistory, SimulationError
from bent_beam.checks import MOST_INSTANTS, whole
from bent_beam.fields import describe
from bent_beam.method import Save
from exudyn_models.arrays import Array
from exudyn_models.assembly import Chosen, Layout, lay_out
from exudyn_models.solvers import quiet
from exudyn_models.stepping import Stepping, Until
from exudyn_models.warnings_of_run import warnings_of_run

__all__ = ["run", "saved_times"]


def run(
    impact: Impact,
    end: float,
    chosen: Chosen,
    save: Save,
    *,
    view: bool,
    progress: Callable[[float], object] | None,
    until: Until | None,
) -> ImpactHistory:
    """Follow ``impact`` to ``end``, s; arguments and errors are those of :func:`exudyn_models.simulate`."""
    targets, began = saved_times(save, end), clock.perf_counter()
    layout = lay_out(impact, end, chosen)
    with quiet():
        stepping = Stepping(layout, chosen, targets, progress, until)
        stepping.through(view)
    record, failure, advice = stepping.run, stepping.failure, stepping.advice
    if failure is not None and not record.record["time"]:
        raise SimulationError(failure, time=0.0, step=0, advice=advice)
    settings = {"end_time": end, "save": np.asarray(save).tolist(), "full_beam": chosen.full_beam}
    settings |= _described(layout, chosen, stepping)
    settings["wall_seconds"] = clock.perf_counter() - began
    history = record.history(
        steps=stepping.steps,
        seconds=stepping.seconds,
        completed=failure is None,
        settings=settings,
    )
    history = history.with_warnings(warnings_of_run(layout, chosen, stepping, history))
    if failure is not None:
        raise SimulationError(
            failure, time=float(history.time[-1]), step=stepping.steps, advice=advice, history=history
        )
    return history


def saved_times(save: Save, end: float) -> Array:
    """The times to save in units of ``end``, ascending, after 0; the last is the end itself. Raises ``ValueError``."""
    if isinstance(save, (int, np.integer)):
        if whole("save", int(save), 1) > MOST_INSTANTS:
            raise ValueError(f"save must be at most {MOST_INSTANTS} instants (got {save})")
        return np.asarray((np.arange(1, save + 1) / save) ** 2)
    times = np.unique(np.asarray(save, float)) / end
    if times.ndim != 1 or not np.isfinite(times).all() or (times < 0.0).any() or (times > 1.0 + 1e-9).any():
        raise ValueError(f"save must be a number of instants or times from 0 to the end time {end:.6g} s")
    return np.append(times[(times > 0.0) & (times < 1.0 - 1e-9)], 1.0)


def _described(layout: Layout, chosen: Chosen, stepping: Stepping) -> dict[str, Any]:
    """The parts and what was chosen with them, JSON-ready; times in s, lengths in m."""
    scaling, segments, settling = layout.scaling, stepping.segments, stepping.settling
    settings: dict[str, Any] = {n: describe(part) for n, part in vars(chosen).items() if is_dataclass(part)}
    settings["contact"] |= stepping.run.contact.settings()
    settings |= {
        "hold": stepping.run.hold(),
        "nodes": int(layout.shape.s.size),
        "modelled_half_length": float(layout.half_length),
        "amplitude": scaling.amplitude,
        "amplitude_of_the_real_beam": scaling.true_amplitude,
        "ends": "moment and shear of the free motion" if layout.ends_follow else "free",
        "first_step": segments[0].length * scaling.end_time,
        "last_step": segments[-1].length * scaling.end_time,
    }
    if math.isfinite(stepping.stable):
        settings["stable_step"] = stepping.stable * scaling.end_time
    if settling is not None:
        settings |= {"contact_cycles": settling.cycles, "unsettled_steps": settling.unsettled}
    return settings
