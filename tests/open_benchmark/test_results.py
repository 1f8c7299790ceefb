"""What a result file may hold, and what is said of one that holds something else."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from bent_beam import Impact
from bent_beam.meshes import UniformMesh
from bent_beam.method import method_type
from open_benchmark import Result, ResultError, load_result, problem, score
from open_benchmark.result import result_from_history, save_result
from theory import contact_parameters


def exact_fields(kappa: float = 0.5, instants: int = 400) -> dict[str, Any]:
    """The theory's own J and Jm: what a perfect code hands in."""
    found = contact_parameters(kappa)
    tau = np.linspace(0.0, 0.1, instants)
    side = np.sqrt(2.0 / np.pi)
    return {
        "outcome": "completed",
        "problem": f"leading-{kappa:g}",
        "metadata": json.dumps({"tool": "exact"}),
        "tau": tau,
        "J": 4.0 * side * found.r0 * np.sqrt(tau),
        "Jm": side * found.r0 * found.lambda0 * tau,
    }


def written(tmp_path: Path, **changes: Any) -> Path:
    fields = {**exact_fields(), **changes}
    file = tmp_path / "result.npz"
    np.savez(file, **{name: value for name, value in fields.items() if value is not None})
    return file


@pytest.mark.parametrize("kappa", [0.05, 0.37, 0.8])
def test_the_exact_impulse_and_moment_give_lambda0_and_r0_to_rounding(tmp_path: Path, kappa: float) -> None:
    found = score(load_result(written(tmp_path, **exact_fields(kappa))))
    assert found.outcome == "completed"
    assert abs(found.error("lambda0") or 1.0) < 1e-9 and abs(found.error("r0") or 1.0) < 1e-9


def test_what_is_not_reported_is_null_and_never_zero(tmp_path: Path) -> None:
    document = score(load_result(written(tmp_path))).to_dict()
    assert [document[name] for name in ("lift", "penetration", "adhesion", "energy")] == [None] * 4
    assert document["lambda1"] is None and document["r1"] is None


def test_scoring_a_saved_result_again_gives_the_same_bits(tmp_path: Path) -> None:
    noise = np.random.default_rng(5).normal(0.0, 1e-3, 400)
    first = load_result(written(tmp_path, J=exact_fields()["J"] + noise))
    save_result(tmp_path / "again.npz", first)
    texts = [json.dumps(score(r).to_dict()) for r in (first, load_result(tmp_path / "again.npz"))]
    assert texts[0] == texts[1]


