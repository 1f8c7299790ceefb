"""The guide's method of one's own is a package outside the project that every command finds by its entry point."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from called import answered, command
from fences import snippet
from here import CASES

from bent_beam import method

PAGE = "guide/add-method.md"


@pytest.fixture(autouse=True)
def installed(own_folder: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The package of the page: its module and what a wheel says of it."""
    (own_folder / "differences.py").write_text(snippet(PAGE, 'title="differences.py"'), encoding="utf-8")
    (about := own_folder / "differences-1.0.dist-info").mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: differences\nVersion: 1.0\n")
    group, line = re.findall(r'entry-points\."(.+)"\]\n(.+)', snippet(PAGE, "entry-points"))[0]
    (about / "entry_points.txt").write_text(f"[{group}]\n{line.replace(chr(34), '')}\n")
    monkeypatch.syspath_prepend(own_folder)
    method._found.cache_clear()
    yield
    method._found.cache_clear()


def test_match_holds_the_method_of_the_page_s_list_against_theory_with_a_row_for_each_resolution() -> None:
    Path("mine.toml").write_text(snippet(PAGE, 'label = "Finite differences, fine"'), encoding="utf-8")
    rows = answered("match", "--methods", "mine.toml", "--kappa-over-nu", "0.5", "--refine", "0.25,0.5")["rows"]
    assert [(row["label"], row["refine"]) for row in rows] == [("Finite differences, fine", r) for r in (0.25, 0.5)]
    assert rows[0]["path"] == "differences" and rows[0]["steps"] < rows[1]["steps"]
    for found in (row[name] for row in rows for name in ("lambda0", "r0")):
        assert found["value"] == pytest.approx(found["theory"], rel=0.02) and found["error"] > 0.0


def test_simulate_takes_its_settings() -> None:
    words = ("--path", "differences", "--set", "differences.nodes=60", "--out", "mine.nc")
    found = answered("simulate", CASES / "thesis_K10.toml", *words)
    assert Path("mine.nc").exists() and found["total_impulse"] is not None


def test_settings_and_completion_name_it(monkeypatch: pytest.MonkeyPatch) -> None:
    found = {(s["table"], s["name"]): s["default"] for s in answered("settings")}
    assert found["differences", "nodes"] == "100" and found["differences", "steps"] == "400"
    typed = {"_BENTBEAM_COMPLETE": "complete_bash", "COMP_CWORD": "3", "COMP_WORDS": "bentbeam match --path diff"}
    for name, value in typed.items():
        monkeypatch.setenv(name, value)
    assert command()[:2] == (0, "differences\n")
