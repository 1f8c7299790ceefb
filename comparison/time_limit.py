"""A time limit of a row: how fine the row may be, and a clock that its runs ask between their steps."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

from bent_beam.errors import TimeLimitError

__all__ = ["Clock", "TimeLimitError", "affordable_refinement"]

FACTORS = (0.125, 0.25, 0.5)  # of the resolution asked for, tried in turn
GROWTH = 6.0  # of a run's time when elements and steps are halved: 4, and half as much for a busy machine


@dataclass
class Clock:
    """The time that the runs of one row have taken, s. ``limit`` : s, of all of them."""

    limit: float
    spent: float = 0.0

    def progress(self) -> Callable[[float], None]:
        """What a run calls between its steps; raises :class:`TimeLimitError` beyond the limit.

        Its time counts from the first call on: what is imported and compiled before does not.
        """
        last: float | None = None

        def ask(_: float) -> None:
            nonlocal last
            now = time.perf_counter()
            self.spent += 0.0 if last is None else now - last
            last = now
            if self.spent > self.limit:
                raise TimeLimitError(f"time limit: not finished after {self.limit:g} s")

        return ask


def affordable_refinement(seconds_at: Callable[[float], float], limit: float, runs: float) -> tuple[float, float]:
    """The largest factor of ⅛, ¼, ½ and 1 at which a row is expected to end within ``limit``, s, and the seconds that
    the row is expected to take at 1.

    seconds_at : runs once at a factor of the resolution and returns the seconds it took. runs : of a row, in units of
    its finest run. Raises :class:`TimeLimitError` when the row takes longer at ⅛, too.
    """
    spent = 0.0
    for factor in FACTORS:
        taken = seconds_at(factor)
        spent += taken
        if factor == FACTORS[0] and taken * runs > limit:
            raise TimeLimitError(
                f"time limit: {taken * runs:.2g} s at {factor:g} times the resolution, more than {limit:g} s; "
                "give a larger --limit or a coarser mesh"
            )
        at_full = taken * runs / factor**2
        if spent + GROWTH * taken * runs > limit:
            return factor, at_full
    return 1.0, at_full
