"""Contact points without mass: nothing impacts there, and no impact law is needed.

Monjaraz-Tec, Gross and Krack 2022, Comput. Struct. 260, 106698 (arXiv 2111.07693), on a mesh of which every other node
may touch. Massless are the contact points and all slopes, q_b: at the end of each step they are in static equilibrium
with the wall. Their mass is moved to the deflections between, q_i with the masses M, which move explicitly (Verlet):

    q_i⁺ = q_i + h(v + ½h a),                            a = M⁻¹(F_i − K_i q)
    K_b q⁺ = F_b⁺ + Gᵀλ⁺,      0 ≤ λ⁺ ⊥ g⁺ = g₀ + Gq⁺ ≥ 0
    v⁺ = v + ½h(a + a⁺)

The wall's impulse of a step is p = ½h(λ + λ⁺), which is what a free beam loses of momentum, and exactly

    Δ(T + V) = ½(F + F⁺)ᵀΔq + pᵀGΔq/h + ⅛h² Δ(aᵀMa):

the work of the loads, less the loss −pᵀGΔq/h, which is none while the same points touch, less the algorithmic loss, a
change of state: waves are not damped at all, and there is no other damping. Steps are parts of those asked for, short
enough to be stable: K_i with everything else held bounds the frequencies that the massless points leave (Gershgorin).
"""

from dataclasses import dataclass
from typing import ClassVar, NamedTuple

import numpy as np

from bent_beam.checks import affordable
from bent_beam.errors import InputError
from hermite_fe.active_set import SOLVED, solve_constrained
from hermite_fe.banded import copy, dot, product
from hermite_fe.compiled import Array, Flags, compiled, compiled_within, recompiling
from hermite_fe.constraints import Constraints, ask_for_gaps, constraints_of, note_complementarity
from hermite_fe.integrators.base import MOST_WORK, Integrator, Reached
from hermite_fe.stepping import Problem, State, add_energies, add_impulses, end_step, forces_at, mean_forces, prepare

STABLE = 0.8  # of the length of a step times the bound of the frequencies; Verlet's limit is 2


class MasslessMemory(NamedTuple):
    """conditions : of the contact, their ``p`` λ, N, when solved, then the step's impulse; inner : (dofs,), those with
    mass; fastest : bound of the frequencies, 1/s; push : (rows,), λ at the instant reached. The rest are work arrays,
    (dofs,)."""

    conditions: Constraints
    inner: Flags
    fastest: float
    push: Array
    b: Array
    dq: Array
    mean_v: Array
    force: Array
    scratch: Array


