"""What is timed is what a user types: each command starts in a folder of its own, where nothing is stored."""

from __future__ import annotations

from pathlib import Path

import pytest
import typer

from benchmarks import __main__ as all_of_them
from benchmarks import startup, waits
from comparison.command_line.app import app
from hermite_fe.integrators import INTEGRATORS


def test_every_wait_is_a_command_with_nothing_stored_and_kernels_compiled_before(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    told: list[tuple[list[str], Path | None]] = []

    def seconds(words: list[str], **environment: str) -> float:
        store = Path(environment["BENTBEAM_STORE"]) if "BENTBEAM_STORE" in environment else None
        assert store is None or (store.parent.is_dir() and not any(store.parent.iterdir()))
        if words[0] != "-m":
            return 0.5  # a yardstick
        told.append((words, store))
        return 2.0

    monkeypatch.setattr(waits, "seconds", seconds)
    monkeypatch.setattr(startup, "seconds", seconds)
    rows = waits.measure()
    compiled, timed = told[: len(INTEGRATORS)], told[len(INTEGRATORS) :]
    assert [f"hermite.integrator.kind={kind}" for kind in INTEGRATORS] == [words[-1] for words, _ in compiled]
    assert len(rows) == 3 and len(timed) == 3
    assert [row.figure for row in rows] == [4.0, 4.0, 4.0]
    assert len({store for _, store in timed}) == 3  # one does not find what another one has stored
    group = typer.main.get_command(app)
    for words, _ in told:
        module, name, *options = words[1:]
        assert module == "comparison.command_line"
        group.get_command(None, name).make_context(name, options)  # exits where an option is unknown


def test_waits_come_last_of_all_benchmarks() -> None:
    """They take minutes."""
    assert all_of_them.ALL[-1] == "waits"
