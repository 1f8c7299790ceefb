"""Mesh, length, steps and contact points that are chosen by scaling arguments, when none are given (docs/exudyn.md).

In the first spread of the zone elements grow with the distance from the middle, steps with time. Before a thin front
all elements that it may reach are equal. A run that lasts until waves are back from the ends needs elements of one
length, and steps that resolve the contact, h = ½Δx²√(μ/EI). A step's impulse is about half of the force at its start
and half of that at its end: in a step much longer than the penalty's own time the latter stops a node that lands, then
counts again in the next step, and the beam leaves with more energy than it had.
"""

import dataclasses
import math

import numpy as np

from bent_beam import Impact
from bent_beam.impact import BEFORE_WAVES_RETURN
from bent_beam.loads import wall_scales
from bent_beam.meshes import Mesh, NodesMesh, ScaleFreeMesh
from exudyn_models.geometry import Array, Indices, Scaling, supports_or_plate
from exudyn_models.integrators import Implicit

GROWTH = 0.01  # of elements, one to the next: 5 lie over the front's bending length at κ/ν = 0.05, 20 at 0.2
THIN = 0.12  # κ/ν below which node hits at the front of that mesh lift the zone: at 0.07 λ₁ would be 23 % off by it
WAVES, GROWTH_OF_WAVES = 2.0, 0.02  # times the front's bound: beyond are waves alone, and elements grow by so much
OF_ZONE, OF_BENDING = 300.0, 30.0  # smallest elements in the front's bound, in the bending length ahead of it, …
OF_SHORT_ZONE, SHORTEST = 60.0, 0.01  # … in a short zone: the bound times 1 − κ/ν, or times SHORTEST if larger
OF_SHORT_ZONE_EXPLICIT, SHORTEST_EXPLICIT = 3.0, 0.07  # likewise; λ₀ is 12 % off at κ/ν = 0.93 with 1.8 elements
OF_THIN_FRONT = 3.0  # equal elements: over the bending length of a thin front at the end of the run, …
LEAST_OF_ZONE, MOST_OF_ZONE = 300.0, 800.0  # … but up to the front's bound so many at least, and at most
BEYOND_THIN_FRONT = 1.1  # times the front's bound, where these end
PASSED = 2.0  # elements that a thin front passes in a step
REACH, REACH_OF_FRONT = 12.0, 8.0  # half length to model, see far_field; tests/comparison/test_constants.py
LONGEST_BENT = 2e3  # Λ of a half beam whose ends an axial force bends
BEFORE_BENT_END = 0.6  # of where a bent-up end would itself be at the wall: beyond, nothing touches
ELEMENT_STEPS = 4e5  # elements times steps of a run with uniform elements: a few seconds
FEWEST = 60  # uniform elements of a half beam, from 0.9 T* on; tests/comparison/test_constants.py
STEP = 0.5  # h/(Δx²√(μ/EI)) that resolves the contact
OF_WALL = 0.08  # ℓ_k: elements before a wall that gives way, …
BEYOND_WALL = 4.0  # … up to so far beyond the front's bound
STEP_OF_WALL, LONGEST_OF_WALL = 0.125, 0.02  # h/t_k over Δx/ℓ_k, and at most
MOST_STEPS = 200_000  # that an open time step may ask for


def far_field(scaling: Scaling) -> float:
    """Half length to model, in units of Λ, when the beam is longer: what the end would send back stays out of the
    picture.

    Waves of the front's length 2/λ₀ travel ~ 2λ₀ by the end and longer ones less; beyond 12 the kernel H has decayed.
    """
    return REACH + REACH_OF_FRONT * math.sqrt(2.0 / max(scaling.kappa, 2e-3))


def chosen_half_length(impact: Impact, end_time: float | None = None) -> float:
    """The half length, m, modelled when no mesh is given: the beam's, or less where nothing returns in time. An axial
    force along x bends the ends of a bow, a force at a point may act anywhere: the beam is then modelled as long as it
    is, up to :data:`LONGEST_BENT`."""
    scaling = Scaling(impact, impact.checked_end_time(end_time))
    bent = bool(impact.axial_force) and impact.tension_direction == "axis"
    if (bent or impact.forces) and impact.half_length <= LONGEST_BENT * scaling.length:
        return impact.half_length
    return min(impact.half_length, far_field(scaling) * scaling.length)


def chosen_mesh(impact: Impact, end_time: float | None = None, *, explicit: bool = False) -> NodesMesh:
    """The mesh that ``simulate`` lays when none is given (half beam), to lay the same under several impacts."""
    scaling, wall = Scaling(impact, impact.checked_end_time(end_time)), wall_scales(impact)
    if lasts_until_waves_return(impact, scaling.end_time) and wall is None:
        steps_at_one = 2.0 * scaling.end_time / impact.slow_time_scale  # with one element
        count = max((ELEMENT_STEPS / steps_at_one) ** (1.0 / 3.0), FEWEST) * near_buckling(impact)
        return NodesMesh(tuple(np.linspace(0.0, impact.half_length, max(2, round(count)) + 1).tolist()))
    front = scaling.front
    if wall is not None:
        ratio = wall.length / scaling.length
        element = OF_WALL * min(1.0, scaling.kappa**-0.375) * ratio
        growth, zone = 0.0, front + BEYOND_WALL * ratio
    elif explicit:
        element, growth, zone = min(max(front, 0.5) / 25, (2.0 / front) / 10), GROWTH_OF_WAVES, None
        if scaling.kappa < 1.0:
            element = min(element, front * max(1.0 - scaling.kappa, SHORTEST_EXPLICIT) / OF_SHORT_ZONE_EXPLICIT)
    elif scaling.kappa < THIN:
        count = min(max(OF_THIN_FRONT * front**2 / 2.0, LEAST_OF_ZONE), MOST_OF_ZONE)
        element, growth, zone = front / count, 0.0, BEYOND_THIN_FRONT * front
    else:
        element, growth, zone = min(front / OF_ZONE, (2.0 / front) / OF_BENDING), GROWTH, WAVES * front
        if scaling.kappa < 1.0:
            element = min(element, front * max(1.0 - scaling.kappa, SHORTEST) / OF_SHORT_ZONE)
    outside = {} if zone is None else {"zone": zone * scaling.length, "growth_outside": 1.0 + GROWTH_OF_WAVES}
    rule = ScaleFreeMesh(element * scaling.length, 1.0 + growth, **outside)
    return NodesMesh(tuple(rule.nodes(chosen_half_length(impact, end_time)).tolist()))