def test_csv_beside_json_scores_like_npz(tmp_path: Path) -> None:
    fields = exact_fields()
    table = np.column_stack([fields[n] for n in ("tau", "J", "Jm")])
    lines = ["tau,J,Jm", *(",".join(repr(float(v)) for v in row) for row in table)]
    (tmp_path / "run.csv").write_text("\n".join(lines))
    (tmp_path / "run.json").write_text(json.dumps({n: fields[n] for n in ("outcome", "problem")} | {"metadata": {}}))
    from_csv = score(load_result(tmp_path / "run.csv")).to_dict()
    from_npz = score(load_result(written(tmp_path, metadata="{}"))).to_dict()
    assert from_csv == from_npz


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"J": None}, "J is missing"),
        ({"outcome": None}, "outcome is missing"),
        ({"outcome": "finished"}, "outcome must be one of"),
        ({"problem": "leading-x"}, "problem: 'leading-x' is not the id"),
        ({"problem": "leading-1.5"}, "K must be below 1"),
        ({"metadata": "{"}, "metadata is not JSON"),
        ({"metadata": "[1]"}, "metadata must hold one JSON object"),
        ({"metadata": '{"tool": "\\ud800"}'}, "metadata holds characters that are not text"),
        ({"outcome": "crashed(\x1b[31m)"}, "outcome holds characters that are not text"),
        ({"J": np.zeros(17)}, "J holds 17 values for 400 instants"),
        ({"J": np.zeros((400, 2))}, "J must have one dimension"),
        ({"J": np.full(400, np.nan)}, "J[0] is nan"),
        ({"Jm": np.full(400, np.inf)}, "Jm[0] is inf"),
        ({"J": np.array(["a"] * 400)}, "J must hold numbers"),
        ({"J": np.zeros(400, complex)}, "J must hold numbers"),
        ({"tau": np.linspace(0.1, 0.0, 400)}, "tau must increase"),
        ({"tau": np.linspace(0.0, 0.05, 400)}, "tau ends at 0.05"),
        ({"tau": np.r_[np.linspace(0, 0.009, 300), np.linspace(0.01, 0.1, 100)]}, "instants in the fit window"),
        ({"J_mnus": np.zeros(400)}, "'J_mnus' is not a field of a result (did you mean J_minus?)"),
        ({"J_minus": -np.ones(400)}, "J_minus is the size of the tensile impulse"),
        ({"x": np.zeros(3)}, "snap_tau is missing next to x"),
        ({"x": np.zeros(3), "snap_tau": np.zeros(2), "snap_gap": np.zeros((3, 2))}, "must have shape (2, points)"),
        ({"x": np.zeros(0), "snap_tau": np.ones(1), "snap_gap": np.zeros((1, 0))}, "snap_gap is empty"),
        ({"x": np.zeros(1), "snap_tau": -np.ones(1), "snap_gap": np.zeros((1, 1))}, "snap_tau must not be negative"),
    ],
)
def test_a_malformed_result_gets_one_line_naming_the_field(tmp_path: Path, changes: dict[str, Any], words: str) -> None:
    with pytest.raises(ResultError) as error:
        load_result(written(tmp_path, **changes))
    assert words in str(error.value) and "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("table", "about", "words"),
    [
        ("tau,J,Jm\n0,zero,0\n", "{}", "run.csv, line 2: J is not a number (got 'zero')"),
        ("this is a letter\n", "{}", "run.csv: 'this is a letter' is not a column"),
        ("tau,J,Jm\n0,0\n", "{}", "run.csv, line 2: 2 values for 3 columns"),
        (b"tau,J,Jm\n\xff", "{}", "run.csv is not UTF-8 text"),
        ("tau,J,Jm\n", "[1, 2]", "run.json must hold one JSON object"),
        ("tau,J,Jm\n", "[" * 20_000, "run.json is not JSON"),
        ("tau,J,Jm\n", '{"J": [1, 2]}', "run.json: 'J' is not a field of a result"),
        ("tau,J,Jm\n", '{"outcome": ["completed"]}', "outcome must be a text"),
        (
            "tau,J,Jm\n",
            '{"outcome": "completed", "problem": "point-2", "metadata": [1]}',
            "metadata must hold one JSON",
        ),
        ("tau,J,Jm\n", '{"outcome": "completed", "problem": "point-2", "metadata": {}}', "tau is empty"),
    ],
)
def test_a_malformed_table_gets_one_line_naming_the_file_once_and_the_field(
    tmp_path: Path, table: str | bytes, about: str, words: str
) -> None:
    (tmp_path / "run.csv").write_bytes(table if isinstance(table, bytes) else table.encode())
    (tmp_path / "run.json").write_text(about)
    with pytest.raises(ResultError) as error:
        load_result(tmp_path / "run.csv")
    said = str(error.value)
    assert words in said and "\n" not in said and said.count("run.csv") <= 1


@pytest.mark.parametrize("step", [0.0, -1.0, 10**400, None, "short", [1.0]])
def test_metadata_that_says_nothing_of_the_steps_is_no_error(tmp_path: Path, step: object) -> None:
    text = json.dumps({"seconds": step, "model": {"time_step": step}})
    found = score(load_result(written(tmp_path, metadata=text)))
    assert found.outcome == "completed" and found.seconds is None


def test_a_wall_that_never_pushes_is_invalid_and_not_scored(tmp_path: Path) -> None:
    found = score(load_result(written(tmp_path, J=np.zeros(400))))
    assert found.outcome == "invalid" and found.measured == {} and "J and Jm" in str(found.reason)


class _Bomb:
    def __reduce__(self) -> tuple[Any, tuple[Any, ...]]:
        return (Path.touch, (Path("pwned"),))


def test_a_pickle_in_a_result_is_refused_and_never_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ResultError, match="J cannot be read"):
        load_result(written(tmp_path, J=np.array([_Bomb()] * 400, dtype=object)))
    (tmp_path / "raw.npz").write_bytes(pickle.dumps(_Bomb()))
    with pytest.raises(ResultError, match="not a readable NPZ"):
        load_result(tmp_path / "raw.npz")
    assert not (tmp_path / "pwned").exists()


@pytest.mark.parametrize("keep", [0, 10, 500, 2000])
def test_a_torn_file_is_one_line(tmp_path: Path, keep: int) -> None:
    file = written(tmp_path)
    file.write_bytes(file.read_bytes()[:keep])
    with pytest.raises(ResultError) as error:
        load_result(file)
    assert "\n" not in str(error.value)


