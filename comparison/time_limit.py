"""How fine a row may be where it has a time limit: told from coarser runs of the same row."""

from __future__ import annotations

from collections.abc import Callable

__all__ = ["affordable_refinement"]

FACTORS = (0.125, 0.25, 0.5)  # of the resolution asked for, tried in turn
GROWTH = 4.0  # of a run's time when elements and steps are halved


def affordable_refinement(seconds_at: Callable[[float], float], limit: float, runs: float) -> tuple[float, float]:
    """The largest factor of ⅛, ¼, ½ and 1 at which a row is expected to end within ``limit``, s, and the seconds that
    the row is expected to take at 1.

    seconds_at : runs once at a factor of the resolution and returns the seconds it took. runs : of a row, in units of
    its finest run.
    """
    spent = 0.0
    for factor in FACTORS:
        taken = seconds_at(factor)
        spent += taken
        expected = GROWTH * taken * runs  # of a row at twice this factor
        if spent + expected > limit:
            return factor, taken * runs / factor**2
    return 1.0, expected