@dataclass(frozen=True)
class MasslessBoundary(Integrator):
    """Explicit steps of the points with mass, static equilibrium of those that may touch."""

    rebounds: ClassVar[bool] = False
    damped: ClassVar[bool] = False
    moves_mass: ClassVar[bool] = True

    def start(self, problem: Problem, state: State) -> MasslessMemory:
        kind = "hermite.integrator.kind: massless_boundary"
        if problem.matrices.causes.size:
            raise InputError(f"{kind} takes no damping: hermite.far_field.viscosity, that of beam and wall must be 0")
        if np.any(state.bending.phi):
            raise InputError(f"{kind} leaves out the inertia of slopes: shear_stiffness is not modelled")
        if problem.rows.dofs.shape[1] > 1:
            raise InputError(f'{kind} needs contact points that are dofs: hermite.contact.kind must be "alternate"')
        matrices, solver, stride = problem.matrices, problem.solver, 2 if state.bending.lengths.size else 1
        mass = moved_masses(problem, stride)
        inner = (mass > 0.0) & ~solver.fixed[solver.unknown]
        matrices.M[:] = 0.0  # of this run from here on
        matrices.M[0] = np.where(inner, mass, 0.0)
        solver.fixed[solver.unknown[inner]] = True  # while the others find their equilibrium
        recompiling(lambda: prepare(problem, 0.0, 1.0, 0.0, 0.0))  # K, and masses where nothing is solved for
        bound, push = fastest(matrices.K, mass, inner), np.zeros_like(state.impulse)
        memory = MasslessMemory(constraints_of(problem.rows), inner, bound, push, *np.zeros((5, state.q.size)))
        if recompiling(lambda: settle(problem, state, memory, 0.0)) != SOLVED:
            raise InputError(f"{kind}: the points that keep mass must hold all others")
        memory.push[:] = memory.conditions.p
        return memory

    def advance(
        self, problem: Problem, state: State, memory: MasslessMemory, times: Array, first: int, last: int
    ) -> Reached:
        needed = times[-1] * memory.fastest / STABLE
        affordable("hermite.integrator.kind = massless_boundary and mesh", needed, state.q.size // 2, 1, MOST_WORK)
        return take_steps(problem, state, memory, times, first, last)


def moved_masses(problem: Problem, stride: int) -> Array:
    """The row sums of M over deflections, ``stride`` dofs apart, those of contact points moved to their neighbours in
    equal parts, (dofs,)."""
    M, touching = problem.matrices.M, np.zeros(problem.matrices.M.shape[1], np.bool_)
    touching[problem.rows.dofs] = True
    if touching.size <= stride or np.any(touching[:-stride] & touching[stride:]):
        needs = "massless_boundary needs points that do not touch beside each that may, to carry its mass"
        raise InputError(f'hermite.integrator.kind: {needs}: hermite.contact.kind must be "alternate"')
    mass, beside = M[0].copy(), np.full(touching.size, 2.0)
    for k in range(stride, 4, stride):
        mass[:-k] += M[k, :-k]
        mass[k:] += M[k, :-k]
    if stride > 1:
        mass[1::stride] = 0.0
    beside[:stride] = beside[-stride:] = 1.0
    given = np.where(touching, mass / beside, 0.0)
    mass[touching] = 0.0
    mass[:-stride] += given[stride:]
    mass[stride:] += given[:-stride]
    return mass


def fastest(K: Array, mass: Array, inner: Flags) -> float:
    """A bound of the frequencies of the points with mass, everything else held, 1/s."""
    root = np.where(inner, 1.0 / np.sqrt(np.where(inner, mass, 1.0)), 0.0)
    return float(np.sqrt((root * product(np.abs(K), root)).max()))


@compiled
def settle(problem: Problem, state: State, memory: MasslessMemory, t: float) -> int:
    """Bring the massless points into equilibrium at t, λ in ``conditions.p``, ``dq`` being how far they move, and put a
    in ``state.acceleration``; returns the status."""
    matrices, rows, solver = problem.matrices, problem.rows, problem.solver
    conditions, dq, b, a = memory.conditions, memory.dq, memory.b, state.acceleration
    forces_at(matrices, t, state.q, state.v, b, memory.scratch)
    ask_for_gaps(rows, conditions, state.q, state.closed, 1.0, 1.0)
    status = solve_constrained(solver, rows, conditions, b, dq)
    if status != SOLVED:
        return status
    copy(conditions.closed, state.closed)
    for i in range(dq.size):
        state.q[i] += dq[i]
    forces_at(matrices, t, state.q, state.v, b, memory.scratch)
    for i in range(a.size):
        a[i] = b[i] / matrices.M[0, i] if memory.inner[i] else 0.0
    return SOLVED


@compiled
def take_steps(problem: Problem, state: State, memory: MasslessMemory, times: Array, first: int, last: int) -> Reached:
    """Take the steps ``first`` … ``last`` − 1 between the instants ``times``, each in equal parts that are stable."""
    for k in range(first, last):
        parts = max(int(np.ceil((times[k + 1] - times[k]) * memory.fastest / STABLE)), 1)
        h = (times[k + 1] - times[k]) / parts
        for part in range(parts):
            status = step(problem, state, memory, times[k] + part * h, h)
            if status != SOLVED:
                return status, k
    return SOLVED, last


@compiled_within
def step(problem: Problem, state: State, memory: MasslessMemory, t: float, h: float) -> int:
    """One explicit step of length h from t, and its energies; returns the status."""
    q, v, a, mass = state.q, state.v, state.acceleration, problem.matrices.M[0]
    mean_v, p = memory.mean_v, memory.conditions.p
    loss = 0.0
    for i in range(q.size):
        mean_v[i] = v[i] + 0.5 * h * a[i] if memory.inner[i] else 0.0
        q[i] += h * mean_v[i]
        loss += mass[i] * a[i] * a[i]
    status = settle(problem, state, memory, t + h)
    if status != SOLVED:
        return status
    for i in range(q.size):
        loss -= mass[i] * a[i] * a[i]
        if not memory.inner[i]:
            mean_v[i] = memory.dq[i] / h
        v[i] = mean_v[i] + 0.5 * h * a[i]  # a is 0 where there is no mass
    note_complementarity(problem.rows, memory.conditions, memory.dq, 1.0, state.worst)  # p is λ here, N
    for j in range(p.size):
        now = p[j]
        p[j] = 0.5 * h * (memory.push[j] + now)
        memory.push[j] = now
    mean_forces(problem.matrices.load, t, h, 0.5, memory.force)
    add_impulses(state, memory.conditions)
    work = h * dot(memory.force, mean_v)
    add_energies(problem, state, h, work, p, mean_v, mean_v, 0.125 * h * h * loss, memory.scratch)
    return end_step(state)
