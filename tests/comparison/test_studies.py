"""Studies: their registry, the theory they are held against, and what they find on small cases."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bent_beam.cases import Case
from bent_beam.impact import Impact
from comparison.studies import STUDIES, amplitude, first_order_case, friction, penalty, run_study
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome
from comparison.studies.panels import unit
from comparison.studies.sentences import between, number, reference_sentences
from comparison.studies.thesis import Variant, run_variants, thesis_settings
from hermite_fe import HermiteFE

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
    impact = Impact(
        bending_stiffness=1.0, mass_per_length=1.0, length=50.0, curvature=curvature, velocity=20.0, **changes
    )
    return Case(
        title=f"K = {curvature:g} 1/m",
        impact=impact,
        end_time=duration * impact.time_scale,
        mesh=None,
        tables={},
    )


def by_label(result: Any) -> dict[str, dict[str, Any]]:
    return {row["label"]: row for row in result.rows}


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


def test_lumped_nodes_are_flatter_than_lumped_middles_and_consistent_ones_are_not() -> None:
    """Thesis 3.3.5: a tenth, which needs lumped masses."""
    rows = by_label(run_study("contact-point", case(1.0, 0.01)))
    assert rows["nodes, lumped"]["value"] == 0.0 > rows["nodes, consistent"]["value"] > rows["middles, lumped"]["value"]
    assert rows["nodes, lumped"]["lift"] < 0.4 * rows["middles, lumped"]["lift"]
    assert 0.5 < rows["nodes, consistent"]["lift"] / rows["middles, consistent"]["lift"] < 2.0


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
