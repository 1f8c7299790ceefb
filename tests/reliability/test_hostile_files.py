"""Files built to harm are refused in one line: nothing else is opened, memory and time stay small."""

import json
import os
import random
import subprocess
import sys
import zlib

import h5py
import numpy as np
import pytest

from bent_beam import Impact, ImpactHistory
from comparison.command_line.app import run

FUZZ = bool(os.environ.get("FUZZ"))
SEED = os.environ.get("FUZZ_SEED", "0")
MUTATED = 3000 if FUZZ else 40
SECONDS, BYTES = 10.0, 1_000_000_000


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    time, x = np.linspace(0.0, 1.0, 12), np.linspace(0.0, 4.0, 20)
    history = ImpactHistory.build(
        impact=Impact.dimensionless(0.5),
        path="hermite",
        symmetry="half",
        settings={"mesh": {"kind": "UniformMesh"}},
        time=time,
        x=x,
        contact_x=x,
        fields={
            "gap": (("time", "x"), np.outer(time, x)),
            "impulse": (("time", "contact"), np.outer(time, x)),
            "in_contact": (("time", "contact"), np.outer(time, x) > 0.5),
            **{name: (("time",), time) for name in ("total_impulse", "kinetic_energy", "strain_energy")},
        },
    )
    return history.save(tmp_path_factory.mktemp("good") / "good.nc")


def replaced(name, make):
    def change(data):
        del data[name]
        make(data)

    return change


def bomb(name, shape):
    """Zeros that unpack to ``shape`` from next to nothing."""
    return lambda data: data.create_dataset(name, shape, "f8", chunks=True, compression="gzip", fillvalue=0.0)


def packed_bomb(data):
    """Chunks of 32 MB zeros that are really stored, 384 MB from some kilobytes."""
    made = data.create_dataset("zeros", (12, 4_000_000), "f8", chunks=(1, 4_000_000), compression="gzip")
    chunk = zlib.compress(bytes(32_000_000), 1)
    for number in range(12):
        made.id.write_direct_chunk((number, 0), chunk)


def deep(data):
    group = data
    for _ in range(300):
        group = group.create_group("g")


def virtual(data):
    layout = h5py.VirtualLayout((12, 20), "f8")
    layout[:] = h5py.VirtualSource("/etc/hostname", "gap", (12, 20))
    data.create_virtual_dataset("gap", layout)


def text(name, value):
    return lambda data: data.attrs.__setitem__(name, value)


def many_attributes(data):
    for number in range(1000):
        data.attrs[f"a{number}"] = number


def huge_attribute(data):
    data.attrs["settings"] = json.dumps({"a": "x" * 20_000_000})


def array_of_texts(data):
    data.attrs.create("settings", ["{}"] * 1000, dtype=h5py.string_dtype())


def scaled(data):
    data["gap"].attrs["scale_factor"] = np.ones(4_000)


