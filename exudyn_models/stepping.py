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

__all__ = ["Stepping", "Until", "step_through"]

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
    """How far a run has come. seconds : inside Exudyn; failure : what failed, None when nothing did; advice : try."""

    steps: int = 0
    seconds: float = 0.0
    failure: str | None = None
    advice: str = ADVICE

    def failed(self, failure: str, advice: str = ADVICE) -> Stepping:
        self.failure, self.advice = failure, advice
        return self


class _Reader:
    """Exudyn's ``PostStepUserFunction``: reads every step, saves the state where asked, switches connectors."""

    def __init__(
        self,
        run: Recorder,
        targets: Array,
        done: Stepping,
        settling: Settling | None,
        progress: Callable[[float], object] | None,
        until: Until | None,
    ) -> None:
        self.run, self.targets, self.done, self.settling = run, targets, done, settling
        self.progress, self.until = progress, until
        self.time = 0.0
        self.step = 0.0  # of the running segment
        self.saved = 0
        self.left = False
        self.error: BaseException | None = None

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
        self.done.steps += 1
        if self.saved < self.targets.size and time >= self.targets[self.saved] * (1.0 - 1e-9):
            run.save(time, q, v)
            self.saved = int(np.searchsorted(self.targets, time * (1.0 + 1e-9), side="right"))
            if self.progress is not None:
                self.progress(time)
            if self.until is not None and self.until(run, time, q, v):
                self.left = True
                return False
        if run.contact.between(time, self.step, q, v):
            mbs.solverSignalJacobianUpdate = True
        return True


def _failed(done: Stepping, message: str) -> Stepping:
    """What Exudyn says of a run that it ended; an interrupt by the user within a user function is no failure."""
    if KeyboardInterrupt.__name__ in message:
        raise KeyboardInterrupt
    return done.failed("Exudyn's solver failed: " + " ".join(message.split())[:200])


def step_through(
    run: Recorder,
    segments: list[Segment],
    settings: Any,
    solver: Any,
    settling: Settling | None,
    targets: Array,
    progress: Callable[[float], object] | None,
    until: Until | None = None,
) -> Stepping:
    """Run all segments and save at the first end of a segment at or after each of ``targets`` (model units)."""
    mbs, time, done = run.beam.mbs, settings.timeIntegration, Stepping()
    if settling is not None:
        mbs.SetPostNewtonUserFunction(settling)
    reader = _Reader(run, targets, done, settling, progress, until)
    try:
        first = segments[0]
        time.startTime, time.endTime, time.numberOfSteps = first.start, first.end, first.steps
        began = clock.perf_counter()
        if not solver.InitializeSolver(mbs, settings):
            return done.failed("Exudyn could not initialise")
        done.seconds += clock.perf_counter() - began
        q, v = run.read(0.0)
        run.save(0.0, q, v)
        run.contact.between(0.0, first.length, q, v)
        mbs.SetPostStepUserFunction(reader)
        for segment in segments:
            size = reader.step = segment.length
            time.startTime, time.endTime, time.numberOfSteps = segment.start, segment.end, segment.steps
            time.minimumStepSize = size * 1e-3
            it = solver.it
            it.startTime, it.endTime, it.numberOfSteps = segment.start, segment.end, segment.steps
            it.currentStepSize = it.initialStepSize = it.maxStepSize = size
            it.minStepSize = size * 1e-3
            began = clock.perf_counter()
            solved = solver.SolveSteps(mbs, settings)
            done.seconds += clock.perf_counter() - began
            if reader.error is not None:
                raise reader.error
            if not solved and not reader.left:
                return _failed(done, str(solver.GetErrorString()))
            if settling is not None and reader.unsettled:
                return done.failed(settling.failure(), UNSETTLED)
            if reader.left:
                return done
    except FloatingPointError as error:
        return done.failed(str(error))
    except SystemError as error:  # what was raised while Exudyn ran, an interrupt by the user above all
        raise (error.__cause__ or error) from None
    except (exu.ExudynError, RuntimeError) as error:
        return _failed(done, str(error))
    finally:
        mbs.SetPostStepUserFunction(0)
        run.sum_up()
    return done
