"""The one place where mesh, steps and parts are chosen from the problem, by scaling alone.

In units of the fast layer (l*, t*; :mod:`bent_beam.impact`), with κ for κ/ν: the undisturbed parabola would meet the
wall at ξ = √(2τ/κ), so that the front moves like λ̂√τ with λ̂ = √(2/κ) as a crude upper estimate. The beam bends ahead of
it over ℓ(τ) = 2√τ/λ̂: the front's speed λ̂/(2√τ) equals the wave number 1/ℓ of the waves that keep up with it. Elements
must be a fraction of ℓ where the front is, steps a fraction of its travel over ℓ. Nothing here knows λ₀ or r₀.

- mesh: elements in proportion to the distance, so that every decade of time is resolved alike; for a thin front
  (κ < ``THIN``) even ones over the zone that the run covers.
- steps: constant at first, then in proportion to the time since impact; for a thin front constant.
- **the first steps** of Signorini's scheme are so long that the front is three smallest elements thick after one of
  them. No mesh resolves the first instants. With short steps each node strikes the wall separately and rebounds, and
  the gaps remain ("double detachment", thesis 3.3.5). A long step of implicit Euler closes those nodes together.
  At κ = 0.1 r₀ is 0.48 % too large after short first steps, and the zone lifts by 0.026 V₀t; after long ones the
  figures are 0.015 % and 0.0007 V₀t.
- integrator: Signorini at the new position, which leaves closed constraints exactly on the wall and does not rattle;
  Moreau–Jean when constraints rebound.
- contact: unilateral; nothing is held unless asked for, except in runs that measure what a pressing load changes.
- far field: viscosity at grid scale.
- a wall that gives way has scales of its own: :mod:`hermite_fe.elastic_resolution`.

The whole beam, until it has left the wall, asks for something else: nothing may be absorbed, nothing held behind a
front (a hold glues the zone when waves come back), and every part of the beam matters alike. So

    a uniform mesh,   steps h = ½Δx²√(μ/EI),   Signorini's law alone,   the beam's own damping alone.

Signorini's condition at the new position with θ = ½, which damps nothing but in impacts, comes nearest to converged
values on a given mesh (docs/whole_impact.md); Moreau–Jean asks for the same at velocity level.

The constants below are studied in tests/hermite_fe/test_constants.py: halved and doubled they move λ₀ and r₀ by less
than the error bar that goes with them.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from bent_beam.impact import Impact
from bent_beam.loads import wall_scales
from bent_beam.meshes import GradedMesh, Mesh, ScaleFreeMesh, UniformMesh, snapped
from hermite_fe.composition import Composition
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.elastic_resolution import ELASTIC_STEP, elastic_mesh, even_element
from hermite_fe.far_fields import FarField, GridViscosity
from hermite_fe.integrators import Integrator, Midpoint, MoreauJean, SignoriniPosition
from hermite_fe.masses import ConsistentMass, Mass

__all__ = ["ELEMENTS", "Choice", "choose", "cross_checks", "for_loads", "for_whole_beam", "front", "varied"]

Array = NDArray[np.float64]
C = TypeVar("C", bound=Composition)

THIN = 0.005  # κ/ν below which scale-free elements all the way would be too many
ZONE = 1.2  # of the front's place at the end: elements are fine up to there
SMALLEST_ELEMENT = 4e-3  # of ℓ at the end of the run, at the centre
ELEMENTS_IN_FRONT = 14.0  # in ℓ at any time
GROWTH = 0.01  # of elements, at most
GROWTH_OUTSIDE = 0.015
LARGEST_STEP = 1e-3  # of the time since impact
LONGEST_FIRST_STEP = 2e-3  # of the run
ELEMENTS_IN_THIN_FRONT = 12.0  # in ℓ at the end, for κ/ν < THIN
MOST_ELEMENTS = 25_000  # over the zone, for κ/ν < THIN
MOST_ON_A_BEAM = 2_000  # likewise, where the front runs over all of the half beam before the run ends
SHORTEST_THIN_STEP = 5e-4  # of the run
LOADED = (1.3e-3, 33.0, 0.005)  # SMALLEST_ELEMENT, ELEMENTS_IN_FRONT, GROWTH of runs that measure what a load changes
PRESSED_HOLD = 16  # constraints, of runs that measure what a load changes and presses the zone on
DOMAIN = 24.0  # √(t/t*) l*: least half length for such a run; 12 and 48 are as good, at 6 waves come back
ELEMENTS = 200  # of a half beam that is followed until it has left


@dataclass(frozen=True)
class Choice:
    """All parts of a run; nodes : of the half beam, m."""

    mesh: Mesh
    nodes: Array
    integrator: Integrator
    contact: Contact
    far_field: FarField
    mass: Mass


def choose(impact: Impact, end_time: float, parts: Composition | None = None) -> Choice:
    """The parts of a run to ``end_time``, s; what ``parts`` leaves open is chosen.

    Raises ``ValueError`` for parts that cannot work together, or where no mesh can be chosen.
    """
    parts = parts or Composition()
    half_length = modelled_half_length(impact, parts.domain)
    mesh, coarse = _mesh(impact, half_length, end_time, parts)
    contact = parts.contact or NodeContact()
    if impact.wall_stiffness is not None and parts.contact is not None:
        raise ValueError(
            f"contact has no effect on a wall with a stiffness: leave it out (got {type(contact).__name__})"
        )
    integrator = parts.integrator or scheme_for(impact, contact)
    # from the mesh before it is refined: then the first step is refined like all others
    integrator = chosen_integrator(impact, end_time, coarse, integrator).refined(parts.refine)
    for name in () if integrator.holds else ("hold", "hold_until"):
        if getattr(contact, name):
            raise ValueError(
                f"contact.{name} has no effect with this integrator, whose rows may always open "
                f"(got {getattr(contact, name)!r})"
            )
    far_field = parts.far_field or GridViscosity(end="free" if parts.domain is None else "following")
    if parts.domain is not None and far_field.end != "following":
        raise ValueError(
            f'domain cuts the beam where it goes on: far_field.end must be "following" (got {far_field.end!r})'
        )
    nodes = snapped(mesh.nodes(half_length), impact.wall_span)
    return Choice(mesh, nodes, integrator, contact, far_field, parts.mass or ConsistentMass())


def scheme_for(impact: Impact, contact: Contact, theta: float = 1.0) -> Integrator:
    """The integrator that is chosen; θ of those before a rigid wall."""
    if impact.wall_stiffness is not None:
        return Midpoint()
    return SignoriniPosition(theta=theta) if contact.restitution == 0.0 else MoreauJean(theta=theta)


def modelled_half_length(impact: Impact, domain: float | None) -> float:
    """Half length, m, of what is modelled; ``ValueError`` when ``domain`` is longer than the beam."""
    if domain is not None and domain > impact.half_length:
        raise ValueError(f"domain must not exceed the half length {impact.half_length!r} of the beam (got {domain!r})")
    return impact.half_length if domain is None else domain


def bounded_kappa(impact: Impact) -> float:
    """κ/ν, kept off 0 and not above 1, where the contact stays a point."""
    return min(max(impact.kappa_over_nu, 1e-9), 1.0)


def front(impact: Impact, time: float) -> tuple[float, float]:
    """Crude estimates of the front's place and thickness at ``time``, m, by scaling."""
    spread = math.sqrt(time / impact.time_scale) * impact.length_scale
    speed, wall = math.sqrt(2.0 / bounded_kappa(impact)), wall_scales(impact)
    return speed * spread, max(2.0 * spread / speed, 0.0 if wall is None else wall.length)


