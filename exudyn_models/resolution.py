"""Mesh, length, steps and contact points that are chosen from the problem by scaling arguments, when none are given.

While nothing but the first spread of the zone moves it, elements and steps grow with distance and time. Where κ/ν is
so small that the front is thin, the elements up to its bound are equal: what counts is that each hit of a node is
plastic (:mod:`exudyn_models.contacts.penalty`), not the bending ahead. A run that
lasts until waves are back from the ends needs every part of the beam alike, and steps that resolve the contact: one
that closes a node in a step much longer than the penalty's own time gives half of the reaction once more in the next,
and the beam leaves with more energy than it had. There the mesh is uniform and h = ½Δx²√(μ/EI).
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any, cast

import numpy as np

from bent_beam import Impact
from bent_beam.checks import positive
from bent_beam.impact import FIRST_SPREAD
from bent_beam.meshes import Mesh, NodesMesh, ScaleFreeMesh
from exudyn_models.arrays import Array, Indices
from exudyn_models.integrators import Integrator
from exudyn_models.scaling import Scaling, front_bound

__all__ = [
    "chosen_half_length",
    "chosen_mesh",
    "chosen_steps",
    "far_field",
    "lasts_until_waves_return",
    "reachable",
    "refined_choice",
    "resolving_step",
    "thin_front",
]

GROWTH = 0.01  # neighbours of the chosen mesh: 5 elements over the front's bending length at κ/ν = 0.05, 20 at 0.2
THIN = 0.04  # κ/ν below which the front passes an element of that mesh about as fast as the element bends
WAVES, GROWTH_OF_WAVES = 2.0, 0.02  # beyond so many times the front's bound there are waves only, and these neighbours
OF_ZONE, OF_BENDING = 300.0, 30.0  # the smallest element over the front's bound and over the bending ahead of it
OF_THIN_FRONT = 3.0  # equal elements over the bending length of a thin front at the end of the run, …
LEAST_OF_ZONE, MOST_OF_ZONE = 300.0, 800.0  # … but so many at least and at most up to the front's bound
BEYOND = 1.1  # times the front's bound, where these end
PASSED = 2.0  # elements that a thin front passes in a step
REACH, REACH_OF_FRONT = 12.0, 8.0  # half length to model, see far_field; tests/exudyn_models/test_exudyn_constants.py
ELEMENT_STEPS = 4e5  # elements times steps of a run with uniform elements: a few seconds
FEWEST = 60  # uniform elements of a half beam, from 0.9 T* on; tests/exudyn_models/test_exudyn_constants.py
STEP = 0.5  # h/(Δx²√(μ/EI)) that resolves the contact
MOST_STEPS = 200_000  # that an open time step may ask for


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
    scaling = Scaling.of(impact, impact.checked_end_time(end_time))
    return min(impact.half_length, far_field(scaling) * scaling.length)


def chosen_mesh(
    impact: Impact, end_time: float | None = None, *, explicit: bool = False, coarsen: float = 1.0
) -> NodesMesh:
    """The mesh that ``simulate`` lays when none is given (half beam), to lay the same under several impacts.

    coarsen : factor on every element's length.
    """
    positive("coarsen", coarsen)
    if lasts_until_waves_return(impact, end_time):
        steps_at_one = 2.0 * impact.checked_end_time(end_time) / impact.slow_time_scale  # with one element
        count = max((ELEMENT_STEPS / steps_at_one) ** (1.0 / 3.0), FEWEST) / coarsen
        places = np.linspace(0.0, impact.half_length, max(2, round(count)) + 1)
        return NodesMesh(places=tuple(float(place) for place in places))
    scaling = Scaling.of(impact, impact.checked_end_time(end_time))
    front = front_bound(scaling.kappa)
    if explicit:
        element, growth, zone = min(max(front, 0.5) / 25, (2.0 / front) / 10), GROWTH_OF_WAVES, None
    elif thin_front(scaling.kappa):
        count = min(max(OF_THIN_FRONT * front**2 / 2.0, LEAST_OF_ZONE), MOST_OF_ZONE)
        element, growth, zone = front / count, 0.0, BEYOND * front
    else:
        element, growth, zone = min(front / OF_ZONE, (2.0 / front) / OF_BENDING), GROWTH, WAVES * front
    rule = ScaleFreeMesh(
        element * scaling.length * coarsen,
        1.0 + growth * coarsen,
        zone=None if zone is None else zone * scaling.length,
        growth_outside=None if zone is None else 1.0 + GROWTH_OF_WAVES * coarsen,
    )
    nodes = rule.nodes(chosen_half_length(impact, end_time))
    return NodesMesh(places=tuple(float(place) for place in nodes))


def lasts_until_waves_return(impact: Impact, end_time: float | None) -> bool:
    """Whether waves from the ends of the beam are back before the end time, s."""
    end = impact.checked_end_time(end_time)
    return end > FIRST_SPREAD * impact.slow_time_scale and chosen_half_length(impact, end) == impact.half_length


def resolving_step(mesh: Mesh, impact: Impact) -> float:
    """The time step, s, that resolves the contact of the shortest element: ½Δx²√(μ/EI)."""
    return STEP * float(np.diff(mesh.nodes(impact.half_length)).min()) ** 2 / impact.wave_constant


def thin_front(kappa_over_nu: float) -> bool:
    """Whether no mesh of moderate size resolves the bending ahead of the front."""
    return kappa_over_nu < THIN


def chosen_steps(integrator: Integrator, mesh: Mesh, impact: Impact, end_time: float | None) -> Integrator:
    """``integrator``, which nobody asked for, with steps that resolve the contact once waves are back from the ends,
    and in which a thin front passes ``PASSED`` elements at most.

    With elements so short that the former would take more than ``MOST_STEPS`` it stays as it is: the run warns where
    its contact gives energy.
    """
    end = impact.checked_end_time(end_time)
    changed: dict[str, float] = {}
    if integrator.explicit:
        return integrator
    if lasts_until_waves_return(impact, end_time):
        step = resolving_step(mesh, impact)
        if end <= MOST_STEPS * step:
            changed["time_step"] = step
    elif thin_front(impact.kappa_over_nu):
        changed["relative_step"] = min(cast(Any, integrator).relative_step, _step_over_elements(mesh, impact, end))
    return cast(Integrator, dataclasses.replace(cast(Any, integrator), **changed))


def _step_over_elements(mesh: Mesh, impact: Impact, end: float) -> float:
    """h/t with which the front, x ~ √t, passes ``PASSED`` elements in the last step."""
    half_length = mesh.places[-1] if isinstance(mesh, NodesMesh) else impact.half_length
    places = mesh.nodes(half_length)
    front = front_bound(impact.kappa_over_nu) * Scaling.of(impact, end).length
    k = min(max(int(np.searchsorted(places, front)), 1), places.size - 1)
    return 2.0 * PASSED * float(places[k] - places[k - 1]) / float(places[k])


def refined_choice(
    mesh: Mesh | None,
    integrator: Integrator,
    impact: Impact,
    end_time: float | None,
    *,
    open_steps: bool,
    refine: float,
    shorter: float = 1.0,
) -> tuple[Mesh, Integrator]:
    """Mesh, chosen where none is given, and integrator, both ``refine`` times finer, steps ``shorter`` times more.

    open_steps : nobody asked for the integrator, so that its steps may be chosen, too.
    """
    laid = chosen_mesh(impact, end_time, explicit=integrator.explicit) if mesh is None else mesh
    laid, integrator = laid.refined(refine), integrator.refined(refine * shorter)
    return laid, chosen_steps(integrator, laid, impact, end_time) if open_steps else integrator


def reachable(x: Array, scaling: Scaling, centre: int) -> Indices:
    """Nodes that may touch: half as far again as the free motion would carry the beam into the wall, and all where
    waves from the ends may throw any of them at it."""
    impact = scaling.impact
    if impact.opposite_wall is not None or scaling.spin or lasts_until_waves_return(impact, scaling.end_time):
        return np.arange(x.size)
    times = np.linspace(0.05, 1.0, 20)[:, None]
    inside = (scaling.free_deflection(x[None, :], times) > 0.0).any(axis=0)
    place = np.abs(x - scaling.first_touch)
    reach = 1.5 * place[inside].max(initial=0.0)
    wide = place <= reach * (1.0 + 1e-9)  # a node right there belongs, whatever its round-off
    wide[max(0, centre - 20) : centre + 21] = True
    return np.flatnonzero(wide)
