"""Studies: their registry, the theory they are held against, and what they find on small cases."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import pytest

from bent_beam.cases import Case
from bent_beam.impact import Impact
from bent_beam.meshes import UniformMesh
from comparison.command_line.app import run
from comparison.studies import STUDIES, amplitude, first_order_case, friction, penalty, run_study
from comparison.studies.exact import Exact
from comparison.studies.of_methods import asked_of
from comparison.studies.outcome import Outcome
from comparison.studies.panels import unit
from comparison.studies.sentences import between, number, reference_sentences
from comparison.studies.thesis import Variant, run_variants, thesis_settings
from exudyn_models import ExudynModel
from hermite_fe import HermiteFE
from hermite_fe.integrators import SignoriniPosition
from self_similar_fe import SelfSimilarFE
from theory import predict

NAMES = {
    "time-step",
    "mesh",
    "damping",
    "restitution",
    "contact-point",
    "far-field",
    "penalty",
    "amplitude",
    "friction",
    "first-order-case",
    "conditioning",
}


def case(curvature: float, duration: float, **changes: float) -> Case:
    usual = {"bending_stiffness": 1.0, "mass_per_length": 1.0, "length": 50.0, "velocity": 20.0}
    impact = Impact(**{**usual, "curvature": curvature, **changes})
    return Case(
        title=f"K = {curvature:g} 1/m",
        impact=impact,
        end_time=duration * impact.time_scale,
        mesh=None,
        tables={},
    )


def by_label(result: Any) -> dict[str, dict[str, Any]]:
    return {row["label"]: row for row in result.rows}


@pytest.mark.parametrize("force", [0.0, 40.0, -40.0])
def test_the_exact_answer_of_a_study_knows_the_axial_force(force: float) -> None:
    impact = Impact.whole_beam(0.5).replace(axial_force=force)
    exact, time = Exact(impact), np.array([1e-3, 2e-3])
    rows = predict(impact, time).times
    assert exact.leading == (force == 0.0) == (not impact.loaded)
    for found, name in ((exact.front(time), "half_contact_length"), (2.0 * exact.side_reaction(time), "reaction"),
                        (exact.impulse(time), "impulse")):  # fmt: skip
        assert found == pytest.approx([getattr(row, name) for row in rows], rel=1e-9)
    front = float(exact.front(2e-3))
    if force >= 0.0:
        assert np.abs(exact.gap(np.linspace(0.0, front, 9), 2e-3)).max() < 1e-2 * 2e-3  # of second order


def test_all_studies_are_registered_with_titles() -> None:
    assert set(STUDIES) == NAMES
    assert all(study.name == name and study.title for name, study in STUDIES.items())


def test_unknown_studies_and_flat_beams_are_refused() -> None:
    with pytest.raises(ValueError, match="mess"):
        run_study("mess", case(1.0, 0.01))
    with pytest.raises(ValueError, match="curvature"):
        run_study("mesh", case(0.0, 0.01))


# theory in SI units --------------------------------------------------------------------------------------------------


def test_the_fast_layer_holds_what_the_wall_pushes() -> None:
    for curvature in (1.0 / 80.0, 1.0, 10.0, 25.0):
        exact = Exact(case(curvature, 0.1).impact)
        assert float(exact.fast_energy(2.5e-4)) == pytest.approx(20.0 * float(exact.impulse(2.5e-4)), rel=1e-9)


def test_strain_takes_a_quarter_of_the_energy_for_flat_beams_and_more_for_bent_ones() -> None:
    shares = [Exact(case(k, 0.1).impact).strain_share for k in (1.0 / 80.0, 10.0, 25.0)]
    assert shares[0] == pytest.approx(0.25, abs=2e-5)
    assert shares[0] < shares[1] < shares[2] < 0.5


def test_impulse_is_the_integral_of_the_reaction_at_first_order() -> None:
    exact = Exact(Impact(1.0, 1.0, 2.0, 0.35, 3.5, acceleration=70.0))
    times = np.linspace(0.0, 1.0, 20001) ** 2 * 4e-4
    middles = 0.5 * (times[1:] + times[:-1])
    total = float(np.sum(2.0 * exact.side_reaction(middles) * np.diff(times)))
    assert total == pytest.approx(float(exact.impulse(4e-4)), rel=1e-3)


def test_the_thesis_settings_of_its_own_cases() -> None:
    given = case(1.0, 0.01)
    found = thesis_settings(given.impact, given.end_time)
    assert found.element_length == pytest.approx(2.5e-3)
    assert found.time_step == pytest.approx(2.5e-8)
    assert found.zone == pytest.approx(0.0624, abs=2e-4)


# studies on small cases ----------------------------------------------------------------------


@pytest.mark.verify
def test_the_time_step_is_not_what_lifts_the_beam(tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    result = run_study(
        "time-step", case(1.0, 0.01), out=tmp_path, progress=lambda done, total: seen.append((done, total))
    )
    rows = by_label(result)
    fine = [rows[f"h = {h} s"] for h in ("5e-08", "2.5e-08", "1e-08")]
    assert all(0.25 < row["lift"] < 0.31 and 15.0 < row["reaction_error"] < 25.0 for row in fine)
    for name, error, lift in (("Hermite", 0.2, 5e-3), ("Self-similar", 0.01, 1e-4)):
        ours = rows[name]
        assert abs(ours["reaction_error"]) < error and abs(ours["contact_length_error"]) < error and ours["lift"] < lift
    assert "moves neither the lift" in result.conclusion
    assert seen[-1] == (7, 7)
    assert {Path(f).name for f in result.files} == {
        "time-step.png",
        "time-step.csv",
        "time-step-table.csv",
        "time-step.json",
    }
    assert all(Path(f).stat().st_size > 100 for f in result.files)
    document = json.loads((tmp_path / "time-step.json").read_text())
    assert document["conclusion"] == result.conclusion and document["rows"] == result.to_dict()["rows"]


@pytest.mark.verify
def test_shorter_elements_bring_the_reaction_to_theory() -> None:
    result = run_study("mesh", case(1.0, 0.01))
    errors = [abs(r["reaction_error"]) for r in result.rows if "e = 1.25" in r["label"]]
    assert errors == sorted(errors, reverse=True)
    assert errors[0] > 30.0 and errors[-1] < 5.0
    json.dumps(result.to_dict(), allow_nan=False)
    assert "conclusion" in result.to_dict() and result.conclusion in result.text()


@pytest.mark.verify
def test_restitution_keeps_energy_and_lifts_more() -> None:
    rows = by_label(run_study("restitution", case(1.0, 0.01)))
    assert rows["restitution 0"]["lost_impact"] > 10.0
    assert abs(rows["restitution 1"]["lost_impact"]) < 1e-9
    assert rows["restitution 1"]["lift"] > rows["restitution 0"]["lift"]


@pytest.mark.verify
def test_the_spectral_radius_hardly_matters() -> None:
    rows = by_label(run_study("damping", case(1.0, 0.01)))
    lifts = [rows[f"ρ∞ = {r}"]["lift"] for r in ("1", "0.8", "0.5", "0.2", "0")]
    assert max(lifts) < 1.25 * min(lifts)


@pytest.mark.verify
def test_lumped_nodes_are_flatter_than_lumped_middles_and_consistent_ones_are_not() -> None:
    """Thesis 3.3.5: a tenth, which needs lumped masses."""
    rows = by_label(run_study("contact-point", case(1.0, 0.01)))
    assert rows["nodes, lumped"]["value"] == 0.0 > rows["nodes, consistent"]["value"] > rows["middles, lumped"]["value"]
    assert rows["nodes, lumped"]["lift"] < 0.4 * rows["middles, lumped"]["lift"]
    assert 0.5 < rows["nodes, consistent"]["lift"] / rows["middles, consistent"]["lift"] < 2.0


@pytest.mark.verify
def test_coarse_elements_far_away_send_waves_back() -> None:
    rows = by_label(run_study("far-field", case(10.0, 0.01)))
    assert rows["e = 1.25"]["noise"] > 1.5 * rows["e = 1.02"]["noise"]
    assert rows["e = 1.25, grid viscosity 0.3"]["noise"] < 0.05 * rows["e = 1.25"]["noise"]


def test_a_solver_that_cannot_finish_is_a_row_of_its_own() -> None:
    given = case(1.0, 0.01)

    class Broken(HermiteFE):
        def simulate(self, *args: Any, **kwargs: Any) -> Any:
            raise ArithmeticError("no luck")

    found = run_variants([Variant("broken", given.impact, given.end_time, Broken())])
    assert found[0].failure == "no luck" and found[0].row()["lift"] is None


def test_what_is_missing_is_said_and_never_a_zero() -> None:
    empty = dict.fromkeys(("contact_length_error", "reaction_error", "lift", "noise"))
    run = synthetic("Mine", empty, mark="mine")
    assert between([run], "lift", " V₀t") == "not measured"
    assert reference_sentences([run]) == "Mine gave no number on this case."
    with pytest.raises(ValueError, match="no lift"):
        run.measure("lift")


# studies of any methods --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Plain:
    """A method of somebody else's without any parts."""

    path: ClassVar[str] = "plain"
    label: str = "Plain"

    def refuses(self, impact: Impact) -> str | None:
        return "axial_force is not modelled" if impact.axial_force else None


