"""Where the theory of the first instants ends on a real beam: measured, over κ/ν and η/T*.

Two things end it. **Waves that have been at the ends**: the same beam and one that is so long that nothing can come
back, on the same elements with the same steps, differ by them alone; the time at which half length, force or impulse
first differ by 1, 2 or 5 % is stored. **The beam's own damping**, which is not in the theory of a spreading contact: it
is felt first and forgotten later. On the long beam it has one number, t/η; the age from which theory and simulation
agree within the tolerance is stored, ``null`` where the long beam is not long enough to see it.

Half length and force come from moments of the impulse: parabolas in √t through ±:data:`WINDOW` in ln t.
``python -m comparison.whole_impact.ends`` measures all (a minute on a machine of its own) and writes ``ends.json``
beside this module, and what ``predict`` reads of it, ``ends.json`` in :mod:`theory`.
"""

from __future__ import annotations

import argparse
import datetime
import json
import math
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

import theory
from bent_beam.history import versions
from bent_beam.impact import Impact
from comparison.bounce import problem
from comparison.plain import json_text
from comparison.store import write_atomically
from comparison.workers import run_all
from theory import damped_point
from theory.stopped_beam import StoppedBeam

__all__ = ["Law", "law_of", "measured_ends", "reached", "without_ends"]

Array = NDArray[np.float64]
DATA = Path(__file__).with_name("ends.json")
FOR_THEORY = Path(theory.__file__).with_name("ends.json")
TOLERANCES = (0.01, 0.02, 0.05)
KAPPAS = (0.05, 0.1, 0.15, 0.2, 0.25, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0)
DAMPINGS = (1e-4, 3e-4, 1e-3, 3e-3, 1e-2)
TOLERANCE = 0.02  # of the table that predict reads
LATEST = 2000.0  # t/η that stands for a damping that was not seen to be forgotten
USUAL = 1e-3  # η/T* of the table that predict reads
WINDOW = 0.11  # half an e-fold of fitted times, in ln t
END = 0.08  # T*
LONGER = 2.5  # times the beam: what comes back from its ends then comes 6.25 times later
TIMES = np.geomspace(1.5e-3, END / math.exp(WINDOW), 160)
"""Instants looked at, T*: the first is where an element of the mesh is a tenth of what a wave has covered."""


class Law(NamedTuple):
    """Half length (ℓ), force and impulse of one side (beam's units) at :data:`TIMES`."""

    half_length: Array
    force: Array
    impulse: Array

    def differs(self, other: Law, *, spreads: bool) -> Array:
        """Largest relative difference of the three (of the last two for a point contact)."""
        found = np.maximum(np.abs(self.force / other.force - 1.0), np.abs(self.impulse / other.impulse - 1.0))
        return np.maximum(found, np.abs(self.half_length / other.half_length - 1.0)) if spreads else found


def without_ends(impact: Impact) -> Impact:
    """The beam, so much longer that nothing comes back from its ends while :data:`END` lasts."""
    return impact.replace(length=LONGER * impact.length)


def law_of(impact: Impact, elements: int, times: Array = TIMES, unit: float | None = None) -> Law:
    """A whole-beam run on ``elements`` a half length of the *given* beam (``unit``: of another), by moments.

    times : in T* of the unit length, s if that is 1.
    """
    from bent_beam.meshes import UniformMesh
    from bent_beam.method import method_from_tables

    length = impact.half_length if unit is None else unit
    scale = length**2 / impact.wave_constant
    method = method_from_tables("hermite", {})
    method = type(method)(mesh=UniformMesh(length / elements)).for_whole_beam(impact)
    end = float(times[-1]) * math.exp(WINDOW) * scale
    saved = np.unique(np.concatenate([np.linspace(0.0, end, 1200)[1:], end * np.linspace(0.05, 1.0, 400) ** 2]))
    history = method.simulate(impact, end_time=end, save=saved)
    time = history.time / scale
    impulse = history.array("total_impulse") / 2.0
    moment = history.array("impulse") @ np.abs(history.contact_positions(0))
    moment = moment if history.dataset.attrs["symmetry"] == "half" else moment / 2.0
    with np.errstate(divide="ignore", invalid="ignore"):
        return _fitted(time, impulse, moment, times)


