"""What a release promises: declared requirements are those that are imported, and the workflows are well formed."""

import ast
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
EXTRAS = PROJECT["optional-dependencies"]
OPTIONAL = {
    "report": {"plotly", "PIL", "markupsafe"},
    "cluster": {"distributed"},
}
ADAPTERS = ROOT / "open_benchmark" / "adapters"  # each runs in an environment of its own


def names(requirements):
    return {re.split(r"[<>=\[ ]", requirement)[0].lower() for requirement in requirements}


def imported(folder):
    for file in (ROOT / folder).rglob("*.py"):
        if ADAPTERS in file.parents:
            continue
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.Import):
                yield from (alias.name.partition(".")[0] for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                yield node.module.partition(".")[0]


def test_every_import_is_a_declared_requirement():
    packages = [p.parent.name for p in ROOT.glob("*/__init__.py") if p.parent.name not in ("benchmarks", "tests")]
    third = {name for package in packages for name in imported(package)} - set(sys.stdlib_module_names) - set(packages)
    core = names(PROJECT["dependencies"]) | {"pydantic_core"}  # comes with pydantic, which documents it
    assert third - core == set().union(*OPTIONAL.values())
    distributions = {"PIL": "pillow"}
    for extra, modules in OPTIONAL.items():
        assert {distributions.get(m, m) for m in modules} == names(EXTRAS[extra])


def test_a_report_without_its_extra_says_what_to_install(tmp_path):
    code = """
import sys
sys.modules["plotly"] = None  # as if it were not installed
from comparison.command_line.app import run
sys.exit(run(["report", "--out", "report"]))
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 2 and done.stdout == ""
    assert "plotly" in done.stderr and "bent-beam-impact[report]" in done.stderr and done.stderr.count("\n") == 1


def test_the_version_is_stated_once():
    files = [ROOT / "CITATION.cff", ROOT / "README.md", *ROOT.glob("*/__init__.py")]
    assert not [file for file in files if PROJECT["version"] in file.read_text()]


def test_the_workflows_are_well_formed_and_test_every_declared_python():
    yaml = pytest.importorskip("yaml")
    found = {file.stem: yaml.safe_load(file.read_text()) for file in (ROOT / ".github" / "workflows").glob("*.yml")}
    assert found.keys() == {"test", "release"}
    for workflow in found.values():
        assert workflow[True]  # YAML reads the key `on` as a truth value
        for job in workflow["jobs"].values():
            assert job["runs-on"] and all(step.keys() & {"uses", "run"} for step in job["steps"])
    matrix = found["test"]["jobs"]["test"]["strategy"]["matrix"]
    declared = [c.rpartition(":: ")[2] for c in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", c)]
    assert matrix["python"] == declared
    (install,) = (s["run"] for s in found["test"]["jobs"]["test"]["steps"] if "pip install" in s.get("run", ""))
    assert set(re.search(r"\.\[(.*)\]", install)[1].split(",")) <= EXTRAS.keys()
    publish = found["release"]["jobs"]["publish"]
    assert publish["permissions"] == {"id-token": "write"} and publish["needs"] == "build"
    site = yaml.safe_load((ROOT / ".readthedocs.yaml").read_text())
    assert all((ROOT / step["requirements"]).exists() for step in site["python"]["install"] if "requirements" in step)
