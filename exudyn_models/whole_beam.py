"""Parts and runs for the whole beam: from the first touch, through waves that come back from its ends, to the last
separation.

What suits the infinite beam's first instants does not suit this: nothing may be held, nothing damped but by the beam
itself, and every part of it matters alike. So

    a uniform mesh,   constant steps h = ½Δx²√(μ/EI),   the trapezoidal rule,   no viscosity at grid scale.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from bent_beam.free_flight import Departure
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import made_of, separation_times
from exudyn_models.composition import Composition
from exudyn_models.contacts import Penalty
from exudyn_models.elements import ANCFCable
from exudyn_models.integrators.trapezoidal import Trapezoidal
from exudyn_models.recording import Recorder
from exudyn_models.simulation import simulate

__all__ = ["ELEMENTS", "simulate_to_separation", "with_parts_for_whole_beam"]

Array = NDArray[np.float64]
C = TypeVar("C", bound=Composition)

ELEMENTS = 100  # of a half beam; half as many: e moves by 1e-3 at κ/ν = 0.6, 3e-3 at 0.4, 4e-5 from 1 on


def with_parts_for_whole_beam(method: C, impact: Impact) -> C:
    """A copy of ``method`` whose open parts are those of the module's head; its ``refine`` is worked in."""
    mesh = UniformMesh(impact.half_length / ELEMENTS) if method.mesh is None else method.mesh
    mesh = mesh.refined(method.refine)
    integrator = method.integrator
    if integrator is None:
        shortest = float(np.diff(mesh.nodes(impact.half_length)).min())
        integrator = Trapezoidal(time_step=0.5 * shortest**2 / impact.wave_constant)
    else:
        integrator = integrator.refined(method.refine)
    return dataclasses.replace(
        method,
        mesh=mesh,
        element=ANCFCable(viscosity=0.0) if method.element is None else method.element,
        integrator=integrator,
        contact=Penalty(hold_start=0.0) if method.contact is None else method.contact,
        full_beam=method.full_beam or bool(impact.rotation or impact.first_touch),
        refine=1.0,
    )


def simulate_to_separation(
    method: Composition,
    impact: Impact,
    *,
    longest: float | None = None,
    save: int = 2000,
    progress: Callable[[float], None] | None = None,
) -> ImpactHistory:
    """Run ``impact`` until the beam has left the wall for good; see :func:`bent_beam.method.simulate_to_separation`.

    Between two walls it never does.
    """
    times, left = separation_times(impact, longest, save), Departure(impact)

    def until(run: Recorder, t: float, q: Array, v: Array) -> bool:
        scaling, beam = run.scaling, run.beam

        def state() -> tuple[Array, Array, Array, float]:
            energy = (beam.kinetic_energy(v) + beam.strain_energy(q)) * scaling.energy
            return (
                beam.shape.s * scaling.length,
                (run.wall_y - beam.deflection(q)) * scaling.deflection,
                v[beam.vertical] * scaling.velocity,
                energy * (2.0 if run.half else 1.0),
            )

        return impact.opposite_wall is None and left(t * scaling.end_time, run.pushed, state)

    parts = made_of(with_parts_for_whole_beam(method, impact))
    return simulate(impact, end_time=float(times[-1]), save=times, progress=progress, until=until, **parts)
