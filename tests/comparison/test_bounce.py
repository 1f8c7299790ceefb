"""A bounce: error bars from other elements, steps and contact laws; without damping a band; the command."""

import dataclasses
import json
import math
import pickle

import numpy as np
import pytest
from called import answered, refused
from histories import rod
from scipy.integrate import solve_ivp

from bent_beam import Impact, ImpactHistory, load_case
from bent_beam.measure.numbers import Band, Number
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.meshes import GradedMesh, NodesMesh, UniformMesh
from bent_beam.method import LONGEST_OF_WALL, simulate_to_separation, time_on_wall
from comparison.bouncing import bounce, follow_hits, problem
from comparison.questions import Question
from comparison.store import RunStore
from comparison.texts import run_text
from exudyn_models import ExudynModel
from exudyn_models.integrators import Trapezoidal
from hermite_fe import HermiteFE
from hermite_fe.contacts import MiddleContact, NodeContact
from hermite_fe.integrators import Midpoint, MoreauJean, SignoriniPosition

COARSE = HermiteFE(mesh=UniformMesh(1.0 / 25))


@pytest.mark.parametrize(("path", "elements", "widest"), [(HermiteFE, 25, 0.02), (ExudynModel, 20, 0.03)])
def test_error_bars_of_a_bounce_hold_the_converged_value(path, elements, widest) -> None:
    found = bounce(problem(0.5, 1e-2), path(mesh=UniformMesh(1.0 / elements)), save=500, store=RunStore(None))
    assert found.history is found.runs.history, "a store that keeps nothing costs no second run"
    restitution = found.numbers["restitution"]
    assert set(restitution.parts) == {*found.runs.companions, "saved_instants"}
    assert restitution.bar == sum(restitution.parts.values())
    assert abs(restitution.value - 0.33636) <= restitution.bar < widest
    unsure = dataclasses.replace(found, numbers=found.numbers | {"last_contact": Number(0.5, 0.6)})
    (said,) = set(unsure.warnings) - set(found.warnings)
    assert "whether the beam touches the wall once more" in said and f"--set {path.path}.refine=2" in said


@pytest.mark.parametrize(("path", "scheme"), [(HermiteFE, MoreauJean), (ExudynModel, Trapezoidal)])
def test_a_step_that_follows_no_mode_and_elements_that_bend_like_none_are_refused(path, scheme) -> None:
    """Whatever makes them so; metres for millimetres are one element, and the companion, with half as many, the run."""
    step = rf"^{path.path}.integrator.time_step must be at most 0.05 s .* \(got 0.06\)"
    for method in (path(integrator=scheme(time_step=0.06)), path(integrator=scheme(time_step=0.006), refine=0.1)):
        with pytest.raises(ValueError, match=step):
            bounce(problem(0.5, 1e-2), method)
    for mesh in (UniformMesh(0.34), UniformMesh(20.0), NodesMesh((0.0, 0.3, 0.6, 1.0)), GradedMesh(50.0)):
        with pytest.raises(ValueError, match=rf"^{path.path}.mesh has [23] elements in a half beam of 1 m, and 4 are"):
            bounce(problem(0.5, 1e-2), path(mesh=mesh))
    with pytest.raises(ValueError, match=r"exudyn.integrator.flight_step must be at most 0.05 s"):
        bounce(problem(0.5, 1e-2), ExudynModel(integrator=Trapezoidal(time_step=1e-3, flight_step=0.2)))


def test_a_bounce_off_a_wall_that_gives_way_has_its_largest_force_and_is_faster_than_off_a_rigid_one() -> None:
    found = bounce(problem(0.5, 1e-2).replace(wall_stiffness=1e3), HermiteFE(mesh=UniformMesh(0.1)), save=500)
    assert set(found.numbers["peak_force"].parts) == {"mesh_and_step", "sharp"}
    assert found.numbers["peak_force"].bar < 0.02
    assert found.numbers["restitution"].known > 0.34  # more than off a rigid wall, whose impacts lose 1 − e²
    budget = found.history.energy_budget()
    assert budget["contact_energy"] == budget["loss_impact"] == 0.0 < budget["loss_material"]
    said = " ".join(str(found).split())
    assert f"energy dissipated {found.numbers['dissipated'].scaled(100.0)} %" in said
    assert "largest force on the wall" in said and "largest impulse within" not in said


