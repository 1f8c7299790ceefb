"""The count of noticed faults: a fault that ends pytest is noticed, a harness that cannot run it is an error."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from benchmarks.mutation import caught, in_child

SECONDS = {"none": 0.0}


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    """A module with a test, no fault in it."""
    folder = tmp_path / "tree"
    folder.mkdir()
    (folder / "solver.py").write_text("ANSWER = 42\n")
    test = "import sys; sys.path.insert(0, '.')\nimport solver\ndef test_answer(): assert solver.ANSWER == 42\n"
    (folder / "test_solver.py").write_text(test)
    return folder


def tried(tree: Path, fault: str, *files: str) -> dict[str, Any]:
    (tree / "solver.py").write_text(fault)
    return in_child(tree, tree.parent / "cache", files or ("test_solver.py",), "own", SECONDS)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks")
@pytest.mark.parametrize(
    ("fault", "noticed"),
    [
        ("ANSWER = 6 * 7", False),
        ("ANSWER = 54", True),
        ("ANSWER = 42 / 0", True),
        ("import sys; sys.exit(2)", True),
        ("import os; os._exit(0)", True),
        ("import os; os.abort()", True),
    ],
)
def test_a_fault_is_noticed_however_it_ends_the_tests(tree: Path, fault: str, noticed: bool) -> None:
    assert caught(tried(tree, fault)) is noticed


@pytest.mark.skipif(not hasattr(os, "fork"), reason="forks")
def test_what_was_not_tried_is_not_noticed(tree: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(RuntimeError, match="code 4"):
        caught(tried(tree, "ANSWER = 54", "test_elsewhere.py"))

    def fails(*_: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr("benchmarks.mutation.Recorder.pytest_collection_modifyitems", fails)
    with pytest.raises(RuntimeError, match="code 3"):
        caught(tried(tree, "ANSWER = 54"))
    monkeypatch.setattr("json.dumps", fails)
    with pytest.raises(RuntimeError, match="code None"):
        caught(tried(tree, "ANSWER = 54"))
