"""The stored map of the whole impact, interpolated; reading it takes nothing of what measures it
(:mod:`comparison.whole_impact.map`)."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import finite, non_negative, positive
from bent_beam.measure.measured import Band, Measured

__all__ = ["DATA", "POINT", "bounce_from_map", "stored_map"]

Array = NDArray[np.float64]
DATA = Path(__file__).with_name("map.json")
POINT = 4.0  # κ/ν that stands for ∞: the midspan moment never reaches it (2.7 at most), the beam touches in one point


@cache
def stored_map() -> dict[str, Any]:
    """The stored map."""
    return dict(json.loads(DATA.read_text(encoding="utf-8")))


@cache
def _grids() -> tuple[Array, Array, dict[str, tuple[Array, Array]]]:
    """κ/ν, η/T*, and for each number its values and error bars, shape (dampings, kappas)."""
    table = stored_map()
    kappas, dampings = np.array(table["kappa_over_nu"]), np.array(table["damping"])
    at = {(p["damping"], p["kappa_over_nu"]): p["numbers"] for p in table["points"]}
    found = {}
    for name in table["points"][0]["numbers"]:
        pairs = np.array([[at[d, k][name] for k in kappas] for d in dampings], float)
        found[name] = (pairs[..., 0], pairs[..., 1])
    return kappas, dampings, found


def bounce_from_map(kappa_over_nu: float, damping: float) -> Mapping[str, Measured | Band] | None:
    """Every number of the whole impact at κ/ν and η/T*, interpolated between the map's points; ``None`` off the map
    (κ/ν < 0.05, η/T* > 1e-1). Without damping, and with less than the map's least (1e-4), which is as irregular, the
    band between the nearest bands.

    The error bar is the largest of the surrounding points', and, along either axis, 2u(1 − u)|Δ²| of the largest second
    difference around the place u between two points. A parabola takes a quarter of that; the numbers go up and down
    with κ/ν, with weak damping from one point to the next: of 240 numbers at random places 30 were outside half of
    this bar and one outside all of it.
    """
    kappa = POINT if kappa_over_nu == math.inf else min(positive("kappa_over_nu", kappa_over_nu), POINT)
    kappas, dampings, numbers = _grids()
    damping = non_negative("damping", finite("damping", damping))
    if kappa < kappas[0] or damping > dampings[-1]:
        return None
    if damping < dampings[0]:
        return _band(kappa)
    j, v = _place(np.log(kappas), math.log(kappa))
    i, u = _place(np.log(dampings), math.log(damping))
    weights = np.array([[(1 - u) * (1 - v), (1 - u) * v], [u * (1 - v), u * v]])
    found = {}
    for name, (values, errors) in numbers.items():
        used = weights > 1e-12
        value = float(np.sum(values[i : i + 2, j : j + 2] * weights))
        spread = 2.0 * u * (1.0 - u) * _bend(values[:, j : j + 2], i)
        spread += 2.0 * v * (1.0 - v) * _bend(values[i : i + 2].T, j)
        found[name] = Measured(value, math.hypot(float(errors[i : i + 2, j : j + 2][used].max()), spread))
    return found


def _band(kappa: float) -> dict[str, Band]:
    bands = stored_map()["bands"]
    at = np.log([band["kappa_over_nu"] for band in bands])
    return {
        name: Band(
            mean=float(np.interp(math.log(kappa), at, [band["band"][name][0] for band in bands])),
            std=float(np.interp(math.log(kappa), at, [band["band"][name][1] for band in bands])),
            runs=int(bands[0]["runs"]),
        )
        for name in bands[0]["band"]
    }


def _bend(values: Array, i: int) -> float:
    """Largest second difference along the first axis at the points ``i`` and ``i + 1``; 0 at an end of it."""
    middle = [k for k in (i, i + 1) if 0 < k < len(values) - 1]
    return max((float(np.abs(values[k - 1] - 2.0 * values[k] + values[k + 1]).max()) for k in middle), default=0.0)


def _place(grid: Array, at: float) -> tuple[int, float]:
    """The interval of ``grid`` that holds ``at``, and how far along, 0 … 1."""
    i = int(np.clip(np.searchsorted(grid, at, side="right") - 1, 0, grid.size - 2))
    share = float(np.clip((at - grid[i]) / (grid[i + 1] - grid[i]), 0.0, 1.0))
    return i, 0.0 if share < 1e-9 else 1.0 if share > 1.0 - 1e-9 else share
