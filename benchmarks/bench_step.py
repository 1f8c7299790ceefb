"""One whole time step, active set included, next to one LAPACK banded factor-and-solve of the same size, in one run.

    make bench        # the `ratio` in extra_info is what counts: these machines drift
"""

import statistics
import time

import pytest

from benchmarks.timing import lapack_step, prepared_step
from hermite_fe.integrators import MoreauJean, NonsmoothGeneralizedAlpha

SIZES = (1_000, 2_000, 4_000, 10_000, 20_000)


def paired(step, yardstick, rounds=40):
    """Median of step/yardstick, taken in turn."""
    ratios = []
    for _ in range(rounds):
        a = time.perf_counter()
        step()
        b = time.perf_counter()
        yardstick()
        c = time.perf_counter()
        ratios.append((b - a) / (c - b))
    return statistics.median(ratios)


@pytest.mark.parametrize("nodes", SIZES)
@pytest.mark.parametrize("growing", [False, True], ids=["constant-step", "growing-step"])
def bench_moreau_jean(benchmark, nodes, growing):
    step = prepared_step(nodes, MoreauJean(), growing=growing)
    benchmark.extra_info["ratio_to_lapack"] = round(paired(step, lapack_step(nodes)), 3)
    benchmark.pedantic(step, rounds=20, warmup_rounds=2)
    print(f"\n{nodes} nodes, growing={growing}: step / LAPACK = {benchmark.extra_info['ratio_to_lapack']}")


@pytest.mark.parametrize("nodes", SIZES)
def bench_thesis_solver(benchmark, nodes):
    step = prepared_step(nodes, NonsmoothGeneralizedAlpha())
    benchmark.extra_info["ratio_to_lapack"] = round(paired(step, lapack_step(nodes)), 3)
    benchmark.pedantic(step, rounds=20, warmup_rounds=2)
    print(f"\n{nodes} nodes, thesis's solver: step / LAPACK = {benchmark.extra_info['ratio_to_lapack']}")
