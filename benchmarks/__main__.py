"""All benchmarks that have goals, one after the other: ratios, and seconds of this machine.

python -m benchmarks [startup theory exudyn steps waits] [--out DIR]
"""

import argparse
import sys
import time
from pathlib import Path

from benchmarks import exudyn, startup, steps, theory
from benchmarks.record import RESULTS, Row, keep
from bent_beam.versions import processor, versions

ALL = {  # the longest come last
    "startup": startup.measure,
    "theory": theory.measure,
    "exudyn": exudyn.measure,
    "steps": steps.measure,
    "waits": startup.waits,
}


def main() -> int:
    """Measure; 1 when a goal is missed."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(ALL))
    parser.add_argument("--out", type=Path, default=RESULTS, help="folder of NAME.json")
    asked = parser.parse_args()
    if unknown := set(asked.names) - ALL.keys():
        parser.error(f"benchmarks are {', '.join(ALL)} (got {', '.join(sorted(unknown))})")
    started = time.perf_counter()
    rows: list[Row] = []
    for name in asked.names or ALL:
        print(f"\n{name}", flush=True)
        own = []
        for row in ALL[name]():
            print(row, flush=True)
            own.append(row)
        keep(asked.out / f"{name}.json", [row.to_dict() for row in own])
        rows += own
    with_goal = [row for row in rows if row.goal is not None]
    print(f"\n{processor()}, Python {sys.version.split()[0]}, {versions()}")
    print(f"{sum(row.met for row in with_goal)} of {len(with_goal)} goals met, {time.perf_counter() - started:.0f} s")
    return 0 if all(row.met for row in with_goal) else 1


if __name__ == "__main__":
    sys.exit(main())
