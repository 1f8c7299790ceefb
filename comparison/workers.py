"""Many independent calls on this machine's cores or on a dask cluster; one that dies does not take others along."""

from __future__ import annotations

import asyncio
import os
import signal
import threading
import time as clock
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    CancelledError,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    as_completed,
)
from concurrent.futures import wait as wait_for
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import islice
from multiprocessing import active_children, get_context, parent_process
from multiprocessing.connection import wait
from types import FrameType
from typing import Any

from bent_beam.checks import positive, whole

__all__ = ["run_all"]

TICK = 0.1  # s, between two looks at the clock of a call whose time is limited
AHEAD = 8  # calls a process that wait or run: a sweep of any length takes the same memory
AHEAD_ON_CLUSTER = 1_000  # the same of all its workers together
PREPARING = ("importlib.", "numba.")


@dataclass(frozen=True)
class Expired:
    """The result of a call that has taken too long, and what to say of it."""

    why: str


def run_all(
    function: Callable[..., Any],
    arguments: Sequence[tuple[Any, ...]],
    *,
    jobs: int = 1,
    scheduler: str | None = None,
    limit: float | None = None,
    progress: Callable[[int, int], None] | None = None,
    on_death: Callable[[int, str], Any] | None = None,
) -> list[Any]:
    """``[function(*a) for a in arguments]``, in order. ``on_death(i, why)`` stands in for a call whose worker died;
    without it that raises ``RuntimeError``.

    jobs : processes on this machine (1: in this one). scheduler : address of a dask.distributed scheduler.
    limit : seconds that one call may take (``None``: any time); what it imports and compiles does not count.
        ``on_death`` stands in for a call that takes longer, too.
    """
    whole("jobs", jobs, 1)
    on_death = on_death or _cannot_do_without
    if limit is not None:
        function = partial(limited, function, positive("limit", limit))
        timed = run_all(function, arguments, jobs=jobs, scheduler=scheduler, progress=progress, on_death=on_death)
        return [on_death(i, result.why) if isinstance(result, Expired) else result for i, result in enumerate(timed)]
    if scheduler is not None:
        return _on_cluster(function, arguments, scheduler, progress, on_death)
    if jobs == 1 or len(arguments) <= 1:
        results = []
        for i, a in enumerate(arguments):
            results.append(function(*a))
            if progress is not None:
                progress(i + 1, len(arguments))
        return results
    return _on_cores(function, arguments, jobs, progress, on_death)


def _cannot_do_without(i: int, why: str) -> Any:
    raise RuntimeError(f"call {i}: {why}")


def limited(function: Callable[..., Any], limit: float, *arguments: Any) -> Any:
    """``function(*arguments)``, or :class:`Expired` when it has taken more than ``limit`` seconds of the clock.

    It is interrupted by a :class:`TimeoutError` (of which other people's code may make an error of its own), by an
    alarm of the operating system, which reaches the main thread between two calls of compiled code; where there is none
    (Windows, a thread of a cluster's worker) the call takes the time that it takes. The clock stands while a module is
    imported or a kernel compiled: neither may be left half done, and neither belongs to the call's own time.
    """
    used, last, over = 0.0, clock.perf_counter(), False
    expired: list[Expired] = []

    def tick(_: int, frame: FrameType | None) -> None:
        nonlocal used, last
        now = clock.perf_counter()
        passed, last = now - last, now
        if over or _preparing(frame):
            return
        used += passed
        if used >= limit:
            signal.setitimer(signal.ITIMER_REAL, 0.0)  # once: whoever sees the error needs time to answer it
            expired.append(Expired(f"time limit: not finished after {limit:g} s"))
            raise TimeoutError(expired[0].why)

    try:
        before = signal.signal(signal.SIGALRM, tick)
    except (AttributeError, ValueError):
        return function(*arguments)
    signal.setitimer(signal.ITIMER_REAL, *2 * (min(limit, TICK),))
    try:
        try:
            result = function(*arguments)
        finally:
            over = True  # an alarm from here on is late
    except Exception:
        if not expired:
            raise
        result = None
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    return expired[0] if expired else result


def _preparing(frame: FrameType | None) -> bool:
    """Whether a module is being imported or a kernel compiled somewhere up the calls."""
    while frame is not None:
        if frame.f_globals.get("__name__", "").startswith(PREPARING):
            return True
        frame = frame.f_back
    return False


def _on_cores(
    function: Callable[..., Any],
    arguments: Sequence[tuple[Any, ...]],
    jobs: int,
    progress: Callable[[int, int], None] | None,
    on_death: Callable[[int, str], Any],
) -> list[Any]:
    results: dict[int, Any] = {}

    def done(i: int, result: Any) -> None:
        results[i] = result
        if progress is not None:
            progress(len(results), len(arguments))

    calls = iter(enumerate(arguments))
    while suspects := _together(function, calls, min(jobs, len(arguments)), done):
        # A worker that dies takes down its pool and all that waited in it: each of those again, in a pool of its own.
        stopped = threading.Event()
        with ThreadPoolExecutor(max_workers=jobs) as watchers, workers_end_with_us(stopped):
            alone = {watchers.submit(_alone, function, arguments[i], stopped): i for i in suspects}
            for watcher in as_completed(alone):
                i = alone[watcher]
                died, result = watcher.result()
                why = "its worker process died three times (killed, or out of memory)"
                done(i, on_death(i, why) if died else result)
    return [results[i] for i in range(len(arguments))]


