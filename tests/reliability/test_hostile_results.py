"""Results of other codes built to harm are refused in one line, in little memory, in seconds; no text of them acts."""

import io
import json
import os
import random
import subprocess
import sys
import zipfile

import numpy as np
import pytest

from open_benchmark.adapter import Adapter
from open_benchmark.campaign import Row
from open_benchmark.judgement import Score
from open_benchmark.page import write_page
from open_benchmark.reading import load_result
from open_benchmark.result import ResultError
from theory import contact_parameters

FUZZ = bool(os.environ.get("FUZZ"))
SECONDS, BYTES = 10.0, 1_000_000_000
TAU = np.linspace(0.0, 0.1, 400)
EXACT = contact_parameters(0.5)
FIELDS = {
    "tau": TAU,
    "J": 4.0 * np.sqrt(2.0 / np.pi) * EXACT.r0 * np.sqrt(TAU),
    "Jm": np.sqrt(2.0 / np.pi) * EXACT.r0 * EXACT.lambda0 * TAU,
}
WORDS = {"outcome": "completed", "problem": "leading-0.5", "metadata": {"tool": "exact"}}


def pair(folder, table=None, words=None):
    """A CSV table beside JSON, either replaced by the text given."""
    lines = ["tau,J,Jm", *(",".join(map(repr, row)) for row in np.column_stack(list(FIELDS.values())).tolist())]
    (folder / "run.csv").write_text("\n".join(lines) if table is None else table)
    (folder / "run.json").write_text(json.dumps(WORDS) if words is None else words)
    return folder / "run.csv"


def long_file(folder, name, size):
    """A file of an announced ``size`` that takes no space on the disk."""
    pair(folder)
    with (folder / name).open("r+b") as stream:
        stream.truncate(size)
    return folder / "run.csv"


def words(**changes):
    return lambda folder: pair(folder, words=json.dumps(WORDS | changes))


def archive(**entries):
    """An NPZ of entries that are bytes."""

    def make(folder):
        with zipfile.ZipFile(folder / "run.npz", "w", zipfile.ZIP_DEFLATED) as made:
            for name, content in entries.items():
                made.writestr(f"{name}.npy", content)
        return folder / "run.npz"

    return make


def header(shape, kind="<f8"):
    """The first bytes of an array of ``shape``, and nothing of its values."""
    stream = io.BytesIO()
    np.lib.format.write_array_header_1_0(stream, {"descr": kind, "fortran_order": False, "shape": shape})
    return stream.getvalue()


