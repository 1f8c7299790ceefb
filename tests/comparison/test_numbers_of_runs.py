"""From readings to numbers: what companions change, what no companion shows, and what is said of a run's energies."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
from histories import history_of, pushed_until

from bent_beam import Impact
from bent_beam.hysteresis import first_mode
from bent_beam.measure.numbers import FACTOR, Band, Number
from bent_beam.measure.reduction import peak_moment
from bent_beam.meshes import UniformMesh
from comparison.bounced import Bounce
from comparison.bouncing import case_of, problem, whole_numbers, whole_reading
from comparison.doubts import energy_residual, loss_warnings, numerical_loss, told_by, wide_bars
from comparison.predicting import OF_INSTANT, instant_numbers, instants_reading
from comparison.questions import Question
from comparison.runs import Run, Runs, numbers_of
from comparison.texts import bounce_text
from hermite_fe import HermiteFE

COARSE = HermiteFE(mesh=UniformMesh(1.0 / 25))
LATE, EARLY = 0.1, 0.001  # T*
TIME = {name: 1.0 for name in OF_INSTANT} | {"impulse_around": [0.9, 1.0, 1.1], "element": 0.0, "lift": 0.0}
TIME |= {"moment_left_out": 0.0, "moment_spread": 0.0, "peak_force_sharp": 0.0}
ENERGY = {"initial": 1.0, "work_of_loads": 0.0, "loss_algorithmic": 0.0, "loss_viscous": 0.0, "defect": 0.0}


def runs(reading, *others, kappa=0.5, damping=1e-3, until=LATE, band=None, **change) -> Runs:
    """Runs of a beam with these readings, that of the run itself first."""
    run, *companions = (Run(one, [], 1.0, 1) for one in (reading, *others))
    question = Question(problem(kappa, damping).replace(**change), COARSE, until, band=band)
    return Runs(question, run, {f"companion {i}": one for i, one in enumerate(companions)})


def whole(*readings, **asked) -> Runs:
    return runs(*readings, **{"kappa": 2.0, "until": None} | asked)


def bounced(made: Runs) -> Bounce:
    return Bounce(case_of(made.question.impact), whole_numbers(made), made)


@pytest.mark.parametrize(("damping", "value", "bar"), [(0.0, 2.0, 2.0), (1e-3, 1.0, FACTOR * (1.0 + 2.0))])
def test_late_and_without_damping_a_number_is_a_mean_with_two_standard_deviations(damping, value, bar) -> None:
    drawn = runs({"impulse": 1.0}, {"impulse": 2.0}, {"impulse": 3.0}, damping=damping)
    number = numbers_of(drawn, ["impulse"])["impulse"]
    assert (number.value, number.bar) == pytest.approx((value, bar))


@pytest.mark.parametrize(
    ("damping", "until", "least"),
    [(1e-3, None, 1e-4), (2e-4, None, 1e-3), (3.1e-4, 0.051, 1e-4), (2.9e-4, 0.051, 1e-3), (2.9e-4, 0.049, 1e-4)],
)
def test_companions_that_agree_better_than_whole_beams_can_leave_a_ten_thousandth(damping, until, least) -> None:
    """A thousandth where short waves live long, once they have run along the beam."""
    made = runs({"impulse": 5.0}, {"impulse": 5.0 + 1e-9}, damping=damping, until=until)
    slow = Impact(1.0, 1e6, 2.0, 0.5, 1e-3, damping=1e3 * damping)  # the same, a thousand times slower
    later = dataclasses.replace(made.question, impact=slow, until=until and 1e3 * until)
    assert slow.slow_time_scale == 1e3 and later.late == made.question.late
    for one in (made, dataclasses.replace(made, question=later)):
        assert numbers_of(one, ["impulse"])["impulse"].bar == pytest.approx(5.0 * least)


def test_a_run_is_kept_under_all_that_it_depends_on() -> None:
    question = runs(TIME).question
    for change in ({"impact": problem(0.5, 0.0)}, {"until": EARLY}, {"save": 300}):
        other = dataclasses.replace(question, **change)
        assert other.key(other.impact) != question.key(question.impact), change


def test_curves_that_cross_at_the_time_asked_do_not_agree() -> None:
    """Nor do forces before a soft wall: means over halves of the window, 0.4 long, differ by ±0.04/0.2. What all of the
    window changes is in the bar already."""
    crossing, above = {"impulse_around": [0.92, 1.0, 1.08]}, {"impulse": 1.02, "impulse_around": [0.92, 1.02, 1.12]}
    for change, bar in (({}, 0.0), (crossing, FACTOR * 0.02), (above, FACTOR * 0.02)):  # what is above counts once
        assert instant_numbers(runs(TIME, TIME | change))["impulse"].bar == pytest.approx(bar)
    for wall, middle, end, apart in ((None, 1.04, 1.1, 0.0), (1e4, 1.04, 1.1, 0.04), (1e4, 1.06, 1.12, 0.04)):
        other = TIME | {"impulse_around": [0.9, middle, end]}
        found = instant_numbers(runs(TIME, other, until=2.0, wall_stiffness=wall))
        assert found["reaction"].bar == pytest.approx(FACTOR * apart / 0.4)
    near = TIME | {"impulse_around": [0.9, 1.0 + 2.0**-50, 1.1]}
    assert instant_numbers(runs(TIME, near, until=2.0, wall_stiffness=1e4))["reaction"].bar == 0.0  # it is round-off


def test_a_half_length_that_a_companion_does_not_have_is_as_unsure_as_it_is_long() -> None:
    number = instant_numbers(runs(TIME, TIME | {"half_contact_length": None}))["half_contact_length"]
    assert number.value == 1.0 and number.bar == pytest.approx(FACTOR)
    assert "half contact length" in wide_bars({"half_contact_length": number})[0]
    assert not instant_numbers(runs(TIME | {"half_contact_length": None}, TIME))["half_contact_length"].measured


def test_what_a_run_and_its_companion_share_stays_in_the_bar() -> None:
    """Grid viscosity of an early run, 2e-3; chatter of single nodes in a moment without damping, 1e-2; of the pressure
    of a landing 1e-4."""
    for pressure, bar in ((1.0, 1e-4), (1.01, FACTOR * 0.01)):
        found = instant_numbers(runs(TIME, TIME | {"peak_pressure": pressure}, wall_stiffness=1e4))
        assert found["peak_pressure"].bar == pytest.approx(bar)
    early = instant_numbers(runs(TIME, TIME, until=EARLY))
    assert early["impulse"].bar == early["peak_moment"].bar == pytest.approx(2e-3)
    for change, rightly in (({}, False), ({"acceleration": -1.0}, True), ({"wall_stiffness": 1e3}, True)):
        lifted = instant_numbers(runs(TIME | {"lift": 0.05}, TIME, until=EARLY, damping=0.0, **change))["impulse"]
        assert (lifted.parts["lift"] == 0.0) is rightly, "a load or a wall that gives way may lift the zone"
    three = TIME | {name: 3.0 for name in OF_INSTANT}  # they are shares of the number
    light, early = (instant_numbers(runs(three, three, damping=2e-4, until=until)) for until in (LATE, EARLY))
    assert light["peak_moment"].bar == pytest.approx(3e-2) and early["impulse"].parts["grid_viscosity"] == 6e-3
    for eta, kappa, bar in ((2e-4, 0.5, 1e-2), (0.0, 0.5, 1e-2), (0.0, 1.01, 1e-2), (1e-3, 0.5, 0), (2e-4, 1.01, 0)):
        number = instant_numbers(runs(TIME, TIME, TIME, damping=eta, kappa=kappa))["peak_moment"]
        assert number.bar == pytest.approx(bar, rel=1e-6, abs=0.0), (eta, kappa)


def last_contact(one, other, **change):
    return whole_numbers(whole(one, other, **change))["last_contact"]


@pytest.mark.parametrize(("other", "shift"), [((0.3, 0.5), 0.0), ((0.35, 0.45), 0.05), ((0.8, None), 0.2)])
def test_the_bar_of_the_last_contact_holds_the_shift_of_its_beginning(other, shift) -> None:
    """From 0.5 to 0.8 T*, 0.2 T* after another contact; the companion's begins 0.05 T* sooner, or goes on from that."""
    number = last_contact(*(whole_reading(pushed_until(end, again=again)) for end, again in ((0.3, 0.5), other)))
    assert number.value == pytest.approx(0.8, abs=0.03)
    assert number.parts["companion 0"] == pytest.approx(0.0, abs=1e-9)
    assert number.parts["contacts"] == pytest.approx(FACTOR * shift, abs=0.05)  # saved every 0.05 T*


