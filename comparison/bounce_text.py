"""A whole impact for a reader."""

from __future__ import annotations

from typing import Any

from comparison.predict_text import force_line, over_damping_lines
from comparison.readable import beam_line, in_unit, largest_of, milliseconds, number_from, shown, text_table, unit_for
from comparison.whole_numbers import WHOLE

__all__ = ["bounce_text"]


def bounce_text(found: dict[str, Any], *, verbose: bool = False) -> str:
    """What ``bentbeam bounce --json`` holds: every number with its error bar, in SI; ``verbose``: also in units of the
    beam, with places and times."""
    rows = []
    for name, about in WHOLE.items():
        if not about.title or (about.more and not verbose):
            continue
        document = found["energy"].get(name) or found.get(name)
        if document is not None:
            rows.append([about.title, *_in_si(found, name), str(number_from(document))])
        elif name == "peak_force":
            within = f"largest impulse within {milliseconds(found['push_window'])}"
            rows.append([within, *_in_si(found, "push"), str(number_from(found["push"]))])
        if name == "peak_moment" and found["peak_stress"] is not None:
            rows.append(["largest stress", *in_unit(number_from(found["peak_stress"]), "Pa"), ""])
    columns = 4 if verbose else 3
    name, what, unit = largest_of(found["peak_stress"])
    damped = found["over_damping"] or []
    scale, unit = unit_for(unit, [row[name]["value"] for row in damped])
    over = [line.strip() for line in over_damping_lines(damped, name, scale)]
    lines = [
        text_table(["", "value", "", "beam's units"][:columns], [row[:columns] for row in rows]),
        "",
        beam_line(found["model"], found["velocity"]),
        "± is the error bar; a band is mean ± standard deviation of runs. Energies are shares of the initial energy",
        "and the work of the loads, at the last contact: the end of the first hit, after which the beam is off the",
        "wall for a period of its first mode at least. The largest moment and stress are those of the whole motion,",
        f"from 0 to {1e3 * found['span'][1]:.4g} ms: a period of the lowest mode after the last contact.",
        force_line(found),
        *(f"Largest {what}, {unit}, {line}." for line in over),
        *(_checks(found) if verbose else []),
    ]
    return "\n".join([*lines, *(f"warning: {w}" for w in found["warnings"])])


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


def _in_si(found: dict[str, Any], name: str) -> list[str]:
    """Value and unit: shares of energy in per cent."""
    if name in found["energy"]:
        return [str(number_from(found["energy"][name]).scaled(100.0)), "%"]
    document = found["si"].get(name)
    return in_unit(number_from(document or found[name]), document["unit"] if document else "")
