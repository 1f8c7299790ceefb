"""Exudyn's solver, run in segments of equal steps, its state vectors read after each step.

The segments are planned before the run (:mod:`exudyn_models.segments`); those of a whole beam are laid as it goes, for
its steps grow with the smallest gap while it is off the wall. A new segment costs a factorisation, a reading a
hundredth of one.
"""

import logging
import math
import time as clock
from collections.abc import Callable, Iterator
from dataclasses import is_dataclass
from typing import Any

import exudyn as exu
import numpy as np

from bent_beam.checks import MOST_INSTANTS, affordable, between, whole
from bent_beam.errors import InputError
from bent_beam.fields import describe
from bent_beam.method import Progress, Save, checked_times
from exudyn_models.assembly import Chosen, Layout, assemble, settings_of, stable_step
from exudyn_models.geometry import Array
from exudyn_models.recording import Recorder
from exudyn_models.segments import Segment
from exudyn_models.settling import ANY, Settling
from exudyn_models.solvers import open_viewer, wait_until_closed

MOST_NODES = 200_000  # Exudyn takes 10 kB for each: 2 GB
MOST_WORK = 2e9  # steps x nodes: some hours
SECONDS = 5e-6  # a step and node, measured with 200 to 240
LONG = 60.0  # s: a run that will take longer says so before it starts
FLIGHT_BLOCK, WALL_BLOCK = 10, 40  # steps in flight, and near the wall, until the gap is looked at again
CLEAR = 2.0  # a block ends before the fastest node of the beam could pass the smallest gap over this
BETWEEN = 200  # steps between two reports of progress

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


def saved_times(save: Save, end: float) -> Array:
    """The times to save in units of ``end``, ascending, after 0. Raises ``ValueError``."""
    if np.ndim(save) == 0:
        count = int(between("save", whole("save", save, 1), 1, MOST_INSTANTS))  # type: ignore[arg-type]
        return np.asarray((np.arange(1, count + 1) / count) ** 2)
    times = checked_times(save, end) / end
    if not times.any():
        raise InputError("save must hold a time after 0")
    return np.minimum(times[times > 0.0], 1.0)


