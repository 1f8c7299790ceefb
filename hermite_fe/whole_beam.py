"""Mesh, steps and integrator of a whole beam, chosen by scaling alone, as in :mod:`hermite_fe.resolution`.

Until the beam has left the wall nothing may be absorbed, nothing held behind a front (a hold glues the zone
when waves come back), and every part of the beam matters alike. So

    a uniform mesh,   steps h = ½Δx²√(μ/EI),   Signorini's law alone,   the beam's own damping alone.

Signorini's condition at the new position with θ = ½, which damps nothing but in impacts, comes nearest to converged
values on a given mesh (docs/whole_impact.md); Moreau–Jean asks for the same at velocity level.

A beam with shear has waves of a largest speed: steps may be longer, in proportion to elements. Signorini's condition at
the new position with θ = ½ rebounds nodes by chance where the front of a zone outruns shear waves, and under loads;
Moreau–Jean does not. Of one point the position is nearer to converged values (docs/shear.md):

    h = T* Δx/(80 · ½L) and Moreau–Jean;   for κ/ν ≥ 2 or a stop, without a load that presses, Signorini's law.
"""

import math

from bent_beam.errors import InputError
from bent_beam.impact import BEFORE_WAVES_RETURN, Impact
from bent_beam.loads import wall_scales
from hermite_fe.contacts import Contact
from hermite_fe.integrators import Integrator, MoreauJean
from hermite_fe.resolution import (
    ELASTIC_STEP,
    ELEMENTS_IN_FRONT,
    LARGEST_STEP,
    LONGEST_FIRST_STEP,
    MOST_ON_A_BEAM,
    front,
    scheme_for,
)

FEWEST_IN_FRONT = 4.0  # with fewer even elements the early impulse of one point is off by more than 1 %
ELEMENTS = 200  # of a half beam that is followed until it has left
SHEARED_ELEMENTS, SHEARED_STEP = 100, 0.0125  # likewise with shear; step, T*, over the element's share of the half beam
HARD = 2.0  # times as many elements: with shear where κ/ν < THICK or η/T* < DAMPED; in first instants of felt damping
THICK, DAMPED = 0.35, 3e-4
ONE_POINT = 2.0  # κ/ν from which on a whole impact is that of one point, with shear, too
LARGEST_ELASTIC = 0.25  # of ℓ_k: the longest element before a wall that gives way
PRESSED = 0.5  # of the beam's momentum: loads that give it more in a T* count as pressing


def begins(impact: Impact, end_time: float) -> bool:
    """Whether a run to ``end_time``, s, is about the front that spreads from the first touch on a rigid wall, before
    waves change its impulse."""
    begin, end = impact.wall_span
    zone = impact.relative_curvature > 0.0 and begin < impact.first_touch < end and impact.wall_stiffness is None
    return zone and end_time <= BEFORE_WAVES_RETURN * impact.slow_time_scale


def damping_is_felt(impact: Impact, element: float) -> bool:
    """Whether elements of this length, m, resolve how far damping lets bending run, √(cη): the bow then lifts by
    itself. A beam with shear is not asked."""
    return impact.shear_stiffness is None and impact.wave_constant * impact.damping >= element**2


def scheme(impact: Impact, contact: Contact, element: float, end_time: float | None) -> Integrator:
    """The integrator that is chosen for a whole beam on elements of this length, m.

    A run that only :func:`begins` takes a dissipative scheme: it removes the rebound of the unresolved start. Where
    damping is felt, that start is resolved, and the scheme is that of a whole impact.
    """
    begin, end = impact.wall_span
    if end_time is not None and begins(impact, end_time) and not damping_is_felt(impact, element):
        return scheme_for(impact, contact).with_steps(LONGEST_FIRST_STEP * end_time, LARGEST_STEP)
    pressed = impact.net_load * impact.slow_time_scale > PRESSED * impact.mass_per_length * impact.velocity
    point = (impact.kappa_over_nu >= ONE_POINT or begin == end) and not pressed
    if impact.shear_stiffness is not None and impact.wall_stiffness is None and not point:
        return MoreauJean(theta=0.5)
    return scheme_for(impact, contact, theta=0.5)


def element(impact: Impact, end_time: float | None) -> float:
    """Length, m, of even elements of a beam that is followed until it has left, or to ``end_time``, s.

    Raises ``ValueError`` for an end that would take too many.
    """
    elements = float(ELEMENTS)
    if impact.shear_stiffness is not None:
        easy = impact.kappa_over_nu >= THICK and impact.relative_damping >= DAMPED
        elements = SHEARED_ELEMENTS if easy else HARD * SHEARED_ELEMENTS
    if end_time is not None and begins(impact, end_time):
        in_half = impact.half_length / front(impact, end_time)[1]
        if FEWEST_IN_FRONT * in_half > MOST_ON_A_BEAM:
            earliest = end_time * (FEWEST_IN_FRONT * in_half / MOST_ON_A_BEAM) ** 2
            raise InputError(
                f"end_time: before {earliest:.3g} s the contact is shorter than even elements resolve (got "
                f"{end_time!r}); only a free beam that touches one long wall at its middle gets a graded mesh: give "
                "[mesh], or a shorter beam.length"
            )
        elements = max(elements, ELEMENTS_IN_FRONT * in_half)
        if damping_is_felt(impact, impact.half_length / elements):
            elements *= HARD  # the moment of a bow that lifts by itself needs them
        elements = min(elements, MOST_ON_A_BEAM)
    wall = wall_scales(impact)
    longest = math.inf if wall is None else max(LARGEST_ELASTIC * wall.length, impact.half_length / MOST_ON_A_BEAM)
    return min(impact.half_length / elements, longest)


def step(impact: Impact, element: float) -> float:
    """Step, s, on such elements of this length, m."""
    if (wall := wall_scales(impact)) is not None:
        return ELASTIC_STEP * min(wall.time, impact.slow_time_scale)
    if impact.shear_stiffness is None:
        return 0.5 * element**2 / impact.wave_constant
    return SHEARED_STEP * element / impact.half_length * impact.slow_time_scale
