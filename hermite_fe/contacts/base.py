"""What every contact discretisation shares: the impact law and the hold behind the front.

    ġ⁺ = −e ġ⁻ where a row closes                                                           (thesis 3.2.4)

**The hold.** Contact is unilateral. Two options keep closed constraints closed against that, for comparison and for the
infinite beam's first instants only:

- ``hold_until``: nothing that has closed opens before this time (a bilateral start). No mesh resolves the first
  instants, when the front is thinner than an element; the impacts of that phase may leave the zone with a velocity
  off the wall ("double detachment", thesis 3.3.5). Off unless stated: a long first step makes it needless
  (:mod:`hermite_fe.resolution`).
- ``hold``: a constraint that has closed is not released until the front is so many constraints further (the strip
  shrinks with the mesh: consistent). Behind a moving front the exact reaction is zero, and noise of either sign there
  turns into pushes off the wall. Off unless stated, but in runs that measure what a pressing load changes.

Neither acts after t_w = 0.005 T* (:data:`bent_beam.impact.FIRST_SPREAD`), from when on waves from the ends may move the
zone. A held constraint may pull; what it pulled is recorded as ``held_impulse``, and how hard as ``hold`` in the
settings.
"""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import between, non_negative, whole
from hermite_fe.beam import HermiteBeam
from hermite_fe.system import ContactRows

__all__ = ["Contact"]

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Contact(ABC):
    """Base of the contact discretisations.

    restitution : e ∈ [0, 1].
    hold : constraints that the front must be ahead before a closed one may open (``None`` and 0: none).
    hold_until : s, until when nothing that has closed opens (``None`` and 0: it may at once).
    """

    restitution: float = 0.0
    hold: int | None = None
    hold_until: float | None = None

    def __post_init__(self) -> None:
        between("restitution", self.restitution, 0.0, 1.0)
        if self.hold is not None:
            whole("contact.hold", self.hold, 0)
        if self.hold_until is not None:
            non_negative("contact.hold_until", self.hold_until)
        if self.restitution > 0.0:
            for name in ("hold", "hold_until"):
                if getattr(self, name):
                    raise ValueError(
                        f"contact.{name} keeps rows closed that restitution {self.restitution!r} makes rebound: "
                        f"state one of them (got {getattr(self, name)!r})"
                    )

    @abstractmethod
    def rows(self, beam: HermiteBeam, facing: Array, *, full: bool) -> ContactRows:
        """The constraint rows of ``beam`` for g = y_w − y = −(u + facing).

        u : the unknown dofs; facing : (dofs,), Hermite dofs of the bow as seen from the wall, −(K − K_w)x²/2.
        """

    def with_hold(self, hold: int, hold_until: float) -> Contact:
        """A copy whose open choices are taken from here (none at all when rows rebound)."""
        if self.restitution > 0.0:
            hold, hold_until = 0, 0.0
        return dataclasses.replace(
            self,
            hold=hold if self.hold is None else self.hold,
            hold_until=hold_until if self.hold_until is None else self.hold_until,
        )
