"""What the doctor reads off a result besides its numbers."""

from __future__ import annotations

import math

import numpy as np

from open_benchmark.result import Result

__all__ = ["mesh_of", "number", "unsteadiness"]

FEWEST_SNAPSHOTS = 10


def number(value: float | None) -> float:
    return math.nan if value is None else value


def mesh_of(result: Result, front: float) -> tuple[float, float, float]:
    """Element at ``front``, largest growth and half length: off the nodes, or as the adapter declares them."""
    declared = number(result.model("smallest_element")), math.nan, number(result.model("half_length"))
    if result.x is None:
        return declared
    nodes = np.unique(np.abs(result.x if result.x.ndim == 1 else result.x[-1]))
    sizes = np.diff(nodes)
    if sizes.size < 3:
        return declared
    at = min(int(np.searchsorted(nodes, front)), sizes.size) - 1
    growth = float((sizes[2:] / sizes[1:-1]).max()) if sizes.size > 3 else math.nan
    return float(sizes[max(at, 0)]), growth, float(nodes[-1])


def unsteadiness(result: Result) -> float:
    """Standard deviation of ln(lift) about its straight line over ln τ, at ten snapshots of the window or more."""
    inner = 0.6 * math.sqrt(2.0 / max(result.problem.kappa_over_nu, 1e-9))
    zones = [(when, gap[places <= inner * math.sqrt(when)]) for when, places, gap in result.snapshots()]
    lifts = [(math.log(when), math.log(gap.max() / when)) for when, gap in zones if gap.size and gap.max() > 0.0]
    if len(lifts) < FEWEST_SNAPSHOTS:
        return math.nan
    times, heights = np.array(lifts).T
    return float(np.std(heights - np.polyval(np.polyfit(times, heights, 1), times)))
