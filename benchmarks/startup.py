"""Start-up of the command, as a multiple of importing the libraries that it needs, each in a fresh interpreter, in
turn; and likewise a small simulation: the first on a machine, which compiles, and the next. Python keeps its bytecode.
Beside it the impulse of a long beam to 0.1 %, here and in 60 lines of SciPy, libraries included.

The waits of a user: commands, each from the start of its interpreter to its last line, in a folder of its own with
nothing stored, all compiled beforehand. Each is a multiple of importing NumPy, SciPy and typer, before and after, with
its goal in seconds of an idle machine. All times are those of processors, of all processes of a command.
"""

import os
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from benchmarks.record import Row

ROOT = Path(__file__).resolve().parents[1]
SCIPY = "benchmarks/scipy_solver.py"
COMMAND = ["-m", "comparison.command_line"]
YARDSTICKS = {name: ["-c", f"import {name}"] for name in ("numpy, scipy.special, typer", "typer")}
ROWS = (  # name, words, yardstick, goal
    ("theory", ["theory", "--kappa-over-nu", "0.5", "--json"], "numpy, scipy.special, typer", 1.6),
    ("predict", ["predict", "cases/drill_pipe.toml", "--json"], "numpy, scipy.special, typer", 1.6),
    ("--help", ["--help"], "typer", 2.5),
)
README = [word for kappa in ("0.01", "0.1", "0.25", "0.5", "0.8") for word in ("--kappa-over-nu", kappa)]
WAITS = (  # name, words (OUT: the folder), goal
    ("predict tube", ["predict", "cases/tube.toml"], 3.0),
    ("bounce tube", ["bounce", "cases/tube.toml"], 3.0),
    ("match of the README", ["match", "--methods", "cases/methods/one_of_each.toml", *README], 12.0),
    ("report", ["report", "--jobs", "2", "--out", "OUT/report"], 90.0),
    ("gallery", ["gallery", "--jobs", "2", "--out", "OUT/gallery"], 300.0),
)
COMPILED = ("moreau_jean", "signorini_position", "nonsmooth_generalized_alpha", "generalized_alpha_penalty")
ROUNDS = 15
IMPULSE = "import hermite_fe as h, bent_beam as b; h.simulate(b.Impact.dimensionless(0.5), end_time=0.1, save=2)"
SIMULATION = [*COMMAND, "simulate", "cases/thesis_K10.toml", "--json", "--quiet"]
FIRST, NEXT = 12.0, 1.5  # s, goals on an idle machine, where
IDLE = 0.3  # s, of the first of the yardsticks (the least of thirty: 0.28 to 0.31)


def seconds(words: list[str], **environment: str) -> float:
    """Of processors, for one interpreter from start to end and all that it starts."""
    around = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"} | environment
    before = os.times()
    subprocess.run([sys.executable, *words], cwd=ROOT, stdout=subprocess.DEVNULL, check=True, env=around)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


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
        ours, plain = (min(seconds(words) for _ in range(4)) for words in (["-c", IMPULSE], [SCIPY]))
        about = {"seconds": round(ours, 3), "scipy_seconds": round(plain, 3)}
        yield Row("impulse to 0.1 % / 60 lines of SciPy", ours / plain, None, about=about)


def waits() -> Iterator[Row]:
    """The commands, after a small simulation by each integrator that they take, which compiles what is not kept."""
    for kind in COMPILED:
        seconds([*SIMULATION, "--set", f"hermite.integrator.kind={kind}"])
    for name, words, goal in WAITS:
        with tempfile.TemporaryDirectory() as folder:
            here = [word.replace("OUT", folder) for word in words]
            yield against_yardstick(name, goal, [*COMMAND, *here, "--quiet"], BENTBEAM_STORE=f"{folder}/store")
