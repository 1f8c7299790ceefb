"""The seed of a fuzz run is printed at its end so that it can be repeated; tests stand in folders of their own."""

import pytest
from here import FUZZ, ROOT, SEED
from hypothesis.configuration import set_hypothesis_home_dir

set_hypothesis_home_dir(ROOT / ".hypothesis")  # kept: what it makes of all modules takes seconds


def pytest_terminal_summary(terminalreporter):
    if FUZZ:
        terminalreporter.write_line(f"fuzz seed: FUZZ_SEED={SEED}")


@pytest.fixture(autouse=True)
def away_from_the_project(own_folder):
    pass
