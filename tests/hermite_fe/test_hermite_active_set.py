"""The compiled contact problem and its factors against truth: every active set tried, densely."""

import numpy as np
import pytest
from hermite_parts import dense
from numpy.typing import NDArray

from hermite_fe.active_set import CYCLING, MOST_ROUNDS, SOLVED, find_wrong, solve_constrained
from hermite_fe.constraints import ContactLaw, constraints_of
from hermite_fe.stepping import prepare, problem_of
from hermite_fe.system import ContactRows, System

Array = NDArray[np.float64]


def random_system(random: np.random.Generator) -> System:
    """A positive definite matrix put together from elements; up to seven rows of one dof, or of an element's four."""
    nodes = int(random.integers(2, 8))
    n = 2 * nodes
    full = np.diag(random.uniform(0.1, 4.0, n))
    for e in range(nodes - 1):  # elements, as in a beam
        part = random.normal(size=(4, 4)) * random.choice([0.1, 1.0, 10.0])
        full[2 * e : 2 * e + 4, 2 * e : 2 * e + 4] += part @ part.T
    bands = np.stack([np.pad(np.diag(full, -m), (0, m)) for m in range(4)])
    if random.random() < 0.5:
        dofs = 2 * np.sort(random.choice(nodes, int(random.integers(1, nodes + 1)), replace=False))[:, None]
    else:
        elements = np.sort(random.choice(nodes - 1, int(random.integers(1, nodes)), replace=False))
        dofs = 2 * elements[:, None] + np.arange(4)
    factors = random.choice([-1.0, 1.0], dofs.shape) * random.uniform(0.5, 2.0, dofs.shape)
    free = np.setdiff1d(np.arange(n), dofs) if dofs.shape[1] == 1 else np.arange(1, n, 2)
    supports = tuple(int(d) for d in free[random.random(free.size) < 0.1][:1])
    return System(
        mass=bands,
        stiffness=np.zeros((1, n)),
        contacts=ContactRows(dofs=dofs, factors=factors, gap=np.zeros(len(dofs))),
        supports=supports,
    )


def truth(system: System, b: Array, target: Array, candidate: Array, held: Array) -> tuple[Array, Array]:
    """x and p of the one active set, out of all, that breaks no sign (or breaks them least: round-off)."""
    rows, n = system.contacts, system.dofs
    m = len(rows)
    G = np.zeros((m, n))
    np.put_along_axis(G, rows.dofs, rows.factors, axis=1)
    keep = np.setdiff1d(np.arange(n), system.supports)
    inverse = np.zeros((n, n))
    inverse[np.ix_(keep, keep)] = np.linalg.inv(dense(system.mass)[np.ix_(keep, keep)])
    W, free = G @ inverse @ G.T, G @ inverse @ b - target
    sets = (np.arange(2**m)[:, None] >> np.arange(m)) & 1 == 1
    sets = sets[np.all(sets | ~held, axis=1) & np.all(~sets | candidate | held, axis=1)]
    both = sets[:, :, None] & sets[:, None, :]
    p = np.linalg.solve(np.where(both, W, np.eye(m)), np.where(sets, -free, 0.0)[:, :, None])[:, :, 0]
    slack = p @ W + free
    worst = np.maximum(np.where(held, 0.0, -p), np.where(candidate & ~sets, -slack, 0.0)).max(axis=1)
    best = int(np.argmin(worst))
    return inverse @ (b + G.T @ p[best]), p[best]


@pytest.mark.parametrize("seeds", [range(120), pytest.param(range(1000, 11000), marks=pytest.mark.verify)], ids=len)
def test_contact_problems_are_solved_as_by_trying_every_active_set(seeds: range) -> None:
    """Random problems, degenerate ones among them, each from three wrong guesses, and by the fall-back from none."""
    for seed in seeds:
        random = np.random.default_rng(seed)
        system = random_system(random)
        problem = problem_of(system, ContactLaw())
        prepare(problem, 0.0, 0.0, 1.0, 1.0)
        conditions = constraints_of(problem.rows)
        n, m = system.dofs, len(system.contacts)
        b = random.normal(size=n)
        target = random.normal(size=m)
        degenerate = random.random()
        if degenerate < 0.1:
            b, target = np.round(b), np.zeros(m)
        elif degenerate < 0.3:  # some rows just touch: no gap and no reaction
            alone, _ = truth(system, b, np.zeros(m), np.zeros(m, bool), np.zeros(m, bool))
            there = np.einsum("jk,jk->j", system.contacts.factors, alone[system.contacts.dofs])
            target = np.where(random.random(m) < random.choice([0.5, 0.9]), there, target)
        candidate, held = random.random(m) < 0.9, random.random(m) < 0.1
        exact_x, exact_p = truth(system, b, target, candidate, held)
        scale = 1.0 + np.abs(exact_x).max() + np.abs(exact_p).max()
        conditions.target[:], conditions.candidate[:], conditions.least[:] = target, candidate, -1.0 * held
        x = np.zeros(n)
        # from one guess to the next the factors are kept; one by one where exchanging many at once runs in a circle
        for most_rounds in (MOST_ROUNDS, MOST_ROUNDS, MOST_ROUNDS, 0):
            conditions.closed[:] = random.random(m) < 0.5
            status = solve_constrained(problem.solver, problem.rows, conditions, b, x, most_rounds)
            if degenerate < 0.3 and most_rounds == 0:  # judged more leniently, but no row is left out in silence
                wrong, *_ = find_wrong(problem.solver, problem.rows, conditions, b, x, 1e-8)
                assert status == CYCLING or (status == SOLVED and wrong == 0), seed
                continue
            assert status == SOLVED, seed
            assert np.abs(x - exact_x).max() < 1e-7 * scale, seed
            assert np.abs(conditions.p - exact_p).max() < 1e-7 * scale, seed
