"""The contract of ``bentbeam bounce --json``."""

from __future__ import annotations

from typing import Any

from bent_beam.versions import versions
from comparison.bounce import Bounce
from measure.whole_impact import SHORTEST_SEPARATION

__all__ = ["ENERGY", "SI", "bounce_document"]

SI = {
    "impulse": ("impulse", "N s"),
    "last_contact": ("time", "s"),
    "peak_moment": ("moment", "N m"),
    "peak_moment_place": ("length", "m"),
    "peak_moment_time": ("time", "s"),
    "midspan_moment": ("moment", "N m"),
    "peak_force": ("force", "N"),
    "translation": ("energy", "J"),
    "vibration": ("energy", "J"),
    "dissipated": ("energy", "J"),
}
ENERGY = ("translation", "vibration", "dissipated")


def bounce_document(found: Bounce) -> dict[str, Any]:
    """The contract of ``bentbeam bounce --json``."""
    unit, stress, balance = found.units, found.peak_stress, found.balance
    document: dict[str, Any] = {
        "kappa_over_nu": found.impact.kappa_over_nu,
        "damping": found.impact.relative_damping,
        "hysteretic_loss": found.history.settings.get("hysteretic_loss"),
        **{name: number.to_dict() for name, number in found.numbers.items() if name not in ENERGY},
        "energy": {name: found.numbers[name].to_dict() for name in ENERGY},
        "si": {
            name: {**found.numbers[name].scaled(unit[scale]).to_dict(), "unit": text}
            for name, (scale, text) in SI.items()
            if name in found.numbers
        },
        "peak_stress": None if stress is None else {**stress.to_dict(), "unit": "Pa"},
        "yield_stress": None if found.section is None else found.section.yield_stress,
        "shortest_separation": SHORTEST_SEPARATION,
        "contacts": [list(times) for times in found.outcome.contacts],
        "error_parts": {name: dict(parts) for name, parts in found.parts.items()},
        "energy_defect": found.outcome.energy_defect,
        "energy_gain": found.outcome.energy_gain,
        "momentum_residual": balance.momentum,
        "gap_of_push": balance.gap_of_push,
        "left": found.left,
        "steps": found.history.steps,
        "seconds": found.seconds,
        "seed": found.seed,
        "settings": found.settings,
        "versions": versions(),
        "warnings": found.warnings,
    }
    document["si"]["time_unit"] = unit["time"]
    return document
