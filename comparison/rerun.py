"""A stored history run again from its own record: case, settings and versions suffice."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.checks import finite, shortened, whole
from bent_beam.history import ImpactHistory
from bent_beam.method import Method, method_type
from bent_beam.parts import InputError, made_from
from bent_beam.versions import versions
from comparison.text_table import text_table

__all__ = ["rerun_history", "rerun_text"]


def _rebuild(described: Any, known: Mapping[str, type], where: str) -> Any:
    """The part that :func:`bent_beam.parts.describe` described; nested parts too. Only known classes are ever made."""
    if described is None:
        return None
    if not isinstance(described, Mapping) or str(described.get("kind")) not in known:
        raise InputError(f"history's {where} cannot be made again (got {shortened(described)})")
    part = known[described["kind"]]
    values = {}
    for field in dataclasses.fields(part):
        if field.name in described and field.init:
            value = described[field.name]
            nested = isinstance(value, Mapping) and "kind" in value
            values[field.name] = _rebuild(value, known, f"{where}.{field.name}") if nested else value
    try:
        return made_from(part, values, where)
    except InputError as error:
        raise InputError(f"history's {error}") from None


def rerun_history(
    old: ImpactHistory, out: Path | None = None, progress: Callable[[float], None] | None = None
) -> dict[str, Any]:
    """Simulate ``old``'s case with its settings and compare: ``identical`` (bit for bit), ``largest_difference``
    (relative, per variable) and versions that differ. Keeps the new history in ``out``."""
    new = _run(old, progress)
    if out is not None:
        new.save(out)
    differences: dict[str, float | None] = {}
    for name in sorted({str(v) for v in (*old.dataset.data_vars, *new.dataset.data_vars)}):
        if name not in old.dataset or name not in new.dataset or old.dataset[name].shape != new.dataset[name].shape:
            differences[name] = None
            continue
        a, b = old.array(name), new.array(name)
        if not np.array_equal(a, b):
            scale = float(np.abs(a).max()) or 1.0
            differences[name] = float(np.abs(a.astype(float) - b.astype(float)).max()) / scale
    now = versions()
    return {
        "identical": not differences,
        "largest_difference": differences,
        "versions_changed": {k: [v, now.get(k)] for k, v in old.versions.items() if now.get(k) != v},
        "file": None if out is None else str(out),
    }


def rerun_text(found: dict[str, Any]) -> str:
    """The comparison for a reader; shares are of a variable's largest value."""
    lines = ["The new run is the same, bit for bit." if found["identical"] else "The new run differs."]
    apart = [
        [n, "missing, or of another size" if v is None else f"{v:.2g}"] for n, v in found["largest_difference"].items()
    ]
    if apart:
        lines += ["", text_table(["variable", "largest difference over its largest value"], apart)]
    changed = [[name, *map(str, pair)] for name, pair in found["versions_changed"].items()]
    if changed:
        lines += ["", text_table(["version of", "then", "now"], changed)]
    return "\n".join(lines if found["file"] is None else [*lines, f"history: {found['file']}"])


def _run(old: ImpactHistory, progress: Callable[[float], None] | None) -> ImpactHistory:
    settings = old.settings
    save: Any = settings.get("save", old.time.size)
    if isinstance(save, list):
        save = np.array([finite("history's save", time) for time in save])
    else:
        save = whole("history's save", save, 1)
    if "end_time" not in settings:
        raise InputError("history's settings lack end_time: it cannot be run again")
    method = method_type(old.path)
    values: dict[str, Any] = {}
    for field in dataclasses.fields(method):
        if field.name not in settings:
            continue
        kinds = method.PARTS.get(field.name)
        value = settings[field.name]
        known = {} if kinds is None else {cls.__name__: cls for cls in kinds.values()}
        values[field.name] = value if kinds is None else _rebuild(value, known, field.name)
    made: Method = method(**values)
    return made.simulate(old.impact, end_time=settings["end_time"], save=save, progress=progress)
