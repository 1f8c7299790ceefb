"""Methods to compare, as the command line and a file name them: ``--path``, ``--set``, ``--methods FILE.toml``.

A methods file is a list of labelled methods, each with the tables that a case has for its path::

    [[method]]
    label = "Moreau–Jean at the middles"
    path = "hermite"
    integrator = {kind = "moreau_jean"}
    contact = {kind = "middle"}
"""

from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from bent_beam.cases import Case, lay_over, read_toml
from bent_beam.checks import shortened
from bent_beam.errors import InputError, nearest, unknown_key
from bent_beam.method import Method, method_from_tables, paths

__all__ = ["PATHS", "check_effect", "chosen_methods", "methods_from_file", "methods_of"]

MOST = 10_000
PATHS = ("hermite", "exudyn")  # that are compared where none is named


def check_effect(assignments: Iterable[str], names: Sequence[str], unused: Mapping[str, str], option: str) -> None:
    """``InputError`` for an assignment to a path that is not among ``names``, or to a table ``unused`` for a reason.
    A case file may hold settings that a command does not use; on the command line they are a mistake."""
    other = f"the path is {' and '.join(names)}" if names else "nothing is simulated"
    reasons = dict.fromkeys({*paths()} - {*names}, other) | dict(unused)
    for assignment in assignments:
        if (table := assignment.partition("=")[0].partition(".")[0].strip()) in reasons:
            raise InputError(f"{option} {shortened(assignment)} has no effect: {reasons[table]}; leave it out")


def chosen_methods(
    names: Sequence[str], assignments: Sequence[str], files: Sequence[Path], case: Case | None = None
) -> list[Method]:
    """The methods of ``--path`` and ``--set``, or those of each ``--methods FILE``; see :func:`methods_of`. Raises
    :class:`InputError` when both name some."""
    if not files:
        return methods_of(names or PATHS, assignments, case)
    if names or assignments:
        raise InputError(f"--methods {files[0]} names the methods: leave --path and --set out, or write them there")
    return methods_from_file(*files)


def methods_of(names: Sequence[str], assignments: Sequence[str] = (), case: Case | None = None) -> list[Method]:
    """A method a path, with ``PATH.PART.KEY=VALUE`` assignments laid over its defaults; the label names them.

    case : whose settings the methods take; the assignments are then among them already.
    Raises :class:`InputError` for an assignment to a path that is not among ``names``.
    """
    twice = next((name for i, name in enumerate(names) if name in names[:i]), None)
    if twice is not None:
        raise InputError(f"--path {twice} is given twice: methods of one path are told apart in a file (--methods)")
    tables: dict[str, Any] = {}
    changes: dict[str, list[str]] = {name: [] for name in names}
    for assignment in assignments:
        path = assignment.partition(".")[0].strip()
        if path not in changes:
            known = [n for n in names if n in paths()] or names
            raise InputError(f"--set {shortened(assignment)}: {path} is not a path asked for{nearest(path, known)}")
        changes[path].append(assignment.partition(".")[2].replace(".kind", ""))
    if case is None:
        lay_over(tables, assignments)
    found = []
    for name in names:
        make = partial(method_from_tables, name, tables.get(name, {})) if case is None else partial(case.method, name)
        made = make()
        found.append(make(label=f"{made.label}, {', '.join(changes[name])}") if changes[name] else made)
    return found


def methods_from_file(*files: Path) -> list[Method]:
    """The labelled methods of files, in order.

    Raises :class:`InputError` for anything but a list of methods, an unknown path, part or value, a label given twice.
    """
    found = [method for file in files for method in _methods(file)]
    labels = [method.label for method in found]
    if twice := next((label for i, label in enumerate(labels) if label in labels[:i]), None):
        raise InputError(f"methods file {', '.join(map(str, files))}: label {twice!r} is given twice")
    return found


def _methods(file: Path) -> list[Method]:
    content = read_toml(file, "methods file")
    if content.keys() & {"beam", "impact"}:
        raise InputError(f"methods file {file} is a case file; a methods file holds [[method]] tables only")
    for key in content:
        if key != "method":
            raise unknown_key("", str(key), ["method"])
    tables = content.get("method")
    if not isinstance(tables, list) or not tables:
        raise InputError(f"methods file {file} must hold at least one [[method]] table")
    if len(tables) > MOST:
        raise InputError(f"methods file {file} holds {len(tables)} methods; {MOST} are the most")
    return [_method(table, f"method {number}") for number, table in enumerate(tables, start=1)]


def _method(table: Any, where: str) -> Method:
    if not isinstance(table, Mapping):
        raise InputError(f"{where} must be a table (got {shortened(table)})")
    rest = {key: value for key, value in table.items() if key not in ("label", "path")}
    if not isinstance(table.get("path"), str):
        raise InputError(f"{where}: path is required (one of {', '.join(paths())})")
    label = table.get("label")
    if label is not None and (not isinstance(label, str) or not 0 < len(label) <= 80 or not label.isprintable()):
        raise InputError(f"{where}: label must be a short text (got {shortened(label)})")
    if label is not None and "$" in label:
        raise InputError(f"{where}: label must not hold $, which figures take for mathematics (got {shortened(label)})")
    try:
        return method_from_tables(table["path"], rest, label=label)
    except InputError as error:
        raise InputError(f"{where}: {error}") from None
