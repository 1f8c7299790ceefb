"""The adapter of docs/guide/enter.md, taken from the page, is scored first time."""

import re
import subprocess
import sys
from pathlib import Path

from open_benchmark.adapter import chosen_adapters
from open_benchmark.campaign import campaign
from open_benchmark.reading import load_result
from open_benchmark.running import Limits
from open_benchmark.score import score

PAGE = Path(__file__).resolve().parents[2] / "docs" / "guide" / "enter.md"


def snippet(name):
    found = re.search(rf'^```python title="{name}"\n(.*?)^```', PAGE.read_text(), re.S | re.M)
    assert found, name
    return found[1]


def test_the_sixty_lines_converge(tmp_path):
    source = snippet("mine.py")
    assert len([line for line in source.splitlines() if line.strip()]) <= 60
    assert not re.search(r"import (?!json|sys|time|tomllib|numpy)", source)
    file = tmp_path / "mine.py"
    file.write_text(source)
    two, once = ["coarse", "medium"], Limits(repeats=1)
    rows = campaign(chosen_adapters(own=[file]), ["leading-0.5"], tmp_path / "out", resolutions=two, limits=once)
    coarse, medium = (row.score for row in rows)
    assert medium.outcome == "completed"
    for name in ("lambda0", "r0"):
        assert abs(medium.error(name) or 1.0) < min(abs(coarse.error(name) or 1.0), 5e-3)
    assert [finding.name for finding in medium.diagnosis] == ["clean"]


def test_a_table_is_scored(tmp_path):
    subprocess.run([sys.executable, "-c", snippet("from_table.py")], cwd=tmp_path, check=True)
    found = score(load_result(tmp_path / "result.csv"))
    assert found.outcome == "completed" and abs(found.error("r0") or 1.0) < 1e-9
