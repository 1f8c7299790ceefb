"""How long the theory takes for a million quadruples (κ/ν, α, ψ, χ), one core.

python -m benchmarks.theory [--rounds 3] [--out benchmarks/results/theory.json]
"""

from __future__ import annotations

import time

import numpy as np

from benchmarks.record import Row, keep, options, said
from theory.contact import contact_parameters

COUNT = 1_000_000
GOAL = 5.0  # s


def measure(rounds: int) -> list[Row]:
    """The shortest time, s, of impacts drawn evenly in log κ/ν from 1e-6 to 10, and in α, ψ, χ from −4 to 4."""
    random = np.random.default_rng(0)
    kappa = 10.0 ** random.uniform(-6.0, 1.0, COUNT)
    alpha, psi, chi = random.uniform(-4.0, 4.0, (3, COUNT))
    contact_parameters(kappa[:1000], alpha[:1000], psi[:1000], chi[:1000])
    taken = []
    for _ in range(rounds):
        started = time.perf_counter()
        contact_parameters(kappa, alpha, psi, chi)
        taken.append(time.perf_counter() - started)
    return [said(Row("theory, a million quadruples, s", min(taken), GOAL))]


def main(words: list[str] | None = None) -> list[Row]:
    arguments = options("theory", __doc__, rounds=3).parse_args(words)
    return keep(arguments.out, measure(arguments.rounds))


if __name__ == "__main__":
    main()
