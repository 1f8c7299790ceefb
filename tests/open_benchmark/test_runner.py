"""An adapter that misbehaves is a row with a reason; the others go on, and what was done is not done again."""

import os
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest
from called import started
from processes import ended, until

from bent_beam.errors import InputError
from bent_beam.measure.numbers import Number
from bent_beam_programs.open_benchmark.adapter import RESOLUTIONS, Adapter, chosen_adapters, shipped_adapters
from bent_beam_programs.open_benchmark.campaign import STANDARD, Row, campaign, declared_rows, drawn
from bent_beam_programs.open_benchmark.judgement import Score, Symptom
from bent_beam_programs.open_benchmark.page import errors_table, properties, write_page
from bent_beam_programs.open_benchmark.problem import problem
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.running import Limits, run_adapter
from bent_beam_programs.open_benchmark.score import score

GOOD = """
import sys, numpy as np
from pathlib import Path
tau = np.linspace(0, 0.1, 300)
Path(__file__).with_name("log").open("a").write(Path(__file__).stem + chr(10))
np.savez(sys.argv[2], outcome="completed", problem="point-2", metadata="{}", tau=tau,
         J=4 * np.sqrt(2 / np.pi * tau), Jm=0 * tau)
"""


def adapter(tmp_path, name, source):
    file = tmp_path / f"{name}.py"
    file.write_text(source)
    return Adapter(name, file, resolutions=("coarse",))


def ran(one, tmp_path, repeats=1, **limits):
    """A run of an adapter, whose result is ``kept/r.npz``."""
    return run_adapter(one, problem("point-2"), "coarse", tmp_path / "kept/r.npz", Limits(repeats=repeats, **limits))


@pytest.mark.parametrize(
    ("source", "found", "reason"),
    [
        ("raise RuntimeError('no licence')", "crashed", "RuntimeError: no licence"),
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "crashed", "signal SIGSEGV"),
        ("", "crashed", "left no result.npz or result.json"),
        ("import resource as r; raise SystemExit(str(r.getrlimit(r.RLIMIT_FSIZE)))", "crashed", "(5000000, 5000000)"),
        ("import sys, os; os.symlink('/etc/passwd', sys.argv[2])", "crashed", "left no result"),
        ("import sys; open(sys.argv[2], 'wb').write(b'rubbish')", "invalid", "result.npz: is not a readable NPZ"),
        (GOOD.replace("point-2", "point-3"), "invalid", "problem is point-3, asked was point-2"),
        ("import theory", "crashed", "ModuleNotFoundError: theory is out of reach"),
        ("import os; os.unlink('err.txt'); os.mkfifo('err.txt')", "crashed", "left no result"),
        ("import sys, os; os.mkfifo(sys.argv[2])", "crashed", "left no result"),
        (GOOD + "sys.exit(7)", "", ""),  # a result counts whatever the exit status says
        ("import itertools\nfor k in itertools.count(): open(f'f{k}', 'wb').write(bytes(1000000))", "crashed", ""),
    ],
)
def test_a_run_ends_as_an_outcome_with_a_reason(tmp_path, source, found, reason):
    run = ran(adapter(tmp_path, "one", source), tmp_path, seconds=30.0, output_bytes=5_000_000)
    assert not list((tmp_path / "kept").glob(".run-*")), "the run's folder is gone"
    assert run.outcome == found and run.reason.startswith(reason) and bool(run.reason) == bool(found)
    assert run.unlimited == ""


def test_a_hang_is_a_timeout_and_takes_its_children_along(tmp_path):
    """A shell starts at once, so that a short limit will do."""
    pid, file = tmp_path / "child.pid", tmp_path / "slow"
    file.write_text(f"#!/bin/sh\nsetsid sleep 60 &\necho $! > {pid}\nsleep 60\n")
    file.chmod(0o755)
    assert ran(Adapter("slow", file), tmp_path, seconds=1.0).outcome == "timeout"
    until(lambda: ended(int(pid.read_text())))


def test_a_killed_command_takes_its_adapter_and_its_folder_along(tmp_path):
    slow = adapter(tmp_path, "slow", "import os, time\nopen('pid', 'w').write(str(os.getpid()))\ntime.sleep(60)")
    asked = ("benchmark", "--adapter", slow.file, "--problem", "point-2", "--out", "out")
    process, places = started(*asked, cwd=tmp_path), "out/results/slow/.run-*"
    until(lambda: any(file.read_text() for file in tmp_path.glob(f"{places}/pid")))
    (pid,) = (int(file.read_text()) for file in tmp_path.glob(f"{places}/pid"))
    process.kill()
    process.communicate()
    until(lambda: ended(pid) and not list(tmp_path.glob(places)))


