"""Compiled code on disk: an upgraded package never runs yesterday's code; a torn or missing file costs time alone."""

import ast
import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from bent_beam import Impact
from hermite_fe import compiled as module
from hermite_fe import simulate
from hermite_fe.contacts import NodeContact
from hermite_fe.integrators import MoreauJean, SignoriniPosition

BROKEN = """
from pathlib import Path; from bent_beam import Impact; from hermite_fe import compiled, simulate
for file in compiled.FOLDER.rglob("*.nb?"):
    file.write_bytes(file.read_bytes()[: int(LEFT * file.stat().st_size)])
print(simulate(Impact.dimensionless(0.5, length=8.0), end_time=0.01).completed)
"""


@pytest.mark.verify
@pytest.mark.parametrize("left", [0.0, 0.5])
def test_a_torn_cache_costs_a_run_its_compile_time(left: float, tmp_path: Path) -> None:
    """The first compiled function of a run is called where its model is made, before it takes a step."""
    here = {"XDG_CACHE_HOME": str(tmp_path), "HOME": str(tmp_path), "PATH": ""}
    for code in (BROKEN.replace("LEFT", "1"), BROKEN.replace("LEFT", str(left))):
        done = subprocess.run([sys.executable, "-c", code], env=here, capture_output=True, text=True, timeout=300)
        assert done.stdout == "True\n", done.stderr


def test_another_module_is_another_folder_and_where_nothing_can_be_kept_functions_run(tmp_path: Path, monkeypatch):
    monkeypatch.setattr(module, "__file__", str(tmp_path / "compiled.py"))
    (tmp_path / "inner.py").write_text("")
    before = module.digest_of_sources()
    (tmp_path / "inner.py").write_text("another")
    assert module.digest_of_sources() != before
    monkeypatch.setattr(module, "FOLDER", tmp_path / "inner.py" / "compiled")  # no folder can be made there
    assert not module.can_be_kept()
    monkeypatch.setattr(module, "FOLDER", tmp_path / "compiled")
    assert module.can_be_kept()
    monkeypatch.setattr("shutil.disk_usage", lambda path: SimpleNamespace(free=1e6))
    assert not module.can_be_kept()
    monkeypatch.setattr(module, "KEPT", False)
    twice = module.compiled(lambda x: 2.0 * x)
    assert module.recompiling(lambda: twice(6.0)) == 12.0


def test_bad_input_and_an_integrator_that_raises_once_leave_what_is_compiled_alone() -> None:
    """What cannot be read is removed and compiled anew; a problem that is refused is no such thing."""
    calls = []

    class Raising(MoreauJean):
        def advance(self, *_: object) -> tuple[int, int]:
            calls.append(1)
            raise RuntimeError("mine")

    asked = {"impact": Impact.dimensionless(0.5, length=8.0), "end_time": 0.01}
    simulate(**asked, integrator=MoreauJean(1e-3))
    before = sorted(module.FOLDER.rglob("*.nbi"))
    with pytest.raises(ValueError, match="restitution must be 0"):
        simulate(**asked, integrator=SignoriniPosition(1e-3), contact=NodeContact(restitution=0.5))
    with pytest.raises(RuntimeError, match="mine"):
        simulate(**asked, integrator=Raising(1e-3))
    assert len(calls) == 1 and before and sorted(module.FOLDER.rglob("*.nbi")) == before


def test_no_number_of_another_package_is_frozen_in_compiled_code() -> None:
    """What is kept on disk is that of this package's sources alone."""
    for name in Path(module.__file__).parent.rglob("*.py"):
        tree = ast.parse(name.read_text())
        imports = [node for node in tree.body if isinstance(node, ast.ImportFrom)]
        foreign = [node for node in imports if str(node.module).split(".")[0] not in ("hermite_fe", "numpy")]
        others = {alias.name for node in foreign for alias in node.names}
        for function in (node for node in tree.body if isinstance(node, ast.FunctionDef)):
            if {getattr(one, "id", "") for one in function.decorator_list} & {"compiled", "compiled_within"}:
                used = {node.id for line in function.body for node in ast.walk(line) if isinstance(node, ast.Name)}
                assert not used & others, f"{name.name}: {function.name} uses {used & others}"


def test_folders_of_versions_that_nobody_uses_go(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mine, old, recent = (tmp_path / f"compiled-{name}" for name in ("mine", "old", "recent"))
    for folder in (mine, old, recent):
        folder.mkdir()
        os.utime(folder, (1e9, 1e9) if folder is old else None)
    monkeypatch.setattr(module, "FOLDER", mine)
    module.forget_old()
    assert mine.exists() and recent.exists() and not old.exists()