def test_without_damping_a_soft_wall_leaves_numbers_and_a_stiff_one_a_band() -> None:
    coarse = HermiteFE(mesh=UniformMesh(0.1), integrator=Midpoint(5e-4, 0.0))
    soft, stiff = (problem(0.5, 0.0).replace(wall_stiffness=0.05**-4 * share) for share in (0.99, 1.01))
    found = bounce(soft, coarse)
    assert {"mesh_and_step", "finer"} <= set(found.numbers["impulse"].parts) and found.runs.question.band is None
    assert not any("irregular" in line for line in found.warnings)
    assert isinstance(bounce(stiff, coarse, runs=2).numbers["impulse"], Band)
    for path in (HermiteFE, ExudynModel):  # an ensemble of their own states no contact, which such a wall refuses
        assert path().varied(stiff, np.random.default_rng(1)).contact is None


def test_a_beam_that_turns_off_the_edge_of_a_plate_may_come_back() -> None:
    middle, beside = {"wall_from": -0.1, "wall_to": 0.1}, {"wall_from": 0.3, "wall_to": 0.9}
    pulled = {"axial_force": 0.5, "tension_direction": "tangent"}  # it turns nothing
    for change, told in ((middle, False), (beside, True), (pulled, False)):
        found = bounce(problem(0.5, 1e-2).replace(**change), HermiteFE(mesh=UniformMesh(0.1)))
        assert found.left and told == any(line.startswith("the beam may come back") for line in found.warnings)


def test_a_force_that_jumps_as_tips_slap_on_dashpots_is_no_surer_than_its_steps() -> None:
    slap = problem(0.4, 1e-3).replace(wall_stiffness=100.0, wall_damping=120.0)
    found = bounce(slap, COARSE).numbers["peak_force"]
    finer = whole_impact(simulate_to_separation(COARSE.refined(4.0), slap)).peak_force
    without = found.spread - found.parts["sharp"]
    assert without < abs(found.known - finer) <= found.spread and found.parts["sharp"] > 0.01 * found.known


def test_without_damping_a_seeded_band_takes_the_place_of_a_number(monkeypatch) -> None:
    monkeypatch.setattr("hermite_fe.whole_beam.ELEMENTS", 50)
    told: list[float] = []
    impact = problem(2.0, 0.0)
    found = bounce(impact, COARSE, runs=2, save=500, seed=3, progress=told.append)
    band = found.numbers["restitution"]
    assert isinstance(band, Band) and band.mean == pytest.approx(0.6, abs=0.1) and band.runs == 2
    assert any("no damping" in warning and "band" in warning for warning in found.warnings)
    assert told == sorted(told) and told[-1] == 1.0  # complete when all runs are
    document = found.to_dict()
    stated = {"mean": band.mean, "std": band.std, "runs": 2}
    assert document["seed"] == 3 and document["restitution"] == {"value": None, "error": None, "band": stated}
    first, again, other = (Question(impact, HermiteFE(), band=(3, seed)).companions() for seed in (3, 3, 4))
    assert first == again != other
    some = [COARSE.varied(impact, np.random.default_rng(seed)) for seed in range(20)]
    assert all(16 <= round(1.0 / one.mesh.element_length) <= 80 for one in some)
    steps = [one.integrator.time_step / one.mesh.element_length**2 for one in some]  # Δx²√(μ/EI)
    assert 0.5 <= min(steps) < 0.7 and 1.4 < max(steps) <= 2.0


