"""Start-up of the command, as a multiple of importing the libraries that it needs, each in a fresh interpreter, in
turn; and likewise a small simulation: the first on a machine, which compiles, and the next. Python keeps its bytecode.

The waits of a user: three commands, each from the start of its interpreter to its last line, in a folder of its own
with nothing stored, on two processes (match: its default), all compiled beforehand. Each is a multiple of importing
NumPy, SciPy and typer, before and after, with its goal in seconds of an idle machine.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from benchmarks.record import Row
from hermite_fe.integrators import INTEGRATORS

ROOT = Path(__file__).resolve().parents[1]
COMMAND = ["-m", "comparison.command_line"]
YARDSTICKS = {name: ["-c", f"import {name}"] for name in ("numpy, scipy.special, typer", "typer")}
ROWS = (  # name, words, yardstick, goal
    ("theory", ["theory", "--kappa-over-nu", "0.5", "--json"], "numpy, scipy.special, typer", 1.6),
    ("predict", ["predict", "cases/drill_pipe.toml", "--json"], "numpy, scipy.special, typer", 1.6),
    ("--help", ["--help"], "typer", 1.2),
)
WAITS = (  # name, words (OUT: the folder), goal
    ("match", ["match"], 45.0),
    ("report", ["report", "--jobs", "2", "--out", "OUT/report"], 90.0),
    ("gallery", ["gallery", "--jobs", "2", "--out", "OUT/gallery"], 150.0),
)
ROUNDS = 15
SIMULATION = [*COMMAND, "simulate", "cases/thesis_K10.toml", "--json", "--quiet"]
FIRST, NEXT = 20.0, 1.5  # s, goals on an idle machine, where
IDLE = 0.3  # s, of the first of the yardsticks (the least of thirty: 0.28 to 0.31)


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
    ``goal`` in seconds of an idle machine."""
    name, yardstick = next(iter(YARDSTICKS.items()))
    before = [seconds(yardstick) for _ in range(4)][1:]
    least = min(seconds(words, **environment) for _ in range(rounds))
    unit = statistics.median([*before, *(seconds(yardstick) for _ in range(3))])
    about = {"seconds": round(least, 2), "yardstick": name, "yardstick_seconds": round(unit, 3)}
    return Row(f"{label} ({least:.1f} s) / import", least / unit, round(goal / IDLE, 1), about=about)


def measure() -> Iterator[Row]:
    """Median ratios of pairs, and a small simulation with its loops to be compiled, and with them compiled."""
    commands = YARDSTICKS | {name: [*COMMAND, *words] for name, words, _, _ in ROWS}
    taken = [{name: seconds(words) for name, words in commands.items()} for _ in range(ROUNDS + 1)][1:]  # caches filled
    for name, _, yardstick, goal in ROWS:
        ratio = statistics.median(one[name] / one[yardstick] for one in taken)
        about = {"seconds": round(min(one[name] for one in taken), 3), "yardstick": yardstick}
        yield Row(f"bentbeam {name} / import {yardstick}", ratio, goal, about=about)
    with tempfile.TemporaryDirectory() as folder:
        yield against_yardstick("first simulate, compiling", FIRST, SIMULATION, XDG_CACHE_HOME=folder)
        yield against_yardstick("next simulate", NEXT, SIMULATION, rounds=3, XDG_CACHE_HOME=folder)


def waits() -> Iterator[Row]:
    """The commands, after a small simulation an integrator, which compiles what is not in the cache."""
    for kind in INTEGRATORS:
        seconds([*SIMULATION, "--set", f"hermite.integrator.kind={kind}"])
    for name, words, goal in WAITS:
        with tempfile.TemporaryDirectory() as folder:
            here = [word.replace("OUT", folder) for word in words]
            yield against_yardstick(name, goal, [*COMMAND, *here, "--quiet"], BENTBEAM_STORE=f"{folder}/store")
