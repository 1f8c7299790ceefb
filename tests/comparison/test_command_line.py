"""The command line is a contract: one JSON document, exit codes, one-line errors."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from comparison import workers
from comparison.command_line.app import run

CASES = Path(__file__).parents[2] / "cases"
K10 = str(CASES / "thesis_K10.toml")


def document(capsys, *arguments):
    code = run([*arguments, "--json"])
    out = capsys.readouterr()
    assert code == 0, out.err

    def no_constants(name):
        raise AssertionError(f"{name} in JSON")

    return json.loads(out.out, parse_constant=no_constants)


def refusal(capsys, *arguments):
    code = run(arguments)
    out = capsys.readouterr()
    assert code == 2
    assert out.out == ""
    assert out.err.startswith("error: ")
    assert out.err.count("\n") == 1
    return out.err


def test_theory(capsys):
    found = document(capsys, "theory", "--kappa-over-nu", "0.5", "--alpha", "4")
    assert list(found) == [
        "kappa_over_nu", "alpha", "psi", "chi", "axial", "regime", "lambda0", "r0", "lambda1", "r1", "lambda_axial",
        "r_axial", "peak_moment",
    ]  # fmt: skip
    assert found["regime"] == "continuous"
    assert found["lambda0"] == pytest.approx(1.01886591389, rel=1e-11)
    assert found["r1"] == pytest.approx(10.6928065607, rel=1e-11)


def test_predict_reads_the_drill_pipe(capsys):
    found = document(capsys, "predict", str(CASES / "drill_pipe.toml"), "--time", "0.005", "--time", "0.01")
    at = found["times"][1]
    assert 3.5 < at["half_contact_length"] < 4.0
    assert found["times"][0]["impulse"] < at["impulse"]
    assert at["valid"] and found["valid_until"] > 0.01 and found["limited_by"]  # ε = 5 does not matter


def test_predict_answers_for_a_damped_rod_and_says_when_it_has_left(capsys):
    found = document(capsys, "predict", str(CASES / "glass_fibre_rod.toml"), "--time", "0.001", "--time", "0.1")
    early, late = found["times"]
    assert (early["valid"], late["valid"]) == (True, False)
    assert found["valid_from"] < 1e-4 < 1e-3 < found["valid_until"]
    last = found["bounce"]["last_contact"]
    assert late["time"] > (last["value"] + last["error"]) * found["slow_time_scale"]
    assert any("At 0.1 s the beam has left the wall" in warning for warning in found["warnings"])


@pytest.mark.parametrize("path", ["hermite", "exudyn"])
def test_simulate_shows_what_theory_says(capsys, tmp_path, path):
    file = tmp_path / "run.nc"
    found = document(capsys, "simulate", K10, "--path", path, "--out", str(file))
    for name, tolerance in (("half_contact_length", 5e-3), ("total_impulse", 2e-3), ("lambda0", 3e-3)):
        assert found[name]["value"] == pytest.approx(found[name]["theory"], rel=tolerance)
    assert abs(found["energy"]["defect"]) < (1e-9 if path == "hermite" else 1e-2) * found["energy"]["initial"]
    assert found["file"] == str(file)
    assert file.exists()
    assert "exists already" in refusal(capsys, "simulate", K10, "--out", str(file))


def test_simulate_discrete_contact(capsys):
    found = document(capsys, "simulate", str(CASES / "thesis_K25_discrete.toml"))
    assert found["half_contact_length"]["value"] == 0.0
    assert found["r0"]["value"] == pytest.approx(1.0, rel=1e-3)


def test_match_prints_rows(capsys, monkeypatch, tmp_path):
    monkeypatch.setenv("BENTBEAM_STORE", str(tmp_path / "store"))
    out = str(tmp_path / "out")
    found = document(capsys, "match", "--path", "self_similar", "--kappa-over-nu", "0.5", "--out", out)
    assert found["rows"][0]["lambda1"] == {"value": None, "error": None, "theory": None}
    assert found["rows"][0]["lambda0"]["value"] == pytest.approx(1.01886591389, rel=1e-4)
    assert {f.name for f in (tmp_path / "out").iterdir()} == {"match.json", "match.csv", "leading.png"}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["theory", "--kappa-over-nu", "nan"], "kappa_over_nu"),
        (["theory", "--kappa-over-nu", "-1"], "kappa_over_nu"),
        (["theory", "--kappa", "0.5"], "--kappa"),
        (["theory"], "kappa-over-nu"),
        (["predict", "none.toml"], "none.toml"),
        (["predict", K10, "--time", "-1"], "times"),
        (["simulate", K10, "--path", "abaqus"], "path"),
        (["bounce", "--kappa-over-nu", "2", "--damping", "0.01", "--path", "self_similar"], "exudyn and hermite have"),
        (
            ["simulate", K10, "--set", "beam.bending_stiffness=-1.0"],
            "beam.bending_stiffness must be positive (got -1.0)",
        ),
        (["simulate", K10, "--set", "hermite.contact.kind=nod"], "did you mean node?"),
        (
            ["simulate", K10, "--set", "hermite.integrator.kind=moreau_jean", "--set", "hermite.integrator.teta=1"],
            "theta",
        ),
        (["simulate", K10, "--set", "exudyn.integrator.kind=newmrk", "--path", "exudyn"], "newmark"),
        (["simulate", K10, "--set", "nonsense"], "--set"),
        (["match", "--first-order", "1,2"], "alpha,psi,chi"),
        (["match", "--refine", "one"], "--refine"),
        (["match", "--path", "exudyn", "--set", "hermite.mass.kind=lumped"], "not a path asked for"),
        (["match", "--methods", "none.toml"], "none.toml"),
        (["match", "--kappa-over-nu", "0"], "kappa_over_nu"),
        (["match", "--path", "theory", "--kappa-over-nu", "1"], "path"),
        (["study", "colour", K10], "colour"),
        (["gallery", "fig-9.9"], "fig-9.9"),
        (["rerun", "none.nc"], "none.nc"),
        (["frobnicate"], "frobnicate"),
    ],
)
def test_bad_input_is_one_line_and_exit_2(capsys, arguments, message):
    assert message in refusal(capsys, *arguments)


def test_a_scheduler_that_does_not_answer_is_named(capsys, monkeypatch):
    monkeypatch.setattr(workers, "FIRST_ANSWER", 0.5)
    arguments = ("match", "--path", "hermite", "--kappa-over-nu", "2", "--scheduler", "tcp://127.0.0.1:1")
    assert "scheduler" in refusal(capsys, *arguments)


def test_help_has_an_example_for_every_command(capsys):
    for command in ("theory", "predict", "simulate", "match", "study", "gallery", "report", "rerun"):
        assert run([command, "--help"]) == 0
        assert f"Example: bentbeam {command}" in capsys.readouterr().out


def test_a_solver_that_cannot_finish_is_exit_3_with_a_partial_history(capsys, tmp_path, monkeypatch):
    from bent_beam import ImpactHistory, SimulationError, load_case
    from hermite_fe import HermiteFE

    case = load_case(K10, ["run.duration=0.01"])
    part = case.method("hermite").simulate(case.impact, end_time=case.end_time, save=8)

    def fails(*_, **__):
        raise SimulationError("the Newton solve diverged", time=1e-5, step=12, advice="a smaller step", history=part)

    monkeypatch.setattr(HermiteFE, "simulate", fails)
    code = run(["simulate", K10, "--out", str(tmp_path / "run.nc")])
    error = capsys.readouterr().err
    assert code == 3
    assert "t = 1e-05 s (step 12); try: a smaller step" in error
    assert ImpactHistory.load(tmp_path / "run.partial.nc").dataset.identical(part.dataset)


def test_a_companion_run_that_cannot_finish_is_a_warning(capsys, monkeypatch):
    from bent_beam import SimulationError
    from self_similar_fe import SelfSimilarFE

    def simulate(method, *given, **named):
        if method.refine < 1.0:
            raise SimulationError("the front left the mesh", time=1e-5, step=12, advice="a smaller step")
        return whole(method, *given, **named)

    whole = SelfSimilarFE.simulate
    monkeypatch.setattr(SelfSimilarFE, "simulate", simulate)
    found = document(capsys, "simulate", K10, "--path", "self_similar")
    assert found["lambda0"]["error"] > 0.0
    (warning,) = (w for w in found["warnings"] if "companion" in w)
    assert "0.5 times the resolution" in warning and "the front left the mesh" in warning


@pytest.mark.parametrize("arguments", [[], ["-h"], ["--help"]])
def test_bare_command_prints_its_help(capsys, arguments):
    assert run(arguments) == 0
    printed = capsys.readouterr().out
    assert "simulate" in printed
    assert "..." not in printed.partition("Commands:")[2]  # each command's sentence fits its line


def test_version(capsys):
    assert run(["--version"]) == 0
    assert capsys.readouterr().out.strip()[0].isdigit()


def test_a_stored_run_is_drawn_and_compared(capsys, tmp_path):
    for name, path in (("a", "hermite"), ("b", "exudyn")):
        file = str(tmp_path / f"{name}.nc")
        document(capsys, "simulate", K10, "--path", path, "--out", file, "--error-bars", "drift")
    found = document(capsys, "plot", str(tmp_path / "a.nc"), "--out", str(tmp_path))
    assert all(Path(f).stat().st_size > 10_000 for f in found["files"])
    found = document(capsys, "compare", str(tmp_path / "a.nc"), str(tmp_path / "b.nc"))
    assert found["same_impact"] and found["paths"] == ["hermite", "exudyn"]
    assert found["largest_difference"]["total_impulse"] < 0.01  # two codes, one impact
    assert found["largest_difference"]["gap"] < 0.01


def test_what_a_path_logs_for_the_user_is_shown_with_the_progress():
    import logging

    from comparison.command_line.console import notices

    seen = []
    with notices(seen.append):
        logging.getLogger("bent_beam").info("compiling")
        logging.getLogger("elsewhere").info("noise")
    logging.getLogger("bent_beam").info("after")
    assert seen == ["compiling"]


@pytest.mark.parametrize("quiet", [False, True])
def test_what_a_path_logs_is_a_line_where_there_is_no_terminal(capsys, quiet):
    import logging

    from comparison.command_line.console import Console

    with Console(quiet).progress("a run"):
        logging.getLogger("bent_beam").info("compiling")
    logging.getLogger("bent_beam").info("after")
    printed = capsys.readouterr()
    assert printed.out == "" and printed.err == ("" if quiet else "compiling\n")


def test_settings_and_kinds_are_completed():
    from comparison.command_line.options import setting_names

    assert "hermite.contact.kind=middle" in setting_names("hermite.contact.k")
    assert setting_names("beam.leng") == ["beam.length="]
    assert "exudyn.integrator.kind=newmark" in setting_names("exudyn.")


@pytest.mark.parametrize(
    ("words", "cores", "processes"),
    [((), 2, 2), ((), 64, 4), (("--kappa-over-nu", "0.5"), 64, 1), (("--jobs", "1"), 2, 1), ((), None, 1)],
)
def test_match_takes_as_many_processes_as_there_are_cores_and_rows_for_them(
    words, cores, processes, capsys, monkeypatch
):
    """Eighteen rows without options; four a process at least, for one takes seconds to start."""
    taken = []
    monkeypatch.setattr("os.cpu_count", lambda: cores)
    monkeypatch.setattr("comparison.match.match", lambda asked, *, jobs, **_: taken.append(jobs) or [])
    assert document(capsys, "match", *words)["rows"] == []
    assert taken == [processes]


@pytest.mark.parametrize(("asked", "taken"), [(None, "1"), ("3", "3")])
def test_linear_algebra_takes_one_thread_unless_told(asked, taken):
    """Set before NumPy is imported, or it would not be heard."""
    text = (
        "import os, sys; from comparison.command_line.app import main\n"
        "assert 'numpy' not in sys.modules\n"
        "try: main(['--version'])\n"
        "finally: print(os.environ['OPENBLAS_NUM_THREADS'])"
    )
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    if asked:
        environment["OPENBLAS_NUM_THREADS"] = asked
    told = subprocess.run([sys.executable, "-c", text], env=environment, capture_output=True, text=True, check=True)
    assert told.stdout.split()[-1] == taken