@pytest.mark.parametrize("path", ["hermite", "exudyn"])
def test_a_run_until_separation_ends_off_the_wall_on_either_path(path, tmp_path) -> None:
    asked = ("simulate", rod(tmp_path, element=0.1), "--path", path, "--error-bars", "drift")
    kept = tmp_path / "run.nc"
    found = answered(*asked, "--until", "separation", "--out", kept)
    history = ImpactHistory.load(kept)
    assert history.array("gap")[-1].min() > 0.0 and found["hits"] is None
    assert found["time"] == history.time[-1] < 3.0 * history.impact.slow_time_scale
    assert abs(found["energy"]["defect"]) < 1e-5 * found["energy"]["initial"]
    last = whole_impact(history).last_contact * history.impact.slow_time_scale
    assert found["last_contact"]["value"] == pytest.approx(last)
    assert "half contact length (off the wall)" in run_text(found) and f"{1e3 * last:.3g}" in run_text(found)
    largest = np.argmax(np.abs(history.array("largest_moment")))
    assert found["peak_moment_time"] == pytest.approx(history.time[largest], rel=0.02)
    for kind in ("kinetic", "strain"):
        assert found["energy"][kind] == pytest.approx(history.array(f"{kind}_energy")[-1])
    if path == "hermite":  # its weight brings it back, however light it is
        light = ("section.density=7.85", "section.youngs_modulus=2.1e8", "impact.gravity=20.0", "run.end_time=0.09")
        first, second = answered(*asked, *(word for one in light for word in ("--set", one)))["hits"]
        assert {first["wall"], second["wall"]} == {"front"}
        assert second["before"] == pytest.approx(-first["after"], rel=0.02)
    rod(tmp_path, "[wall]\nopposite = 0.01", element=0.1)  # the same file
    found = answered(*asked, "--set", "run.end_time=0.04", "--save", "1000")
    assert [hit["wall"] for hit in found["hits"][:2]] == ["front", "opposite"]
    assert all(hit["impulse"] > 0.0 and hit["lost"] > 0.0 for hit in found["hits"][:2])
    assert "wall.opposite" in refused(*asked, "--until", "separation")  # no separation is the last


def test_the_command_gives_numbers_with_bars_figures_and_the_stress_of_the_largest_moment(tmp_path, monkeypatch):
    monkeypatch.setattr("comparison.figures.history.FRAMES", 2)
    out = tmp_path / "out"
    words = ("--set", "impact.velocity=2.0", "--path", "hermite", "--path", "exudyn", "--hits", 3, "--out", out)
    found = answered("bounce", rod(tmp_path, element=0.1), *words)
    assert {file.name for file in out.iterdir()} == {"bounce.json", "bounce.png", "bounce.gif"}
    assert [one["path"] for one in found["paths"]] == ["hermite", "exudyn"]
    assert json.loads((out / "bounce.json").read_text()) == {n: v for n, v in found.items() if n != "files"}
    assert 0.0 < found["restitution"]["value"] < 1.0 and found["left"]
    assert len(found["hits"]) == 1 and found["warnings"][-1].startswith("1 of 3 hits: then the beam is off for good")
    longest = 1e3 * LONGEST_OF_WALL * load_case(tmp_path / "rod.toml").impact.slow_time_scale
    assert found["warnings"][-1].endswith(f"for good or is not back by {longest:.3g} ms")
    momentum, modulus = 7850.0 * math.pi * 0.01**2 * 2.0, math.pi * 0.02**3 / 32.0
    impulse, restitution = found["si"]["impulse"]["value"], found["restitution"]["value"]
    assert impulse == pytest.approx(momentum * (1.0 + restitution), rel=1e-6)
    for key in ("value", "error"):
        assert found["peak_stress"][key] == pytest.approx(found["si"]["peak_moment"][key] / modulus, rel=1e-12)


