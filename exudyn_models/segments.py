"""The plan of time steps: segments of equal ones, each taken inside Exudyn without interruption."""

import math
from dataclasses import dataclass
from typing import Any

LEFT_BY_HALVING = 1e-3  # of a step, what halving it may leave
EVEN = 12.5  # steps of one length at least, while steps grow …
CHANGE = 1.05  # … or as many as it takes them to grow by this factor


@dataclass(frozen=True)
class Segment:
    """``steps`` equal time steps from ``start`` to ``end`` (model units), taken inside Exudyn without interruption."""

    start: float
    end: float
    steps: int

    @property
    def length(self) -> float:
        """Of one step."""
        return (self.end - self.start) / self.steps

    def lay(self, settings: Any, running: Any = None) -> None:
        """Set Exudyn's steps, nowhere else set: in its settings of the time integration, and in a solver that runs."""
        settings.minimumStepSize = LEFT_BY_HALVING * self.length
        for one in (settings, running) if running else (settings,):
            one.startTime, one.endTime, one.numberOfSteps = self.start, self.end, self.steps
        if running:
            running.currentStepSize = running.initialStepSize = running.maxStepSize = self.length
            running.minStepSize = settings.minimumStepSize


def growing_segments(first: float, relative: float) -> list[Segment]:
    """Segments over 0 ≤ t ≤ 1: steps of ``first``, then of ``relative``·t.

    A new step size costs a factorisation: it changes by ``CHANGE`` at a time, or by what ``EVEN`` steps make of it.
    """
    segments: list[Segment] = []
    t, step, change = 0.0, first, max(CHANGE, 1.0 + EVEN * relative)
    while t < 1.0 - 1e-12:
        count = max(1, math.ceil((change * step / relative - t) / step - 1e-9))
        end = t + count * step
        if end > 1.0 - step * 1e-6:
            count, end = max(1, round((1.0 - t) / step + 0.499)), 1.0
        segments.append(Segment(t, end, count))
        t, step = end, max(step, relative * end)
    return segments
