"""The compiled contact problem against the conditions of its one solution, and its factors against LAPACK's."""

import numpy as np
import pytest
from hermite_parts import dense
from scipy.linalg import cho_solve_banded, cholesky_banded

from bent_beam.meshes import ScaleFreeMesh
from hermite_fe.active_set import CYCLING, MOST_ROUNDS, SOLVED, find_wrong, solve_constrained
from hermite_fe.beam import HermiteBeam
from hermite_fe.compiled import Array, Flags
from hermite_fe.constraints import Constraints, ContactLaw, constraints_of
from hermite_fe.masses import ConsistentMass
from hermite_fe.stepping import Problem, prepare, problem_of
from hermite_fe.system import ContactRows, System


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
    return System(bands, np.zeros((1, n)), ContactRows(dofs, factors, np.zeros(len(dofs))), supports=supports)


def ready(system: System) -> tuple[Problem, Constraints]:
    """A system with its mass as the step matrix, and one set of conditions."""
    problem = problem_of(system, ContactLaw())
    prepare(problem, 0.0, 0.0, 1.0, 1.0)
    return problem, constraints_of(problem.rows)


def missed(system: System, conditions: Constraints, held: Flags, b: Array, x: Array) -> float:
    """By how much x and p miss what one x alone fulfils: Mx = b + Gᵀp, and of each row a gap or a push."""
    rows, p, forces = system.contacts, conditions.p, dense(system.mass) @ x - b
    np.subtract.at(forces, rows.dofs, p[:, None] * rows.factors)
    forces[list(system.supports)] = x[list(system.supports)]
    gap = np.einsum("jk,jk->j", rows.factors, x[rows.dofs]) - conditions.target
    contact = np.where(held, gap, np.where(conditions.candidate, np.minimum(gap, p), p))
    return float(max(np.abs(forces).max(), np.abs(contact).max()))


@pytest.mark.parametrize("seeds", [range(120), pytest.param(range(1000, 11000), marks=pytest.mark.verify)], ids=len)
def test_contact_problems_are_solved(seeds: range) -> None:
    """Random problems, degenerate ones among them, each from three wrong guesses, and by the fall-back from none."""
    for seed in seeds:
        random = np.random.default_rng(seed)
        system = random_system(random)
        problem, conditions = ready(system)
        n, m = system.dofs, len(system.contacts)
        b, target, degenerate = random.normal(size=n), random.normal(size=m), random.random()
        if degenerate < 0.1:
            b, target = np.round(b), np.zeros(m)
        elif degenerate < 0.3:  # some rows just touch: no gap and no reaction
            alone, keep = np.zeros(n), np.setdiff1d(np.arange(n), system.supports)
            alone[keep] = np.linalg.solve(dense(system.mass)[np.ix_(keep, keep)], b[keep])
            there = np.einsum("jk,jk->j", system.contacts.factors, alone[system.contacts.dofs])
            target = np.where(random.random(m) < random.choice([0.5, 0.9]), there, target)
        candidate, held = random.random(m) < 0.9, random.random(m) < 0.1
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
            scale = 1.0 + np.abs(x).max() + np.abs(conditions.p).max()
            assert missed(system, conditions, held, b, x) < 1e-9 * scale, seed


def test_the_factors_solve_like_lapack_s() -> None:
    """The step matrix of a strongly graded beam."""
    beam = HermiteBeam(ScaleFreeMesh(element_length=1e-3, growth=1.02).nodes(10.0), 1.0, 1.0)
    bands, one = ConsistentMass().matrix(beam) + 1e-6 * beam.stiffness(), ContactRows([[0]], [[1.0]], [0.0])
    problem, conditions = ready(System(mass=bands, stiffness=np.zeros((1, beam.dofs)), contacts=one))
    known = np.random.default_rng(0).normal(size=(8, beam.dofs))
    right, ours = known @ dense(bands), np.zeros_like(known)
    for b, x in zip(right, ours):
        assert solve_constrained(problem.solver, problem.rows, conditions, b, x, MOST_ROUNDS) == SOLVED
    lapack = cho_solve_banded((cholesky_banded(bands, lower=True), True), right.T).T
    assert np.abs(ours - known).max() < 5.0 * np.abs(lapack - known).max() < 5e-6
