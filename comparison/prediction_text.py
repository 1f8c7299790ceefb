"""A prediction for a reader: kN, MPa, ms, as many digits as the error bar carries."""

from __future__ import annotations

from typing import Any

from comparison.text_table import text_table
from comparison.wall_text import wall_lines
from measure.measured import Band, Measured

__all__ = ["prediction_text"]

REGIMES = {
    "discrete": "The contact stays one point.",
    "continuous": "The contact spreads: a zone with a concentrated force at each end.",
    "detached": "The contact spreads as two points; the beam lifts off between them.",
}
LIMITS = {
    "waves back from the ends": "reflections from the beam's ends arrive",
    "first-order correction": "the loads change the contact by more than first order covers",
    "tension": "the axial force changes the contact by more than first order covers",
    "damping": "material damping has no closed form once the contact spreads",
    "slope": "slopes are no longer small",
    "shear": "shear deformation, which is not modelled, matters for as long as the theory would hold without it",
    "wall": "the wall gives way for as long as the theory of a rigid wall would hold, or longer",
    "section": "the section yields",
}
BEFORE = {"shear": "shear deformation matters", "wall": "the wall gives way"}
UNITS = {
    "half_contact_length": ("half contact", "m", 1.0),
    "reaction": ("reaction", "kN", 1e-3),
    "impulse": ("impulse", "N s", 1.0),
    "peak_moment": ("moment", "kN m", 1e-3),
    "peak_stress": ("stress", "MPa", 1e-6),
}


def prediction_text(document: dict[str, Any]) -> str:
    """What :func:`comparison.prediction.predict_case` found, in the order in which it is asked for."""
    return "\n".join(
        [
            f"{REGIMES[document['regime']]} kappa/nu = {document['kappa_over_nu']:.4g} (it spreads below 1).",
            _validity(document),
            "",
            _table(document),
            "",
            *_agreement(document),
            *wall_lines(document),
            *_stress(document),
            *_whole(document),
            *(f"warning: {text}" for text in document["warnings"]),
        ]
    )


def _validity(document: dict[str, Any]) -> str:
    why = LIMITS[document["limited_by"]]
    if not document["valid_until"]:
        return f"The theory covers no time: {why}."
    before = BEFORE.get(document["valid_after"], "")
    start = f"from {_ms(document['valid_from'])} (before, {before}) " if before else ""
    return f"The theory holds to 2 % {start}until {_ms(document['valid_until'])}: then {why}."


def _ms(time: float) -> str:
    return f"{1e3 * time:.3g} ms"


def _table(document: dict[str, Any]) -> str:
    head = ["time", "", *(f"{title}, {unit}" for title, unit, _ in UNITS.values())]
    body = []
    for row in document["times"]:
        theory = [_digits(row[name], scale) for name, (_, _, scale) in UNITS.items()]
        body.append([_ms(row["time"]), "theory" if row["valid"] else "theory, beyond its range", *theory])
        if "simulation" in row:
            cells = [_number(row["simulation"].get(name), scale) for name, (_, _, scale) in UNITS.items()]
            body.append(["", "simulation", *cells])
    return text_table(head, body, left=(0, 1))


def _digits(value: float | None, scale: float) -> str:
    return "-" if value is None else f"{value * scale:.4g}"


def _number(found: dict[str, Any] | None, scale: float) -> str:
    if not found:
        return "-"
    if found.get("band"):
        return str(Band(**found["band"]).scaled(scale))
    return str(Measured(found["value"], found["error"]).scaled(scale))


def _agreement(document: dict[str, Any]) -> list[str]:
    if not any("simulation" in row for row in document["times"]):
        return []
    lines = [
        "Half contact and reactions of the simulation are means over a tenth of the time before and after;",
        "its moments and stresses are the largest until then.",
    ]
    agreement = document["agreement"]
    if agreement is None:
        return [*lines, "Theory and simulation do not agree at any of the times compared."]
    begin, end = _ms(agreement["from"]), _ms(agreement["until"])
    agree = f"Half length and impulse of theory and simulation agree from {begin} to {end} (within bars and 2 %)."
    return [*lines, agree]


def _stress(document: dict[str, Any]) -> list[str]:
    """The largest stress, with the time range of each value."""
    if document["peak_stress"] is None:
        return []
    lines = [f"Largest stress of the first instants (theory, undamped): {_digits(document['peak_stress'], 1e-6)} MPa."]
    last = max(document["times"], key=lambda row: row["time"])
    if last.get("simulation", {}).get("peak_stress"):
        value = _number(last["simulation"]["peak_stress"], 1e-6)
        lines.append(f"Largest stress until {_ms(last['time'])} (simulation): {value} MPa.")
    whole = document["whole_impact"]
    if whole and whole["peak_stress"]:
        value = _number(whole["peak_stress"], 1e-6)
        lines.append(f"Largest stress of the whole impact ({whole['source']}): {value} MPa.")
        rows = [(_number(row["peak_stress"], 1e-6), 100.0 * row["damping_ratio"]) for row in whole["over_damping"]]
        over = [f"{stress} at {ratio:g} %" for stress, ratio in rows]
        lines += [f"Over the material's damping ratio, MPa: {', '.join(over)}."] if over else []
    else:
        lines.append("The whole impact may stress the beam more: bentbeam bounce.")
    return lines


def _whole(document: dict[str, Any]) -> list[str]:
    whole = document["whole_impact"]
    if not whole:
        return []
    last = _number(whole["last_contact"], 1e3)
    if last == "-":
        return ["The whole impact: the beam does not leave the wall within 3 T* (bentbeam bounce follows it)."]
    restitution = _number(whole["restitution"], 1.0)
    return [f"The whole impact ({whole['source']}): coefficient of restitution {restitution}, last contact {last} ms."]


