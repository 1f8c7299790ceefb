"""Interrupts and a disk that is full: one line that says how to go on, or what could not be written; files whole."""

import io
import json
import os
import random
import signal
import time
import tomllib
from pathlib import Path

import h5py
import pytest
from called import CASE, started
from here import FUZZ, SEED
from PIL import Image
from processes import ended, until

INTERRUPTS = 2 if FUZZ else 1
MAIN = """
from pathlib import Path
from comparison.command_line.app import main
Path("ready").touch()
main()
"""
FEW_ROWS = """
import bent_beam_programs.report.page as page
import bent_beam_programs.report.rows as rows
questions = rows.report_questions
rows.report_questions = lambda *a: [q for q in questions(*a) if q.kappa_over_nu >= 0.4 and q.first is None]
page.stored_studies = lambda: []
"""
COMMANDS = {
    "match": "match --kappa-over-nu 0.5 --kappa-over-nu 2 --jobs 2 --out out",
    "simulate": "simulate case.toml --out out/history.nc --save 2000 --overwrite",
    "simulate on Exudyn": "simulate case.toml --path exudyn --out out/history.nc --overwrite",
    "bounce": "bounce --kappa-over-nu 2 --damping 0.1 --jobs 2 --out out",
    "report": "report --path hermite --out out --jobs 2 --overwrite",
    "gallery": "gallery fig-2.5 fig-2.7a fig-2.9 --out out --format png --format pdf",
    "study": "study mesh case.toml --path hermite --refine 0.5,1 --out out",
    "benchmark": "benchmark --solver hermite --problem point-2 --seed 34 --out out",
    "new": "new out/beam.toml --overwrite",
}
SOME = COMMANDS if FUZZ else ["new"]
A_COMMAND = """
import time
from pathlib import Path
from comparison.command_line import app

def slowly(_):
    Path("ready").touch()
    for _ in range(3000):  # a signal just before one long sleep would wait for its end
        time.sleep(0.02)

def command(**_):
{body}

app.app = command
app.main(["{name}"])
"""
SLEEP = """
    from comparison.workers import run_all
    Path("ready").touch()
    run_all(time.sleep, [(60.0,)] * 3, jobs=2, on_death=lambda i, why: why)
"""
WRITE = """
    from bent_beam import files
    files.os.fsync = slowly
    files.write_atomically(Path("out/beam.toml"), "text")
"""
SWALLOWS = """
    app.PATIENCE = 0.2
    try:
        slowly(None)
    except KeyboardInterrupt:
        {}
"""


def at_work(program, folder, *words):
    """A program in ``folder``, at work from the moment ``ready`` is there."""
    (folder / "ready").unlink(missing_ok=True)
    process = started(*words, program=program, cwd=folder)
    until(lambda: (folder / "ready").exists() or process.poll() is not None, 500.0, 0.002)
    return process


def command(name, folder, before=""):
    folder.mkdir(exist_ok=True)
    short = CASE.replace("length = 20.0", "length = 2.0\ndamping = 0.01")
    (folder / "case.toml").write_text(f"{short}[run]\nend_time = 0.01\n")
    return at_work(before + (FEW_ROWS if name == "report" else "") + MAIN, folder, *COMMANDS[name].split())


def interrupted(process, send, how):
    """The one line that the command says."""
    send(process.pid, how)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 130 and out == "" and err.count("\n") == 1, err
    return err


def written(folder):
    return [file for file in (folder / "out").rglob("*") if file.is_file()]


READERS = {  # which raise for half of a file
    ".json": json.loads,
    ".toml": lambda content: tomllib.loads(content.decode()),
    ".nc": lambda content: h5py.File(io.BytesIO(content))["gap"][()],
    ".png": lambda content: Image.open(io.BytesIO(content)).load(),
}
READERS[".gif"] = READERS[".png"]
ENDS = {".html": b"</html>", ".pdf": b"%%EOF"}


def readable(file: Path) -> bool:
    """Whether a file is whole, by its kind."""
    content = file.read_bytes()
    READERS.get(file.suffix, bytes)(content)
    return bool(content) and file.suffix != ".part" and content.rstrip().endswith(ENDS.get(file.suffix, b""))


