"""Exudyn's solver, run in segments of a few equal steps; between them its state vectors are read.

That costs some microseconds where a callback a step would cost the run.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import exudyn as exu
import numpy as np
from numpy.typing import NDArray

from exudyn_models.integrators.base import Segment
from exudyn_models.recording import Recorder
from exudyn_models.settling import Settling

__all__ = ["Stepping", "step_through"]

Array = NDArray[np.float64]

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


def step_through(
    run: Recorder,
    segments: list[Segment],
    settings: Any,
    solver: Any,
    settling: Settling | None,
    targets: Array,
    progress: Callable[[float], object] | None,
) -> Stepping:
    """Run all segments and save at the first end of a segment at or after each of ``targets`` (model units)."""
    mbs, time, done = run.beam.mbs, settings.timeIntegration, Stepping()
    if settling is not None:
        mbs.SetPostNewtonUserFunction(settling)
    try:
        first = segments[0]
        time.startTime, time.endTime, time.numberOfSteps = first.start, first.end, first.steps
        began = clock.perf_counter()
        if not solver.InitializeSolver(mbs, settings):
            return done.failed("Exudyn could not initialise")
        done.seconds += clock.perf_counter() - began
        q, v = run.read(0.0, 0.0)
        run.save(0.0, q, v)
        run.contact.between(0.0, first.length, q, v)
        saved = 0
        for segment, following in zip(segments, [*segments[1:], segments[-1]]):
            size = segment.length
            time.startTime, time.endTime, time.numberOfSteps = segment.start, segment.end, segment.steps
            time.minimumStepSize = size * 1e-3
            it = solver.it
            it.startTime, it.endTime, it.numberOfSteps = segment.start, segment.end, segment.steps
            it.currentStepSize = it.initialStepSize = it.maxStepSize = size
            it.minStepSize = size * 1e-3
            began = clock.perf_counter()
            solved = solver.SolveSteps(mbs, settings)
            done.seconds += clock.perf_counter() - began
            if not solved:
                return done.failed("Exudyn's solver failed: " + " ".join(str(solver.GetErrorString()).split())[:200])
            if settling is not None and settling.must_settle and settling.unsettled:
                return done.failed(settling.failure(), UNSETTLED)
            done.steps += segment.steps
            q, v = run.read(segment.end, segment.end - segment.start)
            if saved < targets.size and segment.end >= targets[saved] * (1.0 - 1e-9):
                run.save(segment.end, q, v)
                saved = int(np.searchsorted(targets, segment.end * (1.0 + 1e-9), side="right"))
                if progress is not None:
                    progress(segment.end)
            if run.contact.between(segment.end, following.length, q, v):
                mbs.solverSignalJacobianUpdate = True
    except FloatingPointError as error:
        return done.failed(str(error))
    except SystemError as error:  # what was raised while Exudyn ran, an interrupt by the user above all
        raise (error.__cause__ or error) from None
    except (exu.ExudynError, RuntimeError) as error:
        return done.failed("Exudyn's solver failed: " + " ".join(str(error).split())[:200])
    return done
