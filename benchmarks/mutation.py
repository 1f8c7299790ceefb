"""A sample of small faults put into the source, one at a time: which does the test suite notice?

    python -m benchmarks.mutation draw --out FOLDER [--seed 21] [--number 500]
    python -m benchmarks.mutation run --out FOLDER
    python -m benchmarks.mutation tell --out FOLDER

``draw`` takes places in the source at random, each once, and one fault of Cosmic Ray's operators at each: another
operator, comparison or number, a condition turned round, a loop that does not run, a decorator left out. ``run`` tries
each fault in a copy of the source, first against the tests of its own module, then against wider ones, and stops at
the first test that fails; ended and started again, it goes on. ``tell`` prints what is caught and what is not.

Left out are faults that no run could show (within annotations) and those that only raise ``TypeError`` (bits of a
float). Needs the extra ``mutation``.
"""

from __future__ import annotations

import argparse
import ast
import collections
import compileall
import difflib
import fnmatch
import importlib
import json
import os
import random
import resource
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
COPIED = ("bent_beam", "theory", "hermite_fe", "self_similar_fe", "exudyn_models", "comparison", "open_benchmark",
          "tests", "cases", "docs", "benchmarks", "pyproject.toml", "README.md", "CITATION.cff")  # fmt: skip
KERNELS = "hermite_fe/kernels/"

# Sources that faults are put into, and the tests of their own module. The first pattern that fits a source counts.
THEORY, HERMITE = "tests/theory/test_theory_", "tests/hermite_fe/test_hermite_"
OWN: dict[str, tuple[str, ...]] = {
    "theory/ladder/*.py": (THEORY + "ladder.py",),
    "theory/contact.py": (THEORY + "contact.py",),
    "theory/damped_zone.py": (THEORY + "damped_zone.py",),
    "theory/fields.py": (THEORY + "fields.py",),
    "theory/kernel.py": (THEORY + "kernel.py",),
    "theory/moment.py": (THEORY + "moment.py",),
    "theory/phi.py": (THEORY + "phi.py",),
    "theory/prediction.py": (THEORY + "prediction.py",),
    "theory/second_order.py": (THEORY + "second_order.py",),
    "theory/sideways.py": (THEORY + "sideways.py",),
    "theory/similarity.py": (THEORY + "similarity.py",),
    "theory/stopped_beam.py": (THEORY + "stopped_beam.py",),
    "theory/validity.py": (THEORY + "prediction.py", THEORY + "axial.py"),
    "theory/worked_examples.py": (THEORY + "worked_examples.py",),
    "theory/*.py": (THEORY + "kernel.py", THEORY + "similarity.py", THEORY + "phi.py"),
    "hermite_fe/beam.py": (HERMITE + "beam.py",),
    "hermite_fe/contacts/*.py": (HERMITE + "contacts.py",),
    "hermite_fe/far_fields/*.py": (HERMITE + "far_field.py",),
    "hermite_fe/integrators/*.py": (HERMITE + "integrators.py",),
    "hermite_fe/masses/*.py": (HERMITE + "masses.py",),
    KERNELS + "*.py": tuple(HERMITE + f"{name}.py" for name in ("pivoting", "integrators", "energy", "steps")),
    "hermite_fe/*.py": (HERMITE + "simulate.py", HERMITE + "model.py"),
    "comparison/estimators.py": ("tests/comparison/test_estimators.py",),
    "comparison/error_bars.py": ("tests/comparison/test_error_bars.py",),
    "comparison/reduction.py": ("tests/comparison/test_estimators.py",),
    "bent_beam/cases.py": ("tests/bent_beam/test_cases.py", "tests/bent_beam/test_descriptions.py"),
    "bent_beam/description.py": ("tests/bent_beam/test_descriptions.py",),
    "bent_beam/section.py": ("tests/bent_beam/test_descriptions.py", "tests/bent_beam/test_cases.py"),
    "bent_beam/impact.py": ("tests/bent_beam/test_impact.py",),
}
WIDER = {
    "theory": (THEORY + "axial.py", THEORY + "second_order.py", THEORY + "prediction.py", "tests/theory"),
    "hermite_fe": ("tests/hermite_fe",),
    "comparison": ("tests/comparison/test_error_bars.py", "tests/comparison/test_match.py"),
    "bent_beam": ("tests/bent_beam", "tests/theory"),
}
WIDEST = (
    "tests/reliability/test_similarity.py",
    "tests/reliability/test_guard_rails.py",
    "tests/reliability/test_fuzz.py",
    "tests/comparison/test_match.py",
)
# interpreted: kernels as plain Python, where they would have to be compiled anew for every fault
CHEAP, DEAR = ("own", "interpreted", "long", "wider"), ("compiled", "widest", "verify")
STAGES = CHEAP + DEAR
BLOCK = 250

