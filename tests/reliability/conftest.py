"""One seed for a whole fuzz run, the same in every worker process, printed at its end so that it can be repeated."""

import os
import random
from pathlib import Path

import pytest
from hypothesis.configuration import set_hypothesis_home_dir

set_hypothesis_home_dir(Path(__file__).parents[2] / ".hypothesis")  # kept: what it makes of all modules takes seconds
FUZZ = bool(os.environ.get("FUZZ"))
if FUZZ:
    os.environ.setdefault("FUZZ_SEED", str(random.SystemRandom().randrange(2**32)))


def pytest_terminal_summary(terminalreporter):
    if FUZZ:
        terminalreporter.write_line(f"fuzz seed: FUZZ_SEED={os.environ['FUZZ_SEED']}")


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    """Runs, and the partial history of one that fails, are kept where the command is started: not in the project."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("BENTBEAM_STORE", "store")
