"""What a user waits for: three commands, each from the start of its interpreter to its last line, in a folder of its
own with nothing stored, on two processes (match: as many as it takes when nobody says), all compiled beforehand.
Each as a multiple of what it takes to import NumPy, SciPy and typer, before and after, with its goal in seconds of an
idle machine (benchmarks/startup.py).

python -m benchmarks.waits [--out benchmarks/results/waits.json]
"""

from __future__ import annotations

import tempfile

from benchmarks.record import Row, keep, options
from benchmarks.startup import COMMAND, SIMULATION, against_yardstick, seconds
from hermite_fe.integrators import INTEGRATORS

ROWS: tuple[tuple[str, list[str], float], ...] = (  # name, words (OUT: the folder), goal
    ("match", ["match"], 45.0),
    ("report", ["report", "--jobs", "2", "--out", "OUT/report"], 90.0),
    ("gallery", ["gallery", "--jobs", "2", "--out", "OUT/gallery"], 150.0),
)


def compile_integrators() -> None:
    """Where they are not kept yet: by a small simulation an integrator."""
    for kind in INTEGRATORS:
        seconds([*SIMULATION, "--set", f"hermite.integrator.kind={kind}"])


def measure() -> list[Row]:
    """The least of each command; prints them."""
    compile_integrators()
    out = []
    for name, words, goal in ROWS:
        with tempfile.TemporaryDirectory() as folder:
            here = [word.replace("OUT", folder) for word in words]
            store = {"BENTBEAM_STORE": f"{folder}/store"}
            out.append(against_yardstick(name, goal, [*COMMAND, *here, "--quiet"], **store))
    return out


def main(words: list[str] | None = None) -> list[Row]:
    arguments = options("waits", __doc__).parse_args(words)
    return keep(arguments.out, measure())


if __name__ == "__main__":
    main()
