"""What a run costs in time and memory against nodes, steps and saved instants, and a sweep against its rows.

    python -m benchmarks.scale [--out benchmarks/results/scale.json]

Every row is a process of its own, whose largest resident memory the system tells. Prints the table of docs/scale.md.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from benchmarks.record import RESULTS, keep_rows

RUNS = (  # nodes, steps, saved instants
    (1_000, 10_000, 200),
    (10_000, 1_000, 200),
    (100_000, 100, 200),
    (100_000, 100, 20),
    (1_000, 1_000_000, 200),
    (100, 1_000_000, 200),
    (1_000, 10_000, 2_000),
    (1_000, 10_000, 10_000),
    (10_000, 4_000, 4_000),  # too much for memory: written to disk on the way
)
SWEEPS = {  # rows
    ("sweep", "two processes"): (1_000, 10_000),
    ("cluster", "a dask cluster, scheduler included"): (1_000, 10_000),
}
LENGTH = 100.0  # l*, half the beam: no wave comes back


def one_run(nodes: int, steps: int, saved: int) -> dict[str, Any]:
    """A half beam, constant steps; seconds of the steps, of all, and of a first step that compiles or loads kernels."""
    import hermite_fe
    from bent_beam import Impact
    from bent_beam.meshes import UniformMesh
    from hermite_fe.integrators import MoreauJean

    impact = Impact.dimensionless(0.5, length=2.0 * LENGTH)
    mesh = UniformMesh(LENGTH / (nodes - 1))
    integrator = MoreauJean(time_step=1e-4)
    hermite_fe.simulate(impact, end_time=2e-4, mesh=mesh, integrator=integrator, save=2)
    before = peak()
    started = time.perf_counter()
    history = hermite_fe.simulate(impact, end_time=1e-4 * steps, mesh=mesh, integrator=integrator, save=saved)
    return {
        "seconds": time.perf_counter() - started,
        "stepping": history.seconds,
        "megabytes": peak(),
        "before": before,
        "history": history.dataset.nbytes / 1e6,
    }


def nothing(row: int) -> dict[str, float]:
    """A row of a sweep that costs nothing, with an answer of the usual size."""
    return {f"number {k}": float(row) for k in range(20)}


def one_sweep(rows: int) -> dict[str, float]:
    """Rows that cost nothing, on two processes of this machine."""
    from comparison.workers import run_all

    run_all(nothing, [(row,) for row in range(10)], jobs=2)
    before, started = peak(), time.perf_counter()
    run_all(nothing, [(row,) for row in range(rows)], jobs=2)
    return {"seconds": time.perf_counter() - started, "megabytes": peak(), "before": before}


def one_cluster(rows: int) -> dict[str, float]:
    """The same on a dask cluster of two workers, whose scheduler is in this process."""
    from distributed import LocalCluster

    from comparison.workers import run_all

    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        address = cluster.scheduler_address
        run_all(nothing, [(row,) for row in range(10)], scheduler=address)
        before, started = peak(), time.perf_counter()
        run_all(nothing, [(row,) for row in range(rows)], scheduler=address)
        return {"seconds": time.perf_counter() - started, "megabytes": peak(), "before": before}


def peak() -> float:
    """Largest resident memory of this process so far, MB."""
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1.0 if sys.platform == "darwin" else 1024.0) / 1e6


def apart(kind: str, *numbers: int) -> dict[str, Any]:
    """One row in a process of its own."""
    words = [sys.executable, "-m", "benchmarks.scale", "--one", kind, *map(str, numbers)]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    found: dict[str, Any] = json.loads(done.stdout)
    return found


def measure() -> list[dict[str, Any]]:
    """All rows; prints them as they come."""
    out = []
    print("| nodes | steps | saved | seconds | ns a node and step | memory, MB | the history, MB |")
    print("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    for nodes, steps, saved in RUNS:
        row = apart("run", nodes, steps, saved)
        each = 1e9 * row["stepping"] / (nodes * steps)
        print(
            f"| {nodes:,} | {steps:,} | {min(saved, steps + 1):,} | {row['seconds']:.2f} | {each:.0f} | "
            f"{row['megabytes']:.0f} | {row['history']:.0f} |",
            flush=True,
        )
        out.append({"nodes": nodes, "steps": steps, "saved": saved, **row})
    print("\n| rows of a sweep | on | seconds | memory before, MB | after, MB |")
    print("| ---: | --- | ---: | ---: | ---: |")
    for (kind, on), sizes in SWEEPS.items():
        for rows in sizes:
            row = apart(kind, rows)
            memory = f"{row['before']:.0f} | {row['megabytes']:.0f}"
            print(f"| {rows:,} | {on} | {row['seconds']:.1f} | {memory} |", flush=True)
            out.append({"rows": rows, "on": on, **row})
    return out


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=RESULTS / "scale.json")
    parser.add_argument("--one", nargs="+", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        kind, *numbers = arguments.one
        one = {"run": one_run, "sweep": one_sweep, "cluster": one_cluster}[kind]
        print(json.dumps(one(*map(int, numbers))))
        return
    keep_rows(arguments.out, measure())


if __name__ == "__main__":
    main()
