"""Studies: the theory they are compared with, what their runs show on small cases, the thesis's filter; those on the
thesis's own cases, as they are stored for the report."""

import json
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from called import answered, refused
from PIL import Image
from strangers import Plain, Stranger

from bent_beam import stored
from bent_beam.cases import Case
from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from bent_beam_programs.thesis import stored_studies
from bent_beam_programs.thesis.gallery import runs
from bent_beam_programs.thesis.gallery.runs import every_step
from bent_beam_programs.thesis.sheet import Sheet
from bent_beam_programs.thesis.studies import STUDIES, first_order_case, run_study
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.of_methods import runs_of_methods
from bent_beam_programs.thesis.studies.outcome import CUT_OFF, Outcome, Steps
from bent_beam_programs.thesis.studies.panels import contact_length, geometry, unit
from bent_beam_programs.thesis.studies.thesis import Variant, run_variants, thesis_settings
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE
from hermite_fe.integrators import SignoriniPosition
from self_similar_fe import SelfSimilarFE
from theory import predict


def case(curvature: float, duration: float, **changes: float) -> Case:
    found = runs.case(curvature, duration)
    return replace(found, impact=found.impact.replace(**changes))


LOADS = ({}, {"axial_force": 40.0}, {"axial_force": -40.0}, {"acceleration": 70.0}, {"acceleration": -70.0})


@pytest.mark.parametrize("load", LOADS)
def test_the_exact_answer_of_a_study_is_that_of_the_theory_with_its_loads(load: dict[str, float]) -> None:
    impact = Impact.whole_beam(0.5).replace(**load)
    exact, time = Exact(impact), np.array([1e-3, 2e-3])
    rows = predict(impact, time).times
    assert exact.leading == (not load)
    for found, name in ((exact.front(time), "half_contact_length"), (2.0 * exact.side_reaction(time), "reaction"),
                        (exact.impulse(time), "impulse")):  # fmt: skip
        assert found == pytest.approx([getattr(row, name) for row in rows], rel=1e-9)
    with pytest.raises(ValueError, match="wall_stiffness is not modelled by the theory"):
        Exact(impact.replace(wall_stiffness=1e3))
    if min(load.values(), default=0.0) >= 0.0:
        places = np.linspace(0.0, float(exact.front(2e-3)), 9)
        assert np.abs(exact.gap(places, 2e-3)).max() < 1e-2 * 2e-3  # of second order


def test_the_fast_layer_holds_the_work_of_the_wall_and_a_quarter_of_it_and_more_is_strain() -> None:
    shares = []
    for curvature in (1.0 / 80.0, 1.0, 25.0):
        exact = Exact(case(curvature, 0.1).impact)
        assert float(exact.fast_energy(2.5e-4)) == pytest.approx(20.0 * float(exact.impulse(2.5e-4)), rel=1e-9)
        shares.append(exact.strain_share)
    assert shares[0] == pytest.approx(0.25, abs=2e-5)
    assert shares == sorted(shares) and shares[-1] < 0.5


@pytest.mark.parametrize(("sign", "expected"), [(1.0, 300.0), (-1.0, -280.6)])
def test_the_fit_of_the_thesis_recovers_the_prediction_of_theory(sign: float, expected: float) -> None:
    impact = first_order_case.accelerated(Impact(1.0, 1.0, 2.0, 0.35, 3.5), sign)
    assert impact.acceleration == 700.0 * sign
    assert first_order_case.predicted(impact) == pytest.approx(expected, abs=0.05)
    times = np.linspace(0.0, 2e-3, 400)
    none = np.zeros_like(times)
    exact = Outcome("x", impact, sign, times, Exact(impact).front(times), none, none, none, none, none, {})
    assert first_order_case.fitted(exact) == pytest.approx(expected, rel=1e-3)


def test_the_thesis_settings_of_its_own_cases_and_the_units_of_its_figures() -> None:
    given = case(1.0, 0.01)
    found = thesis_settings(given.impact, given.end_time)
    assert (found.element_length, found.time_step) == pytest.approx((2.5e-3, 2.5e-8))
    assert found.zone == pytest.approx(0.0624, abs=2e-4)
    assert unit(2.5e-5, "s") == (1e6, "µs") and unit(0.03, "m") == (1e3, "mm") and unit(12e3, "N")[1] == "kN"


