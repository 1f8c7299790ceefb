"""``bentbeam problem``, ``score`` and ``benchmark`` as they are called."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from comparison.command_line.app import run

POINT = """
import sys, numpy as np
tau = np.linspace(0, 0.1, 300)
np.savez(sys.argv[2], outcome="completed", problem="point-2", metadata='{"seconds": 0.5}',
         tau=tau, J=4 * np.sqrt(2 / np.pi) * np.sqrt(tau), Jm=0 * tau)
"""


def result(file: Path, **changes: object) -> Path:
    tau = np.linspace(0.0, 0.1, 300)
    fields: dict[str, object] = {"outcome": "completed", "problem": "point-2", "metadata": "{}"}
    np.savez(file, **{**fields, "tau": tau, "J": 4 * np.sqrt(2 / np.pi) * np.sqrt(tau), "Jm": 0 * tau, **changes})  # type: ignore[arg-type]
    return file


def test_a_problem_is_written_and_not_over_what_is_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = str(tmp_path / "problem.toml")
    assert run(["problem", "leading-0.5", "--out", out]) == 0
    assert run(["problem", "leading-0.5", "--out", out]) == 2
    assert "exists already" in capsys.readouterr().err
    assert run(["problem", "leading-2"]) == 2


def test_score_prints_one_document(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["score", str(result(tmp_path / "a.npz")), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["outcome"] == "completed" and document["diagnosis"] == ["clean"]
    assert document["r0"] == pytest.approx({"value": 1.0, "error": 0.0, "theory": 1.0}, abs=1e-3)
    assert {document[name] for name in ("lift", "penetration", "adhesion", "lambda1", "r1")} == {None}


def test_several_results_come_with_their_work_precision_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [str(result(tmp_path / f"{k}.npz", metadata=json.dumps({"seconds": float(k)}))) for k in (3, 1, 2)]
    assert run(["score", *files, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert [point["seconds"] for point in document["work_precision"]] == [1.0, 2.0, 3.0]
    assert len(document["results"]) == 3


def test_a_result_that_cannot_be_read_is_exit_code_2_and_no_score(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bad = result(tmp_path / "bad.npz", J=np.full(300, np.nan))
    assert run(["score", str(bad), "--json"]) == 2
    said = capsys.readouterr()
    assert len(said.err.strip().splitlines()) == 1 and "J[0] is nan" in said.err
    document = json.loads(said.out)
    assert document["outcome"] == "invalid" and document["r0"] is None and document["diagnosis"] == []


def test_benchmark_writes_a_page_for_an_adapter_of_ones_own(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mine.py"
    file.write_text(POINT)
    out = tmp_path / "out"
    assert run(["benchmark", "--adapter", str(file), "--problem", "point-2", "--out", str(out), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert [row["outcome"] for row in document["rows"]] == ["completed"] * 3
    assert (out / "index.html").read_text().count("<h2") >= 3 and json.loads((out / "benchmark.json").read_text())
    assert run(["benchmark", "--solver", "nothing"]) == 2
    assert run(["benchmark", "--install", "nothing"]) == 2
