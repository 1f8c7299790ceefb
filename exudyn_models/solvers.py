"""Exudyn's nonlinear and linear solver settings, how to keep it from printing, and its viewer.

Newton's method is run modified (the Jacobian is kept while it converges) on a sparse factorisation whose pattern is
kept. Residuals are forces in model units, of the size of the amplitude.
"""

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
    """How each implicit step is solved. What is left open (``None``) is as contact and beam ask for (:func:`filled`),
    otherwise as :data:`USUAL`.

    The absolute tolerance and that of the contact are in units of the model's amplitude, and raised to the round-off of
    contact, elastic, viscous and axial forces (:func:`exudyn_models.assembly.settings_of`) where that is larger.
    """

    where: ClassVar[str] = "exudyn.solver"

    absolute_tolerance: Annotated[
        float | None,
        Quantity(
            "", "of the residual", above=0.0, absent="1e-8 (damped whole beam without shear 1e-5, elastic wall 1e-6)"
        ),
    ] = None
    relative_tolerance: Annotated[
        float | None, Quantity("", "of the residual", above=0.0, absent="1e-5 (whole beam 1e-8)")
    ] = None
    contact_tolerance: Annotated[
        float | None,
        Quantity(
            "", "force below which a changed contact state does not repeat the step", above=0.0,
            absent="1e-4 (segment_friction 1e-2, elastic wall 1e-7)",
        ),
    ] = None  # fmt: skip
    iterations: Annotated[
        int | None, Quantity("", "largest number of Newton iterations a step", least=1, absent="25")
    ] = None
    contact_iterations: Annotated[
        int | None,
        Quantity("", "largest number of repetitions until a step's contact state has settled", least=1, absent="300"),
    ] = None
    contact_must_settle: Annotated[
        bool | None, Quantity("", "fail when they run out; otherwise a warning counts the steps", absent="true")
    ] = None
    halve_steps: Annotated[
        bool | None,
        Quantity("", "let Exudyn shorten a failed step (down to 1/1000)", absent="false (segment_friction true)"),
    ] = None
    initial_accelerations: Annotated[
        bool | None, Quantity("", "start from the accelerations at t = 0 instead of from zero", absent="true")
    ] = None

    def settings(self, amplitude: float, round_off: float, along: float) -> Any:
        """Fresh ``exudyn.SimulationSettings`` with these choices and no files; ``round_off`` of a force across the
        beam, and of one ``along`` it."""
        chosen, settings = filled(self, USUAL), exu.SimulationSettings()
        settings.solution.file.write = False
        settings.solution.sensors.active = False
        settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse
        settings.linearSolver.reuseAnalyzedPattern = True
        time = settings.timeIntegration
        time.verboseMode = 0
        time.stepInformation = 0
        time.adaptiveStep = chosen.halve_steps
        time.generalizedAlpha.computeInitialAccelerations = chosen.initial_accelerations
        time.newton.useModifiedNewton = True
        time.newton.absoluteTolerance = max(chosen.absolute_tolerance * amplitude, round_off, along)
        time.newton.relativeTolerance = chosen.relative_tolerance
        time.newton.maxIterations = chosen.iterations
        time.discontinuous.useRecommendedStepSize = False
        time.discontinuous.ignoreMaxIterations = True  # whether they settled is judged elsewhere
        time.discontinuous.maxIterations = chosen.contact_iterations
        time.discontinuous.iterationTolerance = max(chosen.contact_tolerance * amplitude, 10.0 * round_off)
        return settings


USUAL = NewtonSolver(
    absolute_tolerance=1e-8,
    relative_tolerance=1e-5,
    contact_tolerance=1e-4,
    iterations=25,
    contact_iterations=300,
    contact_must_settle=True,
    halve_steps=False,
    initial_accelerations=True,
)
"""What is taken where neither user, contact nor beam says otherwise."""


def filled(stated: NewtonSolver | None, chosen: NewtonSolver) -> Any:
    """``chosen`` with whatever is ``stated``."""
    return replace(chosen, **{name: value for name, value in vars(stated or chosen).items() if value is not None})


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
