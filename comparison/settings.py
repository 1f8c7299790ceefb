"""Every setting that a case file may hold, read off the code: tables, kinds, fields, units, defaults, ranges."""

from __future__ import annotations

import dataclasses
import inspect
import logging
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from bent_beam.errors import InputError
from bent_beam.fields import declared, key_of
from bent_beam.meshes import MESHES
from bent_beam.method import method_type, paths
from bent_beam.section import SECTIONS
from bent_beam.tables import TABLES
from comparison.readable import text_table

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
    found = [field for table, part in TABLES.items() for field in _fields(table, None, part)]
    found += _kinds("section", SECTIONS)
    found += _kinds("mesh", MESHES)
    for path in paths():
        try:
            method = method_type(path)
        except InputError as error:
            logging.getLogger("bent_beam").warning("left out: %s", error)
            continue
        parts: Mapping[str, Mapping[str, type]] = getattr(method, "PARTS", {})
        found += [f for f in _fields(path, None, method) if f.name not in (*parts, "label")]
        for name, kinds in parts.items():
            if kinds is not MESHES:
                found += _kinds(f"{path}.{name}", kinds)
    return found


def _kinds(table: str, kinds: Mapping[str, type]) -> list[Setting]:
    found = []
    for kind, part in kinds.items():
        title = (inspect.getdoc(part) or "").split("\n")[0]
        found.append(Setting(table, kind, "kind", "", None, f'"{kind}"', title))
        found += _fields(table, kind, part)
    return found


def _fields(table: str, kind: str | None, part: type) -> Iterator[Setting]:
    """The fields of a part as their annotations declare them."""
    for field in dataclasses.fields(part):
        if not field.init:
            continue
        quantity = declared(part)[field.name].quantity
        default: str | None = None
        if field.default is None:
            default = quantity.absent or ("-" if table in TABLES else "chosen")
        elif field.default is not dataclasses.MISSING:
            default = _written(field.default)
        elif field.default_factory is not dataclasses.MISSING:
            default = _written(field.default_factory())
        yield Setting(table, kind, key_of(field.name), quantity.unit, default, quantity.allowed, quantity.text)


def _written(value: Any) -> str:
    if dataclasses.is_dataclass(value):
        return type(value).__name__
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)


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