def _fitted(time: Array, impulse: Array, moment: Array, times: Array) -> Law:
    fits = np.array([[*_local(time, impulse, t), _local(time, moment, t)[1]] for t in times])
    force = fits[:, 1] / (2.0 * np.sqrt(times))
    return Law(fits[:, 2] / fits[:, 1], force, fits[:, 0])


def _local(time: Array, values: Array, at: float) -> tuple[float, float]:
    """Value and slope in √t at ``at``, of a parabola in √t around it."""
    inside = (time > at * math.exp(-WINDOW)) & (time < at * math.exp(WINDOW))
    root = np.sqrt(time[inside])
    fit = np.polyfit(root - math.sqrt(at), values[inside], 2)
    return float(fit[2]), float(fit[1])


def theory_law(kappa: float, times: Array = TIMES) -> Law:
    """The undamped infinite beam's law in the beam's units."""
    exact = theory.contact_parameters(kappa)
    force = math.sqrt(2.0 / math.pi) * exact.r0
    return Law(exact.lambda0 * np.sqrt(times), force / np.sqrt(times), 2.0 * force * np.sqrt(times))


def reached(times: Array, error: Array, tolerance: float) -> float | None:
    """When an error that grows first reaches ``tolerance``, by interpolation; ``None`` if it does not."""
    beyond = np.flatnonzero(error >= tolerance)
    if beyond.size == 0:
        return None
    k = int(beyond[0])
    if k == 0:
        return 0.0
    share = (tolerance - error[k - 1]) / (error[k] - error[k - 1])
    return float(times[k - 1] * (times[k] / times[k - 1]) ** share)


def forgotten(times: Array, error: Array, tolerance: float) -> float | None:
    """From when on an error that falls stays below ``tolerance``; ``None`` if it does not."""
    beyond = np.flatnonzero(error >= tolerance)
    if beyond.size == 0:
        return float(times[0])
    k = int(beyond[-1]) + 1
    return float(times[k]) if k < times.size else None


def measure_point(kappa: float, damping: float, elements: int = 200) -> dict[str, Any]:
    """One κ/ν and η/T*: times (T*) by tolerance until which ends are not felt, ages (η) from which damping is not."""
    impact = problem(kappa, damping)
    spreads = kappa < 1.0
    real = law_of(impact, elements)
    endless = law_of(without_ends(impact), elements, unit=impact.half_length)
    ends = real.differs(endless, spreads=spreads)
    damped = endless.differs(theory_law(kappa), spreads=spreads)
    seen = TIMES < 0.9 * END
    ages = [forgotten(TIMES[seen] / damping, damped[seen], tolerance) for tolerance in TOLERANCES]
    return {
        "kappa_over_nu": kappa,
        "damping": damping,
        "until": {str(tolerance): reached(TIMES, ends, tolerance) for tolerance in TOLERANCES},
        "damping_forgotten": {str(tolerance): age for tolerance, age in zip(TOLERANCES, ages)},
    }


def _lost(i: int, why: str) -> Any:
    raise RuntimeError(f"point {i}: {why}")


