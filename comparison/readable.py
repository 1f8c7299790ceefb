"""Results as a reader writes them: numbers (0.0025, 2.5·10⁻⁸, −1.3, a dash for nothing), units (kN and kN m from a
hundred on, mm below a centimetre, MPa, ms), tables in plain text as wide as they need to be; and as files."""

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from numbers import Real
from pathlib import Path
from typing import Any

from bent_beam.as_json import json_text, plain
from bent_beam.errors import InputError
from bent_beam.files import write_atomically
from bent_beam.measure.numbers import Band, Number
from comparison.whole_numbers import HIT

RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
SMALL, LARGE = 1e-3, 1e5  # beyond them a power of ten
WIDEST = 400  # characters of a table

BEAMS = {  # which beam an answer is of, by ``Impact.model``
    "timoshenko": "The beam bends and shears (Timoshenko).",
    "euler_bernoulli": "The beam bends and does not shear (Euler and Bernoulli).",
}

REGIMES = {
    "discrete": "The contact stays one point.",
    "continuous": "The contact spreads: a zone that pushes mostly at its ends.",
    "detached": "The contact is two points that move apart; the beam lifts off between them.",
}
SHORT_ZONE = "The contact stays short: at first a zone, as the beam shears, which shrinks to one point."
"""In place of one point, of a beam that shears (docs/shear.md)."""
LIMITS = {
    "waves back from the ends": "reflections from the beam's ends arrive",
    "first-order correction": "the loads change the contact by more than first order covers",
    "tension": "the axial force changes the contact by more than first order covers",
    "damping": "the contact, by damping one point until then, becomes a zone, which has no closed form",
    "hysteretic loss": "the stiffness grows with the frequency, for which there is no closed form",
    "slope": "slopes are no longer small",
    "shear": "reflections, loads, damping or slopes end it before shear has ceased to matter",
    "wall": "reflections, loads, damping or slopes end it before the wall acts as a rigid one",
    "section": "the section yields",
}
BEFORE = {"shear": "shear deformation matters", "wall": "the wall gives way"}
REACTION_LATER, NO_REACTION = "; for the reaction twice as long", "Its reaction is within 2 % at no time."  # with shear
"""Why the theory ends, and begins late, by the names that the theory has for it."""


def beam_line(model: str, velocity: float, clearance: float = 0.0) -> str:
    """The beam that an answer is of, as a sentence, and the velocity, m/s, at which it touches the wall, or before one
    that is apart from it passes its rest position."""
    return f"{BEAMS[model]} It {'passes its rest position' if clearance else 'arrives'} at {readable(velocity)} m/s."


def validity_text(document: dict[str, Any]) -> str:
    """From when, until when and why no longer the theory holds."""
    why, before = LIMITS[document["limited_by"]], BEFORE.get(document["valid_after"], "")
    if not document["valid_until"]:
        return f"The theory covers no time: {why}."
    late = document["valid_after"] == "shear" and document["force_until"] > document["valid_from"]
    holds = late and document["force_until"] > 2.0 * document["valid_from"]  # the reaction, too
    before += REACTION_LATER * holds
    start = f"from {milliseconds(document['valid_from'])} (before, {before}) " if before else ""
    lines = [f"The theory holds to 2 % {start}until {milliseconds(document['valid_until'])}: then {why}."]
    if late and not holds:
        lines.append(NO_REACTION)
    if document["force_until"] < document["valid_until"]:
        begin = milliseconds(max(document["force_until"], document["valid_from"]))
        lines.append(f"From {begin} on it has no reaction: waves from the ends swing the force.")
    loads = any(document[f"epsilon_{load}"] for load in ("alpha", "psi", "chi", "axial"))
    acting = {"loads": loads, "shear": document["model"] == "timoshenko", "the wall's give": document["wall"]}
    if left_out := [name for name, acts in acting.items() if acts]:
        lines.append(f"Its moment leaves out {' and '.join(left_out)}.")  # it is of leading order
    if acting["shear"] and (document["regime"] == "discrete" or document["damping"]):  # one point, as yet or for good
        lines.append("Its half contact is within 2 % only without loads and damping.")
    return "\n".join(lines)


def readable(value: Any, digits: int = 4) -> str:
    """Any value as text; floating-point numbers with so many significant digits, their zeros at the end left out."""
    if value is None:
        return "–"
    if isinstance(value, (bool, int, str)) or not isinstance(value, Real):
        return str(value)
    number = float(value)
    if not math.isfinite(number):
        return str(number)
    text = f"{number:.{digits}g}"
    if number != 0.0 and not SMALL <= abs(number) < LARGE:
        mantissa, power = f"{number:.{digits - 1}e}".split("e")
        factor = {1.0: "", -1.0: "-"}.get(float(mantissa), f"{float(mantissa):.{digits}g}·")
        text = f"{factor}10{str(int(power)).translate(RAISED)}"
    elif "e" in text:
        text = f"{float(text):.0f}"
    return text.replace("-", "−")


def shown(value: float | None, digits: str = ".4g") -> str:
    """A number of a table; a dash where there is none."""
    return "-" if value is None else f"{value:{digits}}"


