"""Do the quick tests see a broken line?

    make faults                                  (python -m benchmarks.faults [--each 30] [--room NAME] [--seed N])
    python -m benchmarks.faults --put comparison/predicting.py "AGREE = 0.02" "AGREE = 2.0"

Draws places of each room below the programs by a printed seed and breaks one at a time, in a copy of the project: a
constant is scaled, a sign or an operator flipped, a comparison turned round, a factor dropped, an index moved by one.
Only that piece of text changes; messages, pictures and the text of commands are left out. The quick tests of the room
are asked first, files that speak of the module before others, then those of one floor up. Prints each fault and the
first test that sees it, or UNSEEN. Whether an unseen fault changes a number is for the reader to judge: not all do.
"""

import argparse
import ast
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
PATHS = ["theory", "hermite_fe", "self_similar_fe", "exudyn_models"]
# room → the rooms of tests/ one floor up
ABOVE = {"bent_beam": ["measure"], "bent_beam/measure": PATHS[1:]} | {path: ["comparison"] for path in PATHS}
ABOVE |= {"comparison": ["report", "predictor", "thesis", "open_benchmark"]}
WORDS = re.compile(r"/(figures|command_line|scripts|examples)/|_text\.py|pictures|tables\.py|warnings_of_run")
OPERATORS: dict[type[ast.AST], tuple[str, str]] = {
    ast.Add: ("+", "-"), ast.Sub: ("-", "+"), ast.Mult: ("*", "/"), ast.Div: ("/", "*"), ast.Lt: ("<", ">"),
    ast.Gt: (">", "<"), ast.LtE: ("<=", ">="), ast.GtE: (">=", "<="), ast.Eq: ("==", "!="), ast.NotEq: ("!=", "=="),
}  # fmt: skip
STALE = "tests/comparison/test_provenance.py::test_shipped_numbers_are_those_of_today_s_code"  # sees every change
NO_END = "no end"  # counted apart: the machine may have other work
LIMIT = 450.0  # s, of the tests of a room
Fault = tuple[str, bytes, bytes]
"""File, and all of its text before and after."""


def faults_of(file: str) -> list[Fault]:
    """Every fault that can be put into a file of the project."""
    text = (ROOT / file).read_bytes()
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    found = _edits(ast.parse(text), text, starts)
    return [(file, text, text[:begin] + new.encode() + text[end:]) for begin, end, new in found]


def _edits(node: Any, text: bytes, starts: list[int]) -> Iterator[tuple[int, int, str]]:
    """From where to where the text of the node, and of what is inside it, can be changed, and into what."""

    def span(part: Any) -> tuple[int, int]:
        return starts[part.lineno - 1] + part.col_offset, starts[part.end_lineno - 1] + part.end_col_offset

    if isinstance(node, (ast.Raise, ast.JoinedStr)):
        return
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield *span(node), str(node.value + 1 if isinstance(node.value, int) else 1.5 * node.value or 0.1)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield span(node)[0], span(node)[0] + 1, ""
    elif isinstance(node, (ast.Compare, ast.BinOp)):
        compared = isinstance(node, ast.Compare)
        other, operator = (node.comparators[0], node.ops[0]) if compared else (node.right, node.op)
        lists = any(isinstance(side, (ast.JoinedStr, ast.List, ast.Tuple)) for side in (node.left, other))
        if type(operator) in OPERATORS and (compared or not lists):
            old, new = OPERATORS[type(operator)]
            place = text.index(old.encode(), span(node.left)[1])
            yield place, place + len(old), new
            if old == "*":
                yield place, span(node)[1], ""  # a factor is dropped
    for child in ast.iter_child_nodes(node):
        yield from _edits(child, text, starts)


def seen_by(fault: Fault, copy: Path, rooms: Sequence[str]) -> str | None:
    """The first quick test that sees the fault, room of ``tests`` after room; None if none does."""
    file, text, broken = fault
    (copy / file).write_bytes(broken)
    try:
        return next(filter(None, (_failing(copy, room, Path(file).stem) for room in rooms)), None)
    finally:
        (copy / file).write_bytes(text)


