"""Multipliers of rows that touch several dofs: only rows near the contact zone have one.

A row's multiplier stands among the unknowns, between the dofs of two nodes. Rows ahead of the zone are open, and need
none: there, unknowns are dofs, and the step matrix is as narrow as that of contact at the nodes. When the zone comes
near the last row that has a multiplier, more are given one, many at a time.
"""

from __future__ import annotations

from hermite_fe.kernels.jit import compiled_apart
from hermite_fe.kernels.problem import Problem, Work

FIRST = 64  # rows that have a multiplier from the first solution on
GROWTH = 1.5  # of their number


@compiled_apart
def extend(problem: Problem, work: Work, row: int) -> None:
    """Give row number ``row`` a multiplier, with all before it and some beyond: unknowns beyond move on, in S too, and
    all has to be factored anew."""
    S, place, before, switch = work.S, work.place, problem.before, problem.switch
    n = place.size
    span = min(max(row + FIRST, int(GROWTH * work.span[0])), switch.size)
    for i in range(n - 1, -1, -1):
        old, new = place[i], i + min(before[i], span)
        if new == old:
            break
        s1 = S[old, old - place[i - 1]] if i > 0 else 0.0
        s2 = S[old, old - place[i - 2]] if i > 1 and old - place[i - 2] < 5 else 0.0
        s3 = S[old, old - place[i - 3]] if i > 2 and old - place[i - 3] < 5 else 0.0
        diagonal = S[old, 0]
        S[new, :] = 0.0
        S[new, 0] = diagonal
        for back, value in ((1, s1), (2, s2), (3, s3)):
            if i >= back:
                apart = new - (i - back) - min(before[i - back], span)
                if apart < 5:
                    S[new, apart] = value
        place[i] = new
    for j in range(work.span[0], span):
        S[switch[j], :] = 0.0
    for j in range(work.span[0], span):
        for i in range(problem.dofs.shape[1]):
            k, s = place[problem.dofs[j, i]], switch[j]
            S[max(k, s), abs(k - s)] = problem.factors[j, i]
    work.fixed[:] = False
    for j in range(span):
        work.fixed[switch[j]] = True
    for support in problem.supports:
        work.fixed[place[support]] = True
    work.span[0] = span