USES = {  # whom a study can use, of hermite, self_similar, exudyn and a method without parts
    "time-step": {"hermite", "exudyn"},
    "mesh": {"hermite", "self_similar", "exudyn"},
    "damping": {"hermite", "exudyn"},
    "restitution": {"hermite"},
    "contact-point": {"hermite", "exudyn"},
    "far-field": {"hermite", "self_similar", "exudyn", "plain"},
    "penalty": {"exudyn"},
    "amplitude": {"exudyn"},
    "friction": set(),  # until it is given a contact with friction
    "first-order-case": {"hermite", "self_similar", "exudyn", "plain"},
    "conditioning": set(),
}


@pytest.mark.parametrize("name", sorted(NAMES))
def test_a_study_varies_the_methods_that_have_what_it_varies_and_says_what_the_others_lack(name: str) -> None:
    given = case(10.0, 0.01)
    for method in (HermiteFE(), SelfSimilarFE(), ExudynModel(), Plain()):
        found = asked_of(STUDIES[name], given, method, 1.0)
        if method.path in USES[name]:
            settings = [one for one in found if isinstance(one, Variant)]
            assert len(settings) == len(found) > 1
            assert len({one.setting for one in settings}) == len(found)
            assert len({(one.method, one.impact, one.end_time) for one in settings}) == len(found)
            assert all(one.label == method.label for one in settings)
        else:
            (row,) = found
            assert isinstance(row, Outcome) and row.refused and row.label == method.label
            assert "not varied: " in str(row.failure)


