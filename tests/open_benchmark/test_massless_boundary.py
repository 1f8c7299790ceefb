"""The massless-boundary scheme as an adapter: it conserves, and what no impact takes throws the zone off."""

import subprocess
import sys
from pathlib import Path

from bent_beam_programs.open_benchmark.problem import problem, problem_text
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.score import score

ADAPTER = Path(__file__).with_name("massless_boundary.py")


def test_the_scheme_conserves_momentum_and_energy_pulls_nowhere_and_lets_the_zone_rebound(tmp_path):
    (tmp_path / "problem.toml").write_text(problem_text(problem("leading-0.5")))
    words = [sys.executable, str(ADAPTER), "problem.toml", "result.npz", "coarse"]
    subprocess.run(words, cwd=tmp_path, check=True, stdin=subprocess.DEVNULL)
    found = score(load_result(tmp_path / "result.npz"))
    assert abs(found.momentum_residual or 1.0) < 0.01 and found.adhesion == 0.0 and (found.penetration or 0.0) < 0.01
    assert abs((found.energy or {})["lost"] or 1.0) < 0.01
    assert (found.lift or 0.0) > 0.01 and (found.error("r0") or 1.0) < 0.05
