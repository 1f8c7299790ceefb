"""Contact constraints as compiled code uses them, g = gap + G q ≥ 0, one row each, and the linear system of a time step
under closed ones, on banded matrices:

    S x = b + Gᵀp,      G x = c for the closed constraints,      p = 0 for the open,      x = 0 at supports.

A constraint on one dof fixes that dof while it is closed; p is the residual of its equation. A constraint on several
dofs has a multiplier −p among the unknowns, fixed at 0 while it is open. To open or close a constraint changes one
entry of ``fixed``, and makes the factors of that unknown and of all before it stale (:mod:`hermite_fe.banded`): half of
them on a full beam. Which constraints are closed is decided in :mod:`hermite_fe.active_set`.
"""

from typing import NamedTuple

import numpy as np

from bent_beam.errors import InputError
from hermite_fe.banded import PAD, copy, factor, substitute_back, substitute_forward
from hermite_fe.compiled import Array, Flags, Places, compiled, compiled_within
from hermite_fe.system import System

SMALLEST_REACTION, PRODUCT = range(2)
"""Indices in ``worst``: the smallest of an impulse less its bound, N s, negative where a constraint pulls harder than
it may; the largest |p·slack|, J, impulse times velocity or force times gap."""
WORST = ("smallest_reaction", "complementarity_product")


class ContactLaw(NamedTuple):
    """What constraints do that close: how they rebound, and how hard they may pull. A penalty has none.

    restitution : e. hold, hold_until : what is held (:mod:`hermite_fe.contacts`); nothing from ``hold_ends``, s, on.
    strength : (rows,), N, the pull at which a constraint that has closed opens; one number is that of all.
    """

    restitution: float = 0.0
    hold: int = 0
    hold_until: float = 0.0
    hold_ends: float = np.inf
    strength: Array = np.zeros(1)


class Rows(NamedTuple):
    """The rows of G, fields as in :class:`hermite_fe.system.ContactRows`."""

    dofs: Places
    factors: Array
    gap: Array
    order: Places
    tributary: Array


class Constraints(NamedTuple):
    """One set of conditions 0 ≤ p ⊥ G x − c ≥ 0 on the constraints, each array (rows,).

    target : c; candidate : whether the constraint may close; least : bound of p. A constraint that may pull, by a
        negative bound, stays closed in a solution; :func:`some_gave_way` then tells whether it has pulled harder.
    closed : the guess before a solution, the answer after; p : the multipliers, N s unless a scheme says otherwise.
    Gq, Gv : work arrays of the integrator.
    """

    candidate: Flags
    closed: Flags
    target: Array
    least: Array
    p: Array
    Gq: Array
    Gv: Array


def constraints_of(rows: Rows) -> Constraints:
    """One set of conditions, all constraints open."""
    m = rows.gap.size
    return Constraints(*np.zeros((2, m), np.bool_), *np.zeros((5, m)))


@compiled_within
def row_times(rows: Rows, x: Array, j: int) -> float:
    """Row j of G x."""
    total = 0.0
    for i in range(rows.dofs.shape[1]):
        total += rows.factors[j, i] * x[rows.dofs[j, i]]
    return total


@compiled
def rows_times(rows: Rows, x: Array, out: Array) -> None:
    """out = G x."""
    for j in range(out.size):
        out[j] = row_times(rows, x, j)


@compiled_within
def set_bounds(rows: Rows, law: ContactLaw, closed: Flags, t: float, h: float, least: Array) -> None:
    """Set the least impulses of a step from t: 0, of closed constraints −h·strength, of held ones −∞: before
    ``hold_until`` all that are closed, else those whose front is fewer than ``hold`` constraints ahead."""
    for j in range(closed.size):
        least[j] = -h * law.strength[j] if closed[j] else 0.0
    if t >= law.hold_ends or (law.hold == 0 and t >= law.hold_until):
        return
    right, left = -1, 0  # the front on either side of the middle
    for j in range(closed.size):
        if closed[j]:
            right, left = max(right, rows.order[j]), min(left, rows.order[j])
    for j in range(closed.size):
        behind = right - rows.order[j] if rows.order[j] >= 0 else rows.order[j] - left
        if closed[j] and (t < law.hold_until or behind < law.hold):
            least[j] = -np.inf


