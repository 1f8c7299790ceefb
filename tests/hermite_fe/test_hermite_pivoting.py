"""The compiled contact problem and factorisation against truth: every active set tried densely, and LAPACK."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded

from bent_beam.meshes import ScaleFreeMesh
from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts import Contact, MeanContact, NodeContact
from hermite_fe.kernels import (
    SOLVED,
    combine,
    force_at,
    multiply,
    problem_of,
    row_times,
    rows_times,
    solve_rows,
    stiff_multiply,
    works_of,
)
from hermite_fe.kernels.banded import quadratic, row_sums
from hermite_fe.kernels.contact import rows_times_both
from hermite_fe.kernels.monotone import solve_monotone
from hermite_fe.kernels.multipliers import extend
from hermite_fe.kernels.problem import Problem, Work
from hermite_fe.kernels.rows import CYCLING, wrong_rows
from hermite_fe.system import ContactRows, System

Array = NDArray[np.float64]


def dense(bands: Array) -> Array:
    """The symmetric matrix of lower bands."""
    n = bands.shape[1]
    lower = sum(np.diag(bands[m, : n - m], -m) for m in range(min(4, n)))
    return np.asarray(lower + np.tril(lower, -1).T)


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


def ready(random: np.random.Generator) -> tuple[System, Problem, Work]:
    """A random system with its matrix, and room to solve in."""
    system = random_system(random)
    problem = problem_of(system)
    work = works_of(system, problem, 1)[0]
    combine(problem.M, problem.C, problem.K, 1.0, 0.0, 0.0, work.place, work.S)
    return system, problem, work


def ready_for_all(random: np.random.Generator) -> tuple[System, Problem, Work]:
    """:func:`ready`, each row with its multiplier."""
    system, problem, work = ready(random)
    if work.span[0] < len(system.contacts):
        extend(problem, work, len(system.contacts) - 1)
    return system, problem, work


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


def check(seed: int) -> None:
    random = np.random.default_rng(seed)
    system, problem, work = ready(random)
    n, m = system.dofs, len(system.contacts)
    extent = int(random.integers(0, n + 1))
    b = random.normal(size=n) * (np.arange(n) < extent)
    target = random.normal(size=m)
    degenerate = random.random()
    if degenerate < 0.1:
        b, target = np.round(b), np.zeros(m)
    elif degenerate < 0.3:  # some rows just touch: no gap and no reaction
        none = np.zeros(m, bool)
        x, _ = truth(system, b, target, none, none)
        touching = np.einsum("jk,jk->j", system.contacts.factors, x[system.contacts.dofs])
        target = np.where(random.random(m) < 0.5, touching, target)
    candidate, held = random.random(m) < 0.9, random.random(m) < 0.1
    x, p = truth(system, b, target, candidate, held)
    scale = 1.0 + np.abs(x).max() + np.abs(p).max()
    work.target[:], work.candidate[:], work.held[:] = target, candidate, held
    for attempt in range(3):  # from one guess to the next the factors are kept
        closed = random.random(m) < 0.5
        work.b[:] = b
        assert solve_rows(problem, work, attempt == 0, extent, closed) == SOLVED, seed
        assert np.abs(work.x - x).max() < 1e-7 * scale, seed
        assert np.abs(work.p - p).max() < 1e-7 * scale, seed


def test_contact_problems_are_solved_as_by_trying_every_active_set() -> None:
    """300 random problems, degenerate ones among them, each from three wrong guesses."""
    for seed in range(300):
        check(seed)


def test_the_fall_back_finds_the_same_reactions_from_none() -> None:
    """What takes over when exchanging many rows at once runs in a circle, asked directly."""
    for seed in range(200):
        random = np.random.default_rng(seed)
        system, problem, work = ready_for_all(random)
        n, m = system.dofs, len(system.contacts)
        b, target = random.normal(size=n), random.normal(size=m)
        candidate, held = random.random(m) < 0.9, random.random(m) < 0.1
        work.b[:], work.target[:], work.candidate[:], work.held[:] = b, target, candidate, held
        work.p[:] = random.normal(size=m)  # whatever was there before
        x, p = truth(system, b, target, candidate, held)
        closed = random.random(m) < 0.5
        status, solutions = solve_monotone(problem, work, closed, 1e-12)
        scale = 1.0 + np.abs(x).max() + np.abs(p).max()
        assert status == SOLVED and solutions <= 3 * m, seed
        assert np.abs(work.y[work.place] - x)[work.place < n].max() < 1e-7 * scale, seed
        assert np.abs(np.where(closed, work.p, 0.0) - p).max() < 1e-7 * scale, seed


@pytest.mark.parametrize("tolerance", [1e-13, 1e-17])
def test_the_fall_back_never_calls_a_row_inside_the_wall_solved(tolerance: float) -> None:
    """Rows that just touch, by a tolerance beyond and below round-off; there no row may be left out in silence."""
    given_up = 0
    for seed in range(200):
        random = np.random.default_rng([5, seed])
        system, problem, work = ready_for_all(random)
        n, m = system.dofs, len(system.contacts)
        none = np.zeros(m, bool)
        b, target = random.normal(size=n), random.normal(size=m)
        x, _ = truth(system, b, target, none, none)
        touching = np.einsum("jk,jk->j", system.contacts.factors, x[system.contacts.dofs])
        work.b[:], work.target[:] = b, np.where(random.random(m) < 0.9, touching, target)
        work.candidate[:], work.held[:] = True, False
        closed = none.copy()
        status, _ = solve_monotone(problem, work, closed, tolerance)
        if status == SOLVED:
            assert wrong_rows(problem, work, closed, 0, m, 0, work.y.size, tolerance)[0] == 0, seed
        else:
            assert status == CYCLING
            given_up += 1
    assert (given_up == 0) == (tolerance > 1e-15)


@pytest.mark.verify
def test_ten_thousand_contact_problems() -> None:
    for seed in range(1000, 11000):
        check(seed)


def test_the_factors_solve_like_lapack_s() -> None:
    """The step matrix of a strongly graded beam, scaled to a unit diagonal for the comparison."""
    beam = HermiteBeam(ScaleFreeMesh(element_length=1e-3, growth=1.02).nodes(10.0), 1.0, 1.0)
    system = System(
        mass=beam.mass(),
        stiffness=beam.stiffness(),
        contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[0.0]),
    )
    problem = problem_of(system)
    work = works_of(system, problem, 1)[0]
    combine(problem.M, problem.C, problem.K, 1.0, 0.0, 1e-6, work.place, work.S)
    bands = system.mass + 1e-6 * system.stiffness
    known = np.random.default_rng(1).normal(size=system.dofs)
    work.b[:] = dense(bands) @ known
    assert solve_rows(problem, work, True, system.dofs, np.zeros(1, bool)) == SOLVED
    lapack = cho_solve_banded((cholesky_banded(bands, lower=True), True), work.b)
    worst = np.abs(lapack - known).max()
    assert 0.0 < worst < 1e-6
    assert np.abs(work.x - known).max() < 5.0 * worst


@pytest.mark.parametrize("n", [2, 4, 6, 8, 10, 16, 30])
def test_products_are_those_of_the_dense_matrix(n: int) -> None:
    random = np.random.default_rng(n)
    bands, x, y = random.normal(size=(4, n)), random.normal(size=n), np.zeros(n)
    for m in range(4):
        bands[m, max(n - m, 0) :] = 0.0
    full = dense(bands)
    for first in {n, n - 1, n // 2, 1}:  # x is taken as zero beyond
        multiply(bands, x, y, first)
        assert y[:first] == pytest.approx(full[:first, :first] @ x[:first], rel=1e-13, abs=1e-13)
    assert quadratic(bands, x) == pytest.approx(x @ full @ x, rel=1e-12, abs=1e-12)
    stiff_multiply(bands, *row_sums(bands), x, y)
    assert y == pytest.approx(full @ x, rel=1e-13, abs=1e-13)


@pytest.mark.parametrize("width", [1, 4])
def test_gaps_are_rows_times_displacements(width: int) -> None:
    random = np.random.default_rng(width)
    dofs = np.array([[0], [3], [4]]) + np.arange(width)
    factors, x, out = random.normal(size=(3, width)), random.normal(size=9), np.full(3, 7.0)
    exact = (factors * x[dofs]).sum(axis=1)
    rows_times(dofs, factors, x, out)
    assert out == pytest.approx(exact, rel=1e-14)
    assert [row_times(dofs, factors, x, j) for j in range(3)] == pytest.approx(exact, rel=1e-14)
    first, second = np.empty(3), np.empty(3)
    rows_times_both(dofs, factors, x, x[::-1].copy(), first, second)
    assert first == pytest.approx(exact, rel=1e-14)
    assert second == pytest.approx((factors * x[::-1][dofs]).sum(axis=1), rel=1e-14)


def test_loads_are_powers_of_time() -> None:
    load, force = np.array([[1.0, -2.0], [0.5, 3.0], [-4.0, 0.25]]), np.full(2, 9.0)
    t, h, theta = 0.7, 0.2, 0.6
    force_at(load, t, h, theta, force)
    exact = [theta * np.polyval(c[::-1], t + h) + (1.0 - theta) * np.polyval(c[::-1], t) for c in load.T]
    assert force == pytest.approx(exact, rel=1e-14)


@pytest.mark.parametrize("contact", [NodeContact(), MeanContact()], ids=["nodes", "elements"])
def test_a_load_near_the_contact_moves_nothing_far_away(contact: Contact) -> None:
    """A short right-hand side is solved only as far as anything moves, and to the same answer."""
    beam = HermiteBeam(np.linspace(0.0, 40.0, 1601), 1.0, 1.0)
    rows = contact.rows(beam, np.zeros(3202), full=False)
    system = System(mass=beam.mass(), stiffness=beam.stiffness(), contacts=rows)
    problem = problem_of(system)
    short, whole = works_of(system, problem, 2)
    combine(problem.M, problem.C, problem.K, 1.0, 0.0, 1e-6, short.place, short.S)
    for work, extent, fresh in ((short, 30, True), (whole, system.dofs, False)):
        work.b[:30] = np.sin(np.arange(30))
        work.candidate[:20] = True
        assert solve_rows(problem, work, fresh, extent, np.zeros(len(rows), bool)) == SOLVED
    assert 30 < short.extent[0] < 0.9 * system.dofs
    assert np.all(short.x[short.extent[0] :] == 0.0)
    assert np.abs(short.x - whole.x).max() < 1e-15 * np.abs(whole.x).max()
    assert np.abs(short.p - whole.p).max() < 1e-14 * np.abs(whole.p).max()

def beam_rows(random, nodes, width):
    beam = HermiteBeam(np.cumsum(random.uniform(0.5, 1.5, nodes)), 1.0, 1.0)
    m = nodes - (width > 1)
    dofs = 2 * np.arange(m)[:, None] + np.arange(width)
    factors = np.tile({1: [-1.0], 4: [-0.5, -0.1, -0.5, 0.1]}[width], (m, 1))
    rows = ContactRows(dofs=dofs, factors=factors, gap=np.zeros(m))
    return System(mass=beam.mass(), stiffness=beam.stiffness(), contacts=rows, supports=(1,) if width == 1 else ())


@pytest.mark.parametrize("width", [1, 4])
def test_what_is_settled_behind_a_front_is_factored_once(width: int) -> None:
    """A front runs over a beam, now and then something lifts behind it: the conditions hold after every solve."""
    retreats = 0
    for seed in range(10):
        random = np.random.default_rng(seed)
        system = beam_rows(random, 200, width)
        problem = problem_of(system)
        work = works_of(system, problem, 1)[0]
        n, m = system.dofs, len(system.contacts)
        combine(problem.M, problem.C, problem.K, 1.0, 0.0, 0.3, work.place, work.S)
        S, G = dense(system.mass + 0.3 * system.stiffness), np.zeros((m, n))
        np.put_along_axis(G, system.contacts.dofs, system.contacts.factors, axis=1)
        closed, twists = np.zeros(m, bool), []
        free = np.setdiff1d(np.arange(n), system.supports)
        for step in range(60):
            front = 3.0 * step
            b = random.normal(size=n) * 1e-3 + (np.arange(n) % 2 == 0) * np.where(np.arange(n) < 2 * front, 1.0, -0.05)
            if random.random() < 0.1:
                b[2 * random.integers(0, 60)] -= 30.0
            target = 1e-3 * random.normal(size=m)
            work.b[:], work.target[:], work.candidate[:] = b, target, True
            assert solve_rows(problem, work, step % 17 == 0, n, closed) == SOLVED
            twists.append(int(work.twist[0]))
            residual = (S @ work.x - b - G.T @ work.p)[free]
            slack = G @ work.x - target
            scale = np.abs(work.x).max() + np.abs(work.p).max()
            assert np.abs(residual).max() < 1e-9 * scale
            assert min(work.p.min(), slack.min()) > -1e-9 * scale
            assert np.abs(work.p * slack).max() < 1e-9 * scale**2
        assert max(twists) > n // 4, twists
        retreats += min(np.diff(twists)) < -20
    assert retreats > 0


@pytest.mark.parametrize("extent", [1000, 1602])
def test_rows_ahead_of_the_zone_have_no_multiplier_until_it_comes(extent: int) -> None:
    """The same reactions as with all multipliers from the start, while a load goes over the beam and back."""
    beam = HermiteBeam(np.linspace(0.0, 80.0, 801), 1.0, 1.0)
    rows = MeanContact().rows(beam, np.zeros(1602), full=False)
    system = System(mass=beam.mass(), stiffness=beam.stiffness(), contacts=rows, supports=(1601,))
    problem = problem_of(system)
    (late,), (early,) = works_of(system, problem, 1), works_of(system, problem, 1)
    spans = []
    closed = {0: np.zeros(800, bool), 1: np.zeros(800, bool)}
    for step, front in enumerate((0, 10, 30, 150, 155, 190, 240, 20)):
        for which, work in enumerate((late, early)):
            fresh = step % 3 == 0
            if fresh:
                combine(problem.M, problem.C, problem.K, 1.0, 0.0, 1e-4 * (1 + step), work.place, work.S)
            if step == 0 and which == 1:
                extend(problem, work, 799)
            work.b[:] = 0.0
            work.b[: 2 * front : 2] = 1.0 + np.sin(np.arange(front)) ** 2
            work.candidate[:], work.target[:] = True, -1e-3
            assert solve_rows(problem, work, fresh, extent, closed[which]) == SOLVED
        assert np.count_nonzero(late.p) > 0 or front == 0
        assert np.abs(late.x - early.x).max() <= 1e-12 * np.abs(early.x).max()
        assert np.abs(late.p - early.p).max() <= 1e-11 * np.abs(early.p).max()
        assert np.all(closed[0] == closed[1])
        spans.append(int(late.span[0]))
    assert spans[0] < 100 < spans[3] < spans[6] < 800 == early.span[0]
