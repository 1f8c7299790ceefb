"""Every integrator, that of the guide too, on a bouncing ball, an oscillator against a stop, two masses; steps of a
beam, whose energy account shows what is falsified; odd steps and numbers."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hermite_parts import ALL, DROP, FIRST_ORDER, GRAVITY, WITH_IMPACT_LAW, Make, account, ball, chain, defined_in

from bent_beam import Impact, SimulationError
from bent_beam.meshes import UniformMesh
from hermite_fe import HermiteFE, simulate
from hermite_fe.constraints import ContactLaw
from hermite_fe.contacts import NodeContact
from hermite_fe.far_fields import GridViscosity, Sponge
from hermite_fe.integrators import GeneralizedAlphaPenalty, MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.integrators.base import Integrator
from hermite_fe.model import beam_model
from hermite_fe.run import Stepper, integrate
from hermite_fe.system import ContactRows, System
from theory.ladder import BouncingBall

START = np.array([0.5, -0.2]), np.array([0.0, 1.0])
GUIDES = defined_in("guide/add-integrator.md")["NewmarkProjection"]
of_the_guide = pytest.param(GUIDES, id="the guide's", marks=pytest.mark.verify)  # compiled anew each time
every = pytest.mark.parametrize("make", ALL.values(), ids=ALL)
every_and_the_guide_s = pytest.mark.parametrize("make", [*ALL.values(), of_the_guide])


@every_and_the_guide_s
def test_order_in_smooth_motion(make: Make) -> None:
    order = 1 if make in [ALL[name] for name in FIRST_ORDER] else 2
    system = chain(100.0, [[1.0, 2.0], [0.5, -0.3]])
    fine = integrate(system, *START, MoreauJean(2e-4, theta=0.5), 2.0, save=[2.0]).q[-1]
    errors = [np.abs(integrate(system, *START, make(h), 2.0, save=[2.0]).q[-1] - fine).max() for h in (0.02, 0.01)]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)


def test_lasting_contact_is_second_order_with_reactions_in_the_smooth_motion() -> None:
    def end(step: float) -> np.ndarray:
        system = chain(0.0, [[-10.0, 0.0], [-1.0, 0.3], [1.0, 0.0]])
        run = integrate(system, np.array([0.0, 0.5]), np.array([0.0, 1.0]), NonsmoothGeneralizedAlpha(step), 2.0)
        return np.array([run.q[-1, 1], run.v[-1, 1], run.impulse[-1, 0]])

    exact = end(2e-4)
    for coarse, fine in pairwise(np.abs(end(h) - exact) for h in (0.02, 0.01, 0.005)):
        assert np.all(np.log2(coarse / fine) > 1.7)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
@pytest.mark.parametrize("make", [*WITH_IMPACT_LAW.values(), of_the_guide])
def test_an_oscillator_leaves_its_stop_with_the_restitution(make: Make, restitution: float) -> None:
    """Every half period an impact at v = 2A, then amplitude e·A."""
    oscillator = System(mass=[[2.0]], stiffness=[[8.0]], contacts=ContactRows([[0]], [[1.0]], [0.0]))  # ω = 2
    run = integrate(oscillator, np.array([1.0]), np.zeros(1), make(1e-3), 2.0, law=ContactLaw(restitution))
    after = run.time > math.pi / 4 + 0.01
    assert run.q[after, 0].max() == pytest.approx(restitution, abs=5e-3)
    assert run.impulse[-1, 0] == pytest.approx(2.0 * (1.0 + restitution) * 2.0, rel=5e-3)
    assert run.sums["loss_impact"][-1] == pytest.approx(0.5 * 2.0 * 4.0 * (1.0 - restitution**2), abs=2e-2)


HELD = [(make, ContactLaw(hold_until=1.0), 2.0) for make in WITH_IMPACT_LAW.values()]
HELD += [(make, ContactLaw(strength=np.array([most])), most)
         for make in (SignoriniPosition, WITH_IMPACT_LAW["moreau_jean"]) for most in (1.0, 3.0)]  # fmt: skip


@pytest.mark.parametrize(("make", "law", "most"), HELD)
def test_a_weight_presses_until_it_is_lifted_and_only_what_is_held_then_pulls(make, law, most) -> None:
    """The load −2 + 4t presses until t = ½ and then pulls: until ``most`` is reached, which is 2 at the hold's end."""
    system = System([[1.0]], [[0.0]], ContactRows([[0]], [[1.0]], [0.0]), load=[[-2.0], [4.0]])
    run = integrate(system, np.zeros(1), np.zeros(1), make(1e-3), 1.5, law=law, save=1500)
    pressed, pulled = run.time <= 0.5, most**2 / 8.0
    assert np.abs(run.q[pressed]).max() < 1e-5 and np.abs(run.sums["complementarity_product"]).max() < 1e-12
    assert run.impulse[pressed, 0].max() == pytest.approx(0.5, rel=1e-2)
    assert run.time[run.closed[:, 0]].max() == pytest.approx((2.0 + most) / 4.0, abs=3e-3)
    assert np.all(np.diff(run.held_impulse[:, 0]) <= 1e-12)
    assert run.held_impulse[-1, 0] == pytest.approx(-pulled, abs=2e-3)
    assert run.impulse[-1, 0] == pytest.approx(0.5 - pulled, abs=3e-3)


