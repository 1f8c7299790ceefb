"""How long the command takes to answer, over what it cannot do without, each in a fresh interpreter, in turn.

python -m benchmarks.startup [--rounds 15] [--out benchmarks/results/startup.json]
"""

from __future__ import annotations

import argparse
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from benchmarks.record import RESULTS, keep

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


def seconds(words: list[str]) -> float:
    """Of the clock, for one interpreter from start to end."""
    started = time.perf_counter()
    subprocess.run([sys.executable, *words], cwd=ROOT, stdout=subprocess.DEVNULL, check=True)
    return time.perf_counter() - started


def measure(rounds: int) -> list[dict[str, Any]]:
    """Median ratios of pairs; prints them."""
    taken: dict[str, list[float]] = {name: [] for name in (*YARDSTICKS, *(row[0] for row in ROWS))}
    for _ in range(rounds + 1):  # the first round fills caches
        for name, words in (*YARDSTICKS.items(), *((name, words) for name, words, _, _ in ROWS)):
            taken[name].append(seconds(words))
    out = []
    print(f"{'command':12}{'seconds':>9}{'ratio':>8}{'goal':>8}  met   over the import of")
    for name, _, yardstick, goal in ROWS:
        ratio = statistics.median(a / b for a, b in zip(taken[name][1:], taken[yardstick][1:]))
        shortest = min(taken[name][1:])
        print(f"{name:12}{shortest:9.3f}{ratio:8.2f}{goal:8.2f}  {ratio <= goal!s:5} {yardstick}")
        row = {"command": name, "seconds": round(shortest, 3), "ratio": round(ratio, 3), "goal": goal}
        out.append({**row, "met": ratio <= goal, "yardstick": yardstick})
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--out", type=Path, default=RESULTS / "startup.json")
    arguments = parser.parse_args()
    keep(arguments.out, measure(arguments.rounds))


if __name__ == "__main__":
    main()
