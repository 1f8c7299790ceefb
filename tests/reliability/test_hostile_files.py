"""Files built to harm are refused in one line: nothing else is opened, memory and time stay small."""

import json
import os
import zlib

import h5py
import numpy as np
import pytest
from histories import history_of

from bent_beam import ImpactHistory
from comparison.command_line.app import run


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    time, x = np.linspace(0.0, 1.0, 12), np.linspace(0.0, 4.0, 20)
    history = history_of(time, x, gap=np.outer(time, x), impulse=np.outer(time, x), in_contact=np.outer(time, x) > 0.5)
    return history.save(tmp_path_factory.mktemp("good") / "good.nc")


def replaced(name, make):
    def change(data):
        del data[name]
        make(data)

    return change


def bomb(*shape):
    """Zeros that unpack to ``shape`` from next to nothing."""
    return replaced(
        "gap", lambda d: d.create_dataset("gap", shape, "f8", chunks=True, compression="gzip", fillvalue=0.0)
    )


def packed_bomb(data):
    """Chunks of 32 MB zeros that are really stored, 384 MB from some kilobytes."""
    made = data.create_dataset("zeros", (12, 4_000_000), "f8", chunks=(1, 4_000_000), compression="gzip")
    chunk = zlib.compress(bytes(32_000_000), 1)
    for number in range(12):
        made.id.write_direct_chunk((number, 0), chunk)


def virtual(data):
    layout = h5py.VirtualLayout((12, 20), "f8")
    layout[:] = h5py.VirtualSource("/etc/hostname", "gap", (12, 20))
    data.create_virtual_dataset("gap", layout)


def text(name, value):
    return lambda data: data.attrs.__setitem__(name, value)


def many_attributes(data):
    for number in range(1000):
        data.attrs[f"a{number}"] = number


HOSTILE = {
    "an external link for a field": replaced("gap", lambda d: d.__setitem__("gap", h5py.ExternalLink("x.nc", "/gap"))),
    "a soft link for a field": replaced("gap", lambda d: d.__setitem__("gap", h5py.SoftLink("/impulse"))),
    "a link to a file of the system": lambda d: d.__setitem__("more", h5py.ExternalLink("/etc/hostname", "/")),
    "values in another file": replaced(
        "gap", lambda d: d.create_dataset("gap", (12, 20), "u1", external=[("/etc/passwd", 0, h5py.h5f.UNLIMITED)])
    ),
    "values of a virtual dataset": replaced("gap", virtual),
    "announced terabytes": bomb(10**6, 10**6),
    "zeros of eight gigabytes": bomb(12, 80_000_000),
    "stored zeros": packed_bomb,
    "one dimension too many": bomb(12, 20, 3),
    "a group": lambda d: d.create_group("g"),
    "a group that is its own child": lambda d: d.__setitem__("loop", d["/"]),
    "a type in place of a variable": lambda d: d.__setitem__("kind", np.dtype("f8")),
    "many variables": lambda d: [d.create_dataset(f"v{n}", (1,), "f8") for n in range(200)],
    "many attributes": many_attributes,
    "a huge attribute": text("settings", json.dumps({"a": "x" * 20_000_000})),
    "an array of texts": lambda d: d.attrs.create("settings", ["{}"] * 1000, dtype=h5py.string_dtype()),
    "an array to scale by": lambda d: d["gap"].attrs.__setitem__("scale_factor", np.ones(4_000)),
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
def test_a_hostile_history_is_refused_before_its_values_are_read(name, good, tmp_path):
    assert ImpactHistory.load(good).path == "bare"
    file = tmp_path / "bad.nc"
    file.write_bytes(good.read_bytes())
    (tmp_path / "x.nc").write_bytes(good.read_bytes())
    with h5py.File(file, "r+") as data:
        HOSTILE[name](data)
    with pytest.raises(ValueError) as refused:
        ImpactHistory.load(file)
    said = str(refused.value)
    assert "\n" not in said and len(said) < 500 and "\x1b" not in said, said


def changed(name, change):
    """One variable made anew: (dims, values, attributes) in, the same out."""

    def make(data):
        old = data[name]
        dims, values, attributes = change(old.dims, old.values, dict(old.attrs))
        return data.drop_vars(name).assign({name: (dims, values, attributes)})

    return make


MISREAD = {
    "transposed": changed("gap", lambda d, v, a: (d[::-1], v.T, a)),
    "a field of one instant": changed("gap", lambda d, v, a: (("x",), v[0], a)),
    "an impulse at the nodes": changed("impulse", lambda d, v, a: (("time", "x"), v, a)),
    "an energy of nodes": changed("kinetic_energy", lambda d, v, a: (("x",), v, a)),
    "millimetres": changed("gap", lambda d, v, a: (d, 1e3 * v, a | {"units": "mm"})),
    "nodes from right to left": changed("x", lambda d, v, a: (d, v[::-1], a)),
    "a time before the impact": changed("time", lambda d, v, a: (d, v - 0.5, a)),
    "sizes that overflow": changed("gap", lambda d, v, a: (d, 1e200 * v, a)),
    "no times": lambda data: data.drop_vars("time"),
    "a half beam to the left": lambda data: data.assign_coords(x=("x", data.x.values - 9.0, data.x.attrs)),
    "a beam longer than itself": lambda data: data.assign_coords(x=("x", 1e4 * data.x.values, data.x.attrs)),
    "the half said to be the full beam": lambda data: data.assign_attrs(symmetry="full"),
}


@pytest.mark.parametrize("name", MISREAD)
def test_a_history_that_would_be_misread_is_refused(name, tmp_path):
    """Square, so that its shape tells nothing."""
    time = np.linspace(0.0, 1.0, 12)
    history = history_of(time, 4.0 * time, gap=np.outer(time, time), impulse=np.outer(time, time))
    ImpactHistory.load(history.save(tmp_path / "good.nc"))
    with pytest.raises(ValueError, match=r"bad\.nc is not a good history"):
        ImpactHistory.load(ImpactHistory(MISREAD[name](history.dataset)).save(tmp_path / "bad.nc"))


def test_a_pipe_that_nobody_writes_into_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "pipe.nc")
    with pytest.raises(ValueError, match="no regular file"):
        ImpactHistory.load(tmp_path / "pipe.nc")


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