def test_an_outcome_without_numbers_is_kept_with_its_reason(tmp_path: Path) -> None:
    file = tmp_path / "none.npz"
    np.savez(file, outcome="unsupported(no axial force)", problem="leading-0.5", metadata="{}")
    found = score(load_result(file))
    assert found.outcome == "unsupported(no axial force)" and found.measured == {}


def test_a_wall_that_pulls_is_called_adhesive(tmp_path: Path) -> None:
    pulled = 0.03 * exact_fields()["J"]
    found = score(load_result(written(tmp_path, J_minus=pulled)))
    assert found.outcome == "completed, adhesive" and found.adhesion == pytest.approx(0.03)


@pytest.mark.parametrize("net", [-1.0, 0.0])
def test_a_wall_that_pulls_more_than_it_pushes_is_adhesive_too(net: float) -> None:
    asked = problem("stopped-beam")
    tau = np.linspace(0.0, asked.end_time, 400)
    pushed, pulled = np.minimum(tau / tau[-1], 0.5), np.maximum(tau / tau[-1] - 0.5, 0.0) * (1.0 - 2.0 * net)
    found = score(Result("completed", "", asked, {}, tau, pushed - pulled, series={"J_minus": pulled}))
    assert found.outcome == "completed, adhesive"
    assert found.adhesion == pytest.approx(1.5 if net else 1.0, rel=1e-2)


def test_gaps_in_the_zone_and_penetration_are_measured_over_the_way_travelled(tmp_path: Path) -> None:
    x = np.linspace(0.0, 2.0, 401)
    front = contact_parameters(0.5).lambda0 * np.sqrt(0.05)
    gap = np.where(x < front, 0.002 * 0.05, (x - front) ** 2)
    gap[0] = -0.02 * 0.05
    found = score(load_result(written(tmp_path, x=x, snap_tau=np.array([0.05]), snap_gap=gap[None, :])))
    assert found.lift == pytest.approx(0.002) and found.penetration == pytest.approx(0.02)
    assert found.outcome == "completed, leaky"


def test_first_order_numbers_need_the_base_they_belong_to(tmp_path: Path) -> None:
    asked = problem("first-0.5-1-1-1")
    exact = contact_parameters(0.5, 1.0, 1.0, 1.0)
    fields = exact_fields()
    tau, side, eps = fields["tau"], np.sqrt(2.0 / np.pi), asked.epsilon
    load = asked.uniform_load
    base = Result("completed", "", problem("leading-0.5"), {}, tau, fields["J"], fields["Jm"])
    loaded = Result(
        "completed",
        "",
        asked,
        {},
        tau,
        fields["J"] + 4.0 * side * eps * exact.r1 * tau**1.5 / 3.0 + 4.0 / 3.0 * load * exact.lambda0 * tau**1.5,
        fields["Jm"]
        + side * (exact.r0 * exact.lambda1 + exact.r1 * exact.lambda0) * eps * tau**2 / 2.0
        + load * exact.lambda0**2 * tau**2 / 4.0,
    )
    found = score(loaded, base)
    assert abs(found.error("lambda1") or 1.0) < 1e-4 and abs(found.error("r1") or 1.0) < 1e-4
    assert "lambda1" not in score(loaded).measured
    with pytest.raises(ResultError, match="is not the base"):
        score(loaded, loaded)


def test_a_window_that_grows_with_the_contact_is_not_said_to_gain_energy() -> None:
    history = method_type("self_similar")().simulate(Impact.dimensionless(0.5), end_time=0.1, save=60)
    found = score(result_from_history(history))
    assert found.energy is None and [finding.name for finding in found.diagnosis] == ["clean"]


@pytest.mark.parametrize(
    ("name", "value"), [("damping", 0.001), ("rotation", 0.001), ("first_touch", 0.001), ("opposite_wall", 1.0)]
)
def test_a_history_of_another_impact_than_the_exact_solution_s_is_refused(name: str, value: float) -> None:
    impact = Impact.whole_beam(0.5).replace(**{name: value})
    method = method_type("hermite")(mesh=UniformMesh(element_length=0.1))  # type: ignore[call-arg]
    history = method.simulate(impact, end_time=1e-3, save=4)
    with pytest.raises(ResultError, match=f"{name} is {value:g}"):
        result_from_history(history)
