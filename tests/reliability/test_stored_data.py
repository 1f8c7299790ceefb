"""Stored histories and case files are data: the same run again, bit for bit; anything else in them is refused."""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
import pytest
from called import refused

import exudyn_models
import hermite_fe
from bent_beam import Impact, ImpactHistory
from bent_beam.meshes import UniformMesh
from comparison.compare import rerun_history
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


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    return hermite().save(tmp_path_factory.mktemp("histories") / "good.nc")


def attribute(name, value):
    return lambda data: data.attrs.__setitem__(name, value)


def setting(**changes):
    def change(data):
        settings = json.loads(data.attrs["settings"])
        settings.update(changes)
        data.attrs["settings"] = json.dumps(settings)

    return change


def without(name):
    return lambda data: data.attrs.__delitem__(name)


def not_finite(data):
    data["gap"][0, 0] = np.nan


GOOD_IMPACT = dict(bending_stiffness=1.0, mass_per_length=1.0, length=20.0, curvature=0.5, velocity=1.0)
CRAFTED = {
    "NaN in a field": not_finite,
    "no format": without("format"),
    "no settings": without("settings"),
    "impact no JSON": attribute("impact", "{"),
    "impact NaN": attribute("impact", json.dumps(GOOD_IMPACT | {"velocity": float("nan")})),
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
    "mesh too fine": setting(mesh={"kind": "UniformMesh", "element_length": 1e-300}),
    "steps without end": setting(integrator={"kind": "SignoriniPosition", "time_step": 1e-300, "growth": 0.0}),
    "end time": setting(end_time="later"),
    "end time NaN": setting(end_time=float("nan")),
    "save": setting(save=10**12),
    "save of tables": setting(save={"a": 1}),
}


@pytest.mark.parametrize("name", CRAFTED)
def test_a_crafted_history_is_refused_in_one_line(name, good, tmp_path):
    file = tmp_path / "bad.nc"
    file.write_bytes(good.read_bytes())
    with h5py.File(file, "r+") as data:
        CRAFTED[name](data)
    refused("rerun", file, "--json")


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
    assert "case" in refused("predict", file, "--json")


@pytest.mark.parametrize(
    "table",
    [
        *(
            pytest.param(name, marks=pytest.mark.verify)
            for name in ("beam", "mesh", "section", "impact", "run", "hermite", "nonsense")
        ),
        "hermite.mesh",
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
        refused(*arguments, tmp_path / name)


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
            said = refused("predict", file)
        finally:
            os.seteuid(user)
    assert "permission denied" in said


@pytest.mark.parametrize("out", ["/proc/history.nc", "/dev/null/x/history.nc", "/dev/null", "/dev"])
def test_a_place_that_cannot_be_written_is_refused_before_the_run(out, case, monkeypatch):
    monkeypatch.setattr(hermite_fe.HermiteFE, "simulate", lambda *a, **k: pytest.fail("it ran"))
    assert "out:" in refused("simulate", case, "--out", out, "--json", "--overwrite")


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


@pytest.mark.parametrize(
    ("closed", "number"),
    [pytest.param("<&-", 0, marks=pytest.mark.verify), pytest.param(">&-", 1, marks=pytest.mark.verify), ("2>&-", 2)],
)
def test_a_closed_standard_stream_is_no_file_that_is_opened_later(closed, number, case):
    """As cron jobs and daemons are started: nothing is said there, and nothing of it lands anywhere else."""
    for file, code in ((case, 0), (case.with_name("missing.toml"), 2)):
        line = f'exec "$0" -c "$1" predict "$2" --json {closed}'
        done = subprocess.run(["sh", "-c", line, sys.executable, MAIN, str(file)], capture_output=True, text=True)
        assert done.returncode == code, done.stderr
        assert bool(done.stdout) == (code == 0 and number != 1)
        assert done.stderr.count("\n") == (code == 2 and number != 2)
