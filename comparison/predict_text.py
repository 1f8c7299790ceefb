"""A prediction for a reader: kN, MPa, ms, as many digits as the error bar carries."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from comparison.readable import beam_line, largest_of, milliseconds, number_from, text_table, unit_for

__all__ = ["force_line", "over_damping_lines", "prediction_text", "validity_text", "wall_lines"]

REGIMES = {
    "discrete": "The contact stays one point.",
    "continuous": "The contact spreads: a zone with a concentrated force at each end.",
    "detached": "The contact is two points that move apart; the beam lifts off between them.",
}
LIMITS = {
    "waves back from the ends": "reflections from the beam's ends arrive",
    "first-order correction": "the loads change the contact by more than first order covers",
    "tension": "the axial force changes the contact by more than first order covers",
    "damping": "the contact spreads, for which material damping has no closed form",
    "hysteretic loss": "the stiffness grows with the frequency, for which there is no closed form",
    "slope": "slopes are no longer small",
    "shear": "shear deformation matters until another limit ends it",
    "wall": "the wall does not act as a rigid one before another limit ends it",
    "section": "the section yields",
}
BEFORE = {"shear": "shear deformation matters", "wall": "the wall gives way"}
COLUMNS = {
    "half_contact_length": ("half contact", "m"),
    "reaction": ("reaction", "N"),
    "impulse": ("impulse", "N s"),
    "peak_moment": ("moment", "N m"),
    "peak_stress": ("stress", "Pa"),
}


def prediction_text(document: dict[str, Any]) -> str:
    """What :func:`comparison.predicting.predict_case` found, in the order in which it is asked for."""
    return "\n".join(
        [
            f"{REGIMES[document['regime']]} kappa/nu = {document['kappa_over_nu']:.4g} (it spreads below 1).",
            beam_line(document["model"], document["velocity"]),
            validity_text(document),
            "",
            _table(document),
            "",
            *_agreement(document),
            *wall_lines(document),
            *_largest(document),
            *_whole(document),
            *(f"warning: {text}" for text in document["warnings"]),
        ]
    )


def validity_text(document: dict[str, Any]) -> str:
    """From when, until when and why no longer the theory holds."""
    why = LIMITS[document["limited_by"]]
    if not document["valid_until"]:
        return f"The theory covers no time: {why}."
    before = BEFORE.get(document["valid_after"], "")
    start = f"from {milliseconds(document['valid_from'])} (before, {before}) " if before else ""
    holds = f"The theory holds to 2 % {start}until {milliseconds(document['valid_until'])}: then {why}."
    if document["force_until"] >= document["valid_until"]:
        return holds
    begin = milliseconds(max(document["force_until"], document["valid_from"]))
    return f"{holds}\nFrom {begin} on it has no reaction: waves from the ends swing the force."


def _table(document: dict[str, Any]) -> str:
    rows = document["times"]
    units = {name: unit_for(unit, (row[name] for row in rows)) for name, (_, unit) in COLUMNS.items()}
    head = ["time", "", *(f"{title}, {units[name][1]}" for name, (title, _) in COLUMNS.items())]
    body = []
    for row in rows:
        theory = ["-" if row[name] is None else f"{row[name] * scale:.4g}" for name, (scale, _) in units.items()]
        body.append([milliseconds(row["time"]), "theory" if row["valid"] else "theory, beyond its range", *theory])
        if "simulation" in row:
            cells = [_scaled(row["simulation"].get(name), scale) for name, (scale, _) in units.items()]
            body.append(["", "simulation", *cells])
    return text_table(head, body, left=(0, 1))


def _scaled(found: dict[str, Any] | None, scale: float) -> str:
    return str(number_from(found).scaled(scale))


def _agreement(document: dict[str, Any]) -> list[str]:
    if not any("simulation" in row for row in document["times"]):
        return []
    lines = [
        "Half contact and reaction of the simulation: means over a tenth of the time before and after. Moment and",
        "stress: the largest of all steps until then.",
    ]
    agreement = document["agreement"]
    if agreement is None:
        return [*lines, "Theory and simulation do not agree at any of the times compared."]
    begin, end = milliseconds(agreement["from"]), milliseconds(agreement["until"])
    agree = f"Half length and impulse of theory and simulation agree from {begin} to {end} (within bars and 2 %)."
    return [*lines, agree]


def _largest(document: dict[str, Any]) -> list[str]:
    """The largest stress, or without a section the largest moment, each value with its time range."""
    name, title, unit = largest_of(document["peak_stress"])
    last, whole = max(document["times"], key=lambda row: row["time"]), document["whole_impact"]
    scale, unit = unit_for(unit, [document[name]])
    lines = [f"Largest {title}, {unit}:"]
    if document["valid_until"]:
        until = f"until {milliseconds(document['valid_until'])}, when {LIMITS[document['limited_by']]}"
        lines.append(f"  {until} (theory): {document[name] * scale:.4g}")
    if last.get("simulation", {}).get(name):
        until = f"until {milliseconds(last['time'])}"
        lines.append(f"  {until} (simulation): {_scaled(last['simulation'][name], scale)}")
    if whole is None:
        return [*lines, f"  of the whole impact: not known here ({document['no_whole_impact']}); it may be larger"]
    until = f"until {milliseconds(whole['span'][1])}"
    lines.append(f"  of the whole impact, {until} (simulation): {_scaled(whole[name], scale)}")
    lines += over_damping_lines(whole["over_damping"] or (), name, scale)
    if document["yield_stress"]:
        lines.append(f"  the material yields at: {document['yield_stress'] * 1e-6:.4g}")
    return lines


def over_damping_lines(rows: Sequence[dict[str, Any]], name: str, scale: float) -> list[str]:
    """How the largest ``name`` of the whole impact moves with the material's damping ratio; nothing without rows."""
    over = ", ".join(f"{_scaled(row[name], scale)} at {100.0 * row['damping_ratio']:g} %" for row in rows)
    return [f"  of the whole impact, by damping ratio of the material: {over}"] if over else []


def _whole(document: dict[str, Any]) -> list[str]:
    whole = document["whole_impact"]
    if not whole:
        return []
    force, said = whole["peak_force"], [f"warning: {w}" for w in whole["warnings"] if w not in document["warnings"]]
    largest = f"Largest impulse within {milliseconds(whole['push_window'])}: {_scaled(whole['push'], 1.0)} N s. "
    if force:
        largest = f"Largest force of the whole impact: {_scaled(force, 1e-3)} kN. "
    largest += force_line(whole)
    if whole["restitution"]["value"] is None and "band" not in whole["restitution"]:
        return [largest, *said]
    restitution, last = _scaled(whole["restitution"], 1.0), _scaled(whole["last_contact"], 1e3)
    ends = f"coefficient of restitution {restitution}, last contact {last} ms (the end of the first hit)."
    return [largest, f"The whole impact: {ends}", *said]


def force_line(found: dict[str, Any]) -> str:
    """When and where the wall pushes hardest."""
    if found["peak_force_time"] is None:
        return f"A rigid wall has no largest force; its largest push begins at {milliseconds(found['push_time'])}."
    when, where = milliseconds(found["peak_force_time"]), found["peak_force_place"]
    return f"The largest force acts at {when}, on average {where:.3g} m from the middle."


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