def test_the_runs_of_a_band_are_coarser_of_many_sizes_and_of_the_contact_and_integrator_that_are_stated() -> None:
    contact = {"contact": MiddleContact()}
    for stated in (contact, contact | {"integrator": SignoriniPosition()}):
        every = Question(problem(2.0, 0.0), HermiteFE(**stated), band=(20, 1)).companions().values()
        kinds, finer = [(type(one.contact), type(one.integrator)) for _, one in every], [one.refine for _, one in every]
        assert kinds == 19 * [(MiddleContact, SignoriniPosition)], stated
        assert 2.0**-1.5 < min(finer) < 0.42 and 0.6 < max(finer) < 2.0**-0.5, stated


def test_the_companion_that_absorbs_no_waves_has_ten_elements_in_the_root_of_time() -> None:
    """It is run of hardly any damping, η < 3e-5 T*, from 1e-5 T* on, and until waves have run: 3e-3 T*."""
    _, other = Question(problem(0.5, 0.0), HermiteFE(), 1e-4).companions()["waves_absorbed"]
    assert other.mesh.element_length == pytest.approx(0.1 * 1e-4**0.5)
    asked = ((2.9e-5, 1.1e-5), (2.9e-5, 2.9e-3), (3.1e-5, 1e-4), (2.9e-5, 0.9e-5), (2.9e-5, 3.1e-3))
    found = [Question(problem(0.5, damping), HermiteFE(), until).companions() for damping, until in asked]
    assert ["waves_absorbed" in one for one in found] == [True, True, False, False, False]


def test_the_companion_of_nodes_that_rebound_has_nodes_that_do_not() -> None:
    rebounding = dataclasses.replace(COARSE, integrator=MoreauJean(theta=0.5), contact=NodeContact(restitution=0.5))
    others = rebounding.cross_checks(problem(0.5, 1e-3)).values()
    assert [other.contact for other in others] == [NodeContact(restitution=0.0)] * 2


@pytest.mark.parametrize(("share", "times"), [(0.4, 1), (0.1, 2 ** (2 / 3)), (0.04, 2), (0.01, 10**0.5), (0.005, 4)])
def test_the_sooner_a_run_ends_the_finer_are_its_elements(share, times) -> None:
    whole = Question(Impact(1.0, 1e6, 2.0, 2.0, 1e-3, damping=10.0), HermiteFE())  # T* is 1000 s
    early = dataclasses.replace(whole, until=share * whole.impact.slow_time_scale)
    assert whole.run_by.mesh.element_length / early.run_by.mesh.element_length == pytest.approx(times)


def test_runs_whose_processes_die_are_told_and_one_that_is_left_is_no_band(monkeypatch) -> None:
    def all_die(function, calls, *, jobs, on_death, **_):
        assert jobs == 2 and pickle.loads(pickle.dumps((function, calls))) == (function, calls), "as they go there"
        return [on_death(number, "the worker died") for number in range(len(calls))]

    monkeypatch.setattr("comparison.runs.run_all", all_die)
    found = bounce(problem(2.0, 0.0), HermiteFE(mesh=UniformMesh(0.1)), runs=3, jobs=2)
    assert sum(line.startswith("no companion run") and "the worker died" in line for line in found.warnings) == 2
    assert found.numbers["restitution"].value is None


def test_a_damping_that_is_not_stated_is_answered_over_three_and_one_that_is_stated_once(tmp_path) -> None:
    """The numbers are those of the largest stress; what companions say at any is passed on, and their seconds count."""
    told: list[float] = []
    file = rod(tmp_path, element=0.1)
    file.write_text(file.read_text().replace("damping_ratio", "# damping_ratio"))
    unstated, stated = load_case(file), load_case(file, ["beam.damping_ratio=0.002"])
    found = bounce(unstated, unstated.method("hermite"), store=RunStore(tmp_path), progress=told.append)
    rows, once = found.over_damping or [], bounce(stated, stated.method("hermite")).to_dict()
    assert [row["damping_ratio"] for row in rows] == [0.0002, 0.002, 0.02]
    assert found.in_si["peak_stress"].known == max(row["peak_stress"]["value"] for row in rows)
    assert [found.in_si[name].unit for name in ("restitution", "peak_moment", "peak_stress")] == ["", "N m", "Pa"]
    assert any("no damping is stated" in line and "0.02, 0.2, 2 % of the" in line for line in found.warnings)
    assert once["over_damping"] is None and once["restitution"] == rows[1]["restitution"]
    assert told == sorted(told) and told[-1] == pytest.approx(1.0)
    assert len([share for share in told if 0.0 < share < 0.1]) > 3  # within a run, and one that is kept
    assert found.seconds == pytest.approx(sum(one.runs.seconds for one in found.over.values()))
    lost = dataclasses.replace(found, runs=dataclasses.replace(found.runs, lost=["no companion run"]))
    told = dataclasses.replace(found, over={**found.over, 0.5: lost}).warnings
    assert any(line.startswith("50 %: no companion run") for line in told)