def chosen_mesh(impact: Impact, half: float, end_time: float, *, loaded: bool = False) -> Mesh:
    """Scale-free elements; for a thin front even ones over the zone. ``loaded``: to measure what a load changes."""
    place, thickness = front(impact, end_time)
    kappa, zone = bounded_kappa(impact), min(ZONE * place, half)
    wall = wall_scales(impact)
    if wall is not None:
        return elastic_mesh(impact, wall, half, ZONE * place)
    if kappa < THIN:
        most = MOST_ELEMENTS if zone < half else MOST_ON_A_BEAM
        element = max(thickness / ELEMENTS_IN_THIN_FRONT, zone / most)
        return GradedMesh(element_length=element, growth=1.0 + GROWTH_OUTSIDE, zone=zone, size_ratio=1e6)
    smallest, in_front, growth = LOADED if loaded else (SMALLEST_ELEMENT, ELEMENTS_IN_FRONT, GROWTH)
    return ScaleFreeMesh(
        element_length=min(smallest * thickness, 1e-3 * half),
        growth=1.0 + min(growth, kappa / in_front),
        **({} if zone == half else {"zone": zone, "growth_outside": 1.0 + GROWTH_OUTSIDE}),
    )


def _mesh(impact: Impact, half_length: float, end_time: float, parts: Composition) -> tuple[Mesh, Array]:
    """The mesh, and its nodes (m) before it is refined."""
    chosen = parts.mesh or chosen_mesh(impact, half_length, end_time)
    mesh = chosen.refined(parts.refine)
    try:
        mesh.nodes(half_length)
        return mesh, chosen.nodes(half_length)
    except ValueError as error:
        if parts.mesh is not None:
            raise
        raise ValueError(
            f"curvature: no mesh can be chosen that resolves the contact front at kappa/nu = "
            f"{impact.kappa_over_nu:g} ({error}); give [mesh]"
        ) from None


