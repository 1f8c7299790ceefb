"""What a run of any beam shows at an instant, saved or between two: front, reaction, the largest until then."""

import numpy as np
import pytest
from histories import history_of

from bent_beam import Impact, ImpactHistory
from bent_beam.measure.force_map import force_map, spread
from bent_beam.measure.instant import instant, largest_moment
from bent_beam.measure.moments import (
    element_at,
    first_front,
    half_contact_length,
    jump_of_rim,
    local_front,
    mean_reaction,
    moments,
    one_side,
    unresolved,
    unresolved_at_end,
)  # fmt: skip
from bent_beam.measure.reduction import pull_of, rise_between, wall_peaks


def test_the_lift_at_a_time_is_the_largest_of_the_last_decade() -> None:
    """It grows as t², but for one of 4 at 0.04."""
    time, x = np.linspace(0.0, 1.0, 101), np.linspace(0.0, 1.0, 101)
    spreads = np.diff(np.minimum(np.sqrt(time)[:, None], np.append(x, 1.1)), axis=1)
    gap = np.outer(np.where(time == 0.04, 0.16, time**3), np.ones(101))
    run = history_of(time, x, impulse=spreads, total_impulse=2.0 * np.sqrt(time), gap=gap)
    lifts = [instant(run, t, first_spread=True).lift for t in (0.3, 0.395, 0.405, 0.5)]
    assert lifts == pytest.approx([4.0, 4.0, 0.16, 0.25])


def test_a_middle_that_lifts_off_does_not_shorten_the_contact_and_a_late_push_alone_makes_it() -> None:
    x, time = np.linspace(0.0, 1.0, 11), np.linspace(0.0, 1.0, 101)
    impulse = np.zeros((time.size, x.size))
    impulse[:, 4] = time  # two points at 0.4, nothing between them
    impulse[:, 8] = np.maximum(time - 0.88, 0.0)  # and late at 0.8
    history = history_of(time, x, impulse=impulse, total_impulse=2.0 * impulse.sum(axis=1))
    assert [half_contact_length(history, k) for k in (0, 75, 100)] == [None, pytest.approx(0.4), pytest.approx(0.8)]
    assert jump_of_rim(history, 75) == 0.0
    small = history_of(time, 0.01 * x, impulse=impulse)
    jumps = [jump_of_rim(small, k) for k in range(80, 100)]
    assert set(np.round(jumps, 9)) == {0.0, 0.004}  # where the median of the rims may be either
    impulse[:, 8] = np.maximum(time - 0.89, 0.0)
    assert jump_of_rim(history_of(time, 0.01 * x, impulse=impulse), 90) == 0.0  # 11 of 19: one less is as many
    for near, jump in ((0.779, 0.021), (0.786, 0.0)):  # 2.6 % of itself; 1.8 %, where one ~ √t moves on by 0.5 %
        close = history_of(time, [0.0, 0.1, 0.2, 0.3, near, 0.79, 0.793, 0.796, 0.8, 0.9, 1.0], impulse=impulse)
        assert max(jump_of_rim(close, k) for k in range(80, 100)) == pytest.approx(jump)
    assert (mean_reaction(history, 0.0), mean_reaction(history, 0.05)) == (None, pytest.approx(2.0))
    assert mean_reaction(history, history.time[100]) is None  # no tenth after the end
    assert mean_reaction(history, 1.0 / 1.1) == pytest.approx(2.0 + 2.0 * 0.12 / (0.2 / 1.1))  # the tenth is the last
    assert mean_reaction(history, history.time[75]) == pytest.approx(2.0, rel=1e-9)


