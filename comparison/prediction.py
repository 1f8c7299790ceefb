"""One beam: the theory of its first instants beside a simulation of the beam as it is, and its whole impact.

The theory says what closed forms and formulas allow (:mod:`theory.validity`). The simulation runs the whole beam with
its ends, loads, damping and wall. Early times are simulated on elements that resolve them, later ones on even elements.
Error bars are those of :mod:`comparison.companions`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from bent_beam.cases import Case
from bent_beam.errors import SimulationError
from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.method import Method, for_whole_beam, refined, simulate_to_separation
from comparison.companions import EARLY, companions_of, number_of
from comparison.summary import energy_at_end, loss_warnings, numerical_loss
from comparison.whole_impact.stored_map import bounce_from_map
from measure.front import half_contact_length, mean_reaction
from measure.measured import Band, Measured
from measure.reduction import peak_moment
from measure.whole_impact import whole_impact
from theory import Prediction, predict

__all__ = ["COMPARED", "predict_case"]

PATH = "hermite"
COMPARED = ("half_contact_length", "reaction", "impulse", "peak_moment", "peak_stress")
"""What theory and simulation both say at a time."""

BEYOND = 1.15  # times the last time: readings take a tenth of the time before and after
INSTANTS = 400  # saved of a run
CHECKED = 24  # instants between a hundredth of the last time and the last, at which theory and simulation are compared
AGREE = 0.02  # of the theory's number, beyond the error bar
FINEST, USUAL_END = 2.0, 0.05  # resolution of the whole beam's own choice, up to this time, T*; later ones are coarser
WIDE = 0.05  # error bar of the map's largest moment over its value, beyond which the beam is simulated
LATEST = 20.0  # T*: later times are not simulated
COARSE, INSTANTS_OF_IMPACT = 0.5, 1000  # resolution and saved instants a T* of a whole impact
LONGEST = 3.0  # T*: a loaded beam that is then still at the wall is not followed further
DAMPING_RATIOS = (0.002, 0.01, 0.05)  # of the first mode: of a plain steel bar, of one with joints, of a damped one
STEEP = 0.3  # slope of the bow at the beam's ends from which the small-slope theory deserves a warning

Progress = Callable[[float], None]


def predict_case(
    case: Case, times: Sequence[float], *, theory_only: bool = False, progress: Progress | None = None
) -> dict[str, Any]:
    """The contract of ``bentbeam predict --json``.

    times : s, each ≥ 0. progress : called with the finished fraction of the simulations.
    Raises ``ValueError`` for what the theory does not cover, :class:`bent_beam.SimulationError` where a simulation
    cannot finish.
    """
    impact, method = case.impact, None if theory_only else case.method(PATH)
    checked = [] if theory_only else list(_checked(times))
    prediction = predict(impact, [*times, *checked], section=case.section)
    document = prediction.to_dict()
    rows = document["times"]
    document["times"] = rows[: len(times)]
    document["warnings"] = _warnings(impact)
    document["agreement"] = None
    if method is not None:
        told = progress or (lambda _: None)
        simulated, warnings = _simulated(case, method, [*times, *checked], told)
        for row, found in zip(document["times"], simulated):
            row["simulation"] = {name: number.to_dict() for name, number in found.items()}
        document["agreement"] = _agreement(checked, prediction, simulated, len(times))
        document["warnings"] += warnings
    document["whole_impact"] = _whole_impact(case, method)
    return document


def _checked(times: Sequence[float]) -> Iterator[float]:
    last = max(times)
    if last > 0.0:
        yield from (float(t) for t in np.geomspace(0.01 * last, last, CHECKED))


def _warnings(impact: Impact) -> list[str]:
    slope = impact.relative_curvature * impact.half_length
    if slope < STEEP:
        return []
    return [
        f"the bow's own slope at its ends is {slope:.2g}: theory and simulation are for small slopes (at 0.5 the force "
        "is about 10 % larger)"
    ]


# --- the simulation at the times asked -----------------------------------------------------------------------------


def _simulated(
    case: Case, method: Method, times: Sequence[float], progress: Progress
) -> tuple[list[dict[str, Measured]], list[str]]:
    """What the runs say at each time, and their warnings."""
    impact = case.impact
    bound, last = EARLY * impact.slow_time_scale, LATEST * impact.slow_time_scale
    early, late = [t for t in times if 0.0 < t <= bound], [t for t in times if bound < t <= last]
    found: dict[float, dict[str, Measured]] = {t: {} for t in times}
    warnings: list[str] = []
    if max(times) > last:
        warnings.append(f"times beyond {last:.4g} s ({LATEST:g} T*) are not simulated here: bentbeam simulate")
    groups = [(early, method), (late, _for_late_times(method, impact, max(late, default=0.0)))]
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


def _for_late_times(method: Method, impact: Impact, end: float) -> Method:
    """``method`` for the whole beam, the finer the sooner the run ends."""
    factor = FINEST * min(1.0, (USUAL_END * impact.slow_time_scale / end) ** (1.0 / 3.0)) if end > 0.0 else 1.0
    return for_whole_beam(refined(method, factor) or method, impact)


def _runs(
    case: Case, method: Method, times: Sequence[float], progress: Progress
) -> tuple[list[dict[str, Measured]], list[str]]:
    """One run and its companions, read at ``times``."""
    end = BEYOND * max(times)
    save = np.unique(np.concatenate([np.linspace(0.0, end, INSTANTS + 1)[1:], times]))
    methods = [method, *companions_of(method, case.impact, end)]
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
        "element": _element_at(history, k, front),
    }


def _element_at(history: ImpactHistory, k: int, place: float) -> float:
    """Length of the element at ``place`` from the middle, m."""
    x = np.unique(np.abs(history.positions(k)))
    at = min(max(int(np.searchsorted(x, place)), 1), x.size - 1)
    return float(x[at] - x[at - 1])


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
    best, begin = (0, 0), 0
    for i, both in enumerate([*agree, False]):
        if not both:
            best = max(best, (i - begin, -begin))
            begin = i + 1
    length, begin = best[0], -best[1]
    return {"from": checked[begin], "until": checked[begin + length - 1]} if length else None


# --- the whole impact -----------------------------------------------------------------------------------------------


def _whole_impact(case: Case, method: Method | None) -> dict[str, Any] | None:
    """Restitution, last contact, largest moment and stress of the whole impact, SI; ``None`` where nothing says them.

    From the stored map where it reaches and is sure: a beam without loads, a second wall or rocking. Otherwise by
    simulation.
    """
    impact = case.impact
    free = not (impact.loaded or impact.off_centre) and impact.opposite_wall is None
    found: Any = bounce_from_map(impact.kappa_over_nu, impact.relative_damping) if free else None
    source = "stored map"
    wide = found is not None and impact.damping > 0.0 and found["peak_moment"].error > WIDE * found["peak_moment"].value
    if (found is None or wide) and method is not None and impact.opposite_wall is None:
        found, source = _followed(impact, method), "simulation"
    if found is None:
        return None
    return {
        "restitution": found["restitution"].to_dict(),
        "last_contact": found["last_contact"].scaled(impact.slow_time_scale).to_dict(),
        **_peaks(case, found["peak_moment"]),
        "peak_force": None,
        "source": source,
        "over_damping": _over_damping(case) if free else [],
    }


def _peaks(case: Case, largest: Measured | Band) -> dict[str, Any]:
    """Largest moment, N m, and stress, Pa, from the moment over V₀√(μEI)."""
    impact, section = case.impact, case.section
    moment = largest.scaled(impact.velocity * (impact.bending_stiffness * impact.mass_per_length) ** 0.5)
    stress = None
    if section is not None:
        stress = moment.scaled(1.0 / section.section_modulus, section.stress(0.0, impact.axial_force)).to_dict()
    return {"peak_moment": moment.to_dict(), "peak_stress": stress}


def _over_damping(case: Case) -> list[dict[str, Any]]:
    """Largest moment and stress of the whole impact over a plausible range of the material's damping ratio."""
    found = []
    for ratio in DAMPING_RATIOS:
        numbers = bounce_from_map(case.impact.kappa_over_nu, ratio * LOWEST_PERIOD / math.pi)
        if numbers is not None:
            found.append({"damping_ratio": ratio, **_peaks(case, numbers["peak_moment"])})
    return found


def _followed(impact: Impact, method: Method) -> dict[str, Measured | Band]:
    """The whole impact by one run and its companions; restitution is missing where the beam has not left."""
    chosen = for_whole_beam(refined(method, COARSE) or method, impact)
    longest = LONGEST * impact.slow_time_scale
    outcomes = [
        whole_impact(simulate_to_separation(one, impact, longest=longest, save=INSTANTS_OF_IMPACT))
        for one in (chosen, *companions_of(chosen, impact, longest))
    ]
    left = all(outcome.left for outcome in outcomes)
    found: dict[str, Measured | Band] = {}
    for name in ("restitution", "last_contact", "peak_moment"):
        values = [float(getattr(outcome, name)) for outcome in outcomes]
        number = number_of(values, impact) if impact.damping else Band.of(values)
        found[name] = number if left or name == "peak_moment" else Measured()
    return found
