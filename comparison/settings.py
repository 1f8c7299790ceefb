"""Every setting that a case file may hold, read off the code: tables, kinds, fields, units, defaults, ranges."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from bent_beam.meshes import MESHES
from bent_beam.method import method_type, paths
from bent_beam.section import SECTIONS
from bent_beam.tables import TABLES
from comparison.text_table import text_table

__all__ = ["Setting", "settings", "settings_markdown", "settings_text"]


@dataclass(frozen=True)
class Setting:
    """One field. kind : of its table, where it has one; default : as it is written, ``None`` where it is required."""

    table: str
    kind: str | None
    name: str
    unit: str
    default: str | None
    allowed: str
    text: str


def settings() -> list[Setting]:
    """All settings, table by table; those of installed paths last."""
    found = [field for table in TABLES for field in _fields_of_table(table)]
    found += _kinds("section", SECTIONS)
    found += _kinds("mesh", MESHES)
    for path in paths():
        method = method_type(path)
        parts: Mapping[str, Mapping[str, type]] = getattr(method, "PARTS", {})
        found += [f for f in _fields(path, None, method) if f.name not in (*parts, "label")]
        for name, kinds in parts.items():
            if kinds is not MESHES:
                found += _kinds(f"{path}.{name}", kinds)
    return found


def _fields_of_table(table: str) -> Iterator[Setting]:
    for name, field in TABLES[table].model_fields.items():
        extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
        bounds = {type(rule).__name__: rule for rule in field.metadata}
        signs = {"Gt": ("gt", ">"), "Ge": ("ge", "≥"), "Le": ("le", "≤")}
        allowed = [f"{sign} {getattr(bounds[k], key):g}" for k, (key, sign) in signs.items() if k in bounds]
        default = None if field.is_required() else "-" if field.default is None else f"{field.default:g}"
        yield Setting(
            table, None, name, str(extra.get("unit", "")), default, ", ".join(allowed), field.description or ""
        )


def _kinds(table: str, kinds: Mapping[str, type]) -> list[Setting]:
    found = []
    for kind, part in kinds.items():
        title = (inspect.getdoc(part) or "").split("\n")[0]
        found.append(Setting(table, kind, "kind", "", None, f'"{kind}"', title))
        found += _fields(table, kind, part)
    return found


def _fields(table: str, kind: str | None, part: type) -> Iterator[Setting]:
    said = _said(part)
    for field in dataclasses.fields(part):
        if not field.init:
            continue
        default: str | None = None
        if field.default is not dataclasses.MISSING:
            # a section's numbers are known or not; a part may say what it chooses
            absent = "-" if table == "section" else field.metadata.get("chosen", "chosen")
            default = absent if field.default is None else _written(field.default)
        elif field.default_factory is not dataclasses.MISSING:
            default = _written(field.default_factory())
        yield Setting(table, kind, field.name, *_unit_apart(said.get(field.name, ""), default))


ROLE = re.compile(r":\w+:`~?([^`]+)`")
ABSENT = re.compile(r"`?\bNone\b`?: ")
UNITS = "kg/m³|kg/m|N s/m²|N/m²|1/m|Pa|m⁴|m²|m|s|N"
UNIT = re.compile(rf"^({UNITS})(?:, |(?= \()|\.?$)|, ({UNITS})(?: of beam)?(?=\.?$| \()")


def _unit_apart(sentence: str, default: str | None) -> tuple[str, str | None, str, str]:
    """Unit, default, allowed range (not known) and what is left of a field's sentence without its unit."""
    found = UNIT.search(sentence)
    if found is None:
        return "", default, "", sentence
    return found[1] or found[2], default, "", (sentence[: found.start()] + sentence[found.end() :]).strip()


def _written(value: Any) -> str:
    if dataclasses.is_dataclass(value):
        return type(value).__name__
    return {True: "true", False: "false"}.get(value, str(value)) if isinstance(value, bool) else str(value)


def _said(part: type) -> dict[str, str]:
    """What the docstrings of a class and its bases say of each field: lines "name, other : text"."""
    found: dict[str, str] = {}
    for kind in reversed(part.__mro__[:-1]):
        text = inspect.cleandoc(kind.__doc__ or "")
        pieces = re.split(r"(?:^|(?<=\. )|(?<=\n))((?:[a-z_]+)(?:, [a-z_]+)*) : ", text)
        for names, sentence in zip(pieces[1::2], pieces[2::2]):
            for name in names.split(", "):
                text = ROLE.sub(r"`\1`", " ".join(sentence.split("\n\n")[0].split())).replace("``", "`")
                found[name] = ABSENT.sub("unless given: ", text)
    return found


def settings_text() -> str:
    """All settings as tables for a terminal."""
    blocks = []
    for table, kind, mine in _grouped():
        title = f"[{table}]" + (f" kind = {kind}" if kind else "")
        rows = [[s.name, s.unit, "required" if s.default is None else s.default, s.allowed, s.text] for s in mine]
        blocks.append(f"{title}\n" + text_table(["field", "unit", "default", "allowed", "what"], rows, left=(0, 4)))
    return "\n\n".join(blocks)


def settings_markdown() -> str:
    """The page of the documentation."""
    lines = [
        "# Every setting",
        "",
        "Made from the code by `bentbeam settings --markdown`; a table is a table of a case file.",
    ]
    for table, kind, mine in _grouped():
        lines += ["", f"## `[{table}]`" + (f" kind = `{kind}`" if kind else ""), ""]
        rows = [["field", "unit", "default", "allowed", "what"]]
        rows += [
            [f"`{s.name}`", s.unit, "required" if s.default is None else s.default, s.allowed, s.text] for s in mine
        ]
        columns = [column for column in zip(*rows) if any(column[1:])]
        rows = [list(row) for row in zip(*columns)]
        rows.insert(1, ["---"] * len(columns))
        escaped = [[cell.replace("|", "\\|").replace("*", "\\*") for cell in row] for row in rows]
        lines += ["| " + " | ".join(row) + " |" for row in escaped]
    return "\n".join([*lines, ""])


def _grouped() -> list[tuple[str, str | None, list[Setting]]]:
    groups: dict[tuple[str, str | None], list[Setting]] = {}
    for setting in settings():
        groups.setdefault((setting.table, setting.kind), []).append(setting)
    return [(table, kind, [s for s in mine if s.name != "kind"]) for (table, kind), mine in groups.items()]
