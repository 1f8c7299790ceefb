"""The answer of ``bentbeam simulate``: what one run did and found, its document, text and files."""

import math
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.cases import Case
from bent_beam.history import REFLECTED, ImpactHistory
from bent_beam.hysteresis import converges
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.moments import lift, moments, unresolved_at_end
from bent_beam.measure.numbers import MISSING, Number
from bent_beam.measure.reduction import hold_of, pull_of
from bent_beam.measure.whole_impact import hits
from comparison.bounced import OF_WHOLE, Bounce, scales
from comparison.bouncing import whole_numbers, whole_reading
from comparison.doubts import comparable, doubts, energy_at_end, energy_residual, numerical_loss, told_by
from comparison.predicting import instants_reading, numbers_at
from comparison.questions import Progress, Question
from comparison.runs import Runs, runs_of
from theory import Prediction, predict
from theory.validity import ENDS

BAND = "without damping a whole impact is a band, which bentbeam bounce gives; one run has no number of it"
UNSTATED = "of a beam whose damping is not stated bentbeam bounce gives the whole impact at three damping ratios"


@dataclass(frozen=True)
class Simulated:
    """A run of ``case`` to a time or to its last separation, ``history``, and its ``numbers`` (SI, and λ₀ and r₀) with
    the bars of its companions. whole : of a run to the last separation, where it has numbers."""

    case: Case
    runs: Runs
    history: ImpactHistory
    numbers: dict[str, Number]
    whole: Bounce | None = None

    def to_dict(self, file: Path | None = None) -> dict[str, Any]:
        """The contract of ``bentbeam simulate --json``; the theory's numbers only where it claims to hold."""
        history, section = self.history, self.case.section
        impact, until, reading = history.impact, self.runs.question.until, self.runs.run.reading
        end = float(history.time[-1]) if until is None else until
        infinite = predict(impact, [end]) if comparable(impact) else None
        row = infinite.times[0] if infinite and infinite.times[0].valid else None
        energy, balance = energy_at_end(self.runs.history or history, until), self.runs.balance
        largest = reading["whole"] if until is None else reading
        unit = scales(impact) if until is None else {"length": 1.0, "time": 1.0}
        several = impact.opposite_wall is not None or impact.off_centre  # between two walls, or of a beam that rocks
        again = several or impact.supported or impact.net_load > 0.0
        listed = hits(history) if again and history.is_whole else []
        return {
            "path": history.path,
            "model": impact.model,
            "velocity": impact.velocity,
            "symmetry": history.symmetry,
            "settings": {name: one for name, one in history.settings.items() if name != "save"},  # of instants, many
            "versions": history.versions,
            "steps": history.steps,
            "seconds": history.seconds,
            "time": end,
            "clearance": impact.wall_clearance,
            "saved_apart": float(np.diff(history.time).max(initial=0.0)),
            "begins": self._begins(),
            "half_contact_length": self._beside("half_contact_length", row.half_contact_length if row else None),
            "total_impulse": self._beside("impulse", row.impulse if row else None),
            "restitution": self._beside("restitution", None),
            "last_contact": self._beside("last_contact", None),
            # constants of the theory: no number of the run stands beside them at a time at which it does not hold
            "lambda0": self._beside("lambda0" if row else "", infinite.lambda0 if infinite else None),
            "r0": self._beside("r0" if row else "", infinite.r0 if infinite else None),
            "lift": None if impact.off_centre else float(lift(history)[-1]),
            "pull": pull_of(history),
            "hold": hold_of(history),
            **self._with_error("peak_moment"),
            "peak_moment_place": largest["peak_moment_place"] * unit["length"],
            "peak_moment_time": largest["peak_moment_time"] * unit["time"],
            **self._with_error("peak_stress"),
            "yield_stress": None if section is None else section.yield_stress,
            **{name: reading[name] for name in ("peak_force_time", "peak_force_place", "peak_force_wall")},
            **self._with_error("peak_force", "peak_penetration", "peak_pressure"),
            "energy": energy,
            "energy_residual": energy_residual(energy),
            "numerical_loss": numerical_loss(energy),
            "momentum_residual": balance.momentum,
            "second_moment_residual": balance.second_moment,
            "contact_points_residual": balance.points,
            "contact_law_residual": balance.law,
            "initial_energy_residual": balance.initial_energy,
            **{name: getattr(balance, name) for name in ("gap_of_push", "penetration", "middle_slope")},
            "hits": [asdict(hit) for hit in listed] if several or len(listed) > 1 else None,
            "warnings": [
                *self._not_reached(), *self._reflected(infinite, end),
                *(self._of_run() if self.whole is None else self.whole.warnings),
            ],
            "file": None if file is None else str(file),
        }  # fmt: skip

    def _beside(self, name: str, theory: float | None) -> dict[str, float | None]:
        return replace(self.numbers.get(name, MISSING), theory=theory).compared()

    def _with_error(self, *names: str) -> dict[str, float | None]:
        found = {name: self.numbers.get(name, MISSING) for name in names}
        return {key: v for name, one in found.items() for key, v in ((name, one.value), (f"{name}_error", one.bar))}

    def _of_run(self) -> list[str]:
        band = [BAND if self.case.damping_stated else UNSTATED] if self.runs.question.until is None else []
        section = self.case.section
        return [*doubts(self.case.impact, section), *told_by(self.numbers, section), *band, *self.runs.warnings]

    def _begins(self) -> str:
        """What the beam does at the time 0."""
        impact = self.history.impact
        if impact.wall_clearance:
            return "it passes its rest position"
        begin, end = impact.wall_span
        at_apex = begin <= impact.first_touch <= end or not impact.relative_curvature
        return "first contact" if at_apex else "its apex passes the line of the wall"

    def _not_reached(self) -> list[str]:
        """Of a beam that has not touched its wall."""
        if np.any(self.history.array("total_impulse")):
            return []
        if away := self.history.impact.wall_clearance:
            return [f"the beam has not reached its wall, {away:g} m away from its rest position"]
        return ["the beam has not touched the wall"]

    def _reflected(self, infinite: Prediction | None, end: float) -> list[str]:
        """From when on waves are back from the ends, where that ends the theory and the run does not say so."""
        if self.runs.question.until is None or infinite is None or infinite.limited_by != ENDS:
            return []
        if end <= infinite.valid_until or any(REFLECTED in line for line in self.history.warnings):
            return []
        return [f"waves reflected at the beam's ends are back from {infinite.valid_until:.3g} s on"]


