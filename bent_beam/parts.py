"""Parts of a run from the tables of a case file: ``kind = "…"`` names a frozen dataclass, the rest are its fields.

One mechanism serves meshes, integrators, contacts and elements of every path: a package offers a registry
``{"kind": Dataclass}`` and :func:`part_from_table` does the rest, errors included.
"""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Iterable, Mapping
from typing import Any

import pydantic

from bent_beam.checks import shortened
from bent_beam.errors import InputError

__all__ = ["InputError", "describe", "nearest", "part_from_table", "unknown_key"]


def nearest(word: str, known: Iterable[str]) -> str:
    """`` (did you mean …?)`` for a misspelt word, or the list of what is known."""
    known = sorted(known)
    close = difflib.get_close_matches(word, known, n=1, cutoff=0.5)
    return f" (did you mean {close[0]}?)" if close else f" (known: {', '.join(known)})"


def unknown_key(where: str, key: str, known: Iterable[str]) -> InputError:
    """The error for an unknown key."""
    return InputError(f"{where + '.' if where else ''}{key} is not a known setting{nearest(key, known)}")


def first_line(error: pydantic.ValidationError, where: str) -> str:
    """One line for the first problem of a pydantic error: field, what is wrong, the value got."""
    problem = error.errors()[0]
    place = ".".join([where, *(str(part) for part in problem["loc"])]).strip(".")
    cause = problem.get("ctx", {}).get("error")
    if isinstance(cause, ValueError):  # raised by a part's own check: it names its field already
        return str(cause)
    if problem["type"] == "missing":
        return f"{place} is required"
    return f"{place}: {problem['msg'][0].lower() + problem['msg'][1:]} (got {shortened(problem.get('input'))})"


def part_from_table(kinds: Mapping[str, type], table: Mapping[str, Any], where: str, default: str | None = None) -> Any:
    """Make the part that ``table["kind"]`` names, its other keys being the part's fields.

    By hand and not as one of pydantic's tagged unions, which would ask every part, somebody else's too, for a field
    ``kind`` and a configuration that forbids unknown keys.

    Raises :class:`InputError` for an unknown kind or key (naming the nearest), a missing field, a wrong type
    or a value that the part refuses.
    """
    if not isinstance(table, Mapping):
        raise InputError(f"{where} must be a table (got {shortened(table)})")
    kind = table.get("kind", default)
    if kind is None:
        raise InputError(f"{where}.kind is required (one of {', '.join(sorted(kinds))})")
    if not isinstance(kind, str) or kind not in kinds:
        raise InputError(f"{where}.kind: {shortened(kind)} is not known{nearest(str(kind), kinds)}")
    part = kinds[kind]
    fields = {f.name for f in dataclasses.fields(part)}
    values = {key: value for key, value in table.items() if key != "kind"}
    for key in values:
        if key not in fields:
            raise unknown_key(where, str(key), fields | {"kind"})
    try:
        return pydantic.TypeAdapter(part).validate_python(values)
    except pydantic.ValidationError as error:
        raise InputError(first_line(error, where)) from None


def describe(part: Any) -> dict[str, Any]:
    """A part as JSON-ready settings: its class name and fields (nested parts too)."""
    out: dict[str, Any] = {"kind": type(part).__name__}
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if dataclasses.is_dataclass(value) and not isinstance(value, type):
            value = describe(value)
        elif isinstance(value, tuple):
            value = list(value)
        out[field.name] = value
    return out
