"""Exact solutions of simpler impacts, the rungs below the beam, one thing to get right on each.

A ball (restitution, infinitely many impacts), a bar (a wave, contact that lasts), a string (contact everywhere at
once), and the stopped beam (bending waves, one fixed point: `theory.stopped_beam`). The bent beam's moving front is
`theory.similarity`.
"""

from theory.ladder.ball import BouncingBall
from theory.ladder.bar import DroppedBar, FlyingBar, ReleasedBar
from theory.ladder.string import StringOnObstacle

__all__ = ["BouncingBall", "DroppedBar", "FlyingBar", "ReleasedBar", "StringOnObstacle"]