def chosen_integrator(impact: Impact, end_time: float, nodes: Array, integrator: Integrator) -> Integrator:
    """``integrator`` with what it leaves open filled in."""
    kappa, wall = bounded_kappa(impact), wall_scales(impact)
    if wall is not None:
        step, growth = min(ELASTIC_STEP * wall.time, LONGEST_FIRST_STEP * end_time), LARGEST_STEP
    elif kappa < THIN:
        step, growth = end_time * max(min(LARGEST_STEP, kappa), SHORTEST_THIN_STEP), 0.0
    else:
        # when the front is as thick as the smallest element
        resolved = impact.time_scale * (float(np.diff(nodes).min()) / front(impact, impact.time_scale)[1]) ** 2
        first = integrator.elements_in_first_front**2 * resolved
        step = min(max(first, 1e-10 * end_time), LONGEST_FIRST_STEP * end_time)
        growth = LARGEST_STEP
    return integrator.with_steps(step, growth).with_defaults(impact)


def for_loads(parts: C, impact: Impact, end_time: float) -> C:
    """A copy of ``parts`` for a run that measures what the loads of ``impact`` change.

    A long beam is cut where nothing arrives, its ends following the free motion, and a zone that the load presses on is
    held behind the front: what lift the bare impact leaves would otherwise take up the load before the wall does.
    Neither without loads.
    """
    if not impact.loaded or impact.wall_stiffness is not None:
        return parts
    contact, domain, mesh = parts.contact, parts.domain, parts.mesh
    if domain is None and parts.far_field is None:
        domain = chosen_domain(impact, end_time)
    if contact is None and impact.zone_pressure > 0.0 and (parts.integrator is None or parts.integrator.holds_zone):
        contact = NodeContact(hold=PRESSED_HOLD)
    if mesh is None:
        mesh = chosen_mesh(impact, modelled_half_length(impact, domain), end_time, loaded=True)
    return dataclasses.replace(parts, mesh=mesh, contact=contact, domain=domain)


