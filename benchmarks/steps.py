"""What a time step costs, as a multiple of one LAPACK banded factor-and-solve of the same size, taken in turn.

    python -m benchmarks.steps [--sizes 500,1000,…] [--rounds 60] [--out benchmarks/results/steps.json]

Prints a table (ratio, goal, met or not) and keeps it with the processor's model and the versions. Ratios are medians of
pairs, so that other work on the machine weighs on both alike.
"""

from __future__ import annotations

import argparse
import math
import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.record import RESULTS, keep
from benchmarks.timing import HALF_LENGTH, lapack_step, prepared_step
from hermite_fe.contacts import Contact, MeanContact, MiddleContact, NodeContact
from hermite_fe.integrators import Integrator, MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition

SIZES = (500, 1_000, 2_000, 4_000, 10_000, 20_000, 50_000)
EXPONENT = 1.03  # goal: of cost over nodes
START = 0.06  # t*; growing steps grow from 0.05 on


@dataclass(frozen=True)
class Row:
    """One kind of step: ``goals`` for constant and growing steps."""

    label: str
    integrator: Integrator
    goals: tuple[float, float]
    contact: Contact
    half_length: float = HALF_LENGTH


NODES, MIDDLES, MEANS = (kind(hold=0, hold_until=0.0) for kind in (NodeContact, MiddleContact, MeanContact))
THETA, ALPHA = (0.55, 0.85), (1.0, 2.0)
ROWS = (
    Row("Moreau–Jean", MoreauJean(), THETA, NODES),
    Row("Signorini", SignoriniPosition(), THETA, NODES),
    Row("generalised-α", NonsmoothGeneralizedAlpha(), ALPHA, NODES),
    Row("Moreau–Jean, half the nodes closed", MoreauJean(), THETA, NODES, 5.0),
    Row("Signorini, half the nodes closed", SignoriniPosition(), THETA, NODES, 5.0),
    Row("generalised-α, half the nodes closed", NonsmoothGeneralizedAlpha(), ALPHA, NODES, 5.0),
    Row("Moreau–Jean, middles", MoreauJean(), THETA, MIDDLES),
    Row("Moreau–Jean, means", MoreauJean(), THETA, MEANS),
    Row("Signorini, means", SignoriniPosition(), THETA, MEANS),
    Row("generalised-α, means", NonsmoothGeneralizedAlpha(), ALPHA, MEANS),
)


def paired(step: Callable[[], None], yardstick: Callable[[], None], rounds: int) -> tuple[float, float]:
    """Median of step/yardstick, taken in turn, and the shortest step, s."""
    ratios, steps = [], []
    for _ in range(rounds):
        a = time.perf_counter()
        step()
        b = time.perf_counter()
        yardstick()
        c = time.perf_counter()
        ratios.append((b - a) / (c - b))
        steps.append(b - a)
    return statistics.median(ratios), min(steps)


def exponent(sizes: list[int], seconds: list[float]) -> float:
    """Growth of the cost with nodes, from 2,000 nodes on, where a call's own cost no longer counts."""
    pairs = [(math.log(n), math.log(s)) for n, s in zip(sizes, seconds, strict=True) if n >= 2_000]
    if len(pairs) < 2:
        return math.nan
    x, y = zip(*pairs, strict=True)
    return statistics.linear_regression(x, y).slope


def measure(sizes: list[int], rounds: int) -> list[dict[str, Any]]:
    """All rows at all sizes; prints them as they come."""
    out: list[dict[str, Any]] = []
    print(f"{'step':46}" + "".join(f"{n:>8}" for n in sizes) + "    goal  met   exponent")
    for row in ROWS:
        for growing, goal in zip((False, True), row.goals, strict=True):
            ratios, seconds = [], []
            for nodes in sizes:
                step = prepared_step(
                    nodes, row.integrator, row.contact, growing=growing, start=START, half_length=row.half_length
                )
                for _ in range(3):
                    step()
                ratio, shortest = paired(step, lapack_step(nodes), max(10, min(rounds, 400_000 // nodes)))
                ratios.append(round(ratio, 3))
                seconds.append(shortest)
            label = f"{row.label}, {'growing' if growing else 'constant'}"
            slope = exponent(sizes, seconds)
            met = max(ratios) <= goal
            figures = "".join(f"{r:8.2f}" for r in ratios)
            print(f"{label:46}{figures}{goal:8.2f}  {met!s:5}{slope:8.2f}", flush=True)
            out.append(
                {
                    "step": label,
                    "nodes": sizes,
                    "ratio": ratios,
                    "seconds": [float(f"{s:.3g}") for s in seconds],
                    "goal": goal,
                    "met": met,
                    "exponent": None if math.isnan(slope) else round(slope, 3),
                    "exponent_goal": EXPONENT,
                }
            )
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", default=",".join(map(str, SIZES)))
    parser.add_argument("--rounds", type=int, default=60)
    parser.add_argument("--out", type=Path, default=RESULTS / "steps.json")
    arguments = parser.parse_args()
    rows = measure([int(n) for n in arguments.sizes.split(",")], arguments.rounds)
    keep(arguments.out, rows)


if __name__ == "__main__":
    main()
