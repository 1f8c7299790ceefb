"""The summary of one run for a reader."""

from __future__ import annotations

from typing import Any

from bent_beam.measure.numbers import Band, Number
from comparison.hits import BETWEEN_WALLS, hits_table
from comparison.readable import beam_line, in_unit, number_from, shown, text_table

__all__ = ["run_table"]

ENERGY_TITLES = {
    "initial": "initial energy",
    "kinetic": "kinetic energy at the end",
    "strain": "strain energy at the end",
    "wall": "energy in the springs of the wall",
}


def run_table(found: dict[str, Any], verbose: bool = False) -> str:
    """The summary of one run for a reader; ``verbose``: with what tells an expert how good it is."""
    until = f"until {1e3 * found['time']:.4g} ms"
    lines = [
        _compared("half contact length", number_from(found["half_contact_length"]), "m"),
        _compared("impulse", number_from(found["total_impulse"]), "N s"),
        *_peak(found, "moment", f"largest bending moment, {until}", "N m"),
        *_peak(found, "stress", f"largest stress, {until}", "Pa"),
    ]
    if found["peak_force"] is not None:  # of a wall that gives way
        wall = "wall" if found["peak_force_wall"] == "front" else "opposite wall"
        at = f"at {1e3 * found['peak_force_time']:.4g} ms and {found['peak_force_place']:.3g} m"
        lines += _peak(found, "force", f"largest force, on the {wall}, {at}", "N")
        lines += _peak(found, "penetration", "largest penetration", "m")
        lines += _peak(found, "pressure", "largest pressure", "N/m")
    if found["restitution"]["value"] is not None:
        lines.append(_compared("coefficient of restitution", number_from(found["restitution"]), ""))
    lines.append(["lost to steps and mesh", f"{100.0 * found['numerical_loss']:.2g}", "% of the energy", ""])
    text = [
        f"{found['path']}, {1e3 * found['time']:.4g} ms after first contact ({found['seconds']:.2g} s for one run)",
        "",
        text_table(["", "value", "unit", "theory"], lines + (_expert_lines(found) if verbose else [])),
        "",
        beam_line(found["model"], found["velocity"]),
        "± is the error bar by other runs of the same beam; theory: the closed form where it holds to 2 %. Moment and",
        "stress are the largest of all steps until then; a longer run may show larger ones.",
    ]
    if found["hold"] and verbose:
        text.append(_hold_text(found["hold"]))
    if found["hits"]:
        text += ["", hits_table(found["hits"], BETWEEN_WALLS)]
    text += [f"warning: {w}" for w in found["warnings"]]
    if found["file"]:
        text.append(f"history: {found['file']}")
    return "\n".join(text)


def _compared(title: str, number: Number | Band, unit: str) -> list[str]:
    return [title, str(number), unit, shown(number.theory)]


def _expert_lines(found: dict[str, Any]) -> list[list[str]]:
    def plain(title: str, value: float | None, unit: str = "") -> list[str]:
        return [title, shown(value), unit, ""]

    energy = dict(found["energy"])
    residual = energy.pop("defect")
    return [
        *(_compared(n, number_from(found[n]), "") for n in ("lambda0", "r0") if found[n]["value"] is not None),
        plain("lift of the zone over V0 t", found["lift"]),
        plain("largest pull over largest push", found["pull"]),
        *(plain(ENERGY_TITLES.get(n, n.replace("_", " ")), v, "J") for n, v in energy.items() if v is not None),
        plain("energy residual", residual, "J"),
        plain("the same over what there was", found["energy_residual"]),
        plain("momentum residual over the impulse", found["momentum_residual"]),
        plain("largest gap of a push over V0 t", found["gap_of_push"]),
        plain("steps", found["steps"]),
    ]


def _hold_text(hold: dict[str, Any]) -> str:
    pulled = "" if hold["pull"] is None else f" and pulled at most {hold['pull']:.2g} of the largest push"
    until = f"held: contact points were held until {hold['until']:.3g} s"
    return f"{until}{pulled}; the gap of the zone up to then is imposed"


def _peak(found: dict[str, Any], name: str, title: str, unit: str) -> list[list[str]]:
    """The line of a largest value; none where it is not known."""
    number = Number(found[f"peak_{name}"], found[f"peak_{name}_error"])
    return [[title, *in_unit(number, unit), ""]] if number.measured else []