class Stepping:
    """A run under way, and Exudyn's ``PostStepUserFunction``: it reads every step, saves the state where asked and lets
    the contact switch connectors.

    targets : times to save, model units; each is saved at the first end of a step at or after it, the run ends with
        the last. until, progress : see :func:`exudyn_models.simulate`.
    run : the recorder; segments, flight, stable : the steps, those of a beam far off the wall (0: alike), and the
        longest that an explicit integrator bears, model units.
    layout, chosen : as they are given; saved : how many targets; left : whether ``until`` has ended the run.
    steps : done; seconds : inside Exudyn; failure : what failed, ``None`` when nothing did; advice : what to try then.

    Raises ``ValueError`` for more work than one run takes.
    """

    def __init__(
        self, layout: Layout, chosen: Chosen, targets: Array, progress: Progress | None, until: Until | None
    ) -> None:
        scaling, integrator, nodes = layout.scaling, chosen.integrator, layout.shape.s.size
        if nodes > MOST_NODES:
            raise InputError(
                f"mesh: {nodes} nodes on the Exudyn path, {MOST_NODES} are the most (memory); larger elements"
            )
        beam, contact = assemble(layout, chosen)
        self.run = Recorder(beam, contact, not chosen.full_beam, integrator.averages())
        self.stable = stable_step(beam, contact, integrator)
        crossing = min(0.01, (layout.places[1] / scaling.front) ** 2)
        self.segments = integrator.segments(crossing, scaling.end_time, self.stable)
        self.flight = (getattr(integrator, "flight_step", None) or 0.0) / scaling.end_time
        steps = sum(segment.steps for segment in self.segments)
        last = float(targets[-1])
        if until is not None:  # most beams have left after a T*
            last = min(last, scaling.impact.slow_time_scale / scaling.end_time)
        steps = round(steps * last)
        affordable("exudyn.integrator and mesh", steps, nodes, targets.size, MOST_WORK)
        if (expected := SECONDS * steps * nodes) > LONG:
            so_long = "up to" if self.flight else "about"
            log = logging.getLogger("bent_beam")
            log.warning("%s %.2g minutes: %d steps of %d nodes", so_long, expected / 60.0, steps, nodes)
        self.settings = settings_of(chosen, beam, contact)
        self.solver: Any = exu.MainSolverExplicit() if integrator.explicit else exu.MainSolverImplicitSecondOrder()
        self.settling: Settling | None = None  # explicit steps are not repeated
        if contact.iterated and not integrator.explicit:
            judged = self.settings.timeIntegration.discontinuous
            self.settling = Settling(contact, judged.maxIterations, judged.iterationTolerance)
            judged.iterationTolerance = ANY
        self.layout, self.chosen = layout, chosen
        self.targets, self.progress, self.until = targets, progress, until
        self.steps, self.seconds = 0, 0.0
        self.failure: str | None = None
        self.advice = ADVICE
        self._time = self._step = 0.0  # of the last step, model units
        self.saved, self.left = 0, False
        self._error: BaseException | None = None

    def settings_of_run(self) -> dict[str, Any]:
        """The parts and what was chosen with them, JSON-ready; times in s, lengths in m."""
        scaling, settling = self.layout.scaling, self.settling
        found: dict[str, Any] = {n: describe(part) for n, part in vars(self.chosen).items() if is_dataclass(part)}
        springs = scaling.impact.wall_stiffness is not None  # a contact that cannot be asked for
        found["contact"] = None if springs else found["contact"] | self.run.contact.chosen
        if math.isfinite(self.stable):
            found["stable_step"] = self.stable * scaling.end_time
        if settling is not None:
            found |= {"contact_cycles": settling.cycles, "unsettled_steps": settling.unsettled}
        return found | {
            "full_beam": self.chosen.full_beam,
            "hold": self.run.hold(),
            "nodes": int(self.layout.shape.s.size),
            "modelled_half_length": float(self.layout.half_length),
            "amplitude": scaling.amplitude,
            "amplitude_of_the_real_beam": scaling.true_amplitude,
            "ends": "moment and shear of the free motion" if self.layout.ends_follow else "free",
            "first_step": self.segments[0].length * scaling.end_time,
            "last_step": (self._step or self.segments[-1].length) * scaling.end_time,
        }

    @property
    def _over(self) -> bool:
        return self.left or self.saved == self.targets.size

    @property
    def _unsettled(self) -> bool:
        """Whether a step has ended with contacts that must settle and did not."""
        unsettled = self.settling is not None and self.settling.unsettled > 0
        return unsettled and bool(self.chosen.solver.contact_must_settle)

    def __call__(self, mbs: Any, time: float) -> bool:
        try:
            return self._read(mbs, time)
        except BaseException as error:  # Exudyn would turn it into an error of its own
            self._error = error
            return False

    def _read(self, mbs: Any, time: float) -> bool:
        if self._unsettled:
            return False
        run = self.run
        if time <= self._time:  # Exudyn calls at the start of a segment, too
            return True
        q, v = run.read(time)
        self._time, self._state = time, (q, v)
        self.steps += 1
        if time >= self.targets[self.saved] * (1.0 - 1e-9):
            run.save(q)
            self.saved = int(np.searchsorted(self.targets, time * (1.0 + 1e-9), side="right"))
            self.left = self.until is not None and self.until(run, time, q, v)
        if self.progress is not None and (self.steps % BETWEEN == 0 or self.saved == self.targets.size):
            self.progress(min(1.0, time / self.targets[-1]))
        if self._over:
            return False
        if run.contact.between(time, self._step, q, v):
            mbs.solverSignalJacobianUpdate = True
        return True

    def through(self, view: bool) -> None:
        """Take all steps, or those up to a failure, which is kept; watched where asked for. The Exudyn system is given
        up at the end.

        Raises what the user's functions raise, and ``KeyboardInterrupt``.
        """
        mbs = self.run.beam.mbs
        container = mbs.variables["container"]
        viewing = view and open_viewer(container)
        try:
            self._all_segments(mbs)
            if viewing:
                wait_until_closed(container)
        finally:
            if viewing:
                container.renderer.Stop()
            mbs.SetPostNewtonUserFunction(0)
            mbs.SetPreNewtonResidualUserFunction(0)
            mbs.variables.clear()  # container and functions hold the system: break the circle, or it is never freed

    def _all_segments(self, mbs: Any) -> None:
        if self.settling is not None:
            mbs.SetPostNewtonUserFunction(self.settling)
        try:
            if self._started(self.segments[0]):
                mbs.SetPostStepUserFunction(self)
                for segment in self._in_flight() if self.flight else self.segments:
                    self._step_through(segment)
                    if self.failure is not None or self._over:
                        break
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
        run = self.run
        first.lay(self.settings.timeIntegration)
        began = clock.perf_counter()
        if not self.solver.InitializeSolver(run.beam.mbs, self.settings):
            self.failure = "Exudyn could not initialise"
            return False
        self.seconds += clock.perf_counter() - began
        q, v = run.read(0.0)
        run.save(q)
        run.contact.between(0.0, first.length, q, v)
        return True

    def _in_flight(self) -> Iterator[Segment]:
        """Segments whose steps grow with the smallest gap, from those near the wall up to ``flight``."""
        vertical, short, step, t = self.run.beam.vertical, self.segments[0].length, 0.0, 0.0
        while t < 1.0 - 1e-9:
            step = min(max(short, step), self.flight)
            count = math.ceil(min(FLIGHT_BLOCK if step > short else WALL_BLOCK, (1.0 - t) / step) - 1e-9)
            start, t = t, min(t + count * step, 1.0)
            yield Segment(start, t, count)
            q, v = self._state
            step = -float(self.run.contact.depth(q).max()) / (CLEAR * FLIGHT_BLOCK * float(np.abs(v[vertical]).max()))

    def _step_through(self, segment: Segment) -> None:
        segment.lay(self.settings.timeIntegration, self.solver.it)
        self._step = segment.length
        began = clock.perf_counter()
        solved = self.solver.SolveSteps(self.run.beam.mbs, self.settings)
        self.seconds += clock.perf_counter() - began
        if self._error is not None:
            raise self._error
        if not solved and not self._over:
            self._failed(str(self.solver.GetErrorString()))
        elif self.settling is not None and self._unsettled:
            self.failure, self.advice = self.settling.first, UNSETTLED

    def _failed(self, message: str) -> None:
        """What Exudyn says of a run that it ended; an interrupt by the user within a user function is no failure."""
        if KeyboardInterrupt.__name__ in message:
            raise KeyboardInterrupt
        self.failure = "Exudyn's solver failed: " + " ".join(message.split())[:200]
