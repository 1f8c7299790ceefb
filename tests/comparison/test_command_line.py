"""The command line is a contract: one JSON document, exit codes, one-line errors."""

import json
import logging
import os
import subprocess
import sys
from pathlib import Path
from unittest.mock import Mock

import pytest
from called import answered, command, refused
from here import CASES
from histories import pushed_until

from bent_beam import ImpactHistory, SimulationError
from comparison.command_line.app import run
from comparison.command_line.options import progress
from hermite_fe import HermiteFE
from self_similar_fe import SelfSimilarFE

K10 = str(CASES / "thesis_K10.toml")
VELOCITIES = ("--vary", "impact.velocity=1,2")
EVEN = ("--set", "mesh.kind=uniform", "--set", "mesh.element_length=1")
SWEEP = ("sweep", K10, *EVEN)


def test_theory():
    found = answered("theory", "--kappa-over-nu", "0.5", "--alpha", "4")
    assert (found["lambda0"], found["r1"]) == pytest.approx((1.01886591389, 10.6928065607), rel=1e-11)


def test_both_paths_say_what_theory_says_and_their_stored_runs_are_drawn_and_compared(tmp_path):
    files = [str(tmp_path / f"{path}.nc") for path in ("hermite", "exudyn")]
    for path, file in zip(("hermite", "exudyn"), files):
        half = ("--set", f"{path}.refine=0.5", "--error-bars", "drift", "--save", "50")
        found = answered("simulate", K10, "--path", path, "--out", file, *half)
        for name, tolerance in (("half_contact_length", 5e-3), ("total_impulse", 2e-3), ("lambda0", 3e-3)):
            assert found[name]["value"] == pytest.approx(found[name]["theory"], rel=tolerance)
        assert abs(found["energy"]["defect"]) < (1e-9 if path == "hermite" else 1e-2) * found["energy"]["initial"]
        assert found["file"] == file and Path(file).exists()
    assert "exists already" in refused("simulate", K10, "--out", file)
    found = answered("plot", files[0], "--out", str(tmp_path))
    assert all(Path(f).stat().st_size > 10_000 for f in found["files"])
    found = answered("compare", *files)
    assert found["same_impact"] and found["paths"] == ["hermite", "exudyn"]
    assert max(found["largest_difference"][name] for name in ("total_impulse", "gap")) < 0.01  # two codes, one impact
    assert all(one != other for one, other in found["settings"].values())
    assert found["settings"]["far_field"][1] is found["settings"]["geometry"][0] is None  # one path alone has it


def test_a_match_whose_rows_are_all_refused_is_bad_input_and_still_a_document(capsys):
    pair = ["--set", "exudyn.contact.kind=rigid", "--set", "exudyn.integrator.spectral_radius=.9"]
    asked = ["match", "--path", "exudyn", *pair, "--kappa-over-nu", "0.5", "--json", "--first-order", "free,1,2,3"]
    assert run([*asked, "--wall", "1e5"]) == 2
    assert json.loads(capsys.readouterr().out)["rows"][0]["wall"] == [1e5, 0.0]
    assert run([*asked, "--refine", "2"]) == 2
    printed = capsys.readouterr()
    (row,) = json.loads(printed.out)["rows"]
    assert "needs exudyn.integrator.kind newmark" in row["reason"]
    assert [row[name] for name in ("alpha", "psi", "chi", "axial", "refine")] == [-1.5, 1.0, 2.0, 3.0, 2.0]
    assert "every row was refused: exudyn.contact.kind rigid needs" in printed.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["simulate", K10, "--set", "hermite.contact.kind=nod"], "did you mean node?"),
        (["simulate", K10, "--set", "nonsense"], "--set"),
        (["match", "--first-order", "1,2"], "alpha,psi,chi"),
        (["match", "--refine", "one"], "--refine"),
        (["match", "--path", "exudyn", "--set", "hermite.mass.kind=lumped"], "not a path asked for"),
        (["match", "--kappa-over-nu", "0"], "kappa_over_nu"),
        (["bounce"], "--kappa-over-nu"),
        (["bounce", "--kappa-over-nu", "2"], "--damping"),
        (["study", "colour", K10], "colour"),
        (["gallery", "fig-9.9"], "fig-9.9"),
        # what would have no effect
        (["simulate", K10, "--set", "exudyn={refine=2.0}"], "has no effect: the path is hermite"),
        (["problem", "leading-0.5", "--overwrite"], "without --out"),
        (["simulate", K10, "--out", "run.csv"], "--out must not end in .csv: the file is a .nc (got run.csv)"),
        (["predict", K10, "--theory-only", "--set", "impact.rotation=5"], "bentbeam bounce follows the full beam"),
        (["simulate", K10, "--until", "separation", "--set", "run.end_time=1"], "--until separation says how long"),
        (["bounce", K10, "--set", "self_similar.refine=2"], "the path is hermite"),
        (["bounce", K10, "--set", "run.duration=1"], "a whole impact ends with the last separation"),
        (["bounce", "--kappa-over-nu", "2", "--damping", "0.1", "--seed", "0"], "seed has no effect"),
        (["bounce", K10, "--runs", "3"], "runs has no effect"),
        ([*SWEEP, "--vary", "exudyn.refine=1,2"], "vary: 'exudyn.refine' has no effect: the path is hermite"),
        ([*SWEEP, "--vary", "run.end_time=1,2"], "the last separation ends a row"),
        ([*SWEEP, *VELOCITIES, "--set", "impact.velocity=3"], "says the same in every row"),
        ([*SWEEP, *VELOCITIES, "--set", "impact.drop_height=3"], "says the same in every row"),
        ([*SWEEP, *VELOCITIES, "--vary", "impact.drop_height=1,2"], "another --vary says the same"),
        ([*SWEEP, "--vary", "velocity=1,2"], "TABLE.KEY"),
        ([*SWEEP, "--vary", "impact.velocity=1,,2"], "TABLE.KEY"),
        ([*SWEEP, "--vary", "impact.velocity=1:2"], "A:B:N, two numbers and how many values, from 2 on, or A,B,C"),
        ([*SWEEP, *VELOCITIES, *VELOCITIES], "--vary impact.velocity is given twice"),
        ([*SWEEP, "--vary", "impact.velocity=1:2:1"], "from 2 on"),
        ([*SWEEP, "--vary", "impact.velocity=0:1:20000"], "from 2 on"),
        ([*SWEEP, "--vary", "impact.velocty=1,2"], "did you mean velocity?"),
        (["predict", K10, "--theory-only", "--set", "hermite.refine=2"], "nothing is simulated"),
        (["predict", K10, "--time", "0", *EVEN], "is simulated"),
        (["predict", K10, "--theory-only", "--time", "1e-4", "--set", "run.end_time=1"], "--time says when"),
        (["predict", K10, "--time", "-1"], "error: --time: "),
        (["predict", K10, "--theory-only", "--fresh"], "--fresh has no effect"),
        (["simulate", K10, "--until", "separation", "--error-bars", "thorough"], "has no effect without damping"),
        (["settings", "--json", "--markdown"], "--markdown writes the whole page"),
        (["study", "list", K10], "study list takes --json alone"),
        (["study", "contact-point", K10, *EVEN], "their own"),
        (["gallery", "--list", "fig-3.9"], "--list lists all and draws nothing: leave 'fig-3.9' out"),
        (["gallery", "--list", "--jobs", "1"], "leave --jobs out"),
        (["benchmark", "--install", "scikit-fem", "--seconds", "9"], "--install runs nothing: leave --seconds out"),
    ],
)
def test_bad_input_is_one_line_and_exit_2(arguments, message):
    assert message in refused(*arguments)