@compiled_within
def ask_for_gaps(rows: Rows, conditions: Constraints, q: Array, closed: Flags, h: float, theta: float) -> None:
    """Ask all constraints for g⁺ = g₀ + Gq + h(Gv + θGx) ≥ 0, Gv as it is; guess ``closed``."""
    rows_times(rows, q, conditions.Gq)
    copy(closed, conditions.closed)
    for j in range(closed.size):
        conditions.candidate[j] = True
        conditions.target[j] = -((rows.gap[j] + conditions.Gq[j]) / h + conditions.Gv[j]) / theta


@compiled_within
def find_candidates(rows: Rows, conditions: Constraints, q: Array, closed: Flags, ahead: float) -> None:
    """Those may close that are on the wall or in it a time ``ahead`` from now, or may pull; guess ``closed``."""
    rows_times(rows, q, conditions.Gq)
    copy(closed, conditions.closed)
    for j in range(closed.size):
        gap = rows.gap[j] + conditions.Gq[j] + ahead * conditions.Gv[j]
        conditions.candidate[j] = gap <= 0.0 or conditions.least[j] < 0.0


@compiled_within
def ask_for_rebound(law: ContactLaw, conditions: Constraints, now: Array) -> None:
    """Ask for Gv⁺ = now + Gx ≥ −eGv, e = 0 of constraints that may pull."""
    for j in range(now.size):
        rebound = 0.0 if conditions.least[j] < 0.0 else law.restitution
        conditions.target[j] = -now[j] - rebound * conditions.Gv[j]


@compiled_within
def some_gave_way(conditions: Constraints) -> bool:
    """Whether any pulls harder than it may: unilateral from now on, it asks for another solution."""
    found = False
    for j in range(conditions.p.size):
        if conditions.p[j] < conditions.least[j] < 0.0:
            conditions.least[j], found = 0.0, True
    return found


@compiled_within
def note_complementarity(rows: Rows, conditions: Constraints, x: Array, factor: float, worst: Array) -> None:
    """Record in ``worst`` how far closed constraints are from 0 ≤ p ⊥ Gx − c ≥ 0.

    x : the solution; factor : turns p into N s and Gx into m/s, or leaves N and m.
    """
    for j in range(conditions.p.size):
        if conditions.closed[j]:
            p, slack = conditions.p[j], factor * (row_times(rows, x, j) - conditions.target[j])
            worst[PRODUCT] = max(worst[PRODUCT], abs(factor * p * slack))
            worst[SMALLEST_REACTION] = min(worst[SMALLEST_REACTION], factor * (p - conditions.least[j]))


class Solver(NamedTuple):
    """The step matrix, its factors, and the constraints that they are made for.

    unknown : (dofs,), the index of a dof among the unknowns; row_unknown : (rows,), the one that a constraint fixes.
    S, U : (5, unknowns + 2 PAD); sign, fixed : (unknowns + 2 PAD,), see :func:`hermite_fe.banded.factor`.
    y : (unknowns + 2 PAD,), the right-hand side, then the solution.
    closed : (rows,), the constraints as the factors have them; excess : (rows,), by how much each sign is wrong.
    reached : (rows,), reactions on the way of the fall-back (:func:`hermite_fe.active_set.exchange_one`).
    stale : (1,), the last unknown whose factors are out of date, −1: none. step : (3,), h (s), c and k of S.
    rounds : (3,), contact problems solved, rounds of all of them, most rounds of one.
    """

    unknown: Places
    row_unknown: Places
    S: Array
    U: Array
    sign: Array
    fixed: Flags
    y: Array
    closed: Flags
    excess: Array
    reached: Array
    stale: Places
    step: Array
    rounds: Places


