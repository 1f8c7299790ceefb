"""One question, one answer: whichever door is asked, the same number with the same bar, to the last digit."""

import json
import random
import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from here import CASES
from histories import history_of

from bent_beam import Impact, ImpactHistory
from bent_beam.cases import Case, load_case, read_toml
from bent_beam.hysteresis import first_mode
from bent_beam.measure.force_map import force_map
from bent_beam.meshes import UniformMesh
from bent_beam.versions import versions
from comparison import bounce, match, predict
from comparison.bouncing import case_of
from comparison.compare import compare_histories, comparison_text, rerun_history, rerun_text
from comparison.doors import Swept
from comparison.predicting import predict_case
from comparison.readable import milliseconds, readable, unit_for
from comparison.simulating import simulate_case
from comparison.store import RunStore
from comparison.sweeping import Row
from comparison.texts import run_text
from comparison.whole_numbers import HIT
from hermite_fe import HermiteFE
from theory import contact_parameters

SEED = 20261123


def drawn(uniform, kind: int, *laid_over: str) -> Case:
    """A tube before a rigid wall, an elastic one, under tension, or an elastic bow that falls; any damping."""
    said = {"beam.length": uniform(1.0, 5.0), "beam.sagitta": 10.0 ** uniform(-3.5, -2.0), "impact.gravity": 0.0}
    said |= {"beam.damping_ratio": 10.0 ** uniform(-2.5, -1.0), "impact.velocity": 10.0 ** uniform(-0.7, 0.5)}
    said |= {"wall.stiffness": 10.0 ** uniform(6.0, 8.0), "wall.damping_ratio": uniform(0.0, 0.7)} if kind == 1 else {}
    said |= {"beam.axial_force": uniform(100.0, 2000.0)} if kind == 2 else {}
    said |= {"beam.natural_curvature": 0.0, "impact.gravity": 9.81} if kind == 3 else {}
    return load_case(CASES / "tube.toml", [*(f"{key}={value!r}" for key, value in said.items()), *laid_over])


def same(one, other) -> bool:
    return (one["value"], one["error"]) == (other["value"], other["error"])


def test_every_door_says_that_the_beam_yields_and_that_a_late_number_is_of_a_beam_whose_damping_nobody_stated() -> None:
    """And what is doubtful of the case itself. One run without damping has no number of the whole impact: it is a band,
    which ``bounce`` gives. A late r₀ stands beside its theory, however slight the bow."""
    pulled = ["hermite.mesh.kind=uniform", "hermite.mesh.element_length=0.15", "beam.axial_force=1.0"]
    stated = load_case(CASES / "tube.toml", pulled)
    bare = replace(stated, impact=stated.impact.replace(damping=0.0), damping_stated=False)
    time = 0.5 * stated.impact.slow_time_scale
    for case, none in ((stated, False), (bare, True)):
        late, whole = (simulate_case(case, "hermite", until=until) for until in (time, None))
        assert late.to_dict()["r0"]["theory"] == contact_parameters(case.impact.kappa_over_nu).r0
        assert (whole.to_dict()["restitution"]["value"] is None) is (whole.to_dict()["peak_moment"] is None) is none
        for limit, yields in ((2e7, True), (2e8, False), (None, None)):
            case = replace(case, section=replace(case.section, yield_stress=limit))
            known = predict_case(case, [time], whole=False, store=RunStore.usual()).to_dict()
            assert known["yields"] is yields
            told = [known["warnings"], replace(late, case=case).to_dict()["warnings"]]
            if not none:
                whole = replace(whole, case=case, whole=replace(whole.whole, case=case))
                told += [bounce(case).warnings, whole.to_dict()["warnings"]]
            for lines in told:
                assert any("beyond the yield stress of 20 MPa" in line for line in lines) is (yields is True)
                assert any("those of a beam without any" in line for line in lines) is none
                assert any("stresses include |N|/A" in line for line in lines)
        warnings = whole.to_dict()["warnings"]
        assert any("at three damping ratios" in line for line in warnings) is none
        assert none or any("bring the beam back" in line for line in warnings)