def test_the_beam_of_two_numbers_is_told_to_be_no_real_one():
    code, out, _ = command("bounce", "--kappa-over-nu", 2, "--damping", 0.1, "--set", "hermite.refine=0.1", "--quiet")
    assert code == 0 and "L/2 = EI = mu = V0 = 1" in out


def test_a_solver_that_cannot_finish_is_exit_3_with_a_partial_history(tmp_path, monkeypatch):
    part, why = pushed_until(0.5), "the Newton solve diverged"
    failed = SimulationError(why, time=1e-5, step=12, advice="a smaller step", history=part)
    monkeypatch.setattr(HermiteFE, "simulate", Mock(side_effect=failed))
    for kept in ("run.v2.partial.nc", "run.v2.partial-2.nc"):
        code, _, error = command("simulate", K10, "--out", tmp_path / "run.v2.nc")
        assert code == 3 and "t = 1e-05 s (step 12); try: a smaller step" in error
        assert ImpactHistory.load(tmp_path / kept).dataset.identical(part.dataset)


def test_a_companion_run_that_cannot_finish_is_a_warning(monkeypatch):
    def simulate(method, *given, **named):
        if method.refine < 1.0:
            raise SimulationError("the front left the mesh", time=1e-5, step=12, advice="a smaller step")
        return whole(method, *given, **named)

    whole = SelfSimilarFE.simulate
    monkeypatch.setattr(SelfSimilarFE, "simulate", simulate)
    found = answered("simulate", K10, "--path", "self_similar")
    assert found["lambda0"]["error"] > 0.0
    (warning,) = (w for w in found["warnings"] if "companion" in w)
    assert "no companion run" in warning and "the front left the mesh" in warning


def test_what_a_path_logs_reaches_its_user_unless_quiet(capsys):
    for quiet, said in ((False, "long\n"), (True, "")):
        with progress("a run", quiet):
            logging.getLogger("bent_beam").warning("long")
        assert capsys.readouterr().err == said


def test_help_fits_its_lines_and_has_an_example_for_every_command(capsys):
    for arguments in ([], ["-h"], ["--help"]):
        assert run(arguments) == 0
        commands = capsys.readouterr().out.partition("Commands:")[2]
        assert "simulate" in commands and "..." not in commands
    for name in (line.split()[0] for line in commands.strip().splitlines()):
        assert run([name, "--help"]) == 0
        assert f"Example: bentbeam {name}" in capsys.readouterr().out
    assert run(["--version"]) == 0 and capsys.readouterr().out.strip()[0].isdigit()


def test_linear_algebra_takes_one_thread_unless_told():
    """Set before NumPy is imported, or it would not be heard."""
    loaded = "import os, sys, comparison.command_line"
    said = "print(os.environ['OMP_NUM_THREADS'], os.environ['OPENBLAS_NUM_THREADS'], 'numpy' in sys.modules)"
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    environment["OPENBLAS_NUM_THREADS"] = "3"
    told = subprocess.check_output([sys.executable, "-c", f"{loaded}; {said}"], env=environment, text=True)
    assert told.split() == ["1", "3", "False"]