HOSTILE = {
    "an external link for a field": replaced("gap", lambda d: d.__setitem__("gap", h5py.ExternalLink("x.nc", "/gap"))),
    "a soft link for a field": replaced("gap", lambda d: d.__setitem__("gap", h5py.SoftLink("/impulse"))),
    "a link to a file of the system": lambda d: d.__setitem__("more", h5py.ExternalLink("/etc/hostname", "/")),
    "values in another file": replaced(
        "gap", lambda d: d.create_dataset("gap", (12, 20), "u1", external=[("/etc/passwd", 0, h5py.h5f.UNLIMITED)])
    ),
    "values of a virtual dataset": replaced("gap", virtual),
    "announced terabytes": replaced("gap", bomb("gap", (10**6, 10**6))),
    "zeros of eight gigabytes": replaced("gap", bomb("gap", (12, 80_000_000))),
    "stored zeros": packed_bomb,
    "one dimension too many": replaced("gap", bomb("gap", (12, 20, 3))),
    "deep groups": deep,
    "a group that is its own child": lambda d: d.__setitem__("loop", d["/"]),
    "a type in place of a variable": lambda d: d.__setitem__("kind", np.dtype("f8")),
    "many variables": lambda d: [d.create_dataset(f"v{n}", (1,), "f8") for n in range(200)],
    "many attributes": many_attributes,
    "a huge attribute": huge_attribute,
    "an array of texts": array_of_texts,
    "an array to scale by": scaled,
    "objects": replaced("gap", lambda d: d.create_dataset("gap", data=["a"] * 12, dtype=h5py.string_dtype())),
    "references": replaced("gap", lambda d: d.create_dataset("gap", (12,), dtype=h5py.ref_dtype)),
    "compounds": replaced("gap", lambda d: d.create_dataset("gap", (12,), dtype=[("a", "f8"), ("b", "f8")])),
    "a name with a path": lambda d: d.create_dataset("a..\\b", (1,), "f8"),
    "a name with an escape": lambda d: d.create_dataset("a\x1b[2J", (1,), "f8"),
    "an escape in a warning": text("warnings", json.dumps(["\x1b]0;title\x07"])),
    "an escape in the path": text("path", "hermite\x1b[31m"),
    "an escape in a setting's name": text("settings", json.dumps({"\x9b31m": 1})),
    "writing turned round": text("settings", json.dumps({"a": "\u202egnp.exe"})),
    "a warning that is no text": text("warnings", json.dumps([{"a": 1}])),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_history_is_refused_before_its_values_are_read(name, good, tmp_path, examined_here):
    file = tmp_path / "bad.nc"
    file.write_bytes(good.read_bytes())
    (tmp_path / "x.nc").write_bytes(good.read_bytes())
    with h5py.File(file, "r+") as data:
        HOSTILE[name](data)
    with pytest.raises(ValueError) as refused:
        ImpactHistory.load(file)
    said = str(refused.value)
    assert "\n" not in said and len(said) < 500 and "\x1b" not in said, said


def test_a_pipe_that_nobody_writes_into_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.nc")
    with pytest.raises(ValueError, match="no regular file"):
        ImpactHistory.load(tmp_path / "pipe.nc")


def test_a_file_that_hangs_the_library_is_refused(good, tmp_path, monkeypatch):
    from bent_beam import examination, storage

    forever = tmp_path / "forever.py"
    forever.write_text("import resource\nresource.setrlimit(resource.RLIMIT_CPU, (1, 1))\nwhile True:\n    pass\n")
    monkeypatch.setattr(examination, "__file__", str(forever))
    with pytest.raises(ValueError, match="hangs or crashes"):
        storage.read_dataset(good)


def test_the_process_apart_has_one_thread_whose_stack_takes_of_its_memory(good, tmp_path, monkeypatch):
    from bent_beam import examination, storage

    told = tmp_path / "told.py"
    told.write_text("import os\nprint(os.environ['OPENBLAS_NUM_THREADS'], 'thread')\nraise SystemExit(1)\n")
    monkeypatch.setattr(examination, "__file__", str(told))
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "64")
    with pytest.raises(ValueError, match="1 thread"):
        storage.read_dataset(good)


def test_what_stands_in_a_file_is_told_by_the_process_apart(good, tmp_path):
    file = tmp_path / "bad.nc"
    file.write_bytes(good.read_bytes())
    ImpactHistory.load(file)
    with h5py.File(file, "r+") as data:
        HOSTILE["a soft link for a field"](data)
    with pytest.raises(ValueError, match="gap is a link to elsewhere"):
        ImpactHistory.load(file)


READ_ALL = """
import json, resource, sys, time
import bent_beam.storage
from bent_beam import ImpactHistory
from bent_beam.examination import LIBRARIES, allowed, examine
bent_beam.storage.examine_apart = lambda file, patience: examine(file)  # this process is apart already
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
resource.setrlimit(resource.RLIMIT_DATA, (LIBRARIES + allowed(0),) * 2)
for line in sys.stdin:
    began, said = time.process_time(), "good"
    resource.setrlimit(resource.RLIMIT_CPU, (int(began) + 2, resource.RLIM_INFINITY))
    try:
        ImpactHistory.load(line.strip())
    except ValueError as error:
        said = str(error)
    most = next(int(x.split()[1]) * 1024 for x in open("/proc/self/status") if x.startswith("VmHWM"))
    print(json.dumps([said, time.process_time() - began, most]), flush=True)
"""