NOT_TRIED = ("RShift", "LShift", "BitOr", "BitAnd", "BitXor")  # in place of arithmetic
TOO_LONG = 1e6  # s, noted for a test that is not worth its time where kernels are plain Python
CPU_SECONDS = 240  # of a stage, at most: a fault that makes a loop run for ever is caught
HARNESS = 70  # exit status of a child that could not run pytest or tell what it said
DIED = "died"
WALL_SECONDS = 1500  # the run may be in the background, with little of a core


# --- draw ------------------------------------------------------------------------------------------------------------


def sources() -> list[str]:
    files = (str(p.relative_to(ROOT)) for top in ("theory", "hermite_fe", "comparison", "bent_beam")
             for p in sorted((ROOT / top).rglob("*.py")))  # fmt: skip
    return [f for f in files if any(fnmatch.fnmatch(f, pattern) for pattern in OWN)]


class WithoutAnnotations(ast.NodeTransformer):
    """A syntax tree without what no run looks at."""

    def visit_AnnAssign(self, node: ast.AnnAssign) -> ast.AST:
        node.annotation = ast.Name("object", ast.Load())
        return self.generic_visit(node)

    def visit_arg(self, node: ast.arg) -> ast.AST:
        node.annotation = None
        return node

    def visit_FunctionDef(self, node: ast.FunctionDef) -> ast.AST:
        node.returns = None
        return self.generic_visit(node)


def meaning(source: str) -> str:
    return ast.dump(WithoutAnnotations().visit(ast.parse(source)))


def tried(operator: str) -> bool:
    """Whether an operator of Cosmic Ray makes faults worth a test."""
    kind, *swap = operator.split("/")[1].split("_")
    if kind == "ReplaceBinaryOperator":
        return swap[0] in NOT_TRIED or swap[1] not in NOT_TRIED
    return True


def draw(out: Path, seed: int, number: int) -> None:
    """Write ``mutants.jsonl``: the source, the operator, the line, the changed file and the difference of each."""
    from cosmic_ray.ast import ast_nodes, get_ast
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator, operator_names

    places: dict[tuple[str, tuple[int, int]], list[tuple[str, int]]] = collections.defaultdict(list)
    for file in sources():
        tree = get_ast((ROOT / file).read_text(encoding="utf-8"))
        for name in filter(tried, operator_names()):
            operator = get_operator(name)
            if operator.arguments():
                continue
            positions = (start for node in ast_nodes(tree) for start, _ in operator().mutation_positions(node))
            for occurrence, start in enumerate(positions):
                places[file, start].append((name, occurrence))
    numbers = random.Random(seed)
    order = sorted(places)
    numbers.shuffle(order)
    drawn: list[dict[str, Any]] = []
    for file, start in order:
        name, occurrence = numbers.choice(places[file, start])
        before = (ROOT / file).read_text(encoding="utf-8")
        after = mutate_code(before, get_operator(name)(), occurrence)
        try:
            if after is None or meaning(before) == meaning(after):
                continue
        except SyntaxError:
            continue
        lines = difflib.unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0)
        changes = [line for line in lines if line[0] in "+-" and line[:3] not in ("+++", "---")]
        drawn.append({"number": len(drawn), "file": file, "line": start[0], "operator": name.split("/")[1],
                      "change": changes, "source": after})  # fmt: skip
        if len(drawn) == number:
            break
    out.mkdir(parents=True, exist_ok=True)
    (out / "mutants.jsonl").write_text("".join(json.dumps(m) + "\n" for m in drawn))
    print(f"{len(drawn)} of {len(places)} places in {len({f for f, _ in places})} files, seed {seed}")


