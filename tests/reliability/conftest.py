"""One seed for a whole fuzz run, the same in every worker process, printed at its end so that it can be repeated."""

import os
import random

FUZZ = bool(os.environ.get("FUZZ"))
if FUZZ:
    os.environ.setdefault("FUZZ_SEED", str(random.SystemRandom().randrange(2**32)))


def pytest_terminal_summary(terminalreporter):
    if FUZZ:
        terminalreporter.write_line(f"fuzz seed: FUZZ_SEED={os.environ['FUZZ_SEED']}")
