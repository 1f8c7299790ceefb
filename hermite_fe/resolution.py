"""Mesh, steps and parts chosen from the problem, by scaling alone (of a whole impact: :mod:`hermite_fe.whole_beam`).

In units of the fast layer (l*, t*; :mod:`bent_beam.impact`), with κ for κ/ν: the undisturbed parabola would meet the
wall at ξ = √(2τ/κ), so that the front moves like λ̂√τ with λ̂ = √(2/κ) as a crude upper estimate. The beam bends ahead of
it over ℓ(τ) = 2√τ/λ̂: the front's speed λ̂/(2√τ) equals the wave number 1/ℓ of the waves that keep up with it. Elements
must be a fraction of ℓ where the front is, steps a fraction of its travel over ℓ. Nothing here knows λ₀ or r₀.

- mesh: elements in proportion to the distance, so that every decade of time is resolved alike; for a thin front
  (κ < ``THIN``) even ones over the zone that the run covers.
- steps: constant at first, then in proportion to the time since impact; for a thin front constant.
- **the first steps** of Signorini's scheme are so long that the front is three smallest elements thick after one of
  them. No mesh resolves the first instants: in short steps each node strikes the wall by itself and rebounds ("double
  detachment", thesis 3.3.5), a long step of implicit Euler closes them together (docs/numerics.md).
- integrator: Signorini at the new position, which leaves closed constraints exactly on the wall and does not rattle;
  Moreau–Jean when constraints rebound.
- contact: unilateral; nothing is held unless asked for, except in runs that measure what a pressing load changes.
- far field: viscosity at grid scale.
- a wall that gives way has scales of its own, ℓ_k and t_k (:mod:`bent_beam.loads`): the pressure falls off at
  the rim of the zone over some ℓ_k, and the force rises and falls over some t_k, whatever the zone does. A zone that is
  short when the force is largest, κ/ν > 1, has then a half length of about ℓ_k(κ/ν)^−⅜.

Most of the constants below are studied in tests/comparison/test_constants.py: halved and doubled they move λ₀ and r₀ by
at most 0.1 %. Those of an elastic wall, of a thin front and of the most elements are not.
"""

import dataclasses
import math
from dataclasses import dataclass
from typing import Annotated, Any, Self

import numpy as np

from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from bent_beam.impact import Impact
from bent_beam.loads import wall_scales
from bent_beam.meshes import GradedMesh, Mesh, ScaleFreeMesh, snapped
from hermite_fe.compiled import Array
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.far_fields import FarField, GridViscosity
from hermite_fe.integrators import Integrator, Midpoint, MoreauJean, SignoriniPosition
from hermite_fe.masses import ConsistentMass, Mass

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
MOST_ON_A_BEAM = 2_000  # likewise, where the front runs over all of the half beam, or before a wall that gives way
SHORTEST_THIN_STEP = 5e-4  # of the run
LOADED = (1.3e-3, 33.0, 0.005)  # SMALLEST_ELEMENT, ELEMENTS_IN_FRONT, GROWTH of runs that measure what a load changes
PRESSED_HOLD = 16  # constraints, of runs that measure what a load changes and presses the zone on
DOMAIN = 24.0  # √(t/t*) l*: least half length for such a run; 12 and 48 are as good, at 6 waves come back
ELASTIC_ELEMENT = 0.08  # of ℓ_k: elements over the zone
ELASTIC_REACH = 4.0  # ℓ_k beyond the front
ELASTIC_STEP = 0.01  # of t_k


@dataclass(frozen=True)
class Composition(Part):
    """What a run is made of; parts that are ``None`` are chosen for the problem."""

    mesh: Mesh | None = None
    integrator: Integrator | None = None
    contact: Contact | None = None
    far_field: FarField | None = None
    mass: Mass | None = None
    full_beam: Annotated[bool, Quantity("", "both halves instead of one with a symmetry support")] = False
    domain: Annotated[
        float | None,
        Quantity("m", "half length to model; cut ends follow the free motion", above=0.0, absent="all of it"),
    ] = None
    refine: Annotated[float, Quantity("", "refinement factor of elements; steps follow", above=0.0)] = 1.0

    def refined(self, factor: float) -> Self:
        """A copy with elements and steps ``factor`` times finer."""
        return dataclasses.replace(self, refine=self.refine * factor)


