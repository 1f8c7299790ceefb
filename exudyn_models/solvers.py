"""Exudyn's nonlinear and linear solver settings, how to keep it from printing, and its viewer.

Newton's method is run modified (the Jacobian is kept while it converges) on a sparse factorisation whose pattern is
kept. Residuals are forces in model units, of the size of the amplitude.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Annotated, Any, ClassVar

import exudyn as exu

from bent_beam.fields import Part, Quantity

BLUE = [0.12, 0.35, 0.67, 1.0]


@dataclass(frozen=True)
class NewtonSolver(Part):
    """How each implicit step is solved.

    The absolute tolerance and that of the contact are in units of the model's amplitude, and raised to the round-off of
    contact, elastic, viscous and axial forces (:func:`exudyn_models.assembly.settings_of`) where that is larger.
    """

    where: ClassVar[str] = "exudyn.solver"

    absolute_tolerance: Annotated[float, Quantity("", "of the residual", above=0.0)] = 1e-8
    relative_tolerance: Annotated[float, Quantity("", "of the residual", above=0.0)] = 1e-5
    contact_tolerance: Annotated[
        float, Quantity("", "force below which a changed contact state does not repeat the step", above=0.0)
    ] = 1e-4
    iterations: Annotated[int, Quantity("", "largest number of Newton iterations a step", least=1)] = 25
    contact_iterations: Annotated[
        int, Quantity("", "largest number of repetitions of a step until its contact state has settled", least=1)
    ] = 300
    contact_must_settle: Annotated[
        bool, Quantity("", "fail when they run out; otherwise a warning counts the steps")
    ] = True
    halve_steps: Annotated[bool, Quantity("", "let Exudyn shorten a failed step (down to 1/1000)")] = False
    initial_accelerations: Annotated[
        bool, Quantity("", "start from the accelerations at t = 0 instead of from zero")
    ] = True

    def settings(self, amplitude: float, round_off: float, along: float) -> Any:
        """Fresh ``exudyn.SimulationSettings`` with these choices and no files; ``round_off`` of a force across the
        beam, and of one ``along`` it."""
        settings = exu.SimulationSettings()
        settings.solution.file.write = False
        settings.solution.sensors.active = False
        settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
        settings.linearSolver.reuseAnalyzedPattern = True
        time = settings.timeIntegration
        time.verboseMode = 0
        time.stepInformation = 0
        time.adaptiveStep = self.halve_steps
        time.generalizedAlpha.computeInitialAccelerations = self.initial_accelerations
        time.newton.useModifiedNewton = True
        time.newton.absoluteTolerance = max(self.absolute_tolerance * amplitude, round_off, along)
        time.newton.relativeTolerance = self.relative_tolerance
        time.newton.maxIterations = self.iterations
        time.discontinuous.useRecommendedStepSize = False
        time.discontinuous.ignoreMaxIterations = True  # whether they settled is judged elsewhere
        time.discontinuous.maxIterations = self.contact_iterations
        time.discontinuous.iterationTolerance = max(self.contact_tolerance * amplitude, 10.0 * round_off)
        return settings


def filled(stated: NewtonSolver | None, chosen: NewtonSolver) -> NewtonSolver:
    """``chosen`` with what ``stated`` has otherwise than by default."""
    own = {n: v for n, v in vars(stated).items() if v != getattr(NewtonSolver, n)} if stated else {}
    return replace(chosen, **own)


SOLVERS: dict[str, type] = {"newton": NewtonSolver}
"""Kinds of ``[exudyn.solver]``."""


@contextmanager
def quiet() -> Iterator[None]:
    """Nothing from Exudyn on standard output or standard error while in here."""
    console, warnings = exu.config.printToConsole, exu.config.suppressWarnings
    exu.config.printToConsole, exu.config.suppressWarnings = False, True
    try:
        yield
    finally:
        exu.config.printToConsole, exu.config.suppressWarnings = console, warnings


def open_viewer(container: Any) -> bool:
    """Open the viewer on an assembled system; without a display, say so on standard error and return False."""
    if sys.platform.startswith("linux") and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        print("no display: DISPLAY is not set, so Exudyn's viewer cannot open a window here", file=sys.stderr)
        return False
    settings = container.visualizationSettings
    settings.general.graphicsUpdateInterval = 0.05
    settings.bodies.defaultColor = BLUE
    settings.openGL.lineWidth = 3.0
    for group in (settings.nodes, settings.markers, settings.connectors, settings.loads):
        group.show = False
    if not container.renderer.Start():
        print("Exudyn's viewer could not be started", file=sys.stderr)
        return False
    container.renderer.ZoomAll()
    return True


def wait_until_closed(container: Any) -> None:
    """Leave the last picture on the screen until its user has seen enough."""
    print("the viewer shows the end of the run: Q or Escape in its window to go on", file=sys.stderr)
    container.renderer.DoIdleTasks(printPauseMessage=False)