def solver_of(system: System) -> Solver:
    """The unknowns of ``system`` in order: dofs, and each multiplier after the second dof that its constraint touches.

    Raises ``ValueError`` when constraints on several dofs are not those of neighbouring nodes, one at most for two
    dofs.
    """
    rows, n = system.contacts, system.dofs
    m, width = rows.dofs.shape
    unknown = np.arange(n) + PAD
    if width == 1:
        row_unknown, size = unknown[rows.dofs[:, 0]], n + 2 * PAD
    else:
        before = np.sort(rows.dofs, axis=1)[:, (width - 1) // 2]  # the dof that a multiplier follows
        unknown += np.searchsorted(before, np.arange(n), side="left")
        row_unknown, size = unknown[before] + 1, n + m + 2 * PAD
        check_width(system, unknown, row_unknown)
    fixed, sign, U = np.zeros(size, np.bool_), np.ones(size), np.zeros((5, size))
    fixed[unknown[list(system.supports)]] = True
    U[0] = 1.0
    if width > 1:
        fixed[row_unknown], sign[row_unknown] = True, -1.0
    return Solver(
        unknown=unknown, row_unknown=row_unknown, S=np.zeros((5, size)), U=U, sign=sign, fixed=fixed,
        y=np.zeros(size), closed=np.zeros(m, np.bool_),
        excess=np.zeros(m), reached=np.zeros(m), stale=np.array([size - PAD - 1]), step=np.full(3, np.nan),
        rounds=np.zeros(3, np.int64),
    )  # fmt: skip


def check_width(system: System, unknown: Places, row_unknown: Places) -> None:
    """``ValueError`` when some matrix or constraint couples unknowns more than four apart."""
    tight = np.all(np.diff(row_unknown) > 0)
    tight &= np.abs(unknown[system.contacts.dofs] - row_unknown[:, None]).max(initial=0) <= 4
    for bands in (system.mass, system.stiffness, system.damping):
        for k in range(1, 4):
            tight &= not np.any(bands[k, :-k][unknown[k:] - unknown[:-k] > 4])
    if not tight:
        raise InputError("contact rows must each touch a few neighbouring dofs, at most one row for two dofs")


@compiled_within
def count_rounds(solver: Solver, rounds: int) -> None:
    """Note that one more problem has taken so many rounds."""
    solver.rounds[0] += 1
    solver.rounds[1] += rounds
    solver.rounds[2] = max(solver.rounds[2], rounds)


@compiled_within
def exchange(solver: Solver, rows: Rows, j: int) -> None:
    """Close constraint j if it is open, open it if it is closed."""
    solver.closed[j] = not solver.closed[j]
    k = solver.row_unknown[j]
    solver.fixed[k] = solver.closed[j] == (rows.dofs.shape[1] == 1)
    solver.stale[0] = max(solver.stale[0], k)


@compiled_within
def right_side(solver: Solver, rows: Rows, b: Array, target: Array) -> None:
    """The right-hand side of all unknowns, with the terms of known values moved to it."""
    right, fixed, S = solver.y, solver.fixed, solver.S
    for i in range(b.size):
        right[solver.unknown[i]] = 0.0 if fixed[solver.unknown[i]] else b[i]
    for j in range(solver.row_unknown.size):
        k = solver.row_unknown[j]
        if rows.dofs.shape[1] > 1:
            right[k] = target[j] if solver.closed[j] else 0.0
        elif solver.closed[j]:
            value = target[j] / rows.factors[j, 0]
            right[k] = value
            for m in range(1, 5):
                if not fixed[k - m]:
                    right[k - m] -= S[m, k - m] * value
                if not fixed[k + m]:
                    right[k + m] -= S[m, k] * value


@compiled_within
def update(solver: Solver, rows: Rows, b: Array, target: Array) -> bool:
    """Solve for y with the constraints as they are closed now; False where S is singular."""
    if not factor(solver.S, solver.fixed, solver.sign, solver.stale[0], solver.U):
        solver.step[0] = np.nan
        return False
    solver.stale[0] = -1
    right_side(solver, rows, b, target)
    substitute_forward(solver.U, solver.y)
    substitute_back(solver.U, solver.y)
    return True
