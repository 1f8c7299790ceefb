"""Compiled kernels on disk: an upgraded package must never run yesterday's code."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from numba.core.caching import CompileResultCacheImpl

from hermite_fe.kernels import jit


def test_kernels_run_where_nothing_can_be_written(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(CompileResultCacheImpl, "_locator_classes", [])

    @jit.compiled
    def more(x: float) -> float:
        return x + 1.0

    assert more(2.0) == 3.0


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
