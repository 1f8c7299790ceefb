"""Exudyn's solver, run in segments of equal steps, its state vectors read after each step.

Every new segment costs a factorisation, every reading a hundredth of one.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np

from exudyn_models.arrays import Array
from exudyn_models.integrators.base import Segment
from exudyn_models.recording import Recorder
from exudyn_models.settling import Settling

__all__ = ["Stepping", "Until"]

Until = Callable[[Recorder, float, Array, Array], bool]
"""Asked with the recorder, the time, q and v (model units): whether the run is to end."""

ADVICE = (
    "a smaller exudyn.integrator.relative_step (or time_step), a smaller spectral_radius, more contact damping "
    "(exudyn.contact.relative_damping), or a larger exudyn.solver.absolute_tolerance"
)
UNSETTLED = (
    "more exudyn.solver.contact_iterations, a smaller exudyn.integrator.relative_step (or time_step), or a larger "
    "exudyn.solver.contact_tolerance; exudyn.solver.contact_must_settle = false goes on regardless"
)


@dataclass
class Stepping:
    """A run under way, and Exudyn's ``PostStepUserFunction``: it reads every step, saves the state where asked and lets
    the contact switch connectors.

    segments, stable : the steps, and the longest that an explicit integrator bears, model units.
    settings, solver : Exudyn's.
    targets : times to save, model units; each is saved at the first end of a step at or after it.
    until, progress : see :func:`exudyn_models.simulate`.
    steps : done; seconds : inside Exudyn; failure : what failed, ``None`` when nothing did; advice : what to try then.
    time, step : of the last step, model units; saved : targets; left : ``until`` has ended the run.
    """

    run: Recorder
    segments: list[Segment]
    stable: float
    settings: Any
    solver: Any
    settling: Settling | None
    targets: Array
    progress: Callable[[float], object] | None = None
    until: Until | None = None
    steps: int = 0
    seconds: float = 0.0
    failure: str | None = None
    advice: str = ADVICE
    time: float = 0.0
    step: float = 0.0
    saved: int = 0
    left: bool = False
    error: BaseException | None = None

    @property
    def unsettled(self) -> bool:
        """Whether a step has ended with contacts that must settle and did not."""
        return self.settling is not None and self.settling.must_settle and self.settling.unsettled > 0

    def __call__(self, mbs: Any, time: float) -> bool:
        try:
            return self._read(mbs, time)
        except BaseException as error:  # Exudyn would turn it into an error of its own
            self.error = error
            return False

    def _read(self, mbs: Any, time: float) -> bool:
        if self.unsettled:
            return False
        run = self.run
        if time <= self.time:  # Exudyn calls at the start of a segment, too
            return True
        q, v = run.read(time, None if self.settling is None else self.settling.solution)
        self.time = time
        self.steps += 1
        if self.saved < self.targets.size and time >= self.targets[self.saved] * (1.0 - 1e-9):
            run.save(time, q, v)
            self.saved = int(np.searchsorted(self.targets, time * (1.0 + 1e-9), side="right"))
            if self.progress is not None:
                self.progress(time)
            self.left = self.until is not None and self.until(run, time, q, v)
            if self.left:
                return False
        if run.contact.between(time, self.step, q, v):
            mbs.solverSignalJacobianUpdate = True
        return True

    def through(self) -> None:
        """Take all steps, or those up to a failure, which is kept.

        Raises what the user's functions raise, and ``KeyboardInterrupt``.
        """
        mbs = self.run.beam.mbs
        if self.settling is not None:
            mbs.SetPostNewtonUserFunction(self.settling)
        try:
            if self._started(self.segments[0]):
                mbs.SetPostStepUserFunction(self)
                for segment in self.segments:
                    if self.failure is None and not self.left:
                        self._step_through(segment)
        except FloatingPointError as error:
            self.failure = str(error)
        except SystemError as error:  # what was raised while Exudyn ran, an interrupt by the user above all
            raise (error.__cause__ or error) from None
        except (exu.ExudynError, RuntimeError) as error:
            self._failed(str(error))
        finally:
            mbs.SetPostStepUserFunction(0)
            self.run.sum_up()

    def _started(self, first: Segment) -> bool:
        """Whether Exudyn took the system; the state at t = 0 is then read and saved."""
        time, run = self.settings.timeIntegration, self.run
        time.startTime, time.endTime, time.numberOfSteps = first.start, first.end, first.steps
        began = clock.perf_counter()
        if not self.solver.InitializeSolver(run.beam.mbs, self.settings):
            self.failure = "Exudyn could not initialise"
            return False
        self.seconds += clock.perf_counter() - began
        q, v = run.read(0.0)
        run.save(0.0, q, v)
        run.contact.between(0.0, first.length, q, v)
        return True

    def _step_through(self, segment: Segment) -> None:
        time, it, size = self.settings.timeIntegration, self.solver.it, segment.length
        self.step = size
        time.startTime, time.endTime, time.numberOfSteps = segment.start, segment.end, segment.steps
        it.startTime, it.endTime, it.numberOfSteps = segment.start, segment.end, segment.steps
        it.currentStepSize = it.initialStepSize = it.maxStepSize = size
        time.minimumStepSize = it.minStepSize = size * 1e-3
        began = clock.perf_counter()
        solved = self.solver.SolveSteps(self.run.beam.mbs, self.settings)
        self.seconds += clock.perf_counter() - began
        if self.error is not None:
            raise self.error
        if not solved and not self.left:
            self._failed(str(self.solver.GetErrorString()))
        elif self.settling is not None and self.unsettled:
            self.failure, self.advice = self.settling.failure(), UNSETTLED

    def _failed(self, message: str) -> None:
        """What Exudyn says of a run that it ended; an interrupt by the user within a user function is no failure."""
        if KeyboardInterrupt.__name__ in message:
            raise KeyboardInterrupt
        self.failure = "Exudyn's solver failed: " + " ".join(message.split())[:200]