@pytest.mark.parametrize("name", ["velocity", "position_velocity_acceleration", "penalty"])
def test_what_steps_cannot_resolve_shrinks_by_the_spectral_radius(name: str) -> None:
    """Chung & Hulbert 1993: at ωh → ∞ all roots of the amplification are ρ∞, a double one among them (n ρⁿ)."""
    system = System(mass=[[1.0]], stiffness=[[1e12]], contacts=ContactRows([[0]], [[1.0]], [1e9]))
    run = integrate(system, np.ones(1), np.zeros(1), ALL[name](1.0, spectral_radius=0.6), 80.0, save=np.arange(81.0))
    early, late = (np.abs(run.q[step - 4 : step, 0]).max() for step in (40, 80))
    assert (late / early / 2.0) ** (1.0 / 40.0) == pytest.approx(0.6, rel=0.03)


def test_a_penalty_carries_a_weight_by_its_penetration_and_bounces_elastically_where_it_is_stiff() -> None:
    """Reaction mg and penetration mg/k in every step: their product is what complementarity lacks."""
    spring = GeneralizedAlphaPenalty(1e-3, stiffness=1e4, damping=0.0)
    run = integrate(ball(), np.array([-GRAVITY / 1e4]), np.zeros(1), spring, 0.1, save=8)
    product = run.sums["complementarity_product"][1:]
    assert product == pytest.approx(GRAVITY**2 / 1e4, rel=0.15)  # the start shakes it a little
    stiff = GeneralizedAlphaPenalty(1e-4, stiffness=1e6, damping=0.0, spectral_radius=1.0)
    run = integrate(ball(), np.array([DROP]), np.zeros(1), stiff, 1.2, save=60)
    exact = BouncingBall(height=DROP, gravity=GRAVITY, restitution=1.0).position(run.time)
    assert np.abs(run.q[:, 0] - exact).mean() < 5e-3


def test_saved_instants_go_as_squares_and_each_tells_how_far_the_run_is() -> None:
    told: list[float] = []
    run = integrate(ball(), np.array([DROP]), np.zeros(1), SignoriniPosition(1e-3), 1.2, save=20, progress=told.append)
    assert run.time == pytest.approx(1.2 * np.linspace(0.0, 1.0, 20) ** 2, abs=5.1e-4)  # to half a step
    assert told == pytest.approx(run.time / 1.2)


def test_steps_grow_at_most_as_asked_and_refined_ones_are_as_many_times_shorter() -> None:
    integrator = GeneralizedAlphaPenalty(1e-3, growth=0.02, stiffness=1e5, damping=1e3)
    for finer in (1.0, 4.0):
        instants = integrator.refined(finer).instants(3.0)
        steps = np.diff(instants)
        assert (instants[0], instants[-1]) == (0.0, 3.0)
        assert steps[0] == pytest.approx(1e-3 / finer, rel=0.03) and steps.min() > 0.9 * steps[0]
        assert np.all(steps <= np.maximum(1e-3, 0.02 * instants[:-1]) / finer * 1.001)
        # 1/g even steps up to h/g, then as many as fit into log(3g/h) at most g long
        assert steps.size == pytest.approx(finer / 0.02 * (1.0 + math.log(3.0 * 0.02 / 1e-3)), rel=0.02)
    stiff = integrator.refined(2.0)  # the penetration is of second order, too
    assert (stiff.stiffness, stiff.damping) == (4e5, 2e3)
    assert MoreauJean(1e-3, growth=0.02).refined(2.0) == MoreauJean(5e-4, growth=0.01)


