"""A second wall behind the beam: every contact row guards the nearer of the two.

    g = y_w − y ≥ 0 in front,      g = y + D − (y_w at x = 0) ≥ 0 behind: a flat wall at the distance D of the apex

A node cannot get from one wall to the other between two saved instants, so choosing there is exact as long as these are
closer than the flight from wall to wall.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.model import BeamModel
from hermite_fe.run import Stepper

__all__ = ["TwoWalls"]

Array = NDArray[np.float64]


class TwoWalls:
    """Turns the rows of a run to the nearer wall, and keeps the impulses of the two apart.

    Called at every saved instant; ``front`` and ``behind`` hold the impulses of each row so far, as samples.
    """

    def __init__(self, model: BeamModel, distance: float) -> None:
        rows = model.system.contacts
        if rows.dofs.shape[1] != 1:
            raise ValueError('opposite_wall takes contact.kind = "node" only')
        places = np.interp(rows.places, model.beam.nodes, model.natural[0::2])
        self.dofs = rows.dofs[:, 0]
        self.faces = (rows.factors, -rows.factors)
        self.gaps = (rows.gap, places + distance)
        if np.any(self.gaps[1] + model.displacement[self.dofs] < 0.0):
            raise ValueError(
                f"opposite_wall must leave room for the bow of {float(-places.min()):.6g} m behind its apex "
                f"(got {distance!r})"
            )
        self.facing = np.zeros(len(rows), np.int64)
        self.last = np.zeros(len(rows))
        self.front: list[Array] = []
        self.behind: list[Array] = []

    def gap(self, wall: int, q: Array) -> Array:
        """Distance of the rows to a wall (0: in front, 1: behind)."""
        return self.gaps[wall] + self.faces[wall][:, 0] * q[self.dofs]

    def __call__(self, run: Stepper) -> bool:
        gained = run.state.impulse - self.last
        self.last = run.state.impulse.copy()
        before = [samples[-1] if samples else np.zeros(gained.size) for samples in (self.front, self.behind)]
        self.front.append(before[0] + np.where(self.facing == 0, gained, 0.0))
        self.behind.append(before[1] + np.where(self.facing == 1, gained, 0.0))
        q = run.state.q
        self.facing = np.where(self.gap(1, q) < self.gap(0, q), 1, 0)
        behind = self.facing == 1
        factors = np.where(behind[:, None], self.faces[1], self.faces[0])
        run.problem = run.problem._replace(
            factors=np.ascontiguousarray(factors), gap=np.where(behind, self.gaps[1], self.gaps[0])
        )
        return False