def _failing(copy: Path, room: str, module: str) -> str | None:
    files = sorted((copy / "tests" / room).glob("test_*.py"), key=lambda f: -f.read_text("utf-8").count(module))
    command = [sys.executable, "-m", "pytest", "-x", "-m", "not verify", "-p", "no:cacheprovider", "--deselect", STALE]
    around = os.environ | {"PYTHONPATH": str(copy), "XDG_CACHE_HOME": str(copy / "cache")}
    around["PYTHONDONTWRITEBYTECODE"] = "1"  # a file that is mended in the second in which it was broken looks the same
    try:
        ran = subprocess.run([*command, *files], cwd=copy, env=around, capture_output=True, text=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        return f"{room}: {NO_END}"
    failed = re.search(r"^(?:FAILED|ERROR) (?:tests/)?(\S+)", ran.stdout, re.MULTILINE)
    return failed[1] if failed else None if ran.returncode == 0 else f"{room}: {ran.stdout[-200:]}"


def put(file: str, old: str, new: str) -> Fault:
    """A fault of one's own. Raises ``SystemExit`` unless the file has the old text once."""
    text = (ROOT / file).read_text("utf-8")
    if text.count(old) != 1:
        sys.exit(f"{file} has {text.count(old)} times {old!r}, not once")
    return file, text.encode(), text.replace(old, new).encode()


def drawn(room: str, each: int, seed: int) -> list[Fault]:
    """So many faults of a room."""
    names = sorted(file.relative_to(ROOT).as_posix() for file in (ROOT / room).rglob("*.py"))
    names = [name for name in names if not WORDS.search(name) and room_of(name) == room]
    return random.Random(f"{seed} {room}").sample([fault for name in names for fault in faults_of(name)], each)


def room_of(file: str) -> str:
    """The innermost room of a file."""
    return next(room for room in sorted(ABOVE, reverse=True) if file.startswith(f"{room}/"))


def main() -> int:
    """Draw, break, test; 1 where a fault is unseen."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--each", type=int, default=30, help="faults of each room")
    parser.add_argument("--room", choices=ABOVE, action="append", help="this one alone; may be repeated")
    parser.add_argument("--put", nargs=3, metavar=("FILE", "OLD", "NEW"), action="append", help="this one instead")
    parser.add_argument("--seed", type=int, default=time.time_ns() % 2**31, help="the clock's unless given")
    asked = parser.parse_args()
    print(f"seed {asked.seed}", flush=True)
    of_rooms = [] if asked.put else [drawn(room, asked.each, asked.seed) for room in asked.room or ABOVE]
    # a room at a time, in turn: a drawing that is stopped is one of every room
    faults = [put(*one) for one in asked.put or ()] + [fault for one in zip(*of_rooms, strict=True) for fault in one]
    seen = Counter[tuple[str, str]]()
    with tempfile.TemporaryDirectory(prefix="bentbeam-faults-") as folder:
        copy = Path(folder) / "project"
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".*", "out", "site", "__pycache__", "*.egg-info"))
        for fault in faults:
            file, *texts = fault
            room = room_of(file)
            sight = seen_by(fault, copy, [own := Path(room).name, *ABOVE[room]])
            where = "unseen" if sight is None else "in its room" if sight.startswith(own) else "one floor up"
            seen[room, NO_END if sight and sight.endswith(NO_END) else where] += 1
            lines = enumerate(zip(*(text.decode().splitlines() for text in texts)), 1)
            number, (was, now) = next((k, pair) for k, pair in lines if pair[0] != pair[1])
            print(f"{file}:{number}\n    {was.strip()}\n    {now.strip()}\n    {sight or 'UNSEEN'}", flush=True)
    for (room, where), count in sorted(seen.items()):
        print(f"{room}: {count} {where}")
    return int(any(where == "unseen" for _, where in seen))


if __name__ == "__main__":
    sys.exit(main())
