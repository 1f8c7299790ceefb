"""Parts and runs for the whole beam: from the first touch, through waves that come back from its ends, to the last
separation.

What suits the infinite beam's first instants does not suit this: nothing may be absorbed, nothing held behind a front
(a hold glues the zone when waves come back), and every part of the beam matters alike. So

    a uniform mesh,   steps h = ½Δx²√(μ/EI),   Signorini's law alone,   the beam's own damping alone.

Signorini's condition at the new position with θ = ½, which damps nothing but in impacts, comes nearest to converged
values on a given mesh (docs/whole_impact.md); Moreau–Jean asks for the same at velocity level.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from bent_beam.free_flight import Departure
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import made_of, separation_times
from hermite_fe.composition import Composition
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import MoreauJean, SignoriniPosition
from hermite_fe.model import BeamModel
from hermite_fe.run import Stepper
from hermite_fe.simulate import simulate

__all__ = ["ELEMENTS", "cross_checks", "simulate_to_separation", "varied", "with_parts_for_whole_beam"]

ELEMENTS = 200  # of a half beam
C = TypeVar("C", bound=Composition)


def with_parts_for_whole_beam(method: C, impact: Impact) -> C:
    """A copy of ``method`` whose open parts are those of the module's head; its ``refine`` is worked in."""
    mesh = UniformMesh(impact.half_length / ELEMENTS) if method.mesh is None else method.mesh
    mesh = mesh.refined(method.refine)
    shortest = float(np.diff(mesh.nodes(impact.half_length)).min())
    contact = NodeContact() if method.contact is None else method.contact
    without_rebound = contact.restitution == 0.0
    chosen = SignoriniPosition(theta=0.5) if without_rebound else MoreauJean(theta=0.5)
    integrator = chosen if method.integrator is None else method.integrator
    integrator = integrator.with_defaults(impact)  # before it is refined: what is open cannot be
    if integrator.time_step is None:
        integrator = integrator.refined(method.refine**2).with_steps(0.5 * shortest**2 / impact.wave_constant, 0.0)
    else:
        integrator = integrator.with_steps(integrator.time_step, 0.0).refined(method.refine)
    return dataclasses.replace(
        method,
        mesh=mesh,
        integrator=integrator,
        contact=contact.with_hold(0, 0.0),
        far_field=GridViscosity(viscosity=0.0) if method.far_field is None else method.far_field,
        full_beam=method.full_beam or impact.off_centre,
        domain=None,
        refine=1.0,
    )


def cross_checks(method: C, impact: Impact) -> dict[str, C]:
    """What stands beside ``method`` for error bars, by cause: half as many elements (and steps in proportion to their
    square), steps twice as long, and the impact law of another scheme, with these steps too (half of the work; the bar
    then counts the step twice)."""
    chosen = with_parts_for_whole_beam(method, impact)
    mesh, integrator = chosen.mesh, chosen.integrator
    assert mesh is not None and integrator is not None
    step = integrator.time_step
    other = (
        SignoriniPosition(theta=0.5, time_step=step, growth=0.0)
        if isinstance(integrator, MoreauJean) and chosen.contact is not None and chosen.contact.restitution == 0.0
        else MoreauJean(theta=0.5, time_step=step, growth=0.0)
    )
    return {
        "mesh": dataclasses.replace(chosen, mesh=mesh.refined(0.5), integrator=integrator.refined(0.25)),
        "step": dataclasses.replace(chosen, integrator=integrator.refined(0.5)),
        "contact_law": dataclasses.replace(chosen, integrator=other.refined(0.5)),
    }


def varied(method: C, impact: Impact, random: np.random.Generator) -> C:
    """A method for an ensemble: elements, steps and impact law drawn at random.

    Moreau–Jean with θ = ½ throughout, which keeps the energy between impacts.
    """
    elements = int(random.integers(2 * ELEMENTS // 5, 4 * ELEMENTS // 5))
    length = impact.half_length / elements
    step = 2.0 ** random.uniform(-1.0, 1.0) * length**2 / impact.wave_constant
    restitution = (0.0, 0.5, 1.0)[int(random.integers(3))]
    return dataclasses.replace(
        method,
        mesh=UniformMesh(length),
        integrator=MoreauJean(theta=0.5, time_step=step, growth=0.0),
        contact=NodeContact(restitution=restitution),
    )


def simulate_to_separation(
    method: Composition,
    impact: Impact,
    *,
    longest: float | None = None,
    save: int = 2000,
    progress: Callable[[float], None] | None = None,
) -> ImpactHistory:
    """Run ``impact`` until the beam has left the wall for good; see :func:`bent_beam.method.simulate_to_separation`."""
    times, left = separation_times(impact, longest, save), Departure(impact)

    def until(model: BeamModel, run: Stepper) -> bool:
        state = run.state
        return left(
            float(run.instants[run.step]),
            float(state.impulse.sum()),
            lambda: (model.beam.nodes, model.gap(state.q), state.v[0::2], model.copies * run.energy()),
            closed=bool(np.any(state.closed)),
        )

    parts = made_of(with_parts_for_whole_beam(method, impact))
    return simulate(impact, end_time=float(times[-1]), save=times, progress=progress, until=until, **parts)
