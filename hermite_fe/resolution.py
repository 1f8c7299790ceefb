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

The constants below are studied in tests/hermite_fe/test_constants.py: halved and doubled they move λ₀ and r₀ by less
than the error bar that goes with them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.impact import Impact
from bent_beam.meshes import GradedMesh, Mesh, ScaleFreeMesh
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.far_fields import FarField, GridViscosity
from hermite_fe.integrators import Integrator, MoreauJean, SignoriniPosition
from hermite_fe.masses import ConsistentMass, Mass

__all__ = ["Choice", "choose", "chosen_domain", "chosen_mesh", "front"]

Array = NDArray[np.float64]

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
ELEMENTS_PER_FRONT = 2.0  # fewer in ℓ deserve a warning
LOADED = (1.3e-3, 33.0, 0.005)  # SMALLEST_ELEMENT, ELEMENTS_IN_FRONT, GROWTH of runs that measure what a load changes
PRESSED_HOLD = 16  # constraints, of runs that measure what a load changes and presses the zone on
DOMAIN = 24.0  # √(t/t*) l*: least half length for such a run; 12 and 48 are as good, at 6 waves come back


@dataclass(frozen=True)
class Choice:
    """All parts of a run, and what to warn of."""

    mesh: Mesh
    nodes: Array
    integrator: Integrator
    contact: Contact
    far_field: FarField
    mass: Mass
    warnings: tuple[str, ...]


def bounded_kappa(impact: Impact) -> float:
    """κ/ν, kept off 0 and not above 1, where the contact stays a point."""
    return min(max(impact.kappa_over_nu, 1e-9), 1.0)


def front(impact: Impact, time: float) -> tuple[float, float]:
    """Crude estimates of the front's place and thickness at ``time``, m, by scaling."""
    spread = math.sqrt(time / impact.time_scale) * impact.length_scale
    speed = math.sqrt(2.0 / bounded_kappa(impact))
    return speed * spread, 2.0 * spread / speed


def chosen_mesh(impact: Impact, end_time: float, *, loaded: bool = False) -> Mesh:
    """Scale-free elements; for a thin front even ones over the zone. ``loaded``: to measure what a load changes."""
    place, thickness = front(impact, end_time)
    kappa, half = bounded_kappa(impact), impact.half_length
    zone = min(ZONE * place, half)
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


def chosen_integrator(impact: Impact, end_time: float, nodes: Array, integrator: Integrator) -> Integrator:
    """``integrator`` with what it leaves open filled in."""
    kappa = bounded_kappa(impact)
    if kappa < THIN:
        step, growth = end_time * max(min(LARGEST_STEP, kappa), SHORTEST_THIN_STEP), 0.0
    else:
        first = integrator.elements_in_first_front**2 * resolved_time(impact, nodes)
        step = min(max(first, 1e-10 * end_time), LONGEST_FIRST_STEP * end_time)
        growth = LARGEST_STEP
    return integrator.with_steps(step, growth).with_defaults(impact)


def chosen_contact(contact: Contact, integrator: Integrator) -> Contact:
    """``contact`` with what it leaves open filled in; ``ValueError`` for a hold that the integrator does not know."""
    if not integrator.holds:
        for name in ("hold", "hold_until"):
            if getattr(contact, name):
                raise ValueError(
                    f"contact.{name} has no effect with this integrator, whose rows may always open "
                    f"(got {getattr(contact, name)!r})"
                )
    return contact.with_hold(0, 0.0)


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


def resolved_time(impact: Impact, nodes: Array) -> float:
    """When the front is as thick as the smallest element, s."""
    _, thickness = front(impact, impact.time_scale)
    return impact.time_scale * (float(np.diff(nodes).min()) / thickness) ** 2