def packed_zeros(folder):
    """Eight hundred megabytes of zeros in some kilobytes."""
    with zipfile.ZipFile(folder / "run.npz", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as made:
        with made.open("J.npy", "w") as entry:
            entry.write(header((10**8,)))
            for _ in range(100):
                entry.write(bytes(8_000_000))
    return folder / "run.npz"


def many_entries(folder):
    with zipfile.ZipFile(folder / "run.npz", "w") as made:
        for number in range(5000):
            made.writestr(f"{number:064d}", b"")
    return folder / "run.npz"


HOSTILE = {
    "a million columns": lambda d: pair(d, "tau," + ",".join(f"c{n}" for n in range(1_000_000)) + "\n"),
    "a line of ten megabytes": lambda d: pair(d, "tau,J,Jm\n" + "1," * 5_000_000),
    "one field without end": lambda d: pair(d, 'tau,J,Jm\n"' + "1\n" * 1_000_000),
    "a million instants": lambda d: pair(d, "tau,J,Jm\n" + "".join(f"{n},0,0\n" for n in range(300_000))),
    "ten announced gigabytes of CSV": lambda d: long_file(d, "run.csv", 10**10),
    "ten announced gigabytes of JSON": lambda d: long_file(d, "run.json", 10**10),
    "zeros in CSV": lambda d: long_file(d, "run.csv", 10**8),
    "a number of a million digits": lambda d: pair(d, "tau,J,Jm\n0." + "9" * 1_000_000 + ",0,0\n"),
    "a formula in a name": lambda d: pair(d, "=cmd|' /C calc'!A0,J,Jm\n"),
    "JSON of many lists": lambda d: pair(d, words='{"outcome": [' + "[]," * 3_300_000 + "[]]}"),
    "metadata without end": words(metadata='{"a":' * 100_000 + "1" + "}" * 100_000),
    "an integer too long": lambda d: pair(d, words='{"outcome": ' + "9" * 100_000 + "}"),
    "an integer beyond any float": words(snap_tau=[10**400], snap_gap=[[1]], x=[1]),
    "an escape of eight bits in the metadata": words(metadata={"tool": "\x9b31m"}),
    "writing turned round": words(metadata={"tool": "\u202egnp.exe"}),
    "a field that is markup": words(**{"<script>alert(1)</script>": 1}),
    "announced terabytes of values": archive(J=header((10**12,))),
    "dimensions beyond any machine": archive(J=header((2**62, 2**62))),
    "objects": archive(J=header((400,), "|O") + b"cos\nsystem\n(S'true'\ntR."),
    "a header that is code": archive(J=b"\x93NUMPY\x01\x00\x20\x00__import__('os').system('true')   \n"),
    "eight hundred megabytes of zeros, packed": packed_zeros,
    "thousands of entries": many_entries,
    "a path for a name": archive(**{"../../evil": header((1,))}),
    "an escape for a name": archive(**{"\x1b[31m": header((1,))}),
}

LARGE = ("eight hundred megabytes", "JSON of many", "a million instants", "a line of ten")  # only in `make fuzz`

READ_ALL = """
import json, sys, time
from open_benchmark.reading import load_result
from open_benchmark.result import ResultError
for line in sys.stdin:
    began, said = time.process_time(), "good"
    try:
        load_result(line.strip())
    except ResultError as error:
        said = str(error)
    most = next(int(x.split()[1]) * 1024 for x in open("/proc/self/status") if x.startswith("VmHWM"))
    print(json.dumps([said, time.process_time() - began, most]), flush=True)
"""


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """Name → what a process of its own says of a hostile file, its seconds, and its largest memory so far."""
    files = {}
    for name, make in ({"good": pair} | HOSTILE).items():
        if FUZZ or not name.startswith(LARGE):
            files[name] = make(tmp_path_factory.mktemp("hostile"))
    folder = tmp_path_factory.getbasetemp()
    before = sorted(folder.rglob("*"))
    lines = "".join(f"{file}\n" for file in files.values())
    command = [sys.executable, "-c", READ_ALL]
    done = subprocess.run(command, input=lines, capture_output=True, text=True, cwd=folder, check=True)
    assert sorted(folder.rglob("*")) == before, "nothing is written"
    return dict(zip(files, map(json.loads, done.stdout.splitlines()), strict=True))


@pytest.mark.parametrize("name", [name for name in HOSTILE if FUZZ or not name.startswith(LARGE)])
def test_a_hostile_result_is_refused_in_one_line_in_little_memory_and_time(answers, name):
    said, seconds, memory = answers[name]
    assert answers["good"][0] == "good"
    assert said != "good" and len(said) < 500 and all(c.isprintable() for c in said)
    assert seconds < SECONDS and memory < BYTES
    assert name != "thousands of entries" or "table of contents" in said  # before zipfile reads all of it


def test_mutated_results_are_read_or_refused(tmp_path):
    """Bits turned and bytes cut in an NPZ, a table and its JSON."""
    numbers = random.Random("results")
    np.savez(tmp_path / "good.npz", **FIELDS, outcome="completed", problem="leading-0.5", metadata="{}")
    pair(tmp_path)
    originals = {name: (tmp_path / name).read_bytes() for name in ("good.npz", "run.csv", "run.json")}
    for _ in range(300):
        name = numbers.choice(list(originals))
        data = bytearray(originals[name])
        for _ in range(numbers.randint(1, 5)):
            data[numbers.randrange(len(data))] = numbers.randrange(256)
        if numbers.random() < 0.2:
            del data[numbers.randrange(len(data)) :]
        (tmp_path / name).write_bytes(data)
        try:
            load_result(tmp_path / (name if name.endswith("npz") else "run.csv"))
        except ResultError as error:
            assert "\n" not in str(error)
        (tmp_path / name).write_bytes(originals[name])


def test_markup_in_results_and_adapters_is_text_on_the_page(tmp_path):
    evil = "<script>alert(1)</script><img src=x onerror=alert(1)>"
    file = tmp_path / "adapter.py"
    file.write_text(f"# </pre>{evil}")
    score = Score("leading-0.5", f"crashed({evil})", evil, metadata={"tool": evil, "version": evil})
    rows = [Row(evil, "leading-0.5", resolution, 1.0, score) for resolution in ("coarse", "medium", "fine")]
    page = write_page(rows, [Adapter(evil, file)], tmp_path / "out").read_text()
    assert "alert(1)" in page and "<script>alert" not in page and "<img" not in page
