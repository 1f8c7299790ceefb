"""Holds today's code to the recorded answers.

python -m benchmarks.net [--only TEXT] [--jobs N] [--record]

Prints every case with its worst deviation over its tolerance; the exit code is 1 when one is above 1.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import json
import os
import platform
import subprocess
import sys
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from benchmarks.net.answers import answer
from benchmarks.net.case import Case
from benchmarks.net.cases import CASES
from benchmarks.net.compare import Numbers, sensitivity, worst
from benchmarks.record import VERSIONS
from bent_beam.files import write_atomically
from bent_beam.versions import processor, today

ANSWERS = Path(__file__).parent / "answers.json"
NUDGES = (1e-13, -2.3e-13, 0.6e-13)
DIGITS = 13
Entry = dict[str, Any]


def recorded_entry(case: Case) -> Entry:
    """What is kept of a case: its command, its numbers, and how much each group changes under nudges."""
    numbers = answer(case)
    sensitive = sensitivity(numbers, [answer(case, nudge) for nudge in NUDGES]) if case.kind == "same" else {}
    rounded = {key: float(f"{value:.{DIGITS}g}") for key, value in numbers.items()}
    return {"command": case.asked, "kind": case.kind, "sensitivity": sensitive, "numbers": rounded}


def answered(case: Case) -> Numbers | str:
    """The answer of today's code, or what it failed with."""
    try:
        return answer(case)
    except Exception as error:  # whatever a rewrite does wrong is a row of the table
        return f"{type(error).__name__}: {error}"


def judged(case: Case, entry: Entry | None, found: Numbers | str) -> tuple[float, str]:
    """Worst deviation over its tolerance, and the quantity or the reason."""
    if entry is None or entry["command"] != case.asked:
        return float("inf"), "not recorded"
    if isinstance(found, str):
        return float("inf"), found
    return worst(case, entry["numbers"], entry["sensitivity"], found)


def mapped(function: Any, cases: list[Case], jobs: int) -> Iterator[Any]:
    """``function`` of every case, in order, as soon as it is there."""
    if jobs == 1:
        yield from map(function, cases)
        return
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        yield from pool.map(function, cases)


def record(cases: list[Case], jobs: int) -> None:
    """Write the answers of today's code, in place of those of the same cases."""
    kept: dict[str, Entry] = json.loads(ANSWERS.read_text("utf-8"))["answers"] if ANSWERS.exists() else {}
    ask = ["git", "log", "-1", "--format=%h", "--", ".", ":!benchmarks"]
    commit = subprocess.run(ask, capture_output=True, text=True, cwd=ANSWERS.parents[2]).stdout.strip()
    for case, entry in zip(cases, mapped(recorded_entry, cases, jobs)):
        kept[case.name] = {"commit": commit, **entry}
        largest = max(entry["sensitivity"].values(), default=0.0)
        print(f"{case.name:60} {len(entry['numbers']):4} numbers, sensitivity {largest:.1e}", flush=True)
    versions = {name: importlib.metadata.version(name) for name in VERSIONS}
    head = {"date": today(), "processor": processor(), "python": platform.python_version(), "versions": versions}
    lines = [f"{json.dumps(case.name)}: {json.dumps(kept[case.name])}" for case in CASES if case.name in kept]
    text = json.dumps(head, indent=1)[:-2] + ',\n "answers": {\n' + ",\n".join(lines) + "\n }\n}\n"
    write_atomically(ANSWERS, text)


def main() -> int:
    """Run the cases; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", default="", help="cases whose names contain this")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    parser.add_argument("--record", action="store_true", help="keep today's answers as the right ones")
    asked = parser.parse_args()
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(name, "1")  # of the processes that are started
    cases = [case for case in CASES if asked.only in case.name]
    if asked.record:
        record(cases, asked.jobs)
        return 0
    entries: dict[str, Entry] = json.loads(ANSWERS.read_text("utf-8"))["answers"]
    began, held = time.perf_counter(), 0
    print(f"{'case':58} {'class':5} {'deviation / tolerance':>22}  quantity")
    for case, found in zip(cases, mapped(answered, cases, asked.jobs)):
        ratio, quantity = judged(case, entries.get(case.name), found)
        held += ratio <= 1.0
        verdict = "" if ratio <= 1.0 else "FAILS"
        print(f"{case.name:58} {case.kind:5} {ratio:15.2g} {verdict:>6}  {quantity}", flush=True)
    print(f"{held} of {len(cases)} cases hold, {time.perf_counter() - began:.0f} s")
    return 0 if held == len(cases) else 1


if __name__ == "__main__":
    sys.exit(main())