def test_a_study_varies_one_thing() -> None:
    """Longer steps on the same mesh, longer elements with the same steps, ρ∞ as the θ that means it."""
    given, method = case(10.0, 0.01), HermiteFE()
    steps = {one.setting: one.method for one in asked_of(STUDIES["time-step"], given, method, 1.0)}
    assert steps["h × 4"].integrator.growth == 4.0 * steps["h × 1"].integrator.growth
    assert steps["h × 4"].mesh == steps["h × 1"].mesh
    meshes = {one.setting: one.method for one in asked_of(STUDIES["mesh"], given, method, 2.0)}
    assert meshes["Δx × 2"].mesh.element_length == pytest.approx(2.0 * meshes["Δx × 1"].mesh.element_length)
    assert meshes["Δx × 2"].integrator == meshes["Δx × 1"].integrator
    damped = {one.setting: one.method for one in asked_of(STUDIES["damping"], given, method, 1.0)}
    assert [damped[f"ρ∞ = {radius}"].integrator.theta for radius in ("1", "0")] == [0.5, 1.0]


def test_what_a_method_refuses_is_a_row_with_its_reason() -> None:
    pulled = case(10.0, 0.01, axial_force=1.0)
    (row,) = asked_of(STUDIES["far-field"], pulled, Plain(), 1.0)
    assert row.refused and row.failure == "axial_force is not modelled"
    (row,) = asked_of(STUDIES["far-field"], case(10.0, 0.01), Plain(), 2.0)
    assert row.refused and "does not know how to be refined" in row.failure
    law = HermiteFE(mesh=UniformMesh(0.05), integrator=SignoriniPosition())
    rows = run_study("restitution", case(10.0, 0.01, length=2.0), methods=[law]).rows
    assert [row["refused"] for row in rows] == [False, True, True]
    assert all("restitution" in row["failure"] for row in rows[1:])


def test_the_command_takes_methods_and_every_row_plot_and_table_carries_the_label(tmp_path: Path, capsys: Any) -> None:
    """The labels are those of the file; a method that cannot be used is a row among the others, and no error."""
    mesh = 'mesh = {kind = "uniform", element_length = 0.05}'
    file = tmp_path / "methods.toml"
    file.write_text(
        f'[[method]]\nlabel = "Mine"\npath = "hermite"\n{mesh}\nintegrator = {{kind = "moreau_jean"}}\n'
        '[[method]]\nlabel = "Endless"\npath = "self_similar"\n'
    )
    small = ["--set", "beam.length=2.0", "--set", "run.duration=0.01"]
    arguments = ["study", "damping", "cases/thesis_K10.toml", *small, "--json", "--out", str(tmp_path / "out")]
    assert run([*arguments, "--methods", str(file), "--refine", "1,2"]) == 0
    document = json.loads(capsys.readouterr().out)
    rows = document["rows"]
    assert [(r["label"], r["refine"]) for r in rows] == [
        *[("Mine", 1)] * 5,
        *[("Mine", 2)] * 5,
        ("Endless", 1),
        ("Endless", 2),
    ]
    assert [r["setting"] for r in rows[5:10]] == ["ρ∞ = 1", "ρ∞ = 0.8", "ρ∞ = 0.5", "ρ∞ = 0.2", "ρ∞ = 0"]
    assert all(r["reaction_error"] is not None and r["failure"] is None for r in rows[:10])
    assert all(r["failure"] == "not varied: self_similar has no integrator" and r["refused"] for r in rows[10:])
    drawn = (tmp_path / "out" / "damping.csv").read_text()
    table = (tmp_path / "out" / "damping-table.csv").read_text()
    assert "Mine" in drawn and "Mine, refined 2 times" in drawn and "Endless" in table
    assert "Mine, refined 2 times: over 5 settings" in document["conclusion"]