@pytest.mark.parametrize("late", [0.0, 1e-3, -1e-3, 4e-3])
def test_a_rim_that_moves_on_is_read_at_the_time_whether_or_not_one_interval_more_lies_around_it(late) -> None:
    """It is at 0.2 + 0.6 t, 0.006 further an interval; the tenth before 0.5 begins ``late`` in one of them."""
    time, x = np.arange(0.0, 1.2, 0.01), np.linspace(0.0, 1.0, 2001)
    time[time < 0.5] -= late
    time[0] = 0.0
    rim = 0.2 + 0.3 * (time[1:] + time[:-1])
    pushed = (np.abs(rim[:, None] - x) < 2.5e-4) * 1.0
    history = history_of(time, x, impulse=np.vstack([0.0 * x, pushed.cumsum(axis=0)]))
    assert half_contact_length(history, 50) == pytest.approx(0.5, abs=1e-3)


def test_a_front_that_does_not_go_as_the_root_of_time_is_between_where_it_was_and_where_it_will_be() -> None:
    """It comes back from 0.6 as 0.6 − t/2; a zone of 0.3 ends at a quarter: straight in √t from there to nothing."""
    x, time = np.linspace(0.0, 1.0, 1001), np.linspace(0.0, 1.0, 2001)
    places = np.searchsorted(x, 0.6 - 0.5 * time)
    gained = np.zeros((time.size, x.size))
    gained[np.arange(1, time.size), places[1:]] = 1.0
    back = history_of(time, x, impulse=gained.cumsum(axis=0))
    front, bent = first_front(back, 0.5)
    assert front == pytest.approx(0.35, abs=2e-3) and bent == pytest.approx(0.6 - 0.5 * 0.475 - 0.35, abs=0.015)
    assert first_front(back, time[-2])[1] > 0.02  # the last interval tells that it comes back
    coarse = first_front(ImpactHistory.of(back.dataset.isel(time=slice(None, None, 200))), 0.5)[0]
    assert coarse == pytest.approx(0.35, rel=0.01)  # of intervals longer than a tenth of the time
    assert instant(back, 0.5, first_spread=True).element == pytest.approx(0.5 * bent)  # and not an element, 1 mm
    assert [unresolved(back, -1, front) for front in (2.9e-3, 3.1e-3)] == pytest.approx([1e-3, 0.0])  # it passed three
    ends = np.zeros((time.size, x.size))
    ends[:, 300], ends[:, 0] = np.minimum(time, 0.25), np.maximum(time - 0.25, 0.0)
    before, after = (1.0 + np.sqrt(0.9)) / 2.0, (1.0 + np.sqrt(1.1)) / 2.0
    share = (after - 1.0) / (after - before)
    front, bent = first_front(history_of(time, x, impulse=ends), 0.25)
    assert front == pytest.approx(0.3 * share, rel=0.02) and bent == pytest.approx(0.3)  # it may be at either place


def test_a_rim_that_jumps_about_an_instant_is_known_to_its_jump_alone() -> None:
    """From 0.4 to 0.8 at the instant itself; well before and after it is known to an element."""
    x, time = np.linspace(0.0, 1.0, 11), np.linspace(0.0, 1.0, 101)
    impulse = np.zeros((time.size, x.size))
    impulse[:, 4], impulse[:, 8] = np.minimum(time, 0.7), np.maximum(time - 0.7, 0.0)
    history = history_of(time, x, impulse=impulse, total_impulse=2.0 * impulse.sum(axis=1))
    assert instant(history, 0.7).element == pytest.approx(0.4)
    assert [instant(history, time).element for time in (0.5, 0.68, 0.72, 0.85)] == pytest.approx([0.1] * 4)


def test_half_a_contact_is_as_long_as_it_reaches_from_the_first_touch() -> None:
    """0.4 m to the right of it, where elements are short, and 0.3 m to the left; a round-off beyond is no push."""
    time, x = np.linspace(0.0, 1.0, 11), np.array([-1.0, -0.1, 0.2, 0.5, 0.6, 1.0])
    impact, impulse = Impact.whole_beam(0.5).replace(first_touch=0.2), np.outer(time, [1e-6, 1e3, 1e3, 0.0, 1e-4, 0.0])
    history = history_of(time, x, impact=impact, symmetry="full", impulse=impulse)
    found = instant(history, 0.5)
    assert (found.half_contact_length, found.element) == pytest.approx((0.4, 0.1))
    mirrored = impact.replace(first_touch=-0.2)
    found = instant(history_of(time, -x[::-1], impact=mirrored, symmetry="full", impulse=impulse[:, ::-1]), 0.5)
    assert (found.half_contact_length, found.element) == pytest.approx((0.4, 0.1))
    assert [element_at(history, -1, place) for place in (-0.5, 0.0, 0.55, 0.9)] == pytest.approx([0.9, 0.3, 0.1, 0.4])


