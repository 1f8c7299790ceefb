"""What every contact discretisation shares: the impact law and the hold behind the front.

    ġ⁺ = −e ġ⁻ where a row closes                                                           (thesis 3.2.4)

**The hold.** Behind a moving contact front the exact reaction is zero. A unilateral law turns round-off and
mesh noise of either sign there into pushes off the wall, which lift the zone ("double detachment", thesis
3.3.5); the impacts of the first instants, when no mesh resolves the front, do the same. So a row that has
closed is not released

- until the front is ``hold`` rows further (the strip shrinks with the mesh: consistent), and
- before ``hold_until``, the time at which the front's thickness is a few elements.

A held row may pull; what it pulled is recorded as ``held_impulse``. Where the middle truly lifts off (α + ψ <
0) a long hold pulls on what should leave: keep it short there. With a restitution e > 0 nothing is held
unless asked for.
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
    hold : rows that the front must be ahead before a closed one may open (``None``: chosen from the problem;
        0: none).
    hold_until : s, until when nothing that has closed opens (``None``: chosen; 0: never held).
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

    @abstractmethod
    def rows(self, beam: HermiteBeam, natural: Array, *, full: bool) -> ContactRows:
        """The constraint rows of ``beam`` for g = y_w − y = −(u + natural).

        u : the unknown dofs; natural : (dofs,), Hermite dofs of the bow as seen from the wall, −(K − K_w)x²/2.
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
