"""Where walls and supports are: along a part of the beam, as springs, behind the beam; and ends that are held.

With a second wall behind the beam every node has a constraint for either wall.

    g = y_w − y ≥ 0 in front,      g = y + D − (y_w at x = 0) ≥ 0 behind: a flat wall at the distance D of the apex
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from bent_beam.impact import Impact
from hermite_fe.beam import HermiteBeam
from hermite_fe.elastic_wall import NO_SPRINGS, Springs
from hermite_fe.system import ContactRows

__all__ = ["before_the_wall", "behind", "held_dofs", "springs_of", "with_opposite_wall"]

Array = NDArray[np.float64]

NEAR = 1e-9  # of the length: a node so near an edge of the wall lies on it
HELD = {"free": 0, "hinged": 1, "clamped": 2}  # dofs of the end node


def held_dofs(impact: Impact, beam: HermiteBeam, *, full: bool) -> tuple[int, ...]:
    """Dofs that the ends hold, and the slope in the middle of a half beam."""
    left = tuple(range(HELD[impact.left_end])) if full else (1,)
    last = beam.dofs - 2
    return left + tuple(range(last, last + HELD[impact.right_end]))


def before_the_wall(rows: ContactRows, impact: Impact, supports: tuple[int, ...]) -> ContactRows:
    """``rows`` that stand before the wall, and not at an end that is held.

    Raises ``ValueError`` where there is none, as before a stop where contact is not at nodes.
    """
    begin, end = impact.wall_span
    near = NEAR * impact.length
    kept = (rows.places >= begin - near) & (rows.places <= end + near)
    if rows.dofs.shape[1] == 1:
        kept &= ~np.isin(rows.dofs[:, 0], supports)
    if not kept.any():
        raise ValueError(
            f"wall_from: no contact point stands before the wall from {begin!r} to {end!r} m; take contact.kind = node"
        )
    return ContactRows(*(getattr(rows, field.name)[kept] for field in dataclasses.fields(rows)))


def springs_of(impact: Impact, beam: HermiteBeam, facing: Array, *, full: bool) -> Springs:
    """The springs of a wall that gives way; of a stop in the middle of a half beam, half of them."""
    if impact.wall_stiffness is None:
        return NO_SPRINGS
    (begin, end), near = impact.wall_span, NEAR * impact.length
    inside = np.flatnonzero((beam.nodes >= begin - near) & (beam.nodes <= end + near))
    first, last = int(inside[0]), int(inside[-1])
    share = 0.5 if begin == end and not full else 1.0
    return Springs(
        stiffness=share * impact.wall_stiffness,
        damping=share * impact.wall_damping,
        facing=facing,
        lengths=beam.lengths,
        first=first,
        last=last,
        stop=2 * first if begin == end else -1,
    )


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