def test_the_map_of_forces_holds_the_impulse_and_a_pull_is_a_share_of_a_push_in_any_unit() -> None:
    impact, x, time = Impact(2.0, 8.0, 6.0, 0.5, 3.0), np.linspace(0.0, 3.0, 31), np.linspace(0.0, 2.0, 41)
    impulse = 0.01 * np.outer(np.sqrt(time), np.exp(-x))
    history = history_of(time, x, impact=impact, impulse=impulse, total_impulse=2.0 * impulse.sum(axis=1))
    edges = np.linspace(0.0, 4.0, 9) / impact.length_scale
    kept = np.array([0, 30, 40])  # 1.5 and 0.5 s
    given = np.diff(time[kept]) @ force_map(history, kept, edges) @ np.diff(edges) / impact.time_scale
    assert given == pytest.approx(impulse[-1].sum() / (24.0 * impact.length_scale))
    near = force_map(history, kept, np.array([0.0, 0.55]) / impact.length_scale)[-1, 0] * 0.55
    assert near == pytest.approx((impulse[40] - impulse[30])[:6].sum() * impact.time_scale / (0.5 * 24.0), rel=1e-9)
    assert spread(np.array([0.05, 0.15, 0.25]), np.ones(3), np.array([0.0, 0.1])) == pytest.approx([1.0])  # middles
    assert spread(np.array([-0.1, 0.0, 0.1]), np.ones(3), np.array([-0.1, 0.0])) == pytest.approx([1.5])
    plate = spread(np.array([0.25, 0.26, 0.27]), np.ones(3), np.array([0.0, 0.25, 0.3]))
    assert plate == pytest.approx([0.0, 3.0])  # nothing before its edge
    assert spread(np.array([0.3]), np.ones(1), np.array([0.0, 0.25, 0.35])) == pytest.approx([0.0, 1.0])
    impulse = 1e-3 * np.outer(np.arange(41.0), [3.0, 2.0, 1.0])
    impulse[30:, 1] -= 4e-3
    assert pull_of(history_of(time, x[:3], impact=impact, impulse=impulse)) == pytest.approx(2.0 / 3.0)
    assert pull_of(history_of(time, x[:3], impact=impact, impulse=np.outer(time, np.ones(3)))) == 0.0
    impulse[:3, 0] += 9e-3  # a pull from 0.1 s on counts once a hundredth of the run is over
    for end, pull in ((1000.0, 2.0 / 3.0), (9.0, 2.0)):
        assert pull_of(history_of(np.r_[time[:4], 0.5 * end * time[4:]], x[:3], impulse=impulse)) == pytest.approx(pull)


def test_a_point_that_moves_pushes_where_it_is_halfway() -> None:
    """The second of three, at 1 + t, bears from half of that to one and a half: at 2.5 s from 1.75 to 5.25 m, at 3.5 s
    from 2.25 to 6.75 m. It gathers 5 and 7 N s."""
    time, impact = np.arange(6.0), Impact.dimensionless(0.5)
    places, impulse = np.outer(1.0 + time, [0.0, 1.0, 2.0]), np.outer(time**2, [0.0, 1.0, 0.0])
    history = history_of(time, [0.0, 1.0, 2.0], impact=impact, impulse=impulse, contact_position=places)
    edges, borne = np.array([0.0, 1.75, 5.25, 6.75, 8.0]), [0.0, 5.0 + 7.0 * 3.0 / 4.5, 7.0 * 1.5 / 4.5, 0.0]
    pushed = force_map(history, np.array([2, 4]), edges / impact.length_scale)
    assert pushed[0] * np.diff(edges) * 2.0 == pytest.approx(borne)