def test_the_command_takes_paths_and_settings_and_refuses_both_ways_at_once(tmp_path: Path, capsys: Any) -> None:
    arguments = ["study", "damping", "cases/thesis_K10.toml", "--json", "--set", "beam.length=2.0"]
    arguments += ["--set", "run.duration=0.01", "--set", "hermite.mesh.kind=uniform"]
    arguments += ["--set", "hermite.mesh.element_length=0.05"]
    assert run([*arguments, "--path", "hermite"]) == 0
    (label,) = {row["label"] for row in json.loads(capsys.readouterr().out)["rows"]}
    assert label == "Hermite, mesh=uniform, mesh.element_length=0.05"
    assert run([*arguments, "--methods", "cases/methods/one_of_each.toml"]) == 2
    assert "names the methods" in capsys.readouterr().err


# Exudyn and first order --------------------------------------------------------------------------------------------


@pytest.mark.verify
def test_true_geometry_drifts_with_the_slopes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(amplitude, "DURATIONS", (3e-2,))
    result = run_study("amplitude", case(10.0, 0.1))
    rows = by_label(result)
    drift = rows["true, τ = 0.03"]["reaction_error"] - rows["linear, τ = 0.03"]["reaction_error"]
    assert 0.4 < drift < 0.9
    assert "within one per cent up to slopes of 0.17" in result.conclusion


def synthetic(
    label: str, measures: dict[str, float | None], value: float | None = None, mark: str | None = None
) -> Outcome:
    none = np.zeros(0)
    whole = {"contact_length_error": 0.0, "reaction_error": 0.0, "lift": 0.0, "noise": 0.0, **measures}
    return Outcome(label, case(10.0, 0.1).impact, value, none, none, none, none, none, none, none, whole, mark)


def test_conclusions_follow_the_numbers() -> None:
    runs = [
        synthetic(penalty.BARE, {"noise": 0.1, "lift": 1e-5}),
        synthetic("C = 100", {"noise": 17.0, "lift": 2e-3}, 100.0),
        synthetic(penalty.DEFAULT, {"noise": 0.1, "lift": 1e-10}, mark="exudyn"),
    ]
    assert "noisiest that finished is C = 100 (17 %)" in penalty.conclude(runs)
    rubbed = [
        synthetic(f"{g}, friction {f:g}", {"reaction_error": 0.5 * f * (g[0] == "t")}, f)
        for g in ("linear limit", "true geometry")
        for f in (0.0, 0.6)
    ]
    text = friction.conclude(rubbed)
    assert "moves r₀ by 0 % at most in the linear limit" in text and "by 0.3 % at most in the true geometry" in text
    assert text.count("does not matter") == 1 and text.count("Friction matters") == 1


@pytest.mark.parametrize(("sign", "expected"), [(1.0, 300.0), (-1.0, -280.6)])
def test_the_fit_of_the_thesis_recovers_what_theory_predicts(sign: float, expected: float) -> None:
    impact = first_order_case.accelerated(Impact(1.0, 1.0, 2.0, 0.35, 3.5), sign)
    assert impact.acceleration == 700.0 * sign
    assert first_order_case.predicted(impact) == pytest.approx(expected, abs=0.05)
    times = np.linspace(0.0, 2e-3, 400)
    none = np.zeros_like(times)
    run = Outcome("x", impact, sign, times, Exact(impact).front(times), none, none, none, none, none, {})
    assert first_order_case.fitted(run) == pytest.approx(expected, rel=1e-3)


def test_numbers_and_units_read_well() -> None:
    assert [number(v) for v in (0.0, 1e-15, 0.0123, 12.34, 1234.0, 2.5e-5)] == [
        "0",
        "0",
        "0.012",
        "12",
        "1234",
        "2.5·10⁻⁵",
    ]
    assert number(-2.5) == "−2.5" and number(None) == "not measured"
    assert unit(2.5e-5, "s") == (1e6, "µs") and unit(0.03, "m") == (1e3, "mm") and unit(12e3, "N")[1] == "kN"