def check(case: Case, share: float) -> None:
    """At a share of T*, and of the whole impact."""
    time = share * case.impact.slow_time_scale
    predicted, whole = predict(case, time).to_dict(), bounce(case).to_dict()
    run = simulate_case(case, "hermite", until=time)
    at, simulated = predicted["times"][0]["simulation"], run.to_dict()
    largest = np.argmax(run.history.array("largest_moment"))  # or one saved interval before it
    assert simulated["peak_moment_time"] == pytest.approx(run.history.time[largest], rel=0.1)
    for name, theirs in (("half_contact_length", "half_contact_length"), ("impulse", "total_impulse")):
        assert same(at[name], simulated[theirs])
    for name in ("peak_moment", "peak_stress"):
        assert (at[name]["value"], at[name]["error"]) == (simulated[name], simulated[f"{name}_error"])
    separated, predicted = simulate_case(case, "hermite", until=None), predicted["whole_impact"]
    assert same(predicted["restitution"], separated.to_dict()["restitution"])
    assert all(same(predicted[name], whole[name]) for name in ("restitution", "peak_stress"))
    assert all(same(predicted[name], whole["si"][name]) for name in ("peak_moment", "last_contact"))
    moved = separated.runs.part(lambda one: one | {"whole": one["whole"] | {"peak_moment_place": 0.5}})
    assert replace(separated, runs=moved).to_dict()["peak_moment_place"] == 0.5 * case.impact.half_length
    assert separated.numbers["peak_moment"].known == whole["peak_moment"]["value"] * case.impact.moment_scale
    assert predicted["span"] == whole["span"] and whole["span"][1] > whole["si"]["last_contact"]["value"]
    force = whole["si"].get("peak_force")  # none of a rigid wall
    assert predicted["peak_force"] is force is None or same(predicted["peak_force"], force)


def test_every_door_gives_the_same_number_with_the_same_bar() -> None:
    uniform = random.Random(SEED).uniform
    _, elastic, pulled = (drawn(uniform, kind, "hermite.refine=0.125") for kind in range(3))
    check(elastic, 0.02)
    check(pulled, 0.002)


def apart(one: ImpactHistory, other: ImpactHistory, name: str = "gap") -> float | None:
    return compare_histories(one, other)["largest_difference"][name]


def test_gaps_are_compared_wherever_both_runs_have_the_beam_at_the_end_of_their_common_time() -> None:
    """They differ by 0.3 V₀t at one place, being linear between nodes and between saved instants."""
    time, coarse, fine = np.linspace(0.0, 2.0, 3), np.linspace(0.0, 1.0, 6), np.linspace(0.0, 1.0, 11)
    at = partial(history_of, impact=Impact.whole_beam(0.5).replace(velocity=2.0))
    for place in (0.0, 0.4, 1.0):
        one = at(time, coarse, gap=np.outer(time, np.where(coarse == place, 0.6, 0.0)))
        assert apart(one, at(time, fine)) == pytest.approx(0.3)
    instants = [0.0, 0.7, 1.0], [0.0, 0.4, 1.2, 1.6]
    late = [at(times, fine, gap=np.outer(np.fmax(times, 0.4), 1.0 + fine)) for times in instants]
    assert apart(*late) == pytest.approx(0.0, abs=1e-12)  # linear from the instant before, not from an earlier one
    x = np.linspace(0.0, 1.0, 16)  # a gap of x³ is one cubic
    curved = Impact.whole_beam(0.5).replace(wall_curvature=0.4, first_touch=0.2)
    runs = [history_of([0.0, 1.0], x, impact=curved, gap=np.outer([0.0, 1.0], x**3),
                       slope=np.outer([1.0, 1.0], -3.0 * x**2 - 0.4 * (x - 0.2))) for x in (x, coarse)]  # fmt: skip
    assert apart(*runs) == pytest.approx(0.0, abs=1e-12)


def test_runs_without_a_time_in_common_are_not_compared() -> None:
    one, other = (history_of(time, [0.0, 1.0]) for time in ([0.0, 0.1], [0.5, 1.0]))
    for pair in ((one, other), (other, one)):
        with pytest.raises(ValueError, match=r"no time in common: one ends at 0.1 s, one begins at 0.5 s"):
            compare_histories(*pair)
    around, within = (history_of(time, [0.0, 0.5, 1.0]) for time in ([0.0, 1.0], [0.2, 0.8]))
    assert compare_histories(around, within)["end"]["time"] == [1.0, 0.8]


