"""Resolution chosen from the problem by scaling alone.

In units of the fast layer (l*, t*), with κ = κ/ν: the undisturbed parabola would meet the wall at ξ = √(2τ/κ), so the front
moves like λ̂√τ with λ̂ = √(2/κ) as a crude upper estimate, and the beam bends ahead of it over ℓ(τ) = 2√τ/λ̂ (speed of the
front, λ̂/2√τ, equal to the wave number 1/ℓ of the waves that keep up with it). Elements must be a fraction of
ℓ where the front is, steps a fraction of its travel over ℓ. Nothing here knows λ₀ or r₀.
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
from hermite_fe.integrators import Integrator, MoreauJean

__all__ = ["Choice", "choose", "front"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Choice:
    """All parts of a run, and what to warn of."""

    mesh: Mesh
    nodes: Array
    integrator: Integrator
    contact: Contact
    far_field: FarField
    warnings: tuple[str, ...]


def front(impact: Impact, time: float) -> tuple[float, float]:
    """Crude estimates of the front's place and thickness at ``time``, m, by scaling."""
    kappa = min(max(impact.kappa_over_nu, 1e-12), 1.0)
    spread = math.sqrt(time / impact.time_scale) * impact.length_scale
    speed = math.sqrt(2.0 / kappa)
    return speed * spread, 2.0 * spread / speed


def chosen_mesh(impact: Impact, end_time: float) -> Mesh:
    """Scale-free elements; for a thin front (small κ/ν) uniform ones over the zone."""
    place, thickness = front(impact, end_time)
    kappa = min(max(impact.kappa_over_nu, 1e-12), 1.0)
    if kappa >= 0.05:
        return ScaleFreeMesh(element_length=1e-3 * thickness, growth=1.0 + min(0.01, 0.1 * kappa))
    return GradedMesh(element_length=thickness / 4.0, growth=1.01, zone=min(1.1 * place, impact.half_length))


def choose(
    impact: Impact, end_time: float, mesh: Mesh | None, integrator: Integrator | None, contact: Contact | None,
    far_field: FarField | None,
) -> Choice:
    """Fill in what was left open."""
    warnings: list[str] = []
    mesh_ = chosen_mesh(impact, end_time) if mesh is None else mesh
    nodes = mesh_.nodes(impact.half_length)
    kappa = min(max(impact.kappa_over_nu, 1e-12), 1.0)
    smallest = float(np.diff(nodes).min())
    # the time at which the front is as thick as the smallest element
    resolved = end_time * (smallest / front(impact, end_time)[1]) ** 2
    growth = min(1e-3, 0.1 * kappa)
    integrator_ = (MoreauJean() if integrator is None else integrator).with_steps(
        max(growth * resolved, growth * end_time * 1e-7), growth)
    contact_ = (NodeContact() if contact is None else contact).with_hold(16, 36.0 * resolved)
    return Choice(mesh_, nodes, integrator_, contact_, far_field or GridViscosity(), tuple(warnings))
