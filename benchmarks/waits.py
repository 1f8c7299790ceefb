"""What a user waits for: three commands, each from the start of its interpreter to its last line, in a folder of its
own with nothing stored, on two processes (match: as many as it takes when nobody says), kernels compiled beforehand.
Goals in seconds are those of an idle machine with two cores: with other work on it they may be missed.

python -m benchmarks.waits [--rounds 1] [--out benchmarks/results/waits.json]
"""

from __future__ import annotations

import tempfile

from benchmarks.record import Row, keep, options, said
from benchmarks.startup import COMMAND, SIMULATION, seconds
from hermite_fe.integrators import INTEGRATORS

ROWS: tuple[tuple[str, list[str], float], ...] = (  # name, words (OUT: the folder), goal
    ("match", ["match"], 45.0),
    ("report", ["report", "--jobs", "2", "--out", "OUT/report"], 90.0),
    ("gallery", ["gallery", "--jobs", "2", "--out", "OUT/gallery"], 150.0),
)


def compile_kernels() -> None:
    """Where they are not kept yet: by a small simulation an integrator."""
    for kind in INTEGRATORS:
        seconds([*SIMULATION, "--set", f"hermite.integrator.kind={kind}"])


def measure(rounds: int) -> list[Row]:
    """The least seconds of each command; prints them."""
    compile_kernels()
    out = []
    for name, words, goal in ROWS:
        taken = []
        for _ in range(rounds):
            with tempfile.TemporaryDirectory() as folder:
                here = [word.replace("OUT", folder) for word in words]
                taken.append(seconds([*COMMAND, *here, "--quiet"], BENTBEAM_STORE=f"{folder}/store"))
        out.append(said(Row(f"bentbeam {name}, idle machine, s", min(taken), goal)))
    return out


def main(words: list[str] | None = None) -> list[Row]:
    arguments = options("waits", __doc__, rounds=1).parse_args(words)
    return keep(arguments.out, measure(arguments.rounds))


if __name__ == "__main__":
    main()
