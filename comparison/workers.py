"""Many independent calls on this machine's cores or on a dask cluster; a call that dies does not take the others along."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import Any

from bent_beam.checks import whole

__all__ = ["run_all"]


def run_all(
    function: Callable[..., Any],
    arguments: Sequence[tuple[Any, ...]],
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] | None = None,
    on_death: Callable[[int, str], Any],
) -> list[Any]:
    """``[function(*a) for a in arguments]``, in order. ``on_death(i, why)`` stands in for a call whose worker died.

    jobs : processes on this machine (1: in this one). scheduler : address of a dask.distributed scheduler.
    """
    whole("jobs", jobs, 1)
    if scheduler is not None:
        return _on_cluster(function, arguments, scheduler, progress, on_death)
    if jobs == 1 or len(arguments) == 1:
        results = []
        for i, a in enumerate(arguments):
            results.append(function(*a))
            if progress is not None:
                progress(i + 1, len(arguments))
        return results
    return _on_cores(function, arguments, jobs, progress, on_death)


def _on_cores(
    function: Callable[..., Any],
    arguments: Sequence[tuple[Any, ...]],
    jobs: int,
    progress: Callable[[int, int], None] | None,
    on_death: Callable[[int, str], Any],
) -> list[Any]:
    results: dict[int, Any] = {}
    waiting = list(range(len(arguments)))
    deaths = dict.fromkeys(waiting, 0)
    while waiting:
        # spawn: a fresh interpreter a worker, so no thread or lock of this process is inherited half-way
        with ProcessPoolExecutor(max_workers=min(jobs, len(waiting)), mp_context=get_context("spawn")) as pool:
            futures: dict[Future[Any], int] = {pool.submit(function, *arguments[i]): i for i in waiting}
            broken = []
            try:
                for future in as_completed(futures):
                    i = futures[future]
                    try:
                        results[i] = future.result()
                    except BrokenProcessPool:
                        broken.append(i)
                        continue
                    if progress is not None:
                        progress(len(results), len(arguments))
            except KeyboardInterrupt:
                pool.shutdown(wait=False, cancel_futures=True)
                raise
        # A dead worker breaks the pool and all that waited in it: try each of those again, alone after a second death.
        waiting = []
        for i in sorted(broken):
            deaths[i] += 1
            if deaths[i] >= 3:
                results[i] = on_death(i, "its worker process died three times (killed, or out of memory)")
            else:
                waiting.append(i)
        if any(deaths[i] >= 2 for i in waiting):
            jobs = 1
    return [results[i] for i in range(len(arguments))]


def _on_cluster(
    function: Callable[..., Any],
    arguments: Sequence[tuple[Any, ...]],
    scheduler: str,
    progress: Callable[[int, int], None] | None,
    on_death: Callable[[int, str], Any],
) -> list[Any]:
    try:
        from distributed import Client
        from distributed import as_completed as completed
    except ImportError:
        raise ValueError("scheduler: needs the extra [cluster] (pip install 'bent-beam-impact[cluster]')") from None
    results: dict[int, Any] = {}
    try:
        client = Client(scheduler, timeout="10s")
    except OSError as error:
        raise ValueError(f"scheduler: none answers at {scheduler} ({error})") from None
    with client:
        futures = {client.submit(function, *a, pure=False): i for i, a in enumerate(arguments)}
        for future in completed(list(futures)):
            i = futures[future]
            if future.status == "finished":
                results[i] = future.result()
            else:
                results[i] = on_death(i, f"its worker died or was lost ({future.exception()})")
            if progress is not None:
                progress(len(results), len(arguments))
    return [results[i] for i in range(len(arguments))]
