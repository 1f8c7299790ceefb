"""Time and memory of a run against nodes, steps and saved instants, and of a sweep against its rows.

Every row is a process of its own, whose largest resident memory the system tells. ``python -m benchmarks.scale`` prints
the tables of docs/scale.md and keeps them in ``benchmarks/results``.
"""

import contextlib
import multiprocessing
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from typing import Any

from benchmarks.record import RESULTS, keep

RUNS = (  # nodes, steps, saved instants
    (1_000, 10_000, 200),
    (10_000, 1_000, 200),
    (100_000, 100, 200),
    (100_000, 100, 20),
    (1_000, 1_000_000, 200),
    (100, 1_000_000, 200),
    (1_000, 10_000, 2_000),
    (1_000, 10_000, 10_000),
    (10_000, 4_000, 4_000),
)
SWEEPS = tuple((rows, on) for on in ("two processes", "a dask cluster, scheduler included") for rows in (1_000, 10_000))
LENGTH, STEP = 100.0, 1e-4  # l*, half the beam: no wave comes back; t*
Found = dict[str, Any]


def run(nodes: int, steps: int, saved: int) -> Found:
    """A half beam, constant steps; seconds of all and of the steps, after two steps that compile or load kernels."""
    import hermite_fe
    from bent_beam import Impact
    from bent_beam.meshes import UniformMesh
    from hermite_fe.integrators import MoreauJean

    impact = Impact.dimensionless(0.5, length=2.0 * LENGTH)
    parts: Any = {"mesh": UniformMesh(LENGTH / (nodes - 1)), "integrator": MoreauJean(time_step=STEP)}
    hermite_fe.simulate(impact, end_time=2 * STEP, save=2, **parts)
    before, started = peak(), time.perf_counter()
    history = hermite_fe.simulate(impact, end_time=STEP * steps, save=saved, **parts)
    found = {"seconds": time.perf_counter() - started, "stepping": history.seconds}
    return found | {"megabytes": peak(), "before": before, "history": history.dataset.nbytes / 1e6}


def nothing(row: int) -> dict[str, float]:
    """A row of a sweep that costs nothing, with an answer of the usual size."""
    return {f"number {k}": float(row) for k in range(20)}


def sweep(rows: int, on: str) -> Found:
    """Rows that cost nothing, on two processes of this machine, or two workers of a cluster whose scheduler is here."""
    from comparison.workers import run_all

    with contextlib.ExitStack() as stack:
        where: dict[str, Any] = {"jobs": 2}
        if on.startswith("a dask"):
            from distributed import LocalCluster

            cluster = LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None)
            where = {"scheduler": stack.enter_context(cluster).scheduler_address}
        run_all(nothing, [(row,) for row in range(10)], **where)
        before, started = peak(), time.perf_counter()
        run_all(nothing, [(row,) for row in range(rows)], **where)
        return {"seconds": time.perf_counter() - started, "megabytes": peak(), "before": before}


def peak() -> float:
    """Largest resident memory of this process so far, MB."""
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1.0 if sys.platform == "darwin" else 1024.0) / 1e6


def measure() -> list[Found]:
    """All rows; prints them as they come."""
    out: list[Found] = []
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawn, max_tasks_per_child=1) as pool:
        print("| nodes | steps | saved | seconds | ns a node and step | memory, MB | the history, MB |")
        print("| ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
        for nodes, steps, saved in RUNS:
            row = pool.submit(run, nodes, steps, saved).result()
            each = 1e9 * row["stepping"] / (nodes * steps)
            size, rest = f"{nodes:,} | {steps:,} | {min(saved, steps + 1):,}", f"{row['history']:.0f}"
            print(f"| {size} | {row['seconds']:.2f} | {each:.0f} | {row['megabytes']:.0f} | {rest} |", flush=True)
            out.append({"nodes": nodes, "steps": steps, "saved": saved, **row})
        print("\n| rows of a sweep | on | seconds | memory before, MB | after, MB |")
        print("| ---: | --- | ---: | ---: | ---: |")
        for rows, on in SWEEPS:
            row = pool.submit(sweep, rows, on).result()
            memory = f"{row['before']:.0f} | {row['megabytes']:.0f}"
            print(f"| {rows:,} | {on} | {row['seconds']:.1f} | {memory} |", flush=True)
            out.append({"rows": rows, "on": on, **row})
    return out


if __name__ == "__main__":
    keep(RESULTS / "scale.json", measure())
