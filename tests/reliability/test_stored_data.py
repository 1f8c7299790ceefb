"""Stored histories and case files are data: the same run again, bit for bit; anything else in them is refused."""

import contextlib
import io
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
import pytest

import exudyn_models
import hermite_fe
from bent_beam import Impact, ImpactHistory, load_case
from bent_beam.meshes import UniformMesh
from comparison.command_line.app import run
from comparison.rerun import rerun_history
from exudyn_models.contacts import CONTACTS
from exudyn_models.integrators import INTEGRATORS
from hermite_fe.integrators import MoreauJean, SignoriniPosition
from self_similar_fe.mesh import ExpandingMesh
from self_similar_fe.run import simulate_expanding

IMPACT = Impact.dimensionless(0.5, length=20.0, epsilon_alpha=0.2)
COARSE = UniformMesh(0.1)
MAIN = "from comparison.command_line.app import main; main()"


def hermite(**parts):
    parts = {"mesh": COARSE, "integrator": SignoriniPosition(time_step=1e-5, growth=1e-2), "save": 12} | parts
    return hermite_fe.simulate(IMPACT, end_time=0.1, **parts)


def exudyn(**parts):
    parts = {
        "mesh": UniformMesh(0.5),
        "integrator": INTEGRATORS["generalized_alpha"](relative_step=0.02),
        "save": 12,
    } | parts
    return exudyn_models.simulate(IMPACT, end_time=0.1, **parts)


RUNS = {
    "hermite": hermite,
    "hermite saved at given times": lambda: hermite(save=[0.01, 0.05, 0.1]),
    "hermite moreau_jean": lambda: hermite(integrator=MoreauJean(time_step=1e-4), full_beam=True),
    "expanding": lambda: simulate_expanding(
        IMPACT, ExpandingMesh(front_resolution=0.05, decades=2.0), end_time=0.1, save=12
    ),
    "exudyn": exudyn,
    "exudyn rigid": lambda: exudyn(contact=CONTACTS["rigid"](), integrator=None),
    "exudyn explicit": lambda: exudyn(integrator=INTEGRATORS["rk44"]()),
}


@pytest.mark.parametrize("name", RUNS)
def test_the_same_case_gives_the_same_bits_and_its_file_is_enough_to_run_it_again(name, tmp_path):
    first, second = RUNS[name](), RUNS[name]()
    for variable in first.dataset.variables:
        assert np.array_equal(first.dataset[variable].values, second.dataset[variable].values), variable
    found = rerun_history(ImpactHistory.load(first.save(tmp_path / "run.nc")))
    assert found["identical"], found


def command(*arguments):
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run([str(a) for a in arguments])
    return code, out.getvalue(), err.getvalue()


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    return hermite().save(tmp_path_factory.mktemp("histories") / "good.nc")


def changed(good, tmp_path, change):
    file = tmp_path / "bad.nc"
    file.write_bytes(good.read_bytes())
    with h5py.File(file, "r+") as data:
        change(data)
    return file


def attribute(name, value):
    return lambda data: data.attrs.__setitem__(name, value)


def setting(**changes):
    def change(data):
        settings = json.loads(data.attrs["settings"])
        settings.update(changes)
        data.attrs["settings"] = json.dumps(settings)

    return change


def objects(data):
    del data["gap"]
    data.create_dataset("gap", data=["__import__('os')"] * 12, dtype=h5py.string_dtype())


def without(*names):
    def change(data):
        for name in names:
            del data.attrs[name]

    return change


def not_finite(data):
    data["gap"][0, 0] = np.nan


