"""Interrupts: one line that says how to go on, and files whole."""

import os
import signal
import time

import pytest
from called import started

SLEEP = """
import time
from pathlib import Path
from comparison.command_line import app
from comparison.workers import run_all

def match(**_):
    Path("ready").touch()
    run_all(time.sleep, [(60.0,)] * 3, jobs=2, on_death=lambda i, why: why)

app.app = match
app.main(["match"])
"""
WRITE = """
import time
from pathlib import Path
from bent_beam import files
from comparison.command_line import app

def slowly(_):
    Path("ready").touch()
    for _ in range(3000):  # a signal just before one long sleep would wait for its end
        time.sleep(0.02)

def new(**_):
    files.os.fsync = slowly
    files.write_atomically(Path("out/beam.toml"), "text")

app.app = new
app.main(["new"])
"""


def at_work(program, folder):
    """A program in ``folder``, at work from the moment ``ready`` is there."""
    process = started(program=program, cwd=folder)
    while not (folder / "ready").exists() and process.poll() is None:
        time.sleep(0.002)
    return process


def nothing_left_of(session):
    """Whether no process of the session is alive, soon: a machine may have other work."""
    for _ in range(1000):
        try:
            os.killpg(session, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    os.killpg(session, signal.SIGKILL)
    return False


@pytest.mark.parametrize("after", [0.0, *(pytest.param(s, marks=pytest.mark.verify) for s in (0.4, 1.5))])
def test_workers_end_with_the_command_and_say_nothing(after, tmp_path):
    """Two workers asleep, or still starting: Ctrl-C reaches all processes of a terminal at once."""
    process = at_work(SLEEP, tmp_path)
    time.sleep(after)
    os.killpg(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=30)
    assert process.returncode == 130 and out == "" and err.count("\n") == 1 and "goes on from there" in err, err
    assert nothing_left_of(process.pid)


@pytest.mark.parametrize("how", ["SIGTERM", *(pytest.param(s, marks=pytest.mark.verify) for s in ("SIGINT", "SIGHUP"))])
def test_a_file_that_is_being_written_is_whole_or_not_there(how, tmp_path):
    process = at_work(WRITE, tmp_path)
    process.send_signal(getattr(signal, how))
    out, err = process.communicate(timeout=30)
    assert process.returncode == 130 and out == "" and err.count("\n") == 1 and "no half of a file" in err, err
    assert list((tmp_path / "out").iterdir()) == []
