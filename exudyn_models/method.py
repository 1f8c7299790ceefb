"""The Exudyn path as a method."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from bent_beam.free_flight import Separation
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.method import Save, made_of, separation_times
from exudyn_models import resolution, whole_beam
from exudyn_models.arrays import Array
from exudyn_models.composition import Composition
from exudyn_models.recording import Recorder
from exudyn_models.simulation import simulate
from exudyn_models.supports import supports_or_plate

__all__ = ["ExudynModel"]

@dataclass(frozen=True)
class ExudynModel(Composition):
    """Exudyn's cable or beam elements with contact against a rigid wall.

    The parts are those of :class:`exudyn_models.composition.Composition`.

    label : how rows and curves call it.
    """

    path: ClassVar[str] = "exudyn"

    label: str = "Exudyn"

    for_whole_beam = whole_beam.for_whole_beam
    cross_checks = whole_beam.cross_checks
    varied = whole_beam.varied

    def simulate(
        self,
        impact: Impact,
        *,
        end_time: float | None = None,
        save: Save = 200,
        progress: Callable[[float], None] | None = None,
    ) -> ImpactHistory:
        """Follow ``impact`` to ``end_time`` (s); see :func:`exudyn_models.simulate`.

        Supports and a wall along a part of the beam get the parts that suit the whole beam.
        """
        chosen = self.for_whole_beam(impact) if supports_or_plate(impact) else self
        return simulate(impact, end_time=end_time, save=save, progress=progress, **made_of(chosen))

    def chosen_for(self, impact: Impact, end_time: float) -> ExudynModel:
        """A copy with mesh, element, steps and hold chosen for ``impact``: other impacts then run on the same ones."""
        chosen = resolution.choose(self, impact, end_time, for_loads=True)
        return dataclasses.replace(
            self,
            mesh=chosen.mesh,
            element=chosen.element,
            contact=chosen.contact,
            integrator=chosen.integrator,
            refine=1.0,
        )

    def simulate_to_separation(
        self,
        impact: Impact,
        *,
        longest: float | None = None,
        save: int = 2000,
        progress: Callable[[float], None] | None = None,
    ) -> ImpactHistory:
        """Follow ``impact`` until the beam has left for good (:func:`bent_beam.method.simulate_to_separation`)."""
        times, separation = separation_times(impact, longest, save), Separation(impact)

        def until(run: Recorder, t: float, q: Array, v: Array) -> bool:
            scaling, beam = run.scaling, run.beam

            def state() -> tuple[Array, Array, Array, float]:
                energy = float(beam.kinetic_energy(v) + beam.strain_energy(q)) * scaling.energy
                return (
                    beam.shape.s * scaling.length,
                    (run.wall_y - beam.deflection(q)) * scaling.deflection,
                    v[beam.vertical] * scaling.velocity,
                    energy * (2.0 if run.half else 1.0),
                )

            closed = bool(run.active.any())
            if not closed:
                run.sum_up()
            return separation(t * scaling.end_time, run.pushed, state, closed=closed)

        parts = made_of(self.for_whole_beam(impact))
        return simulate(impact, end_time=float(times[-1]), save=times, progress=progress, until=until, **parts)
