"""Whether a beam that has left the wall can come back to it, and when a run is over."""

import math
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from histories import history_of, pushed_until

from bent_beam import ImpactHistory
from bent_beam.free_flight import LOWEST_PERIOD, Separation, cannot_return, has_left, may_return
from bent_beam.hysteresis import branches_of
from bent_beam.impact import Impact
from bent_beam.measure.whole_impact import hits, whole_impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import separation_times, simulate_to_separation
from hermite_fe import HermiteFE


def test_a_beam_that_has_left_does_not_return_and_one_that_swings_as_wide_as_it_is_away_may() -> None:
    impact, method = Impact.whole_beam(0.5, relative_damping=1e-2), HermiteFE(mesh=UniformMesh(1.0 / 15))
    history = method.simulate_to_separation(impact)
    assert has_left(history)
    later = method.for_whole_beam(impact).simulate(impact, end_time=3.0, save=20)
    assert later.array("total_impulse")[-1] == pytest.approx(history.array("total_impulse")[-1], rel=1e-6)
    plain: Any = SimpleNamespace(simulate=method.for_whole_beam(impact).simulate)  # no way of its own to a separation
    whole = simulate_to_separation(plain, impact, save=100)
    assert whole.time[-1] > (whole_impact(whole).last_contact + LOWEST_PERIOD) * impact.slow_time_scale
    x, u = np.linspace(0.0, 1.0, 101), np.linspace(0.0, 1.0, 2001)
    flat, up, rigid = 0.5 * 2.0 * x**2, -0.5 * np.ones_like(x), 0.5 * 2.0 * 0.5**2
    # unit force on an end, held by inertia: Q = 3u² − 2u, M = Lu²(u − 1), L = 2; what the end yields by
    bends, shears = 8.0 * np.trapezoid((u**3 - u**2) ** 2, u), 2.0 * np.trapezoid((3.0 * u**2 - 2.0 * u) ** 2, u)
    lossy = Impact.whole_beam(2.0).replace(hysteretic_loss=0.1, loss_frequency=1.0)
    for impact, yields in (
        (Impact.whole_beam(2.0), bends),
        (Impact.whole_beam(2.0).replace(bending_stiffness=3.0), bends / 3.0),
        (Impact.whole_beam(2.0, shear_length=0.5), bends + 0.25 * shears),
        (lossy, bends / branches_of(lossy).relaxed),  # held long enough
    ):
        reach = math.sqrt(2.0 * 0.1 * yields)
        assert cannot_return(impact, x, flat + 1.01 * reach, up, rigid + 0.1)
        assert not cannot_return(impact, x, flat + 0.99 * reach, up, rigid + 0.1)
        assert not cannot_return(impact, x, flat + 1.01 * reach, -up, rigid + 0.1)
        assert not cannot_return(impact.replace(acceleration=1.0), x, flat + 9.0, up, rigid)
    assert not may_return(history) and may_return(history.until(0.7))


def test_a_method_without_a_way_of_its_own_runs_twice_as_far_until_the_beam_is_given_up() -> None:
    asked: list[float] = []

    def pushed_for_ever(impact: Impact, *, end_time: float, **_: Any) -> ImpactHistory:
        asked.append(end_time)
        return pushed_until(99.0)

    plain: Any = SimpleNamespace(simulate=pushed_for_ever)
    simulate_to_separation(plain, Impact.whole_beam(2.0))
    assert asked == pytest.approx([1.5, 3.0, 6.0, 8.0])


@pytest.mark.parametrize("push", [0.0, 1.0])
def test_a_beam_that_never_touched_has_not_left(push) -> None:
    """It flies away as it is laid, at V₀."""
    x, time = np.linspace(0.0, 1.0, 41), np.array([0.0, 1.0, 4.0])
    gap, grown = time[:, None] + x**2, {"total_impulse": push * np.minimum(time, 1.0)}
    moving = {"velocity": -np.ones((3, x.size)), "kinetic_energy": np.ones(3), "strain_energy": np.zeros(3)}
    assert has_left(history_of(time, x, impact=Impact.whole_beam(2.0), gap=gap, **grown, **moving)) == bool(push)


def test_tension_brings_a_hinged_beam_back_and_a_load_off_the_wall_brings_none_back() -> None:
    stop = {"wall_from": 0.5, "wall_to": 0.5, "wall_stiffness": 9.0}
    pendulum = Impact.whole_beam(1.0).replace(curvature=0.0, left_end="hinged", **stop)
    back = (pendulum.replace(axial_force=1.0), pendulum.replace(acceleration=1.0))
    free = Impact.whole_beam(0.5)
    impacts = (*back, pendulum, free.replace(acceleration=-0.1), free.replace(acceleration=0.1))
    stands: list[Any] = [SimpleNamespace(impact=impact) for impact in impacts]
    assert [may_return(one) for one in stands] == [True, True, False, False, True]


