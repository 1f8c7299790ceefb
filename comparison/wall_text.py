"""The largest force on a wall that gives way, for a reader."""

from __future__ import annotations

from typing import Any

__all__ = ["wall_lines"]


def wall_lines(document: dict[str, Any]) -> list[str]:
    """Lines for ``document["wall"]`` of a prediction (:class:`theory.wall_prediction.WallPrediction`); none of a rigid
    wall."""
    wall = document.get("wall")
    if wall is None:
        return []
    if wall["peak_force"] is None:
        return ["The theory has no largest force for this damping of the wall or this kappa/nu."]
    force, time = 1e-3 * wall["peak_force"], 1e3 * wall["peak_force_time"]
    lines = [
        f"Largest force on the wall (theory, an infinite beam): {force:.4g} kN at {time:.3g} ms, over a zone of "
        f"± {wall['half_contact_length']:.3g} m.",
        f"Largest penetration {1e3 * wall['penetration']:.3g} mm, pressure {1e-3 * wall['pressure']:.3g} kN/m. "
        f"Half or twice the stiffness: {force * 0.5**0.25:.4g} or {force * 2.0**0.25:.4g} kN.",
    ]
    if wall["spoiled_by"] is not None:
        lines.append(f"This force does not hold for this beam (limit: {wall['spoiled_by']}): use the simulation.")
    return lines
