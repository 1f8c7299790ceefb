"""All benchmarks that have goals, one after the other, and what they come to.

python -m benchmarks [startup theory exudyn steps waits]

Each keeps its figures in ``benchmarks/results``. Seconds, which are no ratios, are those of this machine.
"""

from __future__ import annotations

import importlib
import importlib.metadata
import sys
import time

from benchmarks.record import VERSIONS
from bent_beam.versions import processor

ALL = ("startup", "theory", "exudyn", "steps", "waits")


def main() -> int:
    names = sys.argv[1:] or ALL
    if unknown := set(names) - set(ALL):
        print(f"benchmarks are {', '.join(ALL)} (got {', '.join(sorted(unknown))})", file=sys.stderr)
        return 2
    started = time.perf_counter()
    rows = []
    for name in names:
        print(f"\n{name}", flush=True)
        rows += importlib.import_module(f"benchmarks.{name}").main([])
    print(f"\n{len(rows)} rows, {time.perf_counter() - started:.0f} s")
    print(f"{processor()}, Python {sys.version.split()[0]}")
    print(", ".join(f"{name} {importlib.metadata.version(name)}" for name in VERSIONS))
    for row in rows:
        print(row)
    missed = sum(not row.met for row in rows)
    goals = sum(row.goal is not None for row in rows)
    print(f"{goals - missed} of {goals} goals met")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