@pytest.mark.parametrize("e", [0.02, 0.5, -0.2])
@pytest.mark.parametrize(("kappa", "least"), [(1.1, 1e-4), (0.5, 4e-4), (0.2, 2.5e-3), (0.05, 1e-2), (1e-160, 1e-2)])
def test_a_rebound_from_a_rigid_wall_is_the_less_known_the_flatter_the_beam(kappa, least, e) -> None:
    """And no better than its impulse, J = (1 + e)mV, nor its energies than e²; companions agree but for round-off."""
    names = ("restitution", "impulse", "translation", "vibration", "peak_moment")
    reading = whole_reading(pushed_until(0.5)) | {"restitution": e, "translation": e**2, "vibration": 0.1}
    other = reading | {name: reading[name] * (1.0 + 1e-9) for name in names}
    for change, share in (({}, least), ({"wall_stiffness": 1e4}, 1e-4), ({"wall_from": 0.0, "wall_to": 0.0}, 1e-4)):
        found = numbers_of(whole(reading, other, kappa=kappa, damping=1e-2, **change), names)
        bars = {"restitution": (1.0 + e) * share, "translation": 2.0 * abs(e) * (1.0 + e) * share}
        bars |= {"vibration": max(bars["translation"], 0.1 * share), "impulse": share * reading["impulse"]}
        bars["peak_moment"] = 1e-4 * reading["peak_moment"]
        assert {name: found[name].bar for name in names} == pytest.approx(bars), change
    gone = numbers_of(whole(reading | {"restitution": None}, other | {"restitution": None}, kappa=kappa), ["impulse"])
    assert gone["impulse"].bar == pytest.approx(least * reading["impulse"])  # of a beam that turns alone


