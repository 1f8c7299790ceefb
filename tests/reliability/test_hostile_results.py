"""Results of other codes built to harm are refused in one line, in little memory, in seconds; no text of them acts."""

import io
import json
import os
import random
import subprocess
import zipfile

import numpy as np
import pytest
from called import started
from here import FUZZ

from bent_beam_programs.open_benchmark.adapter import Adapter
from bent_beam_programs.open_benchmark.campaign import Row
from bent_beam_programs.open_benchmark.judgement import Score
from bent_beam_programs.open_benchmark.page import write_page
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.result import ResultError
from tests.open_benchmark.exact import exact_fields

FIELDS = exact_fields()
WORDS = {"outcome": "completed", "problem": "leading-0.5", "metadata": {"tool": "exact"}}
ROWS = np.column_stack([FIELDS[name] for name in ("tau", "J", "Jm")]).tolist()
GOOD = "tau,J,Jm\n" + "".join(",".join(map(repr, row)) + "\n" for row in ROWS)


def pair(table=GOOD, record=WORDS):
    """A CSV table, or its announced bytes, beside JSON: what it holds, its text or its announced bytes."""

    def make(folder):
        for file, content in ((folder / "run.csv", table), (folder / "run.json", record)):
            if isinstance(content, int):
                file.touch()
                os.truncate(file, content)  # takes no space on the disk
            else:
                file.write_text(content if isinstance(content, str) else json.dumps(content))
        return folder / "run.csv"

    return make


def archive(entries):
    """An NPZ of entries, the pieces of each."""

    def make(folder):
        with zipfile.ZipFile(folder / "run.npz", "w", zipfile.ZIP_DEFLATED, compresslevel=1) as made:
            for name, pieces in entries.items():
                with made.open(f"{name}.npy", "w") as entry:
                    entry.writelines(pieces)
        return folder / "run.npz"

    return make


def header(shape, kind="<f8"):
    """The first bytes of an array of ``shape``, and nothing of its values."""
    stream = io.BytesIO()
    np.lib.format.write_array_header_1_0(stream, {"descr": kind, "fortran_order": False, "shape": shape})
    return stream.getvalue()


HOSTILE = {
    "one field without end": pair('tau,J,Jm\n"' + "1\n" * 1_000_000),
    "ten announced gigabytes of CSV": pair(10**10),
    "ten announced gigabytes of JSON": pair(record=10**10),
    "zeros in CSV": pair(10**8),
    "metadata without end": pair(record=WORDS | {"metadata": '{"a":' * 30_000 + "1" + "}" * 30_000}),
    "metadata of many levels": pair(record=WORDS | {"metadata": '{"a":' * 200 + "1" + "}" * 200}),
    "an integer too long": pair(record='{"outcome": ' + "9" * 100_000 + "}"),
    "an integer beyond any float": pair(record=WORDS | {"snap_tau": [10**400], "snap_gap": [[1]], "x": [1]}),
    "an escape of eight bits in the metadata": pair(record=WORDS | {"metadata": {"tool": "\x9b31m"}}),
    "writing turned round": pair(record=WORDS | {"metadata": {"tool": "\u202egnp.exe"}}),
    "announced terabytes of values": archive({"J": [header((10**12,))]}),
    "objects": archive({"J": [header((400,), "|O"), b"cos\nabort\n(tR."]}),  # ends whoever runs it
    "thousands of entries": archive({f"{number:064d}": [] for number in range(5000)}),
    "an escape for a name": archive({"\x1b[31m": [header((1,))]}),
}
if FUZZ:  # large
    HOSTILE |= {
        "a million instants": pair("tau,J,Jm\n" + "".join(f"{n},0,0\n" for n in range(300_000))),
        "JSON of many lists": pair(record='{"outcome": [' + "[]," * 3_300_000 + "[]]}"),
        "eight hundred megabytes of zeros, packed": archive({"J": [header((10**8,)), *[bytes(8_000_000)] * 100]}),
    }

READ_ALL = """
import json, sys, time
from bent_beam_programs.open_benchmark.reading import load_result
from bent_beam_programs.open_benchmark.result import ResultError
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
    files = {name: make(tmp_path_factory.mktemp("file")) for name, make in ({"good": pair()} | HOSTILE).items()}
    folder = tmp_path_factory.getbasetemp()
    before = sorted(folder.rglob("*"))
    process = started(program=READ_ALL, stdin=subprocess.PIPE, cwd=folder)
    out, _ = process.communicate("".join(f"{file}\n" for file in files.values()))
    assert sorted(folder.rglob("*")) == before, "nothing is written"
    return dict(zip(files, map(json.loads, out.splitlines()), strict=True))


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_result_is_refused_in_one_line_in_little_memory_and_time(answers, name):
    said, seconds, memory = answers[name]
    assert answers["good"][0] == "good"
    assert said != "good" and len(said) < 500 and all(c.isprintable() for c in said)
    assert seconds < 10.0 and memory < 1_000_000_000
    assert "table of contents" in said or name != "thousands of entries"  # before zipfile reads all of it


def test_mutated_results_are_read_or_refused(tmp_path):
    """Bits turned and bytes cut in an NPZ, a table and its JSON."""
    numbers = random.Random("results")
    np.savez(tmp_path / "good.npz", **FIELDS)
    pair()(tmp_path)
    originals = {name: (tmp_path / name).read_bytes() for name in ("good.npz", "run.csv", "run.json")}
    for _ in range(150):
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
