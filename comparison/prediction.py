"""One beam: the theory of its first instants beside a simulation of the beam as it is, and its whole impact.

The theory says what closed forms and formulas allow (:mod:`theory.validity`). The simulation runs the whole beam with
its ends, loads, damping and wall. Early times are simulated on elements that resolve them, later ones on even elements.
Error bars are those of :mod:`comparison.companions`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import groupby
from typing import Any

import numpy as np

from bent_beam.cases import Case
from bent_beam.errors import SimulationError
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.measure.measured import Measured
from bent_beam.measure.moments import element_at, half_contact_length, mean_reaction
from bent_beam.measure.reduction import peak_moment
from bent_beam.method import Method, for_whole_beam, refined
from comparison.companions import companions_of, is_late, number_of
from comparison.summary import energy_at_end, loss_warnings, numerical_loss
from comparison.whole_impact.predicted import predicted_impact
from theory import Prediction, predict

__all__ = ["COMPARED", "predict_case"]

PATH = "hermite"
COMPARED = ("half_contact_length", "reaction", "impulse", "peak_moment", "peak_stress")
"""What theory and simulation both say at a time."""

BEYOND = 1.15  # times the last time: readings take a tenth of the time before and after
INSTANTS = 400  # saved of a run
CHECKED = 24  # instants between a hundredth of the last time and the last, at which theory and simulation are compared
AGREE = 0.02  # of the theory's number, beyond the error bar
FINEST, USUAL_END = 2.0, 0.05  # resolution over the whole beam's own choice, up to this time, T*
LATEST = 20.0  # T*: later times are not simulated
STEEP = 0.3  # slope of the bow at the beam's ends from which the small-slope theory deserves a warning

Progress = Callable[[float], None]


def predict_case(
    case: Case,
    times: Sequence[float],
    *,
    theory_only: bool = False,
    whole: bool = True,
    progress: Progress | None = None,
) -> dict[str, Any]:
    """The contract of ``bentbeam predict --json``.

    times : s, each ≥ 0. whole : also the whole impact, which may take runs of its own.
    progress : called with the finished fraction of the simulations.
    Raises ``ValueError`` for what the theory does not cover, :class:`bent_beam.SimulationError` where a simulation
    cannot finish.
    """
    impact, method = case.impact, None if theory_only else case.method(PATH)
    last = max(times)
    checked = [] if theory_only or last <= 0.0 else np.geomspace(0.01 * last, last, CHECKED).tolist()
    prediction = predict(impact, [*times, *checked], section=case.section)
    document = prediction.to_dict()
    rows = document["times"]
    document["times"] = rows[: len(times)]
    document["model"], document["warnings"] = impact.model, _warnings(impact)
    document["agreement"], document["yield_stress"] = None, getattr(case.section, "yield_stress", None)
    if method is not None:
        told = progress or (lambda _: None)
        simulated, warnings = _simulated(case, method, [*times, *checked], told)
        for row, found in zip(document["times"], simulated):
            row["simulation"] = {name: number.to_dict() for name, number in found.items()}
        document["agreement"] = _agreement(checked, prediction, simulated, len(times))
        document["warnings"] += warnings
    document["whole_impact"] = predicted_impact(case, method) if whole else None
    return document


def _warnings(impact: Impact) -> list[str]:
    slope = impact.relative_curvature * impact.half_length
    steep = (
        f"the bow's own slope at its ends is {slope:.2g}: theory and simulation are for small slopes (at 0.5 the force "
        "is about 10 % larger)"
    )
    return [steep] if slope >= STEEP else []


# --- the simulation at the times asked -----------------------------------------------------------------------------


def _simulated(
    case: Case, method: Method, times: Sequence[float], progress: Progress
) -> tuple[list[dict[str, Measured]], list[str]]:
    """What the runs say at each time, and their warnings."""
    impact = case.impact
    last = LATEST * impact.slow_time_scale
    early = [t for t in times if t > 0.0 and not is_late(impact, t)]
    late = [t for t in times if is_late(impact, t) and t <= last]
    found: dict[float, dict[str, Measured]] = {t: {} for t in times}
    warnings: list[str] = []
    if max(times) > last:
        warnings.append(f"times beyond {last:.4g} s ({LATEST:g} T*) are not simulated here: bentbeam simulate")
    refine = _fineness(impact, max(late, default=0.0))
    groups = [(early, method), (late, for_whole_beam(refined(method, refine) or method, impact))]
    share = 1.0 / sum(bool(group) for group, _ in groups) if early or late else 1.0
    for group, chosen in groups:
        if group:
            rows, said = _runs(case, chosen, group, _part_of(progress, share, bool(early) and group is late))
            found |= dict(zip(group, rows))
            warnings += said
    return [found[t] for t in times], sorted(set(warnings))


def _part_of(progress: Progress, share: float, before: int) -> Progress:
    """Progress of a job that is ``share`` of the whole, after ``before`` such jobs."""
    return lambda part: progress(share * (before + part))


def _fineness(impact: Impact, end: float) -> float:
    """Of a run of the whole beam over its usual choice: the finer the sooner the run ends."""
    return FINEST * min(1.0, (USUAL_END * impact.slow_time_scale / end) ** (1.0 / 3.0)) if end > 0.0 else 1.0


def _runs(
    case: Case, method: Method, times: Sequence[float], progress: Progress
) -> tuple[list[dict[str, Measured]], list[str]]:
    """One run and its companions, read at ``times``."""
    end = BEYOND * max(times)
    save = np.unique(np.concatenate([np.linspace(0.0, end, INSTANTS + 1)[1:], times]))
    last = max(times)
    methods = [method, *companions_of(method, case.impact, last, _fineness(case.impact, last))]
    read, warnings = [], []
    for i, chosen in enumerate(methods):
        told = _part_of(progress, 1.0 / len(methods), i)
        try:
            history = chosen.simulate(case.impact, end_time=end, save=save, progress=told)
        except SimulationError as error:
            if i == 0:
                raise
            warnings.append(f"no companion run: {error}")
            continue
        read.append([_reading(case, history, t) for t in times])
        warnings += loss_warnings(numerical_loss(energy_at_end(history))) if i == 0 else []
    return [_with_bars([run[i] for run in read], case.impact) for i in range(len(times))], warnings


def _reading(case: Case, history: ImpactHistory, time: float) -> dict[str, float | None]:
    """One run at one time: the wall's numbers are those of the instant, moment and stress the largest until then."""
    k = int(np.argmin(np.abs(history.time - time)))
    moment = peak_moment(history, until=time).moment
    front = half_contact_length(history, k)
    return {
        "half_contact_length": front,
        "reaction": mean_reaction(history, k),
        "impulse": float(history.array("total_impulse")[k]),
        "peak_moment": moment,
        "peak_stress": None if case.section is None else case.section.stress(moment, case.impact.axial_force),
        "element": element_at(history, k, front),
    }


