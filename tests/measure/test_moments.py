"""Moments between nodes, of a mesh that moves, and in the middle."""

import numpy as np
import pytest
from histories import history_of

from bent_beam import Impact
from bent_beam.measure.reduction import moments_around, peak_moment


@pytest.mark.parametrize("with_slope", [True, False])
@pytest.mark.parametrize("natural", [None, 0.1])
def test_the_moment_of_a_cubic_is_exact_and_the_peak_is_where_it_is_largest(with_slope, natural):
    """y = t(ax² + bx³), a curved wall: M = EI(t(2a + 6bx) + K₀). The first saved instant does not count."""
    a, b, stiffness, wall = 0.3, 0.2 if with_slope else 0.0, 2.5, 0.05  # differences are exact for a parabola
    impact = Impact(stiffness, 1.0, 4.0, 0.2, 1.0, wall_curvature=wall, natural_curvature=natural)
    time, x = np.array([9.0, 1.0, 3.0, 2.0]), np.array([0.0, 0.3, 0.7, 1.2, 2.0])
    y = np.outer(time, a * x**2 + b * x**3)
    slope = {"slope": np.outer(time, 2 * a * x + 3 * b * x**2)} if with_slope else {}
    history = history_of(np.arange(4.0), x, impact=impact, gap=-y - 0.5 * wall * x**2, **slope)
    exact = stiffness * (np.multiply.outer(time, 2 * a + 6 * b * x) + (0.2 if natural is None else natural))
    found, place = history.bending_moments(slice(None))
    assert found[..., 0] == pytest.approx(exact[:, :-1], rel=1e-12)
    assert found[..., 1] == pytest.approx(exact[:, 1:], rel=1e-12)
    assert history.bending_moments(2)[0] == pytest.approx(found[2], rel=1e-15)
    assert np.all(place == np.stack([x[:-1], x[1:]], axis=1))
    assert history.moment == pytest.approx(np.abs(exact).max(axis=1), rel=1e-12)
    peak = peak_moment(history)
    assert peak.time == 2.0 and (peak.place == 2.0 or not with_slope)
    assert peak_moment(history, until=1.0).moment == pytest.approx(exact[1, -1], rel=1e-12)
    assert peak.moment == pytest.approx(exact[2, -1], rel=1e-12)
    assert peak.midspan == pytest.approx(exact[2, 0], rel=1e-12)
    assert peak_moment(history, until=0.0) == (0.0, 0.0, 0.0, 0.0, 0.0)  # there is none before the impact


def test_moments_of_a_mesh_that_moves_stand_where_its_nodes_are_then():
    time, x = np.array([0.0, 1.0, 4.0]), np.array([0.0, 0.3, 0.65, 1.2])
    position = np.multiply.outer(np.sqrt(time) + 1.0, x)
    bent = {"gap": -0.3 * position**2, "slope": 0.6 * position}
    history = history_of(time, x, impact=Impact(2.5, 1.0, 4.0, 0.2, 1.0), position=position, **bent)
    found, place = history.bending_moments(2)
    assert found == pytest.approx(2.5 * (0.6 + 0.2), rel=1e-12) and np.all(place[:, 1] == position[2, 1:])
    for k in (-1, np.int64(2)):
        assert np.array_equal(history.bending_moments(k), (found, place))
    bent = {"gap": -0.1 * position**3, "slope": 0.3 * position**2}
    peak = peak_moment(history_of(time, x, impact=history.impact, position=position, **bent))  # 2.1 lies beyond its end
    assert peak[:4] == pytest.approx((2.5 * (0.6 * 1.95 + 0.2), 1.95, 4.0, 2.5 * 0.2), rel=1e-12)


