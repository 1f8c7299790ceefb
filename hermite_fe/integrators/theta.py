"""θ-schemes with unilateral constraints: Moreau–Jean, and Signorini at the new position.

    M Δv + hC v_θ + hK q_θ = hF_θ + Gᵀp,     q⁺ = q + h v_θ,      x_θ = x + θΔx

Solved for Δv: S Δv = h[F_θ − K(q + θhv) − Cv] + Gᵀp, S = M + θhC + θ²h²K. Exactly, per step,

    Δ(T + V) = h F_θᵀv_θ − h v_θᵀC v_θ + pᵀG(v + ½Δv) − (θ − ½)[Δvᵀ(MΔv − Gᵀp) + h² v_θᵀK v_θ]:

the work of the loads, less viscous loss, less loss in impacts −pᵀG(v + ½Δv), less algorithmic loss. Maxwell branches
add to S, to the right side and to the energies (:mod:`hermite_fe.maxwell`).

**Moreau–Jean** is for measures, Signorini and the impact law at velocity level:

    0 ≤ p ⊥ Gv⁺ + eGv ≥ 0    for the constraints with  g + (1 − θ)h ġ ≤ 0

A constraint takes part when closing it now would leave it in the wall or on it; so a closed one stays a candidate.
(Jean 1999, "The non-smooth contact dynamics method"; thesis 3.2.1–4 and Fig. 3.6 for its drift at position level.)

**Signorini's condition at the new position**, 0 ≤ p ⊥ g⁺ = g₀ + Gq⁺ ≥ 0, knows no drift. A constraint that reaches the
wall within a step ends it on the wall exactly. The scheme has no impact law: with θ = 1 the constraint is at rest a
step later, with θ = ½ it keeps a share of its speed that depends on when in the step it lands.
"""

from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

import numpy as np

from bent_beam.fields import Quantity
from hermite_fe import constraints
from hermite_fe.active_set import SOLVED, solve_constrained
from hermite_fe.banded import copy, dot, multiply, stiff_multiply
from hermite_fe.compiled import Array, compiled, compiled_within
from hermite_fe.constraints import Constraints, constraints_of
from hermite_fe.integrators.base import Integrator, Reached
from hermite_fe.maxwell import add_branch_forces, step_branches, stiffen
from hermite_fe.stepping import MATERIAL, Problem, State, add_energies, add_impulses, end_step, mean_forces, prepare


class Vectors(NamedTuple):
    """Work arrays of a step, (dofs,): b, Δv, v_θ, v̄ = v + ½Δv, F_θ, and one for anything."""

    b: Array
    dv: Array
    v_theta: Array
    mean_v: Array
    force: Array
    scratch: Array


Memory = tuple[Constraints, Vectors, float, bool]  # the last two are θ and ``at_position``


@compiled_within
def begin_step(
    problem: Problem, state: State, vectors: Vectors, t: float, end: float, theta: float
) -> tuple[float, bool]:
    """Make S for the step from t to ``end``, b = h[F_θ − K(q + θhv) − Cv] less what the branches take, and F_θ in
    ``vectors.force``; returns the length of the step, and whether S is new."""
    matrices, h, made_for = problem.matrices, end - t, problem.solver.step[0]
    h = prepare(problem, theta * h, theta * theta * h * h, h, end)
    if h != made_for:
        stiffen(state.branches, h, theta, problem.solver)
    b, moved, scratch, force = vectors.b, vectors.v_theta, vectors.scratch, vectors.force
    mean_forces(matrices.load, t, h, theta, force)
    # v_θ is not known yet: its array holds q + θhv, and b first K times that
    for i in range(b.size):
        moved[i] = state.q[i] + theta * h * state.v[i]
    stiff_multiply(matrices.K, matrices.K_sums, moved, b)
    stiff_multiply(matrices.C, matrices.C_sums, state.v, scratch)
    for i in range(b.size):
        b[i] = h * (force[i] - b[i] - scratch[i])
    add_branch_forces(state.branches, state.bending, state.v, h, b)
    return h, h != made_for