def test_laws_that_agree_by_chance_are_compared_on_half_of_the_elements_too() -> None:
    """The larger of two changes counts, of the numbers of a rebound alone; a run that is lost changes nothing."""
    own = whole_reading(pushed_until(0.5))
    question = Question(problem(1.0, 1e-2), COARSE)
    causes = ("mesh_and_step", "contact_law", "contact_law_coarser")
    sheared = dataclasses.replace(question, impact=question.impact.replace(shear_stiffness=1e4))
    assert tuple(question.companions()) == tuple(sheared.companions()) == causes
    half, law, law_of_half = (method.for_whole_beam(impact).mesh for impact, method in question.companions().values())
    assert half == law_of_half == UniformMesh(2.0 * law.element_length)
    timed, point = (dataclasses.replace(question, **one) for one in ({"until": LATE}, {"impact": problem(2.0, 1e-2)}))
    assert tuple(timed.companions()) == tuple(point.companions()) == causes[:2]
    for law, both, laws in ((0.01, 0.04, 0.06), (0.07, 0.04, 0.07), (0.01, None, 0.01)):
        shifts = {"mesh_and_step": -0.02, "contact_law": law} | ({} if both is None else {"contact_law_coarser": both})
        every = {
            cause: Run(own | {name: own[name] + shift for name in ("restitution", "peak_moment")}, [], 1.0, 1)
            for cause, shift in shifts.items()
        }
        found = whole_numbers(Runs(question, Run(own, [], 1.0, 1), every))
        bar, drift = found["restitution"].bar, found["restitution"].parts["saved_instants"]
        assert bar == pytest.approx(FACTOR * (0.02 + laws) + drift)
        assert found["peak_moment"].bar == pytest.approx(FACTOR * (0.02 + law))