def test_a_moment_that_passes_its_earlier_largest_between_saved_instants_is_interpolated_itself() -> None:
    """It is 0.9 at 2 s and 1.5 at 3 s, and the largest before was 1.2: that stands until 2.5 s, with its place. The
    first, at 1 s, is there at once: it does not grow from 0, but on to the second."""
    time = np.arange(5.0)

    def moving(moment):
        told = {"largest_moment": moment, "largest_midspan_moment": moment, "largest_moment_place": 0.1 * time}
        return history_of(time, np.linspace(0.0, 1.0, 5), impact=Impact.whole_beam(2.0), **told)

    grown = [largest_moment(moving(np.array([0.0, 0.4, 1.2, 0.5, 1.4])), at).moment for at in (0.5, 1.25, 2.0, 9.0)]
    assert grown == pytest.approx([0.4, 0.6, 1.2, 1.4])
    run = moving(np.array([0.0, 1.2, 0.9, 1.5, 1.0]))
    times = (0.6, 2.0, 2.4, 2.6, 2.9, 3.0, 3.5)
    found = [largest_moment(run, at) for at in times]
    assert [one.moment for one in found] == pytest.approx([1.2, 1.2, 1.2, 1.26, 1.44, 1.5, 1.5])
    assert [one.place for one in found] == pytest.approx([0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.3])
    assert all(one.time <= at for one, at in zip(found, times))


def test_a_force_of_the_wall_that_passes_its_earlier_largest_between_saved_instants_is_interpolated_itself() -> None:
    """It grows to 1.1 at 2 s, falls to 0.5 at 4 s, grows by 0.4 a second, and is 1.1 again in the middle of a saved
    interval: the wall is pressed in half as far."""
    time, force = np.arange(7.0), np.array([0.0, 0.6, 1.1, 0.8, 0.5, 0.9, 1.3])
    largest, when = np.maximum.accumulate(force), np.array([0.0, 1.0, 2.0, 2.0, 2.0, 2.0, 6.0])
    told = {"peak_force": largest, "peak_penetration": 0.5 * largest, "peak_pressure": largest, "peak_force_time": when}
    given = np.concatenate(([0.0], np.cumsum(0.5 * (force[1:] + force[:-1]))))
    impact = Impact.whole_beam(2.0).replace(wall_stiffness=100.0)
    x, pushed = np.linspace(0.0, 1.0, 4), np.outer(given, [0.5, 0.0, 0.0, 0.0])
    run = history_of(time, x, impact=impact, impulse=pushed, total_impulse=given, **told)
    found = [instant(run, at) for at in (0.0, 0.5, 1.5, 5.0, 5.25, 5.75, 6.0)]
    most = [0.0, 0.3, 0.85, 1.1, 1.1, 1.2, 1.3]
    assert [one.peak_force for one in found] == [one.peak_pressure for one in found] == pytest.approx(most)
    assert [one.peak_penetration for one in found] == pytest.approx([0.5 * force for force in most])
    assert [one.peak_force_time for one in found] == pytest.approx([0.0, 0.5, 1.5, 2.0, 2.0, 5.75, 6.0])
    assert found[2].impulse_around == pytest.approx(np.interp(1.5 * np.linspace(0.9, 1.1, 9), time, given))


