"""The guide's method of one's own is a package outside the project that every command finds by its entry point."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "guide" / "add-method.md"


def fence(start: str) -> str:
    found = re.search(rf"^```{re.escape(start)}\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.S | re.M)
    assert found is not None, start
    return found[1]


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """Where the package of the page is installed: its module and what a wheel says of it."""
    folder = tmp_path_factory.mktemp("site")
    (folder / "differences.py").write_text(fence('python title="differences.py"'), encoding="utf-8")
    about = folder / "differences-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: differences\nVersion: 1.0\n")
    group, line = re.findall(r'entry-points\."(.+)"\]\n(.+)', PAGE.read_text(encoding="utf-8"))[0]
    (about / "entry_points.txt").write_text(f"[{group}]\n{line.replace(chr(34), '')}\n")
    paths = os.pathsep.join([str(folder), str(ROOT)])
    return {**os.environ, "PYTHONPATH": paths, "BENTBEAM_STORE": str(folder / "store")}


def bentbeam(environment: dict[str, str], *words: str) -> Any:
    command = [sys.executable, "-m", "comparison.command_line", *words]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, cwd=ROOT, timeout=300)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_match_holds_a_method_from_outside_against_theory(environment: dict[str, str]) -> None:
    arguments = ("--path", "differences", "--kappa-over-nu", "0.5", "--json")
    row = bentbeam(environment, "match", *arguments)["rows"][0]
    assert row["path"] == "differences" and row["label"] == "Finite differences"
    for name in ("lambda0", "r0"):
        assert row[name]["value"] == pytest.approx(row[name]["theory"], rel=0.03)
        assert row[name]["error"] > 0.0


def test_simulate_takes_its_settings_and_refusals(environment: dict[str, str], tmp_path: Path) -> None:
    file = tmp_path / "mine.nc"
    arguments = ("--path", "differences", "--set", "differences.nodes=60", "--out", str(file), "--json")
    found = bentbeam(environment, "simulate", "cases/thesis_K10.toml", *arguments)
    assert file.exists() and found["total_impulse"] is not None


def python(environment: dict[str, str], code: str, *words: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", code, *words], env=environment, capture_output=True, text=True, cwd=ROOT, timeout=200
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def methods_file(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The list of methods of the page."""
    file = tmp_path_factory.mktemp("lists") / "mine.toml"
    file.write_text(fence("toml\n[[method]]").join(["[[method]]\n", ""]), encoding="utf-8")
    return str(file)


LABEL = "Finite differences, fine"


@pytest.mark.verify
def test_refine_gives_a_row_for_each_resolution(environment: dict[str, str], methods_file: str, tmp_path: Path) -> None:
    arguments = ("--methods", methods_file, "--kappa-over-nu", "0.5", "--refine", "0.25,0.5", "--out", str(tmp_path))
    rows = bentbeam(environment, "match", *arguments, "--json")["rows"]
    assert [(row["label"], row["refine"]) for row in rows] == [(LABEL, 0.25), (LABEL, 0.5)]
    assert all(row["r0"]["value"] == pytest.approx(row["r0"]["theory"], rel=0.02) for row in rows)
    assert rows[0]["steps"] < rows[1]["steps"]
    assert (tmp_path / "work-precision.png").exists() and LABEL in (tmp_path / "match.csv").read_text()


def test_settings_and_completion_name_it(environment: dict[str, str]) -> None:
    found = {(s["table"], s["name"]): s["default"] for s in bentbeam(environment, "settings", "--json")}
    assert found["differences", "nodes"] == "100" and found["differences", "steps"] == "400"
    typed = {"_BENTBEAM_COMPLETE": "complete_bash", "COMP_CWORD": "3"}
    asked = {**environment, **typed, "COMP_WORDS": "bentbeam match --path diff"}
    code = "from comparison.command_line.app import main; main()"
    assert python(asked, code).split() == ["differences"]