def test_a_solver_that_cannot_finish_is_a_row_of_its_own_without_numbers() -> None:
    given, broken = case(1.0, 0.01), Stranger("fails")
    (found,) = run_variants([Variant("broken", given.impact, given.end_time, broken)])
    assert "no luck" in found.failure and found.row()["lift"] is None
    with pytest.raises(ValueError, match="broken: no lift"):
        _ = found.lift


def stored_rows(name: str) -> dict[str, dict[str, Any]]:
    """Rows of a study on the thesis's own case, by label."""
    (study,) = (s for s in stored.read(stored_studies.FILE)["studies"] if s["name"] == name)
    return {row["label"]: row for row in study["rows"]}


def test_each_parameter_has_the_effect_that_the_thesis_and_theory_give_it() -> None:
    """3.3.1–3.3.5. Of no effect on the lift: the time step, ρ∞. A tenth of the lift with nodes needs lumped masses;
    coarse elements far away reflect waves; true geometry drifts with the slopes."""
    rows = stored_rows("time-step")
    fine = [rows[f"h = {h} s"] for h in ("5·10⁻⁸", "2.5·10⁻⁸", "10⁻⁸")]
    lifts = [row["lift"] for row in fine]
    assert max(lifts) < 1.01 * min(lifts) and all(45.0 < row["reaction_error"] < 55.0 for row in fine)  # lumped middles
    for name, error, lift in (("Hermite", 0.2, 5e-3), ("Self-similar", 0.01, 1e-4)):
        ours = rows[name]
        assert abs(ours["reaction_error"]) < error and abs(ours["contact_length_error"]) < error and ours["lift"] < lift
    errors = [abs(row["reaction_error"]) for label, row in stored_rows("mesh").items() if "e = 1.25" in label]
    assert errors == sorted(errors, reverse=True) and errors[0] > 30.0 and errors[-1] < 0.2 * errors[0]
    rows = stored_rows("restitution")
    assert rows["restitution 0"]["lost_impact"] > 10.0 and abs(rows["restitution 1"]["lost_impact"]) < 1e-9
    assert rows["restitution 1"]["lift"] > rows["restitution 0"]["lift"]
    lifts = [stored_rows("damping")[f"ρ∞ = {r}"]["lift"] for r in ("1", "0.8", "0.5", "0.2", "0")]
    assert max(lifts) < 1.25 * min(lifts)
    rows = stored_rows("contact-point")
    assert rows["nodes, lumped"]["value"] == 0.0 > rows["nodes, consistent"]["value"] > rows["middles, lumped"]["value"]
    assert rows["nodes, lumped"]["lift"] < 0.4 * rows["middles, lumped"]["lift"]
    assert 0.5 < rows["nodes, consistent"]["lift"] / rows["middles, consistent"]["lift"] < 2.0
    rows = stored_rows("far-field")
    assert rows["e = 1.25"]["noise"] > 1.5 * rows["e = 1.02"]["noise"]
    assert rows["e = 1.25, grid viscosity 0.3"]["noise"] < 0.05 * rows["e = 1.25"]["noise"]
    rows = stored_rows("amplitude")
    assert 0.4 < rows["true, τ = 0.03"]["reaction_error"] - rows["linear, τ = 0.03"]["reaction_error"] < 0.9


def test_the_condition_of_the_matrix_is_that_of_its_units_and_the_runs_close_their_budget() -> None:
    rows = stored_rows("conditioning").values()
    assert all(row["scaled"] < 1e-3 * row["raw"] and row["defect"] < 1e-9 for row in rows)
    assert [row["elements"] for row in rows] == sorted(row["elements"] for row in rows)


def test_the_filter_is_that_of_butterworth_both_ways() -> None:
    """Of order 1 it passes 1/(1 + (tan πf/2 / tan πf_c/2)²) of an amplitude both ways, without a shift: ½ at f_c."""
    n, middle = np.arange(6000.0), slice(2000, 4000)
    for share in (0.25, 1.0, 4.0):
        wave = np.cos(np.pi * share * CUT_OFF * n)
        passed = 1.0 / (1.0 + (np.tan(0.5 * np.pi * share * CUT_OFF) / np.tan(0.5 * np.pi * CUT_OFF)) ** 2)
        assert Steps(n, wave).filtered()[middle] == pytest.approx(passed * wave[middle], abs=1e-6)
    assert Steps(n, np.ones_like(n)).filtered() == pytest.approx(1.0)  # to both ends


