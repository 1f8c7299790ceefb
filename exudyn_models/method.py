"""The Exudyn path as a method."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.method import Save, made_of
from exudyn_models import whole_beam
from exudyn_models.composition import Composition
from exudyn_models.contacts import Contact, Penalty
from exudyn_models.resolution import thin_front
from exudyn_models.simulation import simulate

__all__ = ["ExudynModel"]

FIRST_ORDER_HOLD = 16  # elements behind the front; it ends when waves may be back, and every run states it
FIRST_ORDER_STEPS = 4.0  # so many times shorter steps: λ₁ of (−1, −1, 0) at κ/ν = 0.8 is 5 % off without, 0.4 % with


@dataclass(frozen=True)
class ExudynModel(Composition):
    """Exudyn's cable or beam elements with contact against a rigid wall.

    The parts are those of :class:`exudyn_models.composition.Composition`.

    label : how rows and curves call it.
    """

    path: ClassVar[str] = "exudyn"

    label: str = "Exudyn"

    for_whole_beam = whole_beam.with_parts_for_whole_beam
    cross_checks = whole_beam.cross_checks
    varied = whole_beam.varied
    simulate_to_separation = whole_beam.simulate_to_separation

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
        shorter = FIRST_ORDER_STEPS if self.integrator is None and impact.loaded else 1.0
        chosen = dataclasses.replace(self, contact=self._held_for(impact)).chosen(impact, end_time, shorter)
        return dataclasses.replace(
            self,
            mesh=chosen.mesh,
            element=chosen.element,
            contact=chosen.contact,
            integrator=chosen.integrator,
            refine=1.0,
        )

    def _held_for(self, impact: Impact) -> Contact:
        """The contact with the hold that suits the load, for the runs with and without load."""
        contact = Penalty() if self.contact is None else self.contact
        if impact.zone_pressure > 0.0 and self.contact is None and not thin_front(impact.kappa_over_nu):
            # The load first closes what the rebound of the first instants has left. λ₁ of (4, 0, 0) at κ/ν = 0.5 is
            # 12 % off without the hold, 0.1 % with it. Behind a thin front nothing rebounds.
            return Penalty(hold=FIRST_ORDER_HOLD)
        if impact.zone_pressure < 0.0 and isinstance(contact, Penalty) and contact.hold_start is None:
            return dataclasses.replace(contact, hold_start=0.0)  # the load lifts the zone: no start is held
        return contact
