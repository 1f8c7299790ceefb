"""Two runs side by side: numbers at the end of their common time, the largest distance of their curves, settings."""

import dataclasses
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from reprlib import Repr
from typing import Any

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from bent_beam import ImpactHistory, InputError
from bent_beam.checks import finite, whole
from bent_beam.fields import part_from_table
from bent_beam.measure.instant import largest_moment
from bent_beam.method import Progress, method_type
from bent_beam.versions import versions
from comparison.readable import milliseconds, shown, text_table, unit_for

CURVES = ("total_impulse", "kinetic_energy", "strain_energy")


class Short(Repr):
    """Values as a table has room for: a mesh may name all its nodes, each to its last digit."""

    def repr_float(self, value: float, level: int) -> str:
        return repr(float(f"{value:.6g}"))


SHORT = Short()
SHORT.maxlist, SHORT.maxstring, SHORT.maxother = 4, 60, 60


def compare_histories(a: ImpactHistory, b: ImpactHistory) -> dict[str, Any]:
    """What two histories have in common and what not; SI units.

    ``impact``, ``settings``, ``versions`` : what differs in each. ``end`` : numbers at the end of the common time
    (``time`` : of each run), first and second; ``peak_moment`` : the largest until then; ``largest_difference`` : of
    each curve over the common time, over the first's largest value; of the gap over V₀t at the end, on the nodes
    of the first.
    """
    end = min(float(a.time[-1]), float(b.time[-1]))
    begin = max(float(a.time[0]), float(b.time[0]))
    times = a.time[(a.time >= begin) & (a.time <= end * (1.0 + 1e-9))]
    if not times.size:  # a long interval of the first may hold all of the second
        times = np.array([begin, end])
    if begin > end:
        raise InputError(f"the two runs have no time in common: one ends at {end:.6g} s, one begins at {begin:.6g} s")
    numbers: dict[str, list[float]] = {"time": [float(a.time[-1]), float(b.time[-1])]}
    apart: dict[str, float | None] = {}
    for name in CURVES:
        mine = np.interp(times, a.time, a.array(name))
        other = np.interp(times, b.time, b.array(name))
        numbers[name] = [float(np.interp(end, h.time, h.array(name))) for h in (a, b)]
        largest = float(np.abs(mine).max())
        apart[name] = float(np.abs(mine - other).max()) / largest if largest > 0.0 else None
    if not math.isclose(a.modelled_length, b.modelled_length, rel_tol=1e-6):  # each models another part of the beam
        apart["kinetic_energy"] = None
    numbers["peak_moment"] = [largest_moment(h, end).moment for h in (a, b)]
    apart["gap"] = _gap_apart(a, b, end)
    return {
        "paths": [a.path, b.path],
        "same_impact": a.impact == b.impact,
        "impact": _apart(vars(a.impact), vars(b.impact)),
        "end": numbers,
        "largest_difference": apart,
        "settings": _apart(a.settings, b.settings),
        "versions": _apart(a.versions, b.versions),
    }


def _apart(a: Mapping[str, Any], b: Mapping[str, Any]) -> dict[str, Any]:
    """The entries that differ, a pair of values each; ``None`` where one has none."""
    return {key: [a.get(key), b.get(key)] for key in sorted({*a, *b}, key=str) if a.get(key) != b.get(key)}


def _gap_apart(a: ImpactHistory, b: ImpactHistory, end: float) -> float | None:
    """At ``end``, linear between the saved instants around it, which are others in either run; between the nodes of
    ``b`` by the cubics of its elements where it has slopes: elements may be long."""
    halved = 1 in (a.sides, b.sides)  # one of them is of the half beam alone

    def shape(history: ImpactHistory) -> tuple[Any, Any, Any]:
        after = min(int(np.searchsorted(history.time, end * (1.0 - 1e-9))), history.time.size - 1)
        before = max(after - 1, 0)
        share = float(np.interp(end, history.time[[before, after]], [0.0, 1.0])) if before < after else 1.0

        def at_end(values: Callable[[int], Any]) -> Any:
            return (1.0 - share) * values(before) + share * values(after)

        x, gap = at_end(history.positions), at_end(lambda k: history.array("gap", k))
        slope = None
        if "slope" in history:
            from_touch = x - history.impact.first_touch
            slope = -at_end(lambda k: history.array("slope", k)) - history.impact.wall_curvature * from_touch
        kept = x >= 0.0 if halved else np.ones(x.size, bool)
        return x[kept], gap[kept], None if slope is None else slope[kept]

    (x, gap, _), (other_x, other_gap, other_slope) = shape(a), shape(b)
    common = (x >= other_x[0]) & (x <= other_x[-1])
    scale = a.impact.velocity * end
    if scale <= 0.0 or not common.any():
        return None
    if other_slope is None:
        between = np.interp(x[common], other_x, other_gap)
    else:
        between = CubicHermiteSpline(other_x, other_gap, other_slope)(x[common])
    return float(np.abs(gap[common] - between).max()) / scale


