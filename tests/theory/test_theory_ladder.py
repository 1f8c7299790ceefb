"""The ladder's exact solutions: each satisfies its equation, its contact law and its balances."""

import numpy as np
import pytest

from theory.ladder import BouncingBall, DroppedBar, FlyingBar, ReleasedBar, StringOnObstacle


@pytest.mark.parametrize("restitution", [0.0, 0.3, 0.9, 1.0])
def test_the_ball_is_what_event_by_event_integration_gives(restitution: float) -> None:
    ball = BouncingBall(height=2.0, velocity=0.7, gravity=9.81, restitution=restitution)
    start, height, speed, impacts, given = 0.0, 2.0, 0.7, 0, 0.0
    for _ in range(40):
        flight = (speed + np.sqrt(speed**2 + 2.0 * 9.81 * height)) / 9.81
        inside = start + flight * np.array([0.01, 0.5, 0.99])
        age = inside - start
        # the accumulation point bounds what an instant can tell: age is known to 1e-16 of the time
        slack = 1e-15 * (start + flight) * (abs(speed) + 9.81 * flight)
        flown = height + speed * age - 9.81 * age**2 / 2
        np.testing.assert_allclose(ball.position(inside), flown, rtol=1e-12, atol=slack)
        np.testing.assert_allclose(ball.velocity_at(inside), speed - 9.81 * age, atol=1e-12)
        np.testing.assert_array_equal(ball.impacts(inside), impacts)
        np.testing.assert_allclose(ball.impulse(inside), given, atol=1e-12)
        landing = speed - 9.81 * flight
        start, height, speed, impacts = start + flight, 0.0, -restitution * landing, impacts + 1
        given += speed - landing
        at = ball.impact_time(impacts)
        assert at == pytest.approx(start, rel=1e-13)
        assert ball.velocity_at([np.nextafter(at, 0.0), at]) == pytest.approx([landing, speed], abs=1e-11)
        if speed < 1e-4:
            break


def test_infinitely_many_impacts_end_in_finite_time() -> None:
    ball = BouncingBall(restitution=0.5)
    # t₁ = √2 and the flights 2u₁/g (e + e² + …) = 2√2
    assert ball.rest == pytest.approx(3.0 * np.sqrt(2.0), rel=1e-15)
    assert ball.impacts(ball.rest) == np.inf and ball.impacts(ball.rest * (1.0 - 1e-9)) == 30.0
    after = np.array([ball.rest, 10.0])
    for field in (ball.position, ball.velocity_at):
        np.testing.assert_array_equal(field(after), 0.0)
    # at rest the floor has stopped it and carries its weight
    np.testing.assert_allclose(ball.impulse(after), after, rtol=1e-15)
    assert BouncingBall(restitution=0.0).rest == BouncingBall(restitution=0.0).first_impact
    assert BouncingBall(restitution=1.0).rest == np.inf


def differences(field, x, t, h):
    """∂/∂t and ∂/∂x."""
    return (field(x, t + h) - field(x, t - h)) / (2.0 * h), (field(x + h, t) - field(x - h, t)) / (2.0 * h)


X = np.linspace(0.013, 0.987, 41)


@pytest.mark.parametrize(
    ("bar", "speed", "stiffness", "times"),
    [
        (ReleasedBar(), 1.0, 1.0, [0.3, 0.8, 1.21, 1.7, 2.4, 2.9, 4.33, 302.1]),
        (FlyingBar(1.0, 8.0, 2.0, 0.5, 0.2), 2.0, 8.0, [0.1, 0.5, 0.75, 1.02, 1.33, 1.7]),
    ],
)
def test_bars_carry_waves_and_keep_signorini_their_momentum_and_energy(bar, speed, stiffness, times) -> None:
    # u_t and u_x are the derivatives of u away from the kinks
    x, t = np.meshgrid(X, times)
    fine = np.ones(x.shape, dtype=bool)
    for field in (bar.velocity_at, bar.strain):
        for dx, dt in ((2e-6, 0.0), (-2e-6, 0.0), (0.0, 2e-6), (0.0, -2e-6)):
            fine &= field(x + dx, t + dt) == field(x, t)
    assert np.count_nonzero(fine) > 0.9 * fine.size
    rate, slope = differences(bar.displacement, x, t, 1e-6)
    np.testing.assert_allclose(rate[fine], bar.velocity_at(x, t)[fine], atol=1e-7)
    np.testing.assert_allclose(slope[fine], bar.strain(x, t)[fine], atol=1e-7)
    # u_tt = c² u_xx, kinks or not: opposite corners of what waves enclose have one sum
    inside, h = np.abs(X - 0.5) < 0.49 - 0.01 * speed, 0.01
    x, t = x[:, inside], t[:, inside]
    along = bar.displacement(x + speed * h, t) + bar.displacement(x - speed * h, t)
    np.testing.assert_allclose(along, bar.displacement(x, t + h) + bar.displacement(x, t - h), atol=1e-13)
    fine = np.linspace(0.0, 3.0, 1201) + 1e-5
    gap, reaction = bar.displacement(0.0, fine), bar.reaction(fine)
    assert np.all(gap >= -1e-14) and np.all(reaction >= 0.0)
    assert np.max(gap * reaction) < 1e-14
    np.testing.assert_allclose(reaction, np.where(gap > 1e-13, 0.0, -stiffness * bar.strain(0.0, fine)), atol=1e-13)
    np.testing.assert_allclose(np.diff(bar.impulse(fine)), 0.0025 * 0.5 * (reaction[1:] + reaction[:-1]), atol=3e-3)
    x, t = np.meshgrid((np.arange(4000) + 0.5) / 4000, [0.1, 0.7, 1.3, 1.4, 2.2, 2.9])
    energies = np.mean(bar.velocity_at(x, t) ** 2 + speed**2 * bar.strain(x, t) ** 2, axis=1)
    np.testing.assert_allclose(energies, energies[0], rtol=2e-3)


