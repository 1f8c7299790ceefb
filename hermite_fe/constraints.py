"""Contact constraints in the form that compiled code uses: g = gap + G q ≥ 0, one row each."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hermite_fe.compiled import compiled
from hermite_fe.system import ContactRows

__all__ = ["WORST", "Constraints", "ContactLaw", "Rows", "constraints_of", "find_held", "note_complementarity",
           "row_times", "rows_of", "rows_times"]  # fmt: skip

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Places = NDArray[np.int64]

SMALLEST_REACTION, PRODUCT = range(2)
"""Indices in ``worst``: the smallest impulse of a constraint that is not held, and the largest |p·slack|."""
WORST = ("smallest_reaction", "complementarity_product")


class ContactLaw(NamedTuple):
    """The impact law and what is held against it (:mod:`hermite_fe.contacts`); nothing from ``hold_ends``, s,
    on."""

    restitution: float = 0.0
    hold: int = 0
    hold_until: float = 0.0
    hold_ends: float = np.inf


class Rows(NamedTuple):
    """The rows of G, fields as in :class:`hermite_fe.system.ContactRows`."""

    dofs: Places
    factors: Array
    gap: Array
    rank: Places
    side: Places
    tributary: Array


class Constraints(NamedTuple):
    """One set of conditions 0 ≤ p ⊥ G x − c ≥ 0 on the constraints, each array (rows,).

    target : c; candidate : whether the constraint may close; held : whether it stays closed, whatever the sign of p.
    closed : the guess on entry of a solution, the answer on return; p : the multipliers, N s unless a scheme says
        otherwise.
    Gq, Gv : work arrays of the integrator.
    """

    target: Array
    candidate: Flags
    held: Flags
    closed: Flags
    p: Array
    Gq: Array
    Gv: Array


def rows_of(contacts: ContactRows) -> Rows:
    """The arrays of ``contacts``."""
    return Rows(*(getattr(contacts, name) for name in Rows._fields))


def constraints_of(rows: Rows) -> Constraints:
    """One set of conditions, all constraints open."""
    m = rows.gap.size
    numbers, flags = np.zeros((4, m)), np.zeros((3, m), np.bool_)
    return Constraints(numbers[0], *flags, *numbers[1:])


@compiled
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


@compiled
def find_held(rows: Rows, law: ContactLaw, closed: Flags, t: float, held: Flags) -> None:
    """Mark the constraints that stay closed after time t: before ``hold_until`` all that are closed, else those whose
    front is fewer than ``hold`` constraints ahead."""
    held[:] = False
    if t >= law.hold_ends or (law.hold == 0 and t >= law.hold_until):
        return
    right, left = -1, -1  # the front on either side of the first to touch
    for j in range(closed.size):
        if closed[j] and rows.side[j] == 0:
            right = max(right, rows.rank[j])
        elif closed[j]:
            left = max(left, rows.rank[j])
    for j in range(closed.size):
        front = right if rows.side[j] == 0 else left
        held[j] = closed[j] and (t < law.hold_until or front - rows.rank[j] < law.hold)


@compiled
def note_complementarity(
    rows: Rows, conditions: Constraints, x: Array, to_impulse: float, to_speed: float, worst: Array
) -> None:
    """Record in ``worst`` how far closed constraints are from 0 ≤ p ⊥ Gx − c ≥ 0.

    x : the solution that ``conditions`` were imposed on; to_impulse, to_speed : turn p into N s and Gx into m/s (or m).
    """
    for j in range(conditions.p.size):
        if conditions.closed[j]:
            p, slack = to_impulse * conditions.p[j], to_speed * (row_times(rows, x, j) - conditions.target[j])
            worst[PRODUCT] = max(worst[PRODUCT], abs(p * slack))
            if not conditions.held[j]:
                worst[SMALLEST_REACTION] = min(worst[SMALLEST_REACTION], p)