def measure(
    kappas: Sequence[float] = KAPPAS,
    dampings: Sequence[float] = DAMPINGS,
    *,
    elements: int = 200,
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> list[dict[str, Any]]:
    """All points, in the order of ``dampings``, ``kappas``."""
    return run_all(
        measure_point,
        [(kappa, damping, elements) for damping in dampings for kappa in kappas],
        jobs=jobs,
        progress=progress,
        on_death=_lost,
    )


def _age(at: dict[tuple[float, float], dict[str, Any]], kappa: float) -> float:
    """t/η from which damping is forgotten, from the run with the usual damping or, if it is too short, with less."""
    for damping in sorted((d for d, k in at if k == kappa and d <= USUAL), reverse=True):
        age = at[damping, kappa]["damping_forgotten"][str(TOLERANCE)]
        if age is not None:
            return float(age)
    return LATEST


def one_point(damping: float, tolerance: float = TOLERANCE) -> float:
    """t/T* until which the ends change impulse and momentary force of one point by less, exact for κ/ν ≥ 1."""
    times = np.geomspace(1e-3, 0.1, 4000)
    beam, age = StoppedBeam(damping), times / damping
    endless = 2.0 * np.sqrt(2.0 / math.pi) * np.sqrt(times)
    force = beam.reaction(times) * times / (endless * damped_point.reaction_ratio(age))
    impulse = beam.impulse(times) / (2.0 * endless * damped_point.impulse_ratio(age))
    found = reached(times, np.maximum(np.abs(force - 1.0), np.abs(impulse - 1.0)), tolerance)
    assert found is not None
    return found


def write(points: Sequence[dict[str, Any]], elements: int) -> list[Path]:
    """Write both files."""
    provenance: dict[str, Any] = {
        "made_by": "python -m comparison.whole_impact.ends",
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "versions": versions(),
        "settings": {"path": "hermite", "elements": elements, "longer": LONGER, "window": WINDOW, "end": END},
    }
    write_atomically(
        DATA,
        json_text(
            {
                "what": "until: t/T* at which waves back from the ends first change half length, force or impulse by "
                "so much; damping_forgotten: t/eta from which the undamped law holds so well on an endless beam",
                **provenance,
                "points": list(points),
            },
            indent=1,
        )
        + "\n",
    )
    at = {(p["damping"], p["kappa_over_nu"]): p for p in points}
    kappas, dampings = sorted({k for _, k in at}), sorted({d for d, _ in at})
    times = {key: p["until"][str(TOLERANCE)] for key, p in at.items()}
    ages = np.maximum.accumulate([_age(at, k) for k in kappas[::-1]])[::-1]  # what swings counts until it is over
    least = {d: min(times[d, k] / times[USUAL, k] for k in kappas) for d in dampings}
    exact = {d: one_point(d) / one_point(USUAL) for d in (1e-5, *dampings)}
    factors = {d: min(factor, least.get(d, factor)) for d, factor in exact.items()}
    write_atomically(
        FOR_THEORY,
        json_text(
            {
                "what": "t/T* until which the infinite beam's half length, force and impulse are those of the finite "
                "beam within `tolerance`, no loads; `time` over `kappa_over_nu` at damping eta/T* = 1e-3, `factor` "
                "over `damping` for other eta (the least of all kappa/nu and of one point's exact momentary force; the "
                "smallest eta stands for none); "
                "`zone_damping_times`, over `kappa_over_nu`: t/eta from which damping changes a zone by less than the "
                f"tolerance ({LATEST:g}: not seen to)",
                "tolerance": TOLERANCE,
                "source": "the whole beam against one without ends, comparison/whole_impact/ends.py; one point: exact",
                **provenance,
                "kappa_over_nu": kappas,
                "time": [times[USUAL, k] for k in kappas],
                "damping": list(factors),
                "factor": list(factors.values()),
                "zone_damping_times": ages.tolist(),
            },
            indent=1,
        )
        + "\n",
    )
    return [DATA, FOR_THEORY]


@cache
def measured_ends() -> dict[str, Any]:
    """The stored measurement."""
    return dict(json.loads(DATA.read_text(encoding="utf-8")))


def _main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--elements", type=int, default=200)
    asked = parser.parse_args()
    points = measure(
        elements=asked.elements,
        jobs=asked.jobs,
        progress=lambda done, total: print(f"\r{done}/{total}", end="", flush=True),
    )
    for file in write(points, asked.elements):
        print(file)


if __name__ == "__main__":
    _main()