GOOD_IMPACT = dict(bending_stiffness=1.0, mass_per_length=1.0, length=20.0, curvature=0.5, velocity=1.0)
CRAFTED = {
    "objects": objects,
    "NaN in a field": not_finite,
    "no format": without("format"),
    "no settings": without("settings"),
    "impact no JSON": attribute("impact", "{"),
    "impact a list": attribute("impact", "[1, 2]"),
    "impact NaN": attribute("impact", json.dumps(GOOD_IMPACT | {"velocity": float("nan")})),
    "impact text": attribute("impact", json.dumps(GOOD_IMPACT | {"velocity": "fast"})),
    "impact huge": attribute("impact", json.dumps(GOOD_IMPACT | {"length": 10**400})),
    "impact unknown": attribute("impact", json.dumps(GOOD_IMPACT | {"__class__": "os.system"})),
    "impact a number": attribute("impact", 3.0),
    "nesting without end": attribute("settings", "[" * 100_000),
    "path": attribute("path", "../../etc"),
    "symmetry": attribute("symmetry", "none"),
    "unknown class": setting(mesh={"kind": "Popen", "args": ["true"]}),
    "class by module": setting(integrator={"kind": "os.system"}),
    "class no name": setting(mesh={"kind": ["UniformMesh"]}),
    "mesh of nothing": setting(mesh={"kind": "UniformMesh", "element_length": 0.0}),
    "mesh of text": setting(mesh={"kind": "UniformMesh", "element_length": "__import__('os')"}),
    "mesh too fine": setting(mesh={"kind": "UniformMesh", "element_length": 1e-300}),
    "steps without end": setting(integrator={"kind": "SignoriniPosition", "time_step": 1e-300, "growth": 0.0}),
    "end time": setting(end_time="later"),
    "end time NaN": setting(end_time=float("nan")),
    "save": setting(save=10**12),
    "save of text": setting(save=["a"]),
    "save of tables": setting(save={"a": 1}),
}


@pytest.mark.parametrize("name", CRAFTED)
def test_a_crafted_history_is_refused_in_one_line(name, good, tmp_path, examined_here):
    file = changed(good, tmp_path, CRAFTED[name])
    code, out, err = command("rerun", file, "--json")
    assert code == 2 and out == "", (code, err)
    assert err.startswith("error: ") and err.count("\n") == 1


