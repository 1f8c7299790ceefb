"""Compiled kernels on disk: an upgraded package must never run yesterday's code."""

import errno
import shutil
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from numba.core.caching import CompileResultCacheImpl
from numba.core.typed_passes import NativeLowering
from numba.core.types.functions import BaseFunction

from hermite_fe.kernels import jit, lowering


def test_kernels_run_where_nothing_can_be_written(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(CompileResultCacheImpl, "_locator_classes", [])

    @jit.compiled
    def more(x: float) -> float:
        return x + 1.0

    assert more(2.0) == 3.0


TWICE = """
import sys
sys.path.insert(0, {folder!r})
{before}
from kernels.outer import outer
print(outer(5.0))
"""


@pytest.fixture
def kernels(tmp_path: Path) -> Path:
    """A package of two kernels, one of which calls the other, compiled and kept once."""
    package = tmp_path / "kernels"
    package.mkdir()
    shutil.copy(Path(jit.__file__), package / "jit.py")
    (package / "__init__.py").write_text("")
    (package / "inner.py").write_text(
        "from kernels.jit import compiled\n\n@compiled\ndef inner(x):\n    return x + 1.0\n"
    )
    (package / "outer.py").write_text(
        "from kernels.inner import inner\nfrom kernels.jit import compiled\n\n"
        "@compiled\ndef outer(x):\n    return 2.0 * inner(x)\n"
    )
    return package


def answered(kernels: Path, before: str = "") -> str:
    program = TWICE.format(folder=str(kernels.parent), before=before)
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    return done.stdout.strip() or done.stderr


def test_kernels_run_while_the_disk_is_full(kernels: Path):
    full = "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))"
    assert answered(kernels, full) == "12.0"
    assert not list(kernels.rglob("*.nbc"))


@pytest.mark.verify
@pytest.mark.parametrize("kind", ["nbi", "nbc"])
def test_kernels_on_disk_that_lost_their_end_are_compiled_again(kind: str, kernels: Path):
    assert answered(kernels) == "12.0"
    files = list(kernels.rglob(f"*.{kind}"))
    assert files
    for left in (0.0, 0.5):
        for file in files:
            file.write_bytes(file.read_bytes()[: int(left * file.stat().st_size)])
        assert answered(kernels) == "12.0"


class Full(jit.KernelFiles):
    """On a disk that has room for an index and for nothing else."""

    def _save_data(self, name: str, data: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")


def test_code_of_the_version_before_is_not_read_under_an_index_of_today(tmp_path: Path):
    jit.KernelFiles(str(tmp_path), "kernel", "old").save("key", "old code")
    with pytest.raises(OSError, match="No space"):
        Full(str(tmp_path), "kernel", "new").save("key", "new code")
    today = jit.KernelFiles(str(tmp_path), "kernel", "new")
    assert today.load("key") is None
    today.save("key", "new code")
    assert today.load("key") == "new code"


def test_code_for_other_types_is_not_read_under_an_index_of_another_process(tmp_path: Path):
    """Two processes start with no index, and each calls its first kernel number 1."""
    one, other = (jit.KernelFiles(str(tmp_path), "kernel", "stamp") for _ in range(2))
    one.save("float", "for floats")
    index = Path(one._index_path).read_bytes()
    Path(one._index_path).unlink()
    other.save("int", "for ints")
    Path(one._index_path).write_bytes(index)
    assert one.load("float") is None


TORN_AND_FULL = """
import numba.core.caching as caching
def full(self, path):
    raise OSError(28, "No space left on device")
caching.IndexDataCacheFile._open_for_write = full
"""
NO_FOLDER = """
import sys
import numba.core.caching as caching
def gone(self):
    if sys._getframe(1).f_code.co_name == "_save_overload":
        raise PermissionError(13, "Permission denied")
caching._CacheLocator.ensure_cache_path = gone
"""
CANNOT_REBUILD = """
import numba.core.caching as caching
def rebuild(self, context, payload):
    raise ValueError("what was read is no kernel")
caching.CompileResultCacheImpl.rebuild = rebuild
"""


@pytest.mark.verify
@pytest.mark.parametrize("before", [TORN_AND_FULL, NO_FOLDER, CANNOT_REBUILD], ids=["full", "no-folder", "rebuild"])
def test_what_a_cache_cannot_do_is_done_without(before: str, kernels: Path):
    assert answered(kernels) == "12.0"
    if before is not CANNOT_REBUILD:
        for file in kernels.rglob("*.nbi"):
            file.write_bytes(file.read_bytes()[:-20])
    assert answered(kernels, before) == "12.0"


def test_types_are_kept_and_variables_are_not_with_the_numba_that_is_locked():
    assert hasattr(BaseFunction.get_call_type, "__wrapped__")
    assert lowering.plain(NativeLowering) is not NativeLowering


OTHER_NUMBA = """
from numba.core.types.functions import BaseFunction
found = BaseFunction.get_call_type
def get_call_type(self, context, args, kws, more=None):
    return found(self, context, args, kws)
BaseFunction.get_call_type = get_call_type
"""
OTHER_LOWERING = """
from numba.core.lowering import Lower
kept = Lower.storevar
def storevar(self, value, name, argidx=None, more=None):
    return kept(self, value, name, argidx)
Lower.storevar = storevar
"""
NO_CONFIG = """
import sys
import numba
sys.modules["numba.core.targetconfig"] = None  # an import of it fails
"""
LEFT_ALONE = """
import atexit
from numba.core.types.functions import BaseFunction
here = BaseFunction.get_call_type
atexit.register(lambda: print(BaseFunction.get_call_type is here))
"""


@pytest.mark.parametrize("before", [OTHER_NUMBA, NO_CONFIG], ids=["parameters", "import"])
def test_kernels_answer_where_numba_is_built_otherwise(before: str, kernels: Path):
    assert answered(kernels, before + LEFT_ALONE).split() == ["12.0", "True"]


def test_kernels_answer_where_numba_keeps_variables_otherwise(kernels: Path):
    outer = kernels / "outer.py"
    outer.write_text(outer.read_text().replace("compiled", "compiled_in_place"))
    told = "\nimport atexit\nfrom numba.core.typed_passes import NativeLowering as n\n"
    told += "from hermite_fe.kernels.lowering import plain\natexit.register(lambda: print(plain(n) is n))\n"
    assert answered(kernels, OTHER_LOWERING + told).split() == ["12.0", "True"]


class Pair(NamedTuple):
    x: np.ndarray
    y: np.ndarray
    factor: float


def add_in(pair: Pair, sums: np.ndarray, k: int) -> float:
    sums[k] += pair.factor * pair.y[k]
    return sums[k]


def walk(one: Pair, other: Pair, sums: np.ndarray) -> float:
    """Variables that are assigned once, in a branch, in a loop and used after it, carried over, and exchanged."""
    total, before, largest = 0.0, -1.0, one.factor
    for k in range(one.x.size):
        step = one.x[k]
        if step > 0.0:
            share = step * other.factor
            if share > largest:
                largest = share
                continue
            total += share * one.y[k]
        elif k > 0 and before > 0.0:
            total -= before
        one, other = other, one
        before = added(other, sums, k) - step
    chosen = one if total > 0.0 else other
    return total + largest + before + added(chosen, sums, 0)


added = jit.compiled_in_place(add_in)


def test_a_kernel_computes_what_its_python_does():
    """Whatever is left out on the way: every variable has the value that it was given last."""
    random = np.random.default_rng(5)
    x, y, u, v = random.normal(size=(4, 40))
    results = []
    for run in (jit.compiled_in_place(walk), walk):
        sums = np.zeros(40)
        results.append((run(Pair(x, y, 0.5), Pair(u, v, 2.0), sums), sums))
    assert results[0][0] == pytest.approx(results[1][0], rel=1e-13)
    np.testing.assert_allclose(results[0][1], results[1][1], rtol=1e-13)


def test_types_that_are_found_again_are_those_of_the_arguments():
    @jit.compiled
    def twice(x: float) -> float:
        return x + x

    assert [type(twice(x)) for x in (2, 2.0, 3, 3j)] == [int, float, int, complex]


@pytest.mark.verify
def test_a_change_in_one_module_reaches_kernels_of_another(tmp_path: Path):
    package = tmp_path / "kernels"
    package.mkdir()
    (package / "__init__.py").write_text("")
    shutil.copy(Path(jit.__file__), package / "jit.py")
    (package / "outer.py").write_text(
        "from kernels.inner import rule\nfrom kernels.jit import compiled\n\n\n"
        "@compiled\ndef outer(x):\n    return rule(x)\n"
    )
    seen = []
    for rule in ("x + 1.0", "x + 1.0", "x * 3.0"):
        (package / "inner.py").write_text(
            f"from kernels.jit import compiled\n\n\n@compiled\ndef rule(x):\n    return {rule}\n"
        )
        program = (
            "import logging; logging.basicConfig(level='INFO', format='%(name)s: %(message)s'); "
            "from kernels.outer import outer; print(outer(5.0), sum(outer.stats.cache_hits.values()))"
        )
        done = subprocess.run(
            [sys.executable, "-c", program], cwd=tmp_path, capture_output=True, text=True, timeout=120, check=True
        )
        seen.append((*done.stdout.split(), done.stderr.count("bent_beam: compiling")))
    assert seen == [("6.0", "0", 1), ("6.0", "1", 0), ("15.0", "0", 1)]  # said once, to whom the command listens


def test_a_kernel_of_ones_own_may_hold_all_that_numba_takes():
    """Those of the package, which loop over numbers, are compiled without passes for arrays, closures and the like."""

    @jit.compiled
    def furthest(x: np.ndarray) -> float:
        def off(value: float) -> float:
            return abs(value - 1.0)

        return max([off(v) for v in 2.0 * x + 1.0])

    assert furthest(np.array([1.0, -3.0, 2.0])) == 6.0
