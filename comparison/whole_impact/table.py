"""A whole impact as a table for readers."""

from __future__ import annotations

from comparison.bounce import SI, Bounce, scales
from comparison.text_table import text_table
from comparison.whole_impact.outcome import SHORTEST_SEPARATION

__all__ = ["bounce_table"]

TITLES = {
    "restitution": "velocity after over before, e",
    "impulse": "impulse of the wall",
    "last_contact": "last contact",
    "separations": "separations",
    "peak_moment": "largest bending moment",
    "peak_moment_place": "its place, from the middle",
    "peak_moment_time": "its time",
    "midspan_moment": "largest moment at the middle",
    "translation": "energy left in translation",
    "vibration": "energy left in vibration",
    "dissipated": "energy dissipated",
}


def bounce_table(found: Bounce) -> str:
    """Every number with its error bar, in units of the beam and in SI."""
    impact, unit = found.impact, scales(found.impact)
    rows = []
    for name, title in TITLES.items():
        number = found.numbers[name]
        si = ["", ""]
        if name in SI:
            scale, text = SI[name]
            si = [str(number.scaled(unit[scale])), text]
        rows.append([title, str(number), *si])
        if name == "peak_moment" and found.peak_stress is not None:
            rows.append(["largest stress, there and then", "", str(found.peak_stress), "Pa"])
    lines = [
        f"kappa/nu = {impact.kappa_over_nu:.6g}, eta/T* = {impact.relative_damping:.6g}, "
        f"T* = {impact.slow_time_scale:.6g} s; {found.history.steps} steps, {found.seconds:.1f} s for all runs",
        "",
        text_table(["", "beam's units", "SI", ""], rows),
        "",
        "Beam's units: L/2 = EI = mu = V0 = 1; energies are shares of the initial one, at the last contact.",
        f"A separation lasts at least {SHORTEST_SEPARATION:g} T* ({SHORTEST_SEPARATION * unit['time']:.3g} s).",
        *(f"warning: {w}" for w in found.warnings),
    ]
    return "\n".join(lines)
