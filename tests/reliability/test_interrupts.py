"""Ctrl-C at any moment of any command, or a disk that is full: one line that says how to go on, or what could not be
written; files whole or not there."""

import csv
import json
import os
import random
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import h5py
import pytest
from PIL import Image

FUZZ = bool(os.environ.get("FUZZ"))
SEED = os.environ.get("FUZZ_SEED", "0")
INTERRUPTS = 3 if FUZZ else 1
MAIN = """
import sys
from pathlib import Path
from comparison.command_line.app import main
Path({ready!r}).touch()
main()
"""
FEW_ROWS = """
import comparison.report.page as page
import comparison.report.rows as rows
questions = rows.report_questions
rows.report_questions = lambda *a: [q for q in questions(*a) if q.kappa_over_nu >= 0.4 and q.first is None]
page.stored_studies = lambda: []
"""
CASE = """[beam]
bending_stiffness = 1.0
mass_per_length = 1.0
length = 2.0
curvature = 0.5
damping = 0.01
[impact]
velocity = 1.0
[run]
end_time = 0.01
"""
COMMANDS = {
    "match": ["match", "--path", "hermite", "--kappa-over-nu", "0.5", "--kappa-over-nu", "2", "--out", "OUT"],
    "match --jobs 2": ["match", "--kappa-over-nu", "0.5", "--kappa-over-nu", "2", "--jobs", "2", "--out", "OUT"],
    "match on Exudyn": ["match", "--path", "exudyn", "--kappa-over-nu", "2", "--out", "OUT"],
    "simulate": ["simulate", "CASE", "--out", "OUT/history.nc", "--save", "2000"],
    "simulate on Exudyn": ["simulate", "CASE", "--path", "exudyn", "--out", "OUT/history.nc"],
    "bounce": ["bounce", "--kappa-over-nu", "2", "--damping", "0.1", "--jobs", "2", "--out", "OUT"],
    "report": ["report", "--path", "hermite", "--out", "OUT", "--jobs", "2", "--overwrite"],
    "gallery": ["gallery", "fig-2.5", "fig-2.7a", "fig-2.9", "--out", "OUT", "--format", "png", "--format", "pdf"],
    "study": ["study", "mesh", "CASE", "--path", "hermite", "--refine", "0.5,1", "--out", "OUT"],
    "benchmark": ["benchmark", "--solver", "hermite", "--problem", "point-2", "--out", "OUT"],
    "score": ["score", "HISTORY"],
    "predict --simulate": ["predict", "CASE", "--simulate"],
    "predict": ["predict", "CASE"],
    "new": ["new", "OUT/beam.toml", "--overwrite"],
}
QUICK = ("new",)


SLEEP = """
import sys, time
from pathlib import Path
from comparison.command_line import app
from comparison.workers import run_all

def match(**_):
    Path({ready!r}).touch()
    run_all(time.sleep, [(60.0,)] * 3, jobs=2, on_death=lambda i, why: why)

if __name__ == "__main__":
    app.app = match
    sys.exit(app.run(["match"]))
"""


def started_with_workers(folder: Path) -> subprocess.Popen[str]:
    """A command in a session of its own, about to start two workers that sleep."""
    ready, program = folder / "ready", folder / "program.py"
    program.write_text(SLEEP.format(ready=str(ready)))
    process = subprocess.Popen(
        [sys.executable, str(program)], stdout=-1, stderr=-1, text=True, start_new_session=True, cwd=folder
    )
    while not ready.exists():
        time.sleep(0.01)
    return process


