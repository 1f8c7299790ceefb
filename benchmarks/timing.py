"""Time steps, and plain LDLᵀ of a matrix of the same size, ready to be timed."""

from collections.abc import Callable

import numba
import numpy as np
from numpy.typing import NDArray

from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import Contact, NodeContact
from hermite_fe.far_fields import GridViscosity
from hermite_fe.integrators import Integrator
from hermite_fe.model import BeamModel, beam_model
from hermite_fe.run import Stepper

STEP = 1e-3  # in units of t*, at κ/ν = 0.1
HALF_LENGTH = 100.0  # l*
START, END = 0.06, 1.0  # t*, of the first call and of the impact; growing steps grow from 0.05 on
STEPS = 8  # a call, as between two saved instants

njit = numba.njit(error_model="numpy", fastmath={"contract"})


def _model(nodes: int, contact: Contact, half_length: float) -> BeamModel:
    impact = Impact.dimensionless(0.1, length=2.0 * half_length)
    places = UniformMesh(half_length / (nodes - 1)).nodes(half_length)
    return beam_model(impact, places, contact, GridViscosity(), full=False)


def prepared_step(
    nodes: int,
    integrator: Integrator,
    contact: Contact,
    *,
    growing: bool,
    half_length: float = HALF_LENGTH,
    length: float = STEP,
) -> Callable[[], None]:
    """A half beam of ``nodes`` nodes in the middle of an impact; each call of the result takes :data:`STEPS` more,
    active set included.

    growing : steps in proportion to time, so that every one makes and factors a new matrix. half_length : in l*; the
    shorter, the more of the nodes are in contact (at most 3 l* of the beam are). length : of constant steps, in t*.

    Raises ``RuntimeError`` when a step fails.
    """
    sizes = (0.1 * STEP, 2.0 * STEP) if growing else (length, 0.0)
    model = _model(nodes, contact, half_length)
    run = Stepper(model.system, model.displacement, model.velocity, integrator.with_steps(*sizes), END, ContactLaw())
    run.advance_to(int(np.searchsorted(run.instants, START)))

    def step() -> None:
        if run.step + STEPS >= run.instants.size or run.advance_to(run.step + STEPS) != 0:
            raise RuntimeError(f"no step after t = {float(run.instants[run.step])!r}")

    return step


@njit
def factor(S: NDArray[np.float64], L: NDArray[np.float64]) -> None:
    """S = L D Lᵀ with half bandwidth 3, lower bands; L[0] = 1/D. Three idle entries at either end."""
    for i in range(3, S.shape[1] - 3):
        a = S[3, i - 3]
        b = S[2, i - 2] - a * L[1, i - 3]
        c = S[1, i - 1] - a * L[2, i - 3] - b * L[1, i - 2]
        L[3, i - 3], L[2, i - 2], L[1, i - 1] = a * L[0, i - 3], b * L[0, i - 2], c * L[0, i - 1]
        L[0, i] = 1.0 / (S[0, i] - a * L[3, i - 3] - b * L[2, i - 2] - c * L[1, i - 1])


@njit
def substitute(L: NDArray[np.float64], b: NDArray[np.float64], x: NDArray[np.float64]) -> None:
    """L D Lᵀ x = b."""
    for i in range(3, x.size - 3):
        x[i] = b[i] - L[3, i - 3] * x[i - 3] - L[2, i - 2] * x[i - 2] - L[1, i - 1] * x[i - 1]
    for i in range(x.size - 4, 2, -1):
        x[i] = x[i] * L[0, i] - L[3, i] * x[i + 3] - L[2, i] * x[i + 2] - L[1, i] * x[i + 1]


def plain_step(nodes: int, *, factors: bool) -> Callable[[], None]:
    """Plain compiled LDLᵀ of the same beam's step matrix, as many times: its ``factors`` and the solution, or the
    solution alone. Four times as fast as LAPACK's pbtrf and pbtrs, which are made for wide bands.
    """
    system = _model(nodes, NodeContact(), HALF_LENGTH).system
    S = np.pad(system.mass + STEP * system.damping + STEP**2 * system.stiffness, ((0, 0), (3, 3)))
    L, right, x = np.zeros_like(S), np.ones(S.shape[1]), np.zeros(S.shape[1])
    factor(S, L)

    def step() -> None:
        for _ in range(STEPS):
            if factors:
                factor(S, L)
            substitute(L, right, x)

    step()
    return step
