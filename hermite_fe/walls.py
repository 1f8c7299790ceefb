"""A second wall behind the beam: every node then has a constraint for either wall.

    g = y_w − y ≥ 0 in front,      g = y + D − (y_w at x = 0) ≥ 0 behind: a flat wall at the distance D of the apex
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.beam import HermiteBeam
from hermite_fe.system import ContactRows

__all__ = ["behind", "with_opposite_wall"]

Array = NDArray[np.float64]


def with_opposite_wall(
    rows: ContactRows, beam: HermiteBeam, natural: Array, displacement: Array, distance: float
) -> ContactRows:
    """``rows`` of the wall in front, each followed by the same node's of a wall behind at ``distance``, m.

    natural, displacement : (dofs,), the bow at the first touch, and the unknowns then.

    Raises ``ValueError`` for contact that is not at nodes, or a distance that leaves the bow no room.
    """
    if rows.dofs.shape[1] != 1:
        raise ValueError('opposite_wall takes contact.kind = "node" only')
    bow = np.interp(rows.places, beam.nodes, natural[0::2])
    gap = bow + distance
    if np.any(gap + displacement[rows.dofs[:, 0]] < 0.0):
        raise ValueError(
            f"opposite_wall must leave room for the bow of {float(-bow.min()):.6g} m behind its apex (got {distance!r})"
        )
    twice = np.repeat(np.arange(len(rows)), 2)
    factors, gaps = rows.factors[twice], rows.gap[twice]
    factors[1::2] *= -1.0
    gaps[1::2] = gap
    return ContactRows(
        dofs=rows.dofs[twice],
        factors=factors,
        gap=gaps,
        places=rows.places[twice],
        rank=rows.rank[twice],
        side=rows.side[twice],
        tributary=rows.tributary[twice],
    )


def behind(rows: int, two_walls: bool) -> NDArray[np.bool_]:
    """Which of ``rows`` constraints guard the wall behind, (rows,)."""
    marks = np.zeros(rows, bool)
    if two_walls:
        marks[1::2] = True
    return marks
