"""Compiled code on disk: an upgraded package never runs yesterday's code; a torn or missing file costs time alone."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from bent_beam import Impact
from hermite_fe import compiled as module
from hermite_fe import simulate
from hermite_fe.contacts import NodeContact
from hermite_fe.integrators import MoreauJean, SignoriniPosition

ANSWER = "from package.outer import outer; from package.compiled import recompiling as r; print(r(lambda: outer(5.0)))"


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package of two compiled functions, one of which calls the other, with a cache folder of its own."""
    package = tmp_path / "package"
    package.mkdir()
    shutil.copy(module.__file__, package / "compiled.py")
    (package / "__init__.py").write_text("")
    (package / "inner.py").write_text(
        "from package.compiled import compiled\n\n\n@compiled\ndef inner(x):\n    return x + 1.0\n"
    )
    (package / "outer.py").write_text(
        "from package.inner import inner\nfrom package.compiled import compiled\n\n\n"
        "@compiled\ndef outer(x):\n    return 2.0 * inner(x)\n"
    )
    return package


def answered(package: Path, before: str = "") -> str:
    """What a new process prints, by itself."""
    done = subprocess.run(
        [sys.executable, "-c", f"{before}\n{ANSWER}"],
        cwd=package.parent,
        env={"XDG_CACHE_HOME": str(package.parent / "cache"), "PATH": "", "HOME": str(package.parent)},
        capture_output=True,
        text=True,
        timeout=120,
    )
    return done.stdout.strip() or done.stderr


def kept(package: Path, kind: str) -> list[Path]:
    return list((package.parent / "cache").rglob(f"*.{kind}"))


@pytest.mark.verify
def test_a_change_in_one_module_reaches_functions_of_another(package: Path) -> None:
    assert answered(package) == "12.0" and kept(package, "nbc")
    inner = package / "inner.py"
    inner.write_text(inner.read_text().replace("x + 1.0", "x * 3.0"))
    assert answered(package) == "30.0"


@pytest.mark.verify
@pytest.mark.parametrize("kind", ["nbi", "nbc"])
@pytest.mark.parametrize("left", [0.0, 0.5])
def test_files_that_lost_their_end_are_compiled_again(kind: str, left: float, package: Path) -> None:
    assert answered(package) == "12.0" and kept(package, kind)
    for file in kept(package, kind):
        file.write_bytes(file.read_bytes()[: int(left * file.stat().st_size)])
    assert answered(package) == "12.0"


FULL = "import shutil; from types import SimpleNamespace as S; shutil.disk_usage = lambda path: S(free=1e6)"


@pytest.mark.verify
@pytest.mark.parametrize("before", ["", FULL], ids=["no folder", "a disk that is nearly full"])
def test_functions_run_where_nothing_can_be_kept(before: str, package: Path) -> None:
    if not before:
        (package.parent / "cache").write_text("a file where the folder should be")
    assert answered(package, before) == "12.0"
    assert not kept(package, "nbc")


def test_another_module_is_another_folder_and_one_that_cannot_be_made_keeps_nothing(package: Path, monkeypatch) -> None:
    monkeypatch.setattr(module, "__file__", str(package / "compiled.py"))
    before = module.digest_of_sources()
    (package / "inner.py").write_text("")
    assert module.digest_of_sources() != before
    monkeypatch.setattr(module, "FOLDER", package / "inner.py" / "compiled")
    assert not module.can_be_kept()
    monkeypatch.setattr(module, "KEPT", False)
    twice = module.compiled(lambda x: 2.0 * x)
    assert module.recompiling(lambda: twice(6.0)) == 12.0


def test_bad_input_leaves_what_is_compiled_alone() -> None:
    """What cannot be read is removed and compiled anew; an integrator that refuses a problem is no such thing."""
    simulate(Impact.dimensionless(0.5, length=8.0), end_time=0.01, integrator=MoreauJean(1e-3))
    before = sorted(module.FOLDER.rglob("*.nbi"))
    with pytest.raises(ValueError, match="restitution must be 0"):
        simulate(
            Impact.dimensionless(0.5, length=8.0),
            end_time=0.01,
            integrator=SignoriniPosition(1e-3),
            contact=NodeContact(restitution=0.5),
        )
    assert before and sorted(module.FOLDER.rglob("*.nbi")) == before


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


def test_an_integrator_that_raises_is_called_once_and_costs_no_compiled_code() -> None:
    calls = []

    class Raising(MoreauJean):
        def advance(self, *_: object) -> tuple[int, int]:
            calls.append(1)
            raise RuntimeError("mine")

    simulate(Impact.dimensionless(0.5, length=8.0), end_time=0.01, integrator=MoreauJean(1e-3))
    before = sorted(module.FOLDER.rglob("*.nbi"))
    with pytest.raises(RuntimeError, match="mine"):
        simulate(Impact.dimensionless(0.5, length=8.0), end_time=0.01, integrator=Raising(1e-3))
    assert len(calls) == 1 and before and sorted(module.FOLDER.rglob("*.nbi")) == before


def test_folders_of_versions_that_nobody_uses_go(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    mine, old, recent = (tmp_path / f"compiled-{name}" for name in ("mine", "old", "recent"))
    for folder in (mine, old, recent):
        folder.mkdir()
        os.utime(folder, (1e9, 1e9) if folder is old else None)
    monkeypatch.setattr(module, "FOLDER", mine)
    module.forget_old()
    assert mine.exists() and recent.exists() and not old.exists()