@pytest.mark.parametrize(("velocity", "weight", "zeta"), [(2.0, 0.5, 0.2), (1.0, 1.2, 0.0)])
def test_a_straight_bar_on_a_soft_wall_leaves_as_a_mass_on_a_spring_does(velocity, weight, zeta) -> None:
    """ẍ = g − ω²x − 2ζωẋ while that pushes: nothing vibrates, and what is left is ½ẋ² of ½V₀² + gx."""
    omega = 8.0
    bar = Impact(1.0, 1.0, 2.0, 0.0, velocity, damping=1e-2, acceleration=weight)
    found = bounce(bar.replace(wall_stiffness=omega**2, wall_damping=2.0 * zeta * omega), COARSE)

    def push(_, state):
        return omega**2 * state[0] + 2.0 * zeta * omega * state[1]

    push.terminal, push.direction = True, -1.0  # type: ignore[attr-defined]
    start, accuracy = (0.0, velocity), {"rtol": 1e-10, "atol": 1e-12}
    x, v = solve_ivp(lambda t, s: (s[1], weight - push(t, s)), (0.0, 9.0), start, events=push, **accuracy).y[:, -1]
    left = 0.5 * v**2 / (0.5 * velocity**2 + weight * x)
    wanted = {"translation": left, "vibration": 0.0, "dissipated": 1.0 - left, "restitution": -v / velocity}
    for name, exact in wanted.items():
        number = found.numbers[name]
        assert abs(number.known - exact) <= number.bar < 0.01, (name, exact, number)


def test_a_softer_wall_pushes_for_half_a_period_however_long_and_a_force_that_still_rises_is_no_largest() -> None:
    """π√(m/k) and V₀√(km) of a straight bar; the second wall would not throw it off in 100 T*."""
    bar = Impact(1.0, 1.0, 2.0, 0.0, 1.0, damping=1e-2)
    bowed = bar.replace(curvature=1e3, wall_stiffness=0.05)  # longer in it than a straight bar, as Hertz has it
    few = HermiteFE(mesh=UniformMesh(0.1))
    soft = bounce(bar.replace(wall_stiffness=0.03), few, save=500)
    quick = HermiteFE(mesh=UniformMesh(0.1), integrator=Midpoint(0.05, 0.0))
    softer, leaving = (bounce(one, quick) for one in (bar.replace(wall_stiffness=1e-4), bowed))
    assert soft.numbers["last_contact"].known == pytest.approx(math.pi / math.sqrt(0.03), rel=1e-3)
    assert soft.numbers["peak_force"].known == pytest.approx(2.0 * math.sqrt(0.03), rel=1e-4)
    assert len(follow_hits(soft.impact, few, 2, first=soft.history)) == 1, "longer than ten periods"
    assert leaving.left and leaving.numbers["last_contact"].known == pytest.approx(time_on_wall(bowed), rel=0.02)
    assert not softer.numbers["peak_force"].measured and not softer.numbers["restitution"].measured
    assert any("no largest force on the wall: it still rises" in warning for warning in softer.warnings)
    assert softer.to_dict()["peak_force_time"] is None
