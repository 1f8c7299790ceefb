"""Ends that are held, and where the wall stands before the beam.

A hinge holds y of the end's node where it is at the first touch, a clamp y and the rotation, by Exudyn's
``CoordinateConstraint``. Along the beam every end is free: supports that held both would make a string of it.
"""

from __future__ import annotations

import numpy as np

from bent_beam import Impact
from exudyn_models.arrays import Array, Flags
from exudyn_models.elements import Beam
from exudyn_models.scaling import Scaling

__all__ = ["before_the_wall", "hold_ends", "supports_or_plate"]

NEAR = 1e-9  # of the length: a node so near an edge of the wall lies on it


def supports_or_plate(impact: Impact) -> bool:
    """Whether an end is held, or the wall stands before a part of the beam only."""
    return impact.supported or impact.wall_in_part


def hold_ends(beam: Beam, impact: Impact, *, half: bool, by_inertia: bool) -> None:
    """Hold the beam's ends; of a half beam the right one."""
    hold = beam.hold_by_inertia if by_inertia else beam.fix
    ends = {0: impact.left_end, beam.shape.s.size - 1: impact.right_end}
    for node, held in list(ends.items())[1 if half else 0 :]:
        coordinates = {"free": (), "hinged": (beam.vertical_coordinate,)}.get(
            held, (beam.vertical_coordinate, beam.rotation_coordinate)
        )
        if coordinates:
            hold(node, *coordinates)


def before_the_wall(s: Array, scaling: Scaling) -> tuple[Flags, Array]:
    """Which nodes at s (Λ) stand before the wall and are not held, (nodes,), and the length of every element before
    it, 0 of others, (nodes − 1,)."""
    impact, near = scaling.impact, NEAR * scaling.impact.length / scaling.length
    begin, end = (edge / scaling.length for edge in impact.wall_span)
    inside = (s >= begin - near) & (s <= end + near)
    free = inside & ((s > s[0]) | (s[0] == 0.0) | (impact.left_end == "free"))
    free &= (s < s[-1]) | (impact.right_end == "free")
    return free, np.where(inside[1:] & inside[:-1], np.diff(s), 0.0)