@pytest.mark.parametrize("damage", ["cut", "flipped", "empty", "text", "folder"])
def test_a_damaged_history_is_never_taken_for_another(damage, good, tmp_path):
    file, data = tmp_path / "bad.nc", good.read_bytes()
    if damage == "folder":
        file.mkdir()
    else:
        flipped = data[: len(data) // 3] + bytes(255 - b for b in data[len(data) // 3 :])
        file.write_bytes({"cut": data[:-1000], "flipped": flipped, "empty": b"", "text": b"{}"}[damage])
    code, _, err = command("rerun", file)
    assert code == 2 and err.count("\n") == 1


def test_a_history_larger_than_memory_is_refused_before_it_is_read(good, tmp_path):
    def grow(data):
        data.create_dataset("huge", shape=(10**12,), dtype="f8", chunks=(10**6,))

    code, _, err = command("rerun", changed(good, tmp_path, grow))
    assert code == 2 and "bytes of memory" in err


# --- files and folders ------------------------------------------------------------

CASE = """[beam]
bending_stiffness = 1.0
mass_per_length = 1.0
length = 20.0
curvature = 0.5
[impact]
velocity = 1.0
[mesh]
kind = "uniform"
element_length = 0.2
[hermite.integrator]
kind = "signorini_position"
growth = 0.02
"""


@pytest.fixture
def case(tmp_path):
    file = tmp_path / "case.toml"
    file.write_text(CASE)
    return file


@pytest.mark.parametrize("kind", ["missing", "folder", "binary", "large", "deep", "long number"])
def test_unreadable_case_files_are_refused(kind, tmp_path):
    file = tmp_path / "case.toml"
    if kind == "folder":
        file.mkdir()
    elif kind != "missing":
        contents = {
            "binary": os.urandom(4096),
            "large": b"# " + b"x" * 10_000_000,
            "deep": b"a = " + b"[" * 100_000,
            "long number": b"a = " + b"9" * 10_000,
        }
        file.write_bytes(contents[kind])
    code, out, err = command("predict", file, "--json")
    assert code == 2 and out == "" and err.count("\n") == 1 and "case" in err


@pytest.mark.parametrize(
    "table",
    [
        *(pytest.param(name, marks=pytest.mark.verify) for name in ("beam", "mesh", "section", "impact", "run")),
        *("hermite", "hermite.mesh", "nonsense"),
    ],
)
def test_tables_nested_without_end_are_refused_in_one_line(table, tmp_path):
    """Five thousand tables in each other take no bracket: a.a.a… = 1."""
    deep = f"[{table}]\n{'a.' * 5000}b = 1\n"
    for name, text, arguments in (
        ("case.toml", deep, ["predict"]),
        ("more.toml", CASE.replace("[hermite.integrator]", f"{deep}[hermite.integrator]"), ["simulate"]),
        ("methods.toml", f'[[method]]\npath = "hermite"\n{"a." * 5000}b = 1\n', ["match", "--methods"]),
    ):
        (tmp_path / name).write_text(text)
        code, out, err = command(*arguments, tmp_path / name)
        assert code == 2 and out == "" and err.count("\n") == 1, err


def test_a_file_without_permission_is_refused():
    with tempfile.TemporaryDirectory(dir="/tmp") as folder:
        os.chmod(folder, 0o755)
        file = Path(folder) / "case.toml"
        file.write_text(CASE)
        os.chmod(file, 0)
        user = os.geteuid()
        if user == 0:  # who may read everything
            os.seteuid(65534)
        try:
            code, _, err = command("predict", file)
        finally:
            os.seteuid(user)
    assert code == 2 and "permission denied" in err


@pytest.mark.parametrize("out", ["/proc/history.nc", "/dev/null/x/history.nc", "/dev/full/history.nc"])
def test_a_folder_that_cannot_be_written_is_refused_before_the_run(out, case, monkeypatch):
    monkeypatch.setattr(hermite_fe.HermiteFE, "simulate", lambda *a, **k: pytest.fail("it ran"))
    code, stdout, err = command("simulate", case, "--out", out, "--json")
    assert code == 2 and stdout == "" and "out:" in err and err.count("\n") == 1


def test_a_folder_in_the_place_of_the_file_is_refused(case, tmp_path):
    (tmp_path / "history.nc").mkdir()
    code, _, err = command("simulate", case, "--out", tmp_path / "history.nc", "--overwrite")
    assert code == 2 and "directory" in err


def test_a_full_disk_costs_the_file_and_not_the_answer(case, tmp_path):
    disk = tmp_path / "disk"
    disk.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(disk)]
    if os.getuid() != 0 or subprocess.run(mount, capture_output=True).returncode != 0:
        pytest.skip("needs the right to mount a small file system")
    try:
        code, out, err = command("simulate", case, "--out", disk / "history.nc", "--save", 500, "--json")
        assert code == 2 and "could not be written" in err and err.count("\n") == 1
        assert json.loads(out)["file"] is None and json.loads(out)["total_impulse"]["value"] > 0.0
        assert list(disk.iterdir()) == []  # nor half a file
    finally:
        subprocess.run(["umount", str(disk)], check=True)


def test_a_full_standard_output_is_an_error():
    if not os.path.exists("/dev/full"):
        pytest.skip("no /dev/full here")
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-c", MAIN, "theory", "--kappa-over-nu", "0.5"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
        )
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr


@pytest.mark.parametrize(("closed", "number"), [("<&-", 0), (">&-", 1), ("2>&-", 2)])
def test_a_closed_standard_stream_is_no_file_that_is_opened_later(closed, number, case):
    """As cron jobs and daemons are started: nothing is said there, and nothing of it lands anywhere else."""
    for file, code in ((case, 0), (case.with_name("missing.toml"), 2)):
        line = f'exec "$0" -c "$1" predict "$2" --json {closed}'
        done = subprocess.run(["sh", "-c", line, sys.executable, MAIN, str(file)], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        assert bool(done.stdout) == (code == 0 and number != 1)
        assert done.stderr.count("\n") == (code == 2 and number != 2)


def test_paths_in_a_case_write_nothing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    file = tmp_path / "case.toml"
    file.write_text('title = "../../../evil"\n' + CASE)
    code, _, _ = command("simulate", file, "--json")
    assert code == 0 and {f.name for f in tmp_path.iterdir()} == {"case.toml"}
    assert load_case(file).title == "../../../evil"
