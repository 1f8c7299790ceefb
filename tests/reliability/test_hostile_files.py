"""Files built to harm are refused in one line: nothing else is opened, nothing runs, memory and time stay small."""

import json
import math
import os
import re
import signal

import h5py
import numpy as np
import pytest
from called import CASE, command, refused

import hermite_fe
from bent_beam import Impact, ImpactHistory, guarded
from bent_beam.cases import EXAMPLES
from bent_beam.meshes import UniformMesh
from comparison.compare import rerun_history
from hermite_fe.integrators import SignoriniPosition


@pytest.fixture(scope="module")
def history():
    """Twelve instants of twelve nodes: square, so that the shape of a field tells nothing."""
    steps = SignoriniPosition(time_step=1e-5, growth=1e-2)
    impact, mesh = Impact.dimensionless(0.5, length=20.0), UniformMesh(10.0 / 11.0)
    found = hermite_fe.simulate(impact, end_time=0.1, mesh=mesh, integrator=steps, save=12)
    return ImpactHistory.of(found.dataset[["gap", "impulse", "total_impulse", "kinetic_energy", "strain_energy"]])


@pytest.fixture(scope="module")
def good(history, tmp_path_factory):
    """Its file, which is read."""
    file = history.save(tmp_path_factory.mktemp("good") / "good.nc")
    assert ImpactHistory.load(file).array("gap").shape == (12, 12)
    return file.read_bytes()


def gap(*arguments, **options):
    return lambda data: data.create_dataset("gap", *arguments, **options)


def bomb(*shape):
    """Zeros that unpack to ``shape`` from next to nothing."""
    return gap(shape, "f8", chunks=True, compression="gzip", fillvalue=0.0)


def virtual(data):
    layout = h5py.VirtualLayout((12, 12), "f8")
    layout[:] = h5py.VirtualSource("/etc/hostname", "gap", (12, 12))
    data.create_virtual_dataset("gap", layout)


HOSTILE = {
    "a link": ("link to elsewhere", lambda data: data.update(gap=h5py.ExternalLink("x.nc", "/gap"))),
    "values in another file": ("another file", gap((9,), "u1", external=[("/etc/passwd", 0, h5py.h5f.UNLIMITED)])),
    "values of a virtual dataset": ("another file", virtual),
    "announced 384 megabytes": ("bytes of memory", bomb(12, 4_000_000)),
    "one dimension too many": ("two dimensions", bomb(12, 12, 3)),
    "a group": ("no groups", lambda data: data.create_group("g")),
    "many variables": ("variables", lambda data: [data.create_dataset(f"v{n}", (1,), "f8") for n in range(200)]),
    "many attributes": ("attributes", lambda data: data.attrs.update({f"a{n}": n for n in range(1000)})),
    "a huge attribute": ("too long", lambda data: data.attrs.update(settings="x" * 20_000_000)),
    "many texts": ("one text", lambda data: data.attrs.create("path", ["{}"] * 1000, dtype=h5py.string_dtype())),
    "an array to scale by": ("few numbers", lambda data: data["x"].attrs.update(scale_factor=np.ones(4_000))),
    "objects": ("numbers", gap(data=["a"] * 12, dtype=h5py.string_dtype())),
    "a name with an escape": ("the name", lambda data: data.create_dataset("a\x1b[2J", (1,), "f8")),
}


def refusal(file):
    with pytest.raises(ValueError) as caught:
        ImpactHistory.load(file)
    said = str(caught.value)
    assert "\n" not in said and len(said) < 500 and "\x1b" not in said, said
    return said


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_is_refused_before_its_values_are_read(name, good, tmp_path):
    file = tmp_path / "bad.nc"
    file.write_bytes(good)
    (tmp_path / "x.nc").write_bytes(good)
    why, change = HOSTILE[name]
    with h5py.File(file, "r+") as data:
        del data["gap"]
        change(data)
    assert re.search(f"is not a readable history: .*{why}", refusal(file))