def unit_for(unit: str, values: Iterable[float | None]) -> tuple[float, str]:
    """Factor and name of the unit in which ``values`` (N, N m, N/m, m, Pa, s) are written."""
    if unit == "Pa":
        return 1e-6, "MPa"
    if unit == "s":
        return 1e3, "ms"
    largest = max((abs(value) for value in values if value is not None), default=0.0)
    if unit == "m":
        return (1e3, "mm") if largest < 1e-2 else (1.0, unit)
    return (1e-3, f"k{unit}") if unit.startswith("N") and unit != "N s" and largest >= 100.0 else (1.0, unit)


def with_bar(number: Number | Band) -> tuple[float | None, float]:
    """Value and bar, 0 where it is not known; of a band mean and standard deviation."""
    return (number.mean, number.std) if isinstance(number, Band) else (number.value, number.bar or 0.0)


def in_unit(number: Number | Band, unit: str) -> list[str]:
    """``number``, in ``unit``, in the unit in which it is written, and that unit."""
    scale, name = unit_for(unit, [with_bar(number)[0]])
    return [str(number.scaled(scale)), name]


def number_from(found: dict[str, Any] | None) -> Number | Band:
    """The number that a document holds."""
    if found and found.get("band"):
        return Band(**found["band"])
    return Number(found["value"], found["error"], found.get("theory")) if found else Number()


def largest_of(of_section: Any) -> tuple[str, str, str]:
    """Name, title and unit of the largest load on a beam: its stress, or without a section (``None``) its moment."""
    return ("peak_moment", "bending moment", "N m") if of_section is None else ("peak_stress", "stress", "Pa")


def milliseconds(time: float) -> str:
    """A time, s, for a sentence: three digits; of more than a second whole milliseconds, and no power of ten."""
    return f"{1e3 * time:.3g} ms" if abs(time) < 0.9995 else f"{1e3 * time:.0f} ms"


def text_table(head: Sequence[str], rows: Sequence[Sequence[str]], left: Sequence[int] = (0,)) -> str:
    """Columns under their heads, those numbered in ``left`` flush left and the others flush right."""
    from rich.box import SIMPLE_HEAD
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=SIMPLE_HEAD, pad_edge=False, show_edge=False, header_style=None)
    for number, title in enumerate(head):
        table.add_column(Text(title), justify="left" if number in left else "right", no_wrap=True)
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    stream = io.StringIO()
    Console(file=stream, width=WIDEST, color_system=None).print(table)
    return "\n".join(line.rstrip() for line in stream.getvalue().rstrip("\n").split("\n"))


def flat(document: Mapping[str, Any]) -> dict[str, Any]:
    """A row of a document as one of a table: ``name``, ``name_error``, ``name_theory`` of a number, ``name_mean``,
    ``name_std``, ``name_runs`` of a band, the entries of ``varied`` by their keys, other data as text."""
    found: dict[str, Any] = {}
    for key, value in plain(document).items():
        if key == "varied":
            found |= value
        elif isinstance(value, dict) and "error" in value:
            band = {f"{key}_{name}": one for name, one in value.pop("band", {}).items()}
            found |= {key: value.pop("value")} | {f"{key}_{name}": one for name, one in value.items()} | band
        elif isinstance(value, dict):
            found[key] = json_text(value)
        else:
            found[key] = "; ".join(map(str, value)) if isinstance(value, list) else value
    return found


def csv_text(documents: Iterable[Mapping[str, Any]]) -> str:
    """Rows (:func:`flat`) as CSV with a header; what is missing stays empty."""
    rows = [flat(document) for document in documents]
    stream = io.StringIO()
    writer = csv.DictWriter(stream, list(dict.fromkeys(name for row in rows for name in row)), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return stream.getvalue()


def folder(out: str | Path) -> Path:
    """Where files are to be written. Raises :class:`InputError` where that is a file."""
    out = Path(out)
    if out.exists() and not out.is_dir():
        raise InputError(f"out must be a folder, and {out} is a file")
    return out


def write_answer(
    found: Any, out: str | Path, name: str, drawable: bool = True, document: dict[str, Any] | None = None
) -> list[Path]:
    """Document and figure of an answer in ``out``; returns the files. A figure of an earlier answer does not stay."""
    from comparison.figures import style

    out = folder(out)
    file = out / f"{name}.json"
    write_atomically(file, json_text(document or found.to_dict(), indent=1) + "\n")
    if not drawable:
        (out / f"{name}.png").unlink(missing_ok=True)
        return [file]
    return [file, *style.save(found.plot(), out, name)]


def hits_table(rows: Sequence[Mapping[str, Any]], names: Sequence[str], apart: float | None = None) -> str:
    """Hits by their fields ``names``, a line each. apart : of saved instants, s, at most; ``None``: it is little."""
    cells = [[row[name] if isinstance(row[name], str) else shown(row[name]) for name in names] for row in rows]
    head = ["hit", *(HIT[name] for name in names)]
    table = text_table(head, [[str(number), *line] for number, line in enumerate(cells, 1)])
    behind = any(row.get("wall") == "opposite" for row in rows)
    both = "\nWhere two overlap, velocities, energies and moments are those of both together." * behind
    late = "\nThe run ends less than a period of the first mode after its last push: the last hit may not be over."
    cut = "" if rows[-1].get("over", True) else late
    far = "" if apart is None else f", up to {milliseconds(apart)} apart (--save N: closer),"
    return (
        f"{table}\nHits are read from the saved instants of one run{far} and have no error bars. Of all but the\n"
        "first, the second digit is uncertain. Velocities are those of the centre of mass. A moment is the largest "
        f"until\nthe next hit.{both}{cut}"
    )