def test_a_scheme_that_gains_energy_without_bound_is_a_failure_not_an_answer() -> None:
    """Generalised-α with sixty-four held constraints blows up on a graded mesh at κ/ν = ½ (measured)."""
    bare = Impact.dimensionless(0.5)
    held = HermiteFE(integrator=NonsmoothGeneralizedAlpha(), contact=NodeContact(hold=64), refine=0.4)
    with pytest.raises(SimulationError, match="unstable"):
        held.chosen_for(bare.replace(acceleration=0.2), 0.1).simulate(bare, end_time=0.1, save=60)


def test_springs_settle_in_every_step_or_the_run_fails_by_name_and_their_rounds_are_counted() -> None:
    beam = Impact(length=2.0, bending_stiffness=1.0, mass_per_length=1.0, curvature=0.5, velocity=1.0, damping=1e-3)
    method = HermiteFE(mesh=UniformMesh(1 / 30), integrator=GeneralizedAlphaPenalty())
    history = method.simulate(beam, end_time=0.2)
    assert 1.0 < history.settings["mean_iterations"] < 1.5 and history.settings["most_iterations"] < 10
    with pytest.raises(SimulationError, match="active set of the contact does not settle"):
        replace(method, integrator=GeneralizedAlphaPenalty(contact_rounds=1)).simulate(beam, end_time=0.2)


STEP = 1e-3


@every_and_the_guide_s
def test_each_loss_is_booked_and_a_false_velocity_is_missing_from_the_budget(make: Make) -> None:
    impact = Impact.dimensionless(0.5, length=2.0, damping=1e-3, epsilon_alpha=0.5)  # of all kinds, pressed on
    model = beam_model(impact, UniformMesh(0.05).nodes(1.0), NodeContact(), Sponge(), full=False)
    begin = model.system, model.displacement, model.velocity
    right, fast = (Stepper(*begin, make(STEP), 0.2) for _ in range(2))
    start, last = account(right.sums()), right.instants.size - 1
    assert right.advance_to(last) == 0
    sums = right.sums()
    assert sums["work_of_loads"] > 1e-3 * start
    for cause in ("viscous", "material", "absorbed", "impact"):
        assert sums[f"loss_{cause}"] > 1e-6 * start, cause
    assert abs(account(sums) - start) < 1e-11 * start
    # generalised-α also misses the damping force of what v̇ was not told of
    fast.advance_to(last // 2)
    brought = (1.04**2 - 1.0) * fast.sums()["kinetic_energy"]
    fast.state.v[:] *= 1.04
    fast.advance_to(last)
    assert account(fast.sums()) - start == pytest.approx(brought, rel=1e-3)


@pytest.mark.parametrize(
    ("kappa", "step"), [(0.1, 1e-3), *(pytest.param(*p, marks=pytest.mark.verify) for p in ((0.5, 2e-4), (1.5, 1e-3)))]
)
@pytest.mark.parametrize("radius", [0.0, 1.0])
@pytest.mark.parametrize("levels", ["velocity", "position_velocity", "position_velocity_acceleration"])
def test_the_wall_brings_no_energy(levels: str, radius: float, step: float, kappa: float) -> None:
    """To an undamped beam whose shortest waves the steps do not resolve; no loss in impacts is below zero."""
    scheme = NonsmoothGeneralizedAlpha(step, spectral_radius=radius, levels=levels)
    parts = {"mesh": UniformMesh(0.02), "contact": NodeContact(), "far_field": GridViscosity(viscosity=0.0)}
    history = simulate(Impact.dimensionless(kappa, length=2.0), end_time=0.3, integrator=scheme, save=100, **parts)
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


def subnormal(part: Any) -> bool:
    """Whether any number is in nested tuples of arrays."""
    if isinstance(part, tuple):
        return any(map(subnormal, part))
    return bool(np.any((part != 0.0) & (np.abs(part) < np.finfo(float).tiny)))


@every
def test_no_number_of_the_state_is_subnormal(make: Make) -> None:
    run = stepper(make(STEP), 100.0, 2000)
    for step in (5, 50, 200):
        assert run.advance_to(step) == 0
        assert not subnormal((run.state.q, run.state.v, run.state.acceleration, run.memory))


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


def test_a_thousand_nodes_nearly_at_rest_on_the_wall_are_sorted_out_in_a_few_hundred_rounds() -> None:
    """With one row at a time in any order, and all signs at round-off's mercy, it was one round a node and more."""
    run = stepper(SignoriniPosition(STEP), 5.0, 10_000)
    assert run.advance_to(22) == 0
    assert run.problem.solver.rounds[2] < 1_000
