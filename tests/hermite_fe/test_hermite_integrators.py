"""The contact core knows no beams: a bouncing ball and an oscillator against a stop run through every
integrator."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest

from hermite_fe.integrators import (
    GeneralizedAlphaPenalty,
    Integrator,
    MoreauJean,
    NonsmoothGeneralizedAlpha,
    SignoriniPosition,
)
from hermite_fe.run import Trajectory, integrate, saved_steps
from hermite_fe.system import ContactRows, System

GRAVITY, DROP = 9.81, 0.5  # thesis Fig. 3.6
Make = Callable[[float], Integrator]

WITH_IMPACT_LAW: dict[str, Make] = {
    "moreau_jean": lambda h: MoreauJean(h, theta=0.5),
    "velocity": lambda h: NonsmoothGeneralizedAlpha(h, levels="velocity"),
    "position_velocity": lambda h: NonsmoothGeneralizedAlpha(h, levels="position_velocity"),
    "position_velocity_acceleration": lambda h: NonsmoothGeneralizedAlpha(h),
}
ALL: dict[str, Make] = WITH_IMPACT_LAW | {
    "moreau_jean_implicit": lambda h: MoreauJean(h),
    "signorini_position": lambda h: SignoriniPosition(h),
    "penalty": lambda h: GeneralizedAlphaPenalty(h, stiffness=1e4, damping=10.0),
}


@pytest.mark.parametrize("make", ALL.values(), ids=ALL)
def test_steps_grow_at_most_as_asked_and_refined_ones_are_as_many_times_shorter(make: Make) -> None:
    integrator = dataclasses.replace(make(1e-3), growth=0.02)
    for finer in (1.0, 4.0):
        instants = integrator.refined(finer).instants(3.0)
        steps = np.diff(instants)
        assert (instants[0], instants[-1]) == (0.0, 3.0)
        assert steps[0] == pytest.approx(1e-3 / finer, rel=0.03)
        assert np.all(steps <= np.maximum(1e-3, 0.02 * instants[:-1]) / finer * 1.001)
        # 1/g even steps up to h/g, then as many as fit into log(3g/h) at most g long
        assert steps.size == pytest.approx(finer / 0.02 * (1.0 + math.log(3.0 * 0.02 / 1e-3)), rel=0.02)
    assert type(integrator.refined(2.0)) is type(integrator)
    if isinstance(integrator, GeneralizedAlphaPenalty):  # the penetration is of second order, too
        finer = integrator.refined(2.0)
        assert (finer.stiffness, finer.damping) == (4e4, 20.0)


def test_a_step_that_is_given_stays_and_does_not_grow_unless_asked() -> None:
    def chosen(**given: float) -> tuple[float | None, float | None]:
        made = MoreauJean(**given).with_steps(1e-3, 0.01)
        return made.time_step, made.growth

    assert chosen() == (1e-3, 0.01)
    assert chosen(time_step=1e-4) == (1e-4, 0.0)
    assert chosen(growth=0.05) == (1e-3, 0.05)
    assert chosen(time_step=1e-4, growth=0.05) == (1e-4, 0.05)


def test_half_of_the_saved_instants_lie_in_the_first_quarter() -> None:
    assert np.mean(saved_steps(np.linspace(0.0, 1.0, 100_001), 201) <= 25_000) == pytest.approx(0.5, abs=0.01)


def ball() -> System:
    return System(
        mass=[[1.0]],
        stiffness=[[0.0]],
        load=[[-GRAVITY]],
        contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[0.0]),
    )


def oscillator(gap: float = 0.0) -> System:
    return System(mass=[[2.0]], stiffness=[[8.0]], contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[gap]))


def chain(gap: float) -> System:
    """Two damped, forced masses and a stop."""
    return System(
        mass=[[1.0, 2.0]],
        stiffness=[[3.0, 2.0], [-1.0, 0.0]],
        damping=[[0.1, 0.2]],
        load=[[1.0, 2.0], [0.5, -0.3]],
        contacts=ContactRows(dofs=[[0]], factors=[[1.0]], gap=[gap]),
    )


def bounced(t: float, restitution: float) -> float:
    """Height of the exact ball."""
    first = math.sqrt(2.0 * DROP / GRAVITY)
    if t < first:
        return DROP - 0.5 * GRAVITY * t**2
    start, speed = first, GRAVITY * first
    while True:
        speed *= restitution
        if t < start + 2.0 * speed / GRAVITY:
            return speed * (t - start) - 0.5 * GRAVITY * (t - start) ** 2
        start += 2.0 * speed / GRAVITY


def defect(run: Trajectory) -> float:
    return float(np.abs(run.defect()).max())


@pytest.mark.parametrize("make", WITH_IMPACT_LAW.values(), ids=WITH_IMPACT_LAW)
def test_the_thesis_s_ball_bounces_as_the_exact_one(make: Make) -> None:
    run = integrate(ball(), np.array([DROP]), np.zeros(1), make(1e-3), 2.0, restitution=0.9)
    exact = np.array([bounced(t, 0.9) for t in run.time])
    assert run.failure == ""
    assert np.abs(run.q[:, 0] - exact).mean() < 2e-3
    assert run.gap.min() > -5e-3  # drift of the velocity-level schemes


@pytest.mark.parametrize("make", WITH_IMPACT_LAW.values(), ids=WITH_IMPACT_LAW)
def test_order_across_impacts_is_about_one(make: Make) -> None:
    end = 1.9
    steps = np.geomspace(4e-3, 1e-4, 24)
    errors = []
    for h in steps:
        run = integrate(ball(), np.array([DROP]), np.zeros(1), make(float(h)), end, restitution=0.9, save=[end])
        errors.append(abs(run.q[-1, 0] - bounced(end, 0.9)))
    order = np.polyfit(np.log(steps), np.log(np.maximum(errors, 1e-9)), 1)[0]
    assert 0.6 < order < 1.7


@pytest.mark.parametrize(("name", "order"), [(n, 1 if "implicit" in n or "signorini" in n else 2) for n in ALL])
def test_order_in_smooth_motion(name: str, order: int) -> None:
    system, ends = chain(gap=100.0), []
    for h in (0.02, 0.01, 0.005, 2e-4):
        run = integrate(system, np.array([0.5, -0.2]), np.array([0.0, 1.0]), ALL[name](h), 2.0, save=[2.0])
        ends.append(run.q[-1])
    fine = integrate(
        system, np.array([0.5, -0.2]), np.array([0.0, 1.0]), MoreauJean(2e-4, theta=0.5), 2.0, save=[2.0]
    ).q[-1]
    errors = [np.abs(e - fine).max() for e in ends[:3]]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.1)
    assert np.log2(errors[1] / errors[2]) == pytest.approx(order, abs=0.1)


@pytest.mark.parametrize("make", ALL.values(), ids=ALL)
def test_energy_closes_to_round_off_through_impacts_loads_and_damping(make: Make) -> None:
    run = integrate(chain(gap=0.3), np.array([0.5, -0.2]), np.array([-3.0, 1.0]), make(1e-3), 6.0)
    assert run.impulse[-1, 0] > 0.5  # it did touch
    assert defect(run) < 1e-11 * (run.kinetic[0] + run.strain[0])


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("make", WITH_IMPACT_LAW.values(), ids=WITH_IMPACT_LAW)
def test_an_oscillator_leaves_its_stop_with_the_restitution(make: Make, restitution: float) -> None:
    """ω = 2, stop at rest position: every half period an impact at v = 2A, then amplitude e·A."""
    run = integrate(oscillator(), np.array([1.0]), np.zeros(1), make(1e-3), 2.0, restitution=restitution)
    after = run.time > math.pi / 4 + 0.01
    assert run.q[after, 0].max() == pytest.approx(restitution, abs=5e-3)
    assert run.impulse[-1, 0] == pytest.approx(2.0 * (1.0 + restitution) * 2.0, rel=5e-3)
    assert run.impact[-1] == pytest.approx(0.5 * 2.0 * 4.0 * (1.0 - restitution**2), abs=2e-2)


@pytest.mark.parametrize("make", WITH_IMPACT_LAW.values(), ids=WITH_IMPACT_LAW)
def test_a_ball_at_rest_presses_with_its_weight(make: Make) -> None:
    run = integrate(ball(), np.zeros(1), np.zeros(1), make(1e-3), 1.0)
    assert np.abs(run.q).max() < 1e-5
    assert run.impulse[-1, 0] == pytest.approx(GRAVITY, rel=2e-3)
    assert np.abs(run.product).max() < 1e-12 and run.smallest_reaction.min() >= 0.0


@pytest.mark.parametrize("radius", [0.6, 0.9])
@pytest.mark.parametrize(
    "make",
    [
        lambda h, r: NonsmoothGeneralizedAlpha(h, spectral_radius=r),
        lambda h, r: NonsmoothGeneralizedAlpha(h, levels="velocity", spectral_radius=r),
        lambda h, r: GeneralizedAlphaPenalty(h, spectral_radius=r, stiffness=1e4, damping=0.0),
    ],
)
def test_what_steps_cannot_resolve_shrinks_by_the_spectral_radius(
    make: Callable[[float, float], Integrator], radius: float
) -> None:
    """Chung & Hulbert 1993: at ωh → ∞ all roots of the amplification are ρ∞, a double one among them (n ρⁿ)."""
    system = System(mass=[[1.0]], stiffness=[[1e12]], contacts=ContactRows([[0]], [[1.0]], [1e9]))
    steps = int(-40.0 / np.log(radius))
    run = integrate(system, np.ones(1), np.zeros(1), make(1.0, radius), float(steps), save=list(np.arange(steps + 1.0)))
    size, half = np.abs(run.q[:, 0]), steps // 2
    early, late = size[half - 4 : half].max(), size[2 * half - 4 : 2 * half].max()
    assert (late / early / 2.0) ** (1.0 / half) == pytest.approx(radius, rel=0.03)


def test_a_ball_that_rests_on_a_spring_says_how_far_reaction_and_gap_exclude_each_other() -> None:
    """Reaction mg and penetration mg/k in every step: their product is what complementarity lacks."""
    k, h = 1e4, 1e-3
    resting = np.array([-GRAVITY / k])
    run = integrate(ball(), resting, np.zeros(1), GeneralizedAlphaPenalty(h, stiffness=k, damping=0.0), 0.1, save=8)
    assert run.product[1:] == pytest.approx(h * GRAVITY**2 / k, rel=0.15)  # the start shakes it a little
    assert run.held_impulse[-1, 0] == 0.0


@pytest.mark.parametrize("make", WITH_IMPACT_LAW.values(), ids=WITH_IMPACT_LAW)
def test_only_what_a_held_row_pulls_is_its_held_impulse(make: Make) -> None:
    """A weight lifted off at g from a wall that holds it for half a second, after a second of lying on it."""
    g, end = 2.0, 1.5
    system = System(
        mass=[[1.0]], stiffness=[[0.0]], load=[[-g], [2.0 * g]], contacts=ContactRows([[0]], [[1.0]], [0.0])
    )
    run = integrate(system, np.zeros(1), np.zeros(1), make(1e-3), end, hold=0, hold_until=1.0)
    assert np.all(np.diff(run.held_impulse[:, 0]) <= 1e-12)
    # the load −g + 2gt presses until t = ½ and pulls from then on, held until 1
    assert run.held_impulse[-1, 0] == pytest.approx(-g * 0.25, abs=0.02)
    assert run.impulse[-1, 0] == pytest.approx(0.0, abs=0.02)


def test_signorini_at_position_never_enters_the_wall() -> None:
    run = integrate(ball(), np.array([DROP]), np.zeros(1), SignoriniPosition(1e-3), 1.0)
    assert run.gap.min() >= -1e-15
    assert run.q[-1, 0] == pytest.approx(0.0, abs=1e-12)


def test_a_stiff_penalty_approaches_the_elastic_bounce() -> None:
    integrator = GeneralizedAlphaPenalty(1e-4, stiffness=1e6, damping=0.0, spectral_radius=1.0)
    run = integrate(ball(), np.array([DROP]), np.zeros(1), integrator, 1.2)
    exact = np.array([bounced(t, 1.0) for t in run.time])
    assert np.abs(run.q[:, 0] - exact).mean() < 5e-3


def test_growing_steps_take_each_decade_alike_and_end_on_time() -> None:
    instants = SignoriniPosition(time_step=1e-6, growth=1e-2).instants(1.0)
    assert instants[0] == 0.0 and instants[-1] == 1.0
    assert np.all(np.diff(instants) > 0.0)
    decades = [np.sum((instants > 10.0**k) & (instants <= 10.0 ** (k + 1))) for k in (-3, -2, -1)]
    assert max(decades) - min(decades) <= 1
    assert np.diff(instants).max() <= 1e-2
    assert SignoriniPosition(time_step=1e-3, growth=0.1).instants(0.0101).size == 12  # ten even steps and one more


def test_constant_steps_divide_the_run() -> None:
    assert np.allclose(np.diff(MoreauJean(time_step=0.3).instants(1.0)), 0.25)


def test_integrators_validate_their_numbers() -> None:
    for make, message in (
        (lambda: MoreauJean(theta=0.49), r"theta must lie in \[0.5, 1\] \(got 0.49\)"),
        (lambda: SignoriniPosition(theta=1.1), "theta must lie"),
        (lambda: NonsmoothGeneralizedAlpha(spectral_radius=-0.1), r"spectral_radius must lie in \[0, 1\]"),
        (lambda: GeneralizedAlphaPenalty(spectral_radius=1.5), "spectral_radius must lie"),
        (lambda: GeneralizedAlphaPenalty(stiffness=0.0), "stiffness must be positive"),
        (lambda: GeneralizedAlphaPenalty(damping=-1.0), "damping must not be negative"),
        (lambda: NonsmoothGeneralizedAlpha(levels="none"), "levels must be one of"),
        (lambda: MoreauJean(time_step=0.0), r"time_step must be positive \(got 0.0\)"),
        (lambda: MoreauJean(time_step=-1e-3), "time_step must be positive"),
        (lambda: MoreauJean(time_step=float("nan")), "time_step must be a finite number"),
        (lambda: MoreauJean(growth=-1.0), "growth must not be negative"),
    ):
        with pytest.raises(ValueError, match=message):
            make()
    with pytest.raises(ValueError, match="time_step is too small"):
        MoreauJean(time_step=1e-12).instants(1.0)
    with pytest.raises(ValueError, match="not chosen yet"):
        MoreauJean().instants(1.0)


def test_systems_validate_their_shapes() -> None:
    rows = ContactRows(dofs=[[0]], factors=[[1.0]], gap=[0.0])
    with pytest.raises(ValueError, match=r"system\.stiffness must have shape"):
        System(mass=[[1.0]], stiffness=[[1.0, 2.0]], contacts=rows)
    with pytest.raises(ValueError, match="must not share a dof"):
        System(mass=[[1.0]], stiffness=[[1.0]], contacts=rows, supports=(0,))
    with pytest.raises(ValueError, match="supports must name dofs"):
        System(mass=[[1.0]], stiffness=[[1.0]], contacts=rows, supports=(3,))
    with pytest.raises(ValueError, match="contact rows must name dofs"):
        System(mass=[[1.0]], stiffness=[[1.0]], contacts=ContactRows(dofs=[[1]], factors=[[1.0]], gap=[0.0]))
    with pytest.raises(ValueError, match="sorted by their first dof"):
        ContactRows(dofs=[[1], [0]], factors=[[1.0], [1.0]], gap=[0.0, 0.0])
    with pytest.raises(ValueError, match="places must have shape"):
        ContactRows(dofs=[[0]], factors=[[1.0]], gap=[0.0], places=np.zeros(2))


@pytest.mark.parametrize("save", [1, 2.5, [], [0.2, 0.1], [-0.1], [2.0], [float("nan")]])
def test_what_is_to_be_saved_is_checked(save: object) -> None:
    with pytest.raises(ValueError, match="save must"):
        integrate(ball(), np.zeros(1), np.zeros(1), MoreauJean(0.1), 1.0, save=save)  # type: ignore[arg-type]
