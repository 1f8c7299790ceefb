"""Plain arrays of a system, as the compiled kernels take them (named tuples, which numba knows).

Unknowns of a step are the dofs, in order, and between them one multiplier for each row that touches several
dofs (after the middle one of its dofs: between the two nodes of an element). ``place`` says which unknown a
dof is, ``switch`` which unknown a row fixes (the dof itself when it touches only one), ``reach`` the last
unknown that a row touches.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hermite_fe._banded import row_sums
from hermite_fe.system import System

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]


class Problem(NamedTuple):
    """What does not change during a run."""

    M: Array
    C: Array
    K: Array
    even: Array
    odd: Array
    load: Array
    dofs: Places
    factors: Array
    gap: Array
    rank: Places
    side: Places
    tributary: Array
    place: Places
    switch: Places
    reach: Places


class ContactLaw(NamedTuple):
    """Impact law and hold (:mod:`hermite_fe.contacts.base`)."""

    restitution: float
    hold: int
    hold_until: float


class State(NamedTuple):
    """What a step changes.

    q, v : motion; acceleration, a, reaction, reaction_a : smooth acceleration and reaction of generalised-α,
        and their filtered companions
    closed : rows in contact; resting : rows closed without rebound
    impulse, held_impulse : so far; budget : energy sums; worst : complementarity since the last look
    """

    q: Array
    v: Array
    a: Array
    acceleration: Array
    reaction: Array
    reaction_a: Array
    closed: Flags
    resting: Flags
    impulse: Array
    held_impulse: Array
    budget: Array
    worst: Array


class Work(NamedTuple):
    """Work space; nothing in it outlives a step but the factors that still hold, and what ``made_with`` says
    of them."""

    S: Array
    fixed: Flags
    D: Array
    R: Array
    U: Array
    r: Array
    z: Array
    y: Array
    wrong: Flags
    b: Array
    x: Array
    p: Array
    target: Array
    candidate: Flags
    held: Flags
    gap: Array
    speed: Array
    d1: Array
    d2: Array
    d3: Array
    made_with: Array
    rounds: NDArray[np.int64]  # solves, active-set iterations of all of them, most of one


SMALLEST_REACTION, PRODUCT = 0, 1  # places in State.worst
WORK, VISCOUS, IMPACT, ALGORITHMIC = 0, 1, 2, 3  # places in State.budget, compensations four further


def problem_of(system: System) -> Problem:
    """The arrays of a system."""
    rows = system.contacts
    m, width = rows.dofs.shape
    place = np.arange(system.dofs)
    if width > 1:
        after = np.sort(rows.dofs, axis=1)[:, (width - 1) // 2]
        place = place + np.searchsorted(after, np.arange(system.dofs), side="left")
        switch = place[after] + 1
        tight = np.all(np.diff(switch) > 0) and np.abs(place[rows.dofs] - switch[:, None]).max(initial=0) <= 4
        for bands in (system.mass, system.stiffness, system.damping):
            for k in range(1, 4):
                apart = place[k:] - place[:-k] > 4
                tight = tight and not np.any(bands[k, :-k][apart])
        if not tight:
            raise ValueError(
                "contact rows must each touch a few neighbouring dofs, at most one row for two dofs"
            )
    else:
        switch = rows.dofs[:, 0].copy()
    reach = np.maximum(place[rows.dofs].max(axis=1), switch) if m else np.zeros(0, np.int64)
    return Problem(
        system.mass,
        system.damping,
        system.stiffness,
        *row_sums(system.stiffness),
        system.load,
        rows.dofs,
        rows.factors,
        rows.gap,
        rows.rank,
        rows.side,
        rows.tributary,
        place,
        switch,
        np.asarray(reach),
    )


def state_of(system: System, q: Array, v: Array) -> State:
    """A fresh state at the start, q and v copied."""
    n, m = system.dofs, len(system.contacts)
    return State(
        np.array(q, float),
        np.array(v, float),
        np.zeros(n),
        np.zeros(n),
        np.zeros(m),
        np.zeros(m),
        np.zeros(m, np.bool_),
        np.zeros(m, np.bool_),
        np.zeros(m),
        np.zeros(m),
        np.zeros(8),
        np.zeros(2),
    )


def work_of(system: System, problem: Problem) -> Work:
    """Work space for a system."""
    n, m = system.dofs, len(system.contacts)
    direct = problem.dofs.shape[1] == 1
    size = n if direct else n + m
    fixed = np.zeros(size, np.bool_)
    fixed[problem.place[list(system.supports)]] = True
    S = np.zeros((size, 5))
    x = np.zeros(n)
    if not direct:
        fixed[problem.switch] = True
        S[problem.switch, 0] = 0.0
        for j in range(m):
            for d, factor in zip(problem.dofs[j], problem.factors[j]):
                k, s = int(problem.place[d]), int(problem.switch[j])
                S[max(k, s), abs(k - s)] = factor
    flags = [np.zeros(m, np.bool_) for _ in range(3)]
    return Work(
        S,
        fixed,
        np.ones(size + 4),
        np.ones(size + 4),
        np.zeros((size + 4, 5)),
        np.zeros(size),
        np.zeros(size + 4),
        x if direct else np.zeros(size),
        flags[0],
        np.zeros(n),
        x,
        np.zeros(m),
        np.zeros(m),
        flags[1],
        flags[2],
        np.zeros(m),
        np.zeros(m),
        np.zeros(n),
        np.zeros(n),
        np.zeros(n),
        np.full(2, np.nan),
        np.zeros(3, np.int64),
    )