def _together(
    function: Callable[..., Any],
    calls: Iterator[tuple[int, tuple[Any, ...]]],
    jobs: int,
    done: Callable[[int, Any], None],
) -> list[int]:
    """Calls in one pool, a few ahead of its workers, until none is left or a worker dies; returns those that were under
    way then."""
    # spawn: a fresh interpreter a worker, so no thread or lock of this process is inherited half-way
    context = get_context("spawn")
    pool = ProcessPoolExecutor(jobs, mp_context=context, initializer=end_with_parent)
    with pool, workers_end_with_us():
        futures: dict[Future[Any], int] = {}
        broken: list[int] = []
        while True:
            for i, call in islice(calls, 0 if broken else AHEAD * jobs - len(futures)):
                try:
                    with interrupts_held():
                        futures[pool.submit(function, *call)] = i
                except BrokenProcessPool:
                    broken.append(i)
                    break
            if not futures:
                return sorted(broken)
            for future in wait_for(futures, return_when=FIRST_COMPLETED).done:
                i = futures.pop(future)
                try:
                    result = future.result()
                except BrokenProcessPool:
                    broken.append(i)
                else:
                    done(i, result)


def _alone(function: Callable[..., Any], call: tuple[Any, ...], stopped: threading.Event) -> tuple[bool, Any]:
    """One call in a process of its own, tried twice: (died, result)."""
    for _ in range(2):
        if stopped.is_set():
            break
        with ProcessPoolExecutor(1, mp_context=get_context("spawn"), initializer=end_with_parent) as pool:
            try:
                with interrupts_held():
                    future = pool.submit(function, *call)
                return False, future.result()
            except BrokenProcessPool:
                continue
    return True, None


@contextmanager
def interrupts_held() -> Iterator[None]:
    """Ctrl-C waits. Processes started meanwhile never see it: this one ends them, and speaks for all of them."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def end_with_parent() -> None:
    """In a worker: end when the process that started it is gone, however it went. Killed, it could tell nobody, and a
    worker that waits for its next call would wait for ever."""
    parent = parent_process()
    if parent is None:
        return

    def watch() -> None:
        wait([parent.sentinel])
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


@contextmanager
def workers_end_with_us(stopped: threading.Event | None = None) -> Iterator[None]:
    """An interrupt, or a ``progress`` that raises, does not wait for calls that are under way."""
    try:
        yield
    except BaseException:
        if stopped is not None:
            stopped.set()
        for worker in active_children():
            worker.terminate()
        raise


FIRST_ANSWER = 10.0  # s that a scheduler has to answer at first
RECONNECT = 120.0  # s that a scheduler may be away before what is left is given up
RESTARTS = 20  # times in a row that it may come back and go without a single answer


class NoSchedulerError(Exception):
    """None answers at the address in time."""


def _on_cluster(
    function: Callable[..., Any],
    arguments: Sequence[tuple[Any, ...]],
    scheduler: str,
    progress: Callable[[int, int], None] | None,
    on_death: Callable[[int, str], Any],
) -> list[Any]:
    """Dask asks again when a worker dies; what it cannot know of, its own scheduler's death, is waited for here."""
    try:
        import distributed
    except ImportError:
        raise ValueError("scheduler: needs the extra [cluster] (pip install 'bent-beam-impact[cluster]')") from None
    results: dict[int, Any] = {}
    idle, patience = 0, FIRST_ANSWER
    while len(results) < len(arguments) and idle < RESTARTS:
        left = [i for i in range(len(arguments)) if i not in results]
        idle += 1
        try:
            with closing(_answers(function, arguments, left, scheduler, patience)) as found:
                for i, raised, result in found:
                    if raised is not None and not isinstance(raised, distributed.KilledWorker):
                        raise raised
                    results[i] = result if raised is None else on_death(i, f"its worker died or was lost ({raised})")
                    idle = 0
                    if progress is not None:
                        progress(len(results), len(arguments))
        except NoSchedulerError as error:
            if patience == FIRST_ANSWER:
                raise ValueError(f"scheduler: none answers at {scheduler} ({error})") from None
            break
        patience = RECONNECT
    for i in range(len(arguments)):
        if i not in results:
            results[i] = on_death(i, f"the scheduler at {scheduler} went away; ask again and only what is left is done")
    return [results[i] for i in range(len(arguments))]


def _answers(
    function: Callable[..., Any],
    arguments: Sequence[tuple[Any, ...]],
    left: Sequence[int],
    scheduler: str,
    patience: float,
) -> Generator[tuple[int, BaseException | None, Any], None, None]:
    """(i, what it raised, result) of the calls ``left``, as they come, until the scheduler goes away; a call whose
    workers died raises ``distributed.KilledWorker``.

    Raises :class:`NoSchedulerError` when none answers at the address within ``patience`` s.
    """
    from distributed import Client
    from distributed import as_completed as completed

    try:
        # not the default: who asked may use dask, or xarray, for something else
        connected = Client(scheduler, timeout=patience, set_as_default=False)
    except (OSError, ValueError) as error:
        raise NoSchedulerError(error) from error
    with connected as client:
        futures: dict[Any, int] = {}
        waiting, finished = iter(left), completed(loop=client.loop)

        def submit(count: int) -> None:
            for i in islice(waiting, count):
                future = client.submit(function, *arguments[i], pure=False)
                futures[future] = i
                finished.add(future)

        submit(AHEAD_ON_CLUSTER)
        for future in finished:
            i = futures.pop(future)
            status, raised, result = future.status, None, None
            try:
                if status == "error":
                    raised = future.exception(timeout=patience)
                    if raised is None or isinstance(raised, CancelledError):
                        continue
                elif status == "finished":
                    result = future.result(timeout=patience)
            except (OSError, CancelledError, asyncio.CancelledError):  # it went away with the answer: asked again
                continue
            if status in ("error", "finished"):
                yield i, raised, result
            if client.status != "running":
                return
            submit(AHEAD_ON_CLUSTER - len(futures))