def test_of_two_runs_of_the_whole_beam_both_halves_are_compared_and_drawn() -> None:
    time, x = np.array([0.0, 1.0, 2.0]), np.linspace(-1.0, 1.0, 5)  # gaps are told over V₀t
    full = partial(history_of, symmetry="full")
    impulse = np.outer(time, [1.0, 0.0, 0.0, 0.0, 1.0])
    runs = [full(time, x, impulse=impulse, gap=np.outer(time, gap)) for gap in (x - 1.0, x + 1.0)]
    assert apart(*runs) == pytest.approx(2.0)
    mirrored = [full(time, x, gap=np.outer(time, np.minimum(0.0, side * x))) for side in (0.0, 1.0)]
    assert apart(*mirrored) == pytest.approx(1.0)  # on the left alone
    early, late = (full(times, x, total_impulse=times) for times in (time, time[1:]))
    assert apart(early, late, "total_impulse") == pytest.approx(0.0)  # where both are
    pushed = full(np.array([0.0, 1.0, 1.4]), x, total_impulse=np.array([0.0, 0.0, 0.4]))  # after the other's end
    for pair in ((pushed, free := full(time[:2], x)), (free, pushed)):
        found = compare_histories(*pair)
        assert found["end"]["total_impulse"] == [0.0, 0.0] and found["largest_difference"]["total_impulse"] is None
    energies = [full(time, part * x, kinetic_energy=part * (2.0 - time)) for part in (1.0, 0.5)]
    assert apart(*energies, "kinetic_energy") is None  # of unlike parts of a beam
    half = history_of(time, x[2:], kinetic_energy=2.0 - time)
    assert apart(half, energies[0], "kinetic_energy") == pytest.approx(0.0)
    small = [full(time, x, total_impulse=share * time) for share in (1e-3, 2e-3)]
    assert apart(*small, "total_impulse") == pytest.approx(1.0)
    edges = np.linspace(-1.0, 1.0, 5) / runs[0].impact.length_scale
    pushed = force_map(runs[0], np.array([0, 2]), edges)[0]
    assert pushed[0] == pytest.approx(pushed[-1]) and pushed[0] > 0.0


def test_times_and_places_that_have_moved_are_a_difference_of_a_run_that_is_repeated() -> None:
    dataset = HermiteFE(mesh=UniformMesh(0.1)).simulate(Impact.whole_beam(0.5), end_time=0.01, save=8).dataset
    found = rerun_history(ImpactHistory.of(dataset))
    assert found["identical"] and found["versions_changed"] == {}
    before = json.dumps(versions() | {"numpy": "1.0"})
    found = rerun_history(ImpactHistory.of(dataset.assign_attrs(versions=before)))
    assert found["versions_changed"] == {"numpy": ["1.0", versions()["numpy"]]}
    said = " ".join(rerun_text(found).split())
    assert "same, bit for bit" in said and f"numpy 1.0 {versions()['numpy']}" in said
    for moved in ("time", "x", "contact_x"):
        found = rerun_history(ImpactHistory.of(dataset.assign_coords({moved: 1.5 * dataset[moved]})))
        assert not found["identical"] and found["largest_difference"] == {moved: pytest.approx(1.0 / 3.0)}
        assert "run differs" in rerun_text(found) and rerun_text(found).split()[-2:] == [moved, "0.33"]
    found = rerun_history(ImpactHistory.of(dataset.isel(time=[0, 3, -1])))  # fewer than its settings say
    assert set(found["largest_difference"]) == {name for name, one in dataset.variables.items() if "time" in one.dims}
    assert set(found["largest_difference"].values()) == {None}
    assert "gap missing, or of another size" in " ".join(rerun_text(found).split())
    found = rerun_history(ImpactHistory.of(dataset.assign(gap=np.nextafter(dataset["gap"], 1.0))))  # by its last bit
    assert not found["identical"] and 0.0 < found["largest_difference"].pop("gap") < 1e-15
    assert not found["largest_difference"]