def test_largest_moments_of_curves_that_differ_around_them_do_not_agree() -> None:
    """Curves 0.02 apart with one maximum, of 1 at 0.3 T*; a companion that is 0.05 higher all over, which counts once;
    one whose largest is another, at 0.7 T*, where this one's is not kept."""
    read = whole_reading(pushed_until(0.5))
    assert read["moment_around"][0] == [read["peak_moment_time"]]  # saved every 0.05 T*
    run, larger = pushed_until(0.5), {"velocity": 1e3, "impulse": 1e3, "total_impulse": 1e3, "kinetic_energy": 1e6}
    told = {name: larger.get(name, 1.0) * run.array(name) for name in ("gap", "slope", *larger)}
    fast = history_of(1e-3 * run.time, run.positions(0), impact=Impact(1e6, 1.0, 2.0, 2.0, 1e3), **told)  # T* is 1 ms
    assert np.array(whole_reading(fast)["moment_around"]) == pytest.approx(np.array(read["moment_around"]))
    steps, same = np.arange(-8, 9), ("peak_moment", "midspan_moment")  # the largest stands in the middle
    times, own = 0.3 + 1e-3 * steps, 1.0 - 0.02 * np.abs(steps)
    crossing = own - 0.02 * np.sign(steps)  # two of the five instants within 0.002 T* are above, two below
    companions = ((crossing, 1.0, 0.0, 0.02 * 0.8**0.5), (own + 0.05, 1.05, 0.0, 0.05), (own, 1.0, 0.4, 0.0))
    for other, largest, later, changed in companions:
        both = [
            read | dict.fromkeys(same, moment) | {"peak_moment_time": time[8], "moment_around": [time, curve]}
            for moment, time, curve in ((1.0, times, own), (largest, times + later, other))
        ]
        assert [whole_numbers(whole(*both))[name].bar for name in same] == pytest.approx([FACTOR * changed] * 2)


@pytest.mark.parametrize("band", [None, (2, 0)])
def test_a_single_run_that_ends_at_the_wall_is_told_with_the_numbers_that_it_enters(band) -> None:
    made = whole(*(whole_reading(pushed_until(end)) for end in (0.5, 9.0)), damping=0.0 if band else 1e-3, band=band)
    found = bounced(made)
    assert found.outcome.left and not found.left and found.to_dict()["left"] is False
    assert any("not left the wall" in warning for warning in found.warnings)
    slow = Impact(1.0, 1e6, 2.0, 2.0, 1e-3, damping=0.0 if band else 1.0, acceleration=1e-6)  # T* is 1000 s
    slow = slow.replace(wall_stiffness=1e6)  # which would throw it off in some 15 s
    held = Bounce(case_of(slow), found.numbers, dataclasses.replace(made, question=Question(slow, COARSE, band=band)))
    assert any(f"flights shorter than {1e3 / first_mode(slow):.3g} ms" in warning for warning in held.warnings)
    gone = ("restitution", "impulse", "last_contact")  # of the hit, which is not over
    assert [found.numbers[name].value for name in gone] == [None] * 3 and found.numbers["push"] != Number()
    for periods, none in ((1.1, False), (0.9, True)):  # in the last period of the lowest mode it may still rise
        late = {"peak_moment_time": 9.0 - periods / first_mode(problem(2.0, 1e-3))}
        still = whole_numbers(made.part(lambda one, late=late: one | {"until": 9.0} | late))  # type: ignore[misc]
        assert (still["peak_moment"] == Number()) is none


def test_a_beam_that_leaves_slowly_may_touch_again_where_twice_the_bar_of_its_velocity_brings_it_to_the_wall() -> None:
    """It misses the wall by 0.05 V₀ at 1 T*, by 0.08 V₀ at 1.5 T*; its restitution has bars of 0.0125, 0.0375, 0.05."""
    for change, later in ((0.01, 0.0), (0.03, 0.2), (0.04, 0.7)):
        one = whole_reading(pushed_until(0.3, again=0.5)) | {"returns": ((1.0, 0.05), (1.5, 0.08))}
        other = one | {"restitution": one["restitution"] + change}
        assert last_contact(one, other).parts["returns"] == pytest.approx(later, abs=0.03)
    assert last_contact(one, other, left_end="hinged").parts["returns"] == 0.0  # nothing is told of its other points


def test_the_last_part_of_a_contact_may_be_none_where_it_changes_the_velocity_by_less_than_two_bars() -> None:
    """Pushed with 5.8 μℓV₀ a T* for 0.3 T*, and for as long from 0.5 T* on: 2.9 times 0.3 of V₀."""
    one = whole_reading(pushed_until(0.3, again=0.5))
    assert one["last_push"] == pytest.approx(2.9 * 0.3)
    for push, earlier in ((0.09, 0.5), (0.11, 0.0)):
        grazes = one | {"last_push": push}
        other = grazes | {"restitution": one["restitution"] + 0.04}  # its bar is 0.05
        assert last_contact(grazes, other).parts["graze"] == pytest.approx(earlier, abs=0.03)


