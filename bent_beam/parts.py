"""Parts of a run from the tables of a case file: ``kind = "…"`` names a frozen dataclass, the rest are its fields.

One mechanism serves the fixed tables, and meshes, integrators, contacts and elements of every path: a package offers a
registry ``{"kind": Dataclass}`` and :func:`part_from_table` does the rest, errors included.
"""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

from bent_beam.checks import shortened
from bent_beam.errors import InputError
from bent_beam.fields import key_of

__all__ = ["InputError", "made_from", "nearest", "part_from_table", "part_or_auto", "unknown_key"]

T = TypeVar("T")


def nearest(word: str, known: Iterable[str]) -> str:
    """`` (did you mean …?)`` for a misspelt word, or the list of what is known."""
    known = sorted(known)
    close = difflib.get_close_matches(word, known, n=1, cutoff=0.5)
    return f" (did you mean {close[0]}?)" if close else f" (known: {', '.join(known)})"


def unknown_key(where: str, key: str, known: Iterable[str]) -> InputError:
    """The error for an unknown key."""
    return InputError(f"{where + '.' if where else ''}{key} is not a known setting{nearest(key, known)}")


def made_from(part: type[T], values: Any, where: str, more: Iterable[str] = ()) -> T:
    """The dataclass ``part`` from the table ``values``; ``more``: further keys that the error for an unknown one names.

    Raises :class:`InputError` for an unknown key (naming the nearest), a missing field, or a value that is refused.
    """
    if not isinstance(values, Mapping):
        raise InputError(f"{where} must be a table (got {shortened(values)})")
    fields = {key_of(field.name): field for field in dataclasses.fields(part) if field.init}  # type: ignore[arg-type]
    for key in values:
        if key not in fields:
            raise unknown_key(where, str(key), {*fields, *more})
    for name, field in fields.items():
        if name not in values and field.default is field.default_factory is dataclasses.MISSING:
            raise InputError(f"{where}.{name} is required")
    try:
        return part(**{fields[key].name: value for key, value in values.items()})
    except (TypeError, ValueError) as error:
        raise InputError(str(error)) from None


def part_from_table(kinds: Mapping[str, type], table: Any, where: str) -> Any:
    """The part that ``table["kind"]`` names, its other keys being the part's fields.

    Raises :class:`InputError` for an unknown kind, and as :func:`made_from`.
    """
    if not isinstance(table, Mapping):
        raise InputError(f"{where} must be a table (got {shortened(table)})")
    if "kind" not in table:
        raise InputError(f"{where}.kind is required (one of {', '.join(sorted(kinds))})")
    kind = table["kind"]
    if not isinstance(kind, str) or kind not in kinds:
        raise InputError(f"{where}.kind: {shortened(kind)} is not known{nearest(str(kind), kinds)}")
    values = {key: value for key, value in table.items() if key != "kind"}
    return made_from(kinds[kind], values, where, more=("kind",))


def part_or_auto(kinds: Mapping[str, type], table: Any, where: str) -> Any:
    """The same; ``None``, to be chosen, of an empty table or where the kind is "auto"."""
    if not isinstance(table, Mapping) or table.get("kind", "auto") != "auto":
        return part_from_table(kinds, table, where)
    for key in table:
        if key != "kind":
            raise InputError(f"{where}.kind is required next to {where}.{key} (one of {', '.join(sorted(kinds))})")
    return None
