"""``bentbeam predict``: theory beside a simulation of the whole beam, and the whole impact."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from called import answered, command, refused
from here import CASES
from histories import history_of, rod

from bent_beam import Impact
from bent_beam.cases import load_case
from bent_beam.hysteresis import first_mode
from bent_beam.measure.numbers import Number
from bent_beam.meshes import UniformMesh
from comparison import predicting
from comparison.bouncing import case_of
from comparison.doubts import doubts, steep
from comparison.predicting import CHECKED, COMPARED, LATEST, predict_case
from comparison.readable import number_from
from comparison.texts import prediction_text
from hermite_fe import HermiteFE
from theory import predict
from theory.stopped_beam import StoppedBeam

PIPE = CASES / "drill_pipe.toml"
HALF = {"hermite": {"refine": 0.5}}


def agrees(row, name) -> bool:
    """Within the error bar and 2 % of the theory."""
    found = row["simulation"][name]
    return abs(found["value"] - row[name]) <= found["error"] + 0.02 * abs(row[name])


@pytest.mark.parametrize(("kappa", "damping", "load", "rate"), [(0.5, 0.0, 20.0, 0.0), (2.0, 1e-3, 5.0, 1.0)])
def test_theory_and_simulation_agree_before_reflections(kappa, damping, load, rate) -> None:
    told: list[float] = []
    impact = Impact.whole_beam(kappa, relative_damping=damping).replace(acceleration=load, curvature_rate=rate)
    case = replace(case_of(impact), tables=HALF)
    found = predict_case(case, [1e-5, 2e-3, 4e-3], whole=False, progress=told.append).to_dict()
    first, early, late = found["times"]
    assert all(row["valid"] for row in found["times"]) and agrees(first, "impulse")
    assert all(agrees(row, name) for row in (early, late) for name in ("half_contact_length", "impulse"))
    if damping == 0.0:  # waves from the ends swing the force
        assert found["force_until"] < 1e-3 and early["reaction"] is late["reaction"] is None
    else:
        assert agrees(early, "reaction") and agrees(late, "reaction")
    assert found["agreement"]["from"] < 6e-4 and 1.9e-3 < found["agreement"]["until"] <= 4e-3
    assert told == sorted(told) and told[-1] == pytest.approx(1.0)


def test_they_agree_as_long_as_the_theory_is_within_2_percent_of_the_stopped_beam_whatever_else_is_asked() -> None:
    impact, times = Impact.whole_beam(2.0, relative_damping=1e-3), np.geomspace(6.9e-4, 0.069, CHECKED)
    theory = [row.impulse for row in predict(impact, times).times]
    near = np.abs(theory / StoppedBeam(1e-3).impulse(times) - 1.0) < 0.02
    assert not near.all()
    found = predict_case(replace(case_of(impact), tables=HALF), [0.069, 1.1 * LATEST], whole=False)
    assert found.agreement == pytest.approx({"from": times[0], "until": times[near][-1]})


def test_a_beam_of_no_damping_keeps_waves_that_grid_viscosity_absorbs_and_its_bars_hold_them() -> None:
    """κ/ν = 1.61 at 0.0098 T*: an independent code has reactions from 14.0 to 15.6 and moments from 1.30 to 1.39."""
    impact = Impact.whole_beam(1.61)
    (found,) = predict_case(case_of(impact), [0.0098], whole=False).simulated or ()
    reaction, moment = found["reaction"], found["peak_moment"]
    assert reaction.known - reaction.spread < 14.0 and moment.known + moment.spread > 1.39
    damped = predict_case(case_of(impact.replace(damping=1e-4)), [0.0025], whole=False).simulated or ()
    assert damped[0]["reaction"].spread < 0.01 * damped[0]["reaction"].known


def test_a_rod_under_its_weight_leaves_with_what_is_known_of_it(tmp_path) -> None:
    """0.6324 of its velocity, 0.6298 without shear."""
    document = predict_case(load_case(rod(tmp_path, element=0.02), ["impact.gravity=9.81"]), [1e-4, 1e-3]).to_dict()
    restitution, largest = (document["whole_impact"][name] for name in ("restitution", "peak_stress"))
    assert restitution["value"] == pytest.approx(0.6324, abs=5e-4) and restitution["error"] < 1e-2
    early, late = (row["simulation"]["peak_stress"] for row in document["times"])
    assert early["value"] < late["value"] < largest["value"] == pytest.approx(165e6, rel=0.02)
    text = prediction_text(document)
    assert f"until 1 ms (simulation): {number_from(late).scaled(1e-6)}" in text
    assert f"(simulation): {number_from(largest).scaled(1e-6)}" in text
    assert f"last contact {number_from(document['whole_impact']['last_contact']).scaled(1e3)} ms" in text
    spoiled = {"valid_from": 1e-3, "force_until": 2e-4, "valid_until": 5e-3, "valid_after": "shear"}
    assert "From 1 ms on it has no reaction" in prediction_text(document | spoiled)
    assert "coefficient of restitution 0.63" in text and "rigid wall has no largest force" in text
    for change in ({}, {"damping": 0.0}, {"model": "euler_bernoulli"}):  # damping keeps a zone one point as yet
        said = prediction_text(document | {"regime": "continuous"} | change)
        assert ("half contact is within 2 % only without" in said) == (change == {})
    wall = {"peak_force": 47.2, "peak_force_time": 1e-3, "half_contact_length": 0.1, "pressure": 900.0}
    force = {"peak_force": {"value": 47.2, "error": 0.2}, "peak_force_time": 1e-3, "peak_force_place": 0.25}
    document |= {"wall": wall | {"penetration": None, "spoiled_by": None}}
    deep = {"wall": document["wall"] | {"penetration": 2e-3}, "whole_impact": document["whole_impact"] | force}
    text = prediction_text(document | deep)
    assert "beam): 47.2 N at 1 ms, over a zone of ± 0.1 m" in text and "penetration 2 mm" in text
    assert "pressure 0.9 kN/m" in text and "damping ratio: 39.69 or 56.13 N" in text  # F ~ k^¼
    assert "impact: 47.2 ± 0.2 N." in text and "acts at about 1 ms, on average about 0.25 m" in text
    push = {"push": {"value": 0.5, "error": 0.2}, "push_window": 2e-3, "push_time": 3e-3}
    over = {"over_damping": [{"damping_ratio": 0.02, "peak_stress": largest}]}
    whole = document["whole_impact"] | push | over | {"peak_force": None, "peak_force_time": None}
    text = prediction_text(document | {"whole_impact": whole, "agreement": {"from": 2e-3, "until": 2e-3}})
    assert "± is" not in text and "agree at 2 ms alone" in text
    assert "within 2 ms: 0.5 ± 0.2 N s." in text and "begins at 3 ms" in text
    assert f"ratio of the material: {number_from(largest).scaled(1e-6)} at 2 %" in text
    band = whole | {"push": {"value": None, "error": None, "band": {"mean": 0.5, "std": 0.2, "runs": 24}}}
    assert "a band is mean ± one standard deviation" in prediction_text(document | {"whole_impact": band})


def test_agreement_from_the_first_time_compared_is_said_so_and_one_point_of_a_beam_that_shears_is_a_short_zone():
    case = replace(case_of(Impact.whole_beam(2.0, relative_damping=1e-3)), tables=HALF)
    document = predict_case(case, [4e-3], whole=False).to_dict()
    first = document["compared_from"]
    assert first == pytest.approx(4e-5, rel=1e-9)
    for begin, said in ((first, "agree at all compared times until 2 ms"), (1e-3, "agree from 1 ms to 2 ms")):
        assert said in prediction_text(document | {"agreement": {"from": begin, "until": 2e-3}})
    for model, said in (("euler_bernoulli", "stays one point"), ("timoshenko", "shrinks to one point")):
        assert said in prediction_text(document | {"model": model, "regime": "discrete"}).split("\n")[0]


def test_a_pull_as_large_as_the_buckling_load_leaves_half_of_a_bow_and_a_tenth_of_it_is_not_worth_a_word() -> None:
    """A half sine of height b rests at b/(1 + NL²/(π²EI)). In units EI = μ = V₀ = 1 no bow is steep."""
    beam = Impact(4.0, 1.0, 2.0, 0.1, 1.0)
    said = {share: doubts(beam.replace(axial_force=share * np.pi**2), None) for share in (1.0, 0.09, -0.09, -0.9)}
    assert "straightens it (at rest to about 50 % of its height)" in said[1.0][0] and said[0.09] == said[-0.09] == []
    assert "bends it further (at rest to about 1000 % of its height)" in said[-0.9][0]
    steep = Impact(4.0, 1.0, 4.0, 0.15, 1.0)
    assert "slope at its ends is 0.3" in doubts(steep, None)[0] and doubts(Impact(1.0, 1.0, 2.0, 1.0, 1.0), None) == []
    held = Impact(4.0, 1.0, 2.0, 0.1, 1.0, axial_force=np.pi**2, tension_direction="tangent", acceleration=0.0)
    assert doubts(held, None) == []  # by other forces
    assert doubts(beam.replace(axial_force=-0.9 * np.pi**2, natural_curvature=0.0), None) == []  # likewise
    limber, less = (doubts(held.replace(shear_stiffness=times * np.pi**2), None) for times in (99.0, 101.0))
    assert "0.01 of the shear stiffness" in limber[0] and less == []


def test_slopes_that_grow_beyond_small_ones_are_told_with_their_time_and_those_of_the_bow_are_not() -> None:
    time, x = np.array([0.0, 1.0, 2.0]), np.linspace(0.0, 1.0, 5)

    def said(*largest: float) -> list[str]:
        return steep(history_of(time, x, impact=Impact(4.0, 1.0, 2.0, 0.1, 1.0), slope=np.outer(largest, x)))

    assert said(0.1, 0.2, 0.29) == said(0.5, 0.4, 0.5) == []
    assert "reach 0.9 (0.3 at 1 s)" in said(0.1, 0.4, 0.9)[0] and "reach 0.5:" in said(0.4, 0.5, 0.4)[0]


def test_a_gate_that_touches_all_at_once_mistaken_units_and_a_hole_that_bends_on_one_side_alone_are_doubted() -> None:
    gate = Impact(4.0, 1.0, 2.0, 0.0, 1.0, damping=1e-3, left_end="hinged")
    assert gate.off_centre and "its rebound is that of the contact law" in doubts(gate, None)[0]
    assert doubts(gate.replace(wall_stiffness=1e3), None) == []

    def said(**change: float | str) -> str:
        """Of an aluminium tube, 3 m, that falls."""
        tables = {"axial_force": "beam", "tension_direction": "beam", "gravity": "impact"}
        assignments = [f"{tables.get(key, 'section')}.{key}={value}" for key, value in change.items()]
        case = load_case(CASES / "tube.toml", assignments)
        return " ".join(doubts(case.impact, case.section))

    assert said() == "" and "are the sizes of the section in m?" in said(outer_diameter=0.7)
    assert "radii of gyration" in said(outer_diameter=0.7, added_mass=5e4), "what moves along makes no beam slender"
    assert "youngs_modulus = 70 Pa" in said(youngs_modulus=70.0) and "is it in kg/m³" in said(density=2.7)
    assert "speed of sound of 6.09 m/s" in said(youngs_modulus=1e5) and "1.18e+05 m/s" in said(density=5.0)
    assert said(youngs_modulus=1e6, density=1100.0) == said(youngs_modulus=1.2e12, density=3510.0) == ""
    area = np.pi * (0.05**2 - 0.044**2) / 4.0
    stretched = [said(axial_force=share * 70e9 * area) for share in (0.048, 0.052)]
    assert "|N|/A = 3360 MPa" in stretched[0] and "in N?" not in stretched[0]
    assert "strains the section by 0.052: is it in N?" in stretched[1]
    assert "no buoyancy is taken off" in said(added_mass=8.0)
    assert said(fluid_density=1e3) == said(added_mass=8.0, gravity=0.0) == ""
    for direction in ("axis", "tangent"):  # a tension weighs nothing
        assert "buoyancy" not in said(added_mass=8.0, gravity=0.0, axial_force=5e3, tension_direction=direction)
    hole = Impact.whole_beam(0.5).replace(opposite_wall=0.3, wall_curvature=0.1)
    bar = Impact(2.0, 1.0, 2.0, 0.1, 1.0)
    percent = [bar.replace(damping=ratio / (np.pi * first_mode(bar))) for ratio in (0.48, 0.52)]
    assert not doubts(percent[0], None) and "ratio of 0.52: is it meant in percent?" in doubts(percent[1], None)[0]
    heavy = bar.replace(mass_per_length=4.0, shear_stiffness=1e3)
    thick, thin = (heavy.replace(rotary_inertia=4.0 * (2.0 / radii) ** 2) for radii in (14.0, 15.5))
    assert not doubts(thin, None) and "only 14 radii of gyration long" in doubts(thick, None)[0]
    soft = Impact(2.0, 1.0, 2.0, 0.1, 1.0, damping=0.1, wall_stiffness=800.0, wall_damping=57.0)
    assert "wall's damping ratio is 1.01, beyond" in doubts(soft, None)[0]
    deep, less = (doubts(soft.replace(wall_damping=0.0, wall_stiffness=k, velocity=2.0), None) for k in (90.0, 110.0))
    assert "the wall gives way by some 0.21 m" in deep[0] and less == []  # 0.19 m of 2 m
    assert doubts(soft.replace(wall_damping=56.0), None) == doubts(soft.replace(wall_from=0.1, wall_to=0.1), None) == []
    assert "the second wall is flat" in doubts(hole, None)[-1] and doubts(hole.replace(wall_curvature=0.0), None) == []


@pytest.mark.parametrize("size", [1e-3, 1e3])
def test_they_agree_within_2_percent_over_the_longest_time_and_not_at_the_most_instants(size, monkeypatch) -> None:
    monkeypatch.setattr(predicting, "instant_numbers", lambda _: dict.fromkeys(COMPARED, Number(next(told), 0.0)))
    theory = SimpleNamespace(times=[SimpleNamespace(half_contact_length=size, impulse=size)] * 6)
    runs = SimpleNamespace(part=lambda _: None)
    for checked, span in (([0.1, 0.2, 0.3, 0.4, 0.6, 1.0], (0.6, 1.0)), ([0.1, 0.2, 0.6, 0.8, 0.9, 1.0], (0.1, 0.6))):
        told = (share * size for share in (1.01, 1.01, 1.01, 1.05, 1.01, 1.01))
        found = predicting._agreement(checked, theory, runs, 0)
        assert found == dict(zip(("from", "until"), span)), "the later is not the longer"
    told = (share * size for share in 6 * [1.05])
    assert predicting._agreement(checked, theory, runs, 0) is None


def test_a_warning_of_one_of_several_runs_says_of_which() -> None:
    """Steps of a rough mesh: its first is longer than the earlier time."""
    soft = Impact.whole_beam(0.1, relative_damping=1e-2).replace(wall_stiffness=1e3)
    found = predict_case(replace(case_of(soft), mesh=UniformMesh(0.25)), [1e-9, 1e-2], whole=False)
    off = [line for line in found.warnings if "do not balance" in line]
    assert [line.partition(":")[0] for line in off] == ["run to 10 ms", "run to 1e-06 ms"]
    assert any(line.startswith("the mesh cannot resolve") for line in found.warnings), "both runs say so"


def test_theory_only_simulates_nothing_and_says_what_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("simulate", "simulate_to_separation"):
        monkeypatch.setattr(HermiteFE, name, lambda *_, **__: pytest.fail("it simulates"))
    found = answered("predict", PIPE, "--time", "0.005", "--time", "0.01", "--theory-only")
    one, other = found["times"]
    assert one["impulse"] < other["impulse"] and 3.5 < other["half_contact_length"] < 4.0 and other["valid"]
    assert found["agreement"] is found["whole_impact"] is None and "simulation" not in one
    held = Impact.whole_beam(2.0, relative_damping=1e-3).replace(natural_curvature=1.0)  # no moment is known of it
    unknown = predict_case(case_of(held), [1e-3], theory_only=True)
    assert unknown.to_dict()["peak_moment"] is None and "(theory): not known" in str(unknown)
    tube = load_case(CASES / "tube.toml")
    late = predict_case(tube, [1.01 * LATEST * tube.impact.slow_time_scale], whole=False)  # T* is not a second
    assert late.simulated == [{}] and "are not simulated here" in " ".join(late.warnings)
    said = command("predict", PIPE, "--theory-only")[1]
    assert "yields at: 931" in said and "Largest stress, MPa:\n" in said
    assert "not known here (nothing is simulated: leave --theory-only out)" in said
    assert "(nothing is simulated: ask for a time after 0)" in command("predict", PIPE, "--time", "0")[1]
    mistaken = ("--set", "hermite.integrator.kind=nonsense")
    assert "hermite.integrator.kind" in refused("predict", PIPE, "--theory-only", *mistaken)
