"""What a field of a part is: unit, meaning and range, stated once, in its annotation.

    element_length: Annotated[float, Quantity("m", "Δx of the zone", above=0.0)]

From this follow the check when a part is made (:class:`Part`), case files and ``--set`` (:func:`part_from_table`),
``bentbeam settings`` and the documentation (:mod:`bent_beam.settings`).
"""

from __future__ import annotations

import dataclasses
import types
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, ClassVar, Protocol, TypeVar, Union, get_args, get_origin, get_type_hints

from bent_beam import checks
from bent_beam.errors import InputError, nearest, unknown_key

T = TypeVar("T")


@dataclass(frozen=True, kw_only=True)
class Declared:
    """A field as its annotation declares it. kind : float, int, bool, str, a class of parts or what a part must do (a
    protocol that can be checked at run time), or ``None`` for anything else."""

    kind: type | None
    optional: bool
    quantity: Quantity

    def checked(self, name: str, value: Any) -> Any:
        """``value`` as this field holds it. Raises ``ValueError`` naming ``name`` and the value."""
        if value is None and self.optional:
            return None
        if self.kind is bool and not isinstance(value, bool):
            raise InputError(f"{name} must be true or false (got {checks.shortened(value)})")
        if self.kind is str:
            if not isinstance(value, str):
                raise InputError(f"{name} must be a text (got {checks.shortened(value)})")
            return checks.one_of(name, value, self.quantity.choices) if self.quantity.choices else value
        if self.kind in (int, float):
            return self.quantity.checked_number(name, value, whole=self.kind is int)
        if self.kind not in (None, bool) and not isinstance(value, self.kind):
            if isinstance(value, type):
                raise InputError(f"{name} must be made from its class: {value.__name__}() (got the class)")
            raise InputError(f"{name} must be an instance of {self.kind.__name__} (got {checks.shortened(value)})")
        return value


@dataclass(frozen=True)
class Quantity:
    """Unit, meaning and range of a field.

    above, least, most : the range, above excluded. choices : of a text. absent : what ``settings`` prints where the
    default is ``None``.
    """

    unit: str
    text: str
    above: float | None = None
    least: float | None = None
    most: float | None = None
    choices: tuple[str, ...] = ()
    absent: str = ""

    @property
    def allowed(self) -> str:
        """The range as a text."""
        signs = (("> ", self.above), ("≥ ", self.least), ("≤ ", self.most))
        return ", ".join([*(f"{sign}{bound:g}" for sign, bound in signs if bound is not None), *self.choices])

    def checked_number(self, name: str, value: Any, *, whole: bool) -> float:
        """``value`` as a finite float (or int) in the range. Raises ``ValueError``."""
        if whole:
            value = checks.whole(name, value, int(self.least or 0))
            return value if self.most is None else int(checks.between(name, value, self.least or 0, self.most))
        number = checks.finite(name, value, self.unit)
        if abs(number) > checks.LARGEST:
            raise InputError(f"{name} must not exceed {checks.LARGEST:g} (got {checks.shortened(value)})")
        if self.above == 0.0 and 0.0 < abs(number) < 1.0 / checks.LARGEST:
            raise InputError(f"{name} must be at least {1.0 / checks.LARGEST:g} (got {checks.shortened(value)})")
        if self.above is not None and number <= self.above:
            bound = f"more than {self.above:g}" if self.above else "positive"
            raise InputError(f"{name} must be {bound} (got {checks.shortened(value)})")
        if self.most is not None:
            return checks.between(name, value, (self.above if self.least is None else self.least) or 0.0, self.most)
        if self.least == 0.0:
            return checks.non_negative(name, value)
        return number if self.least is None else checks.at_least(name, value, self.least)


@cache
def declared(part: type) -> dict[str, Declared]:
    """The fields of a dataclass that may be given, by name."""
    try:
        hints = get_type_hints(part, include_extras=True)
    except NameError:  # somebody else's annotations, of names that are imported for type checkers alone
        hints = {}
    return {field.name: _declared(hints.get(field.name)) for field in dataclasses.fields(part) if field.init}


