"""Many independent calls on this machine's cores (joblib) or on a dask cluster; one that dies costs only itself. And a
time limit for each: a clock that its runs ask between their steps."""

import logging
import os
import signal
import threading
import time
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from typing import Any

from bent_beam.checks import whole
from bent_beam.errors import InputError, TimeLimitError
from comparison.store import this_code

FIRST_ANSWER = 8.0  # s that a scheduler has to answer
FIRST_WORKER = 15.0  # s until one is there, and again until all have answered
IDLE = 10  # s until a worker without work ends; until then the next stage of a command finds it warm
PAYS = 5.0  # s of work from which on a second process pays: it takes some two to start and to load libraries

Done = Callable[[int, Any], None]
Calls = Sequence[tuple[Any, ...]]  # the arguments of each
Count = Callable[[int, int], None]  # is told how many of all are done


def run_all(
    function: Callable[..., Any],
    arguments: Calls,
    *,
    jobs: int | None = 1,
    scheduler: str | None = None,
    progress: Count | None = None,
    on_death: Callable[[int, str], Any] | None = None,
) -> list[Any]:
    """``[function(*a) for a in arguments]``, in order.

    jobs : processes on this machine (1: in this one; ``None``: in this one until one per core pays). scheduler :
        address of a dask.distributed scheduler.
    progress : called with (done, all) after each call. on_death(i, why) : stands in for a call whose worker died.
    Raises what a call raises, ``ValueError`` when no scheduler answers, ``RuntimeError`` without ``on_death``.
    """
    if jobs is not None:
        whole("jobs", jobs, 1)
    if scheduler is not None and jobs not in (None, 1):
        raise InputError(f"jobs has no effect next to scheduler, whose workers run: leave it out (got {jobs!r})")
    results: dict[int, Any] = {}
    calls, began = iter(range(len(arguments))), time.perf_counter()

    def done(i: int, result: Any) -> None:
        results[i] = result
        if progress is not None:
            progress(len(results), len(arguments))

    def died(i: int, why: str = "the worker died: out of memory?") -> None:
        if on_death is None:
            raise RuntimeError(f"call {i}: {why}")
        done(i, on_death(i, why))

    if scheduler is not None:
        _on_cluster(function, arguments, scheduler, done, died)
        return [results[i] for i in range(len(arguments))]
    many = os.cpu_count() or 1 if jobs is None else jobs
    if jobs is None or many == 1 or len(arguments) <= 1:
        spent: list[float] = []
        for i in calls:
            started = time.perf_counter()
            done(i, function(*arguments[i]))
            spent.append(time.perf_counter() - started)
            if many > 1 and _pays(spent, len(arguments) - i - 1):
                break
    if len(results) < len(arguments):
        # A worker that dies takes down its pool: what was under way is asked for again, each call in a pool of its own.
        while under_way := _together(function, arguments, calls, many, done):
            for i in under_way:
                if _together(function, arguments, iter([i]), many, done):
                    died(i)
        if jobs is not None and time.perf_counter() - began < PAYS:
            logging.getLogger("bent_beam").info("so little work is done sooner by one process: leave --jobs out")
    return [results[i] for i in range(len(arguments))]


def _pays(spent: Sequence[float], left: int) -> bool:
    """Whether ``left`` calls like those that took ``spent``, s, are work for a second process. The first call also
    loads what it needs, so that alone it shows this only if it took longer than :data:`PAYS`."""
    return left > 1 and min(spent) * left > PAYS and (len(spent) > 1 or spent[0] > PAYS)


def _numbered(i: int, function: Callable[..., Any], arguments: tuple[Any, ...]) -> tuple[int, Any]:
    return i, function(*arguments)


def _together(function: Callable[..., Any], arguments: Calls, calls: Iterator[int], jobs: int, done: Done) -> list[int]:
    """Call in one pool until none of ``calls`` is left or a worker dies; returns those that were under way then."""
    from concurrent.futures.process import BrokenProcessPool
    from multiprocessing import get_context

    from joblib import Parallel, delayed

    under_way: set[int] = set()

    def tasks() -> Iterator[Any]:
        for i in calls:
            under_way.add(i)
            yield delayed(_numbered)(i, function, arguments[i])

    watch = {"initializer": end_with_parent, "initargs": (os.getpid(),), "idle_worker_timeout": IDLE}
    pool = Parallel(jobs, "loky", "generator_unordered", batch_size=1, max_nbytes=None, **watch)
    with warnings.catch_warnings(), no_code_from_here():
        warnings.simplefilter("ignore", UserWarning)  # loky renews a worker that has grown, drops what is interrupted
        try:
            for kind in ("loky", "spawn"):  # starts the trackers of locks, which would let interrupts in below
                get_context(kind).Lock()
            with ExitStack() as stack:
                with interrupts_held():  # an interrupt that waited finds the answers to close
                    answers = stack.enter_context(closing(pool(tasks())))
                for i, result in answers:
                    under_way.discard(i)
                    done(i, result)
        except BrokenProcessPool:
            return sorted(under_way)
    return []


