"""One time step, and LAPACK on a matrix of the same size, ready to be timed.

step = prepared_step(4000)          # call it: takes one whole step, active set included
yardstick = lapack_step(4000)       # call it: cholesky_banded + cho_solve_banded
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.linalg import cho_solve_banded, cholesky_banded

from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Integrator, MoreauJean
from hermite_fe.model import BeamModel, beam_model
from hermite_fe.run import Stepper

__all__ = ["lapack_step", "prepared_step"]

STEP = 1e-3  # in units of t*, at κ/ν = 0.1
HALF_LENGTH = 100.0  # l*
END = 1.0  # t*, of the impact


def _model(nodes: int, contact: Contact, half_length: float) -> BeamModel:
    impact = Impact.dimensionless(0.1, length=2.0 * half_length)
    places = UniformMesh(half_length / (nodes - 1)).nodes(half_length)
    return beam_model(impact, places, contact, GridViscosity(), full=False)


def prepared_step(
    nodes: int,
    integrator: Integrator | None = None,
    contact: Contact | None = None,
    *,
    growing: bool = False,
    start: float = 0.5,
    half_length: float = HALF_LENGTH,
    length: float = STEP,
    steps: int = 1,
) -> Callable[[], None]:
    """A half beam of ``nodes`` nodes in the middle of an impact; each call of the result takes ``steps`` more steps.

    growing : steps in proportion to time, so that every one makes and factors a new matrix.
    start : of the first call, in t*. half_length : in l*; the shorter, the more of the nodes are in contact (at most
    3 l* of the beam are). length : of constant steps, in t*.

    Raises ``RuntimeError`` when a step fails.
    """
    sizes = (0.1 * STEP, 2.0 * STEP) if growing else (length, 0.0)
    integrator = (integrator or MoreauJean()).with_steps(*sizes)
    contact = contact or NodeContact(hold=16, hold_until=0.0)
    model = _model(nodes, contact, half_length)
    law = ContactLaw(hold=contact.hold or 0)
    run = Stepper(model.system, model.displacement, model.velocity, integrator, END, law)
    run.advance_to(int(np.searchsorted(run.instants, start)))

    def step() -> None:
        if run.step + steps >= run.instants.size or run.advance_to(run.step + steps) != 0:
            raise RuntimeError(f"no step after t = {float(run.instants[run.step])!r}")

    return step


def lapack_step(nodes: int) -> Callable[[], None]:
    """LAPACK's banded factorisation and solution, through SciPy, of the step matrix of the same beam."""
    system = _model(nodes, NodeContact(), HALF_LENGTH).system
    bands = system.mass + STEP * system.damping + STEP**2 * system.stiffness
    right = np.ones(system.dofs)

    def step() -> None:
        cho_solve_banded((cholesky_banded(bands, lower=True), True), right)

    return step
