"""Resolution and parts chosen from the problem by scaling alone.

In units of the fast layer (l*, t*), κ = κ/ν: the undisturbed parabola would meet the wall at ξ = √(2τ/κ), so
the front moves like λ̂√τ with λ̂ = √(2/κ) as a crude upper estimate, and the beam bends ahead of it over ℓ(τ)
= 2√τ/λ̂ (the front's speed λ̂/2√τ equals the wave number 1/ℓ of the waves that keep up with it). Elements
must be a fraction of ℓ where the front is, steps a fraction of its travel over ℓ. Nothing here knows λ₀ or
r₀.

- mesh: elements in proportion to the distance, so that every decade of time is resolved alike; for a thin
  front (small κ) even ones over the zone that the last part of the run covers;
- steps in proportion to the time since impact, for the same reason;
- integrator: Signorini at the new position, which leaves closed rows exactly on the wall; Moreau–Jean when
  rows rebound;
- hold: 16 rows behind the front while the beam is pressed on (p = μa₀ + EI q₀ ≥ 0); none when p < 0, for then
  the middle truly lifts off; and all that is closed until the front is a few elements thick;
- far field: grid-scale viscosity;
- mass: consistent.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.impact import Impact
from bent_beam.meshes import GradedMesh, Mesh, ScaleFreeMesh
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.far_fields import FarField, GridViscosity
from hermite_fe.integrators import GeneralizedAlphaPenalty, Integrator, MoreauJean, SignoriniPosition
from hermite_fe.masses import ConsistentMass, Mass

__all__ = ["Choice", "choose", "front"]

Array = NDArray[np.float64]

THIN = 0.04  # κ/ν below which scale-free elements all the way would be too many
LARGEST_STEP = 5e-4  # of the time since impact
ELEMENTS_PER_FRONT = 2.0  # fewer in ℓ deserve a warning
HOLD = 16


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


def chosen_mesh(impact: Impact, end_time: float) -> Mesh:
    """Scale-free elements; for a thin front even ones over the zone."""
    place, thickness = front(impact, end_time)
    kappa = bounded_kappa(impact)
    if kappa >= THIN:
        smallest = min(4e-3 * thickness, 1e-3 * impact.half_length)
        return ScaleFreeMesh(element_length=smallest, growth=1.0 + min(0.01, 0.1 * kappa))
    zone = min(1.05 * place, impact.half_length)
    return GradedMesh(
        element_length=min(thickness / 3.0, zone / 100.0), growth=1.02, zone=zone, size_ratio=1e6
    )


def chosen_integrator(impact: Impact, end_time: float, nodes: Array, integrator: Integrator) -> Integrator:
    """``integrator`` with what it leaves open filled in."""
    growth = min(LARGEST_STEP, 0.4 * bounded_kappa(impact))
    resolved = resolved_time(impact, nodes)
    step = growth * min(max(resolved, 1e-7 * end_time), end_time)
    integrator = integrator.with_steps(step, growth)
    if isinstance(integrator, GeneralizedAlphaPenalty):
        mass, time = impact.mass_per_length, impact.time_scale
        integrator = dataclasses.replace(
            integrator,
            stiffness=1e5 * mass / time**2 if integrator.stiffness is None else integrator.stiffness,
            damping=1e3 * mass / time if integrator.damping is None else integrator.damping,
        )
    return integrator


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
    if mesh is None:
        mesh = chosen_mesh(impact, end_time).refined(refine)
        try:
            nodes = mesh.nodes(impact.half_length)
        except ValueError as error:
            raise ValueError(
                f"curvature: no mesh can be chosen that resolves the contact front at kappa/nu = "
                f"{impact.kappa_over_nu:g} ({error}); give [mesh]"
            ) from None
    else:
        mesh = mesh.refined(refine)
        nodes = mesh.nodes(impact.half_length)
    if contact is None:
        contact = NodeContact()
    if integrator is None:
        integrator = SignoriniPosition() if contact.restitution == 0.0 else MoreauJean()
    integrator = chosen_integrator(impact, end_time, nodes, integrator).refined(refine)
    hold = HOLD if impact.zone_pressure >= 0.0 else 0
    contact = contact.with_hold(hold, min(36.0 * resolved_time(impact, nodes), end_time))
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
    if impact.kappa_over_nu >= 1.0:
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
    if place > half:
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
        + 0.5 * (impact.curvature_rate * end_time - impact.curvature) * nodes**2
        + impact.fourth_derivative * nodes**4 / 24.0
    )
    if far_field.end == "following" and np.any(free[far] >= 0.0):
        out.append(
            "the free motion itself meets the wall away from the contact, at x = "
            f"{float(nodes[far][free[far] >= 0.0][0]):.3g} m, before the run ends: shorten the beam"
        )
    return out
