"""Plain arrays of a system, as the compiled kernels take them (named tuples, which numba knows).

Unknowns of a step are the dofs, in order, and between them one multiplier for each row that touches several
dofs (after the middle one of its dofs: between the two nodes of an element). ``switch`` says which unknown a row fixes
(the dof itself when it touches only one), ``reach`` the last unknown that a row touches. Rows far ahead of the contact
zone have no multiplier yet (:mod:`.multipliers`): ``span`` counts those that have, ``place`` says which unknown a dof
is.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.banded import row_sums
from hermite_fe.system import System

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]


class Problem(NamedTuple):
    """What does not change during a run.

    M, C, K, load, dofs … tributary, supports : of the :class:`System` and its rows
    even, odd, damping_even, damping_odd : :func:`row_sums` of K and of C
    still : dofs before which a translation of the whole beam may raise forces, or a load acts
    lever : largest sum of a row's |factors| of deflections, and of slopes
    before : rows whose multipliers come before a dof; switch, reach : see above
    """

    M: Array
    C: Array
    K: Array
    parts: Array  # of C, (causes, 4, dofs), only those that are not zero
    slots: Places  # where in State.budget each part of C is booked
    even: Array
    odd: Array
    damping_even: Array
    damping_odd: Array
    still: int
    load: Array
    dofs: Places
    factors: Array
    gap: Array
    rank: Places
    side: Places
    tributary: Array
    lever: Array
    supports: Places
    before: Places
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
        and their filtered companions; jump : C·(jump of v) + K·(jump of q) of the last step
    closed : rows in contact; resting : rows closed without rebound
    impulse, held_impulse : so far; budget : energy sums; worst : complementarity since the last look
    """

    q: Array
    v: Array
    a: Array
    acceleration: Array
    reaction: Array
    reaction_a: Array
    jump: Array
    closed: Flags
    resting: Flags
    impulse: Array
    held_impulse: Array
    budget: Array
    worst: Array


class Work(NamedTuple):
    """Work space of one contact problem; nothing in it outlives a step but the factors that still hold, and what
    ``made_with`` says of them. Problems that a step solves one after the other share the matrix S, its factors and
    what is scratch (:func:`works_of`).

    place, span : see above
    S : step matrix by rows; fixed : unknowns whose equation is x = r
    D, U : factors; meeting : scratch of theirs (:mod:`.banded`); z, y : of a solution, free between two
    wrong, excess : rows whose sign is wrong, and by how much; known, barred : of the rows, scratch (:mod:`.monotone`)
    b : right-hand side, (dofs,); target, candidate, held : of the rows; x, p : the solution, (dofs,) and (rows,)
    gap, speed, d1, d2, d3 : free for the integrator; lost : (causes of damping,), likewise
    twist : where the factorisation from either end meets, and the unknown below which no row has switched of late
    extent : unknowns of the solution that are not zero, counted from the start of the beam
    """

    place: Places
    span: Places
    S: Array
    fixed: Flags
    D: Array
    U: Array
    meeting: Array
    z: Array
    y: Array
    wrong: Flags
    excess: Array
    known: Array
    barred: Flags
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
    lost: Array
    made_with: Array  # the step that S was made with, alone
    length: Places  # and how many dofs it was made for, where that is not all (:mod:`.ahead`)
    twist: NDArray[np.int64]
    extent: NDArray[np.int64]
    rounds: NDArray[np.int64]  # solves, active-set iterations of all of them, most of one


SMALLEST_REACTION, PRODUCT = 0, 1  # places in State.worst
WORK, IMPACT, ALGORITHMIC, VISCOUS, MATERIAL, ABSORBED = 0, 1, 2, 3, 4, 5
"""Places in State.budget, J since the start; their compensations come :data:`TERMS` further.

Work of the loads; loss in impacts, −Σ pᵀG(mean velocity), from contact impulses and velocities; loss to the scheme's
algorithmic damping, from its own quadratic form; losses −(work of Cq̇) to viscosity at grid scale, to the material's own
damping, to an absorber. Each comes from its cause: what they leave of Δ(T + V) is the defect of a run.
"""

TERMS = 6
SLOTS = {"viscous": VISCOUS, "material": MATERIAL, "absorbed": ABSORBED}


