"""The whole impact of one beam: e, impulse, times, moment, stress, energies, with bars; without damping, bands.

Damping has three states. Stated: numbers. Stated 0, or little hysteretic loss: the motion does not converge unless the
wall is soft (docs/whole_impact.md); an ensemble of runs, meshes, steps and contact laws drawn from a seed, gives mean
and standard deviation. Not stated: numbers at each of :data:`DAMPING_RATIOS`, and the answer is that of the largest
moment, so of the largest stress.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam import Case, Impact, ImpactHistory, InputError, load_case
from bent_beam.cases import case_from_tables, check_buckling
from bent_beam.checks import finite, whole
from bent_beam.free_flight import LOWEST_PERIOD, may_return
from bent_beam.hysteresis import converges, first_mode
from bent_beam.measure.balance import balance_of
from bent_beam.measure.numbers import FACTOR, Band, Number
from bent_beam.measure.reduction import moments_around
from bent_beam.measure.whole_impact import WINDOW, Hit, hits, whole_impact
from bent_beam.method import LONGEST_OF_WALL, ON_WALL, Method, for_whole_beam, separation_times, time_on_wall
from comparison.bounced import Bounce
from comparison.doubts import energy_at_end
from comparison.questions import SEED, Progress, Question
from comparison.readable import milliseconds
from comparison.runs import Runs, bands_of, numbers_of, runs_of, unseen_of_moment
from comparison.store import RunStore
from comparison.whole_numbers import FINAL, MAY_RISE, NUMBERS

__all__ = ["DAMPING_RATIOS", "bounce", "case_of", "follow_hits", "problem", "whole_numbers", "whole_reading"]

Beam = Case | Impact | str | Path | Mapping[str, Any]
RUNS = 24  # of a band
DAMPING_RATIOS = (0.0002, 0.002, 0.02)  # of the first mode: bare steel, a bar as it is held, a structure
INSTANTS = 200  # saved a T* of a run that follows hits
FLIGHTS = 50.0  # T*, most that flights under a load add to LONGEST_OF_WALL: a run saves 200 instants a T*
RESTS = 10.0  # periods of the lowest mode: a hit that lasts longer is the last
ABOUT = 0.002  # T*: moments so near the largest are as unsure as it is
RETURNS = 2.0  # bars of the restitution: the mean velocity has one, waves move a point of the beam as much again
LARGEST_KAPPA = 100.0  # beyond, and long before, the beam touches in one point: infinity is calculated as this


def problem(kappa_over_nu: float, damping: float) -> Impact:
    """The beam in units of its half length; κ/ν = ∞ is calculated as a point contact."""
    kappa = LARGEST_KAPPA if kappa_over_nu == math.inf else finite("kappa_over_nu", kappa_over_nu)
    return Impact.whole_beam(kappa, relative_damping=damping)


def whole_reading(history: ImpactHistory) -> dict[str, Any]:
    """A whole impact as it is kept, JSON-ready: :class:`bent_beam.measure.whole_impact.WholeImpact`, times and largest
    moments around the largest, balance and energies."""
    found = asdict(whole_impact(history)) | {"balance": asdict(balance_of(history)), "energy": energy_at_end(history)}
    unit, moment = history.impact.slow_time_scale, history.impact.moment_scale
    times, moments = moments_around(history, found["peak_moment_time"] * unit, WINDOW * unit)
    found["moment_around"] = [(times / unit).tolist(), (moments / moment).tolist()]
    return found | {"loss": history.settings.get("hysteretic_loss")}


def case_of(beam: Beam) -> Case:
    """A case, or that of a file or its tables, or of an impact whose damping is as it says. Raises ``InputError``."""
    if isinstance(beam, Case):
        return beam
    if isinstance(beam, Impact):
        check_buckling(beam)
        return Case(title="", impact=beam, end_time=beam.checked_end_time(), mesh=None, tables={})
    return case_from_tables(beam) if isinstance(beam, Mapping) else load_case(beam)


def bounce(
    beam: Case | Impact,
    method: Method,
    *,
    runs: int | None = None,
    seed: int | None = None,
    save: int | None = None,
    store: RunStore | None = None,
    jobs: int = 1,
    progress: Progress | None = None,
) -> Bounce:
    """Simulate a whole impact, to the last separation, by ``method`` and by the companion runs that it names; where
    the case states no damping, for :data:`DAMPING_RATIOS`.

    runs, seed : of the ensemble, where the beam has no damping. save : saved instants a T*. store : of runs.
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` when it cannot finish.
    """
    case = case_of(beam)
    impact = case.impact
    separation_times(impact)  # refuses what no separation ends
    if not hasattr(method, "for_whole_beam"):
        raise InputError(
            f"path: {method.path} follows no whole impact: take hermite or exudyn (in its code {method.path} lacks "
            "for_whole_beam(impact), docs/guide/add-method.md)"
        )
    ensemble = case.damping_stated and not converges(impact)
    for name, value in (("runs", runs), ("seed", seed)):
        if value is not None and not ensemble:
            raise InputError(
                f"{name} has no effect: only a beam whose damping is stated as 0, and whose wall is not soft, has an "
                f"ensemble (got {value!r})"
            )
    if runs is not None:
        whole("runs", runs, 2)
    how: dict[str, Any] = {"store": store, "jobs": jobs}
    if not case.damping_stated and not (impact.damping or impact.hysteretic_loss):
        return _over_ratios(case, method, progress or (lambda _: None), how | {"save": save})
    band = (RUNS if runs is None else runs, SEED if seed is None else seed) if ensemble else None
    made = runs_of(Question(impact, method, save=save, band=band), whole_reading, progress=progress, **how)
    return Bounce(case, whole_numbers(made), made)


def _over_ratios(case: Case, method: Method, told: Progress, how: dict[str, Any]) -> Bounce:
    """Of the damping ratio with the largest moment, next to the others."""
    found, share = dict[float, Bounce](), 1.0 / len(DAMPING_RATIOS)
    for i, ratio in enumerate(DAMPING_RATIOS):
        damping = ratio / (math.pi * first_mode(case.impact))
        damped = replace(case, impact=case.impact.replace(damping=damping), damping_stated=True)
        found[ratio] = bounce(damped, method, **how, progress=lambda done, i=i: told(share * (i + done)))  # type: ignore[misc]
    return replace(max(found.values(), key=lambda one: one.numbers["peak_moment"].value or 0.0), over=found)


def whole_numbers(made: Runs) -> dict[str, Number | Band]:
    """Every number of a whole impact; those of its end only where the beam left."""
    reading = made.run.reading
    names = NUMBERS if reading["peak_force"] is None else (*NUMBERS, "peak_force")
    known = {name: {"saved_instants": reading["within"]} for name in ("last_contact", "peak_moment_time")}
    if made.question.impact.wall_stiffness is not None:  # a whole interval is for the last push, which fades
        known["peak_moment_time"]["saved_instants"] *= 0.5
    known |= {name: {"saved_instants": change} for name, change in reading["drift"].items()}
    known["peak_force"] = {"sharp": reading["peak_force_sharp"]}
    known["push"] = {"saved_instants": reading["push_rise"]}
    known["last_contact"]["contacts"] = _shifted(made)
    known["peak_moment_place"] = {"element": reading["element"]}
    known["peak_moment"] = unseen_of_moment(made)
    if not made.question.band:
        known["peak_moment"]["about_its_time"] = _moment_about(made)
        restitution = numbers_of(made, ("restitution",), known)["restitution"]
        known["last_contact"]["returns"] = _may_return(made, restitution)
        known["last_contact"]["graze"] = _may_be_none(reading, restitution)
    if reading["midspan_moment"] == reading["peak_moment"]:
        known["midspan_moment"] = known["peak_moment"]
    found = dict(bands_of(made, names) if made.question.band else numbers_of(made, names, known))
    if not all(run.reading["left"] or run.reading["again"] for run in made.every):
        found |= {name: Number() for name in FINAL}
    if not all(run.reading["left"] for run in made.every):
        late = reading["until"] - LOWEST_PERIOD  # a force or a moment that still rises there is not the largest
        found |= {name: Number() for name in MAY_RISE if (reading.get(f"{name}_time") or 0.0) > late}
    return found


def _shifted(made: Runs) -> float:
    """What companions change of the beginning of the last contact, T*. It counts beside its end, on which runs may
    agree by chance; at most by the time between two contacts that are one in another run."""
    own, shifts = made.run.reading["contacts"], 0.0
    for companion in made.causes.values():
        other = companion.reading["contacts"]
        apart = [found[-1][0] - found[-2][1] for found in (own, other) if len(found) > 1]
        shifts += FACTOR * min([abs(own[-1][0] - other[-1][0]), *apart])
    return shifts


def _moment_about(made: Runs) -> float:
    """What companions change of the moment within :data:`ABOUT` of the time of the largest, root of the mean square,
    beyond what they change of the largest: maxima of curves that differ may agree by chance. Nothing where another
    moment is a companion's largest."""
    reading, more = made.run.reading, 0.0
    time, own = np.array(reading["moment_around"])
    near = np.abs(time - reading["peak_moment_time"]) <= ABOUT * (1.0 + 1e-9)
    for companion in made.causes.values():
        times, other = np.array(companion.reading["moment_around"])
        if times.size and (both := near & (times[0] <= time) & (time <= times[-1])).any():
            apart = float(np.sqrt(np.mean((np.interp(time[both], times, other) - own[both]) ** 2)))
            more += FACTOR * max(apart - abs(companion.reading["peak_moment"] - reading["peak_moment"]), 0.0)
    return more


def _may_return(made: Runs, restitution: Number) -> float:
    """How much later the last contact may be, T*: until the beam last misses the wall by less than :data:`RETURNS` bars
    of its restitution, a velocity. 0 of beams that are held or meet a plate, which others of its points pass."""
    impact, last = made.question.impact, made.run.reading["last_contact"]
    if impact.supported or impact.wall_in_part:
        return 0.0
    near = [time for time, speed in made.run.reading["returns"] if speed <= RETURNS * (restitution.bar or 0.0)]
    return max(near, default=last) - last


def _may_be_none(reading: Mapping[str, Any], restitution: Number) -> float:
    """How much earlier the last contact may end, T*: without its last part, where that changes the velocity by less
    than :data:`RETURNS` bars of the restitution."""
    contacts = reading["contacts"]
    graze = len(contacts) > 1 and reading["last_push"] <= RETURNS * (restitution.bar or 0.0)
    return float(contacts[-1][1] - contacts[-2][1]) if graze else 0.0


def follow_hits(impact: Impact, method: Method, count: int, *, first: ImpactHistory) -> list[Hit]:
    """The hits of :func:`followed_hits`."""
    return followed_hits(impact, method, count, first=first)[0]


def followed_hits(impact: Impact, method: Method, count: int, *, first: ImpactHistory) -> tuple[list[Hit], str]:
    """The first ``count`` hits of a beam on its wall by one run, and why there are no more; fewer where it is not back
    in time (:func:`followed_until`) or comes to rest: a hit that is not over within :data:`RESTS` periods of the lowest
    mode, or in the time that its wall needs to throw it off, is none.

    first : the run that a first hit has been read from: the first row is its own.
    Raises ``ValueError`` for what the method refuses, and between two walls.
    """
    chosen, period = for_whole_beam(method, impact), LOWEST_PERIOD * impact.slow_time_scale
    end, at_rest = 2.0 * period, max(RESTS * period, ON_WALL * time_on_wall(impact))
    while True:
        run = chosen.simulate(impact, end_time=end, save=separation_times(impact, end, INSTANTS))
        found = hits(run)
        over = [hit for hit in found if end - hit.end >= period]  # in which its largest moment may still come
        rests = len(over) < len(found) and end - found[-1].begin >= at_rest
        gone = over and len(over) == len(found) and impact.net_load <= 0.0 and not may_return(run)
        longest = followed_until(impact, over)
        flight = _flights(impact, over[-1:])
        if len(over) >= count or rests or end >= longest or gone:
            why = "rests on its wall" if rests else f"is off for good or is not back by {milliseconds(longest)}"
            if flight and not rests and (back := over[-1].end + flight) > end - period:
                why = f"is back at about {milliseconds(back)}, and it is followed until {milliseconds(end)}"
            return [*hits(first)[:1], *over[1:count]] if over else [], f"then the beam {why}"
        end = min(max(2.0 * end, end + flight + 2.0 * period), longest)


def _flights(impact: Impact, over: Sequence[Hit]) -> float:
    """How long the loads need to bring a beam back after hits that are over, altogether, s; 0 without such loads."""
    fall = impact.net_load / impact.mass_per_length  # acceleration back to the wall, m/s²
    return sum(2.0 * max(-hit.after, 0.0) / fall for hit in over) if fall > 0.0 else 0.0


def followed_until(impact: Impact, over: Sequence[Hit]) -> float:
    """Until when a beam is followed after hits that are over, s: ``LONGEST_OF_WALL`` T* and its flights, of which
    :data:`FLIGHTS` T* at most."""
    unit = impact.slow_time_scale
    return LONGEST_OF_WALL * unit + min(_flights(impact, over), FLIGHTS * unit)