def test_one_bad_adapter_is_a_row_and_only_what_changed_or_a_full_disk_may_have_spoilt_is_run_again(own_folder):
    fine = adapter(own_folder, "good", GOOD)
    bad = adapter(own_folder, "bad", "raise SystemExit('cannot')")
    torn = adapter(own_folder, "torn", GOOD + "open(sys.argv[2], 'wb').write(b'PK')")
    none = replace(fine, name="none", install=("nothing==1",), environment="not-there", module="nothing")
    adapters, out = [bad, torn, none, fine], Path("out")  # relative to where one stands
    run = partial(campaign, problems=["point-2"], out=out, limits=Limits(repeats=1))
    run(adapters)
    rows = run(adapters)
    assert Path("log").read_text().split() == ["torn", "good", "torn"]
    assert [r.score.outcome for r in rows] == ["crashed", "invalid", "not_installed", "completed"]
    assert rows[2].score.reason == "bentbeam benchmark --install none"
    assert rows[-1].score.error("r0") == pytest.approx(0.0, abs=1e-9)
    page = write_page(rows, adapters, out).read_text()
    assert page.count("<svg") == 1 and "cannot" in page and "not installed" in page
    adapter(own_folder, "good", GOOD + "import helper")
    run([fine])
    Path("helper.py").write_text("h = 1")
    run([fine])
    assert Path("log").read_text().split()[3:] == ["good", "good"]


@pytest.mark.parametrize("name", ["source_digest", "versions"])
def test_a_changed_solver_of_this_project_runs_again_and_no_foreign_one_which_imports_nothing_of_it(monkeypatch, name):
    shipped = shipped_adapters()
    for one in ("source_digest", "versions"):
        monkeypatch.setattr(f"bent_beam_programs.open_benchmark.adapter.{one}", lambda: "of today")
    before = {key: one.digest() for key, one in shipped.items()}
    monkeypatch.setattr(f"bent_beam_programs.open_benchmark.adapter.{name}", lambda: "of tomorrow")
    changed = {key for key, one in shipped.items() if one.digest() != before[key]}
    assert changed == {"hermite", "hermite-strict", "massless-boundary", "exudyn"}
    for one in (one for one in shipped.values() if not one.host):
        source = one.file.read_text()
        assert not [n for n in ("bent_beam", "hermite_fe", "theory import", "open_benchmark") if n in source], one.name


NODES = """
import sys, tomllib, numpy as np
problem = tomllib.load(open(sys.argv[1], "rb"))
tau = np.linspace(0, 0.1, 300)
noise = 1e-4 * np.random.default_rng(len(sys.argv[3])).standard_normal(300).cumsum() * np.sqrt(tau / 300)
of_wall = 2 * np.sqrt(2 / np.pi) * (np.sqrt(tau) + noise) * (tau > 0)
x = np.r_[0.0, 0.1:1.1:0.1]
nodes = {"node_x": x, "node_impulse": np.c_[of_wall, np.zeros((300, 10))]}
nodes |= {"x": x, "snap_tau": [0.05, 0.1], "snap_gap": x**2 - [[0.05], [0.1]] + [[0.05], [0.1]] * np.exp(-9 * x)}
declared = {"J": 2 * of_wall, "Jm": 0 * tau}
np.savez(sys.argv[2], outcome="completed", problem=problem["id"], metadata="{}", tau=tau, **nodes)
"""


def test_only_nodal_histories_and_gaps_of_drawn_problems_stand_in_the_table_of_runs(tmp_path):
    names = {"clean": NODES, "declared": NODES.replace("**nodes", "**declared")}
    adapters = [adapter(tmp_path, name, source) for name, source in names.items()]
    rows = campaign(adapters, ["point-2"], tmp_path / "out", limits=Limits(repeats=1), seed=4)
    tables = {(row.solver, row.problem == "point-2"): row.declared_because for row in rows}
    of_clean = {("clean", True): "a problem whose answer is published", ("clean", False): ""}
    assert tables == of_clean | {("declared", one): "no nodal histories or no gaps" for one in (True, False)}
    ran = next(row for row in rows if not row.declared_because)
    assert ran.score.error("r0") == pytest.approx(0.0, abs=0.01) and ran.repeats == 1
    assert len(ran.made_by["source"]) == 64 and "numpy" in ran.made_by["packages"]
    page = write_page([ran, rows[-1]], adapters, tmp_path / "out").read_text()
    run_table, declared_table = page[page.index('id="run-here"') :].split('id="self-declared"')
    assert "clean" in run_table and ">declared<" not in run_table and ">declared<" in declared_table
    handed_in = declared_rows(sorted((tmp_path / "out/results").rglob("*.npz")))
    assert len(handed_in) == len(rows)
    assert all(row.score.raw for row in rows + handed_in for one in row.score.diagnosis if one.name == "clean")


