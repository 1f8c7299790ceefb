"""Compiled kernels: what a time integrator is put together from.

| module | what |
| --- | --- |
| :mod:`.problem` | the arrays of a system, its state, work space; where energy is booked |
| :mod:`.banded` | products, the step matrix, factorisation, forward and back substitution |
| :mod:`.pivoting` | ``solve_rows``: a banded linear complementarity problem |
| :mod:`.contact` | rows times vectors, loads at an instant, rows that are held |
| :mod:`.stepping` | forces, the acceleration at the start, the energy of a step |
| :mod:`.theta`, :mod:`.generalized_alpha` | whole steps of the integrators that come with the project |

The names below are the public ones (see ``docs/guide/add-integrator.md``). They take NumPy arrays and can be
called from Python or from a function of your own under :func:`compiled`.
"""

from hermite_fe.kernels.banded import combine, dot, multiply, quadratic, stiff_multiply
from hermite_fe.kernels.contact import force_at, mark_held, row_times, rows_times
from hermite_fe.kernels.jit import compiled
from hermite_fe.kernels.pivoting import solve_rows
from hermite_fe.kernels.problem import ContactLaw, Problem, State, Work, problem_of, state_of, works_of
from hermite_fe.kernels.rows import CYCLING, NOT_FINITE, SINGULAR, SOLVED
from hermite_fe.kernels.stepping import book_step, initial_acceleration, residual_force

__all__ = [
    "CYCLING",
    "NOT_FINITE",
    "SINGULAR",
    "SOLVED",
    "ContactLaw",
    "Problem",
    "State",
    "Work",
    "book_step",
    "combine",
    "compiled",
    "dot",
    "force_at",
    "initial_acceleration",
    "mark_held",
    "multiply",
    "problem_of",
    "quadratic",
    "residual_force",
    "row_times",
    "rows_times",
    "solve_rows",
    "state_of",
    "stiff_multiply",
    "works_of",
]
