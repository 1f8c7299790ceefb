"""Mesh, length and contact points that are chosen from the problem by scaling arguments, when none are given."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from bent_beam import Impact
from bent_beam.checks import positive
from bent_beam.meshes import NodesMesh, ScaleFreeMesh
from exudyn_models.scaling import Scaling, front_bound

__all__ = ["chosen_half_length", "chosen_mesh", "end_time_of", "far_field", "reachable"]

Array = NDArray[np.float64]

DEFAULT_DURATION = 0.1  # τ, the longest time that the thesis computes
FIRST_SPREAD = 0.005  # T*: measured, from when on a finite beam's impulse is 1 % off the infinite beam's (κ/ν = 0.5)
GROWTH = 0.01  # neighbours of the chosen mesh: 5 elements over the front's bending length at κ/ν = 0.05, 20 at 0.2
OF_ZONE, OF_BENDING = 300.0, 30.0  # the smallest element over the front's bound and over the bending ahead of it
REACH, REACH_OF_FRONT = 12.0, 8.0  # half length to model, see far_field; tests/exudyn_models/test_exudyn_constants.py


def far_field(scaling: Scaling) -> float:
    """Half length to model, in units of Λ, when the beam is longer: what the end would send back stays out of the
    picture.

    Waves of the front's length 2/λ₀ travel ~ 2λ₀ by the end and longer ones less; beyond 12 the kernel H has decayed.
    """
    kappa = scaling.kappa
    reach = REACH + REACH_OF_FRONT * math.sqrt(2.0 / max(kappa, 2e-3))
    # a growing velocity (χ > 0) or an upward bent end (ψ > 0) would bring the far field to the wall: stay well inside
    spread = kappa - max(scaling.chi, 0.0)
    if scaling.psi > 0.0 and spread > 0.0:
        reach = min(reach, 0.6 * math.sqrt(12.0 * spread / scaling.psi))
    return reach


def chosen_half_length(impact: Impact, end_time: float | None = None) -> float:
    """The half length, m, modelled when no mesh is given: the beam's, or less where nothing returns in time."""
    scaling = Scaling(impact, end_time_of(impact, end_time), 1.0)
    return min(impact.half_length, far_field(scaling) * scaling.length)


def chosen_mesh(
    impact: Impact, end_time: float | None = None, *, explicit: bool = False, coarsen: float = 1.0
) -> NodesMesh:
    """The mesh that ``simulate`` lays when none is given (half beam), to lay the same under several impacts.

    coarsen : factor on every element's length.
    """
    positive("coarsen", coarsen)
    scaling = Scaling(impact, end_time_of(impact, end_time), 1.0)
    front = front_bound(scaling.kappa)
    if explicit:
        smallest = min(max(front, 0.5) / 25, (2.0 / front) / 10)
        rule = ScaleFreeMesh(smallest * scaling.length * coarsen, 1.0 + 0.02 * coarsen)
    else:
        smallest = min(front / OF_ZONE, (2.0 / front) / OF_BENDING)
        rule = ScaleFreeMesh(smallest * scaling.length * coarsen, 1.0 + GROWTH * coarsen)
    nodes = rule.nodes(chosen_half_length(impact, end_time))
    return NodesMesh(places=tuple(float(place) for place in nodes))


def end_time_of(impact: Impact, end_time: float | None) -> float:
    """The end time, s, checked; None: τ = 0.1."""
    return impact.checked_end_time(DEFAULT_DURATION * impact.time_scale if end_time is None else end_time)


def reachable(x: Array, scaling: Scaling, centre: int) -> NDArray[np.int64]:
    """Nodes that may touch: half as far again as the free motion would carry the beam into the wall."""
    if scaling.impact.opposite_wall is not None or scaling.spin:
        return np.arange(x.size)
    times = np.linspace(0.05, 1.0, 20)[:, None]
    inside = (scaling.free_deflection(x[None, :], times) > 0.0).any(axis=0)
    place = np.abs(x - scaling.first_touch)
    reach = 1.5 * place[inside].max(initial=0.0)
    wide = place <= reach * (1.0 + 1e-9)  # a node right there belongs, whatever its round-off
    wide[max(0, centre - 20) : centre + 21] = True
    return np.flatnonzero(wide)