def test_drawn_problems_are_near_the_named_ones_share_their_base_and_differ_with_the_seed():
    once, again, other = (drawn(STANDARD, seed) for seed in (1, 1, 2))
    assert once == again and not set(once) & {*other, *STANDARD} and len(once) == len(STANDARD)
    for given, name in zip(map(problem, STANDARD), map(problem, once)):
        assert name.kind == given.kind and 0.8 < name.kappa_over_nu / given.kappa_over_nu < 1.2
        assert name.base_id in (None, *once) and (name.uniform_load > 0.0) == (given.uniform_load > 0.0)
    assert drawn(["ball", "bounce-2-1e-3"], 1) == []
    for name in ("elastic-wall-0.5-5", "elastic-stop-3000", "elastic-wall-1000000-0.1"):  # at the ends of their ranges
        assert all(problem(near).kind == problem(name).kind for seed in range(20) for near in drawn([name], seed))


@pytest.mark.parametrize("name", ["...py", "-x.py", "hermite.py"])
def test_the_name_of_an_adapter_stays_in_the_folder_of_results_and_is_its_own(tmp_path, name):
    (tmp_path / name).write_text("")
    with pytest.raises(InputError, match="adapter: "):
        chosen_adapters(["hermite"], own=[tmp_path / name])


def test_an_executable_in_any_language_is_an_adapter(tmp_path):
    file = tmp_path / "mine"
    file.write_text(f"#!{sys.executable}\n{GOOD}")
    (mine,) = chosen_adapters(own=[file])
    assert mine.missing() == f"{file} is not executable"
    os.chmod(file, 0o755)
    run = ran(mine, tmp_path, repeats=2)
    assert not run.outcome and run.repeats == 2 and (tmp_path / "kept/r.npz").is_file()


def row(solver, name, resolution="fine", error=0.0, **score):
    found = Score(name, "completed", measured={"r0": Number(1.0 + error, None, 1.0)})
    return Row(solver, name, resolution, 2.0, replace(found, **score))


@pytest.mark.parametrize(("coarse", "fine", "verdict"), [(3e-3, 1e-3, 1), (1e-3, 1.5e-3, 0), (1e-2, 5e-3, 0)])
def test_a_code_converges_where_its_error_falls_and_ends_small(coarse, fine, verdict):
    rows = [row("mine", "leading-0.5", "coarse", coarse), row("mine", "leading-0.5", "fine", fine)]
    table = properties(rows, "mine")
    assert (table["converges"], table["noise"]) == (f"{verdict} of 1 problems", "not reported")
    table = properties([row("mine", "leading-0.5", outcome="timeout", measured={})], "mine")
    assert (table["converges"], table["noise"]) == ("no result", "timeout")


@pytest.mark.verify
@pytest.mark.parametrize("name", ["elastic-wall-0.5-0", "elastic-wall-0.1-0.5", "elastic-stop-45000"])
def test_two_ways_give_one_largest_force(tmp_path, name):
    """The theory's, by a Volterra equation or modes, and that of Hermite elements as an adapter."""
    run_adapter(shipped_adapters()["hermite"], problem(name), "coarse", tmp_path / "r.npz", Limits(repeats=1))
    found = score(load_result(tmp_path / "r.npz"))
    assert found.error("peak_force") == pytest.approx(0.0, abs=2e-4) and found.outcome == "completed"


def test_the_table_of_errors_has_a_line_for_each_code_a_column_for_each_problem_and_an_error_in_its_own_cell():
    given = [("a", "leading-0.5", 0.01), ("a", "point-2", -0.02), ("b", "point-2", 0.03)]
    rows = [row(solver, name, error=error) for solver, name, error in given]
    lines = [line.strip("|").replace(" ", "").split("|") for line in errors_table(rows, ["a", "b"]).splitlines()]
    assert lines[:2] == [["code", "`leading-0.5`", "`point-2`"], ["---"] * 3]
    assert lines[2:] == [["a", "+1.000(2)", "-2.000(2)"], ["b", "notasked", "+3.000(2)"]]


def test_a_pull_counts_at_every_resolution_and_a_lift_at_the_finest_alone():
    seen = [{name: Symptom(name, size, 0.01) for name in ("pull", "lift")} for size in (0.3, 0.2, 0.1)]
    rows = [row("mine", "leading-0.5", name, readings=one) for name, one in zip(RESOLUTIONS, seen)]
    table = properties(rows, "mine")
    assert (table["unilateral"], table["lift"]) == ("3.0e-01", "1.0e-01")
