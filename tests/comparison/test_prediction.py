"""``bentbeam predict``: theory beside a simulation of the whole beam, and the whole impact."""

import json
import math
from pathlib import Path
from typing import Any

import pytest
from called import answered, refused
from histories import ROD

from bent_beam import Impact
from bent_beam.cases import Case, load_case
from bent_beam.free_flight import LOWEST_PERIOD
from bent_beam.measure.measured import Measured
from comparison.prediction import COMPARED, predict_case
from comparison.prediction_text import prediction_text
from comparison.readable import number_from
from comparison.whole_impact.predicted import over_damping
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean

CASES = Path(__file__).resolve().parents[2] / "cases"
K10 = str(CASES / "thesis_K10.toml")
PLAIN = "beam.model=euler_bernoulli"
MESH = ("mesh.kind=uniform", "mesh.element_length=0.016")  # of the rod: coarser than it would be chosen


def case_of(impact: Impact) -> Case:
    return Case(title="", impact=impact, end_time=1.0, mesh=None, tables={})


def agrees(row: dict[str, Any], name: str) -> bool:
    """Within the error bar and 2 % of the theory."""
    found = row["simulation"][name]
    return abs(found["value"] - row[name]) <= found["error"] + 0.02 * abs(row[name])


@pytest.mark.parametrize(
    ("kappa", "damping", "loads"),
    [
        (0.5, 0.0, {"acceleration": 20.0}),
        pytest.param(0.5, 1e-4, {"acceleration": 20.0}, marks=pytest.mark.verify),
        (2.0, 1e-3, {"acceleration": 5.0, "curvature_rate": 1.0}),
    ],
)
def test_theory_and_simulation_agree_before_reflections(kappa: float, damping: float, loads: dict[str, float]) -> None:
    impact = Impact.whole_beam(kappa, relative_damping=damping).replace(**loads)
    told: list[float] = []
    found = predict_case(case_of(impact), [1e-5, 2e-3, 4e-3], whole=False, progress=told.append)
    first, early, late = found["times"]
    assert first["valid"] and agrees(first, "impulse")
    # a damped zone has no closed form once it spreads, and leaves no trace of its damping after a while
    assert early["valid"] == late["valid"] == (damping == 0.0 or kappa > 1.0)
    assert all(agrees(early, name) for name in ("half_contact_length", "reaction", "impulse"))
    assert agrees(late, "impulse") and agrees(late, "half_contact_length") and agrees(late, "reaction")
    assert all(set(row["simulation"]) == set(COMPARED) - {"peak_stress"} for row in found["times"])
    assert found["agreement"]["from"] < 6e-4 and 1.9e-3 < found["agreement"]["until"] <= 4e-3
    assert told == sorted(told) and told[-1] == pytest.approx(1.0)


def test_a_rod_s_whole_impact_is_the_map_s_and_under_its_weight_a_simulation_s(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("comparison.whole_impact.predicted.DAMPING_RATIOS", (0.002,))
    (tmp_path / "rod.toml").write_text(ROD)
    free, heavy, undamped = (
        predict_case(load_case(tmp_path / "rod.toml", [*one, *MESH]), [1e-4, 1e-3], theory_only="9.81" not in one[0])
        for one in (["impact.gravity=0.0", PLAIN], ["impact.gravity=9.81"], ["beam.damping_ratio=0.0", PLAIN])
    )
    assert free["whole_impact"]["source"] == undamped["whole_impact"]["source"] == "stored map"
    assert heavy["whole_impact"]["source"] == "simulation"
    restitution = heavy["whole_impact"]["restitution"]
    assert restitution["value"] == pytest.approx(0.632, abs=1e-3) and restitution["error"] < 1e-2
    band = undamped["whole_impact"]["restitution"]
    assert band["value"] is None and band["band"]["mean"] == pytest.approx(0.6, abs=0.1)
    stresses = [row["simulation"]["peak_stress"]["value"] for row in heavy["times"]]
    whole = heavy["whole_impact"]["peak_stress"]["value"]
    assert stresses[0] < stresses[1] < whole == pytest.approx(165e6, rel=0.02)
    text = prediction_text(heavy)
    documents = heavy["times"][-1]["simulation"], heavy["whole_impact"]
    first, last = (number_from(found["peak_stress"]).scaled(1e-6) for found in documents)
    assert "Largest stress, MPa:" in text and f"until 1 ms (simulation): {first}" in text
    assert f"of the whole impact (simulation): {last}" in text and "at 0.2 %" in text
    assert "coefficient of restitution 0.63" in text and "reflections from the beam's ends arrive" in text
    assert "band of 24 runs" in prediction_text(undamped) and "below yield" not in text
    assert json.loads(json.dumps(heavy, allow_nan=False)) == heavy


def test_theory_only_simulates_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("simulate", "simulate_to_separation"):
        monkeypatch.setattr(HermiteFE, name, lambda *_, **__: pytest.fail("it simulates"))
    pipe = str(CASES / "drill_pipe.toml")
    found = answered("predict", pipe, "--time", "0.005", "--time", "0.01", "--theory-only")
    one, other = found["times"]
    assert one["impulse"] < other["impulse"] and 3.5 < other["half_contact_length"] < 4.0 and other["valid"]
    assert found["agreement"] is None and "simulation" not in one
    assert found["whole_impact"] is None  # the map has no shear
    assert answered("predict", pipe, "--theory-only", "--set", PLAIN)["whole_impact"]["source"] == "stored map"
    loaded = answered("predict", pipe, "--theory-only", "--set", "impact.acceleration=1.0")
    assert loaded["whole_impact"] is None


def test_at_its_own_damping_the_range_of_damping_has_the_number_of_the_run_itself() -> None:
    """No second run, on other elements, beside it: ζ = 1 % of the first mode is the middle row."""
    impact = Impact.whole_beam(0.75, relative_damping=0.01 * LOWEST_PERIOD / math.pi).replace(acceleration=0.1)
    own = Measured(1.4, 1e-3)
    assert [row["peak_moment"] for row in over_damping(impact, None, None, own)] == [own.to_dict()]
    assert over_damping(impact.replace(damping=1.1 * impact.damping), None, None, own) == []  # no method to run with


def test_the_tables_of_the_case_are_those_of_the_simulation(monkeypatch: pytest.MonkeyPatch) -> None:
    used, simulate = [], HermiteFE.simulate

    def recorded(method: HermiteFE, *given: Any, **named: Any) -> Any:
        used.append(method.integrator)
        return simulate(method, *given, **named)

    monkeypatch.setattr(HermiteFE, "simulate", recorded)
    monkeypatch.setattr("comparison.whole_impact.predicted.LONGEST", 0.005)  # nor is it here
    tables = ("integrator.kind=moreau_jean", "integrator.theta=0.6", "refine=0.25")
    answered("predict", K10, "--time", "1e-5", *(word for one in tables for word in ("--set", f"hermite.{one}")))
    assert len(used) >= 2 and all(isinstance(one, MoreauJean) and one.theta == 0.6 for one in used)
    assert "hermite.integrator.kind" in refused(
        "predict", K10, "--theory-only", "--set", "hermite.integrator.kind=nonsense"
    )


@pytest.mark.parametrize("time", ["-1", "nan", "1e300"])
def test_an_impossible_time_is_laid_to_its_option(time: str) -> None:
    assert refused("predict", K10, "--time", time).startswith("error: --time: ")