@pytest.mark.parametrize("nodes", [(-2.0, -0.3, 0.5, 2.0), (-2.0, -0.3, 0.0, 0.5, 2.0)])
def test_the_moment_in_the_middle_needs_no_node_there(nodes):
    """y = t(ax² + bx³) at two instants: M(0) = EI(2at + K₀), of a limber beam."""
    x, time = np.array(nodes), np.array([0.0, 1.0, 3.0])
    gap, slope = -np.outer(time, 0.3 * x**2 + 0.2 * x**3), np.outer(time, 0.6 * x + 0.6 * x**2)
    history = history_of(time, x, impact=Impact(2.5e-3, 1.0, 4.0, 0.2, 1.0), symmetry="full", gap=gap, slope=slope)
    peak = peak_moment(history)
    assert peak.midspan == pytest.approx(2.5e-3 * (3.0 * 0.6 + 0.2), rel=1e-12)
    assert peak.moment == pytest.approx(2.5e-3 * (3.0 * (0.6 + 1.2 * 2.0) + 0.2), rel=1e-12)  # at x = 2


def test_the_moment_in_the_middle_is_that_of_the_element_there() -> None:
    """y = (|x| − 5 cm)³ beyond 5 cm: no moment in the middle."""
    x, time = np.array([-0.2, -0.05, 0.05, 0.2]), np.array([0.0, 1.0])
    beyond, one = np.maximum(np.abs(x) - 0.05, 0.0), np.array([[0.0], [1.0]])
    bent = {"gap": -one * beyond**3, "slope": one * 3.0 * np.sign(x) * beyond**2}
    impact = Impact(1.0, 1.0, 0.4, 0.2, 1.0, natural_curvature=0.0)
    found = peak_moment(history_of(time, x, impact=impact, symmetry="full", **bent))
    assert (found.moment, found.midspan) == (pytest.approx(6.0 * 0.15), pytest.approx(0.0, abs=1e-12))


def test_a_largest_moment_is_looked_for_after_an_instant_and_within_the_record() -> None:
    """It falls by one a second from 9: all of the second after an instant counts, and the last interval always."""
    time = np.arange(6.0)
    falls = {"largest_moment": 9.0 - time, "largest_midspan_moment": 9.0 - time, "largest_moment_place": 0.0 * time}
    history = history_of(time, np.linspace(0.0, 1.0, 5), impact=Impact.whole_beam(2.0), **falls)
    assert [peak_moment(history, since=k).moment for k in (0, 2, 4, 5)] == [8.0, 6.0, 4.0, 4.0]
    assert peak_moment(history, since=2).time == 2.5
    near, moments = moments_around(history, 3.0, 1.0)
    assert near.tolist() == [2.0, 3.0, 4.0] and moments.tolist() == [7.0, 6.0, 5.0]
    cubic = history_of(time, np.linspace(0.0, 1.0, 5))  # of instants alone: the first is no contact yet
    assert moments_around(cubic, 1.0, 1.0)[0].tolist() == [1.0, 2.0]


@pytest.mark.parametrize(("k", "first", "last"), [(5000, 4989, 5010), (100, 94, 105)])
def test_a_push_that_may_spread_is_its_mean_over_a_thousandth_of_t_star_or_a_twentieth_of_the_time(k, first, last):
    """T* = 10 s, saved every ms. 2 N in these intervals, by the first and the last of them, more beside: the beam
    has 0.9 N m, flat it has 1, so 2·400·0.1 N/m push over 2/80 m."""
    impact = Impact(1.0, 100.0, 2.0, 0.5, 1.0, shear_stiffness=400.0, wall_curvature=-0.5)
    time, x = 1e-3 * np.arange(6001), np.linspace(-1.0, 1.0, 21)
    gains = np.zeros(6001)
    gains[[first, last + 1]] = 1.0
    gains[[first + 1, last]] = 0.5 * 2.0 * (last - first) * 1e-3
    moment = 0.9 * (np.arange(6001) == k)
    told = {"largest_moment": moment, "largest_moment_place": 0.0 * time, "largest_midspan_moment": moment}
    run = history_of(time, x, impact=impact, symmetry="full", impulse=np.outer(gains.cumsum(), x == x[10]), **told)
    assert peak_moment(run).spread == pytest.approx(0.25 * 2.0 * 2.0 / 80.0)
