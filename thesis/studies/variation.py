"""A study's parameter varied on any method: parts and fields are named, the path does not matter.

A method shows its parts by its fields and its ``PARTS`` (:mod:`bent_beam.method`). A study that needs a part which a
method lacks names it (:class:`NotVaried`), and the method becomes a row with that reason.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from bent_beam.cases import Case
from bent_beam.impact import Impact
from bent_beam.meshes import MESHES, Mesh
from bent_beam.method import Method, chosen_for


class NotVaried(ValueError):
    """A method lacks a part or a field that a study varies."""


@dataclass(frozen=True)
class Setting:
    """One value of the varied parameter: its name, the same for all methods, and the method that has it.

    value : as a number, where it is one. impact, end_time : where they are not the case's own.
    """

    name: str
    method: Method
    value: float | None = None
    impact: Impact | None = None
    end_time: float | None = None


Vary = Callable[[Method, Case], Sequence[Setting]]
"""Settings of a study on a method; raises :class:`NotVaried`."""


def has_part(method: Method, name: str) -> bool:
    """Whether a method has a part of this name."""
    return name in getattr(method, "PARTS", {})


def kinds_of(method: Method, name: str) -> Mapping[str, type]:
    """The kinds of a part that a method knows."""
    if not has_part(method, name):
        raise NotVaried(f"{method.path} has no {name}")
    kinds: Mapping[str, type] = getattr(method, "PARTS")[name]  # noqa: B009
    return kinds


def part_of(method: Method, name: str, case: Case, *, filled: bool = False) -> Any:
    """A part as the method has it; where it is left open, of the kind that is chosen for the case.

    filled : with the part's own open fields chosen too.
    """
    kinds_of(method, name)
    own = getattr(method, name)
    if own is not None and not filled:
        return own
    chosen = getattr(chosen_for(method, case.impact, case.end_time), name)
    if chosen is None:
        raise NotVaried(f"{method.path} chooses its {name} in the run: name one")
    if filled:
        return chosen
    try:
        return type(chosen)()
    except TypeError:  # it has no defaults
        return chosen


def with_parts(method: Method, **parts: Any) -> Method:
    """A copy with other parts."""
    changed: Any = method
    return dataclasses.replace(changed, **parts)


def with_field(method: Method, name: str, case: Case, **values: Any) -> Method:
    """A copy with fields of one part changed."""
    part = part_of(method, name, case)
    for field in values.keys() - {f.name for f in dataclasses.fields(part)}:
        raise NotVaried(f"its {name} ({type(part).__name__}) has no {field}")
    return with_parts(method, **{name: dataclasses.replace(part, **values)})


def of_kind(kind: type, part: Any) -> Any:
    """A part of another kind that keeps the fields which both kinds have and ``part`` sets."""
    known = {f.name for f in dataclasses.fields(kind)}
    given = {f.name: getattr(part, f.name) for f in dataclasses.fields(part) if f.name in known}
    return kind(**{name: value for name, value in given.items() if value is not None})


def resolution(method: Method, case: Case) -> tuple[Mesh, Callable[[Mesh], Method]]:
    """The method's mesh, and a function that gives a copy with another mesh and the steps that it has with this one."""
    mesh = part_of(method, "mesh", case, filled=True)
    steps = {"integrator": part_of(method, "integrator", case, filled=True)} if has_part(method, "integrator") else {}
    return mesh, lambda other: with_parts(method, mesh=other, **steps)


def grown(method: Method, case: Case, growths: Sequence[float]) -> list[Setting]:
    """The method with meshes that grow by these factors outside the zone; none where its mesh does not grow."""
    mesh, laid_on = resolution(method, case)
    if type(mesh) not in MESHES.values():
        return []
    changed: Any = mesh
    for name in ("growth_outside", "growth"):
        if getattr(mesh, name, None) is not None:
            return [Setting(f"e = {e:g}", laid_on(dataclasses.replace(changed, **{name: e})), e) for e in growths]
    return []