def test_what_differs_far_down_or_late_is_told_by_its_full_name_from_where_it_differs() -> None:
    """Texts are shortened: two that begin alike, or end alike too, would look the same."""
    at, half = list(range(20)), 90 * "a"
    meshes = [{"mesh": {"at": nodes}, "save": at[:n]} for nodes, n in ((at, 10), ([*at[:9], 9.5, *at[10:]], 12))]
    pairs = {"far": meshes, "named": [f"{half}one{half}", f"{half}two{half}"], "hold": [None, 2],
             "nested": [[[*range(6)], at], [[*range(5), 7], at]],
             "own": [None, {"step": 1.0 / 3.0}], "last": [[0.1, 0.2], [0.1, 0.2 + 3e-17]]}  # fmt: skip
    slow = Impact.dimensionless(0.5)
    one, other = (history_of([0.0, end], at, impact=slow.replace(velocity=end)) for end in (1.0, 2.0))
    said = " ".join(comparison_text(compare_histories(one, other) | {"settings": pairs}, "A", "B").split())
    for part in ("far.mesh.at[9:] [9, 10, 11, 12, ...] [9.5, 10, 11, 12, ...]", "far.save[10:] [] [10, 11]", "hold - 2",
                 "nested[0][5:] [5] [7]", "named[90:] one", "velocity 1.0 2.0", "own.step - 0.333333",
                 "last[1:][0] 0.2 0.20000000000000004", "of two cases that differ.",
                 "end of the run 1000 2000 ms", "common time, 1000 ms.", "peak moment 0.5 0.5 N m"):  # fmt: skip
        assert part in said
    said = comparison_text(compare_histories(one, one), "A", "B")
    assert "Both runs are of the same case." in said and "what differs" not in said


@pytest.mark.verify
def test_twenty_beams_of_a_seed_are_answered_alike_at_every_door() -> None:
    uniform, shares = random.Random(SEED).uniform, random.Random(SEED + 1)
    for number in range(20):
        check(drawn(uniform, number % 4), 10.0 ** shares.uniform(-3.0, -0.5))


def test_a_wall_that_gives_way_and_is_not_yet_touched_has_no_place_of_its_force() -> None:
    case = load_case(CASES / "tube_between_plates.toml", ["wall.clearance=2e-4", "wall.opposite=2e-4"])
    document = simulate_case(case, "hermite", until=3e-4, error_bars="drift", save=20).to_dict()
    said = run_text(document)
    assert "largest force  " in said and "nan" not in said.lower() and "None" not in said
    assert "It passes its rest position at" in said and "arrives" not in said
    assert "0.3 ms after it passes its rest position" in said and "has not reached its wall, 0.0002 m away" in said
    hit = {"peak_force_wall": "opposite", "peak_force_time": 0.0125, "peak_force_place": 0.25, "numerical_loss": 0.031}
    hit["hits"] = [dict.fromkeys(HIT, 1.0) | {"wall": "opposite"}]
    said = run_text(document | hit | {"time": 0.02})
    assert "moment, until 20 ms" in said and "on the opposite wall, at 12.5 ms and 0.25 m" in said
    assert re.search(r"lost to steps and mesh +3\.1 +% of", said) and "impulse, of the front less the opposite" in said
    assert re.search(r"\nhit +wall .*V before, m/s .*lost, J", said) and "restitution" not in said


def test_a_stop_beside_the_apex_of_a_bow_is_met_later_or_never() -> None:
    """Its times count from the apex, which passes 1 mm before it; gravity of 600 m/s² away from it is too much."""
    away = ["impact.gravity=600.0", "impact.gravity_angle=180.0"]
    for place, load, touched in ((0.5, ["impact.gravity=0.0"], True), (-0.5, away, False)):
        case = load_case(CASES / "tube.toml", [f"wall.from={place}", f"wall.to={place}", *load])
        found = simulate_case(case, "hermite", until=3e-3, error_bars="drift", save=20).to_dict()
        assert "3 ms after its apex passes the line of the wall" in run_text(found)
        assert (found["total_impulse"]["value"] > 0.0, "has not touched" in run_text(found)) == (touched, not touched)


def test_waves_that_are_back_from_the_ends_are_told_from_a_hundredth_of_t_star_on() -> None:
    case = replace(case_of(Impact.whole_beam(2.0, relative_damping=1e-3)), mesh=UniformMesh(0.01))
    runs = [simulate_case(case, "hermite", until=time, error_bars="drift", save=8) for time in (9e-3, 11e-3)]
    told = [[line for line in run.to_dict()["warnings"] if "reflected" in line] for run in runs]
    assert told == [[], ["waves reflected at the beam's ends are back from 0.01 s on"]]
    for run, time in zip(runs, (9e-3, 11e-3)):  # few saved instants hold the time that is asked for
        assert np.abs(run.runs.history.time - [[time], [1.1 * time]]).min(axis=1).max() < 0.01 * time


