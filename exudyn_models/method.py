"""The Exudyn path as a method: what it is made of, and a run of it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.meshes import MESHES
from bent_beam.method import Save, made_of
from exudyn_models import whole_beam
from exudyn_models.composition import Composition
from exudyn_models.contacts import CONTACTS, Contact, Penalty
from exudyn_models.elements import ELEMENTS, Element
from exudyn_models.geometry import GEOMETRIES
from exudyn_models.integrators import INTEGRATORS, Integrator
from exudyn_models.resolution import refined_choice
from exudyn_models.simulation import refusal, simulate
from exudyn_models.solvers import SOLVERS

__all__ = ["ExudynModel"]

FIRST_ORDER_HOLD = 16  # elements behind the front; it ends when waves may be back, and every run states it
FIRST_ORDER_STEPS = 4.0  # so many times shorter steps: λ₁ of (−1, −1, 0) at κ/ν = 0.8 is 5 % off without, 0.4 % with


@dataclass(frozen=True)
class ExudynModel(Composition):
    """Exudyn's cable or beam elements with contact against a rigid ground.

    mesh, element, integrator, contact, geometry, solver : parts; ``None``: chosen from the problem.
    full_beam : model both halves instead of one with a symmetry support.
    refine : elements and steps so many times finer than the parts say, for studies of convergence.
    label : how rows and curves call it.
    """

    path: ClassVar[str] = "exudyn"
    PARTS: ClassVar[dict[str, dict[str, type]]] = {
        "mesh": MESHES,
        "element": ELEMENTS,
        "integrator": INTEGRATORS,
        "contact": CONTACTS,
        "geometry": GEOMETRIES,
        "solver": SOLVERS,
    }

    label: str = "Exudyn"

    def refuses(self, impact: Impact) -> str | None:
        """Why this method cannot take ``impact`` (``None``: it can)."""
        contact, element, integrator = self._joined()
        return refusal(impact, self.full_beam) or contact.refuses(impact, element, integrator)

    def _joined(self) -> tuple[Contact, Element, Integrator]:
        contact = Penalty() if self.contact is None else self.contact
        element = ELEMENTS["ancf_cable"]() if self.element is None else self.element
        return contact, element, contact.integrator() if self.integrator is None else self.integrator

    def simulate(
        self,
        impact: Impact,
        *,
        end_time: float | None = None,
        save: Save = 200,
        progress: Callable[[float], None] | None = None,
    ) -> ImpactHistory:
        """Follow ``impact`` to ``end_time`` (s); see :func:`exudyn_models.simulate`."""
        return simulate(impact, end_time=end_time, save=save, progress=progress, **made_of(self))

    def chosen_for(self, impact: Impact, end_time: float) -> ExudynModel:
        """A copy with mesh, element, steps and hold chosen for ``impact``: other impacts then run on the same ones."""
        contact, element, integrator = self._joined()
        shorter = FIRST_ORDER_STEPS if self.integrator is None and impact.loaded else 1.0
        if impact.zone_pressure < 0.0 and isinstance(contact, Penalty) and contact.hold_start is None:
            # no start is held where the load lifts the zone: the run without load must do without it too
            contact = dataclasses.replace(contact, hold_start=0.0)
        elif impact.zone_pressure > 0.0 and self.contact is None:
            # a zone that a load presses must lie on the wall in the run without it, too, or the load first closes what
            # the rebound of the first instants has left: λ₁ of (4, 0, 0) at κ/ν = 0.5 is 12 % off without, 0.1 % with
            contact = Penalty(hold=FIRST_ORDER_HOLD)
        mesh, integrator = refined_choice(
            self.mesh,
            integrator,
            impact,
            end_time,
            open_steps=self.integrator is None,
            refine=self.refine,
            shorter=shorter,
        )
        return dataclasses.replace(
            self, mesh=mesh, element=element, contact=contact, integrator=integrator, refine=1.0
        )

    def for_whole_beam(self, impact: Impact) -> ExudynModel:
        """A copy whose open parts suit the whole beam until it has left: nothing held, no viscosity of the grid."""
        return whole_beam.with_parts_for_whole_beam(self, impact)

    def cross_checks(self, impact: Impact) -> dict[str, ExudynModel]:
        """Coarser elements, longer steps, a softer contact: what error bars of a whole impact come from."""
        return whole_beam.cross_checks(self, impact)

    def varied(self, impact: Impact, random: np.random.Generator) -> ExudynModel:
        """A copy with elements, steps and stiffness of the contact drawn at random, for an ensemble."""
        return whole_beam.varied(self, impact, random)

    def simulate_to_separation(
        self,
        impact: Impact,
        *,
        longest: float | None = None,
        save: int = 2000,
        progress: Callable[[float], None] | None = None,
    ) -> ImpactHistory:
        """Follow ``impact`` until the beam has left for good (:func:`bent_beam.method.simulate_to_separation`)."""
        return whole_beam.simulate_to_separation(self, impact, longest=longest, save=save, progress=progress)
