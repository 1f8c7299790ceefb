"""What a release promises: the built package works away from the checkout, set-up and extras say what they lack."""

import json
import os
import re
import shutil
import subprocess
import sys
import tomllib
import zipfile

import pytest
from called import CASE, refused
from here import ROOT

PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
PACKAGES = sorted({p.parent.name for p in ROOT.glob("*/__init__.py")} - {"benchmarks", "tests"})


def test_set_up_with_an_old_python_names_the_one_it_needs_and_leaves_nothing(tmp_path):
    old = tmp_path / "old"
    old.write_text('#!/bin/sh\ncase "$*" in *--version*) echo Python 3.10.12;; *version_info*) exit 1;; esac\n')
    old.chmod(0o755)
    for name in ("pyproject.toml", "requirements.lock"):
        (tmp_path / name).touch()
    line = ["make", "-f", str(ROOT / "Makefile"), f"PYTHON={old}", ".venv/.installed"]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2 and "needs Python 3.11" in done.stderr and not (tmp_path / ".venv").exists()


def test_a_report_without_its_extra_says_what_to_install(tmp_path, monkeypatch):
    page = "bent_beam_programs.report.page"
    for name in [name for name in sys.modules if name == page]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "PIL", None)  # as if it were not installed
    said = refused("report", "--out", tmp_path / "report")
    assert "PIL" in said and "bent-beam-impact[report]" in said


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The wheel of a copy of the sources, unpacked where nothing else is."""
    folder = tmp_path_factory.mktemp("package")
    (source := folder / "source").mkdir()
    for name in PACKAGES:
        shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__", "*.part"))
    for name in ("pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / name, source / name)
    build = "from setuptools.build_meta import build_wheel; print(build_wheel('.'))"
    done = subprocess.run([sys.executable, "-c", build], cwd=source, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    (wheel,) = source.glob("*.whl")
    with zipfile.ZipFile(wheel) as packed:
        packed.extractall(folder / "site")
    return folder / "site"


def test_every_file_of_the_packages_and_the_example_cases_are_in_the_wheel_under_seven_names(installed):
    files = [f for name in PACKAGES for f in (ROOT / name).rglob("[!.]*") if "__pycache__" not in f.parts]
    assert not [f for f in files if f.is_file() and not (installed / f.relative_to(ROOT)).is_file()]
    names = {p.name for p in installed.iterdir() if not p.name.endswith(".dist-info")}
    assert names == {*PACKAGES} and len(names) == 7
    cases = {p.relative_to(ROOT / "cases") for p in (ROOT / "cases").rglob("*.toml")}
    assert cases and not [case for case in cases if not (installed / "bent_beam" / "examples" / case).is_file()]


COMMANDS = {
    "theory": "theory --kappa-over-nu 0.5 --json",
    "predict": "predict case.toml --theory-only --json",
    "simulate": "simulate case.toml --set hermite.refine=0.25 --error-bars drift --out run.nc --json",
    "rerun": "rerun run.nc --json",
    "settings": "settings",
    "new": "new beam.toml",
    "problem": "problem leading-0.5 --out problem.toml",
    "predictor": "predictor --out page.html",
    "gallery": "gallery --list --json",
}


@pytest.mark.verify  # the kernels are compiled anew
def test_every_command_answers_away_from_the_checkout(installed, tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    # the place of the wheel first and nothing of the checkout: -P keeps the current folder out, as the script would
    main = f"""
import json, shlex, sys
sys.path[:] = [{str(installed)!r}] + [p for p in sys.path if p and p != {str(ROOT)!r}]
sys.meta_path[:] = [f for f in sys.meta_path if "editable" not in repr(f).lower()]
import bent_beam, comparison
assert bent_beam.__file__.startswith({str(installed)!r}) and comparison.__file__.startswith({str(installed)!r})
from importlib.metadata import entry_points
found = {{p.name for p in entry_points(group="bentbeam.methods")}}
assert {{"hermite", "self_similar", "exudyn"}} <= found, found
from comparison.command_line.app import run
for name, words in {COMMANDS!r}.items():
    print("==", name, flush=True)
    assert run(shlex.split(words)) == 0, name
"""
    env = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | {"BENTBEAM_STORE": str(tmp_path / "s")}
    done = subprocess.run([sys.executable, "-P", "-c", main], cwd=tmp_path, capture_output=True, text=True, env=env)
    assert done.returncode == 0, done.stdout[-500:] + done.stderr[-2000:]
    answers = {name.strip(): rest for name, _, rest in (p.partition("\n") for p in done.stdout.split("== ")[1:])}
    assert json.loads(answers["theory"])["lambda0"] == pytest.approx(1.019, abs=1e-3)
    assert json.loads(answers["rerun"])["identical"]
    assert (tmp_path / "page.html").stat().st_size > 10_000


def test_the_version_is_stated_once():
    files = [ROOT / "CITATION.cff", ROOT / "README.md", *ROOT.glob("*/__init__.py")]
    assert not [file for file in files if PROJECT["version"] in file.read_text()]


def test_the_workflow_tests_every_declared_python_with_extras_that_exist():
    yaml = pytest.importorskip("yaml")
    job = yaml.safe_load((ROOT / ".github" / "workflows" / "test.yml").read_text())["jobs"]["test"]
    declared = [c.rpartition(":: ")[2] for c in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", c)]
    assert job["strategy"]["matrix"]["python"] == declared
    (install,) = (step["run"] for step in job["steps"] if "pip install" in step.get("run", ""))
    assert set(re.search(r"\.\[(.*)\]", install)[1].split(",")) <= PROJECT["optional-dependencies"].keys()