def test_a_case_may_be_asked_by_its_tables_and_answers_be_written_to_a_folder_by_name(tmp_path) -> None:
    tables = read_toml(CASES / "tube.toml", "case file")
    asked = predict(tables, 1e-4, theory_only=True), predict(CASES / "tube.toml", 1e-4, theory_only=True)
    assert asked[0].to_dict() == asked[1].to_dict()
    assert [row.kappa_over_nu for row in match("self_similar", kappa_over_nu=0.5)] == [0.5]
    swept = Swept("", "hermite", {"impact.velocity": [1.0]}, [Row({"impact.velocity": 1.0}, reason="none")])
    assert all(file.parent == tmp_path for file in swept.write(str(tmp_path)))


def test_energies_in_joules_are_no_surer_than_the_work_of_the_loads_and_a_place_than_its_element() -> None:
    """They are shares of what a load gives until the last contact, which has a bar of its own."""
    case = load_case(CASES / "tube.toml", ["beam.damping_ratio=0.02", "wall.stiffness=2e6", "mesh.element_length=0.1",
                                           "mesh.kind=uniform"])  # fmt: skip
    found = bounce(case)
    supplied, late = found.outcome.supplied, found.outcome.supplied_rate * found.numbers["last_contact"].bar
    power = case.impact.net_load * case.impact.length * case.impact.velocity * case.impact.slow_time_scale
    assert 0.0 < abs(found.outcome.supplied_rate) * supplied < power  # of the weight, slower than it came
    for name in ("translation", "vibration", "dissipated"):
        share, energy = found.numbers[name], found.in_si[name]
        assert energy.bar == pytest.approx(supplied * (share.bar + abs(late) * abs(share.value)))
        assert sum(energy.parts.values()) == pytest.approx(energy.bar)
    assert found.in_si["peak_moment_place"].bar >= 0.1 * (1.0 - 1e-9)
    for name, record in (("impulse", "total_impulse"), ("peak_force", "peak_force")):  # of the run, in SI
        assert found.in_si[name].known == pytest.approx(found.history.array(record)[-1])
    unsure, steps = found.in_si["peak_moment_time"].parts["saved_instants"], np.diff(found.history.time)
    assert unsure == pytest.approx(0.5 * steps.max()), "it lies between two saved instants"
    apart = found.span[1] - found.in_si["last_contact"].known
    bent = case.impact.replace(shear_stiffness=None, rotary_inertia=0.0)
    assert apart == pytest.approx(1.0 / first_mode(bent), rel=1e-3)  # a period of the lowest mode


def test_a_number_is_written_in_the_unit_that_suits_its_size_or_with_a_power_of_ten() -> None:
    written = []
    for size in "9e-3 m, 0.011 m, 110 N/m, 90 N, 500 N s, 1 Pa, 1 s, 1e-3 m/s".split(", "):
        value, unit = size.split(" ", 1)
        scale, name = unit_for(unit, [None, -float(value)])
        written.append(f"{scale * float(value):g} {name}")
    assert written == ["9 mm", "0.011 m", "0.11 kN/m", "90 N", "500 N s", "1e-06 MPa", "1000 ms", "0.001 m/s"]
    assert [milliseconds(time) for time in (0.01234, 1.2, 12.0)] == ["12.3 ms", "1200 ms", "12000 ms"]
    large = {12345.6: "12350", 99_900.0: "99900", 1e5: "10⁵", 1.23e5: "1.23·10⁵"}
    small = {1e-3: "0.001", 9.99e-4: "9.99·10⁻⁴", -1.5e-4: "−1.5·10⁻⁴", 1e-6: "10⁻⁶", -1e-6: "−10⁻⁶"}
    shown = {0.0: "0", None: "–"} | large | small
    assert {value: readable(value) for value in shown} == shown


def test_one_run_saved_at_other_times_and_further_has_the_same_largest_moment():
    """Of a straight beam that bends to y_xx = t²: not 4, at t = 2, nor 0.9929², at a saved instant."""
    x, impact = np.linspace(0.0, 1.0, 11), Impact.dimensionless(0.5).replace(natural_curvature=0.0)
    times = np.linspace(0.0, 1.0, 101), np.linspace(0.0, 2.0, 142)
    slopes = (np.outer(time**2, x) for time in times)
    runs = [history_of(time, x, impact=impact, slope=s, gap=-0.5 * s * x) for time, s in zip(times, slopes)]
    for pair in (runs, runs[::-1]):
        assert compare_histories(*pair)["end"]["peak_moment"] == pytest.approx([1.0, 1.0], abs=1e-3)
