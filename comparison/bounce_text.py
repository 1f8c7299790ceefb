"""A whole impact as the document of ``bentbeam bounce --json`` and as a table for readers."""

from __future__ import annotations

from typing import Any

from bent_beam.measure.numbers import Number
from bent_beam.measure.whole_impact import SHORTEST_SEPARATION
from bent_beam.versions import versions
from comparison.bouncing import SI, Bounce, documents, over_damping
from comparison.energies import energy_residual, numerical_loss
from comparison.predict_text import over_damping_lines
from comparison.readable import BEAMS, in_unit, shown, text_table, unit_for

__all__ = ["bounce_document", "bounce_table"]

ENERGY = ("translation", "vibration", "dissipated")
TITLES = {
    "restitution": "coefficient of restitution",
    "impulse": "impulse",
    "last_contact": "last contact",
    "peak_moment": "largest bending moment",
    "peak_force": "largest force on the wall",
    "translation": "energy left in translation",
    "vibration": "energy left in vibration",
    "dissipated": "energy dissipated",
}
EXPERT = {
    "peak_moment_place": "place of the largest moment, from the middle",
    "peak_moment_time": "its time",
    "midspan_moment": "largest moment at the middle",
    "separations": "separations",
}


def bounce_document(found: Bounce) -> dict[str, Any]:
    """The contract of ``bentbeam bounce --json``."""
    stress, balance = found.peak_stress, found.balance
    si = documents(found.in_si, [name for name in SI if name in found.numbers])
    return {
        "model": found.impact.model,
        "kappa_over_nu": found.impact.kappa_over_nu,
        "damping": found.impact.relative_damping,
        "hysteretic_loss": found.runs.run.reading["loss"],
        **{name: number.to_dict() for name, number in found.numbers.items() if name not in ENERGY},
        "energy": {name: found.numbers[name].to_dict() for name in ENERGY},
        "si": {name: {**one, "unit": SI[name][1]} for name, one in si.items()} | {"time_unit": found.units["time"]},
        "peak_stress": None if stress is None else {**stress.to_dict(), "unit": "Pa"},
        "yield_stress": None if found.section is None else found.section.yield_stress,
        "shortest_separation": SHORTEST_SEPARATION,
        "span": list(found.span),
        "over_damping": over_damping(found),
        "contacts": [list(times) for times in found.outcome.contacts],
        "error_parts": {name: dict(n.parts) for name, n in found.numbers.items() if isinstance(n, Number)},
        "energy_residual": energy_residual(found.energy),
        "energy_defect": energy_residual(found.energy),
        "numerical_loss": numerical_loss(found.energy),
        "energy_gain": found.outcome.energy_gain,
        "momentum_residual": balance.momentum,
        "gap_of_push": balance.gap_of_push,
        "penetration": balance.penetration,
        "pull": balance.pull,
        "left": found.left,
        "steps": found.runs.run.steps,
        "seconds": found.seconds,
        "seed": found.seed,
        "settings": found.settings,
        "versions": versions(),
        "warnings": found.warnings,
    }


def bounce_table(found: Bounce, *, verbose: bool = False) -> str:
    """Every number with its error bar, in SI; ``verbose``: also in units of the beam, with places and times."""
    rows = []
    for name, title in {**TITLES, **(EXPERT if verbose else {})}.items():
        if name in found.numbers:
            rows.append([title, *_in_si(found, name), str(found.numbers[name])])
        elif name == "peak_force":
            rows.append([title, "none", "on a rigid wall: an impulse", ""])
        if name == "peak_moment" and found.peak_stress is not None:
            rows.append(["largest stress", *in_unit(found.peak_stress, "Pa"), ""])
    columns = 4 if verbose else 3
    name, unit = ("peak_moment", "N m") if found.section is None else ("peak_stress", "Pa")
    rows_over = over_damping(found) or []
    values = [row[name]["value"] for row in rows_over]
    scale, unit = unit_for(unit, values)
    over = [line.strip() for line in over_damping_lines(rows_over, name, scale)]
    impact = found.impact
    lines = [
        text_table(["", "value", "", "beam's units"][:columns], [row[:columns] for row in rows]),
        "",
        BEAMS[impact.model],
        "± is the error bar; a band is mean ± standard deviation of runs. Energies are shares of the initial energy",
        "and the work of the loads, at the last contact: the end of the first hit, after which the beam is off the",
        "wall for a period of its first mode at least. The largest moment and stress are those of the whole motion,",
        f"from 0 to {1e3 * found.span[1]:.4g} ms: a period of the lowest mode after the last contact.",
        *(f"Largest {'moment' if found.section is None else 'stress'}, {unit}, {line}." for line in over),
    ]
    if verbose:
        balance = found.balance
        seen = (balance.momentum, balance.energy, balance.gap_of_push, balance.penetration, balance.pull)
        checks = (shown(value, ".1g") for value in seen)
        lines += [
            "Read from the state: momentum residual {} of the impulse, energy residual {},\n"
            "largest gap of a push {} V0 t, deepest node {} V0 t, largest pull {} of the largest push.".format(*checks),
            f"kappa/nu = {impact.kappa_over_nu:.6g}, {_damping_of(found)}, "
            f"T* = {impact.slow_time_scale:.6g} s; {found.runs.run.steps} steps, {found.seconds:.1f} s for all runs.",
            "Beam's units: L/2 = EI = mu = V0 = 1. A separation lasts at least "
            f"{SHORTEST_SEPARATION:g} T* ({SHORTEST_SEPARATION * found.units['time']:.3g} s).",
        ]
    return "\n".join([*lines, *(f"warning: {w}" for w in found.warnings)])


def _damping_of(found: Bounce) -> str:
    """Of the beam itself: eta/T*, or the hysteretic loss and where it holds."""
    loss = found.runs.run.reading["loss"]
    if loss is None:
        return f"eta/T* = {found.impact.relative_damping:.6g}"
    held = f"{loss['lowest_frequency']:.3g} to {loss['highest_frequency']:.3g} Hz"
    return f"hysteretic loss {loss['loss']:g} within {100.0 * loss['deviation']:.1g} % from {held}"


def _in_si(found: Bounce, name: str) -> list[str]:
    """Value and unit: shares of energy in per cent."""
    if name in ENERGY:
        return [str(found.numbers[name].scaled(100.0)), "%"]
    return in_unit(found.in_si[name], SI[name][1] if name in SI else "")