@pytest.mark.parametrize(("largest_at", "begin"), [(0.02, 0.0), (1.0, 0.9)])
def test_a_force_that_is_largest_when_a_run_begins_or_ends_acts_where_the_wall_pushed_then(largest_at, begin) -> None:
    """At 1 m in one interval alone, otherwise in the middle."""
    time, x = np.linspace(0.0, 1.0, 11), np.array([0.0, 1.0])
    there = np.clip(time - begin, 0.0, 0.1)
    given = np.column_stack([time - there, there])
    peaks = dict.fromkeys(("peak_force", "peak_penetration", "peak_pressure"), time)
    peaks["peak_force_time"] = np.full(time.size, largest_at)
    assert wall_peaks(history_of(time, x, impulse=given, total_impulse=given.sum(axis=1), **peaks)).place == 1.0
    landed, peaks["peak_force_time"] = np.outer(np.maximum(time - 0.5, 0.0), [0.0, 1.0]), np.full(time.size, 0.5)
    assert wall_peaks(history_of(time, x, impulse=landed, **peaks)).place == 1.0  # of a damper, as the beam lands


@pytest.mark.parametrize(("power", "least", "above"), [(1, 0.5, 0.75 * 0.005), (2, 1.0 - 1e-6, 0.005**2)])
def test_a_step_at_the_top_of_a_force_stands_out_by_h_at_a_kink_and_by_h_squared_if_smooth(power, least, above) -> None:
    """The force 1 − |t − t₀|ᵖ + (t − t₀)/3, whose tilt makes no edge, in steps of 0.005, saved at every tenth; the mean
    of the one at a kink is 1 − h/4, of those beside it 1 − h. From saved instants a kink is told to a half only."""
    time, top = np.linspace(0.0, 1.05, 22), 0.525
    given = time - np.sign(time - top) * np.abs(time - top) ** (power + 1) / (power + 1) + (time - top) ** 2 / 6.0
    peaks = dict.fromkeys(("peak_force", "peak_penetration", "peak_pressure"), np.ones(time.size))
    run = history_of(time, [0.0, 1.0], total_impulse=given, peak_force_time=np.full(time.size, top), **peaks)
    run = ImpactHistory.of(run.dataset.assign_attrs(steps=210))
    found = wall_peaks(run).sharp
    assert least * above < found <= above * (1.0 + 1e-6)
    short = ImpactHistory.of(run.dataset.isel(time=slice(9, 14)))  # one less tells nothing: it is as sharp as a landing
    assert wall_peaks(short).sharp == pytest.approx(1e-4)
    for few in (slice(8, 14), slice(7, 14), slice(8, 15)):  # the six instants about the top are enough
        part = ImpactHistory.of(run.dataset.isel(time=few).assign_attrs(steps=round(200 * time[few][-1])))
        assert wall_peaks(part).sharp == pytest.approx(found)


def test_a_parabola_rises_above_a_value_by_its_top_and_above_an_end_by_nothing() -> None:
    values = 2.0 - (np.arange(-2.0, 3.0) - 0.3) ** 2
    assert [rise_between(values[:last], 2) for last in (5, 4, 3)] == pytest.approx([0.09, 0.09, 0.0])
    assert rise_between(values[2:], 0) == rise_between(np.ones(3), 1) == 0.0
    assert rise_between(values[1:], 1) == pytest.approx(0.09)


def test_the_first_moment_is_that_of_where_the_pushes_were():
    """A unit force on each side at 0.02√t, in l*: its moment is 0.02(2/3)t^{3/2}, whatever the mesh did since."""
    time = np.linspace(0.0, 1.0, 2001)
    places, both = 0.02 * np.sqrt(time)[:, None] * [-1.0, 1.0], {"symmetry": "full", "total_impulse": 2.0 * time}
    pushes = {"impulse": np.outer(time, [1.0, 1.0]), "contact_position": places}
    moved = history_of(time, places[-1], **pushes, **both)
    impulse, moment = one_side(moved)
    assert impulse == pytest.approx(time)
    assert moment[500:] == pytest.approx(0.02 * 2.0 / 3.0 * time[500:] ** 1.5, rel=1e-4)
    assert first_front(moved, 0.5) == pytest.approx((0.02 * np.sqrt(0.5), 0.0), rel=1e-3, abs=1e-5)
    assert first_front(moved, 0.0) == (0.0, 0.0)
    assert first_front(moved, time[1])[0] == pytest.approx(0.02 * np.sqrt(time[1]))
    late = ImpactHistory.of(moved.dataset.isel(time=slice(500, None)))  # it got there what it has got before
    assert one_side(late)[1] == pytest.approx(moment[500:] - moment[500] + 0.25 * 0.01)


