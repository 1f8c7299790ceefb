"""Programs of the guide, taken from its pages: an adapter that is scored first time, and Exudyn's reproducer."""

import re
import subprocess
import sys

import pytest
from fences import snippet

from bent_beam_programs.open_benchmark.adapter import Adapter
from bent_beam_programs.open_benchmark.campaign import campaign
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.running import Limits
from bent_beam_programs.open_benchmark.score import score

PAGE = "guide/enter.md"


def test_the_sixty_lines_converge(tmp_path):
    source = snippet(PAGE, 'title="mine.py"')
    assert len([line for line in source.splitlines() if line.strip()]) <= 60
    assert not re.search(r"import (?!json|sys|time|tomllib|numpy)", source)
    file = tmp_path / "mine.py"
    file.write_text(source)
    mine = Adapter("mine", file, resolutions=("coarse", "medium"))
    rows = campaign([mine], ["leading-0.5"], tmp_path / "out", limits=Limits(repeats=1))
    coarse, medium = (row.score for row in rows)
    for name in ("lambda0", "r0"):
        assert abs(medium.error(name) or 1.0) < min(abs(coarse.error(name) or 1.0), 5e-3)
    assert [finding.name for finding in medium.diagnosis] == ["clean"]


def test_a_table_is_scored(tmp_path):
    subprocess.run([sys.executable, "-c", snippet(PAGE, 'title="from_table.py"')], cwd=tmp_path, check=True)
    found = score(load_result(tmp_path / "result.csv"))
    assert found.outcome == "completed" and found.error("r0") == pytest.approx(0.0, abs=1e-9)


def test_capturing_steps_use_up_their_repetitions_and_do_not_with_the_fix():
    """The reproducer for Exudyn's authors: short, on its own, and it still shows what the page says."""
    space = {"__name__": "reproducer"}
    exec(snippet("exudyn_contact_state.md", "contact_state.py"), space)
    run = space["run"]
    (steps, before, exhausted, _), (again, after, left, contradictory) = run(False), run(True)
    assert steps == again == 400
    assert exhausted > 20 and left == 0 and contradictory == 0
    assert after < 0.5 * before