def _with_bars(runs: Sequence[dict[str, float | None]], impact: Impact) -> dict[str, Measured]:
    """The numbers of one time from the run and its companions."""
    found = {}
    for name in COMPARED:
        values = [value for run in runs if (value := run[name]) is not None]
        if len(values) == len(runs):
            element = runs[0]["element"] or 0.0
            found[name] = number_of(values, impact, element if name == "half_contact_length" else 0.0)
    return found


def _agreement(
    checked: Sequence[float], prediction: Prediction, simulated: Sequence[dict[str, Measured]], first: int
) -> dict[str, float] | None:
    """The longest interval between checked instants in which half length and impulse agree within the error bars and
    2 %; ``None`` where they agree at none."""
    agree = []
    for row, found in zip(prediction.times[first:], simulated[first:]):
        pairs = [(getattr(row, name), found.get(name)) for name in ("half_contact_length", "impulse")]
        agree.append(
            all(a is not None and b is not None and abs(b.known - a) <= b.bar + AGREE * abs(a) for a, b in pairs)
        )
    spans = [list(span) for both, span in groupby(range(len(agree)), key=agree.__getitem__) if both]
    longest = max(spans, key=len, default=None)
    return {"from": checked[longest[0]], "until": checked[longest[-1]]} if longest else None
