"""Which contact constraints are closed at the end of a step:

    S x = b + Gᵀp,      0 ≤ p ⊥ G x − c ≥ 0,      x = 0 at supports.

The closed constraints, G x = c, are guessed; the system is solved (:mod:`hermite_fe.constraints`); the constraints
whose sign is wrong are exchanged, until none is (a primal–dual active set; Hintermüller, Ito, Kunisch 2003, SIAM J.
Optim. 13, 865). All wrong ones are exchanged in rounds in which their number has fallen fast. In others, of neighbours
that are all wrongly open or all wrongly closed only the worst is exchanged, or both if they are two: a beam is stiff
over a few nodes, so that this mends the rest. When the number has not fallen for ``PATIENCE`` rounds, only the wrong
one of highest index is exchanged (Murty's rule; Júdice & Pires 1994, Comput. Oper. Res. 21, 587). After ``MOST_ROUNDS``
:func:`exchange_one` starts anew, with all constraints open.

Signs are judged against round-off: p against the terms of its equation, a gap against the largest deflection and slope.
"""

from hermite_fe.banded import FADED, copy
from hermite_fe.compiled import Array, compiled, compiled_within
from hermite_fe.constraints import Constraints, Rows, Solver, count_rounds, exchange, update

SOLVED, SINGULAR, CYCLING, NOT_FINITE = range(4)

ROUND_OFF = 1e-13  # of the terms summed
MOST_LENIENT = 1e-8  # of them, in the fall-back, for constraints that nearly touch
FAST = 0.75  # of the round before: all are exchanged while the number falls below this share of it
FEW = 2  # runs up to this length are exchanged whole
PATIENCE = 10  # rounds without progress
MOST_ROUNDS = 500
MOST_EXCHANGES = 20  # a constraint, in the fall-back


@compiled_within
def equation(S: Array, y: Array, k: int) -> tuple[float, float]:
    """Row k of S y, and the sum of the absolute values of its terms."""
    term = S[0, k] * y[k]
    total, size = term, abs(term)
    for m in range(1, 5):
        left, right = S[m, k - m] * y[k - m], S[m, k] * y[k + m]
        total += left + right
        size += abs(left) + abs(right)
    return total, size


@compiled_within
def largest_of_a_kind(x: Array) -> tuple[float, float]:
    """The largest deflection and the largest slope of x: even and odd dofs."""
    deflection, slope = 0.0, 0.0
    for i in range(0, x.size, 2):
        deflection = max(deflection, abs(x[i]))
    for i in range(1, x.size, 2):
        slope = max(slope, abs(x[i]))
    return deflection, slope


@compiled_within
def find_wrong(
    solver: Solver, rows: Rows, conditions: Constraints, b: Array, x: Array, tolerance: float
) -> tuple[int, int]:
    """Put the impulses in ``conditions.p``, and in ``solver.excess`` by how much the sign of each constraint is
    wrong, 0 where it is right. Returns how many are wrong, and the last of them (−1: none)."""
    dofs, factors, p, target = rows.dofs, rows.factors, conditions.p, conditions.target
    width = dofs.shape[1]
    deflection, slope = largest_of_a_kind(x)
    count, last = 0, -1
    for j in range(p.size):
        p[j], excess, bound = 0.0, 0.0, 0.0
        if solver.closed[j]:
            d = dofs[j, 0]
            total, size = equation(solver.S, solver.y, solver.unknown[d])
            if width == 1:
                p[j] = (total - b[d]) / factors[j, 0]
            else:
                p[j] = -solver.y[solver.row_unknown[j]]
            excess = 0.0 if conditions.least[j] < 0.0 else -p[j]
            bound = tolerance * (size + abs(b[d])) / abs(factors[j, 0])
        elif conditions.candidate[j]:
            excess, bound = target[j], tolerance * abs(target[j])
            for i in range(width):
                excess -= factors[j, i] * x[dofs[j, i]]
                bound += tolerance * abs(factors[j, i]) * (slope if dofs[j, i] % 2 == 1 else deflection)
        solver.excess[j] = excess if excess > bound else 0.0
        if excess > bound:
            count += 1
            last = j
    return count, last


@compiled_within
def begin(solver: Solver, rows: Rows, conditions: Constraints) -> None:
    """Open and close constraints as ``conditions`` guesses. Those that may pull are always closed; of the others
    only candidates may be."""
    closed = conditions.closed
    for j in range(closed.size):
        closed[j] = conditions.least[j] < 0.0 or (closed[j] and conditions.candidate[j])
        if solver.closed[j] != closed[j]:
            exchange(solver, rows, j)


