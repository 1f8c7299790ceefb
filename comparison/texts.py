"""Answers as sentences and tables, of the documents of ``--json``; :mod:`comparison.readable` writes their numbers."""

from collections.abc import Sequence
from typing import Any

from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.measure.numbers import Number
from comparison.readable import (
    LIMITS,
    REGIMES,
    SHORT_ZONE,
    beam_line,
    hits_table,
    in_unit,
    largest_of,
    milliseconds,
    number_from,
    shown,
    text_table,
    unit_for,
    validity_text,
)
from comparison.whole_numbers import BETWEEN_WALLS, WHOLE

COLUMNS = {
    "half_contact_length": ("half contact", "m"),
    "reaction": ("reaction", "N"),
    "impulse": ("impulse", "N s"),
    "peak_moment": ("moment", "N m"),
    "peak_stress": ("stress", "Pa"),
}
ENERGIES = {
    "initial": "initial energy",
    "kinetic": "kinetic energy at the end",
    "strain": "strain energy at the end",
    "wall": "energy in the springs of wall or contact",
    "defect": "energy residual",
}
LEFT = (
    "± is the error bar; a band is mean ± standard deviation of runs. Energies are shares of the initial energy",
    "and the work of the loads, at the last contact. This is the end of the first hit: then the beam stays off the",
    "wall for at least a period of a free beam's first mode. Largest moment and stress are",
)
STAYS = (
    "± is the error bar; a band is mean ± standard deviation of runs. The first hit is not over: it has no last",
    "contact, no rebound and no energies after it. Largest moment and stress are",
)
OF_CONTACT = {"lift": "lift of the zone over V0 t", "pull": "largest pull over largest push"}
OF_BALANCE = {
    "energy_residual": "the same over what there was",
    "momentum_residual": "momentum residual over the impulse",
    "gap_of_push": "largest gap of a push over V0 t",
    "steps": "steps",
}


def prediction_text(document: dict[str, Any]) -> str:
    """What :func:`comparison.predicting.predict_case` found, in the order in which it is asked for."""
    contact = REGIMES[document["regime"]]
    if document["regime"] == "discrete" and document["model"] == "timoshenko":
        contact = SHORT_ZONE
    lines = [
        f"{contact} kappa/nu = {document['kappa_over_nu']:.4g} (it spreads below 1).",
        *["This holds for a rigid wall; this wall gives way."] * (document["wall"] is not None),
        beam_line(document["model"], document["velocity"]),
        validity_text(document),
        *("", _instants(document), ""),
        *_agreement(document),
        *wall_lines(document),
        *_largest(document),
        *_whole(document),
    ]
    return _with_warnings(lines, document)


def _with_warnings(lines: Sequence[str], document: dict[str, Any]) -> str:
    return "\n".join([*lines, *(f"warning: {text}" for text in document["warnings"])])


def _instants(document: dict[str, Any]) -> str:
    rows = document["times"]
    beside = [row.get("simulation", {}) for row in rows]
    known = {name: [row[name] or one.get(name, {}).get("value") for row, one in zip(rows, beside)] for name in COLUMNS}
    units = {name: unit_for(unit, known[name]) for name, (_, unit) in COLUMNS.items()}
    head = ["time", "", *(f"{title}, {units[name][1]}" for name, (title, _) in COLUMNS.items())]
    body = []
    for row in rows:
        theory = ["-" if row[name] is None else f"{row[name] * scale:.4g}" for name, (scale, _) in units.items()]
        body.append([milliseconds(row["time"]), "theory" if row["valid"] else "theory, beyond its range", *theory])
        if row.get("simulation"):
            cells = [_scaled(row["simulation"].get(name), scale) for name, (scale, _) in units.items()]
            body.append(["", "simulation", *cells])
    return text_table(head, body, left=(0, 1))


def _scaled(found: dict[str, Any] | None, scale: float) -> str:
    return str(number_from(found).scaled(scale))