@compiled_within
def finish_step(problem: Problem, state: State, p: Array, vectors: Vectors, h: float, theta: float) -> int:
    """Move on by ``vectors.dv`` and add the energies, p : (rows,), impulses of rigid walls; returns the status."""
    matrices, q, v, dv, v_theta = problem.matrices, state.q, state.v, vectors.dv, vectors.v_theta
    mean_v, scratch = vectors.mean_v, vectors.scratch
    for i in range(q.size):
        v_theta[i] = v[i] + theta * dv[i]
        mean_v[i] = v[i] + 0.5 * dv[i]
        q[i] += h * v_theta[i]
        v[i] += dv[i]
    state.energy[MATERIAL] += step_branches(state.branches, state.bending, v_theta, h, state.stretch)
    multiply(matrices.M, dv, scratch)
    loss = dot(dv, scratch)
    stiff_multiply(matrices.K, matrices.K_sums, v_theta, scratch)
    loss += h * h * dot(v_theta, scratch)
    for j in range(p.size):
        if p[j] != 0.0:
            loss -= p[j] * constraints.row_times(problem.rows, dv, j)
    loss = (theta - 0.5) * loss  # of Δvᵀ(MΔv − Gᵀp) + h² v_θᵀK v_θ
    add_energies(problem, state, h, h * dot(vectors.force, v_theta), p, mean_v, v_theta, loss, scratch)
    return end_step(state)


@compiled
def take_steps(problem: Problem, state: State, memory: Memory, times: Array, first: int, last: int) -> Reached:
    (_, rows, law, solver), (conditions, vectors, theta, at_position) = problem, memory
    for k in range(first, last):
        h, _ = begin_step(problem, state, vectors, times[k], times[k + 1], theta)
        constraints.set_bounds(rows, law, state.closed, times[k], h, conditions.least)
        constraints.rows_times(rows, state.v, conditions.Gv)
        if at_position:
            constraints.ask_for_gaps(rows, conditions, state.q, state.closed, h, theta)
        else:
            constraints.find_candidates(rows, conditions, state.q, state.closed, (1.0 - theta) * h)
            constraints.ask_for_rebound(law, conditions, conditions.Gv)
        while True:  # what was pulled too hard is let go together
            status = solve_constrained(solver, rows, conditions, vectors.b, vectors.dv)
            if status != SOLVED or not constraints.some_gave_way(conditions):
                break
        if status == SOLVED:
            copy(conditions.closed, state.closed)
            add_impulses(state, conditions)
            constraints.note_complementarity(rows, conditions, vectors.dv, 1.0, state.worst)
            status = finish_step(problem, state, conditions.p, vectors, h, theta)
        if status != SOLVED:
            return status, k
    return SOLVED, last


@dataclass(frozen=True)
class Theta(Integrator):
    """Base of the θ-schemes with constraints."""

    holds: ClassVar[bool] = True
    hysteretic: ClassVar[bool] = True
    holds_zone: ClassVar[bool] = True
    at_position: ClassVar[bool]

    theta: Annotated[
        float, Quantity("", "θ; ½ conserves energy between impacts, 1 damps unresolved waves", least=0.5, most=1.0)
    ] = 1.0

    @property
    def sticks(self) -> bool:
        return not self.at_position or self.theta == 1.0

    def start(self, problem: Problem, state: State) -> Memory:
        vectors = Vectors(*np.zeros((6, state.q.size)))
        return constraints_of(problem.rows), vectors, self.theta, self.at_position

    advance = staticmethod(take_steps)


@dataclass(frozen=True)
class MoreauJean(Theta):
    """A θ-scheme with the impact law at velocity level."""

    at_position: ClassVar[bool] = False


@dataclass(frozen=True)
class SignoriniPosition(Theta):
    """A θ-scheme with Signorini's condition at the new position.

    For the infinite beam's first instants θ = 1: θ near ½ makes closed constraints rattle. For a whole beam with
    damping of its own ½, which damps nothing but impacts.
    """

    at_position: ClassVar[bool] = True
    rebounds: ClassVar[bool] = False
    elements_in_first_front: ClassVar[float] = 3.0
