"""Plain arrays of a system, as the compiled kernels take them (named tuples, which numba knows)."""

from __future__ import annotations

from collections import namedtuple

import numpy as np

from hermite_fe._banded import by_rows
from hermite_fe.system import System

Problem = namedtuple("Problem", "M C K load dofs factors gap rank side tributary")
Contact = namedtuple("Contact", "restitution hold_rows hold_until")
State = namedtuple("State", "q v a closed impulse held_impulse budget worst closing")
Work = namedtuple("Work", "S fixed D U r z wrong b x p target candidate held y1 y2 y3 cache")

# places in State.worst: worst complementarity since the last look
SMALLEST_REACTION, PRODUCT, WORST = 0, 1, 2
# places in Work.cache: the coefficients S was made with
CACHE = 4


def problem_of(system: System) -> Problem:
    """The arrays of a system, bands by rows."""
    rows = system.contacts
    return Problem(
        by_rows(system.mass), by_rows(system.damping), by_rows(system.stiffness), system.load,  # type: ignore[arg-type]
        rows.dofs, rows.factors, rows.gap, rows.rank, rows.side, rows.tributary,
    )


def state_of(system: System, q: np.ndarray, v: np.ndarray) -> State:
    """A fresh state at the start, q and v copied."""
    m = len(system.contacts)
    return State(
        np.array(q, float), np.array(v, float), np.zeros(system.dofs), np.zeros(m, np.bool_), np.zeros(m),
        np.zeros(m), np.zeros(8), np.zeros(2), np.zeros(m),
    )


def work_of(system: System) -> Work:
    """Work space of the kernels; nothing in it outlives a step but the factors that still hold."""
    n, m = system.dofs, len(system.contacts)
    fixed = np.zeros(n, np.bool_)
    fixed[list(system.supports)] = True
    return Work(
        np.zeros((n, 4)), fixed, np.ones(n + 3), np.zeros((n + 3, 4)), np.zeros(n), np.zeros(n + 3),
        np.zeros(m, np.bool_), np.zeros(n), np.zeros(n), np.zeros(m), np.zeros(m), np.zeros(m, np.bool_),
        np.zeros(m, np.bool_), np.zeros(n), np.zeros(n), np.zeros(n), np.full(CACHE, np.nan),
    )