def modelled_half_length(mesh: Mesh, impact: Impact) -> float:
    """The half length, m, that a mesh is laid over: the beam's, or less where its nodes are given."""
    if isinstance(mesh, NodesMesh) and mesh.places[-1] <= impact.half_length * (1.0 + 1e-9):
        return mesh.places[-1]
    return impact.half_length


def lasts_until_waves_return(impact: Impact, end: float) -> bool:
    """Whether waves from the ends of the beam are back before the end time, s."""
    return end > BEFORE_WAVES_RETURN * impact.slow_time_scale and chosen_half_length(impact, end) == impact.half_length


def near_buckling(impact: Impact) -> float:
    """(1 − |N|/N_cr)^{−1/2} under compression, at most 1.5: the beam bends 1/(1 − |N|/N_cr) times as far, and what
    elements miss, ~ Δx², counts as much more. At 0.73 N_cr and κ/ν = 2 J is 0.35 % off with 50 elements, 0.1 % with
    100."""
    return min(max(1.0 + impact.axial_force / impact.buckling_load, 1.5**-2), 1.0) ** -0.5


def shortest_element(mesh: Mesh, impact: Impact) -> float:
    """Length of the shortest element, m."""
    return float(np.diff(mesh.nodes(modelled_half_length(mesh, impact))).min())


def resolving_step(mesh: Mesh, impact: Impact) -> float:
    """The time step, s, that resolves the contact of the shortest element: half of the time in which a bending wave
    passes it, ½Δx²√(μ/EI), or a shear wave where it is shorter than l_s; a share of t_k before a soft wall."""
    length, wall = shortest_element(mesh, impact), wall_scales(impact)
    if wall is not None:
        return min(STEP_OF_WALL * length / wall.length, LONGEST_OF_WALL) * wall.time
    return STEP * length * max(length, impact.shear_length) / impact.wave_constant


def chosen_steps(integrator: Implicit, factor: float, mesh: Mesh, impact: Impact, end: float) -> Implicit:
    """``integrator``, whose steps are open, with the steps of this run.

    Until waves are back from the ends: its own relative step over ``factor``, in which a thin front passes ``PASSED``
    elements at most. Later, and before a soft wall: :func:`resolving_step`. If that took more than ``MOST_STEPS``
    later, the relative step stays, and a contact that gives energy is told.
    """
    returned, step = lasts_until_waves_return(impact, end), resolving_step(mesh, impact)
    if impact.wall_stiffness is not None or (returned and end <= MOST_STEPS * step):
        return dataclasses.replace(integrator, time_step=step)
    relative = integrator.default_step / factor
    if impact.kappa_over_nu < THIN and not returned:
        # the front, x ~ √t, in the last step
        scaling, places = Scaling(impact, end), mesh.nodes(modelled_half_length(mesh, impact))
        k = min(max(int(np.searchsorted(places, scaling.front * scaling.length)), 1), places.size - 1)
        relative = min(relative, 2.0 * PASSED * float(places[k] - places[k - 1]) / float(places[k]))
    return dataclasses.replace(integrator, relative_step=relative)


def reachable(x: Array, scaling: Scaling, centre: int) -> Indices:
    """Nodes that may touch: half as far again as the free motion would carry the beam into the wall. All of them
    between two walls, of a beam that rocks, is pushed at a point or has a held end, before a plate or a stop, and once
    waves are back.

    An upward bent end (ψ > 0) would bring the far field to the wall, by a growing velocity (χ > 0) the sooner: it is
    let through."""
    impact = scaling.impact
    any_may = impact.opposite_wall is not None or impact.rotation or impact.forces or supports_or_plate(impact)
    if any_may or lasts_until_waves_return(impact, scaling.end_time):
        return np.arange(x.size)
    times = np.linspace(0.05, 1.0, 20)[:, None]
    inside = (scaling.motion(x[None, :] - scaling.first_touch, times) > 0.0).any(axis=0)
    place = np.abs(x - scaling.first_touch)
    chi, psi = scaling.motion.terms[2, 1], scaling.motion.terms[4, 0]
    spread = scaling.kappa - max(chi, 0.0)
    let = BEFORE_BENT_END * math.sqrt(12.0 * spread / psi) if psi > 0.0 and spread > 0.0 else math.inf
    reach = min(1.5 * place[inside & (place < let)].max(initial=0.0), let)
    wide = place <= reach * (1.0 + 1e-9)  # a node right there belongs, whatever its round-off
    wide[max(0, centre - 20) : centre + 21] = True
    return np.flatnonzero(wide)
