"""The predictor as a file: complete in itself, small, and told apart from what it stands in."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from comparison.command_line.app import run
from comparison.predictor import page, panel, write_page


def test_page_is_one_small_file_that_asks_for_nothing(tmp_path: Path) -> None:
    file = write_page(tmp_path / "new" / "predictor.html")
    text = file.read_text(encoding="utf-8")
    assert text == page()
    assert file.stat().st_size < 1_000_000
    addresses = set(re.findall(r"https?://[^\s\"'<>]+", text))
    assert addresses == {"http://www.w3.org/2000/svg"}  # the name of a namespace, no request
    asks = r"<(?:script|img|iframe)[^>]*\ssrc=|<link[^>]*href=\"(?!data:)|@import|fetch\(|XMLHttpRequest|import\("
    assert not re.search(asks, text)


def test_panel_keeps_its_style_to_itself() -> None:
    style = re.sub(r"@media[^{]*\{|/\*.*?\*/", "", panel().style)
    selectors = [s.strip() for block in re.findall(r"([^{}]+)\{", style) for s in block.split(",")]
    assert [s for s in selectors if not s.startswith(("#predictor", ":root"))] == []


@pytest.mark.skipif(shutil.which("node") is None, reason="Node.js is not installed")
@pytest.mark.parametrize("name", ["theory.js", "beam.js", "case.js", "view.js"])
def test_scripts_parse(name: str) -> None:
    file = Path(__file__).parents[2] / "comparison" / "predictor" / "templates" / name
    subprocess.run(["node", "--check", str(file)], check=True, capture_output=True)


def test_the_page_of_the_guide_is_what_the_command_writes() -> None:
    shipped = Path(__file__).parents[2] / "docs" / "predictor.html"
    current = shipped.read_text(encoding="utf-8") == page()
    assert current, "python -m comparison.command_line predictor --out docs/predictor.html --overwrite"


def test_command_writes_the_page_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mine.html"
    assert run(["predictor", "--out", str(file)]) == 0
    assert file.read_text(encoding="utf-8") == page()
    assert str(file) in capsys.readouterr().out
    assert run(["predictor", "--out", str(file)]) == 2
    assert "overwrite" in capsys.readouterr().err
    assert run(["predictor", "--out", str(file), "--overwrite"]) == 0
