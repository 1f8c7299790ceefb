"""Which captured nodes are held: those that the front has passed by fewer than ``hold`` elements, on either side.

The first instants are never resolved, whatever the mesh: the front is then faster than any element. What their node
impacts leave behind would lift the zone for a long time, so all captured nodes are held for a first share ``START`` of
the run. A zone that is to lift off has by then moved by START² of its final way.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from exudyn_models.contacts.base import Wall

__all__ = ["START", "HeldStrip", "chosen_hold"]

HOLD = 16  # elements; from 8 on the interior no longer lifts
START = 4e-3  # of the end time


def chosen_hold(wall: Wall, hold: int | None) -> int:
    """The given hold, or 16; none where the load draws the beam off the wall and under explicit integrators."""
    if hold is not None:
        return hold
    return 0 if wall.pulled_off or wall.explicit else HOLD


class HeldStrip:
    """Remembers which contact nodes have been captured."""

    def __init__(self, wall: Wall, hold: int, start: float = START) -> None:
        self.hold = hold
        self.start = 0.0 if wall.explicit or wall.point_contact else start
        self.captured = np.zeros(wall.nodes.size, bool)
        self._distance = np.abs(wall.nodes - wall.centre)
        self._sides = (wall.nodes >= wall.centre, wall.nodes < wall.centre)

    @property
    def used(self) -> bool:
        """Whether any node will ever be held."""
        return bool(self.hold) or self.start > 0.0

    def wanted(self, time: float) -> NDArray[np.bool_]:
        """Flags of the contact nodes to hold at ``time`` (of the end time), shape (contacts,)."""
        if time < self.start:
            return self.captured.copy()
        held = np.zeros_like(self.captured)
        if not self.hold:
            return held
        for side in self._sides:
            caught = self.captured & side
            if caught.any():
                held |= caught & (self._distance > self._distance[caught].max() - self.hold)
        return held
