"""The house: imports run downwards and are declared, the paths never meet, comparison treats no path by its name."""

import ast
import os
import re
import subprocess
import sys
import tomllib
from functools import cache

from here import ROOT

PATHS = ("theory", "hermite_fe", "self_similar_fe", "exudyn_models")
PROGRAMS = ("thesis", "report", "predictor", "open_benchmark")
FLOOR = {"bent_beam": 0, "bent_beam.measure": 1, **dict.fromkeys(PATHS, 2), "comparison": 3, "benchmarks": 4}
FLOOR |= {"bent_beam_programs": 4, **{f"bent_beam_programs.{name}": 4 for name in PROGRAMS}}
PACKAGES = {room.partition(".")[0] for room in FLOOR}
NAMES_OF_PATHS = {"hermite", "self_similar", "exudyn"}
METHODS = {"HermiteFE", "SelfSimilarFE", "ExudynModel"}
ADAPTERS = "bent_beam_programs.open_benchmark.adapters"  # each runs in an environment of its own
LEAN = set("numpy scipy xarray pandas matplotlib numba exudyn h5py h5netcdf jinja2 dask".split())
LEAN |= {"multiprocessing", "asyncio", "PIL"}


@cache
def modules():
    """Dotted name → syntax tree of every module of the house."""
    found = {}
    for package in sorted(PACKAGES):
        for file in sorted((ROOT / package).rglob("*.py")):
            parts = file.relative_to(ROOT).with_suffix("").parts
            found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = ast.parse(file.read_text(), str(file))
    return found


@cache
def imported(module):
    """Dotted names that the import statements of a module name, wherever they stand."""
    found = set()
    for node in ast.walk(modules()[module]):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}:{node.lineno}: a relative import"
            found |= {f"{node.module}.{alias.name}" for alias in node.names}
    return found


def room(module):
    """The room that a module of the house belongs to: the longest name in :data:`FLOOR` that its own begins with."""
    return max((r for r in FLOOR if module == r or module.startswith(f"{r}.")), key=len)


def of_the_house(module):
    """Modules of the house that a module imports."""
    for name in imported(module):
        while name and name not in modules():
            name = name.rpartition(".")[0]
        if name:
            yield name


def test_imports_run_downwards_and_rooms_of_one_floor_never_import_one_another():
    """The paths to an answer are independent of each other, and so are the programs."""
    wrong = []
    for module in modules():
        here = room(module)
        for name in of_the_house(module):
            there = room(name)
            if there != here and FLOOR[there] >= FLOOR[here]:
                wrong.append(f"{module} imports {name}")
    assert not wrong


def test_no_modules_import_one_another_in_a_circle():
    """Wherever an import stands: on top, inside a function, or for type checkers only."""
    graph = {module: set(of_the_house(module)) - {module} for module in modules()}
    while ends := {module for module, needs in graph.items() if not needs & graph.keys()}:
        graph = {module: needs for module, needs in graph.items() if module not in ends}
    assert not graph, f"circles among {sorted(graph)}, or above them"


def distributions(requirements):
    return {re.split(r"[<>=\[ ]", requirement)[0].lower() for requirement in requirements}


def test_every_import_is_a_declared_requirement_and_only_extras_bring_more():
    shipped = [name for name in modules() if not name.startswith(("benchmarks", ADAPTERS))]
    third = {name.partition(".")[0] for module in shipped for name in imported(module)} - PACKAGES
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    core = distributions(project["dependencies"]) | {"pydantic_core"}  # comes with pydantic, which documents it
    extras = [distributions(project["optional-dependencies"][extra]) for extra in ("report", "cluster")]
    more = {"pillow" if name == "PIL" else name for name in third - set(sys.stdlib_module_names) - core}
    assert more == set().union(*extras)


def test_no_path_is_compared_by_name_above_the_paths():
    wrong = []
    for module, tree in modules().items():
        if FLOOR[room(module)] < 3 or module.startswith(ADAPTERS):
            continue
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "isinstance":
                wrong += [f"{module}:{node.lineno}" for n in ast.walk(node.args[1]) if getattr(n, "id", "") in METHODS]
            elif isinstance(node, ast.Compare | ast.match_case):
                part = node if isinstance(node, ast.Compare) else node.pattern
                names = {n.value for n in ast.walk(part) if isinstance(n, ast.Constant)}
                wrong += [f"{module}: {ast.unparse(part)}"] if names & NAMES_OF_PATHS else []
    assert not wrong


def test_nothing_reads_the_folder_that_sessions_share():
    kinds = {".py", ".toml", ".md", ".j2", ".js", ".css", ".html", ".ipynb", ".yml", ".json", ".lock"}
    files = [f for d in (*PACKAGES, "tests", "docs", "cases") for f in (ROOT / d).rglob("*") if f.suffix in kinds]
    assert not [f for f in (*files, ROOT / "Makefile") if "../" + "shared" in f.read_text(errors="replace")]


ONE_AFTER_ANOTHER = """
import os, sys, tempfile
from comparison.command_line.app import run

def loads_no_more_than(allowed, *words):
    assert run([*words, "--json"]) == 0
    more = HEAVY & {m.partition(".")[0] for m in sys.modules} - allowed
    assert not more, (words, more)

import numpy as np
tau = np.linspace(0, 0.1, 300)
file = os.path.join(tempfile.mkdtemp(), "result.npz")
np.savez(file, outcome="completed", problem="point-2", metadata="{}", tau=tau, J=3.2 * np.sqrt(tau), Jm=0 * tau)
allowed = {"numpy", "scipy"}
loads_no_more_than(allowed, "score", file)
allowed.add("theory")
import theory.prediction
loads_no_more_than(allowed, "theory", "--kappa-over-nu", "0.5", "--alpha", "4")
loads_no_more_than(allowed, "predict", "cases/ruler.toml", "--theory-only")
"""


def test_a_command_loads_only_what_it_needs():
    """Each of these may load what those before it may, and more."""
    code, here = f"HEAVY = {LEAN | set(PATHS)!r}" + ONE_AFTER_ANOTHER, os.environ | {"PYTHONPATH": str(ROOT)}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, env=here)
    assert done.returncode == 0, done.stderr[-2000:]