def chosen_domain(impact: Impact, end_time: float) -> float | None:
    """Half length, m, of a long beam that a run which measures what a load changes needs; ``None``: all of it.

    The free motion y₀ is a Taylor polynomial: where its quartic term meets the wall by itself the beam is cut.
    """
    reach = DOMAIN * math.sqrt(end_time / impact.time_scale) * impact.length_scale
    if reach > 0.2 * impact.half_length:
        return None
    if impact.fourth_derivative > 0.0:
        reach = min(reach, 0.8 * math.sqrt(12.0 * impact.relative_curvature / impact.fourth_derivative))
    return reach


def for_whole_beam(parts: C, impact: Impact) -> C:
    """A copy of ``parts`` whose open ones are those of a whole beam; its ``refine`` is worked in."""
    wall, element = wall_scales(impact), impact.half_length / ELEMENTS
    if wall is not None:
        element = min(element, even_element(wall, impact.half_length))
    mesh = (parts.mesh or UniformMesh(element)).refined(parts.refine)
    shortest = float(np.diff(mesh.nodes(impact.half_length)).min())
    contact = parts.contact or NodeContact()
    chosen = scheme_for(impact, contact, theta=0.5)
    integrator = (parts.integrator or chosen).with_defaults(impact)  # before it is refined: what is open cannot be
    if integrator.time_step is None and wall is not None:
        integrator = integrator.with_steps(ELASTIC_STEP * wall.time, 0.0).refined(parts.refine)
    elif integrator.time_step is None:
        integrator = integrator.refined(parts.refine**2).with_steps(0.5 * shortest**2 / impact.wave_constant, 0.0)
    else:
        integrator = integrator.with_steps(integrator.time_step, 0.0).refined(parts.refine)
    return dataclasses.replace(
        parts,
        mesh=mesh,
        integrator=integrator,
        contact=contact if wall is None else parts.contact,
        far_field=parts.far_field or GridViscosity(viscosity=0.0),
        full_beam=parts.full_beam or impact.off_centre,
        domain=None,
        refine=1.0,
    )


def cross_checks(parts: C, impact: Impact) -> dict[str, C]:
    """What stands beside ``parts`` for error bars, by cause: half as many elements (and steps in proportion to their
    square), steps twice as long, and the impact law of another scheme, with these steps too (half of the work; the bar
    then counts the step twice)."""
    chosen = for_whole_beam(parts, impact)
    mesh, integrator = chosen.mesh, chosen.integrator
    assert mesh is not None and integrator is not None
    coarser = dataclasses.replace(chosen, mesh=mesh.refined(0.5), integrator=integrator.refined(0.25))
    longer = dataclasses.replace(chosen, integrator=integrator.refined(0.5))
    if integrator.elastic:
        return {"mesh": coarser, "step": longer}
    assert chosen.contact is not None
    step = integrator.time_step
    other = (
        SignoriniPosition(theta=0.5, time_step=step, growth=0.0)
        if isinstance(integrator, MoreauJean) and chosen.contact.restitution == 0.0
        else MoreauJean(theta=0.5, time_step=step, growth=0.0)
    )
    return {
        "mesh": coarser,
        "step": longer,
        "contact_law": dataclasses.replace(chosen, integrator=other.refined(0.5)),
    }


def varied(parts: C, impact: Impact, random: np.random.Generator) -> C:
    """A copy for an ensemble: elements, steps and impact law drawn at random.

    Moreau–Jean with θ = ½ throughout, which keeps the energy between impacts; where the wall gives way, what is chosen
    for it.
    """
    if impact.wall_stiffness is not None:
        return for_whole_beam(parts.refined(2.0 ** random.uniform(-1.0, 0.0)), impact)
    elements = int(random.integers(2 * ELEMENTS // 5, 4 * ELEMENTS // 5))
    length = impact.half_length / elements
    step = 2.0 ** random.uniform(-1.0, 1.0) * length**2 / impact.wave_constant
    restitution = (0.0, 0.5, 1.0)[int(random.integers(3))]
    return dataclasses.replace(
        parts,
        mesh=UniformMesh(length),
        integrator=MoreauJean(theta=0.5, time_step=step, growth=0.0),
        contact=NodeContact(restitution=restitution),
    )
