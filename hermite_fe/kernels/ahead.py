"""The part of a beam where no wave has arrived yet: it moves as a whole, and no step has to work there.

In bending, waves have no front: what a contact does is felt everywhere at once, but falls off so fast with distance
that most of a long beam feels less than 1e-50 of it for most of a run. There a solution is cut
(:func:`hermite_fe.kernels.pivoting.solve_near`), and where a beam translates as a whole no force arises. So steps take
as many dofs as move, and some beyond, for the whole beam; a solution that does not fade within them is made again with
more.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hermite_fe.kernels.jit import compiled_apart, compiled_in_place

Array = NDArray[np.float64]

BEYOND = 1.25  # times as many dofs as move are taken
LEAST = 64  # and as many more
MOST = 0.8  # of the dofs; with more, all are taken


@compiled_apart
def moving(still: int, q: Array, v: Array) -> int:
    """Dofs before which the beam does not move as a whole: beyond, no slopes, and all deflections alike, and no force
    where they are: from ``still`` on, as in :class:`hermite_fe.kernels.problem.Problem`."""
    end = (q.size - 1) // 2 * 2
    for i in range(q.size - 1, still - 1, -1):
        alike = q[i] == q[end] and v[i] == v[end] if i % 2 == 0 else q[i] == 0.0 and v[i] == 0.0
        if not alike:
            return i + 1
    return still


@compiled_in_place
def dofs_to_take(n: int, needed: int) -> int:
    """Of ``n`` dofs, where ``needed`` move or may touch the wall."""
    taken = int(BEYOND * needed) + LEAST
    return taken if taken < MOST * n else n


@compiled_in_place
def chosen_length(n: int, needed: int, made_for: int) -> int:
    """:func:`dofs_to_take`, or as many as the factors at hand are made for, if these are enough and not many more."""
    taken = dofs_to_take(n, needed)
    return made_for if needed < made_for <= taken else taken


@compiled_apart
def carry(q: Array, first: int, stop: int) -> None:
    """Dofs ``first`` … ``stop`` − 1 moved as the two before them."""
    for i in range(first, stop):
        q[i] = q[i - 2]


@compiled_apart
def last_nonzero(x: Array, stop: int) -> int:
    """How many of the first ``stop`` numbers there are up to the last that is not zero."""
    for i in range(stop - 1, -1, -1):
        if x[i] != 0.0:
            return i + 1
    return 0