def _declared(hint: Any) -> Declared:
    quantity = Quantity("", "")
    if get_origin(hint) is Annotated:
        hint, *said = get_args(hint)
        quantity = next((one for one in said if isinstance(one, Quantity)), quantity)
    kinds = get_args(hint) if get_origin(hint) in (Union, types.UnionType) else (hint,)
    plain = [kind for kind in kinds if kind is not types.NoneType]
    kind = plain[0] if len(plain) == 1 else None
    a_part = isinstance(kind, type) and (issubclass(kind, Part) or Protocol in kind.__bases__)
    if kind not in (float, int, bool, str) and not a_part:
        kind = None
    return Declared(kind=kind, optional=types.NoneType in kinds, quantity=quantity)


def key_of(name: str) -> str:
    """The key of a case file for a field: what Python reserves, as ``from``, ends in _ in code."""
    return name.removesuffix("_")


@dataclass(frozen=True)
class Part:
    """Base of frozen dataclasses that check their own fields, once, when they are made.

    where : the table of a case file that holds the fields; messages name a field ``where.field``.
    """

    where: ClassVar[str] = ""

    def __post_init__(self) -> None:
        for name, field in declared(type(self)).items():  # type: ignore[arg-type]
            value = field.checked(f"{self.where}.{key_of(name)}".lstrip("."), getattr(self, name))
            object.__setattr__(self, name, value)


def describe(part: Any) -> dict[str, Any]:
    """A part as JSON-ready settings: its class name and fields (nested parts too)."""
    out: dict[str, Any] = {"kind": type(part).__name__}
    for field in dataclasses.fields(part):
        value = getattr(part, field.name)
        if dataclasses.is_dataclass(value) and not isinstance(value, type):
            value = describe(value)
        out[field.name] = list(value) if isinstance(value, tuple) else value
    return out


def made_from(part: type[T], values: Any, where: str, more: Iterable[str] = ()) -> T:
    """The dataclass ``part`` from the table ``values``; ``more``: further keys that the error for an unknown one names.

    Raises :class:`InputError` for an unknown key (naming the nearest), a missing field, or a value that is refused.
    """
    if not isinstance(values, Mapping):
        raise InputError(f"{where} must be a table (got {checks.shortened(values)})")
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
    """The part that ``table["kind"]`` names, its other keys being the part's fields. Raises :class:`InputError` for an
    unknown kind, and as :func:`made_from`."""
    if not isinstance(table, Mapping):
        raise InputError(f"{where} must be a table (got {checks.shortened(table)})")
    if "kind" not in table:
        raise InputError(f"{where}.kind is required (one of {', '.join(sorted(kinds))})")
    kind = table["kind"]
    if not isinstance(kind, str) or kind not in kinds:
        near = nearest(kind if isinstance(kind, str) else "", kinds)
        raise InputError(f"{where}.kind: {checks.shortened(kind)} is not known{near}")
    values = {key: value for key, value in table.items() if key != "kind"}
    return made_from(kinds[kind], values, where, more=("kind",))


def part_or_auto(kinds: Mapping[str, type], table: Any, where: str, default: str | None = None) -> Any:
    """The same; ``None``, to be chosen, of an empty table or where the kind is "auto". A kind that is left out is the
    ``default`` if it has all keys of the table, else the only kind that has them."""
    if not isinstance(table, Mapping) or table.get("kind", "auto") != "auto":
        return part_from_table(kinds, table, where)
    keys = [key for key in table if key != "kind"]
    if not keys:
        return None
    fitting = [name for name, kind in kinds.items() if {*keys} <= {*map(key_of, declared(kind))}]
    known = [key for kind in kinds.values() for key in map(key_of, declared(kind))]
    if unknown := [key for key in keys if key not in known]:
        raise unknown_key(where, unknown[0], known)
    kind = default if default in fitting else fitting[0] if len(fitting) == 1 else None
    if kind is None or "kind" in table:
        raise InputError(f"{where}.kind is required next to {where}.{keys[0]} (one of {', '.join(sorted(kinds))})")
    return part_from_table(kinds, {**table, "kind": kind}, where)