@pytest.mark.parametrize("after", [0.0, 0.3, pytest.param(1.5, marks=pytest.mark.verify)])
def test_workers_end_with_the_command_and_say_nothing(after, tmp_path):
    """Two workers asleep, or still starting: Ctrl-C reaches all processes of a terminal at once."""
    process = started_with_workers(tmp_path)
    time.sleep(after)
    os.killpg(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 130 and out == "" and err.count("\n") == 1 and "goes on from there" in err, err
    assert nothing_left_of(process.pid)


@pytest.mark.parametrize("how", [signal.SIGKILL, pytest.param(signal.SIGTERM, marks=pytest.mark.verify)])
def test_workers_end_when_the_command_is_killed(how, tmp_path):
    """No line of its own runs then: the workers themselves have to see that it is gone."""
    process = started_with_workers(tmp_path)
    time.sleep(1.5)
    process.send_signal(how)
    process.communicate(timeout=30)
    assert process.returncode == -how
    assert nothing_left_of(process.pid)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A case, and a history of it."""
    folder = tmp_path_factory.mktemp("files")
    (folder / "case.toml").write_text(CASE)
    return {"CASE": str(folder / "case.toml"), "HISTORY": str(folder / "history.nc")}


def start(name, files, folder, before=""):
    """The command in a session of its own, as in a terminal of its own, at work from the moment ``ready`` is there."""
    ready = folder / "ready"
    ready.unlink(missing_ok=True)
    words = {**files, "OUT": str(folder / "out"), "OUT/history.nc": str(folder / "out/history.nc")}
    words["OUT/beam.toml"] = str(folder / "out/beam.toml")
    program = before + (FEW_ROWS if name == "report" else "") + MAIN.format(ready=str(ready))
    again = ["--overwrite"] if name.startswith("simulate") else []
    process = subprocess.Popen(
        [sys.executable, "-c", program, *(words.get(word, word) for word in COMMANDS[name]), *again],
        env=os.environ | {"BENTBEAM_STORE": str(folder / "store"), "OMP_NUM_THREADS": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
        text=True,
        cwd=folder,
    )
    while not ready.exists() and process.poll() is None:
        time.sleep(0.002)
    return process


def readable(file: Path) -> bool:
    """Whether a file is whole, by its kind."""
    match file.suffix:
        case ".json":
            json.loads(file.read_text())
        case ".csv":
            with file.open(newline="") as table:
                widths = {len(row) for row in csv.reader(table)}
            return len(widths) == 1 and file.read_bytes().endswith(b"\n")
        case ".toml":
            tomllib.loads(file.read_text())
        case ".nc":
            with h5py.File(file) as content:
                return bool(content["gap"][()].size)
        case ".html":
            return file.read_text().rstrip().endswith("</html>")
        case ".pdf":
            return file.read_bytes().rstrip().endswith(b"%%EOF")
        case ".png" | ".gif":
            with Image.open(file) as picture:
                picture.load()
        case ".npz" | ".md" | ".txt" | ".svg":
            return bool(file.read_bytes())
        case _:
            return False
    return True


def nothing_left_of(session: int) -> bool:
    """Whether no process of the session is alive, within two seconds."""
    for _ in range(100):
        try:
            os.killpg(session, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    os.killpg(session, signal.SIGKILL)
    return False


@pytest.mark.parametrize("name", COMMANDS if FUZZ else QUICK)
def test_an_interrupt_leaves_whole_files_and_says_how_to_go_on(name, files, tmp_path):
    numbers = random.Random(f"{SEED} interrupted {name}")
    if name == "score" and not Path(files["HISTORY"]).exists():
        from comparison.command_line.app import run

        undamped = ["--set", "beam.damping=0"]  # as the solution is that scores are held against
        assert run(["simulate", files["CASE"], *undamped, "--out", files["HISTORY"]]) == 0
    whole = tmp_path / "whole"
    whole.mkdir()
    process = start(name, files, whole)
    began = time.perf_counter()
    _, err = process.communicate(timeout=500)
    seconds = time.perf_counter() - began
    assert process.returncode == 0, err
    made = sorted(f.relative_to(whole) for f in (whole / "out").rglob("*") if f.is_file())
    assert all(readable(whole / f) for f in made)
    stopped, folder = 0, tmp_path / "interrupted"
    folder.mkdir()
    for _ in range(4 * INTERRUPTS):
        process = start(name, files, folder)
        time.sleep(numbers.uniform(0.0, 0.95) * seconds)
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate(timeout=60)
        assert nothing_left_of(process.pid)
        if process.returncode == 130:
            stopped += 1
            assert out == "" and err.count("\n") == 1 and "interrupted" in err and "same command again" in err, err
        else:  # it had just finished
            assert process.returncode == 0, err
        left = [f for f in (folder / "out").rglob("*") if f.is_file()]
        assert all(readable(f) for f in left), [f for f in left if not readable(f)]
        assert not list(folder.rglob("*.part")) and not list(folder.rglob(".run-*"))
        if stopped == INTERRUPTS:
            break
    process = start(name, files, folder)
    _, err = process.communicate(timeout=500)
    assert process.returncode == 0, err
    assert made == sorted(f.relative_to(folder) for f in (folder / "out").rglob("*") if f.is_file())
    print(f"{name}: {stopped} interrupts of {seconds:.1f} s")
    assert stopped or seconds < 1.0


WRITING = [name for name, words in COMMANDS.items() if any(word.startswith("OUT") for word in words)]


@pytest.mark.parametrize("name", WRITING if FUZZ else QUICK)
def test_a_full_disk_is_told_by_the_name_of_the_file_and_takes_none_of_those_before(name, files, tmp_path):
    """No file of this process and its children may grow beyond 100 bytes: kernels and runs cannot be kept either."""
    full = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"
    process = start(name, files, tmp_path, full)
    _, err = process.communicate(timeout=500)
    assert process.returncode in (2, 3) and "Traceback" not in err, err
    assert str(tmp_path / "out") in err and "File too large" in err, err
    left = [f for f in tmp_path.rglob("*") if f.is_file() and f.name != "ready"]
    assert not [f for f in left if f.suffix == ".part" or not f.stat().st_size], left
    assert nothing_left_of(process.pid)