def choose(
    impact: Impact,
    end_time: float,
    mesh: Mesh | None,
    integrator: Integrator | None,
    contact: Contact | None,
    far_field: FarField | None,
    mass: Mass | None = None,
    *,
    refine: float = 1.0,
) -> Choice:
    """Fill in what was left open, and warn where what was given by hand cannot resolve the front.

    refine : elements and steps so many times finer than given or chosen.
    """
    given = mesh is not None
    chosen = mesh if mesh is not None else chosen_mesh(impact, end_time)
    mesh = chosen.refined(refine)
    try:
        coarse, nodes = chosen.nodes(impact.half_length), mesh.nodes(impact.half_length)
    except ValueError as error:
        if given:
            raise
        raise ValueError(
            f"curvature: no mesh can be chosen that resolves the contact front at kappa/nu = "
            f"{impact.kappa_over_nu:g} ({error}); give [mesh]"
        ) from None
    if contact is None:
        contact = NodeContact()
    if integrator is None:
        integrator = SignoriniPosition() if contact.restitution == 0.0 else MoreauJean()
    # from the mesh before it is refined: then the first step is refined like all others
    integrator = chosen_integrator(impact, end_time, coarse, integrator).refined(refine)
    contact = chosen_contact(contact, integrator)
    if far_field is None:
        far_field = GridViscosity()
    warnings = [
        *resolution_warnings(impact, end_time, nodes, integrator),
        *end_warnings(impact, end_time, nodes, far_field),
    ]
    return Choice(mesh, nodes, integrator, contact, far_field, mass or ConsistentMass(), tuple(warnings))


def resolution_warnings(impact: Impact, end_time: float, nodes: Array, integrator: Integrator) -> list[str]:
    """What the mesh and the steps cannot resolve of the front at the end of the run, and by how much."""
    out: list[str] = []
    if impact.kappa_over_nu >= 1.0 or impact.kappa_over_nu == 0.0:  # a point, or all of the beam at once: no front
        return out
    place, thickness = front(impact, end_time)
    element = float(
        np.diff(nodes)[min(int(np.searchsorted(nodes, min(place, nodes[-1]))), nodes.size - 1) - 1]
    )
    if thickness < ELEMENTS_PER_FRONT * element:
        short = ELEMENTS_PER_FRONT * element / thickness
        out.append(
            "the mesh cannot resolve the contact front: about "
            f"{thickness:.3g} m thick at the end of the run, it spans {thickness / element:.2g} elements "
            f"({element:.3g} m there); {ELEMENTS_PER_FRONT:g} are the least, "
            f"elements {short:.2g} times shorter"
        )
    step = max(integrator.time_step or 0.0, (integrator.growth or 0.0) * end_time)
    travel, room = place * 0.5 * step / end_time, 0.5 * max(thickness, element)
    if travel > room:
        out.append(
            f"the time steps cannot resolve the contact front: it runs about {travel:.3g} m in the last one; "
            f"{room:.3g} m (half its thickness or half an element) is the most, "
            f"steps {travel / room:.2g} times shorter"
        )
    return out


def end_warnings(impact: Impact, end_time: float, nodes: Array, far_field: FarField) -> list[str]:
    """What the ends of the beam may do to the contact within the run.

    A wave of number k travels at 2k√(EI/μ). The front radiates waves of its own number 1/ℓ(t), the shorter
    the earlier, with an energy in proportion to √t: those of the first hundredth of the run carry a tenth.
    The rest is looked at here, as far as the elements at the end carry it (k Δx < 1; shorter waves are
    absorbed at grid scale).
    """
    out = []
    place, _ = front(impact, end_time)
    half, last = impact.half_length, float(nodes[-1] - nodes[-2])
    if place > half and impact.kappa_over_nu > 0.0:
        out.append(
            f"the contact may reach the end of the beam: it may spread to {place:.3g} m, "
            f"the end is at {half:.3g} m"
        )
    emitted = end_time * np.geomspace(0.01, 1.0, 40)
    number = np.array([1.0 / front(impact, t)[1] for t in emitted])
    arrival = emitted + max(2.0 * half - place, 0.0) / (2.0 * number * impact.wave_constant)
    returning = arrival[(number * last < 1.0) & (arrival < end_time)]
    if returning.size:
        out.append(
            f"waves may run to the ends of the beam (x = {half:.3g} m) and be back at the contact from about "
            f"t = {float(returning.min()):.2g} s on, before the run ends at {end_time:.2g} s: from then on "
            "it is no longer the impact of an infinitely long beam (a longer beam or an earlier end avoids it)"
        )
    far = nodes > 1.5 * place
    free = (
        impact.velocity * end_time
        + 0.5 * impact.acceleration * end_time**2
        + 0.5 * (impact.curvature_rate * end_time - impact.relative_curvature) * nodes**2
        + impact.fourth_derivative * nodes**4 / 24.0
    )
    if far_field.end == "following" and np.any(free[far] >= 0.0):
        out.append(
            "the free motion itself meets the wall away from the contact, at x = "
            f"{float(nodes[far][free[far] >= 0.0][0]):.3g} m, before the run ends: shorten the beam"
        )
    return out
