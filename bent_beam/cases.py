"""Case files (TOML): one impact, how long to follow it, and, optionally, the parts of each path.

Tables: ``[beam]``, ``[section]``, ``[impact]``, ``[wall]``, ``[run]``, ``[mesh]``, and one for each installed path,
``[hermite.*]``, ``[exudyn.*]`` … (docs/guide). Unknown keys are errors that name the nearest known key. The tables of
the paths are kept as data: :meth:`Case.method` makes the method of a path from them.
"""

from __future__ import annotations

import contextlib
import dataclasses
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bent_beam.checks import shortened
from bent_beam.description import GRAVITY, OWN_SHEAR, impact_of
from bent_beam.errors import InputError, unknown_key
from bent_beam.fields import key_of, made_from, part_from_table, part_or_auto
from bent_beam.impact import Impact
from bent_beam.meshes import MESHES, Mesh
from bent_beam.modes import lowest_frequency
from bent_beam.section import SECTIONS, Section
from bent_beam.tables import TABLES, WAYS, BeamTable, ImpactTable, RunTable, WallTable, in_keys

if TYPE_CHECKING:
    from bent_beam.method import Method

EXAMPLES = Path(__file__).with_name("examples")
"""The folder of the example cases, and of lists of methods below it: `cases/` of the checkout."""

MAXIMUM_BYTES = 1_000_000


@dataclass(frozen=True)
class Case:
    """A validated case. ``end_time`` in s; ``mesh`` is ``None`` when it is to be chosen from the problem; ``tables``
    are those of the paths, by name; ``section`` where one was given; ``damping_stated``: whether the beam's own damping
    is, be it 0."""

    title: str
    impact: Impact
    end_time: float
    mesh: Mesh | None
    tables: dict[str, dict[str, Any]]
    section: Section | None = None
    damping_stated: bool = True

    def method(self, path: str, *, label: str | None = None) -> Method:
        """The method of ``path`` with the parts that this case sets for it.

        Raises :class:`InputError` for an unknown path, part or value, in the tables of other paths too.
        """
        from bent_beam.method import method_from_tables

        for name, table in self.tables.items():
            if name != path:
                method_from_tables(name, table)
        made = method_from_tables(path, self.tables.get(path, {}), label=label)
        if self.mesh is None:
            return made
        known = getattr(made, "PARTS", {}).get("mesh", {})
        if "mesh" in self.tables.get(path, {}) and made.mesh is not None:
            raise InputError(
                f"[mesh] and [{path}.mesh] say the same: give one of them (got {made.mesh!r} in the latter)"
            )
        if type(self.mesh) in known.values():
            return dataclasses.replace(made, mesh=self.mesh)
        raise InputError(
            f"mesh.kind: {path} does not take this mesh (known: {', '.join(sorted(known)) or 'none'}); "
            f"leave [mesh] out, or set [{path}.mesh]"
        )


KNOWN = ("title", *TABLES, "section", "mesh")


