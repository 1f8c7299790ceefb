"""One run of one case on one path, and what to say about it."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bent_beam.cases import Case
from bent_beam.history import ImpactHistory
from comparison.estimators import leading_order, moments

__all__ = ["simulate_case", "summary"]


def simulate_case(
    case: Case, path: str, *, save: int = 200, progress: Callable[[float], None] | None = None
) -> ImpactHistory:
    """Run a case on one path with the parts that its file sets; what it leaves out is chosen from the problem.

    Raises ``ValueError`` for parts that the path does not know, :class:`bent_beam.SimulationError` when it cannot
    finish.
    """
    return case.method(path).simulate(case.impact, end_time=case.end_time, save=save, progress=progress)


def summary(history: ImpactHistory, file: Path | None = None) -> dict[str, Any]:
    """What a run did and found, JSON-ready, SI units; ``theory`` beside it where the theory has an answer."""
    from theory import predict

    impact, time = history.impact, history.time
    found = moments(history, uniform=bool(impact.acceleration or impact.fourth_derivative or impact.curvature_rate))
    end = float(time[-1])
    total = float(history.array("total_impulse")[-1])
    result: dict[str, Any] = {
        "path": history.path,
        "symmetry": str(history.dataset.attrs["symmetry"]),
        "settings": history.settings,
        "versions": history.versions,
        "steps": history.steps,
        "seconds": history.seconds,
        "time": end,
        "half_contact_length": float(found.front[-1]) * impact.length_scale,
        "total_impulse": total,
        "largest_gap_in_contact_zone": float(found.lift[-1]) * impact.velocity * end,
        "flatness": float(found.lift[-1]),
        "energy": history.energy_budget(),
        "lambda0": None,
        "lambda0_error": None,
        "r0": None,
        "r0_error": None,
        "warnings": history.warnings,
        "file": None if file is None else str(file),
    }
    if not (impact.acceleration or impact.fourth_derivative or impact.curvature_rate):
        try:
            leading = leading_order(found)
        except ValueError:
            pass
        else:
            result.update(
                lambda0=leading.lambda0.value,
                lambda0_error=leading.lambda0.error,
                r0=leading.r0.value,
                r0_error=leading.r0.error,
            )
    result["theory"] = None
    if impact.curvature > 0.0:
        prediction = predict(impact, [end])
        at = prediction.times[0]
        result["theory"] = {
            "regime": prediction.regime,
            "lambda0": prediction.lambda0,
            "r0": prediction.r0,
            "half_contact_length": at.half_contact_length,
            "total_impulse": at.impulse,
            "valid": at.valid,
        }
    return finite_or_null(result)


def finite_or_null(value: Any) -> Any:
    """Plain JSON data: NumPy scalars as Python numbers, no NaN or infinity (null instead)."""
    if isinstance(value, dict):
        return {str(k): finite_or_null(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite_or_null(v) for v in value]
    if hasattr(value, "item") and not isinstance(value, (str, bytes)):
        value = value.item()
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