def simulate_case(
    case: Case,
    path: str,
    *,
    until: float | None,
    save: int | None = None,
    error_bars: str = "quick",
    progress: Progress | None = None,
) -> Simulated:
    """Follow ``case`` to ``until`` (s; ``None``: to the last separation) with the method of ``path``.

    save : saved instants up to then; of a run to separation, a T*. Of a beam without damping that is one run, whose
    numbers are missing: they are a band (:func:`comparison.bounce`).
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` when it cannot finish.
    """
    band = until is None and not converges(case.impact)
    bars = "drift" if band and error_bars == "quick" else error_bars
    question = Question(case.impact, case.method(path), until, save, bars, case.damping_stated)
    read: Any = _whole_run if until is None else partial(_run, question.first_spread, until)
    runs = runs_of(question, read, whole_history=True, progress=progress)
    assert runs.history is not None
    if until is not None:
        return Simulated(case, runs, runs.history.until(until), numbers_at(runs, case) | _leading(runs))
    if band:
        return Simulated(case, runs, runs.history, {})
    inner = runs.part(lambda reading: dict(reading["whole"]))
    whole = Bounce(case, whole_numbers(inner), inner)
    found: dict[str, Any] = {name: n for name, n in whole.in_si.items() if name in (*OF_WHOLE, "last_contact")}
    at_end, of_hit = numbers_at(runs, case), whole.in_si.get("impulse", MISSING)
    if of_hit.value is not None and math.isclose(of_hit.value, at_end["impulse"].known, rel_tol=1e-9):
        found["impulse"] = of_hit  # one number with one bar
    return Simulated(case, runs, runs.history, at_end | found, whole)


def _run(first_spread: bool, until: float, history: ImpactHistory) -> dict[str, Any]:
    asked = history.until(until)
    found = moments(asked)
    of_front = {"moments": found, "unresolved": unresolved_at_end(asked, found)}
    return instants_reading((until,), first_spread, history) | of_front


def _whole_run(history: ImpactHistory) -> dict[str, Any]:
    """A whole impact, and its end as an instant."""
    return instants_reading((float(history.time[-1]),), False, history) | {"whole": whole_reading(history)}


def _leading(runs: Runs) -> dict[str, Number]:
    """λ₀ and r₀ of the run, where theory has them."""
    impact = runs.question.impact
    if impact.loaded_to_first_order or not comparable(impact):
        return {}
    try:
        found, *others = (run.reading["moments"] for run in runs.every)
        leading = leading_order(found, companions=others, unresolved=runs.run.reading["unresolved"])
    except ValueError:
        return {}
    return {"lambda0": leading.lambda0, "r0": leading.r0}