def _agreement(document: dict[str, Any]) -> list[str]:
    if not any(row.get("simulation") for row in document["times"]):
        return []
    lines = [
        "Reaction of the simulation: the mean over a tenth of the time before and after; half contact: how far out the",
        "wall pushes, the median over the same times. Moment and stress: the largest of all steps until then.",
    ]
    if (agreement := document["agreement"]) is None:
        return [*lines, "Theory and simulation do not agree at any of the times compared."]
    begin, end = (milliseconds(agreement[key]) for key in ("from", "until"))
    span = f"at {end} alone" if agreement["from"] == agreement["until"] else f"from {begin} to {end}"
    if agreement["from"] == document["compared_from"] < agreement["until"]:  # earlier times are not compared
        span = f"at all compared times until {end}"
    return [*lines, f"Half length and impulse of theory and simulation agree {span} (within bars and 2 %)."]


def _largest(document: dict[str, Any]) -> list[str]:
    """The largest stress, or without a section the largest moment, each value with its time range."""
    last, whole = max(document["times"], key=lambda row: row["time"]), document["whole_impact"]
    simulated = whole or last.get("simulation", {})
    name, title, unit = largest_of(document["peak_stress"] or simulated.get("peak_stress"))
    scale, unit = unit_for(unit, [(known := document[name]) or simulated.get(name, {}).get("value")])
    lines = [f"Largest {title}, {unit}{'; that of the whole impact decides' * (whole is not None)}:"]
    if document["valid_until"]:
        until = f"until {milliseconds(document['valid_until'])}, when {LIMITS[document['limited_by']]}"
        lines.append(f"  {until} (theory): " + ("not known" if known is None else f"{known * scale:.4g}"))
    if last.get("simulation", {}).get(name):
        found = _scaled(last["simulation"][name], scale)
        lines.append(f"  until {milliseconds(last['time'])} (simulation): {found}")
    if whole is None:
        lines.append(f"  of the whole impact: not known here ({document['no_whole_impact']}); it may be larger")
    else:
        until, found = milliseconds(whole["span"][1]), _scaled(whole[name], scale)
        lines.append(f"  of the whole impact, until {until} (simulation): {found}")
        lines += [f"  {line}" for line in _over_damping(whole["over_damping"] or (), name, scale)]
    if document["yield_stress"]:
        lines.append(f"  the material yields at: {document['yield_stress'] * 1e-6:.4g}")
    return lines


def _over_damping(rows: Sequence[dict[str, Any]], name: str, scale: float) -> list[str]:
    """How the largest ``name`` of the whole impact moves with the material's damping ratio; nothing without rows."""
    over = ", ".join(f"{_scaled(row[name], scale)} at {100.0 * row['damping_ratio']:g} %" for row in rows)
    return [f"of the whole impact, by damping ratio of the material: {over}"] if over else []


def _whole(document: dict[str, Any]) -> list[str]:
    if not (whole := document["whole_impact"]):
        return []
    said = [f"warning: {w}" for w in whole["warnings"] if w not in document["warnings"]]
    if any(isinstance(number, dict) and number.get("band") for number in whole.values()):
        said = ["± is the error bar, about two standard deviations; a band is mean ± one standard deviation.", *said]
    largest = f"Largest impulse within {milliseconds(whole['push_window'])}: {_scaled(whole['push'], 1.0)} N s."
    if force := whole["peak_force"]:
        largest = f"Largest force of the whole impact: {' '.join(in_unit(number_from(force), 'N'))}."
    largest = f"{largest} {_hardest(whole)}"
    if whole["restitution"]["value"] is None and "band" not in whole["restitution"]:
        return [largest, *said]
    restitution, last = _scaled(whole["restitution"], 1.0), _scaled(whole["last_contact"], 1e3)
    ends = f"coefficient of restitution {restitution}, last contact {last} ms (the end of the first hit)."
    return [largest, f"The whole impact: {ends}", *said]


def _hardest(found: dict[str, Any]) -> str:
    """When and where the wall pushes hardest."""
    if found["peak_force_time"] is None and found.get("peak_force") is not None:
        return "The largest force is not known: it may still rise."
    if found["peak_force_time"] is None:
        return f"A rigid wall has no largest force; its largest impulse begins at {milliseconds(found['push_time'])}."
    place = found["peak_force_place"]
    where = "" if place is None else f", on average about {place:.2g} m from the middle"
    return f"The largest force acts at about {milliseconds(found['peak_force_time'])}{where}."


