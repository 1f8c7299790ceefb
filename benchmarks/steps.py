"""The cost of a time step, as a multiple of what a plain code of the same size cannot do without, taken in turn: one
compiled LDLᵀ at half bandwidth 3, with constant steps its substitutions alone, as the matrix stays.

Ratios are medians of pairs, so that other work on the machine weighs on both alike.
"""

import math
import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import Any

from benchmarks.record import Row
from benchmarks.timing import STEPS, plain_step, prepared_step
from hermite_fe.contacts import MeanContact, NodeContact
from hermite_fe.integrators import MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition

SIZES = (500, 1_000, 2_000, 5_000, 10_000, 20_000)
ROUNDS = 60
SCHEMES = (  # goals of constant and of growing steps
    ("Moreau–Jean", MoreauJean(), (5.0, 4.0)),
    ("Signorini", SignoriniPosition(), (5.0, 4.0)),
    ("generalised-α", NonsmoothGeneralizedAlpha(), (10.0, 8.0)),
)
NODES, MEANS = (kind(hold=0, hold_until=0.0) for kind in (NodeContact, MeanContact))
BEAMS: tuple[tuple[str, tuple[int, ...], dict[str, Any]], ...] = (  # sizes, and arguments of prepared_step
    ("", SIZES, {"contact": NODES}),
    (", means", SIZES, {"contact": MEANS}),
    # a zone that rebounds: two to five of the nodes are closed, others in each step
    (", eight rounds a step", (5_000,), {"contact": NODES, "half_length": 5.0, "length": 1e-4}),
)


def paired(steps: Callable[[], None], yardstick: Callable[[], None], rounds: int) -> tuple[float, float]:
    """Median of step/yardstick, :data:`STEPS` of either in turn, and the shortest step, s."""
    taken = []
    for _ in range(rounds):
        a = time.perf_counter()
        steps()
        b = time.perf_counter()
        yardstick()
        taken.append((b - a, time.perf_counter() - b))
    return statistics.median(own / other for own, other in taken), min(taken)[0] / STEPS


def exponent(sizes: Sequence[int], ratios: Sequence[float]) -> float | None:
    """Growth of the cost with nodes, from 2,000 nodes on, where a call's own cost no longer counts. Taken from the
    ratios, for the yardstick's cost grows like the number of nodes."""
    pairs = [(math.log(n), math.log(r * n)) for n, r in zip(sizes, ratios, strict=True) if n >= 2_000]
    return statistics.linear_regression(*zip(*pairs, strict=True)).slope if len(pairs) >= 3 else None


def measure() -> Iterator[Row]:
    """For each kind of step the worst ratio of the sizes, and how its cost grows with them."""
    for (beam, sizes, parts), (scheme, integrator, goals) in product(BEAMS, SCHEMES):
        for growing, goal in zip((False, True), goals, strict=True):
            label = f"{scheme}{beam}, {'growing' if growing else 'constant'}"
            ratios, seconds = [], []
            for nodes in sizes:
                step = prepared_step(nodes, integrator, growing=growing, **parts)
                step()
                unit = plain_step(nodes, factors=growing)
                ratio, shortest = paired(step, unit, max(10, min(ROUNDS, 200_000 // nodes)))
                ratios.append(round(ratio, 4))
                seconds.append(float(f"{shortest:.3g}"))
            about = {"nodes": sizes, "ratio": ratios, "seconds": seconds}
            yield Row(f"{label} / plain LDLᵀ", max(ratios), goal, about=about)
            if (slope := exponent(sizes, ratios)) is not None:
                yield Row(f"{label}: exponent", slope, None)