def test_taking_every_step_by_itself_gives_the_same_run_and_its_impulse() -> None:
    given = case(10.0, 0.002)
    method = thesis_settings(given.impact, given.end_time).method()
    saved = np.linspace(0.0, given.end_time, 6)
    history, steps = every_step(given.impact, given.end_time, method, saved)
    whole = method.simulate(given.impact, end_time=given.end_time, save=saved)
    for name in ("time", "gap", "total_impulse", "kinetic_energy", "loss_impact"):
        assert np.array_equal(history.array(name), whole.array(name))
    impulse = float(whole.array("total_impulse")[-1])
    assert 2.0 * float(steps.reaction @ np.diff(steps.time, prepend=0.0)) == pytest.approx(impulse, rel=1e-12)


def asked_of(name: str, given: Case, method: Any, refine: float = 1.0) -> dict[str, Any]:
    """Runs (or the refusal) by the name of their setting, those of this refinement from the last of two."""
    both = runs_of_methods(STUDIES[name].vary, given, [method], [0.5, refine])
    found = [one for one in both if one.refine == refine]
    by_name = {one.setting: one for one in found}
    assert len(by_name) == len(found)
    return by_name


def test_a_study_varies_the_methods_that_have_its_parameter_and_names_what_the_others_lack() -> None:
    given, used = case(10.0, 0.01), {}
    for name in STUDIES:
        for method in (HermiteFE(), SelfSimilarFE(), ExudynModel(), Plain()):
            found = list(asked_of(name, given, method).values())
            assert all(one.label == method.label for one in found)
            if len(found) > 1:
                assert len({(one.method, one.impact, one.end_time) for one in found}) == len(found)
                used.setdefault(name, []).append(method.path)
            else:
                assert found[0].refused and "not varied: " in found[0].failure
    assert used["restitution"] == ["hermite"] and used["penalty"] == ["exudyn"]
    assert used["mesh"] == ["hermite", "self_similar", "exudyn"]
    assert used["far-field"] == ["hermite", "self_similar", "exudyn", "theirs"]


def test_a_study_varies_one_thing() -> None:
    """Longer steps on the same mesh, longer elements with the same steps, ρ∞ as the θ of the same amplification."""
    given, method = case(10.0, 0.01), HermiteFE()
    steps = asked_of("time-step", given, method)
    once, longer = (steps[f"h × {f}"].method for f in (1, 4))
    assert longer.integrator.growth == 4.0 * once.integrator.growth and longer.mesh == once.mesh
    meshes = asked_of("mesh", given, method, 2.0)
    once, longer = (meshes[f"Δx × {f}"].method for f in (1, 2))
    assert longer.mesh.element_length == pytest.approx(2.0 * once.mesh.element_length)
    assert longer.integrator == once.integrator
    damped = asked_of("damping", given, method)
    assert [damped[f"ρ∞ = {radius}"].method.integrator.theta for radius in (1, 0)] == [0.5, 1.0]


def test_the_refusal_of_a_method_is_a_row_with_its_reason() -> None:
    (row,) = asked_of("far-field", case(10.0, 0.01, axial_force=1.0), Plain()).values()
    assert row.refused and row.failure == "axial_force is not modelled"
    (row,) = asked_of("far-field", case(10.0, 0.01), Plain(), 2.0).values()
    assert row.refused and "does not know how to be refined" in row.failure
    law, told = HermiteFE(mesh=UniformMesh(0.05), integrator=SignoriniPosition()), list[tuple[int, int]]()
    given = case(10.0, 0.01, length=2.0)
    rows = run_study("restitution", given, methods=[law], progress=lambda *done: told.append(done)).rows
    assert told[-1][0] == told[-1][1]
    assert [row["refused"] for row in rows] == [False, True, True]
    assert all("restitution" in row["failure"] for row in rows[1:])


