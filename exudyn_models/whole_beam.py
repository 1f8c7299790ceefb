"""Parts and runs for the whole beam: from the first touch, through waves that come back from its ends, to the last
separation.

What suits the infinite beam's first instants does not suit this: nothing may be held, nothing damped but by the beam
itself, and every part of it matters alike. So

    a uniform mesh,   constant steps h = ½Δx²√(μ/EI),   the trapezoidal rule,   no viscosity at grid scale.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from bent_beam.free_flight import LOWEST_PERIOD, bears_free_flight, cannot_return
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import separation_times
from exudyn_models.contacts import Penalty
from exudyn_models.elements import ANCFCable
from exudyn_models.integrators.trapezoidal import Trapezoidal
from exudyn_models.recording import Recorder
from exudyn_models.simulation import simulate

if TYPE_CHECKING:
    from exudyn_models.method import ExudynModel

__all__ = ["ELEMENTS", "simulate_to_separation", "with_parts_for_whole_beam"]

Array = NDArray[np.float64]

ELEMENTS = 100  # of a half beam; half as many: e moves by 1e-3 at κ/ν = 0.6, 3e-3 at 0.4, 4e-5 from 1 on


def with_parts_for_whole_beam(method: ExudynModel, impact: Impact) -> ExudynModel:
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


class _Left:
    """Says when the beam is off the wall for good: it cannot come back, or, where that cannot be told, it has not
    pushed for one period of its lowest mode. Between two walls it never is."""

    def __init__(self, impact: Impact) -> None:
        self.impact = impact
        self.told = bears_free_flight(impact)
        self.pushed = 0.0
        self.since = 0.0

    def __call__(self, run: Recorder, t: float, q: Array, v: Array) -> bool:
        scaling = run.scaling
        time = t * scaling.end_time
        if run.pushed > self.pushed:
            self.pushed, self.since = run.pushed, time
            return False
        if run.pushed == 0.0 or self.impact.opposite_wall is not None:
            return False
        if not self.told:
            return time - self.since >= LOWEST_PERIOD * self.impact.slow_time_scale
        gap = (run.wall_y - run.beam.deflection(q)) * scaling.deflection
        if gap.min() <= 0.0:
            return False
        energy = (run.beam.kinetic_energy(v) + run.beam.strain_energy(q)) * scaling.energy * (2.0 if run.half else 1.0)
        velocity = v[run.beam.vertical] * scaling.velocity
        return cannot_return(self.impact, run.beam.shape.s * scaling.length, gap, velocity, energy)


def simulate_to_separation(
    method: ExudynModel,
    impact: Impact,
    *,
    longest: float | None = None,
    save: int = 2000,
    progress: Callable[[float], None] | None = None,
) -> ImpactHistory:
    """Run ``impact`` until the beam has left the wall for good; see :func:`bent_beam.method.simulate_to_separation`."""
    chosen = with_parts_for_whole_beam(method, impact)
    times = separation_times(impact, longest, save)
    return simulate(
        impact,
        end_time=float(times[-1]),
        mesh=chosen.mesh,
        element=chosen.element,
        integrator=chosen.integrator,
        contact=chosen.contact,
        geometry=chosen.geometry,
        solver=chosen.solver,
        full_beam=chosen.full_beam,
        save=times,
        progress=progress,
        until=_Left(impact),
    )