def problem_of(system: System) -> Problem:
    """The arrays of a system."""
    rows = system.contacts
    m, width = rows.dofs.shape
    before = np.zeros(system.dofs, np.int64)
    if width > 1:
        after = np.sort(rows.dofs, axis=1)[:, (width - 1) // 2]
        before = np.searchsorted(after, np.arange(system.dofs), side="left").astype(np.int64)
        place = np.arange(system.dofs) + before
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
    slopes = rows.dofs % 2 == 1
    lever = np.array([np.abs(rows.factors * here).sum(axis=1).max(initial=0.0) for here in (~slopes, slopes)])
    last = rows.dofs.max(axis=1)
    reach = np.maximum(last + before[last], switch) if m else np.zeros(0, np.int64)
    even, odd = row_sums(system.stiffness)
    damping_even, damping_odd = row_sums(system.damping)
    # a translation moves the even dofs alike
    felt = [np.where(np.arange(system.dofs) % 2 == 0, *sums) for sums in ((even, odd), (damping_even, damping_odd))]
    forced = np.flatnonzero(np.any([*felt, *system.load], axis=0))
    parts = [bands for _, bands in system.dampings]
    return Problem(
        M=system.mass,
        C=system.damping,
        K=system.stiffness,
        # one cause is C itself: less for a long beam to read
        parts=system.damping[None] if len(parts) == 1 else np.array(parts).reshape(-1, *system.damping.shape),
        slots=np.array([SLOTS[cause] for cause, _ in system.dampings], np.int64),
        even=even,
        odd=odd,
        damping_even=damping_even,
        damping_odd=damping_odd,
        still=int(forced[-1]) + 1 if forced.size else 0,
        # nothing for a long beam to read where there is no load
        load=system.load if np.any(system.load) else np.zeros((0, system.dofs)),
        dofs=rows.dofs,
        factors=rows.factors,
        gap=rows.gap,
        rank=rows.rank,
        side=rows.side,
        tributary=rows.tributary,
        lever=lever,
        supports=np.array(system.supports, np.int64),
        before=before,
        switch=switch,
        reach=np.asarray(reach),
    )


def state_of(system: System, q: Array, v: Array) -> State:
    """A fresh state at the start, q and v copied."""
    n, m = system.dofs, len(system.contacts)
    return State(
        q=np.array(q, float),
        v=np.array(v, float),
        a=np.zeros(n),
        acceleration=np.zeros(n),
        reaction=np.zeros(m),
        reaction_a=np.zeros(m),
        jump=np.zeros(n),
        closed=np.zeros(m, np.bool_),
        resting=np.zeros(m, np.bool_),
        impulse=np.zeros(m),
        held_impulse=np.zeros(m),
        budget=np.zeros(2 * TERMS),
        worst=np.zeros(2),
    )


def work_of(system: System, problem: Problem) -> Work:
    """Work space for a system."""
    n, m = system.dofs, len(system.contacts)
    direct = problem.dofs.shape[1] == 1
    size = n if direct else n + m
    fixed = np.zeros(size, np.bool_)
    fixed[list(system.supports)] = True
    x = np.zeros(n)
    return Work(
        place=np.arange(n),
        span=np.full(1, m if direct else 0),
        S=np.zeros((size, 5)),
        fixed=fixed,
        D=np.ones(size + 4),
        U=np.zeros((size + 4, 5)),
        meeting=np.zeros((4, 5)),
        z=np.zeros(size + 4),
        y=x if direct else np.zeros(size),
        wrong=np.zeros(m, np.bool_),
        excess=np.zeros(m),
        known=np.zeros(m),
        barred=np.zeros(m, np.bool_),
        b=np.zeros(n),
        x=x,
        p=np.zeros(m),
        target=np.zeros(m),
        candidate=np.zeros(m, np.bool_),
        held=np.zeros(m, np.bool_),
        gap=np.zeros(m),
        speed=np.zeros(m),
        d1=np.zeros(n),
        d2=np.zeros(n),
        d3=np.zeros(n),
        lost=np.zeros(problem.slots.size),
        made_with=np.full(1, np.nan),
        length=np.zeros(1, np.int64),
        twist=np.zeros(2, np.int64),
        extent=np.full(1, n),
        rounds=np.zeros(3, np.int64),
    )


def works_of(system: System, problem: Problem, count: int) -> tuple[Work, ...]:
    """Work space for ``count`` contact problems with one matrix, solved one after the other in every step."""
    first = work_of(system, problem)
    works = [first]
    for _ in range(count - 1):
        other = work_of(system, problem)
        own = ("y", "b", "x", "p", "target", "candidate", "held", "gap", "speed", "extent", "rounds")
        works.append(first._replace(**{name: getattr(other, name) for name in own}))
    return tuple(works)
