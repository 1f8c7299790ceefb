"""A sweep: rows are what ``bounce`` says of each case, kept as they are finished, whatever happens to the command."""

import json

import numpy as np
import pytest
import xarray
from called import answered, command
from histories import rod

from bent_beam.cases import load_case, read_toml
from bent_beam.errors import InputError
from bent_beam.measure.numbers import Band, Number
from comparison import bounce, predict, sweep
from comparison.sweeping import NAMES, Row, SweepTable, cases_of, varied_from
from hermite_fe import HermiteFE


@pytest.fixture
def case(tmp_path):
    return rod(tmp_path, element=0.1)


def test_rows_are_the_numbers_of_bounce_and_are_kept(case, tmp_path, monkeypatch):
    monkeypatch.setenv("BENTBEAM_STORE", str(tmp_path / "store"))
    words = ("sweep", case, "--jobs", 1, "--vary", "impact.velocity=1:2:2", "--vary", "beam.damping_ratio=0.01,0.02")
    found = answered(*words, "--out", tmp_path / "out")
    assert [tuple(row["varied"].values()) for row in found["rows"]] == [(1, 0.01), (1, 0.02), (2, 0.01), (2, 0.02)]
    assert found["kept"] == 0 and found["failures"] == []
    settings = ["impact.velocity=2.0", "beam.damping_ratio=0.02"]
    whole, row = answered("bounce", case, "--set", settings[0], "--set", settings[1]), found["rows"][-1]
    for name in NAMES:
        of_bounce = whole["si"].get(name) or whole.get(name)
        both = [number and (number["value"], number["error"]) for number in (row[name], of_bounce)]
        assert both[0] == both[1], name
    grid = xarray.open_dataset(tmp_path / "out" / "sweep.nc", engine="h5netcdf")
    assert float(grid["restitution"].sel(row["varied"])) == row["restitution"]["value"]
    lines = (tmp_path / "out" / "sweep.csv").read_text().splitlines()
    assert len(lines) == 5 and lines[0].startswith("impact.velocity,beam.damping_ratio,kappa_over_nu")
    assert {file.suffix for file in (tmp_path / "out").iterdir()} == {".csv", ".json", ".nc", ".png"}
    fast = load_case(case, settings)
    predicted = predict(fast)
    for name in ("simulate", "simulate_to_separation"):
        monkeypatch.setattr(HermiteFE, name, lambda *a, **k: pytest.fail("it ran"))
    assert bounce(fast).runs.kept and predict(fast).to_dict() == predicted.to_dict()
    for ask in (bounce, predict, lambda _, fresh: sweep(case, {"beam.damping_ratio": [0.02]}, fresh=fresh)):
        with pytest.raises(pytest.fail.Exception, match="it ran"):
            ask(fast, fresh=True)
    again = sweep(case, {"impact.velocity": [1.0, 2.0], "beam.damping_ratio": "0.01,0.02"})
    assert again.kept == 4 and json.loads(json.dumps(again.to_dict()["rows"])) == found["rows"]
    assert again.units == {"impact.velocity": "m/s", "beam.damping_ratio": ""}
    assert [line.split()[:2] for line in str(again).splitlines()[2:4]] == [["1", "0.01"], ["1", "0.02"]]
    assert again.table["restitution"].tolist() == [one["restitution"]["value"] for one in found["rows"]]


def test_a_row_that_cannot_be_is_a_row_with_its_reason(case, monkeypatch):
    found = answered("sweep", case, "--jobs", 1, "--vary", "beam.damping_ratio=-1,0.01")
    bad, good = found["rows"]
    assert bad["refused"] and "damping" in bad["reason"] and bad["restitution"] is None
    assert good["restitution"]["value"] is not None and found["failures"] == []
    monkeypatch.setattr(HermiteFE, "simulate_to_separation", lambda *a, **k: 1 / 0)
    code, out, err = command("sweep", case, "--jobs", 1, "--vary", "beam.damping_ratio=0.03,0.04", "--json", "--fresh")
    assert code == 3 and err.count("\n") == 2 and "beam.damping_ratio = 0.03: the method failed" in err
    assert len(json.loads(out)["failures"]) == 2


