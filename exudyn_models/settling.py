"""When a step's contact state has settled: the judge of Exudyn's discontinuous iterations.

Exudyn solves a step with a guess of which connectors are closed, looks at the gaps, and repeats it with the state that
they show. Its own nodal contact compares that state with the one at the *start* of the step: a step with a capture
repeats until its repetitions run out, settled or not, and a node that hovers at the wall is accepted as soon as it is
back where it began. Here the state that a solution *assumed* is compared with the one that its gaps show:

- they agree, but for forces below the tolerance: the step is accepted at once;
- a state comes back that this step had already tried: none is consistent, for the damping of the contact acts all at
  once when the gap closes and may stop a node that barely touches short of the wall. Of the states that return, the
  one that contradicts itself least is accepted, and counted;
- the repetitions run out before either: the step is not solved.
"""

from __future__ import annotations

from typing import Any

from exudyn_models.contacts import ContactRun

__all__ = ["Settling"]


class Settling:
    """Exudyn's ``PostNewtonUserFunction`` for one run (implicit integrators).

    iterations : most repetitions of a step; tolerance : force, model units; must_settle : whether the run is to fail
        when they run out.
    steps, cycles, unsettled : steps seen, those accepted though no contact state was consistent, and those that ran
        out of repetitions.
    """

    def __init__(
        self, contact: ContactRun, solver: Any, iterations: int, tolerance: float, must_settle: bool
    ) -> None:
        self.must_settle = must_settle
        self.steps = self.cycles = self.unsettled = 0
        self._contact, self._solver = contact, solver
        self._iterations, self._tolerance = iterations, tolerance
        self._time: float | None = None
        self._tried: dict[bytes, float] = {}  # states assumed in this step, and their contradictions
        self._repetitions = 0
        self._cycling = False
        self._first = ""

    def __call__(self, mbs: Any, time: float) -> list[float]:
        if time != self._time:
            self._time, self._tried, self._repetitions, self._cycling = time, {}, 0, False
            self.steps += 1
        self._repetitions += 1
        data = mbs.systemData
        assumed, wrong = self._contact.contradictions(data.GetODE2Coordinates(), data.GetDataCoordinates())
        force = float(wrong.max(initial=0.0))
        if force <= self._tolerance:
            return self._accept()
        state = assumed.tobytes()
        if state in self._tried:
            while not self._cycling and next(iter(self._tried)) != state:
                del self._tried[next(iter(self._tried))]  # what led into the cycle, never to return
            self._cycling = True
            if force <= min(self._tried.values()) * (1.0 + 1e-6):
                self.cycles += 1
                return self._accept()
        self._tried[state] = force
        if self._repetitions >= self._iterations:
            self.unsettled += 1
            self._first = self._first or (
                f"the contact state of a step had not settled after {self._iterations} repetitions: "
                f"{(wrong > self._tolerance).sum()} contact points contradict their gaps by up to "
                f"{force / self._tolerance:.3g} contact_tolerance"
            )
        return [force, -1.0]

    def failure(self) -> str:
        """What happened in the first step that ran out of repetitions."""
        return self._first

    def _accept(self) -> list[float]:
        """No further repetition, whatever Exudyn's own measure says: it goes on when they are used up."""
        self._solver.it.discontinuousIteration = self._iterations - 1
        return [0.0, -1.0]