def changed(name, change, dims=None, **attributes):
    """One variable made anew, from its values."""

    def make(data):
        old = data[name]
        return data.drop_vars(name).assign({name: (dims or old.dims, change(old.values), old.attrs | attributes)})

    return make


def attribute(name, value):
    return lambda data: data.assign_attrs({name: value if isinstance(value, str | float) else json.dumps(value)})


def without(name):
    return lambda data: data.drop_attrs(deep=False).assign_attrs({k: v for k, v in data.attrs.items() if k != name})


def impact(**changes):
    return lambda data: data.assign_attrs(impact=json.dumps(json.loads(data.attrs["impact"]) | changes))


MISREAD = {
    "transposed": changed("gap", np.transpose, ("x", "time")),
    "millimetres": changed("gap", lambda v: 1e3 * v, units="mm"),
    "nodes from right to left": changed("x", lambda v: v[::-1]),
    "a time before the impact": changed("time", lambda v: v - 0.05),
    "sizes that overflow": changed("gap", lambda v: 1e200 * v),
    "no number": changed("gap", lambda v: np.nan * v),
    "no times": lambda data: data.drop_vars("time"),
    "a half beam to the left": changed("x", lambda v: v - 9.0),
    "a beam longer than itself": changed("x", lambda v: 1e4 * v),
    "the half said to be the full beam": attribute("symmetry", "full"),
    "a symmetry that is none": attribute("symmetry", "none"),
    "no format": without("format"),
    "no settings": without("settings"),
    "nesting without end": attribute("settings", "[" * 100_000),
    "an escape in a setting's name": attribute("settings", {"\x9b31m": 1}),
    "writing turned round": attribute("settings", {"a": "\u202egnp.exe"}),
    "an escape in a warning": attribute("warnings", ["\x1b]0;title\x07"]),
    "a warning that is no text": attribute("warnings", [{"a": 1}]),
    "an escape in the path": attribute("path", "hermite\x1b[31m"),
    "a section without its modulus": attribute("section", {"area": 1.0}),
    "a section without end": attribute("section", {"area": math.inf, "section_modulus": 1.0}),
    "an impact of NaN": impact(velocity=float("nan")),
    "an impact beyond any float": impact(length=10**400),
    "an impact of something else": impact(__class__="os.system"),
}


@pytest.mark.parametrize("name", MISREAD)
def test_a_history_that_would_be_misread_is_refused(name, history, tmp_path):
    file = ImpactHistory.of(MISREAD[name](history.dataset)).save(tmp_path / "bad.nc")
    assert re.search(r"bad\.nc is not a (good )?history", refusal(file))


@pytest.mark.parametrize("part", ["total_impulse", "settings"])
def test_one_bit_that_flips_in_a_number_is_seen(part, history, tmp_path):
    """HDF5 itself reads both without a word."""
    file = history.save(tmp_path / "flipped.nc")
    content = bytearray(file.read_bytes())
    digit = bytes(history.array(part)) if part in history else b'"end_time": 0.'
    place = content.index(digit) + len(digit)
    content[place - 3 if part in history else place] ^= 1
    file.write_bytes(content)
    assert "flipped.nc is not what was written" in refusal(file)


CRAFTED = {
    "no such path": dict(path="../../etc"),
    "an unknown class": dict(mesh={"kind": "Popen", "args": ["true"]}),
    "a class without a name": dict(mesh={"kind": ["UniformMesh"]}),
    "a mesh too fine": dict(mesh={"kind": "UniformMesh", "element_length": 1e-300}),
    "a text for a time": dict(end_time="later"),
    "many instants": dict(save=10**12),
    "a table for instants": dict(save={"a": 1}),
}


@pytest.mark.parametrize("name", CRAFTED)
def test_a_crafted_history_is_not_run_again(name, history):
    path, settings = CRAFTED[name].get("path", history.path), history.settings | CRAFTED[name]
    with pytest.raises(ValueError) as caught:
        rerun_history(ImpactHistory.of(history.dataset.assign_attrs(path=path, settings=json.dumps(settings))))
    assert "\n" not in str(caught.value)