def end_with_parent(parent: int) -> None:
    """In a worker: leave as soon as the process ``parent`` is gone, busy or blocked, which no pipe tells reliably. And
    log nothing, which would cross the parent's bar."""
    logging.getLogger("bent_beam").addHandler(logging.NullHandler())

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(1.0)
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


@contextmanager
def no_code_from_here() -> Iterator[None]:
    """Pythons started meanwhile look for modules where their parent says, not in the folder where it was called."""
    before = os.environ.get("PYTHONSAFEPATH")
    os.environ["PYTHONSAFEPATH"] = "1"
    try:
        yield
    finally:
        os.environ.pop("PYTHONSAFEPATH")
        if before is not None:
            os.environ["PYTHONSAFEPATH"] = before


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


async def _shake_hands(scheduler: str) -> None:
    import asyncio

    from distributed.comm import connect

    async with asyncio.timeout(FIRST_ANSWER):  # a port that accepts and stays mute
        (await connect(scheduler, timeout=FIRST_ANSWER)).abort()


def _check_workers(client: Any, scheduler: str) -> None:
    """Raise ``ValueError`` unless workers are there, answer, and have this project's sources and versions."""
    from distributed import wait

    try:
        client.wait_for_workers(1, timeout=FIRST_WORKER)
        workers = list(client.scheduler_info(n_workers=-1)["workers"])
        asked = [client.submit(this_code, workers=[w], pure=False, priority=100) for w in workers]
        with client.as_current():
            wait(asked, timeout=FIRST_WORKER)
    except TimeoutError:
        raise ValueError(
            f"scheduler: workers at {scheduler} are missing, frozen or busy: not all answered within {FIRST_WORKER:g} s"
        ) from None
    for worker, answer in zip(workers, asked):
        theirs = answer.result() if answer.status == "finished" else answer.exception()
        if theirs != this_code():
            raise ValueError(
                f"scheduler: the worker {worker} has other sources or versions, so its numbers would be others "
                f"(theirs: {theirs}; here: {this_code()})"
            )


def _on_cluster(
    function: Callable[..., Any], arguments: Calls, scheduler: str, done: Done, died: Callable[..., None]
) -> None:
    """Dask asks again by itself when a worker dies. (joblib's dask backend waits for ever for a killed worker.)"""
    import asyncio  # a quarter of a second that only a cluster asks for

    try:
        from distributed import Client, KilledWorker, as_completed
    except ImportError:
        raise ValueError("scheduler: needs the extra [cluster] (pip install 'bent-beam-impact[cluster]')") from None
    try:
        with ThreadPoolExecutor(1) as thread:  # a client that fails to connect would linger
            thread.submit(asyncio.run, _shake_hands(scheduler)).result()
        # not the default: who asked may use dask, or xarray, for something else
        client = Client(scheduler, timeout=FIRST_ANSWER, set_as_default=False)
    except Exception as error:  # each kind of address has its own
        raise ValueError(f"scheduler: none answers at {scheduler} ({error})") from None
    with client:
        _check_workers(client, scheduler)
        numbers = {client.submit(function, *a, pure=False): i for i, a in enumerate(arguments)}
        away = f"the scheduler at {scheduler} went away; ask again and only what is left is done"
        # a call that waits on a worker is blamed when another kills it: each is asked once more, alone
        suspects: list[int] = []

        def settle(i: int, future: Any, killed: Callable[[int], None]) -> None:
            try:
                result = future.result()
            except KilledWorker:
                killed(i)
            except CancelledError:
                died(i, away)
            else:
                done(i, result)

        for future in as_completed(list(numbers), loop=client.loop):
            settle(numbers.pop(future), future, suspects.append)
        for i in suspects:
            settle(i, client.submit(function, *arguments[i], pure=False), died)


@dataclass
class Clock:
    """The time that the runs of one row have taken, s. ``limit`` : s, of all of them."""

    limit: float
    spent: float = 0.0

    def progress(self) -> Callable[[float], None]:
        """What a run calls between its steps; raises :class:`TimeLimitError` beyond the limit. Its time counts from the
        first call on: what is imported and compiled before does not."""
        last: float | None = None

        def ask(_: float) -> None:
            nonlocal last
            now = time.perf_counter()
            self.spent += 0.0 if last is None else now - last
            last = now
            if self.spent > self.limit:
                raise TimeLimitError(f"time limit: not finished after {self.limit:g} s")

        return ask
