"""Which captured nodes are held: those that the front has passed by fewer than ``hold`` elements, on either side."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from exudyn_models.contacts.base import Wall

__all__ = ["HeldStrip", "chosen_hold"]

HOLD = 16  # elements; from 8 on the interior no longer lifts


def chosen_hold(wall: Wall, hold: int | None) -> int:
    """The given hold, or 16; none where the load draws the beam off the wall and under explicit integrators."""
    if hold is not None:
        return hold
    return 0 if wall.pulled_off or wall.explicit else HOLD


class HeldStrip:
    """Remembers which contact nodes have been captured."""

    def __init__(self, wall: Wall, hold: int) -> None:
        self.hold = hold
        self.captured = np.zeros(wall.nodes.size, bool)
        self._distance = np.abs(wall.nodes - wall.centre)
        self._sides = (wall.nodes >= wall.centre, wall.nodes < wall.centre)

    def wanted(self) -> NDArray[np.bool_]:
        """Flags of the contact nodes to hold now, shape (contacts,)."""
        held = np.zeros_like(self.captured)
        if not self.hold:
            return held
        for side in self._sides:
            caught = self.captured & side
            if caught.any():
                held |= caught & (self._distance > self._distance[caught].max() - self.hold)
        return held
