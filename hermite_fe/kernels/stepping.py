"""Compiled pieces of a step that integrators share: forces, the acceleration at the start, the energy booked."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.ahead import carry
from hermite_fe.kernels.banded import CHUNK, add, combine, dot, quadratic_rows, stiff_rows
from hermite_fe.kernels.contact import force_rows, row_times
from hermite_fe.kernels.jit import compiled, compiled_apart, compiled_in_place
from hermite_fe.kernels.pivoting import solve_rows
from hermite_fe.kernels.problem import ALGORITHMIC, IMPACT, WORK, Problem, State, Work
from hermite_fe.kernels.rows import SOLVED

Array = NDArray[np.float64]
ROUNDING = 2.0**-51  # of an instant: each of two instants is rounded twice at most


@compiled_in_place
def step_length(times: Array, k: int, made_with: Array) -> float:
    """h of step k, s; the one that the matrix was made with where the two differ by the rounding of the instants alone,
    so that steps that are meant to be alike share their factors."""
    h = times[k + 1] - times[k]
    return made_with[0] if abs(h - made_with[0]) <= ROUNDING * times[k + 1] else h


@compiled_in_place
def hand_back(q: Array, made_with: Array, length: int, status: int) -> None:
    """Leave a run as it is to be found: the dofs that steps left out have moved on too, and the factors of a step that
    failed hold no longer."""
    carry(q, length + 3, q.size)
    if status != SOLVED:
        made_with[0] = math.nan


@compiled_apart
def residual_rows(problem: Problem, t: float, q: Array, v: Array, out: Array, scratch: Array, length: int) -> None:
    """The first ``length`` rows of :func:`residual_force`."""
    for first in range(0, length, CHUNK):
        stop = min(first + CHUNK, length)
        part = out[first:stop]
        stiff_rows(problem.K, problem.even, problem.odd, q, 0, first, stop, part)
        for i in range(stop - first):
            part[i] = -part[i]
        if problem.slots.size > 0:
            stiff_rows(problem.C, problem.damping_even, problem.damping_odd, v, 0, first, stop, scratch)
            for i in range(stop - first):
                part[i] -= scratch[i]
        if problem.load.shape[0] > 0:
            force_rows(problem.load, t, 0.0, 0.0, first, stop, scratch)
            for i in range(stop - first):
                part[i] += scratch[i]


@compiled_in_place
def residual_force(problem: Problem, t: float, q: Array, v: Array, out: Array, scratch: Array) -> None:
    """out = F(t) − Cv − Kq."""
    residual_rows(problem, t, q, v, out, scratch, q.size)


@compiled
def initial_acceleration(problem: Problem, state: State, work: Work) -> int:
    """Acceleration at the start, v̇ = a = M⁻¹(F − Cv − Kq), without reactions; leaves ``work`` without rows that take
    part."""
    combine(problem.M, problem.C, problem.K, 1.0, 0.0, 0.0, work.place, work.S)
    work.made_with[0] = math.nan
    work.candidate[:] = False
    work.held[:] = False
    residual_force(problem, 0.0, state.q, state.v, work.b, work.d1)
    status = solve_rows(problem, work, True, state.q.size, np.zeros(state.closed.size, np.bool_))
    state.acceleration[:] = work.x
    state.a[:] = work.x
    return status


@compiled_apart
def book_step(
    problem: Problem,
    state: State,
    h: float,
    force: Array,
    change: Array,
    mean_v: Array,
    impulse: Array,
    algorithmic: float,
) -> None:
    """Book a step of length h in state.budget and state.impulse, each term from its cause.

    Work of the loads, forceᵀΔq; loss in impacts, −pᵀGv̄; what each cause of damping takes, h v̄ᵀCv̄.
    force : F̄, mean load of the step, and change : Δq, of the dofs up to the last that feels a force (or of all);
        mean_v : v̄ = ½(v + v⁺), (dofs,); impulse : p of all rows up to the last that reacts (or of all).
        algorithmic : the scheme's own loss, from the scheme's own formula: what is left of Δ(T + V) is a run's defect.
    """
    contact = 0.0
    for j in range(impulse.size):
        if impulse[j] != 0.0:
            contact += impulse[j] * row_times(problem.dofs, problem.factors, mean_v, j)
            state.impulse[j] += impulse[j]
    add(state.budget, WORK, dot(force, change))
    add(state.budget, IMPACT, -contact)
    add(state.budget, ALGORITHMIC, algorithmic)
    for cause in range(problem.slots.size):
        add(state.budget, problem.slots[cause], h * quadratic_rows(problem.parts[cause], mean_v, 0, 0, change.size))
