"""The hits of one wall: of beams that rock, fly under a load, or are still on it when the run ends."""

import dataclasses
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from histories import pushed_until, recorded

from bent_beam import ImpactHistory
from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.measure.whole_impact import hits
from bent_beam.meshes import UniformMesh
from comparison.bouncing import bounce, case_of, follow_hits, followed_hits, followed_until, problem
from comparison.readable import hits_table, milliseconds
from comparison.whole_numbers import OF_ONE_WALL
from hermite_fe import HermiteFE


def test_a_flight_under_a_load_does_not_count_and_where_it_is_too_long_its_end_is_told(monkeypatch) -> None:
    """2ev/a to the next hit: longer than the 5 T* to which a beam is followed here."""
    monkeypatch.setattr("comparison.bouncing.LONGEST_OF_WALL", 5.0)
    impact, few = problem(2.0, 0.02).replace(acceleration=0.15), HermiteFE(mesh=UniformMesh(0.1))
    first, unit = bounce(impact, few).history, impact.slow_time_scale
    one, two = followed_hits(impact, few, 2, first=first)[0]
    back = one.end - 2.0 * one.after / 0.15
    assert two.begin == pytest.approx(back, rel=0.05) and two.begin > 5.0 * unit
    assert followed_until(impact, [one]) == pytest.approx(5.0 * unit + back - one.end, rel=1e-12)
    monkeypatch.setattr("comparison.bouncing.FLIGHTS", 0.5)
    fewer, why = followed_hits(impact, few, 2, first=first)
    said = f"is back at about {milliseconds(back)}, and it is followed until {milliseconds(5.5 * unit)}"
    assert fewer == [one] and why.endswith(said)
    _, why = followed_hits(impact.replace(acceleration=0.0), few, 2, first=first)
    assert why.startswith("then the beam is off for good")


@pytest.mark.verify
def test_a_beam_that_rocks_back_onto_its_wall_is_told_and_followed() -> None:
    """Literal values of an explicit code of finite differences, 160 elements: 2.3165 to 2.4715, 0.3973."""
    impact = problem(2.0, 0.02).replace(first_touch=0.3, wall_stiffness=3e3)
    impact = impact.replace(shear_stiffness=400.0, rotary_inertia=5e-4, wall_damping=0.6 * math.sqrt(3e3))
    found = bounce(case_of(impact), HermiteFE())
    assert any(line.startswith("the beam comes back to the wall") for line in found.warnings)
    _, second = follow_hits(impact, HermiteFE(), 3, first=found.history)
    assert second.begin == pytest.approx(2.316, abs=6e-3) and second.end == pytest.approx(2.4715, abs=6e-3)
    assert second.impulse == pytest.approx(0.3973, abs=1e-3)


def test_a_free_beam_that_rocks_away_slowly_has_the_numbers_of_its_first_hit_and_may_come_back() -> None:
    """Its end turns to the wall about as fast as it leaves: no bound says that it never returns."""
    impact = problem(1.9, 0.013).replace(first_touch=0.17)
    found = bounce(impact, HermiteFE(mesh=UniformMesh(0.1)))
    assert found.left and any(line.startswith("the beam may come back to the wall") for line in found.warnings)
    assert f" ms, {milliseconds(LOWEST_PERIOD)} after the last contact." in str(found)
    restitution, pressed = found.numbers["restitution"], impact.replace(acceleration=1e-9)
    held = bounce(pressed, HermiteFE(mesh=UniformMesh(0.1))).numbers["restitution"]
    assert abs(restitution.known - held.known) <= restitution.spread + held.spread


def test_the_last_hit_of_a_beam_that_cannot_return_is_followed_for_a_period_and_listed() -> None:
    """It ends 0.45 T* before the first of the ends to which the run is carried."""
    ends: list[float] = []

    def record(impact: Any = None, *, end_time: float = 3.0, save: Any = None) -> ImpactHistory:
        ends.append(end_time)
        energy = np.full(round(20 * end_time) + 1, 0.55)  # little more than its flight has
        return pushed_until(0.3, last=end_time, again=1.5, kinetic_energy=energy)

    method: Any = SimpleNamespace(simulate=record)
    found, why = followed_hits(record().impact, method, 3, first=record())
    assert [hit.begin for hit in found] == pytest.approx([0.0, 1.5], abs=0.05)
    assert why.startswith("then the beam is off for good")
    assert ends[-2] - found[1].end < LOWEST_PERIOD < ends[-1] - found[1].end


def test_largest_values_of_a_free_beam_that_comes_back_are_those_of_all_its_hits_and_the_answer_says_so() -> None:
    """It touches beside its middle, and its other half slaps harder: 1.2527 to 1.2519 for 0.6434, by an explicit code
    of finite differences with 80 and 160 elements."""
    few, impact = HermiteFE(refine=0.5), problem(3.06, 0.0147).replace(first_touch=0.7, wall_stiffness=678.0)
    found = bounce(impact, few)
    one, two = follow_hits(impact, few, 2, first=found.history)
    assert (one.moment, two.moment) == pytest.approx((0.6434, 1.252), rel=2e-3)
    moment = found.numbers["peak_moment"]
    assert moment.known == pytest.approx(two.moment, rel=1e-3) and one.end == found.outcome.last_contact
    (said,) = (line for line in found.warnings if line.startswith("the beam comes back to the wall"))
    assert f"largest values are of all hits until {milliseconds(found.span[1])}" in said and found.to_dict()["again"]
    assert "in which the beam hits more than once" in str(found) and "Where two overlap" not in str(found)


@pytest.mark.parametrize(("energy", "last", "over"), [(1.0, 1.0, False), (1.0, 2.0, True), (0.21, 1.0, True)])
def test_a_hit_is_over_when_the_beam_stays_off_for_a_period_or_cannot_return(energy, last, over) -> None:
    """At 0.45 V₀ its flight has 0.2025 μℓV₀²; what else there is bends it, and may bring it back."""
    (hit,) = hits(pushed_until(0.5, last=last, kinetic_energy=np.full(round(20 * last) + 1, energy)))
    assert hit.over == over
    row = dataclasses.asdict(hit) | {"restitution": hit.restitution}
    assert ("the last hit may not be over" in hits_table([row], OF_ONE_WALL)) != over


def test_the_numbers_of_a_beam_that_stays_on_its_wall_are_not_said_to_be_of_a_hit_that_is_over() -> None:
    pressed = problem(2.0, 0.02).replace(acceleration=40.0)
    said = str(bounce(pressed, HermiteFE(mesh=UniformMesh(0.1))))
    assert "The first hit is not over" in said and "stays off" not in said


def test_a_hit_that_goes_on_beside_one_of_the_other_wall_is_not_over() -> None:
    time = np.linspace(0.0, 2.0, 41)
    front, behind = (np.outer(np.clip(time - at, 0.0, span), np.ones(5)) for at, span in ((0.0, 2.0), (0.5, 0.5)))
    run = recorded(time, front, total_impulse=2.0 * (front - behind).sum(axis=1), opposite_impulse=behind)
    assert [hit.over for hit in hits(run)] == [False, False]
    short = np.minimum(front, 0.3)
    early = recorded(time, short, total_impulse=2.0 * (short - behind).sum(axis=1), opposite_impulse=behind)
    assert [hit.over for hit in hits(early)] == [True, False]
