"""Every setting that a case file may hold, read off the code: tables, kinds, fields, units, defaults, ranges."""

import dataclasses
import difflib
import inspect
import logging
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from bent_beam.checks import shortened
from bent_beam.errors import InputError
from bent_beam.fields import declared, key_of
from bent_beam.meshes import MESHES
from bent_beam.method import method_type, paths
from bent_beam.section import SECTIONS
from bent_beam.tables import TABLES


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


def about(word: str) -> list[Setting]:
    """The settings whose table, kind, name or text has ``word`` in it; all without one. Raises :class:`InputError`
    where there are none."""
    wanted, every = word.strip().lower().strip("[]"), settings()
    found = [one for one in every if wanted in f"{one.table}.{one.name} {one.kind} {one.text}".lower()]
    if not found:
        close = difflib.get_close_matches(wanted, {one.name for one in every}, n=1)
        hint = f"did you mean {close[0]}?" if close else "bentbeam settings lists them all"
        raise InputError(f"settings: none has {shortened(word)} in it ({hint})")
    return found


def _kinds(table: str, kinds: Mapping[str, type]) -> Iterator[Setting]:
    for kind, part in kinds.items():
        yield Setting(table, kind, "kind", "", None, f'"{kind}"', _first_sentence(part))
        yield from _fields(table, kind, part)


def _first_sentence(part: type) -> str:
    """Of its docstring, without the marks of Sphinx."""
    paragraph = " ".join((inspect.getdoc(part) or "").partition("\n\n")[0].split())
    plain = re.sub(r":\w+:|`", "", paragraph)
    return plain.partition(". ")[0].removesuffix(".") + "." if plain else ""


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