def test_the_released_bar_starts_held_and_has_period_three() -> None:
    bar = ReleasedBar()
    np.testing.assert_allclose(bar.displacement(X, 0.0), (1.0 - X) / 2.0, atol=1e-15)
    np.testing.assert_allclose(bar.velocity_at(X, 0.0), 0.0, atol=1e-15)
    for t in (0.0, 0.4, 1.3, 2.2):
        np.testing.assert_allclose(bar.displacement(X, t + 30.0), bar.displacement(X, t), atol=1e-13)
        assert bar.displacement(1.0, t) == pytest.approx(0.0, abs=1e-15)
    assert bar.impulse(30.0) == 5.0


def test_the_flying_bar_leaves_as_it_came() -> None:
    bar = FlyingBar(length=10.0, stiffness=900.0, mass_per_length=1.0, velocity=10.0, gap=5.0)
    assert bar.contact == pytest.approx((0.5, 0.5 + 2.0 / 3.0))
    assert (bar.reaction(0.7), bar.impulse(5.0)) == pytest.approx((300.0, 2.0 * 10.0 * 10.0))
    x = np.linspace(0.0, 10.0, 7)
    np.testing.assert_allclose(bar.displacement(x, 0.5 + 1.0 / 3.0), -10.0 * x / 30.0, atol=1e-14)
    np.testing.assert_allclose(bar.displacement(x, 2.0), 10.0 * (2.0 - 0.5 - 2.0 / 3.0), rtol=1e-14)


def test_the_string_stays_above_the_obstacle_keeps_its_energy_and_obeys_the_wave_equation() -> None:
    string = StringOnObstacle()
    x, t = np.meshgrid((np.arange(2000) + 0.5) / 2000, np.array([0.0, 0.3, 0.4999, 0.5001, 0.77, 1.0, 1.4, 7.1]))
    assert np.all(string.displacement(x, t) >= 0.0)
    energy = np.mean(string.velocity_at(x, t) ** 2 + string.strain(x, t) ** 2, axis=1)
    np.testing.assert_allclose(energy, energy[0], rtol=1e-3)
    np.testing.assert_allclose(string.displacement(X, 0.0), 4.0 * X * (1.0 - X), atol=1e-15)
    np.testing.assert_allclose(string.displacement(X, 3.2), string.displacement(X, 0.2), atol=1e-14)
    # the whole string lands at t = ½
    assert np.max(string.displacement(X, 0.5)) < 1e-15
    jump = string.velocity_at(X, 0.5 + 1e-9) - string.velocity_at(X, 0.5 - 1e-9)
    np.testing.assert_allclose(jump, string.impulse(X, 0.6), atol=1e-7)
    assert np.all(jump > 0.0)
    # u_t and u_x are the derivatives of u, and u_tt = u_xx between the landings
    x, t = 0.3, np.linspace(0.02, 2.97, 38)
    kinematic = string.velocity_at(x, t), string.strain(x, t)
    np.testing.assert_allclose(kinematic, differences(string.displacement, x, t, 1e-5), atol=1e-7)
    inertia, _ = differences(string.velocity_at, x, t, 1e-5)
    _, pull = differences(string.strain, x, t, 1e-5)
    np.testing.assert_allclose(inertia, pull, atol=1e-7)


def test_a_dropped_bar_pushes_as_masses_and_springs_do() -> None:
    """Steps of Δx/c carry its waves exactly; what impacts take of the half mass at its end falls with Δx."""
    bar, n = DroppedBar(length=2.0, stiffness=8.0, mass_per_length=2.0, gravity=0.05, height=0.4), 400
    h = bar.length / n / 2.0  # c = 2
    mass = np.full(n + 1, bar.mass_per_length * bar.length / n)
    mass[[0, -1]] *= 0.5
    before = u = np.full(n + 1, bar.height)
    given, steps = [0.0], round(1.9 * (bar.flight + bar.contact) / h)
    for _ in range(steps):
        strains = bar.stiffness * np.diff(u) / (bar.length / n)
        force = np.diff(strains, prepend=0.0, append=0.0) - mass * bar.gravity
        after = 2.0 * u - before + h**2 * force / mass
        push = max(0.0, -after[0]) * mass[0] / h**2
        after[0] = max(after[0], 0.0)
        before, u = u, after
        given.append(given[-1] + push * h)
    assert given == pytest.approx(bar.impulse(h * np.arange(steps + 1)), abs=0.01 * max(given))