@pytest.mark.parametrize("after", [0.0, *(pytest.param(s, marks=pytest.mark.verify) for s in (0.4, 1.5))])
def test_workers_end_with_the_command_and_say_nothing(after, tmp_path):
    """Two workers asleep, or still starting: Ctrl-C reaches all processes of a terminal at once."""
    process = at_work(A_COMMAND.format(body=SLEEP, name="match"), tmp_path)
    time.sleep(after)
    assert "goes on from there" in interrupted(process, os.killpg, signal.SIGINT)
    until(lambda: ended(process.pid), 20.0)


@pytest.mark.parametrize("how", ["SIGTERM", *(pytest.param(s, marks=pytest.mark.verify) for s in ("SIGINT", "SIGHUP"))])
def test_a_file_that_is_being_written_is_whole_or_not_there(how, tmp_path):
    process = at_work(A_COMMAND.format(body=WRITE, name="new"), tmp_path)
    assert "no half of a file" in interrupted(process, os.kill, getattr(signal, how))
    assert list((tmp_path / "out").iterdir()) == []


REFUSED = "raise ValueError(\"path: 'exudyn' is installed but does not load\")"


@pytest.mark.parametrize("then", [REFUSED, 'raise ImportError("initialization failed")', "time.sleep(60)"])
def test_an_interrupt_that_a_library_or_a_solver_swallows_is_told_all_the_same(then, tmp_path):
    """Exudyn says that its module could not be imported, where it is interrupted while it loads, and its path so."""
    process = at_work(A_COMMAND.format(body=SWALLOWS.format(then), name="simulate"), tmp_path)
    assert "interrupted" in interrupted(process, os.kill, signal.SIGINT)


@pytest.mark.verify
@pytest.mark.parametrize("name", SOME)
def test_an_interrupt_leaves_whole_files_and_says_how_to_go_on(name, tmp_path):
    numbers = random.Random(f"{SEED} interrupted {name}")
    whole, folder = tmp_path / "whole", tmp_path / "interrupted"

    def finished(place):
        process, began = command(name, place), time.perf_counter()  # from ``ready`` on
        out, err = process.communicate(timeout=500)
        assert process.returncode == 0, err
        made = sorted(file.relative_to(place) for file in written(place))
        return time.perf_counter() - began, made, out.count("\n")

    seconds, made, lines = finished(whole)
    assert made and all(readable(whole / file) for file in made)
    stopped, tries, span = 0, 0, seconds
    while stopped < INTERRUPTS and tries < 4 * INTERRUPTS:
        tries += 1
        process = command(name, folder)
        time.sleep(numbers.uniform(0.0, 0.95) * span)
        how = numbers.choice([signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
        if process.poll() is None:
            os.killpg(process.pid, how)
        out, err = process.communicate(timeout=60)
        until(lambda: ended(process.pid), 20.0)  # noqa: B023
        if process.returncode == 130:
            stopped += 1
            said, *more = [line for line in err.splitlines() if "leave --jobs out" not in line]
            assert "interrupted" in said and "same command again" in said, err
            assert out.count("\n") in (0, lines)  # the answer stands before figures are written, whole or not at all
            assert not more or (how == signal.SIGHUP and "resource_tracker" in err), err  # joblib's, which it also ends
        else:  # it had just finished: kernels are compiled and runs kept now, and take less time
            assert process.returncode == 0, err
            span *= 0.5
        assert all(readable(file) for file in written(folder))
        assert not list(folder.rglob("*.part"))
    assert finished(folder)[1] == made
    assert stopped or seconds < 1.0


@pytest.mark.parametrize("name", SOME)
def test_a_full_disk_is_told_by_the_name_of_the_file_and_takes_none_of_those_before(name, tmp_path):
    """No file of this process and its children may grow beyond 100 bytes: kernels and runs cannot be kept either."""
    full = "import os, resource, sys\nsys.dont_write_bytecode = True\nos.environ['PYTHONDONTWRITEBYTECODE'] = '1'\n"
    full += "resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))\n"  # Python would keep modules cut short, too
    process = command(name, tmp_path, full)
    _, err = process.communicate(timeout=500)
    assert process.returncode in (2, 3) and "Traceback" not in err, err
    assert "out" in err and "File too large" in err, err
    assert not [file for file in written(tmp_path) if file.suffix == ".part" or not file.stat().st_size]
    until(lambda: ended(process.pid), 20.0)
