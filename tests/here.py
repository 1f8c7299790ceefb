"""Where the project is; ``FUZZ`` (`make fuzz`) draws new input, from a seed that every worker process inherits."""

import os
import random
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CASES = ROOT / "cases"
FUZZ = bool(os.environ.get("FUZZ"))
if FUZZ and not os.environ.get("FUZZ_SEED"):
    os.environ["FUZZ_SEED"] = str(random.SystemRandom().randrange(2**32))
SEED = os.environ.get("FUZZ_SEED") or "5"