def _tables_of_paths(tables: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The tables that are left over must be those of installed paths."""
    found = {name: table for name, table in tables.items() if name not in KNOWN}
    if not found:
        return {}
    from bent_beam.method import paths

    for name, table in found.items():
        if name not in paths():
            keys_of = {at: [key_of(one.name) for one in dataclasses.fields(part)] for at, part in TABLES.items()}
            places = [f"{at}.{name}" for at, keys in keys_of.items() if name in keys]
            if places:
                raise InputError(f"{name} is not a table (did you mean {' or '.join(places)}?)")
            raise unknown_key("", name, {*paths(), *KNOWN})
        if not isinstance(table, dict):
            raise InputError(f"{name} must be a table (got {shortened(table)})")
    return found


def case_from_tables(tables: Mapping[str, Any]) -> Case:
    """A case from the tables of a TOML file. Raises :class:`InputError` with one line naming field and value."""
    others = _tables_of_paths(tables)  # first: a misspelt table is also a missing one
    for name in ("beam", "impact"):
        if name not in tables:
            raise InputError(f"{name} is required")
    if not isinstance(tables.get("title", ""), str):
        raise InputError(f"title must be a text (got {shortened(tables['title'])})")
    beam = made_from(BeamTable, tables["beam"], "beam")
    arrival = made_from(ImpactTable, tables["impact"], "impact")
    wall = made_from(WallTable, tables.get("wall", {}), "wall")
    given = tables.get("section")
    if isinstance(given, Mapping) and "shear_modulus" in given:
        raise InputError(f"section.shear_modulus is not a known setting; {OWN_SHEAR}")
    section = None if given is None else part_from_table(SECTIONS, given, "section")
    try:
        impact = impact_of(beam, arrival, wall, section)
    except ValueError as error:
        raise InputError(in_keys(str(error))) from None
    check_buckling(impact)
    _check_frequency(arrival.frequency, impact)
    return Case(
        title=tables.get("title", ""),
        impact=impact,
        end_time=_end_time(made_from(RunTable, tables.get("run", {}), "run"), impact),
        mesh=part_or_auto(MESHES, tables.get("mesh", {}), "mesh"),
        tables=others,
        section=section,
        damping_stated=any(getattr(beam, name) is not None for name in WAYS["beam"][1]),
    )


def _end_time(run: RunTable, impact: Impact) -> float:
    """In s."""
    if run.end_time is not None and run.duration is not None:
        raise InputError("run.end_time and run.duration exclude each other: give one")
    end_time = run.end_time if run.duration is None else run.duration * impact.time_scale
    try:
        return impact.checked_end_time(end_time)
    except ValueError as error:
        raise InputError(f"run.{'end_time' if run.end_time is not None else 'duration'}: {error}") from None


def _check_frequency(given: float | None, impact: Impact) -> None:
    """Raise :class:`InputError` where a beam swings up to its wall at another frequency than is given."""
    own = lowest_frequency(impact) if given and impact.wall_clearance else 0.0
    if given and own and abs(given / own - 1.0) > OWN:
        raise InputError(
            f"impact.frequency = {given!r} is not the beam's own, {own:.4g} Hz: with V0 = 2 pi f A it would swing "
            f"{given / own:.3g} times as far as impact.amplitude; give impact.velocity, of its middle at rest position"
        )


OWN = 0.1  # of a frequency: closer it is the lowest mode's

BUCKLING = {  # by both ends
    frozenset({"free"}): 1.0,  # of a bow at rest
    frozenset({"hinged"}): 1.0,
    frozenset({"clamped", "free"}): 0.25,
    frozenset({"clamped", "hinged"}): 2.0457,
    frozenset({"clamped"}): 4.0,
    frozenset({"hinged", "free"}): 0.0,
}
"""Largest compression over π² EI/L², by ends (Euler; Timoshenko and Gere, Theory of Elastic Stability, 1961, ch. 2)."""


def check_buckling(impact: Impact) -> None:
    """Raise :class:`InputError` for a compression under which no bow is at rest."""
    share = BUCKLING[frozenset((impact.left_end, impact.right_end))]
    most = share * impact.buckling_load
    if impact.shear_stiffness is not None and not impact.supported:
        most /= 1.0 + most / impact.shear_stiffness  # Engesser; of held ends the lowest mode tells
    if impact.axial_force < -most:
        raise InputError(
            f"beam.axial_force must not press with more than {most:.6g} N, at which a straight beam with these ends "
            f"buckles (got {impact.axial_force!r})"
        )
    if impact.supported and impact.axial_force < 0.0:
        try:
            lowest_frequency(impact)  # with shear it buckles sooner
        except InputError as error:
            raise InputError(f"beam.{error}") from None


def lay_over(tables: dict[str, Any], assignments: Sequence[str]) -> None:
    """Lay each ``table.key=value`` over ``tables``, in place. Raises as :func:`lay_values`, and for anything else."""
    laid: dict[str, Any] = {}
    for assignment in assignments:
        key, sign, text = assignment.partition("=")
        names = [name.strip() for name in key.split(".")]
        if not sign or not all(names):
            raise InputError(f"--set takes table.key=value (got {shortened(assignment)})")
        key = ".".join(names)
        if key in laid:
            raise InputError(f"--set {key} is given twice; leave one of them out")
        laid[key] = value_of(text, names[-1])
    lay_values(tables, laid, "--set")


def lay_values(tables: dict[str, Any], values: Mapping[str, Any], option: str) -> None:
    """Put each value at its ``table.key`` of ``tables``, in place of what says the same
    (:data:`bent_beam.tables.WAYS`). Raises :class:`InputError`, naming ``option``, where that is no place, and for two
    keys that say the same."""
    for key, value in sorted(values.items(), key=lambda item: item[0] == "impact.acceleration"):  # what it needs first
        _lay(tables, key, value, option)
    for key in values:  # a later one that says the same has removed it
        if not holds(tables, key):
            raise InputError(f"{option} {key}: another {option} says the same in its place; leave one of them out")


def holds(tables: Any, key: str) -> bool:
    """Whether there is something at a ``table.key``."""
    name, _, rest = key.partition(".")
    return isinstance(tables, dict) and name in tables and (not rest or holds(tables[name], rest))


def value_of(text: str, name: str = "") -> Any:
    """The value that is written after ``name=``, as in TOML; a text may go without quotation marks."""
    text = text.strip()
    value: Any = text
    if (name != "kind" and "\n" not in text) or text.startswith(("'", '"')):  # a kind is a name, "true" is one
        number = re.fullmatch(r"([-+]?)(\d*)\.(\d*)", text)  # .9 and 9. are none in TOML
        if number and number[2] + number[3]:
            text = f"{number[1]}{number[2] or 0}.{number[3] or 0}"
        with contextlib.suppress(ValueError, RecursionError):
            value = tomllib.loads(f"value = {text}")["value"]
    return value


def _lay(tables: dict[str, Any], key: str, value: Any, option: str) -> None:
    *path, last = key.split(".")
    table = tables
    for name in path:
        table = table.setdefault(name, {})
        if not isinstance(table, dict):
            raise InputError(f"{option} {key}: {name} is a value, not a table")
    if last == "acceleration" and "drop_height" in table and table.keys() & {"gravity", "gravity_angle"}:
        raise InputError(f"{option} {key}: impact.gravity says how it fell from drop_height; give impact.velocity too")
    for ways in WAYS.get(".".join(path), ()):
        others = [name for name in ways if last in ways and name != last and name in table]
        for name in {*others, *(own for other in others for own in ways[other])} - {*ways.get(last, ())}:
            if table.pop(name, None) is not None and name == "drop_height" and "acceleration" not in table:
                table.setdefault("gravity", GRAVITY)  # by which it fell, and falls on
    table[last] = value


def read_toml(path: Path, what: str) -> dict[str, Any]:
    """The tables of a TOML file. Raises :class:`InputError` naming ``what`` when it cannot be read or is no TOML."""
    try:
        with path.open("rb") as stream:
            data = stream.read(MAXIMUM_BYTES + 1)
    except OSError as error:
        raise InputError(f"{what} {path}: {(error.strerror or str(error)).lower()}") from None
    if len(data) > MAXIMUM_BYTES:
        raise InputError(f"{what} {path} is larger than {MAXIMUM_BYTES} bytes: not a {what}")
    try:
        return tomllib.loads(data.decode("utf-8"))
    except (ValueError, RecursionError) as error:  # no UTF-8, no TOML, a number of too many digits, nesting without end
        why = " ".join(str(error).split())
        at = re.search(r"\(at line (\d+), column \d+\)$", why)
        line = data.split(b"\n")[int(at[1]) - 1] if at else b""
        hint = "; numbers take a decimal point, no comma" if re.search(rb"=[^#\"'\[]*\d,\d", line) else ""
        raise InputError(f"{what} {path} is not valid TOML: {why}{hint}") from None


def load_case(file: str | Path, assignments: Sequence[str] = ()) -> Case:
    """Read and validate a case file, with ``table.key=value`` assignments laid over it.

    Raises :class:`InputError` when the file cannot be read, is no TOML, or has an unknown key or a wrong value.

    >>> from bent_beam import load_case
    >>> case = load_case("cases/tube.toml", ["impact.velocity=2.0"])
    >>> round(case.impact.kappa_over_nu, 3), case.section.yield_stress
    (0.377, 240000000.0)
    """
    tables = read_toml(Path(file), "case file")
    lay_over(tables, assignments)
    return case_from_tables(tables)
