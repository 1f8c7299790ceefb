"""One seed for a whole fuzz run, the same in every worker process, printed so that the run can be repeated."""

import os
import random

FUZZ = bool(os.environ.get("FUZZ"))
if FUZZ:
    os.environ.setdefault("FUZZ_SEED", str(random.SystemRandom().randrange(2**32)))


def pytest_report_header():
    return f"fuzz seed: FUZZ_SEED={os.environ['FUZZ_SEED']}" if FUZZ else None
