"""One run of one adapter under limits of time and of the bytes that it writes.

An adapter that hangs, crashes, writes rubbish or fills the disk is an outcome with a reason. It runs in a process group
and a folder of its own; both are gone afterwards.
"""

import contextlib
import json
import os
import signal
import subprocess
import tempfile
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import IO

from bent_beam.files import write_atomically
from bent_beam_programs.open_benchmark.adapter import ADAPTERS, Adapter
from bent_beam_programs.open_benchmark.problem import Problem, problem_text
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.result import ResultError

try:
    import resource
except ImportError:  # Windows has none
    resource = None  # type: ignore[assignment]

GRACE = 0.1  # s between looks at the clock and the folder
MOST_FILES = 10_000


@dataclass(frozen=True)
class Limits:
    """Of one run: wall seconds, and bytes of all that it writes. ``repeats``: runs at most, of which the fastest
    counts, as long as all together take no more than a tenth of the seconds."""

    seconds: float = 120.0
    output_bytes: int = 300_000_000
    repeats: int = 3


@dataclass(frozen=True)
class Run:
    """The end of a run: ``outcome`` and ``reason`` of the judge ("" : the result file says), wall seconds of the whole
    process, start included, the least of so many ``repeats``.

    unlimited : limits that this system cannot set ("" : none).
    """

    outcome: str
    reason: str
    seconds: float
    unlimited: str = ""
    repeats: int = 1


def run_adapter(adapter: Adapter, asked: Problem, resolution: str, kept: Path, limits: Limits) -> Run:
    """Run an adapter on a problem; a readable result is left in ``kept`` (``kept.json`` and ``.csv`` for a pair)."""
    runs = [_once(adapter, asked, resolution, kept, limits)]
    while not runs[-1].outcome and len(runs) < limits.repeats and sum(r.seconds for r in runs) < limits.seconds / 10.0:
        runs.append(_once(adapter, asked, resolution, kept, limits))
    return replace(runs[-1], seconds=min(run.seconds for run in runs), repeats=len(runs))


def _once(adapter: Adapter, asked: Problem, resolution: str, kept: Path, limits: Limits) -> Run:
    for old in (kept, kept.with_suffix(".csv"), kept.with_suffix(".json")):
        old.unlink(missing_ok=True)
    missing = adapter.missing()
    if missing:
        return Run("not_installed", missing, 0.0)
    kept.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".run-", dir=kept.parent, ignore_cleanup_errors=True) as place:
        folder = Path(place).resolve()  # the adapter runs in it
        write_atomically(folder / "problem.toml", problem_text(asked))
        began = time.perf_counter()
        code, (outcome, reason), said = _ended(adapter, resolution, folder, limits)
        seconds = time.perf_counter() - began
        if not outcome:
            outcome, reason = _taken(folder, asked, kept, code, said)
    return Run(outcome, reason, seconds, "" if resource else "size of a single file")


def _ended(adapter: Adapter, resolution: str, folder: Path, limits: Limits) -> tuple[int, tuple[str, str], str]:
    """Run the adapter in ``folder`` to its end: exit status, outcome and reason where it did not end by itself, and the
    last line of its standard error."""
    command = adapter.command(folder / "problem.toml", folder / "result.npz", resolution)
    mark = uuid.uuid4().hex
    # one thread each: a race for cores would be measured, not the codes
    surroundings = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    surroundings |= {"BENTBEAM_RUN": mark, "TMPDIR": str(folder)}
    # nothing of this project is in the reach of a code with packages of its own, and in that of others no answers
    reach = [str(ADAPTERS / "blocked"), "" if adapter.packages else surroundings.get("PYTHONPATH", "")]
    surroundings["PYTHONPATH"] = os.pathsep.join(filter(None, reach))
    with open(folder / "out.txt", "wb") as out, open(folder / "err.txt", "w+b") as err:
        try:
            process = subprocess.Popen(
                command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err, env=surroundings,
                start_new_session=True, preexec_fn=_file_size(limits),
            )  # fmt: skip
        except OSError as error:
            return 0, ("crashed", f"could not be started: {error.strerror or error}"), ""
        guard = None
        try:
            guard = _guard(process, folder)
            ended = _waited(process, folder, limits)
        finally:
            _end(process, f"BENTBEAM_RUN={mark}")
            if guard is not None:
                guard.kill()
                guard.communicate()
        return process.returncode, ended, _last_line(err)


