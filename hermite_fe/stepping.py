"""The data of a time integrator, and compiled functions that the schemes share."""

import math
from typing import Any, NamedTuple

import numpy as np

from bent_beam.files import LOSSES
from hermite_fe.active_set import NOT_FINITE, SOLVED, solve_free
from hermite_fe.banded import PAD, combine, dot, multiply, row_sums, stiff_multiply
from hermite_fe.compiled import Array, Flags, Places, compiled, compiled_within
from hermite_fe.constraints import Constraints, ContactLaw, Rows, Solver, row_times, solver_of
from hermite_fe.elastic_wall import Springs
from hermite_fe.maxwell import strains_of
from hermite_fe.system import Bending, Branches, System

WORK, IMPACT, ALGORITHMIC, VISCOUS, MATERIAL, ABSORBED, WALL = range(7)
"""Indices in ``State.energy``, J since the start: the work of the loads, and the losses to impacts, to the scheme's own
damping, to viscosity at grid scale, to the material's damping, to an absorbing layer, to the dashpots of the wall. Each
has its own formula; the difference between their sum and the change of kinetic, strain and the wall's energy is the
energy residual of a run."""

ENERGIES = ("work_of_loads", *LOSSES)
LARGEST = ("largest_moment", "largest_moment_node", "largest_midspan_moment")
SAME_STEP = 2.0**-50  # of the time: step lengths that differ by less, the rounding of two instants, are the same
SAME_FACTOR = 1e-6  # likewise of c and k


class Matrices(NamedTuple):
    """Matrices and loads, shapes as in :class:`hermite_fe.system.System`.

    K_sums, C_sums : (2, dofs), :func:`hermite_fe.banded.row_sums` of K and C.
    parts : (causes, 4, dofs), C by cause; causes : (causes,), its index in ``State.energy``.
    springs, second : of walls that give way, see :class:`hermite_fe.system.System`.
    """

    M: Array
    C: Array
    K: Array
    K_sums: Array
    C_sums: Array
    parts: Array
    causes: Places
    load: Array
    springs: Springs
    second: Springs


class Problem(NamedTuple):
    """The constant data of a run, and the solver with its work arrays."""

    matrices: Matrices
    rows: Rows
    law: ContactLaw
    solver: Solver


class State(NamedTuple):
    """The variables that a step changes.

    q, v, acceleration : (dofs,), the motion; acceleration, v̇, where the integrator has one.
    closed : (rows,). impulse, held_impulse : (rows,), N s since the start, and its pulling part.
    energy : (7,), J, see :data:`WORK`. worst : (2,), see :data:`hermite_fe.constraints.PRODUCT`.
    peaks : (4,), see :data:`hermite_fe.elastic_wall.FORCE`.
    branches : of a hysteretic beam; stretch : (2 elements,), the weighted sum of their stretches, mean over
        the last step.
    largest : (3,), :data:`LARGEST` of all steps since it was last set to 0: largest bending moment |M|, N m, its node,
        and the largest in the middle, N m.
    """

    q: Array
    v: Array
    acceleration: Array
    closed: Flags
    impulse: Array
    held_impulse: Array
    energy: Array
    worst: Array
    peaks: Array
    largest: Array
    bending: Bending
    branches: Branches
    stretch: Array


def problem_of(system: System, law: ContactLaw) -> Problem:
    """The arrays of a system."""
    parts = np.array([bands for _, bands in system.dampings]).reshape(-1, *system.damping.shape)
    matrices = Matrices(
        M=system.mass.copy(), C=system.damping, K=system.stiffness,  # a scheme may move masses
        K_sums=row_sums(system.stiffness), C_sums=row_sums(system.damping),
        parts=parts, causes=np.array([ENERGIES.index(f"loss_{cause}") for cause, _ in system.dampings], np.int64),
        load=system.load if np.any(system.load) else np.zeros((0, system.dofs)), springs=system.springs,
        second=system.second,
    )  # fmt: skip
    law = law._replace(strength=np.zeros(len(system.contacts)) + law.strength)
    return Problem(matrices, Rows(*(getattr(system.contacts, name) for name in Rows._fields)), law, solver_of(system))


def state_of(system: System, q: Array, v: Array) -> State:
    """The state at the start, q and v copied."""
    n, m = system.dofs, len(system.contacts)
    return State(
        q=np.array(q, float), v=np.array(v, float), acceleration=np.zeros(n), closed=np.zeros(m, np.bool_),
        impulse=np.zeros(m), held_impulse=np.zeros(m), energy=np.zeros(7), worst=np.zeros(2), peaks=np.zeros(4),
        largest=np.zeros(3), bending=system.bending, stretch=np.zeros(2 * system.bending.lengths.size),
        branches=Branches(*(part.copy() for part in system.branches)),
    )  # fmt: skip