def test_the_command_takes_methods_and_every_row_plot_and_table_carries_the_label(tmp_path: Path) -> None:
    """The labels are those of the file; a method that cannot be used is a row among the others, and no error."""
    file, out = tmp_path / "methods.toml", tmp_path / "out"
    file.write_text(
        '[[method]]\nlabel = "Mine"\npath = "hermite"\nmesh = {kind = "uniform", element_length = 0.05}\n'
        'integrator = {kind = "moreau_jean"}\n[[method]]\nlabel = "Endless"\npath = "self_similar"\n'
    )
    asked = ("study", "restitution", "cases/thesis_K10.toml", "--methods", file)
    asked += ("--set", "beam.length=2.0", "--set", "run.duration=0.002")
    assert "names the methods" in refused(*asked, "--set", "hermite.mesh.growth=1.0")
    found = answered(*asked, "--out", out, "--refine", "0.5")
    rows, files = found["rows"], [out / f"restitution{end}" for end in (".png", ".csv", "-table.csv", ".json")]
    assert found["files"] == [str(f) for f in files] and all(f.stat().st_size > 100 for f in files)
    assert json.loads(files[-1].read_text()) == found
    assert [(r["label"], r["refine"]) for r in rows] == [("Mine", 0.5)] * 3 + [("Endless", 0.5)]
    assert [r["setting"] for r in rows[:3]] == ["restitution 0", "restitution 0.5", "restitution 1"]
    assert all(r["reaction_error"] is not None and r["failure"] is None for r in rows[:3])
    assert rows[3]["failure"] == "not varied: self_similar has no contact" and rows[3]["refused"]
    drawn, table = (file.read_text() for file in files[1:3])
    assert "Mine, refined 0.5 times" in drawn and "Endless" in table


def test_runs_of_unlike_lengths_are_drawn_to_the_longest_s_end() -> None:
    """Where the beam is at its end is drawn of the longest alone, with the time beside it."""
    impact, x, sheet, lines = Impact.dimensionless(0.5), np.linspace(0.0, 2.0, 50), Sheet(), []
    for k in range(2):
        time = np.linspace(0.0, 0.1 + 0.9 * k, 30)
        front = np.asarray(Exact(impact).front(time))
        lines.append(Outcome(str(k), impact, None, time, front, front, 0.0 * time, 0.0 * time, x, x**2, {}, "exudyn"))
    with sheet.figure(1, 2, height=3.0) as (_, axes):
        geometry(sheet, axes[0], lines)
        contact_length(sheet, axes[1], lines)
        assert axes[1].get_xlim()[1] == pytest.approx(1.0) and "at 1 s" in axes[0].get_ylabel()
    series = [{name for axis, name, *_ in sheet.curves if axis is panel} for panel in axes]
    assert series == [{"theory", "1"}, {"theory", "0", "1"}]


def test_a_small_picture_keeps_the_colours_of_thin_lines_and_a_grey_wall_grey(tmp_path: Path) -> None:
    """Lines one pixel wide on a smooth shade that has most of the pixels; a grey wall; and a patch of more random
    colours than are kept."""
    lines, colours = [20, 40, 60], np.array([[[31, 119, 180]], [[44, 160, 44]], [[214, 39, 40]]])
    shade = np.broadcast_to(np.linspace(120, 255, 300).astype(np.uint8)[None, :, None], (200, 300, 3)).copy()
    shade[lines], shade[80:120] = colours, 232
    shade[130:190, :60] = np.random.default_rng(1).integers(0, 256, (60, 60, 3))
    Image.fromarray(shade).save(tmp_path / "lines.png")
    with Image.open(BytesIO(stored_studies.small_picture(tmp_path / "lines.png"))) as picture:
        kept = np.asarray(picture.convert("RGB"), dtype=float)
    assert np.abs(kept[lines] - colours).max() <= 12.0 and np.abs(kept[80:120] - 232.0).max() <= 2.0


def test_stored_studies_carry_their_tables_and_pictures_and_say_what_was_lost(tmp_path, monkeypatch):
    cases = {"restitution": case(10.0, 0.002, length=2.0), "mesh": case(0.0, 0.002)}
    monkeypatch.setattr(stored_studies, "case_of", cases.get)
    monkeypatch.setattr(stored_studies, "STUDIES", {name: STUDIES[name] for name in cases})
    note, lost = stored.read(stored_studies.store_studies(file=tmp_path / "studies.json"))["studies"]
    assert [row["label"] for row in note["rows"][:3]] == ["restitution 0", "restitution 0.5", "restitution 1"]
    assert note["columns"].keys() <= note["rows"][0].keys()
    assert not note["failed"] and note["reason"] == ""
    with Image.open(tmp_path / "restitution.png") as picture:
        assert picture.mode == "P"
    assert lost["failed"] and "curvature" in lost["reason"] and lost["rows"] == []