def wall_lines(document: dict[str, Any]) -> list[str]:
    """On the largest force of a prediction (:class:`theory.wall_prediction.WallPrediction`); none of a rigid wall."""
    if (wall := document.get("wall")) is None:
        return []
    if wall["peak_force"] is None:
        return ["The theory has no largest force for this damping of the wall or this kappa/nu."]
    (scale, unit), (per, line) = unit_for("N", [wall["peak_force"]]), unit_for("N/m", [wall["pressure"]])
    force, time, deep = scale * wall["peak_force"], 1e3 * wall["peak_force_time"], wall["penetration"]
    deepest = "" if deep is None else f"largest penetration {1e3 * deep:.3g} mm, "
    lines = [
        f"Largest force on the wall (theory, an infinite beam): {force:.4g} {unit} at {time:.3g} ms, over a zone of "
        f"± {wall['half_contact_length']:.3g} m.",
        f"Of this push: {deepest}largest pressure {per * wall['pressure']:.3g} {line}. Half or "
        f"twice the stiffness, at this damping ratio: {force * 0.5**0.25:.4g} or {force * 2.0**0.25:.4g} {unit}.",
    ]
    if wall["spoiled_by"] is not None:
        lines.append(f"This force does not hold for this beam (limit: {wall['spoiled_by']}): use the simulation.")
    return lines


def bounce_text(found: dict[str, Any], *, verbose: bool = False) -> str:
    """What ``bentbeam bounce --json`` holds, in SI; ``verbose``: also in units of the beam, with places and times."""
    rows = []
    for name, about in WHOLE.items():
        document = found["energy"].get(name) or found.get(name)
        other = name == "push" and found.get("peak_force") is not None  # of a wall that gives way its force is given
        if document is None or other or (about.more and not verbose):
            continue
        within = f" {milliseconds(found['push_window'])}" if name == "push" else ""
        number = number_from(document)
        value = in_unit(number_from(found["si"].get(name, document)), about.unit)
        if about.scale == "energy":
            value = [str(number.scaled(100.0)), "%"]
        rows.append([about.title + within, *value, "" if name == "peak_stress" else str(number)])
    name, what, unit = largest_of(found["peak_stress"])
    damped, left = found["over_damping"] or [], str(number_from(found["last_contact"])) != "-"
    scale, unit = unit_for(unit, [row[name]["value"] for row in damped])
    columns, period = 4 if verbose else 3, milliseconds(LOWEST_PERIOD * found["si"]["time_unit"])
    ends = ", in which the beam hits more than once" if found["again"] else f", {period} after the last contact" * left
    lines = [
        text_table(["", "value", "", "beam's units"][:columns], [row[:columns] for row in rows]),
        "",
        beam_line(found["model"], found["velocity"], found["clearance"]),
        *(LEFT if left else STAYS),
        f"those from 0 to {1e3 * found['span'][1]:.4g} ms{ends}.",
        _hardest(found),
        *(f"Largest {what}, {unit}, {line}." for line in _over_damping(damped, name, scale)),
        *(_checks(found) if verbose else []),
    ]
    return _with_warnings(lines, found)


def _checks(found: dict[str, Any]) -> list[str]:
    """What tells an expert how good the numbers are."""
    names = ("momentum_residual", "energy_of_state", "gap_of_push", "penetration", "pull")
    momentum, energy, gap, depth, pull = (shown(found[name], ".1g") for name in names)
    unit, shortest = found["si"]["time_unit"], found["shortest_separation"]
    return [
        f"Read from the state: momentum off by {momentum} of the impulse, energy by {energy} at its worst instant,",
        f"largest gap of a push {gap} V0 t, deepest node {depth} V0 t, largest pull {pull} of the largest push.",
        f"kappa/nu = {found['kappa_over_nu']:.6g}, {_damping_of(found)}, "
        f"T* = {unit:.6g} s; {found['steps']} steps, {found['seconds']:.1f} s for all runs.",
        f"Beam's units: L/2 = EI = mu = V0 = 1. A separation lasts at least {shortest:g} T* ({shortest * unit:.3g} s).",
    ]


