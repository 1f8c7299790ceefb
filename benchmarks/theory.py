"""How long the theory takes for a million quadruples (κ/ν, α, ψ, χ), one core."""

import timeit
from collections.abc import Iterator

import numpy as np

from benchmarks.record import Row
from theory.contact import contact_parameters

COUNT = 1_000_000
GOAL = 5.0  # s
ROUNDS = 3


def measure() -> Iterator[Row]:
    """The shortest time, s, of impacts drawn evenly in log κ/ν from 1e-6 to 10, and in α, ψ, χ from −4 to 4."""
    random = np.random.default_rng(0)
    drawn = [10.0 ** random.uniform(-6.0, 1.0, COUNT), *random.uniform(-4.0, 4.0, (3, COUNT))]
    taken = timeit.repeat(lambda: contact_parameters(*drawn), number=1, repeat=ROUNDS)
    yield Row("theory, a million quadruples, s", min(taken), GOAL)
