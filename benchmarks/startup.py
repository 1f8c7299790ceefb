"""How long the command takes to answer, over what it cannot do without, each in a fresh interpreter, in turn; and how
long a small simulation takes, the first on a machine, which compiles, and the next, likewise.
Python keeps its bytecode meanwhile, as it does of whatever is installed.

python -m benchmarks.startup [--rounds 15] [--out benchmarks/results/startup.json]
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.record import Row, keep, options, said

ROOT = Path(__file__).resolve().parents[1]
COMMAND = ["-m", "comparison.command_line"]
YARDSTICKS = {
    "numpy, scipy.special, typer": ["-c", "import numpy, scipy.special, typer"],
    "typer": ["-c", "import typer"],
}
ROWS = (
    ("theory", [*COMMAND, "theory", "--kappa-over-nu", "0.5", "--json"], "numpy, scipy.special, typer", 1.6),
    ("predict", [*COMMAND, "predict", "cases/drill_pipe.toml", "--json"], "numpy, scipy.special, typer", 1.6),
    ("--help", [*COMMAND, "--help"], "typer", 1.2),
)
SIMULATION = [*COMMAND, "simulate", "cases/thesis_K10.toml", "--json", "--quiet"]
FIRST, NEXT = 20.0, 1.5  # s, goals on an idle machine, where
IDLE = 0.3  # s is what the first of the yardsticks takes (the least of thirty: 0.28 to 0.31)
NEXT_ROUNDS = 3


def seconds(words: list[str], **environment: str) -> float:
    """Of the clock, for one interpreter from start to end."""
    surroundings = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    started = time.perf_counter()
    subprocess.run(
        [sys.executable, *words], cwd=ROOT, stdout=subprocess.DEVNULL, check=True, env={**surroundings, **environment}
    )
    return time.perf_counter() - started


def against_yardstick(label: str, goal: float, words: list[str], rounds: int = 1, **environment: str) -> Row:
    """The least seconds of a command, ``rounds`` times, over those of the first yardstick before and after, with a
    ``goal`` in seconds of an idle machine; prints the row."""
    name, yardstick = next(iter(YARDSTICKS.items()))
    before = [seconds(yardstick) for _ in range(4)][1:]
    taken = [seconds(words, **environment) for _ in range(rounds)]
    least, unit = min(taken), statistics.median([*before, *(seconds(yardstick) for _ in range(3))])
    about = {"seconds": round(least, 2), "yardstick": name, "yardstick_seconds": round(unit, 3)}
    return said(Row(f"{label} ({least:.1f} s) / import", least / unit, round(goal / IDLE, 1), about=about))


def measure_simulation() -> list[Row]:
    """A small simulation with its loops to be compiled, and with them compiled."""
    with tempfile.TemporaryDirectory() as folder:
        return [
            against_yardstick("first simulate, compiling", FIRST, SIMULATION, XDG_CACHE_HOME=folder),
            against_yardstick("next simulate", NEXT, SIMULATION, NEXT_ROUNDS, XDG_CACHE_HOME=folder),
        ]


def measure(rounds: int) -> list[Row]:
    """Median ratios of pairs; prints them."""
    taken: dict[str, list[float]] = {name: [] for name in (*YARDSTICKS, *(row[0] for row in ROWS))}
    for _ in range(rounds + 1):  # the first round fills caches
        for name, words in (*YARDSTICKS.items(), *((name, words) for name, words, _, _ in ROWS)):
            taken[name].append(seconds(words))
    out = []
    for name, _, yardstick, goal in ROWS:
        ratio = statistics.median(a / b for a, b in zip(taken[name][1:], taken[yardstick][1:]))
        about = {"seconds": round(min(taken[name][1:]), 3), "yardstick": yardstick}
        out.append(said(Row(f"bentbeam {name} / import {yardstick}", ratio, goal, about=about)))
    return out


def main(words: list[str] | None = None) -> list[Row]:
    arguments = options("startup", __doc__, rounds=15).parse_args(words)
    return keep(arguments.out, [*measure(arguments.rounds), *measure_simulation()])


if __name__ == "__main__":
    main()
