"""``bentbeam problem``, ``score`` and ``benchmark`` as they are called."""

import json
import tomllib

import numpy as np
import pytest
from called import answered, command, refused

from tests.open_benchmark.exact import written


def test_a_problem_is_written_in_the_language_of_its_file_and_not_over_what_is_there(tmp_path):
    for name, read in (("p.json", json.loads), ("p.toml", tomllib.loads)):
        asked = ("problem", "point-2", "--out", tmp_path / name)
        assert command(*asked)[0] == 0 and "exists already" in refused(*asked)
        assert read((tmp_path / name).read_text())["id"] == "point-2"
    refused("problem", "leading-2")


def test_score_prints_one_document_and_a_list_of_several(tmp_path):
    files = [str(written(tmp_path, 2.0, f"{k}.npz", metadata=json.dumps({"seconds": float(k)}))) for k in (3, 1, 2)]
    document = answered("score", files[0])
    assert document["outcome"] == "completed" and document["diagnosis"] == []
    assert [one["name"] for one in document["symptoms"]] == ["too_smooth"], "no solver is that smooth"
    assert {"penetration", "momentum", "distribution"} <= document["not_told"].keys()
    assert document["r0"] == pytest.approx({"value": 1.0, "error": 0.0, "theory": 1.0}, abs=1e-3)
    assert {document[name] for name in ("lambda1", "r1")} == {None}
    assert [one["metadata"]["seconds"] for one in answered("score", *files)["results"]] == [3.0, 1.0, 2.0]


def test_a_result_that_cannot_be_read_is_exit_code_2_and_no_score(tmp_path):
    code, out, err = command("score", written(tmp_path, J=np.full(400, np.nan)), "--json")
    assert code == 2 and err.count("\n") == 1 and "J[0] is nan" in err
    document = json.loads(out)
    assert document["outcome"] == "invalid" and document["r0"] is None and document["diagnosis"] == []


def test_benchmark_writes_a_page_for_an_adapter_of_ones_own(tmp_path):
    exact, file, out = written(tmp_path, 2.0, "exact.npz"), tmp_path / "mine.py", tmp_path / "out"
    file.write_text(f"import shutil, sys; shutil.copy({str(exact)!r}, sys.argv[2])")
    document = answered("benchmark", "--adapter", file, "--problem", "point-2", "--out", out, "--seconds", 9)
    # besides the problem that is asked, one like it is drawn, which a copied answer does not fit
    assert [row["outcome"] for row in document["rows"]] == ["completed"] * 3 + ["invalid"] * 3
    assert {row["table"] for row in document["rows"]} == {"self-declared"} and document["seed"] >= 0
    assert (out / "index.html").read_text().count("<h2") >= 3 and json.loads((out / "benchmark.json").read_text())
    refused("benchmark", "--solver", "nothing")
    refused("benchmark", "--install", "nothing")
