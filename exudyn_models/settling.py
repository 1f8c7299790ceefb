"""When a step's contact state has settled: the judge of Exudyn's discontinuous iterations.

Exudyn solves a step with a guess of which connectors are closed, looks at the gaps, and repeats it with the state that
they show. Its own nodal contact compares that state with the one at the *start* of the step
(docs/exudyn_contact_state.md), this judge with the one that the solution *assumed*. Where the contact has a law of its
own (``imposes``: closed is what pushes), that decides, and the states are written over Exudyn's.

Where they agree, but for forces below the tolerance, the step is accepted. Else it is repeated, by three rules in turn
(as in the Hermite path: Júdice & Pires 1994, Comput. Oper. Res. 21, 587):

1. all connectors follow their gaps at once;
2. when ``BLOCK`` repetitions have not made fewer contradict theirs, the one with the largest force is switched;
3. after ``PERSISTENCE`` repetitions more, the last one (Murty's rule).

As soon as fewer contradict, the first rule is back. The first two may circle although a state is consistent: where a
state comes back that this step has already tried, the next rule is taken at once. Where one comes back under the third,
no state is taken to be consistent: the one of that circle that contradicts itself least is accepted, and counted. When
the repetitions run out before, the step is not solved.
"""

import math
from typing import Any

import numpy as np

from exudyn_models.contacts import ContactRun
from exudyn_models.contacts.base import TINY
from exudyn_models.geometry import Flags

BLOCK, PERSISTENCE = 15, 60  # repetitions
ANY = 1e300  # no measure of Exudyn's own is above


class Settling:
    """Exudyn's ``PostNewtonUserFunction`` for one run (implicit integrators).

    iterations : most repetitions of a step; tolerance : force, model units. Exudyn's own tolerance is :data:`ANY`.
    steps, cycles, unsettled : steps seen, those accepted though no contact state was consistent, and those that ran
        out of repetitions; first : what happened in the first of these.
    """

    def __init__(self, contact: ContactRun, iterations: int, tolerance: float) -> None:
        self.steps = self.cycles = self.unsettled = 0
        self._contact = contact
        self._iterations, self._tolerance = iterations, tolerance
        self._time: float | None = None
        self._repetitions = 0
        self._fewest = math.inf  # contradictions in this step
        self._patience = BLOCK  # repetitions until only one follows its gap
        self._doubtful: Flags | None = None  # connectors whose state this step has had to correct
        self._tried: dict[bytes, float] = {}  # what was assumed of them, and by how much it contradicted itself
        self._cycling = False
        self._imposed: Flags | None = None
        self.first = ""

    def __call__(self, mbs: Any, time: float) -> list[float]:
        if time != self._time:
            self._time, self._repetitions, self._doubtful = time, 0, None
            self._fewest, self._patience = math.inf, BLOCK
            self.steps += 1
        self._repetitions += 1
        data, closed = mbs.systemData, self._imposed
        if closed is None:
            closed = data.GetDataCoordinates()[:: self._contact.states] <= 0.0
        q, v = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
        if self._contact.imposes and np.array_equal(self._contact.closed_by(q, v), closed):
            return self._accept(mbs, closed)
        wrong = self._contact.contradictions(q, v, closed)
        force = float(wrong.max(initial=0.0))
        if force <= self._tolerance:
            return self._accept(mbs, closed)
        doubtful = wrong > self._tolerance
        if self._returns(closed, doubtful, force):
            self.cycles += 1
            return self._accept(mbs, closed)
        if self._repetitions >= self._iterations:
            self.unsettled += 1
            self.first = self.first or (
                f"the contact state of a step had not settled after {self._iterations} repetitions: "
                f"{doubtful.sum()} contact points contradict their gaps by up to "
                f"{force / self._tolerance:.3g} contact_tolerance"
            )
            self._follow(mbs)
        elif not self._all_at_once(int(doubtful.sum())):
            by_force = self._patience > -PERSISTENCE
            single = closed.copy()
            single[np.argmax(wrong) if by_force else np.flatnonzero(doubtful)[-1]] ^= True
            self._set(mbs, single)
        elif self._contact.imposes:
            self._set(mbs, np.where(doubtful, ~closed, closed))
        else:
            self._follow(mbs)
        return [math.inf, -1.0]

    def _all_at_once(self, contradictions: int) -> bool:
        """Whether all connectors follow their gaps in the next repetition, or only one that contradicts its own."""
        before, self._patience = self._patience, self._patience - 1
        if contradictions < self._fewest:
            self._fewest, self._patience = contradictions, BLOCK
        if (before > 0) != (self._patience > 0) or self._patience == -PERSISTENCE:
            self._forget()  # under another rule a state may well come back
        return self._patience > 0

    def _returns(self, closed: Flags, doubtful: Flags, force: float) -> bool:
        """Whether this is the least contradictory of states that come back again and again; else it is remembered."""
        if self._doubtful is None or (doubtful & ~self._doubtful).any():
            # a state is told by the connectors that were corrected alone: others hover at the wall without force
            self._doubtful = doubtful if self._doubtful is None else doubtful | self._doubtful
            self._forget()
        state = closed[self._doubtful].tobytes()
        if state in self._tried and self._patience > -PERSISTENCE:
            self._patience = 0 if self._patience > 0 else -PERSISTENCE
            self._forget()
        elif state in self._tried:
            while not self._cycling and next(iter(self._tried)) != state:
                del self._tried[next(iter(self._tried))]  # what led into the cycle, never to return
            self._cycling = True
            if state == min(self._tried, key=self._tried.__getitem__):
                return True
        self._tried[state] = force
        return False

    def _forget(self) -> None:
        """No state counts as tried."""
        self._tried, self._cycling = {}, False

    def _set(self, mbs: Any, closed: Flags) -> None:
        """Assume ``closed`` in the next repetition, whatever the gaps show."""
        if self._imposed is None:
            mbs.SetPreNewtonResidualUserFunction(self._impose)
        self._imposed = closed
        mbs.solverSignalJacobianUpdate = True

    def _impose(self, mbs: Any, time: float, newton_step: int, repetition: int) -> None:
        """Exudyn's ``PreNewtonResidualUserFunction``: the state to assume instead of what the last gaps showed."""
        if newton_step == 0 and self._imposed is not None:
            data = mbs.systemData.GetDataCoordinates()
            data[:: self._contact.states] = np.where(self._imposed, -TINY, TINY)
            mbs.systemData.SetDataCoordinates(data)

    def _follow(self, mbs: Any) -> None:
        """All connectors follow their gaps again."""
        if self._imposed is not None:
            self._imposed = None
            mbs.SetPreNewtonResidualUserFunction(0)

    def _accept(self, mbs: Any, closed: Flags) -> list[float]:
        """No further repetition: whatever Exudyn's own measure says, it is below :data:`ANY`."""
        if not self._contact.imposes:
            self._contact.assumed = mbs.systemData.GetDataCoordinates()
            self._follow(mbs)
        elif self._imposed is None:
            self._set(mbs, closed)
        else:
            self._imposed = closed
        return [0.0, -1.0]