def test_bars_over_a_tenth_of_a_number_are_wide_and_a_small_restitution_counts_as_more() -> None:
    assert not wide_bars({"restitution": Number(0.1, 0.02), "peak_moment": Number(1.0, 0.05)})
    limit = SimpleNamespace(yield_stress=2.4e8)
    reaches, below = ({"peak_stress": Number(value, 1e7)} for value in (2.35e8, 2.2e8))
    assert "may be beyond the yield stress of 240 MPa" in told_by(reaches, limit)[0] and not told_by(below, limit)
    assert "may be beyond" in told_by({"peak_stress": Band(2.3e8, 3e7, 24)}, limit)[0]
    assert not wide_bars({"impulse": Band(1.0, 1.0, 24), "peak_force": Number(), "half_contact_length": Number(1.0)})
    assert not wide_bars({"half_contact_length": Number(0.0, 0.01)})  # one point, within an element
    wide = {"restitution": Number(0.1, 0.04), "impulse": Number(-0.01, 0.002)}
    (said,) = wide_bars(wide | {"peak_moment": Number(1.0, 0.0)})
    assert "restitution" in said and "impulse" in said and "moment" not in said


def test_what_is_missing_of_the_energy_without_being_booked_counts_as_lost() -> None:
    booked = ENERGY | {"loss_viscous": 0.015}
    assert numerical_loss(booked | {"defect": -0.01}) == pytest.approx(0.025)
    assert numerical_loss(booked | {"defect": 0.01}) == pytest.approx(0.015)  # too much of it is no loss
    twice = {name: 2.0 * (value or 0.0) for name, value in (booked | {"defect": -0.01}).items()}
    assert numerical_loss(twice) == pytest.approx(0.025)
    assert "took 2.5 % of" in loss_warnings(booked | {"defect": -0.01})[0] and not loss_warnings(booked)
    assert "gave 3 % of" in loss_warnings(booked | {"loss_algorithmic": -0.03, "loss_viscous": 0.0})[0]
    assert energy_residual(ENERGY | {"defect": -0.01, "work_of_loads": -1.0}) == pytest.approx(0.005)


def test_a_straight_beam_that_its_wall_presses_evenly_has_no_moment_of_round_off() -> None:
    beam = Impact(1e8, 1e8, 2.0, 0.0, 1.0, wall_stiffness=9e8)
    run = HermiteFE(mesh=UniformMesh(0.2)).simulate(beam, end_time=0.2, save=20)
    assert 0.0 < peak_moment(run).moment < 1e-4 and instants_reading((0.1, 0.2), False, run)["peak_moment"] == 0.0


def test_a_document_holds_the_damping_of_its_beam_and_what_the_budget_leaves_and_the_text_all_that_it_holds() -> None:
    read = whole_reading(pushed_until(0.5))
    read["energy"] = dict.fromkeys(read["energy"], 0.0) | {"initial": 3.0, "work_of_loads": -1.0, "defect": -0.2}
    document = bounced(whole(read, read, damping=3e-3)).to_dict()
    assert document["damping"] == pytest.approx(3e-3)
    assert document["energy_residual"] == document["energy_defect"] == pytest.approx(0.05)
    state = {"momentum_residual": 1e-3, "energy_of_state": 2e-3, "gap_of_push": 3e-3, "penetration": 4e-3, "pull": 5e-3}
    loss = {"loss": 0.2, "lowest_frequency": 10.0, "highest_frequency": 200.0, "deviation": 0.03}
    document |= state | {"hysteretic_loss": loss, "span": [0.0, 0.05], "si": document["si"] | {"time_unit": 0.03}}
    said = bounce_text(document, verbose=True)
    for part in ("from 0 to 50 ms", "momentum off by 0.001 of the impulse, energy by 0.002 at", "a push 0.003 V0 t",
                 "deepest node 0.004 V0 t, largest pull 0.005 of", "hysteretic loss 0.2 within 3 % from 10 to 200 Hz",
                 "T* = 0.03 s", "at least 0.002 T* (6e-05 s)"):  # fmt: skip
        assert part in said