def test_between_two_walls_a_row_is_what_predict_would_say_at_the_end_time(case):
    words = ("--set", "wall.opposite=0.01", "--set", "run.end_time=0.002")
    (row,) = answered("sweep", case, "--jobs", 1, "--vary", "impact.velocity=1", *words)["rows"]
    run = answered("simulate", case, *words, "--set", "impact.velocity=1.0")
    assert row["until"] == 0.002 and row["restitution"] is None
    assert (row["peak_moment"]["value"], row["peak_moment"]["error"]) == (run["peak_moment"], run["peak_moment_error"])


def test_a_table_says_a_sentence_once_with_its_rows_and_a_grid_is_in_si():
    known = {"last_contact": Number(0.02, 0.001), "peak_force": Band(2e3, 40.0, 24), "restitution": Number(0.5, 0.2)}
    rows = [
        Row({"impact.velocity": 1.0}, numbers=known, until=2e-3, warnings=["all", "one"], kept=True),
        Row({"impact.velocity": 2.0}, numbers=known, until=4e-3, warnings=["all", "two"], kept=True),
        Row({"impact.velocity": 3.0}, warnings=["all", "two"], reason="stopped"),
    ]
    table = SweepTable("", "hermite", {"impact.velocity": [1.0, 2.0, 3.0]}, rows)
    lines, speed = str(table).splitlines(), "impact.velocity = "
    assert {"warning: all (all rows)", f"warning: one ({speed}1)", f"no numbers: stopped ({speed}3)",
            f"warning: two (2 rows, the first at {speed}2)"} <= {*lines}  # fmt: skip
    assert "2 of 3 rows came from the store" in str(table) and "a band is mean" in str(table)
    assert "end time, 2 ms to 4 ms." in str(table) and "largest force, kN" in lines[0]
    assert "2.00 ± 0.04 (band of 24 runs)" in lines[2] and "20.0 ± 1.0" in lines[2]
    grid = table.to_dataset()
    for name, (value, unit) in {"last_contact": (0.02, "s"), "last_contact_error": (0.001, "s"),
                                "peak_force_std": (40.0, "N"), "restitution": (0.5, "1")}.items():  # fmt: skip
        assert grid[name].attrs["units"] == unit
        assert grid[name].values == pytest.approx([value, value, np.nan], nan_ok=True)


def test_a_key_has_an_effect_by_what_a_row_depends_on(case):
    tables = read_toml(case, "case file")
    tables["beam"].pop("damping_ratio")
    given = {"impact.velocity": [1.0, 2.0], "beam.damping": [None, 0.0], "section.yield_stress": [2e8, 3e8]}
    given |= {"mesh.element_length": [0.05, 0.1], "hermite.refine": [1.0, 2.0], "run.end_time": [0.01, 0.02]}
    assert [len(cases_of(tables, {key: values})) for key, values in given.items()] == 6 * [2]


@pytest.mark.parametrize("speeds", [[1.0], [1.0, 2.0], [1.0, -2.0]])
def test_a_key_without_effect_is_refused_beside_rows_that_are_refused_too(speeds, case):
    tables, asked = read_toml(case, "case file"), {"section.poisson_ratio": [0.2, 0.3], "impact.velocity": speeds}
    assert len(cases_of(tables, asked)) == 2 * len(speeds)
    tables["beam"]["model"] = "euler_bernoulli"
    with pytest.raises(InputError, match=r"section.poisson_ratio has no effect on any row \(got \[0.2, 0.3\]\)"):
        cases_of(tables, asked)


def test_values_are_those_that_one_would_type():
    assert varied_from("a.b=0.1:0.7:7")[1] == [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
    assert varied_from("a.b = 1e-3, 2")[1] == [0.001, 2]
