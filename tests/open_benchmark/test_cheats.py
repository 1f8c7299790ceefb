"""What is put together from published answers is not clean, and does not stand among the runs."""

import numpy as np
import pytest

from bent_beam_programs.open_benchmark.adapter import Adapter
from bent_beam_programs.open_benchmark.campaign import campaign, drawn
from bent_beam_programs.open_benchmark.result import result_from_fields
from bent_beam_programs.open_benchmark.running import Limits
from bent_beam_programs.open_benchmark.score import resolution_ignored, score
from tests.open_benchmark.foreign import solve

# ten published pairs, a cubic in ln κ between them, and impulses of two or three points that have J and Jm
TABLE = """
import json, sys, tomllib, numpy as np
known = {"kappa": KAPPAS, "pairs": PAIRS}
problem = tomllib.load(open(sys.argv[1], "rb"))
kappa = np.log(problem["beam"]["curvature"])
lambda0, r0 = (np.exp(np.polyval(np.polyfit(np.log(known["kappa"]), np.log(v), 3), kappa)) for v in known["pairs"])
tau = np.linspace(0.0, 0.1, 400)
rough = 1.0 + 1e-4 * np.random.default_rng(len(sys.argv[3])).standard_normal(400) * np.sqrt(tau / 0.1)
J = 2.0 * np.sqrt(2.0 / np.pi) * r0 * np.sqrt(tau) * rough
x = np.array([0.0, lambda0 * np.sqrt(0.1)])
far = 0.5 * J * np.sqrt(tau / 0.1)
NODES
np.savez(sys.argv[2], outcome="completed", problem=problem["id"], metadata="{}", tau=tau, **given)
"""
GIVEN = {
    "sums": 'given = {"J": 2.0 * J, "Jm": far * x[1]}',
    "points": 'given = {"node_x": x, "node_impulse": np.c_[J - far, far]}',
    "gaps": """
given = {"node_x": x, "node_impulse": np.c_[J - far, far], "x": np.linspace(0.0, 4.0, 201), "snap_tau": [0.05, 0.1]}
given["snap_gap"] = [np.maximum(np.exp(kappa) * given["x"] ** 2 / 2 - t, 0.0) for t in given["snap_tau"]]
""",
}


@pytest.mark.parametrize("kind", GIVEN)
def test_a_table_of_answers_is_not_clean(kind, tmp_path, monkeypatch):
    from theory import contact_parameters

    monkeypatch.setattr("bent_beam_programs.open_benchmark.adapter.behind", lambda files, folder: [])
    kappas = [0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8]
    pairs = np.array([[getattr(contact_parameters(k), name) for k in kappas] for name in ("lambda0", "r0")])
    source = TABLE.replace("KAPPAS", repr(kappas)).replace("PAIRS", repr(pairs.tolist()))
    file = tmp_path / "table.py"
    file.write_text(source.replace("NODES", GIVEN[kind]))
    names = ["leading-0.5"]
    rows = campaign([Adapter("table", file)], names, tmp_path / "out", limits=Limits(repeats=1), seed=7)
    assert [row.score.brief for row in rows] and len(rows) == 6 and drawn(names, 7)[0] in {row.problem for row in rows}
    for row in rows:
        assert row.score.completed, row.score.reason
        assert "clean" not in {finding.name for finding in row.score.diagnosis}, (kind, row.resolution)
    if kind != "gaps":
        assert {row.table for row in rows} == {"self-declared"}


def test_three_resolutions_of_an_honest_code_are_clean():
    """Copies that differ by a billionth are not (``test_results.py``)."""
    sizes = ((0.04, 300), (0.025, 350), (0.02, 400))
    found = [score(result_from_fields(solve(0.5, size=size, steps=steps))) for size, steps in sizes]
    assert {one.diagnosis[0].name for one in resolution_ignored(found)} == {"clean"}


def test_a_run_that_has_blown_up_has_diverged():
    fields = solve(0.5)
    fields["node_impulse"] = fields["node_impulse"] * 1e120
    assert score(result_from_fields(fields)).outcome.startswith("diverged(node_impulse")
