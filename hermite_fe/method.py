"""The nonsmooth finite-element path as a method: what it is made of, and a run of it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from bent_beam.free_flight import Separation
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.meshes import MESHES
from bent_beam.method import Save, made_of, separation_times
from hermite_fe import resolution
from hermite_fe.composition import Composition
from hermite_fe.contacts import CONTACTS
from hermite_fe.far_fields import FAR_FIELDS
from hermite_fe.integrators import INTEGRATORS
from hermite_fe.masses import MASSES
from hermite_fe.model import BeamModel
from hermite_fe.run import Stepper
from hermite_fe.simulate import refusal, simulate, spreads

__all__ = ["HermiteFE"]


@dataclass(frozen=True)
class HermiteFE(Composition):
    """Hermite beam elements with unilateral contact and a nonsmooth time integrator, on a fixed mesh.

    The parts are those of :class:`hermite_fe.composition.Composition`.

    >>> from bent_beam import Impact
    >>> from hermite_fe import HermiteFE
    >>> from hermite_fe.integrators import MoreauJean
    >>> history = HermiteFE(integrator=MoreauJean(theta=1.0)).simulate(Impact.dimensionless(0.5), end_time=0.1)
    >>> bool(abs(history.array("total_impulse")[-1] - 1.188) < 0.01)
    True
    """

    path: ClassVar[str] = "hermite"
    perturbation: ClassVar[float] = 0.01
    """How much a load may change the free motion at the end of a run that measures λ₁ and r₁, over V₀t."""
    PARTS: ClassVar[dict[str, dict[str, type]]] = {
        "mesh": MESHES,
        "integrator": INTEGRATORS,
        "contact": CONTACTS,
        "far_field": FAR_FIELDS,
        "mass": MASSES,
    }

    label: str = "Hermite"

    def refuses(self, impact: Impact) -> str | None:
        """Why this method cannot take ``impact``, naming the field (``None``: it can)."""
        return refusal(impact)

    def simulate(
        self,
        impact: Impact,
        *,
        end_time: float | None = None,
        save: Save = 200,
        progress: Callable[[float], None] | None = None,
    ) -> ImpactHistory:
        """Follow ``impact`` to ``end_time`` (s); see :func:`hermite_fe.simulate`.

        What is no impact of a front that spreads from the middle (rocking, a second wall, supports, a stop) gets the
        parts that suit the whole beam.
        """
        chosen = self if spreads(impact) else self.for_whole_beam(impact)
        return simulate(impact, end_time=end_time, save=save, progress=progress, **made_of(chosen))

    def chosen_for(self, impact: Impact, end_time: float) -> HermiteFE:
        """A copy with every open part chosen for ``impact`` (:func:`hermite_fe.resolution.for_loads`): other impacts
        then run on the same mesh and steps."""
        parts = resolution.for_loads(self, impact, end_time)
        choice = resolution.choose(impact, end_time, parts)
        return dataclasses.replace(
            parts,
            mesh=choice.mesh,
            integrator=choice.integrator,
            contact=choice.contact,
            far_field=choice.far_field,
            mass=choice.mass,
            refine=1.0,
        )

    for_whole_beam = resolution.for_whole_beam
    cross_checks = resolution.cross_checks
    varied = resolution.varied

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

        def until(model: BeamModel, run: Stepper) -> bool:
            state = run.state
            return separation(
                float(run.instants[run.step]),
                float(state.impulse.sum()),
                lambda: (model.beam.nodes, model.gap(state.q), state.v[0::2], model.copies * run.energy()),
                closed=bool(np.any(state.closed)),
            )

        parts = made_of(self.for_whole_beam(impact))
        return simulate(impact, end_time=float(times[-1]), save=times, progress=progress, until=until, **parts)