@compiled
def prepare(problem: Problem, c: float, k: float, h: float, t: float) -> float:
    """Make S = M + cC + kK for steps of length h, s, unless h, c and k are those that it is made for. Returns the step
    length that it is made for, which differs from h by the rounding of instants at t, s, at most."""
    matrices, rows, _, solver = problem
    same = abs(solver.step[1] - c) <= SAME_FACTOR * c and abs(solver.step[2] - k) <= SAME_FACTOR * k
    if same and abs(solver.step[0] - h) <= SAME_STEP * t:
        return solver.step[0]
    combine(matrices.M, matrices.C, matrices.K, c, k, solver.unknown, solver.S)
    if rows.dofs.shape[1] > 1:
        for j in range(solver.row_unknown.size):
            multiplier = solver.row_unknown[j]
            for i in range(rows.dofs.shape[1]):
                k_dof = solver.unknown[rows.dofs[j, i]]
                solver.S[abs(k_dof - multiplier), min(k_dof, multiplier)] = rows.factors[j, i]
    solver.step[0], solver.step[1], solver.step[2] = h, c, k
    solver.stale[0] = solver.S.shape[1] - PAD - 1
    return h


@compiled_within
def end_moments(stiffness: Any, phi: Any, first: Any, second: Any) -> tuple[Any, Any]:
    """EI w_xx at both ends of an element of the stiffness EI/length from its strains, or of many at once."""
    stiffness, near, far = stiffness / (1.0 + phi), 4.0 + phi, 2.0 - phi
    return -stiffness * (near * first + far * second), stiffness * (far * first + near * second)


@compiled_within
def note_moments(bending: Bending, q: Array, stretch: Array, largest: Array) -> None:
    """Note the largest bending moments of the cubics through q and of the branches, at both ends of each element."""
    for e in range(bending.lengths.size):
        first, second = strains_of(bending, q, e)
        first, second = first + stretch[2 * e], second + stretch[2 * e + 1]
        left, right = end_moments(bending.stiffness / bending.lengths[e], bending.phi[e], first, second)
        left, right = abs(bending.free + left), abs(bending.free + right)
        if max(left, right) > largest[0]:
            largest[0], largest[1] = max(left, right), e if left > right else e + 1
        if e == bending.middle and left > largest[2]:
            largest[2] = left
        if e + 1 == bending.middle and right > largest[2]:
            largest[2] = right


@compiled
def end_step(state: State) -> int:
    """Note the moments of a finished step; returns NOT_FINITE unless v[0] and the energies are finite, else SOLVED. Any
    other infinite or undefined number of q or v makes an energy so."""
    note_moments(state.bending, state.q, state.stretch, state.largest)
    total = state.v[0]
    for cause in range(state.energy.size):
        total += state.energy[cause]
    return SOLVED if math.isfinite(total) else NOT_FINITE


@compiled
def mean_forces(load: Array, t: float, h: float, theta: float, out: Array) -> None:
    """out = θF(t + h) + (1 − θ)F(t), with F = Σ_k load[k]·t^k."""
    out[:] = 0.0
    for power in range(load.shape[0]):
        mean = theta * (t + h) ** power + (1.0 - theta) * t**power if power > 0 else 1.0
        for i in range(out.size):
            out[i] += mean * load[power, i]


@compiled
def forces_at(matrices: Matrices, t: float, q: Array, v: Array, out: Array, scratch: Array) -> None:
    """out = F(t) − Cv − Kq."""
    mean_forces(matrices.load, t, 0.0, 1.0, out)
    stiff_multiply(matrices.K, matrices.K_sums, q, scratch)
    for i in range(q.size):
        out[i] -= scratch[i]
    if matrices.causes.size > 0:
        stiff_multiply(matrices.C, matrices.C_sums, v, scratch)
        for i in range(q.size):
            out[i] -= scratch[i]


@compiled
def initial_acceleration(problem: Problem, state: State, b: Array, scratch: Array) -> int:
    """``state.acceleration`` = M⁻¹(F − Cv − Kq) at the start, without reactions; returns the status of the solution."""
    prepare(problem, 0.0, 0.0, 0.0, 0.0)
    forces_at(problem.matrices, 0.0, state.q, state.v, b, scratch)
    return solve_free(problem.solver, problem.rows, b, state.acceleration)


@compiled
def add_impulses(state: State, conditions: Constraints) -> None:
    """Add the impulses of a step to those so far."""
    for j in range(conditions.p.size):
        state.impulse[j] += conditions.p[j]
        if conditions.least[j] < 0.0:
            state.held_impulse[j] += min(conditions.p[j], 0.0)


@compiled
def add_energies(
    problem: Problem, state: State, h: float, work: float, impulse: Array, mean_v: Array, damped_v: Array,
    algorithmic: float, scratch: Array
) -> None:  # fmt: skip
    """Add the energies of a step of length h to ``state.energy``, each from its cause.

    work : of the loads. impulse : p, (rows,); mean_v : v̄ = ½(v + v⁺), (dofs,): impacts dissipate −pᵀGv̄.
    damped_v : the velocity v_d that the scheme's damping acts on: each cause of damping dissipates h v_dᵀCv_d.
    algorithmic : the scheme's own loss, from the scheme's own formula.
    """
    matrices, energy = problem.matrices, state.energy
    energy[WORK] += work
    energy[ALGORITHMIC] += algorithmic
    for j in range(impulse.size):
        if impulse[j] != 0.0:
            energy[IMPACT] -= impulse[j] * row_times(problem.rows, mean_v, j)
    for part in range(matrices.causes.size):
        multiply(matrices.parts[part], damped_v, scratch)
        energy[matrices.causes[part]] += h * dot(damped_v, scratch)
