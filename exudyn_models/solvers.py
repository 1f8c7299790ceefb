"""Exudyn's nonlinear and linear solver settings, and how to keep it from printing.

Newton's method is run modified (the Jacobian is kept while it converges) on a sparse factorisation whose pattern is
kept. Residuals are forces in model units, of the size of the amplitude; below ``tolerance`` × amplitude they are
round-off of 12EI/Δx³·y.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import exudyn as exu

from bent_beam.checks import one_of, positive, whole

__all__ = ["SOLVERS", "NewtonSolver", "quiet"]

LINEAR = {"sparse": exu.LinearSolverType.EigenSparse, "dense": exu.LinearSolverType.EXUdense}


@dataclass(frozen=True)
class NewtonSolver:
    """How each implicit step is solved.

    absolute_tolerance, relative_tolerance : of the residual; the absolute one in units of the model's amplitude. It and
        ``contact_tolerance`` are raised to the round-off of the contact's own forces where those are larger.
    contact_tolerance : force, in the same units, below which a change of the contact state does not repeat the step.
    iterations : most Newton iterations a step.
    contact_iterations : most repetitions of a step until its contact state has settled (:mod:`exudyn_models.settling`).
    contact_must_settle : fail when they run out; otherwise the run goes on and a warning counts the steps.
    halve_steps : let Exudyn shorten a step that fails (down to 1/1000) before giving up.
    modified_newton : keep the Jacobian while it converges.
    linear_solver : "sparse" or "dense".
    initial_accelerations : solve for the accelerations at t = 0 instead of starting from none.
    """

    absolute_tolerance: float = 1e-8
    relative_tolerance: float = 1e-5
    contact_tolerance: float = 1e-4
    iterations: int = 25
    contact_iterations: int = 300
    contact_must_settle: bool = True
    halve_steps: bool = False
    modified_newton: bool = True
    linear_solver: str = "sparse"
    initial_accelerations: bool = True

    def __post_init__(self) -> None:
        positive("exudyn.solver.absolute_tolerance", self.absolute_tolerance)
        positive("exudyn.solver.relative_tolerance", self.relative_tolerance)
        positive("exudyn.solver.contact_tolerance", self.contact_tolerance)
        whole("exudyn.solver.iterations", self.iterations, 1)
        whole("exudyn.solver.contact_iterations", self.contact_iterations, 1)
        one_of("exudyn.solver.linear_solver", self.linear_solver, LINEAR)

    def settings(self, amplitude: float, round_off: float = 0.0) -> Any:
        """Fresh ``exudyn.SimulationSettings`` with these choices and no files; ``round_off`` of the contact forces."""
        settings = exu.SimulationSettings()
        settings.solution.file.write = False
        settings.solution.sensors.active = False
        settings.linearSolver.solverType = LINEAR[self.linear_solver]
        settings.linearSolver.reuseAnalyzedPattern = self.linear_solver == "sparse"
        time = settings.timeIntegration
        time.verboseMode = 0
        time.stepInformation = 0
        time.adaptiveStep = self.halve_steps
        time.generalizedAlpha.computeInitialAccelerations = self.initial_accelerations
        time.newton.useModifiedNewton = self.modified_newton
        time.newton.absoluteTolerance = max(self.absolute_tolerance * amplitude, round_off)
        time.newton.relativeTolerance = self.relative_tolerance
        time.newton.maxIterations = self.iterations
        time.discontinuous.useRecommendedStepSize = False
        time.discontinuous.ignoreMaxIterations = True  # whether they settled is judged elsewhere
        time.discontinuous.maxIterations = self.contact_iterations
        time.discontinuous.iterationTolerance = max(self.contact_tolerance * amplitude, 10.0 * round_off)
        return settings


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