# --- run -------------------------------------------------------------------------------------------------------------


class Recorder:
    """What pytest does in a child: the shortest tests of each file first, the first failure told."""

    def __init__(
        self, seconds: dict[str, float], files: tuple[str, ...], span: tuple[float, float], limit: float
    ) -> None:
        self.seconds, self.files, self.limit = seconds, files, limit
        self.shortest, self.longest = span if seconds else (0.0, TOO_LONG)
        self.durations: dict[str, float] = {}
        self.failed: str | None = None

    def place(self, nodeid: str) -> tuple[int, float]:
        own = next((i for i, f in enumerate(self.files) if nodeid.startswith(f)), len(self.files))
        return own, self.seconds.get(nodeid, 0.0)

    def pytest_collection(self) -> None:
        """A failure is enough: Hypothesis need not look for a simpler one."""
        from hypothesis import Phase, settings

        settings.register_profile("mutants", settings.default, phases=[Phase.explicit, Phase.generate])
        settings.load_profile("mutants")

    def pytest_collection_modifyitems(self, items: list[Any]) -> None:
        items[:] = [item for item in items if self.shortest <= self.seconds.get(item.nodeid, 0.0) < self.longest]
        items.sort(key=lambda item: self.place(item.nodeid))

    def pytest_internalerror(self, excinfo: Any) -> None:
        if isinstance(excinfo.value, SystemExit):  # to pytest an error of its own, but a module did it at its import
            self.failed = self.failed or "left at an import"

    def pytest_runtest_setup(self) -> None:
        if self.limit:
            signal.signal(signal.SIGVTALRM, too_long)
            signal.setitimer(signal.ITIMER_VIRTUAL, self.limit)

    def pytest_runtest_teardown(self) -> None:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)

    def pytest_runtest_logreport(self, report: Any) -> None:
        self.durations[report.nodeid] = self.durations.get(report.nodeid, 0.0) + report.duration
        if report.failed and "longer than its limit" in str(report.longrepr) and not self.seconds:
            self.durations[report.nodeid] = TOO_LONG
        elif report.failed and self.failed is None:
            self.failed = report.nodeid


def too_long(*_: Any) -> None:
    raise TimeoutError("longer than its limit")


def warm_up() -> None:
    """What every child needs and no fault is put into is imported once."""
    for name in ("h5netcdf", "hypothesis", "matplotlib", "mpmath", "numba.core.typing", "pydantic", "pytest", "typer",
                 "scipy.integrate", "scipy.interpolate", "scipy.linalg", "scipy.optimize", "scipy.sparse.linalg",
                 "scipy.special", "xarray", "_pytest.assertion.rewrite", "numba.extending"):  # fmt: skip
        importlib.import_module(name)


def tests_of(file: str, stage: str) -> tuple[str, ...]:
    own = next(tests for pattern, tests in OWN.items() if fnmatch.fnmatch(file, pattern))
    wider = WIDER[file.partition("/")[0]]
    kernel = file.startswith(KERNELS)
    if stage in (("own", "long", "wider") if kernel else ("interpreted", "compiled")):
        return ()
    return {"wider": wider, "compiled": (*own, *wider), "widest": WIDEST, "verify": (*own, *wider)}.get(stage, own)