UNREADABLE = {"binary": os.urandom(4096), "large": b"# " + b"x" * 10_000_000}
UNREADABLE |= {"deep": b"a = " + b"[" * 100_000, "long number": b"a = " + b"9" * 10_000}


@pytest.mark.parametrize("kind", ["missing", "folder", *UNREADABLE])
def test_unreadable_case_files_are_refused(kind, tmp_path):
    file = tmp_path / "case.toml"
    if kind == "folder":
        file.mkdir()
    elif kind != "missing":
        file.write_bytes(UNREADABLE[kind])
    assert "error: case file" in refused("predict", file, "--json")


@pytest.mark.parametrize("table", ["beam.damping", "hermite.mesh", "mesh.kind", "nonsense"])
def test_tables_nested_without_end_are_refused_in_one_line(table, tmp_path):
    """Two thousand tables in each other take no bracket: a.a.a… = 1."""
    (tmp_path / "case.toml").write_text(f"{CASE}[{table}]\n{'a.' * 2000}b = 1\n")
    refused("simulate", tmp_path / "case.toml")


EVIL = "\x1b]0;x\x07\x9b31m\u202e<script>alert(1)<|script>"
OUT = [("predict {evil}.toml", 2), ("score {evil}.npz --json", 2), ("new {evil}/x.toml", 0)]
OUT += [(f"predict {EXAMPLES}/tube.toml --json --set impact.velocity={{evil}}", 2)]


@pytest.mark.parametrize(("words", "code"), OUT)
def test_no_text_acts_on_the_terminal(words, code):
    """Control characters and writing turned round come out as their codes, in text and JSON, on either stream."""
    found, out, err = command(*words.format(evil=EVIL).split())
    assert (found, err.count("\n")) == (code, code // 2)
    assert "u202e" in out + err and all(c.isprintable() or c == "\n" for c in out + err), (out, err)


def test_an_answer_that_nobody_waited_for_is_not_taken_for_that_on_the_next_file(good, tmp_path):
    """Ctrl-C while a damaged file is examined: a good one is read, and the damaged one is still refused."""
    (tmp_path / "good.nc").write_bytes(good)
    (tmp_path / "bad.nc").write_bytes(b"any")
    ImpactHistory.load(tmp_path / "good.nc")  # the child is there
    child = guarded._child
    os.kill(child.pid, signal.SIGSTOP)
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    signal.setitimer(signal.ITIMER_REAL, 0.2)
    with pytest.raises(KeyboardInterrupt):
        ImpactHistory.load(tmp_path / "bad.nc")
    signal.signal(signal.SIGALRM, before)
    if child.poll() is None:
        os.kill(child.pid, signal.SIGCONT)
    assert ImpactHistory.load(tmp_path / "good.nc").time.size == 12
    assert "signature" in refusal(tmp_path / "bad.nc")


def test_a_file_whose_reading_hangs_or_crashes_is_no_history(tmp_path, monkeypatch):
    os.mkfifo(tmp_path / "pipe.nc")  # nobody writes into it
    assert "no regular file" in refusal(tmp_path / "pipe.nc")
    (tmp_path / "damaged.nc").write_bytes(b"any")
    hang, crash = "import signal, time; signal.alarm(1); time.sleep(60)", "import os; os.abort()"
    for start, why in ((hang, "takes longer than"), (crash, "is a crash")):
        monkeypatch.setattr("bent_beam.guarded._child", None)
        monkeypatch.setattr("bent_beam.guarded.CHILD", start)
        with pytest.raises(ValueError, match=rf"damaged.nc is not a readable history: to read it {why}"):
            ImpactHistory.load(tmp_path / "damaged.nc")
    monkeypatch.undo()
    with pytest.raises(ValueError, match=r"not a readable history: .*signature"):
        ImpactHistory.load(tmp_path / "damaged.nc")
