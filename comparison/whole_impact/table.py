"""A whole impact as a table for readers."""

from __future__ import annotations

from collections.abc import Sequence

from comparison.bounce import SI, Bounce
from comparison.text_table import text_table
from measure.hits import Hit
from measure.whole_impact import SHORTEST_SEPARATION

__all__ = ["bounce_table", "hits_table"]

TITLES = {
    "restitution": "coefficient of restitution e",
    "impulse": "impulse",
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
    impact, unit = found.impact, found.units
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
        "Beam's units: L/2 = EI = mu = V0 = 1; energies are shares of the initial one and the work of loads, at the",
        "last contact.",
        f"A separation lasts at least {SHORTEST_SEPARATION:g} T* ({SHORTEST_SEPARATION * unit['time']:.3g} s).",
        *(f"warning: {w}" for w in found.warnings),
    ]
    return "\n".join(lines)


def hits_table(hits: Sequence[Hit]) -> list[str]:
    """The hits that were followed, as a table; nothing for none."""
    if not hits:
        return []
    head = ["hit", "from, s", "to, s", "impulse, N s", "velocity before, m/s", "after, m/s", "restitution"]
    body = [
        [str(number), *(f"{v:.5g}" for v in (h.begin, h.end, h.impulse, h.before, h.after, h.restitution))]
        for number, h in enumerate(hits, 1)
    ]
    return ["", text_table(head, body)]
