"""The waits of a user: three commands, each from the start of its interpreter to its last line, in a folder of its own
with nothing stored, on two processes (match: its default), all compiled beforehand. Each is a multiple of importing
NumPy, SciPy and typer, before and after, with its goal in seconds of an idle machine (benchmarks/startup.py).
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator

from benchmarks.record import Row
from benchmarks.startup import COMMAND, SIMULATION, against_yardstick, seconds
from hermite_fe.integrators import INTEGRATORS

ROWS: tuple[tuple[str, list[str], float], ...] = (  # name, words (OUT: the folder), goal
    ("match", ["match"], 45.0),
    ("report", ["report", "--jobs", "2", "--out", "OUT/report"], 90.0),
    ("gallery", ["gallery", "--jobs", "2", "--out", "OUT/gallery"], 150.0),
)


def measure() -> Iterator[Row]:
    """The commands, after a small simulation an integrator, which compiles what is not in the cache."""
    for kind in INTEGRATORS:
        seconds([*SIMULATION, "--set", f"hermite.integrator.kind={kind}"])
    for name, words, goal in ROWS:
        with tempfile.TemporaryDirectory() as folder:
            here = [word.replace("OUT", folder) for word in words]
            yield against_yardstick(name, goal, [*COMMAND, *here, "--quiet"], BENTBEAM_STORE=f"{folder}/store")
