"""Two runs side by side: numbers at the end of their common time, the largest distance of their curves, settings."""

from __future__ import annotations

from collections.abc import Callable
from reprlib import Repr
from typing import Any

import numpy as np
from scipy.interpolate import CubicHermiteSpline

from bent_beam.history import ImpactHistory
from comparison.text_table import text_table
from measure.reduction import peak_moment

__all__ = ["compare_histories", "comparison_text"]

CURVES = ("total_impulse", "kinetic_energy", "strain_energy")


def compare_histories(a: ImpactHistory, b: ImpactHistory) -> dict[str, Any]:
    """What two histories have in common and what not; SI units.

    ``end`` : numbers at the end of the common time (``time`` : of each run), first and second; ``peak_moment`` : the
    largest until then; ``largest_difference`` : of each curve over the
    common time, over the first's largest value; of the gap over V₀t at the end, on the nodes of the first.
    """
    end = min(float(a.time[-1]), float(b.time[-1]))
    times = a.time[a.time <= end * (1.0 + 1e-9)]
    numbers: dict[str, list[float]] = {"time": [float(a.time[-1]), float(b.time[-1])]}
    apart: dict[str, float | None] = {}
    for name in CURVES:
        mine = np.interp(times, a.time, a.array(name))
        other = np.interp(times, b.time, b.array(name))
        numbers[name] = [float(np.interp(end, h.time, h.array(name))) for h in (a, b)]
        largest = float(np.abs(mine).max())
        apart[name] = float(np.abs(mine - other).max()) / largest if largest > 0.0 else None
    numbers["peak_moment"] = [peak_moment(h, until=end).moment for h in (a, b)]
    apart["gap"] = _gap_apart(a, b, end)
    settings = {
        key: [a.settings.get(key), b.settings.get(key)]
        for key in sorted({*a.settings, *b.settings})
        if a.settings.get(key) != b.settings.get(key)
    }
    return {
        "paths": [a.path, b.path],
        "same_impact": a.impact == b.impact,
        "end": numbers,
        "largest_difference": apart,
        "settings": settings,
        "versions": {
            k: [a.versions.get(k), b.versions.get(k)]
            for k in sorted({*a.versions, *b.versions})
            if a.versions.get(k) != b.versions.get(k)
        },
    }


def _gap_apart(a: ImpactHistory, b: ImpactHistory, end: float) -> float | None:
    """At ``end``, linear between the saved instants around it, which are others in either run; between the nodes of
    ``b`` by the cubics of its elements where it has slopes: elements may be long."""

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
        right = x >= 0.0
        return x[right], gap[right], None if slope is None else slope[right]

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
    """The same for a reader."""
    units = {"time": "s", "total_impulse": "N s", "kinetic_energy": "J", "strain_energy": "J", "peak_moment": "N m"}
    rows = []
    for name, (a, b) in found["end"].items():
        apart = found["largest_difference"].get(name)
        rows.append(
            [name.replace("_", " "), f"{a:.6g}", f"{b:.6g}", units[name], "-" if apart is None else f"{apart:.2g}"]
        )
    gap = found["largest_difference"]["gap"]
    lines = [
        text_table(["", first, second, "unit", "largest difference"], rows),
        f"largest difference of the gaps at the end of the common time: {'-' if gap is None else f'{gap:.2g}'} V0 t",
        "same impact" if found["same_impact"] else "the impacts differ",
    ]
    shown = Repr()
    shown.maxlist, shown.maxdict, shown.maxstring, shown.maxother = 4, 50, 200, 200  # a mesh may name all its nodes
    changed = {**found["settings"], **found["versions"]}
    lines += [f"{key}: {_told_apart(a, b, shown)}" for key, (a, b) in changed.items()]
    return "\n".join(lines)


def _told_apart(a: Any, b: Any, shown: Repr) -> str:
    """Both; where they differ in what is not shown of them, what stands at the first place at which they do."""
    place = ""
    while shown.repr(a) == shown.repr(b) and (key := _first_difference(a, b)) is not None:
        place += f"[{key!r}]"
        if isinstance(a, str):
            a, b = a[key:], b[key:]
        elif isinstance(a, dict):
            a, b = a.get(key), b.get(key)
        elif key < min(len(a), len(b)):
            a, b = a[key], b[key]
        else:
            return f"{len(a)} values | {len(b)} values, the same up to {place}"
    where = f"first differ at {place}: " if place else ""
    return f"{where}{shown.repr(a)} | {shown.repr(b)}"


def _first_difference(a: Any, b: Any) -> Any:
    """Its key or index; ``None`` : not two dictionaries, two lists or two strings, or none is found."""
    if isinstance(a, dict) and isinstance(b, dict):
        return next((k for k in sorted({*a, *b}, key=str) if a.get(k) != b.get(k)), None)
    for kind in (str, (list, tuple)):
        if isinstance(a, kind) and isinstance(b, kind) and a != b:
            return next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
    return None
