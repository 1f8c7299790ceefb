"""What a time step costs, as a multiple of one LAPACK banded factor-and-solve of the same size, taken in turn.

    python -m benchmarks.steps [--sizes 500,1000,…] [--rounds 60] [--out benchmarks/results/steps.json]

Prints a table (ratio, goal, met or not) and keeps it with the processor's model and the versions. Ratios are medians of
pairs, so that other work on the machine weighs on both alike. A call takes some steps, as between two saved instants.
"""

from __future__ import annotations

import math
import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from benchmarks.record import Row, keep, options, said
from benchmarks.timing import HALF_LENGTH, STEP, lapack_step, prepared_step
from hermite_fe.contacts import Contact, MeanContact, NodeContact
from hermite_fe.integrators import Integrator, MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition

SIZES = (500, 1_000, 2_000, 5_000, 10_000, 20_000)
STEPS = 8  # a call
START = 0.06  # t*; growing steps grow from 0.05 on


@dataclass(frozen=True)
class Kind:
    """One kind of step: ``goals`` for constant and growing steps."""

    label: str
    integrator: Integrator
    goals: tuple[float, float]
    contact: Contact
    half_length: float = HALF_LENGTH
    sizes: tuple[int, ...] | None = None  # of its own
    step: float = STEP  # t*, of constant steps


NODES, MEANS = (kind(hold=0, hold_until=0.0) for kind in (NodeContact, MeanContact))
THETA, ALPHA = (0.6, 1.0), (1.2, 2.0)
SCHEMES = (
    ("Moreau–Jean", MoreauJean(), THETA),
    ("Signorini", SignoriniPosition(), THETA),
    ("generalised-α", NonsmoothGeneralizedAlpha(), ALPHA),
)
# half length, l*, and size of a beam of whose nodes a thousand lie on the wall, and steps in which the front passes one
CROWDED = (5.0, (5_000,), 1e-4)
KINDS = (
    *(Kind(name, kind, goals, NODES) for name, kind, goals in SCHEMES),
    *(Kind(f"{name}, means", kind, goals, MEANS) for name, kind, goals in SCHEMES),
    *(Kind(f"{name}, a thousand on the wall", kind, goals, NODES, *CROWDED) for name, kind, goals in SCHEMES),
)


def paired(steps: Callable[[], None], yardstick: Callable[[], None], rounds: int) -> tuple[float, float]:
    """Median of step/yardstick, :data:`STEPS` of one and one of the other in turn, and the shortest step, s."""
    ratios, taken = [], []
    for _ in range(rounds):
        a = time.perf_counter()
        steps()
        b = time.perf_counter()
        yardstick()
        c = time.perf_counter()
        ratios.append((b - a) / STEPS / (c - b))
        taken.append((b - a) / STEPS)
    return statistics.median(ratios), min(taken)


def exponent(sizes: Sequence[int], ratios: Sequence[float]) -> float | None:
    """Growth of the cost with nodes, from 2,000 nodes on, where a call's own cost no longer counts. Taken from the
    ratios, for LAPACK's cost grows like the number of nodes (50 to 52 ns each from 2,000 to 50,000)."""
    pairs = [(math.log(n), math.log(r * n)) for n, r in zip(sizes, ratios, strict=True) if n >= 2_000]
    if len(pairs) < 3:
        return None
    x, y = zip(*pairs, strict=True)
    return statistics.linear_regression(x, y).slope


def measure(sizes: tuple[int, ...], rounds: int, only: str = "") -> list[Row]:
    """The kinds whose labels hold ``only``: for each the worst ratio of the sizes, and how its cost grows with them."""
    out: list[Row] = []
    for kind in KINDS:
        if only not in kind.label:
            continue
        for growing, goal in zip((False, True), kind.goals, strict=True):
            taken = kind.sizes or sizes
            ratios, seconds = [], []
            for nodes in taken:
                step = prepared_step(
                    nodes,
                    kind.integrator,
                    kind.contact,
                    growing=growing,
                    start=START,
                    half_length=kind.half_length,
                    length=kind.step,
                    steps=STEPS,
                )
                step()
                ratio, shortest = paired(step, lapack_step(nodes), max(10, min(rounds, 200_000 // nodes)))
                ratios.append(round(ratio, 4))
                seconds.append(shortest)
            label = f"{kind.label}, {'growing' if growing else 'constant'}"
            about = {"nodes": taken, "ratio": ratios, "seconds": [float(f"{s:.3g}") for s in seconds]}
            print(f"{'':12}" + "".join(f"{n:>8}{r:6.2f}" for n, r in zip(taken, ratios, strict=True)))
            out.append(said(Row(f"{label} / LAPACK", max(ratios), goal, about=about)))
            slope = exponent(taken, ratios)
            if slope is not None:
                out.append(said(Row(f"{label}: exponent", slope, None)))
    return out


def main(words: list[str] | None = None) -> list[Row]:
    parser = options("steps", __doc__, rounds=60)
    parser.add_argument("--sizes", default=",".join(map(str, SIZES)))
    parser.add_argument("--only", default="", help="kinds of step with this in their names")
    arguments = parser.parse_args(words)
    sizes = tuple(int(n) for n in arguments.sizes.split(","))
    return keep(arguments.out, measure(sizes, arguments.rounds, arguments.only))


if __name__ == "__main__":
    main()
