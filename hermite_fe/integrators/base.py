"""The base class of time integrators: their instants, and the interface that takes steps."""

import dataclasses
import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, Self

import numpy as np

from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from bent_beam.impact import Impact
from hermite_fe.compiled import Array
from hermite_fe.stepping import Problem, State

MAXIMUM_STEPS = 20_000_000
MOST_WORK = 1e11  # steps x nodes: one to four hours
Reached = tuple[int, int]  # what :meth:`Integrator.advance` returns


@dataclass(frozen=True)
class Integrator(Part, ABC):
    """Base of the integrators: steps h = max(time_step, growth·t), adjusted down so that they end at the end time.

    With growth every decade of a self-similar motion takes the same number of steps.

    holds : whether the scheme supports the hold (:mod:`hermite_fe.contacts`); holds_zone : whether that of the whole
        zone, as in runs that measure what a pressing load changes, is stable.
    rebounds : whether it has an impact law, for restitution. damped : whether it takes damping.
    moves_mass : whether it lays out masses of its own, so that those of :mod:`hermite_fe.masses` have no effect.
    elastic : whether it is for a wall that gives way (:mod:`hermite_fe.elastic_wall`), and not for a rigid one.
    hysteretic : whether it steps Maxwell branches (:mod:`hermite_fe.maxwell`).
    elements_in_first_front : a chosen first step (:mod:`hermite_fe.resolution`) ends when the front is so many smallest
        elements thick. More than one, which is a long step, is for schemes that close many nodes at once without
        rebound.
    """

    where: ClassVar[str] = "hermite.integrator"
    holds: ClassVar[bool] = False
    holds_zone: ClassVar[bool] = False
    rebounds: ClassVar[bool] = True
    damped: ClassVar[bool] = True
    moves_mass: ClassVar[bool] = False
    elastic: ClassVar[bool] = False
    hysteretic: ClassVar[bool] = False
    elements_in_first_front: ClassVar[float] = 0.03

    time_step: Annotated[float | None, Quantity("s", "smallest step", above=0.0)] = None
    growth: Annotated[
        float | None, Quantity("", "step over time since impact", least=0.0, absent="chosen; 0 with a time_step")
    ] = None

    @property
    def sticks(self) -> bool:
        """Whether closed constraints may have a strength: what has landed rests on the wall in the next step."""
        return False

    def with_steps(self, time_step: float, growth: float) -> Self:
        """A copy whose unset steps are these."""
        if self.time_step is not None:
            time_step, growth = self.time_step, 0.0
        return dataclasses.replace(self, time_step=time_step, growth=growth if self.growth is None else self.growth)

    def with_defaults(self, impact: Impact, end_time: float | None) -> Self:
        """A copy with all other unset choices made for ``impact`` and a run to ``end_time`` (s; ``None``: until it has
        left); itself where there are none."""
        return self

    def refined(self, factor: float) -> Self:
        """A copy with steps ``factor`` times shorter; what is unset stays unset."""
        steps = {"time_step": self.time_step, "growth": self.growth}
        return dataclasses.replace(self, **{name: step / factor for name, step in steps.items() if step is not None})

    def instants(self, end_time: float) -> Array:
        """All instants from 0 to ``end_time``, s, shape (steps + 1,). ``time_step`` must be set."""
        if self.time_step is None:
            raise InputError("hermite.integrator.time_step is not chosen yet")
        step, growth = self.time_step, self.growth or 0.0
        switch = end_time if growth == 0.0 else min(end_time, step / growth)
        even = switch / step
        grown = math.log(end_time / switch) / math.log1p(growth) if switch < end_time else 0.0
        if not even + grown <= MAXIMUM_STEPS:
            raise InputError(
                f"a run to t = {end_time:.4g} s takes {even + grown:.3g} steps, and {MAXIMUM_STEPS:.2g} are the most: "
                f"give an earlier end, or a longer hermite.integrator.time_step (it is {step:.4g} s, growth {growth:g})"
            )
        times = np.linspace(0.0, switch, max(1, math.ceil(even * (1.0 - 1e-12))) + 1)
        if switch < end_time:
            count = max(1, math.ceil(grown * (1.0 - 1e-12)))
            times = np.concatenate([times, switch * (end_time / switch) ** (np.arange(1, count + 1) / count)])
        times[-1] = end_time
        return times

    @abstractmethod
    def start(self, problem: Problem, state: State) -> Any:
        """The memory of the scheme and its work arrays; called once, at t = 0.

        Raises ``ValueError`` where the scheme cannot take the problem.
        """

    @abstractmethod
    def advance(self, problem: Problem, state: State, memory: Any, times: Array, first: int, last: int) -> Reached:
        """Take steps ``first`` … ``last`` − 1 between the instants ``times`` in place. Returns a status of
        :mod:`hermite_fe.active_set` and the step reached: SOLVED and ``last`` when all went well."""