@dataclass(frozen=True)
class Choice:
    """All parts of a run; nodes : of the half beam, m."""

    mesh: Mesh
    nodes: Array
    integrator: Integrator
    contact: Contact
    far_field: FarField
    mass: Mass

    def parts(self) -> dict[str, Any]:
        """By the names that :class:`Composition` has for them."""
        parts = {name: getattr(self, name) for name in ("mesh", "integrator", "contact", "far_field", "mass")}
        return parts | ({"contact": None} if self.integrator.elastic else {})  # the wall's own springs


def choose(impact: Impact, end_time: float, parts: Composition | None = None) -> Choice:
    """The parts of a run to ``end_time``, s; what ``parts`` leaves open is chosen.

    Raises ``ValueError`` for parts that cannot work together, or where no mesh can be chosen.
    """
    parts = parts or Composition()
    half_length = modelled_half_length(impact, parts.domain)
    chosen = parts.mesh or chosen_mesh(impact, half_length, end_time)
    mesh = chosen.refined(parts.refine)
    try:
        fine, coarse = mesh.nodes(half_length), chosen.nodes(half_length)
    except ValueError as error:
        if parts.mesh is not None:
            raise
        raise InputError(
            f"curvature: no mesh can be chosen that resolves the contact front at kappa/nu = "
            f"{impact.kappa_over_nu:g} ({error}); give [mesh]"
        ) from None
    contact = parts.contact or NodeContact()
    if impact.wall_stiffness is not None and parts.contact is not None:
        raise InputError(
            f"contact has no effect on a wall with a stiffness: leave it out (got {type(contact).__name__})"
        )
    integrator = parts.integrator or scheme_for(impact, contact)
    # from the mesh before it is refined: then the first step is refined like all others
    integrator = chosen_integrator(impact, end_time, coarse, integrator).refined(parts.refine)
    if contact.held and not integrator.holds:
        name, value = next(iter(contact.held.items()))
        raise InputError(
            f"contact.{name} has no effect with this integrator, whose rows may always open (got {value!r})"
        )
    mass = parts.mass or ConsistentMass()
    if integrator.moves_mass and mass != ConsistentMass():
        raise InputError(
            f"hermite.mass has no effect with this integrator, which moves the mass of a node itself (got {mass!r})"
        )
    end = "free" if parts.domain is None else "following"
    far_field = parts.far_field or (
        GridViscosity(end=end) if integrator.damped else GridViscosity(end=end, viscosity=0.0)
    )
    if parts.domain is not None and far_field.end != "following":
        raise InputError(
            f'domain cuts the beam where it goes on: hermite.far_field.end must be "following" (got {far_field.end!r})'
        )
    return Choice(mesh, snapped(fine, impact.places), integrator, contact, far_field, mass)


def scheme_for(impact: Impact, contact: Contact, theta: float = 1.0) -> Integrator:
    """The integrator that is chosen; θ of those before a rigid wall."""
    if impact.wall_stiffness is not None:
        return Midpoint()
    at_velocity = contact.restitution > 0.0 or (contact.sticks and theta < 1.0)
    return MoreauJean(theta=theta) if at_velocity else SignoriniPosition(theta=theta)


def modelled_half_length(impact: Impact, domain: float | None) -> float:
    """Half length, m, of what is modelled; ``ValueError`` when ``domain`` is longer than the beam."""
    if domain is not None and domain > impact.half_length:
        raise InputError(f"domain must not exceed the half length {impact.half_length!r} of the beam (got {domain!r})")
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
    kappa, zone, wall = bounded_kappa(impact), min(ZONE * place, half), wall_scales(impact)
    if wall is not None:
        zone, short = min(ZONE * place + ELASTIC_REACH * wall.length, half), max(impact.kappa_over_nu, 1.0) ** -0.375
        element = min(max(ELASTIC_ELEMENT * short * wall.length, zone / MOST_ON_A_BEAM), 0.1 * half)
    elif kappa < THIN:
        most = MOST_ELEMENTS if zone < half else MOST_ON_A_BEAM
        element = max(thickness / ELEMENTS_IN_THIN_FRONT, zone / most)
    else:
        smallest, in_front, growth = LOADED if loaded else (SMALLEST_ELEMENT, ELEMENTS_IN_FRONT, GROWTH)
        return ScaleFreeMesh(
            element_length=min(smallest * thickness, 1e-3 * half),
            growth=1.0 + min(growth, kappa / in_front),
            **({} if zone == half else {"zone": zone, "growth_outside": 1.0 + GROWTH_OUTSIDE}),
        )
    return GradedMesh(element_length=element, growth=1.0 + GROWTH_OUTSIDE, zone=zone, size_ratio=1e6)


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
    return integrator.with_steps(step, growth).with_defaults(impact, end_time)


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
