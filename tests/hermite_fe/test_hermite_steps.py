"""Steps of a beam by every integrator: the energy account, which shows what is falsified; odd steps and numbers."""

from typing import Any

import numpy as np
import pytest
from hermite_parts import ALL, Make, account

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity, Sponge
from hermite_fe.integrators import Integrator, MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.model import beam_model
from hermite_fe.run import Stepper
from hermite_fe.simulate import simulate
from hermite_fe.system import ContactRows, System

STEP = 1e-3
every = pytest.mark.parametrize("make", ALL.values(), ids=ALL)


@every
def test_each_loss_is_booked_and_a_false_velocity_or_damping_is_missing_from_the_budget(make: Make) -> None:
    impact = Impact.dimensionless(0.5, length=2.0, damping=1e-3, epsilon_alpha=0.5)  # of all kinds, pressed on
    model = beam_model(impact, UniformMesh(0.05).nodes(1.0), NodeContact(), Sponge(), full=False)
    begin = model.system, model.displacement, model.velocity
    right, fast, damped = (Stepper(*begin, make(STEP), 0.2) for _ in range(3))
    start, last = account(right.sums()), right.instants.size - 1
    assert right.advance_to(last) == 0
    sums = right.sums()
    assert sums["work_of_loads"] > 1e-3 * start
    for cause in ("viscous", "material", "absorbed", "impact"):
        assert sums[f"loss_{cause}"] > 1e-6 * start, cause
    assert abs(account(sums) - start) < 1e-11 * start
    # a velocity; generalised-α also misses the damping force of what v̇ was not told of
    fast.advance_to(last // 2)
    brought = (1.04**2 - 1.0) * fast.sums()["kinetic_energy"]
    fast.state.v[:] *= 1.04
    fast.advance_to(last)
    assert account(fast.sums()) - start == pytest.approx(brought, rel=1e-3)
    # a loss: the damping matrix of the account is 3 % off the one that damps
    matrices = damped.problem.matrices
    damped.problem = damped.problem._replace(matrices=matrices._replace(parts=1.03 * matrices.parts))
    damped.advance_to(last)
    sums = damped.sums()
    false = 0.03 / 1.03 * (sums["loss_viscous"] + sums["loss_material"] + sums["loss_absorbed"])
    assert account(sums) - start == pytest.approx(false, rel=1e-8)


@pytest.mark.parametrize(
    ("kappa", "step"), [(0.1, 1e-3), *(pytest.param(*p, marks=pytest.mark.verify) for p in ((0.5, 2e-4), (1.5, 1e-3)))]
)
@pytest.mark.parametrize("radius", [0.0, 1.0])
@pytest.mark.parametrize("levels", ["velocity", "position_velocity", "position_velocity_acceleration"])
def test_the_wall_brings_no_energy(levels: str, radius: float, step: float, kappa: float) -> None:
    """To an undamped beam whose shortest waves the steps do not resolve; no loss in impacts is below zero."""
    scheme = NonsmoothGeneralizedAlpha(step, spectral_radius=radius, levels=levels)
    parts = {"mesh": UniformMesh(0.02), "contact": NodeContact(), "far_field": GridViscosity(viscosity=0.0)}
    impact = Impact.dimensionless(kappa, length=2.0)
    history = simulate(impact, end_time=0.3, integrator=scheme, save=100, **parts)
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    assert energy.max() <= energy[0] * (1.0 + 1e-9)
    assert np.diff(history.array("loss_impact")).min() > -1e-2 * energy[0]
    assert history.array("loss_impact")[-1] > 0.05 * energy[0] * (kappa < 1.0)


def stepper(integrator: Integrator, half_length: float, nodes: int) -> Stepper:
    """Half of a bent beam on equal elements, from the first touch on."""
    impact = Impact.dimensionless(0.1, length=2.0 * half_length)
    mesh = UniformMesh(half_length / (nodes - 1)).nodes(half_length)
    model = beam_model(impact, mesh, NodeContact(), GridViscosity(), full=False)
    return Stepper(model.system, model.displacement, model.velocity, integrator, 1.0)


def subnormal(part: Any) -> int:
    """How many numbers are subnormal in nested tuples of arrays."""
    if isinstance(part, tuple):
        return sum(map(subnormal, part))
    return int(np.count_nonzero((part != 0.0) & (np.abs(part) < np.finfo(float).tiny)))


@every
def test_no_number_of_the_state_is_subnormal(make: Make) -> None:
    run = stepper(make(STEP), 100.0, 2000)
    for step in (5, 50, 200):
        assert run.advance_to(step) == 0
        assert subnormal((run.state.q, run.state.v, run.state.acceleration, run.memory)) == 0


@every
def test_steps_are_the_same_compiled_beforehand_and_odd_ones_do_no_harm(make: Make) -> None:
    """A step of one ulp changes nothing to speak of; an undefined number is found in its step."""
    ready, cold = (stepper(make(STEP), 100.0, 50) for _ in range(2))
    ready.compile()
    for run in (ready, cold):
        run.advance_to(100)
    assert np.array_equal(ready.state.q, cold.state.q) and np.array_equal(ready.state.v, cold.state.v)
    ready.instants = ready.instants.copy()
    ready.instants[101] = np.nextafter(ready.instants[100], 1.0)
    assert ready.advance_to(101) == 0
    assert np.abs(ready.state.q - cold.state.q).max() <= 1e-12
    assert np.abs(ready.state.v - cold.state.v).max() <= 1e-9
    cold.state.q[60] = np.nan
    assert cold.advance_to(120) != 0 and cold.step == 100


def test_an_undefined_number_is_found_in_the_step_where_it_arises() -> None:
    """Also where nothing is damped, loaded or closed."""
    system = System([[1.0, 1.0]], [[1.0, 1.0]], ContactRows([[0]], [[1.0]], [100.0]))
    run = Stepper(system, np.zeros(2), np.ones(2), MoreauJean(STEP, theta=0.5), 1.0)
    run.advance_to(5)
    run.state.q[1] = np.nan
    assert run.advance_to(20) != 0 and run.step == 5


def test_a_thousand_nodes_nearly_at_rest_on_the_wall_are_sorted_out_in_a_few_hundred_rounds() -> None:
    """With one row at a time in any order, and all signs at round-off's mercy, it was one round a node and more."""
    run = stepper(SignoriniPosition(STEP), 5.0, 10_000)
    assert run.advance_to(22) == 0
    assert run.problem.solver.rounds[2] < 1_000