def comparison_text(found: dict[str, Any], first: str, second: str) -> str:
    """The same for a reader: a table of numbers, and one of the settings and versions that differ."""
    units = {"time": "s", "total_impulse": "N s", "kinetic_energy": "J", "strain_energy": "J", "peak_moment": "N m"}
    rows, apart = [], found["largest_difference"]
    for name, (a, b) in found["end"].items():
        scale, unit = unit_for(units[name], [a, b])
        values = [f"{scale * a:.6g}", f"{scale * b:.6g}"]
        title = "end of the run" if name == "time" else name.replace("_", " ")
        rows.append([title, *values, unit, shown(apart.get(name), ".2g")])
    rows.append(["gap at the end", "", "", "V0 t", shown(apart["gap"], ".2g")])
    lines = [
        text_table(["", first, second, "unit", "largest difference"], rows),
        "",
        f"Numbers at the end of the common time, {milliseconds(min(found['end']['time']))}. Differences: the largest",
        "over the curve, as a share of the first run's largest value. Energies are those of the part of the beam that",
        "a run models; kinetic energies of unlike parts have no difference.",
        "Both runs are of the same case." if found["same_impact"] else "The runs are of two cases that differ.",
    ]
    changed = [row for part in ("impact", "settings", "versions") for row in _changed(found[part])]
    lines += ["", text_table(["what differs", first, second], changed, (0, 1, 2))] if changed else []
    return "\n".join(lines)


def _changed(pairs: dict[str, Any], where: str = "") -> list[list[str]]:
    """A row for each entry that differs; entries of tables by their full name."""
    rows = []
    for key, (a, b) in pairs.items():
        alike = SHORT.repr(a) == SHORT.repr(b)
        if all(one is None or isinstance(one, dict) for one in (a, b)) and (a or b):
            rows += _changed(_apart(a or {}, b or {}), f"{where}{key}.")
        elif alike and isinstance(a, (str, list, tuple)):
            at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
            rest = {f"{key}[{at}:]": [a[at:], b[at:]]} if at else {f"{key}[0]": [a[0], b[0]]}  # they begin unlike
            rows += _changed(rest, where)
        else:
            text = repr if alike else SHORT.repr
            rows.append([f"{where}{key}", *("-" if v is None else text(v).strip("'") for v in (a, b))])
    return rows


def rerun_history(old: ImpactHistory, out: Path | None = None, progress: Progress | None = None) -> dict[str, Any]:
    """Simulate ``old``'s case with its settings and compare: ``identical`` (bit for bit), ``largest_difference``
    (relative, per variable, times and places included) and versions that differ. Keeps the new history in ``out``."""
    new = _again(old, progress).until(float(old.time[-1]))  # a run to a time goes on beyond it
    if out is not None:
        about = {name: old.attrs[name] for name in ("title", "section") if name in old.attrs}
        ImpactHistory.of(new.dataset.assign_attrs(about)).save(out)
    differences: dict[str, float | None] = {}
    for name in sorted({*old.variables, *new.variables}):  # times and places too
        a, b = (h.array(name) if name in h else None for h in (old, new))
        if a is None or b is None or a.shape != b.shape:
            differences[name] = None
        elif not np.array_equal(a, b):
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
    lines, lost = ["The new run is the same, bit for bit."], "missing, or of another size"
    if not found["identical"]:
        apart = [[name, lost if v is None else f"{v:.2g}"] for name, v in found["largest_difference"].items()]
        table = text_table(["variable", "largest difference over its largest value"], apart)
        lines = ["The new run differs.", "", table]
    if changed := [[name, *map(str, pair)] for name, pair in found["versions_changed"].items()]:
        lines += ["", text_table(["version of", "then", "now"], changed)]
    return "\n".join(lines if found["file"] is None else [*lines, f"history: {found['file']}"])


def _again(old: ImpactHistory, progress: Progress | None) -> ImpactHistory:
    settings, what = old.settings, "history's save"
    save = settings.get("save", old.time.size)
    save = np.array([finite(what, time) for time in save]) if isinstance(save, list) else whole(what, save, 1)
    if "end_time" not in settings:
        raise InputError("history's settings lack end_time: it cannot be run again")
    method = method_type(old.path)
    values = {field.name: settings[field.name] for field in dataclasses.fields(method) if field.name in settings}
    for name, kinds in getattr(method, "PARTS", {}).items():
        if values.get(name) is not None:  # described by its class: only known ones are ever made
            known = {kind.__name__: kind for kind in kinds.values()}
            values[name] = part_from_table(known, values[name], f"history's {name}")
    return method(**values).simulate(old.impact, end_time=settings["end_time"], save=save, progress=progress)
