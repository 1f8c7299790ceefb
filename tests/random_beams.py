"""Problems drawn at random, each held to the same facts: what fails is named so that it can be drawn again."""

import os
import random
from collections.abc import Callable

import numpy as np

from bent_beam import Impact


def hold_for_many(drawn: Callable[[np.random.Generator], Impact], check: Callable[[Impact], None], count: int) -> None:
    """``check`` on ``count`` problems of ``drawn`` (``BEAMS`` of them) from a new seed (``BEAMS_SEED``), printed."""
    seed = int(os.environ.get("BEAMS_SEED", random.randrange(2**31)))
    print(f"seed {seed}")
    generator = np.random.default_rng(seed)
    for number in range(int(os.environ.get("BEAMS", count))):
        impact = drawn(generator)
        try:
            check(impact)
        except Exception as error:
            raise AssertionError(f"seed {seed}, problem {number}, {impact}: {error}") from error
