"""The nonsmooth finite-element path as a method: what it is made of, and a run of it."""

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
from hermite_fe import resolution, whole_beam
from hermite_fe.composition import Composition
from hermite_fe.contacts import CONTACTS, NodeContact
from hermite_fe.far_fields import FAR_FIELDS, GridViscosity
from hermite_fe.integrators import INTEGRATORS
from hermite_fe.masses import MASSES
from hermite_fe.simulate import cut, refusal, simulate

__all__ = ["HermiteFE"]


@dataclass(frozen=True)
class HermiteFE(Composition):
    """Hermite beam elements with unilateral contact and a nonsmooth time integrator, on a fixed mesh.

    mesh, integrator, contact, far_field, mass : parts; ``None``: chosen for the problem (:mod:`hermite_fe.resolution`).
    full_beam : model both halves instead of one with a symmetry support.
    domain : half length, m, that is modelled of a longer beam, whose cut ends follow the free motion (``None``: all of
        it, with free ends).
    refine : elements and steps so many times finer than the parts say, for studies of convergence.
    label : how rows and curves call it.
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

        What is no impact of a front that spreads from the middle (rocking, a second wall) gets the parts that suit the
        whole beam.
        """
        chosen = self.for_whole_beam(impact) if impact.off_centre or impact.opposite_wall is not None else self
        return simulate(impact, end_time=end_time, save=save, progress=progress, **made_of(chosen))

    def chosen_for(self, impact: Impact, end_time: float) -> HermiteFE:
        """A copy with every open part chosen for ``impact``: other impacts then run on the same mesh and steps.

        It measures what the loads of ``impact`` change. So a long beam is cut where nothing arrives, its ends following
        the free motion, and a zone that the load presses on is held behind the front (``contact.hold``): what lift the
        bare impact leaves would otherwise take up the load before the wall does. Neither without loads.
        """
        mesh, contact, far_field, domain = self.mesh, self.contact, self.far_field, self.domain
        if impact.loaded:
            if domain is None and far_field is None:
                domain = resolution.chosen_domain(impact, end_time)
            if contact is None and impact.zone_pressure > 0.0 and (self.integrator is None or self.integrator.holds):
                contact = NodeContact(hold=resolution.PRESSED_HOLD)
            if mesh is None:
                mesh = resolution.chosen_mesh(cut(impact, domain), end_time, loaded=True)
        if domain is not None and far_field is None:
            far_field = GridViscosity(end="following")
        choice = resolution.choose(
            cut(impact, domain),
            end_time,
            mesh,
            self.integrator,
            contact,
            far_field,
            self.mass,
            refine=self.refine,
        )
        return dataclasses.replace(
            self,
            mesh=choice.mesh,
            integrator=choice.integrator,
            contact=choice.contact,
            far_field=choice.far_field,
            mass=choice.mass,
            domain=domain,
            refine=1.0,
        )

    def for_whole_beam(self, impact: Impact) -> HermiteFE:
        """A copy whose open parts suit the whole beam until it has left: strictly unilateral, nothing absorbed."""
        return whole_beam.with_parts_for_whole_beam(self, impact)

    def cross_checks(self, impact: Impact) -> dict[str, HermiteFE]:
        """Coarser elements, longer steps, another impact law: what error bars of a whole impact come from."""
        return whole_beam.cross_checks(self, impact)

    def varied(self, impact: Impact, random: np.random.Generator) -> HermiteFE:
        """A copy with elements, steps and impact law drawn at random, for an ensemble."""
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