def _damping_of(found: dict[str, Any]) -> str:
    """Of the beam itself: eta/T*, or the hysteretic loss and where it holds."""
    loss = found["hysteretic_loss"]
    if loss is None:
        return f"eta/T* = {found['damping']:.6g}"
    held = f"{loss['lowest_frequency']:.3g} to {loss['highest_frequency']:.3g} Hz"
    return f"hysteretic loss {loss['loss']:g} within {100.0 * loss['deviation']:.1g} % from {held}"


def run_text(found: dict[str, Any], verbose: bool = False) -> str:
    """The summary of one run for a reader; ``verbose``: with what tells an expert how good it is."""
    until = f"until {1e3 * found['time']:.4g} ms"
    behind = any(hit["wall"] == "opposite" for hit in found["hits"] or ())
    none = found["half_contact_length"]["value"] is None and found["total_impulse"]["value"] is not None
    lines = [
        _compared(f"half contact length{' (off the wall)' * none}", found["half_contact_length"], "m"),
        _compared("impulse, of the front less the opposite" if behind else "impulse", found["total_impulse"], "N s"),
    ]
    peaks = {"moment": (f"largest bending moment, {until}", "N m"), "stress": (f"largest stress, {until}", "Pa")}
    if found["peak_force"] is not None:  # of a wall that gives way
        where = ""
        if found["peak_force_time"] is not None:  # a wall has pushed
            wall = "wall" if found["peak_force_wall"] == "front" else "opposite wall"
            where = f", on the {wall}, at {1e3 * found['peak_force_time']:.4g} ms and {found['peak_force_place']:.3g} m"
        peaks["force"] = f"largest force{where}", "N"
        peaks |= {"penetration": ("largest penetration", "m"), "pressure": ("largest pressure", "N/m")}
    for name, (title, unit) in peaks.items():
        number = Number(found[f"peak_{name}"], found[f"peak_{name}_error"])
        lines += [[title, *in_unit(number, unit), ""]] * number.measured
    if found["restitution"]["value"] is not None:
        lines.append(_compared("coefficient of restitution", found["restitution"]))
        lines.append(["last contact", _scaled(found["last_contact"], 1e3), "ms", ""])
    lines.append(["lost to steps and mesh", f"{100.0 * found['numerical_loss']:.2g}", "% of the energy", ""])
    text = [
        f"{found['path']}, {1e3 * found['time']:.4g} ms after {found['begins']} ({found['seconds']:.2g} s for one run)",
        "",
        text_table(["", "value", "unit", "theory"], lines + (_of_experts(found) if verbose else [])),
        "",
        beam_line(found["model"], found["velocity"], found["clearance"]),
        "± is the error bar by other runs of the same beam; theory: the closed form where it holds to 2 %. Moment and",
        "stress are the largest of all steps until then; a longer run may show larger ones. The half contact length is",
        "read from the pushes of a tenth of the time before and after.",
    ]
    if (hold := found["hold"]) and verbose:
        pulled = "" if hold["pull"] is None else f" and pulled at most {hold['pull']:.2g} of the largest push"
        text.append(f"held: contact could pull until {hold['until']:.3g} s{pulled}; where held, the gap is imposed")
    if found["hits"]:
        text += ["", hits_table(found["hits"], BETWEEN_WALLS, found["saved_apart"])]
    return _with_warnings(text, found) + (f"\nhistory: {found['file']}" if found["file"] else "")


def _compared(title: str, document: dict[str, Any], unit: str = "") -> list[str]:
    return [title, str(number_from(document)), unit, shown(document["theory"])]


def _of_experts(found: dict[str, Any]) -> list[list[str]]:
    energies = {ENERGIES.get(name, name.replace("_", " ")): value for name, value in found["energy"].items()}
    lines = [_compared(name, found[name]) for name in ("lambda0", "r0") if found[name]["value"] is not None]
    lines += [[title, shown(found[name]), "", ""] for name, title in OF_CONTACT.items()]
    lines += [[title, shown(value), "J", ""] for title, value in energies.items() if value is not None]
    return lines + [[title, shown(found[name]), "", ""] for name, title in OF_BALANCE.items()]
