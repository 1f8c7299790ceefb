"""What one run did and found, for programs and for readers: the contract of ``bentbeam simulate --json``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any

from bent_beam.cases import Case
from bent_beam.history import REFLECTED, ImpactHistory
from bent_beam.hysteresis import converges
from bent_beam.impact import Impact
from bent_beam.loads import unmodelled
from bent_beam.measure.balance import balance_of
from bent_beam.measure.estimators import leading_order
from bent_beam.measure.moments import moments
from bent_beam.measure.numbers import MISSING, Number
from bent_beam.measure.reduction import hold_of, pull_of
from bent_beam.measure.whole_impact import hits
from comparison.bounced import Bounce, scales, stress_of
from comparison.bouncing import whole_numbers, whole_reading
from comparison.doubts import doubts
from comparison.energies import energy_at_end, energy_residual, loss_warnings, numerical_loss
from comparison.predicting import instant_numbers, instants_reading
from comparison.questions import Question
from comparison.runs import Runs, runs_of
from theory import Prediction, predict
from theory.prediction import MODELLED
from theory.validity import ENDS

__all__ = ["Simulated", "comparable", "simulate_case"]

BAND = "without damping a whole impact is a band, which bentbeam bounce gives; one run has no number of it"


@dataclass(frozen=True)
class Simulated:
    """A run of ``case`` to a time or to its last separation, ``history``, and its ``numbers`` (SI) with the bars of its
    companions."""

    case: Case
    runs: Runs
    history: ImpactHistory
    numbers: dict[str, Number]
    leading: Any

    def to_dict(self, file: Path | None = None) -> dict[str, Any]:
        """The contract of ``bentbeam simulate --json``; the theory's numbers only where it claims to hold."""
        history, section, numbers = self.history, self.case.section, self.numbers
        impact, until, reading = history.impact, self.runs.question.until, self.runs.run.reading
        end = float(history.time[-1]) if until is None else until
        infinite = predict(impact, [end]) if comparable(impact) else None
        row = infinite.times[0] if infinite and infinite.times[0].valid else None
        leading = self.leading if row else None
        energy, balance = energy_at_end(history), balance_of(history)
        moment, largest, unit = numbers["peak_moment"], reading, {"length": 1.0, "time": 1.0}
        if until is None:
            largest, unit = reading["whole"], scales(impact)
        several = impact.opposite_wall is not None or impact.off_centre  # between two walls, or of a beam that rocks
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
            "half_contact_length": _beside(numbers["half_contact_length"], row.half_contact_length if row else None),
            "total_impulse": _beside(numbers["impulse"], row.impulse if row else None),
            "restitution": _beside(numbers.get("restitution", MISSING), None),
            "lambda0": _beside(leading.lambda0 if leading else MISSING, infinite.lambda0 if infinite else None),
            "r0": _beside(leading.r0 if leading else MISSING, infinite.r0 if infinite else None),
            "lift": float(moments(history).lift[-1]),
            "pull": pull_of(history),
            "hold": hold_of(history),
            **_with_error("peak_moment", moment),
            "peak_moment_place": largest["peak_moment_place"] * unit["length"],
            "peak_moment_time": largest["peak_moment_time"] * unit["time"],
            **_with_error("peak_stress", stress_of(moment, impact, section) or MISSING),
            "yield_stress": None if section is None else section.yield_stress,
            **{name: reading[name] for name in ("peak_force_time", "peak_force_place", "peak_force_wall")},
            **_with_error("peak_force", numbers["peak_force"]),
            **_with_error("peak_penetration", numbers["peak_penetration"]),
            **_with_error("peak_pressure", numbers["peak_pressure"]),
            "energy": energy,
            "energy_residual": energy_residual(energy),
            "numerical_loss": numerical_loss(energy),
            "momentum_residual": balance.momentum,
            "second_moment_residual": balance.second_moment,
            "contact_points_residual": balance.points,
            "initial_energy_residual": balance.initial_energy,
            "gap_of_push": balance.gap_of_push,
            "penetration": balance.penetration,
            "middle_slope": balance.middle_slope,
            "hits": [asdict(hit) for hit in hits(history)] if several else None,
            "warnings": [
                *doubts(impact, section), *history.warnings, *self._reflected(infinite, end),
                *loss_warnings(numerical_loss(energy)), *balance.warnings,
                *([BAND] if until is None and not converges(impact) else ()), *self.runs.lost,
            ],
            "file": None if file is None else str(file),
        }  # fmt: skip

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
    progress: Callable[[float], None] | None = None,
) -> Simulated:
    """Follow ``case`` to ``until`` (s; ``None``: to the last separation) with the method of ``path``.

    save : saved instants up to then; of a run to separation, a T*. Of a beam without damping that is one run, whose
    numbers are missing: they are a band (:func:`comparison.bounce`).
    Raises ``ValueError`` for what the method refuses, :class:`bent_beam.SimulationError` when it cannot finish.
    """
    band = until is None and not converges(case.impact)
    bars = "drift" if band else error_bars
    question = Question(case.impact, case.method(path), until, save, bars, case.damping_stated)
    read: Any = _whole_run if until is None else partial(_run, question.first_spread, until)
    runs = runs_of(question, read, whole_history=True, progress=progress)
    assert runs.history is not None
    numbers = instant_numbers(runs)
    if until is None:
        numbers = dict.fromkeys((*numbers, "restitution"), MISSING) if band else numbers | _of_whole(case, runs)
    leading = _leading(runs) if until is not None else None
    history = runs.history if until is None else runs.history.until(until)
    return Simulated(case, runs, history, numbers, leading)


def _run(first_spread: bool, until: float, history: ImpactHistory) -> dict[str, Any]:
    return instants_reading((until,), first_spread, history) | {"moments": moments(history.until(until))}


def _whole_run(history: ImpactHistory) -> dict[str, Any]:
    """A whole impact, and its end as an instant."""
    found = whole_reading(history)
    return instants_reading((float(history.time[-1]),), False, history) | {"whole": found}


def _of_whole(case: Case, runs: Runs) -> dict[str, Any]:
    """Restitution, and the largest moment and force of the whole impact, as ``bounce`` has them."""
    inner = runs.part(lambda reading: dict(reading["whole"]))
    found = Bounce(case, whole_numbers(inner), inner).in_si
    return {name: found[name] for name in ("restitution", "peak_moment", "peak_force") if name in found}


def _leading(runs: Runs) -> Any:
    """λ₀ and r₀ of the run, where theory has them."""
    impact = runs.question.impact
    if impact.loaded_to_first_order or not comparable(impact):
        return None
    try:
        found, *others = (run.reading["moments"] for run in runs.every)
        return leading_order(found, companions=others)
    except ValueError:
        return None


def comparable(impact: Impact) -> bool:
    """Whether the theory has an answer at all: a bow, symmetric about its first touch, before a wall that it knows."""
    return impact.relative_curvature > 0.0 and not impact.off_centre and unmodelled(impact, MODELLED) is None


def _beside(number: Number, theory: float | None) -> dict[str, float | None]:
    return replace(number, theory=theory).compared()


def _with_error(name: str, number: Number) -> dict[str, float | None]:
    return {name: number.value, f"{name}_error": number.bar}