@compiled_within
def take_solution(solver: Solver, x: Array) -> None:
    """Copy the dofs from the solution to x, with negligible values set to zero."""
    for i in range(x.size):
        value = solver.y[solver.unknown[i]]
        x[i] = 0.0 if abs(value) < FADED else value


@compiled_within
def exchange_wrong(solver: Solver, rows: Rows, worst_only: bool) -> None:
    """Exchange the constraints whose sign is wrong: all, or the worst of each run of neighbours that are wrong
    alike."""
    excess, closed = solver.excess, solver.closed
    j, m = 0, excess.size
    while j < m:
        if excess[j] == 0.0:
            j += 1
            continue
        end, worst = j + 1, j
        while end < m and excess[end] > 0.0 and closed[end] == closed[j]:
            if excess[end] > excess[worst]:
                worst = end
            end += 1
        for i in range(j, end):
            if i == worst or end - j <= FEW or not worst_only:
                exchange(solver, rows, i)
        j = end


@compiled
def solve_constrained(
    solver: Solver, rows: Rows, conditions: Constraints, b: Array, x: Array, most_rounds: int = MOST_ROUNDS
) -> int:
    """Solve for x (dofs,) and ``conditions.p`` from the guess ``conditions.closed``; returns SOLVED, SINGULAR or
    CYCLING."""
    begin(solver, rows, conditions)
    p, status, rounds = conditions.p, CYCLING, 0
    before = fewest = p.size + 1
    patience, tolerance, latest = PATIENCE, ROUND_OFF, -1
    while status == CYCLING and rounds < most_rounds + MOST_EXCHANGES * (p.size + 1) and tolerance <= MOST_LENIENT:
        if rounds == most_rounds:
            for j in range(p.size):
                conditions.closed[j], solver.reached[j] = False, 0.0
            begin(solver, rows, conditions)
        rounds += 1
        if not update(solver, rows, b, conditions.target):
            status = SINGULAR
            break
        take_solution(solver, x)
        count, last = find_wrong(solver, rows, conditions, b, x, tolerance)
        patience = PATIENCE if count < fewest else patience - 1
        if count == 0:
            status = SOLVED
        elif rounds > most_rounds:
            latest, opened_at_once = exchange_one(solver, rows, p, last, latest)
            tolerance *= 10.0 if opened_at_once else 1.0
        elif patience > 0:
            exchange_wrong(solver, rows, count > FAST * before)
        else:
            exchange(solver, rows, last)
        before, fewest = count, min(fewest, count)
    copy(solver.closed, conditions.closed)
    count_rounds(solver, min(rounds, most_rounds))
    return status


@compiled_within
def exchange_one(solver: Solver, rows: Rows, p: Array, closing: int, latest: int) -> tuple[int, bool]:
    """The fall-back: exchange one constraint, so that an energy falls each time. Returns the one that was closed last,
    and whether it opens at once.

    The reactions p ≥ 0 minimise ½pᵀGS⁻¹Gᵀp + pᵀ(GS⁻¹b − c). The constraint that is furthest in the wall is closed;
    where a reaction then turns negative the step goes only as far as to the first that vanishes, and that one opens
    (Lawson & Hanson 1974, Solving Least Squares Problems, ch. 23). As the energy falls, no set of closed constraints
    comes back, unless by round-off. Then the one that was closed last opens at once: signs are from then on judged ten
    times more leniently.
    """
    reached, opening, share = solver.reached, -1, 1.0
    for j in range(p.size):
        if solver.closed[j] and solver.excess[j] > 0.0:
            here = reached[j] / (reached[j] - p[j])
            if here < share:
                opening, share = j, here
    for j in range(p.size):
        reached[j] = max(reached[j] + share * (p[j] - reached[j]), 0.0)
    if opening >= 0:
        reached[opening] = 0.0
        exchange(solver, rows, opening)
        return latest, opening == latest
    for j in range(p.size):
        if not solver.closed[j] and solver.excess[j] > solver.excess[closing]:
            closing = j
    exchange(solver, rows, closing)
    return closing, False


@compiled
def solve_free(solver: Solver, rows: Rows, b: Array, x: Array) -> int:
    """Solve S x = b with every constraint open; returns SOLVED or SINGULAR."""
    for j in range(solver.closed.size):
        if solver.closed[j]:
            exchange(solver, rows, j)
    if not update(solver, rows, b, b):  # no target is read where no constraint is closed
        return SINGULAR
    take_solution(solver, x)
    return SOLVED