def test_a_beam_that_turns_comes_back_with_the_end_that_turns_to_the_wall_faster_than_it_leaves() -> None:
    x, impact = np.linspace(-1.0, 1.0, 401), Impact.whole_beam(2.0)
    bow, up, spin = 0.5 * 2.0 * x**2, 0.5, 0.3
    for turns, back in ((0.99 * up, False), (1.01 * up, True), (-1.01 * up, True)):
        energy = 0.5 * 2.0 * (up**2 + turns**2 / 3.0)
        assert cannot_return(impact, x, bow + 0.2 + 0.1 * x, -up - turns * x, energy) != back
    energy = 0.5 * 2.0 * (up**2 + spin**2 / 3.0)
    for share in (0.99, 1.01):  # 0.1 J beyond that of its flight and turning bend its ends by √(2·0.1·L³/105)
        reach = share * math.sqrt(0.2 * 8.0 / 105.0)
        assert cannot_return(impact, x, bow + reach, -up - spin * x, energy + 0.1) == (share > 1.0)
    for tilt, back in ((0.88, False), (0.9, True)):  # a tilted bow of this height is at the wall from √0.8 on
        assert cannot_return(impact, x, bow + 0.2 + tilt * x, -up - spin * x, energy) != back


def test_a_beam_is_given_up_in_time_with_how_long_a_soft_wall_pushes() -> None:
    """Three times the half period π√(m/k) of a bar on springs, at most 100 T*; in T* = 2 s here."""
    bar = Impact(1.0, 4.0, 2.0, 0.0, 1.0, damping=1e-2)
    walls = {8.0: None, 3.0 * math.pi / math.sqrt(0.03): 0.03, 100.0: 1e-4}
    for end, stiffness in walls.items():
        assert separation_times(bar.replace(wall_stiffness=stiffness))[-1] == pytest.approx(2.0 * end, abs=0.012)
    stop = bar.replace(wall_from=0.5, wall_to=0.5)
    swinging = stop.replace(right_end="hinged", wall_clearance=3.0)  # half as fast there as in the middle
    rocking = stop.replace(curvature=2.0, first_touch=0.1, rotation=0.6, wall_from=-0.1, wall_to=-0.1)
    for beam, flight in ((stop, 0.0), (swinging, 6.0), (stop.replace(curvature=2.0), 0.25), (rocking, 0.04 / 0.94)):
        assert separation_times(beam)[-1] == pytest.approx(16.0 + flight, rel=1e-12)
    assert separation_times(stop, 6.0, save=50).size == 150  # in three T*
    assert separation_times(swinging.replace(wall_clearance=300.0))[-1] == pytest.approx(16.0 + 40.0, rel=1e-12)


def test_a_run_is_over_a_period_of_the_lowest_mode_after_its_last_push() -> None:
    over = Separation(Impact.whole_beam(2.0))  # T* = 1
    x = np.linspace(0.0, 1.0, 5)
    gone = (x, 1.0 + x**2, -np.ones(5), 1.0)  # as laid, one half beam away, at the velocity of all its energy
    assert not over(0.0, 0.0, lambda: gone) and not over(5.0, 0.0, lambda: gone)  # it has not touched yet
    assert not over(6.0, 1.0, lambda: gone)
    assert not over(6.0 + 0.99 * LOWEST_PERIOD, 1.0, lambda: gone)
    assert over(6.0 + 1.01 * LOWEST_PERIOD, 1.0, lambda: gone)
    assert not over(8.0, 1.0, lambda: gone, closed=True)


def test_a_beam_that_is_glued_to_its_wall_has_not_left_though_pulls_and_pushes_balance() -> None:
    """Nothing of the whole is given from 0.5 T* on, as of a wall that holds a beam by points that have closed."""
    free = pushed_until(0.5)
    late = np.outer(np.maximum(free.time - 0.5, 0.0), [0.0, 0.2, -0.2, 0.0, 0.0])
    still, pushed = 0.0 * free.array("gap"), free.array("impulse") + late
    held = {n: free.variables[n]._replace(values=v) for n, v in {"gap": still, "impulse": pushed}.items()}
    glued = replace(free, variables={**free.variables, **held})
    assert has_left(free) and not has_left(glued)
    assert [(hit.end, hit.over) for hit in hits(glued)] == [(pytest.approx(1.975), False)]
    assert whole_impact(glued).last_contact == pytest.approx(1.975) and whole_impact(glued).restitution is None