def in_child(
    tree: Path, cache: Path, files: tuple[str, ...], stage: str, seconds: dict[str, float], *more: str
) -> dict[str, Any]:
    """Run pytest on ``files`` in a forked process; what it told, or how it died. Without ``seconds`` nothing is at
    fault: all tests are run, and what is compiled is kept."""
    answer = tree.parent / "answer.json"
    answer.unlink(missing_ok=True)
    began = time.monotonic()
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        try:
            import numba
            import pytest

            sys.dont_write_bytecode = bool(seconds)
            os.environ["PYTHONDONTWRITEBYTECODE"] = "1" if seconds else ""
            os.environ["PYTEST_DISABLE_PLUGIN_AUTOLOAD"] = "1"
            numba.core.config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"] = str(cache)
            numba.core.config.DISABLE_JIT = int(stage == "interpreted")
            os.environ["NUMBA_DISABLE_JIT"] = str(numba.core.config.DISABLE_JIT)
            null = os.open(tree.parent / "output.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
            os.dup2(null, 1), os.dup2(null, 2)
            os.chdir(tree)
            resource.setrlimit(resource.RLIMIT_CPU, (CPU_SECONDS if seconds else 1200, resource.RLIM_INFINITY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            limit = (20.0 if seconds else 6.0) if stage == "interpreted" else 0.0
            span = {"own": (0.0, 2.0), "long": (2.0, TOO_LONG), "interpreted": (0.0, 6.0)}.get(stage, (0.0, TOO_LONG))
            recorder = Recorder(seconds, files, span, limit)
            marks = "verify" if stage == "verify" else "not verify"
            options = ["-m", marks, "-p", "no:cacheprovider", *more]
            options += ["-k", "not subnormal and not care"] if stage == "interpreted" else []
            options += ["--ignore=tests/hermite_fe/test_hermite_kernels.py"]  # of the cache on disk, not of kernels
            code = pytest.main([*files, *options, *(["-x"] if seconds else [])], [recorder])
            answer.write_text(json.dumps([int(code), recorder.failed, recorder.durations]))
            os._exit(0)
        except BaseException:
            traceback.print_exc()
        finally:
            os._exit(HARNESS)
    status, ended = 0, 0
    while not ended and time.monotonic() - began < WALL_SECONDS:
        ended, status, spent = os.wait4(child, os.WNOHANG)
        time.sleep(0.05)
    if not ended:
        os.killpg(child, signal.SIGKILL)
        _, status, spent = os.wait4(child, 0)
    used = round(spent.ru_utime + spent.ru_stime, 1)
    if not answer.exists():
        return {"code": None, "by": how_it_ended(status), "seconds": used}
    code, failed, durations = json.loads(answer.read_text())
    return {"code": code, "by": failed, "seconds": used, "durations": durations}


def how_it_ended(status: int) -> str:
    """Of a child without an answer: a fault may crash it, leave it without memory or time, or make it leave early."""
    if os.WIFSIGNALED(status):
        return f"ended by signal {os.WTERMSIG(status)}"
    return DIED if os.WEXITSTATUS(status) == HARNESS else f"left with {os.WEXITSTATUS(status)}"


def caught(answer: dict[str, Any]) -> bool:
    """Whether the tests notice a fault: one fails, a module cannot be imported (2), or the fault ends the process.

    Raises ``RuntimeError`` where it was not tried: pytest fails by itself (3), has no such test file (4), or this
    program does.
    """
    if (answer["code"] in (3, 4) and answer["by"] is None) or answer["by"] == DIED:
        raise RuntimeError(f"the fault was not tried (pytest's exit code {answer['code']}); see output.txt")
    return answer["code"] not in (0, 5)  # 5: no test chosen


def run(out: Path) -> None:
    """Append to ``results.jsonl``, a line a fault and stage, until something has caught it."""
    mutants = [json.loads(line) for line in (out / "mutants.jsonl").read_text().splitlines()]
    tree, results = out / "tree", out / "results.jsonl"
    done: dict[tuple[int, str], bool] = {}
    if results.exists():
        for line in map(json.loads, results.read_text().splitlines()):
            done[line["number"], line["stage"]] = line["caught"]
    shutil.rmtree(tree, ignore_errors=True)
    tree.mkdir()
    for name in COPIED:
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy2
        copy(ROOT / name, tree / name)
    sys.path[:] = [str(tree), *(p for p in sys.path if Path(p or ".").resolve() != ROOT)]
    os.environ["PYTHONPATH"] = str(tree)
    warm_up()
    compileall.compile_dir(tree, quiet=2)
    in_child(tree, out / "cache", ("tests",), "own", {}, "--collect-only")  # Pytest's own compiled tests
    timed = out / "durations.json"
    durations: dict[str, dict[str, float]] = json.loads(timed.read_text()) if timed.exists() else {}
    for mutant, stage in in_turn(mutants):
        number, file = mutant["number"], mutant["file"]
        files = tests_of(file, stage)
        if not files or (number, stage) in done or any(done.get((number, before)) for before in STAGES):
            continue
        key = " ".join((stage.replace("long", "own"), *files))
        if key not in durations:
            whole = in_child(tree, out / "cache", files, stage, {})
            if whole["code"] not in (0, 1, 5):
                raise SystemExit(f"{key}: without a fault, code {whole['code']}, {whole['by']}; see output.txt")
            if whole["by"] is not None:
                shutil.copy2(out / "output.txt", out / "failed_without_a_fault.txt")
                print(f"{key}: fails without a fault: {whole['by']}", flush=True)
            durations[key] = whole.get("durations", {"none": 0.0})
            timed.write_text(json.dumps(durations))
        with tempfile.TemporaryDirectory() as fresh:
            (tree / file).write_text(mutant["source"], encoding="utf-8")
            cache = Path(fresh) if file.startswith(KERNELS) else out / "cache"
            answer = in_child(tree, cache, files, stage, durations[key] or {"none": 0.0})
            shutil.copy2(ROOT / file, tree / file)  # its time too: what Python compiled of it before is good again
        done[number, stage] = noticed = caught(answer)
        row = {"number": number, "stage": stage, "caught": noticed, "by": answer["by"]}
        with results.open("a") as lines:
            lines.write(json.dumps(row | {"cpu_seconds": answer["seconds"]}) + "\n")


def in_turn(mutants: list[dict[str, Any]]) -> Iterator[tuple[dict[str, Any], str]]:
    """Block by block through the cheap stages, so that a run cut short has finished with a sample of its own; the
    dear stages, compiled kernels among them, for what is then left of all."""
    for first in range(0, len(mutants), BLOCK):
        for stage in CHEAP:
            yield from ((mutant, stage) for mutant in mutants[first : first + BLOCK])
    for stage in DEAR:
        yield from ((mutant, stage) for mutant in mutants)


# --- tell ------------------------------------------------------------------------------------------------------------


def tell(out: Path) -> None:
    mutants = {m["number"]: m for m in map(json.loads, (out / "mutants.jsonl").read_text().splitlines())}
    rows = [json.loads(line) for line in (out / "results.jsonl").read_text().splitlines()]
    found = {r["number"] for r in rows if r["caught"]}
    seen = {r["number"] for r in rows}
    for number in sorted(seen - found, key=lambda n: (mutants[n]["file"], mutants[n]["line"])):
        mutant = mutants[number]
        print(f"{number:4d} {mutant['file']}:{mutant['line']} {mutant['operator']}")
        print("\n".join(f"       {line}" for line in mutant["change"]))
    by_part: dict[str, list[int]] = collections.defaultdict(lambda: [0, 0])
    for number in seen:
        part = by_part[str(Path(mutants[number]["file"]).parent)]
        part[0] += number in found
        part[1] += 1
    for name, (good, all_of_it) in sorted(by_part.items()):
        print(f"{name:30s} {good:4d} of {all_of_it:4d}")
    print(f"{'all':30s} {len(found):4d} of {len(seen):4d} ({len(mutants)} drawn)")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("what", choices=["draw", "run", "tell"])
    parser.add_argument("--out", type=Path, required=True, help="a folder outside the source")
    parser.add_argument("--seed", type=int, default=21)
    parser.add_argument("--number", type=int, default=500)
    given = parser.parse_args()
    out = given.out.resolve()
    if given.what == "draw":
        draw(out, given.seed, given.number)
    else:
        {"run": run, "tell": tell}[given.what](out)


if __name__ == "__main__":
    main()