class Reader:
    """Reads many files in one process, as ``examine_apart`` does one; it ends when the library crashes or hangs."""

    def __init__(self):
        self.process = None

    def read(self, file):
        """(what it said, CPU seconds, bytes at most); a process that died says so."""
        if self.process is None or self.process.poll() is not None:
            self.process = subprocess.Popen(
                [sys.executable, "-c", READ_ALL], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
            )
        self.process.stdin.write(f"{file}\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        return json.loads(line) if line else (f"died ({self.process.wait()})", 0.0, 0)

    def close(self):
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait(timeout=30)


def mutated(content, numbers):
    """Bits turned, runs of bytes overwritten or copied elsewhere, the end cut, large numbers written in."""
    data = bytearray(content)
    for _ in range(numbers.randint(1, 6)):
        at, length = numbers.randrange(len(data)), numbers.choice([1, 2, 4, 8, 64, 512])
        match numbers.randrange(6):
            case 0:
                data[at] ^= 1 << numbers.randrange(8)
            case 1:
                data[at : at + length] = numbers.randbytes(length)
            case 2:
                source = numbers.randrange(len(data))
                data[at : at + length] = data[source : source + length]
            case 3:
                data[at : at + 8] = numbers.choice([0, 2**31 - 1, 2**32 - 1, 2**63 - 1, 10**9]).to_bytes(8, "little")
            case 4:
                data[at : at + length] = b"\0" * length
            case _:
                if numbers.randrange(4) == 0:
                    del data[max(at, 600) :]
    return bytes(data)


def test_mutated_histories_are_read_or_refused_quickly_and_kill_nothing(good, tmp_path):
    """Half of the mutations strike the first 16 kB, where HDF5 keeps what it says of the rest. About one file in
    forty hangs or crashes the HDF5 library: those are refused as damaged."""
    numbers, reader = random.Random(f"{SEED} mutated"), Reader()
    content, file = good.read_bytes(), tmp_path / "mutated.nc"
    said, slowest, most, died = [], 0.0, 0, []
    try:
        for number in range(MUTATED):
            edge = min(len(content), 16_000)
            head = number % 2 == 0
            changed = mutated(content[:edge], numbers) + content[edge:] if head else mutated(content, numbers)
            file.write_bytes(changed)
            answer, seconds, memory = reader.read(file)
            said.append(answer)
            slowest, most = max(slowest, seconds), max(most, memory)
            if answer.startswith("died"):
                died.append(answer)
                if len(died) <= 3:  # five seconds each
                    with pytest.raises(ValueError, match="damaged"):
                        ImpactHistory.load(file)
    finally:
        reader.close()
    good_ones = said.count("good")
    print(f"{MUTATED} mutated histories: {good_ones} good, slowest {slowest:.2f} s, {most / 1e6:.0f} MB; HDF5 {died}")
    assert slowest < SECONDS and most < BYTES
    assert all("\n" not in answer and "\x1b" not in answer for answer in said)


def test_a_hostile_case_reaches_the_terminal_without_its_escapes(tmp_path):
    file = tmp_path / "case.toml"
    file.write_text('[beam]\n"\\u001b[31mlength" = 1.0\n"\\u009b2J" = "<script>"\n')
    main = "from comparison.command_line.app import main; main()"
    done = subprocess.run([sys.executable, "-c", main, "predict", file], capture_output=True, text=True)
    assert done.returncode == 2 and "\x1b" not in done.stderr and "\x9b" not in done.stderr


EVIL = "\x1b]0;x\x07\x9b31m\u202e<script>alert(1)</script>"
TEXTS = {
    "a case's title": "study mesh {case} --set hermite.integrator.kind={evil}",
    "a setting's value": "predict {case} --set beam.{evil}=1",
    "a setting in JSON": "predict {case} --json --set impact.velocity={evil}",
    "a case's name": "predict {folder}/{evil}.toml",
    "a method's label": "match --methods {methods} --kappa-over-nu 2",
    "a label that is mathematics": "match --methods {mathematics} --kappa-over-nu 2",
    "a result's name": "score {folder}/{evil}.npz",
    "a result's name in JSON": "score {folder}/{evil}.npz --json",
    "a history's name": "rerun {folder}/{evil}.nc",
    "a figure's name": "gallery {evil}",
    "a study's name": "study {evil}",
    "a problem's name": "problem {evil}",
    "a folder": "new {folder}/{evil}/x.toml",
}


@pytest.mark.parametrize("name", TEXTS)
def test_no_text_acts_on_the_terminal(name, tmp_path, capsys):
    """Control characters and writing turned round come out as their codes, in text and JSON, on either stream."""
    quoted = json.dumps(EVIL).replace("\\u009b", "\x9b")
    beam = "[beam]\nbending_stiffness = 1.0\nmass_per_length = 1.0\nlength = 2.0\ncurvature = 0.5\n"
    texts = {
        "case": f"title = {quoted}\n{beam}[impact]\nvelocity = 1.0\n",
        "methods": f'[[method]]\npath = "hermite"\nlabel = {quoted}\n',
        "mathematics": '[[method]]\npath = "hermite"\nlabel = "$\\\\frac{$ <b>"\n',
    }
    words = {"folder": str(tmp_path), "evil": EVIL.replace("/", "|")}
    for kind, text in texts.items():
        (tmp_path / f"{kind}.toml").write_text(text)
        words[kind] = str(tmp_path / f"{kind}.toml")
    code = run([word.format(**words) for word in TEXTS[name].split()])
    said = capsys.readouterr()
    assert code in (0, 2) and (code == 0 or said.err.count("\n") == 1)
    assert all(c.isprintable() or c == "\n" for c in said.out + said.err), said