@pytest.mark.parametrize("times", [np.linspace(0.0, 0.1, 41), np.linspace(0.0, 0.3, 30) ** 2])
def test_the_front_is_where_it_is_at_the_instant_not_where_it_was_on_the_way(times):
    """Of an exact history, F = c/√t at λ₀√t: I = 2c√t, J = cλ₀t."""
    front = local_front(times, 3.0 * np.sqrt(times), 1.5 * 0.7 * times)
    assert front == pytest.approx(0.7 * np.sqrt(times), rel=1e-12)


def test_three_even_points_within_seven_tenths_of_a_front_tell_the_uniform_reaction() -> None:
    """2 to 0.4, where 100 push on each side: they are known from 0.5 on. Before a first push there is no front."""
    time, x, impact = np.linspace(0.5, 2.0, 61), np.linspace(0.0, 1.0, 11), Impact.dimensionless(0.5)
    loads = 2.0 * np.array([0.05, 0.1, 0.1, 0.1, 0.05, *np.zeros(6)]) + 100.0 * (np.arange(11) == 4)
    pushed, late = np.outer(time, loads), np.outer(np.maximum(time - 1.0, 0.0), loads)
    runs = [history_of(time, x, impact=impact, impulse=i, total_impulse=2.0 * i.sum(axis=1)) for i in (pushed, late)]
    found, none = (moments(run, uniform=True) for run in runs)
    assert found.pressure == pytest.approx([0.0, *np.full(60, 2.0)]) and np.all(none.front[:21] == 0.0)
    assert found.front[-1] == pytest.approx(0.4 * 2.0 * np.sqrt(2.0) / (np.sqrt(2.0) + np.sqrt(1.975)))
    assert found.impulse[-1] == pytest.approx(0.5 * 100.8 + 1.5 * 100.0)
    assert found.moment[-1] == pytest.approx(0.5 * 40.16 + 1.5 * 40.0)


def test_a_pressure_that_grows_with_time_is_its_mean_from_a_quarter_of_the_time_to_as_much_beyond() -> None:
    """3t² to 0.4: (1.75³ − 0.25³)/1.5 t², but at the end, where nothing is known of what comes."""
    time, x = np.linspace(0.0, 2.0, 65), np.linspace(0.0, 1.0, 11)
    impulse = np.outer(time**3, [0.05, 0.1, 0.1, 0.1, 0.05, *np.zeros(6)]) + np.outer(time, 100.0 * (x == x[4]))
    found = moments(history_of(time, x, impulse=impulse, total_impulse=2.0 * impulse.sum(axis=1))).pressure
    assert found[[16, 32, 64]] == pytest.approx([3.5625 / 4.0, 3.5625, 5.25], rel=1e-9)


def test_springs_in_place_of_a_rigid_wall_leave_half_of_the_square_of_their_length_over_the_front() -> None:
    """EI = 2 N m² and k_c = 5e5 N/m² make √(EI/k_c) = 2e-3 m²; elements resolve the front."""
    time, x = np.linspace(0.0, 1.0, 11), np.linspace(0.0, 1.0, 101)
    impact = Impact(2.0, 8.0, 6.0, 0.5, 1.0)
    rigid = history_of(time, x, impact=impact, impulse=np.outer(time, x <= 0.4), total_impulse=82.0 * time)
    found = moments(rigid)
    front = float(found.front[-1]) * impact.length_scale
    springs = ImpactHistory.of(rigid.dataset.assign_attrs(settings='{"integrator": {"stiffness": 5e5}}'))
    assert unresolved_at_end(rigid, found) == 0.0
    assert unresolved_at_end(springs, found) * impact.length_scale == pytest.approx(0.5 * 2e-3 / front) and front > 0.03
