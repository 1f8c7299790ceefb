"""What steps leave behind: no subnormal numbers, nothing strange for odd meshes and steps; the guide's integrator."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from half_beams import half_beam, stepper
from scipy.linalg import solveh_banded

from bent_beam import Impact
from bent_beam.meshes import ScaleFreeMesh, UniformMesh
from hermite_fe.beam import HermiteBeam
from hermite_fe.contacts import NodeContact
from hermite_fe.integrators import (
    GeneralizedAlphaPenalty,
    Integrator,
    MoreauJean,
    NonsmoothGeneralizedAlpha,
    SignoriniPosition,
)
from hermite_fe.run import Stepper, integrate
from hermite_fe.simulate import simulate
from hermite_fe.system import ContactRows, System

INTEGRATORS: dict[str, Integrator] = {
    "moreau_jean": MoreauJean(1e-3),
    "signorini_position": SignoriniPosition(1e-3),
    "velocity": NonsmoothGeneralizedAlpha(1e-3, levels="velocity"),
    "position_velocity": NonsmoothGeneralizedAlpha(1e-3, levels="position_velocity"),
    "position_velocity_acceleration": NonsmoothGeneralizedAlpha(1e-3),
    "penalty": GeneralizedAlphaPenalty(1e-3, stiffness=1e5, damping=1e3),
}
every = pytest.mark.parametrize("integrator", INTEGRATORS.values(), ids=INTEGRATORS)
GUIDE = Path(__file__).resolve().parents[2] / "docs/guide/add-integrator.md"


def long_beam(nodes: int, integrator: Integrator) -> Stepper:
    return stepper(half_beam(kappa=0.1, half_length=100.0, nodes=nodes), integrator)


def subnormal(run: Stepper) -> int:
    """How many numbers of the motion, and of what its integrator remembers of it, are subnormal."""
    arrays = [run.state.q, run.state.v, run.state.acceleration]
    for part in run.memory:
        arrays += [x for x in (part if isinstance(part, tuple) else (part,)) if np.ndim(x) and x.dtype == float]
    return sum(int(np.count_nonzero((x != 0.0) & (np.abs(x) < np.finfo(float).tiny))) for x in arrays)


@every
@pytest.mark.parametrize("nodes", [500, 1000, 2000, 4000])
def test_no_number_of_the_state_is_subnormal(integrator: Integrator, nodes: int) -> None:
    run = long_beam(nodes, integrator)
    for step in (5, 50, 200):
        assert run.advance_to(step) == 0
        assert subnormal(run) == 0


def test_without_care_they_would_be() -> None:
    """The solution of one step, and again of what it gives, as it fades along a beam, in plain floating-point
    numbers."""
    system = long_beam(2000, MoreauJean(1e-3)).problem.matrices
    bands = system.M + 1e-6 * system.K
    x = np.zeros(4000)
    x[0] = 1.0
    x = solveh_banded(bands, x, lower=True)
    assert np.count_nonzero((x != 0.0) & (np.abs(x) < np.finfo(float).tiny)) > 0


@every
def test_compiling_beforehand_changes_no_step(integrator: Integrator) -> None:
    ready, cold = long_beam(50, integrator), long_beam(50, integrator)
    ready.compile()
    assert ready.step == 0 and np.array_equal(ready.state.q, cold.state.q) and ready.iterations() == cold.iterations()
    for run in (ready, cold):
        run.advance_to(20)
    assert np.array_equal(ready.state.q, cold.state.q) and np.array_equal(ready.state.v, cold.state.v)


@every
def test_a_step_of_one_ulp_changes_nothing_to_speak_of(integrator: Integrator) -> None:
    run = long_beam(50, integrator)
    run.advance_to(100)
    q, v = run.state.q.copy(), run.state.v.copy()
    run.instants = run.instants.copy()
    run.instants[101] = np.nextafter(run.instants[100], 1.0)
    assert run.advance_to(101) == 0
    assert np.abs(run.state.q - q).max() <= 1e-12
    assert np.abs(run.state.v - v).max() <= 1e-9


@every
def test_an_undefined_number_in_the_motion_is_found_in_its_step(integrator: Integrator) -> None:
    run = long_beam(50, integrator)
    run.advance_to(5)
    run.state.q[60] = np.nan
    assert run.advance_to(20) != 0
    assert run.step == 5


def test_an_undefined_number_is_found_where_nothing_is_damped_loaded_or_closed() -> None:
    system = System(
        mass=[[1.0, 1.0]], stiffness=[[1.0, 1.0]], contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[100.0])
    )
    run = Stepper(system, np.zeros(2), np.ones(2), MoreauJean(1e-3, theta=0.5), 1.0)
    run.advance_to(5)
    run.state.q[1] = np.nan
    assert run.advance_to(20) != 0
    assert run.step == 5


def test_a_penalty_that_is_never_settled_is_refused() -> None:
    with pytest.raises(ValueError, match="contact_rounds must be a whole number of at least 1"):
        GeneralizedAlphaPenalty(1e-3, contact_rounds=0)


def test_beams_of_one_element_or_of_identical_nodes_are_refused() -> None:
    with pytest.raises(ValueError, match="at least two elements"):
        HermiteBeam(np.array([0.0, 1.0]), 1.0, 1.0)
    with pytest.raises(ValueError, match="nodes"):
        HermiteBeam(np.array([0.0, 0.5, 0.5, 1.0]), 1.0, 1.0)
    with pytest.raises(ValueError, match="nodes"):
        HermiteBeam(np.array([0.0, 0.5, np.nextafter(0.5, 0.0), 1.0]), 1.0, 1.0)


@pytest.mark.verify
@every
def test_the_budget_of_a_hundred_thousand_steps_closes(integrator: Integrator) -> None:
    history = simulate(
        Impact.whole_beam(0.5),
        end_time=100.0,
        integrator=integrator,
        mesh=UniformMesh(0.05),
        contact=NodeContact(hold=0, hold_until=0.0),
    )
    assert history.steps == 100_000
    budget = history.energy_budget()
    assert abs(budget["defect"]) < 1e-9 * budget["initial_energy"]


def guide_integrator() -> Any:
    """The class that the guide writes, from the guide."""
    code = re.search(r"^```python\n(.*?)^```", GUIDE.read_text(encoding="utf-8"), re.S | re.M)
    assert code is not None and len(code[1].splitlines()) <= 45
    space: dict[str, Any] = {"__name__": "guide"}
    exec(compile(code[1], str(GUIDE), "exec", dont_inherit=True), space)
    return space["NewmarkProjection"]


def test_the_guide_s_integrator_is_of_second_order_in_smooth_motion() -> None:
    newmark = guide_integrator()
    system = System(
        mass=[[1.0, 2.0]],
        stiffness=[[3.0, 2.0], [-1.0, 0.0]],
        damping=[[0.1, 0.2]],
        load=[[1.0, 2.0], [0.5, -0.3]],
        contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[100.0]),
    )
    start = np.array([0.5, -0.2]), np.array([0.0, 1.0])
    fine = integrate(system, *start, MoreauJean(2e-4, theta=0.5), 2.0, save=[2.0]).q[-1]
    errors = [np.abs(integrate(system, *start, newmark(h), 2.0, save=[2.0]).q[-1] - fine).max() for h in (0.02, 0.01)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_the_guide_s_integrator_bounces_and_its_budget_closes(restitution: float) -> None:
    """ω = 2, stop at rest position: every half period an impact at v = 2A, then amplitude e·A."""
    newmark = guide_integrator()
    system = System(mass=[[2.0]], stiffness=[[8.0]], contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[0.0]))
    run = integrate(system, np.array([1.0]), np.zeros(1), newmark(1e-3), 2.0, restitution=restitution)
    assert run.q[run.time > np.pi / 4 + 0.01, 0].max() == pytest.approx(restitution, abs=5e-3)
    assert run.impact[-1] == pytest.approx(0.5 * 2.0 * 4.0 * (1.0 - restitution**2), abs=2e-2)
    assert np.abs(run.defect()).max() < 1e-11


def test_the_guide_s_integrator_gives_the_impulse_of_the_impact() -> None:
    impact, mesh = Impact.dimensionless(0.5, length=20.0), ScaleFreeMesh(element_length=2e-3, growth=1.02)
    kinds = (guide_integrator()(time_step=2e-5, growth=2e-3), SignoriniPosition(time_step=1e-5, growth=1e-3))
    new, known = (
        simulate(impact, end_time=0.1, mesh=mesh, integrator=kind, contact=NodeContact(hold=0, hold_until=0.0))
        for kind in kinds
    )
    impulse = known.array("total_impulse")[-1]
    assert new.array("total_impulse")[-1] == pytest.approx(impulse, rel=3e-3)
    assert abs(new.energy_budget()["defect"]) < 1e-11 * new.energy_budget()["initial_energy"]


@every
def test_steps_that_differ_by_the_rounding_of_the_instants_share_their_matrix(integrator: Integrator) -> None:
    system = half_beam(kappa=0.1, half_length=5.0, nodes=50).system
    run = Stepper(system, np.zeros(system.dofs), np.zeros(system.dofs), integrator, 0.05)
    assert len(set(np.diff(run.instants))) > 1
    run.advance_to(1)
    made_for = run.problem.solver.step[0]
    assert made_for == run.instants[1]
    assert run.advance_to(50) == 0
    assert run.problem.solver.step[0] == made_for


def test_a_thousand_nodes_nearly_at_rest_on_the_wall_are_sorted_out_in_a_few_hundred_rounds() -> None:
    """With one row at a time in any order, and all signs at round-off's mercy, it was one round a node and more."""
    run = stepper(half_beam(kappa=0.1, half_length=5.0, nodes=10_000), SignoriniPosition(1e-3))
    assert run.advance_to(22) == 0
    assert run.problem.solver.rounds[2] < 1_000