def _file_size(limits: Limits) -> Callable[[], None] | None:
    """Sets the limit of a file's size and forbids core dumps, in the process that is started (``None``: cannot)."""
    if resource is None:
        return None
    allowed = resource.getrlimit(resource.RLIMIT_FSIZE)[1]  # which nobody may raise
    most = limits.output_bytes if allowed == resource.RLIM_INFINITY else min(limits.output_bytes, allowed)

    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    return limit


def _guard(process: subprocess.Popen[bytes], folder: Path) -> subprocess.Popen[bytes] | None:
    """A shell that ends the adapter's group and its folder when this process is killed: its pipe closes then."""
    if os.name != "posix":
        return None
    last = f'read _; kill -9 -{process.pid}; rm -rf "$0"'
    return subprocess.Popen(["sh", "-c", last, str(folder)], stdin=subprocess.PIPE, start_new_session=True)


def _waited(process: subprocess.Popen[bytes], folder: Path, limits: Limits) -> tuple[str, str]:
    """Wait for the end; outcome and reason when a limit ended it."""
    began = time.perf_counter()
    while process.poll() is None:
        passed = time.perf_counter() - began
        if passed > limits.seconds:
            return "timeout", f"more than {limits.seconds:g} s"
        size, files = _written(folder)
        if size > limits.output_bytes or files > MOST_FILES:
            return "crashed", f"wrote {size} bytes in {files} files, {limits.output_bytes} are the most"
        time.sleep(GRACE if passed > 1.0 else GRACE / 5)
    return "", ""


def _written(folder: Path) -> tuple[int, int]:
    """Bytes and files under ``folder``; counting ends where there are too many."""
    size = files = 0
    for place, _, names in os.walk(folder):
        for name in names:
            with contextlib.suppress(OSError):
                about = os.lstat(os.path.join(place, name))
                size += about.st_blocks * 512 if hasattr(about, "st_blocks") else about.st_size
                files += 1
        if files > MOST_FILES:
            break
    return size, files


def _end(process: subprocess.Popen[bytes], mark: str) -> None:
    """Kill the whole process group, and whatever of this run has left it (it carries the run's mark)."""
    with contextlib.suppress(ProcessLookupError):
        if hasattr(os, "killpg"):
            os.killpg(process.pid, signal.SIGKILL)
        else:
            process.kill()
    process.wait()
    for place in Path("/proc").glob("[0-9]*/environ"):
        with contextlib.suppress(OSError):
            if mark.encode() in place.read_bytes().split(b"\0"):
                os.kill(int(place.parent.name), signal.SIGKILL)


def _taken(folder: Path, asked: Problem, kept: Path, code: int, said: str) -> tuple[str, str]:
    """Keep the adapter's result, if it can be read and answers the problem; else outcome and reason."""
    for name in ("result.npz", "result.json"):
        file = folder / name
        if file.is_symlink() or not file.is_file():
            continue
        try:
            result = load_result(file)
        except ResultError as error:
            return "invalid", str(error).replace(f"{folder}{os.sep}", "")
        if result.problem.id != asked.id:
            return "invalid", f"problem is {result.problem.id}, asked was {asked.id}"
        for part in (file, file.with_suffix(".csv")):
            if part.is_file() and not part.is_symlink():
                os.replace(part, kept.with_suffix(part.suffix))
        return "", ""
    reasons = [f"signal {signal.Signals(-code).name}" if code < 0 else "", said]
    silent = f"exit status {code}" if code else "left no result.npz or result.json"
    return "crashed", ": ".join(filter(None, reasons)) or silent


def _last_line(stream: IO[bytes]) -> str:
    """The last line of standard error, short; of the open file, for its name may be another's by now."""
    stream.seek(0, os.SEEK_END)
    stream.seek(max(stream.tell() - 4000, 0))
    lines = stream.read().decode("utf-8", "replace").splitlines()
    line = next((" ".join(text.split()) for text in reversed(lines) if text.strip()), "")
    return json.dumps(line[:200], ensure_ascii=False).strip('"')
