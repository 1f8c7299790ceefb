"""Runs a case and makes a flat dictionary of numbers of its answer."""

from __future__ import annotations

import contextlib
import io
import json
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.net.case import Case
from bent_beam import ImpactHistory

__all__ = ["answer"]

SKIPPED = {"seconds", "versions", "version", "settings", "file", "files", "summary", "warnings", "metadata", "model"}
SKIPPED |= {"mean_iterations", "most_iterations", "seed"}
SHARES = (0.25, 0.5, 0.75, 1.0)  # of the saved instants, and of the nodes


def answer(case: Case, nudge: float = 0.0) -> dict[str, float]:
    """The numbers of ``case``, its number changed by a share ``nudge``; a refusal is ``{"exit code": …}``."""
    from comparison.command_line.app import run

    with tempfile.TemporaryDirectory() as name:
        folder, found = Path(name), {}
        os.environ["BENTBEAM_STORE"] = str(folder / "store")  # nothing kept from before is read
        for words in case.arguments(folder, nudge):
            said, complaint = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(complaint):
                code = run(words)
            if code:
                return {"exit code": float(code)}
        lines = [line for line in said.getvalue().splitlines() if line.startswith("{")]
        found = dict(flat(json.loads(lines[-1])))
        if (folder / "run.nc").exists():
            found |= samples(ImpactHistory.load(folder / "run.nc"))
    return found


def flat(value: Any, name: str = "") -> Iterator[tuple[str, float]]:
    """Every number under ``value`` with the names on the way to it, joined by dots."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in SKIPPED:
                yield from flat(inner, f"{name}.{key}" if name else key)
    elif isinstance(value, list):
        for k, inner in enumerate(value):
            yield from flat(inner, f"{name}.{k}")
    elif isinstance(value, bool | int | float):
        yield name, float(value)


def samples(history: ImpactHistory) -> dict[str, float]:
    """A few instants and places of a stored run."""
    found: dict[str, float] = {}
    for share in SHARES:
        k = round(share * (history.time.size - 1))
        impulse, places = history.array("impulse", k), history.contact_positions(k)
        found[f"time.{share}"] = float(history.time[k])
        found[f"impulse.{share}"] = float(history.array("total_impulse", k))
        found[f"impulse.first {share}"] = float(impulse[0])
        found[f"impulse moment.{share}"] = float(impulse @ np.abs(places))
        found[f"contacts.{share}"] = float(np.sum(history.array("in_contact", k)))
        for variable in ("gap", "velocity", "slope"):
            values = history.array(variable, k)
            for part in (0.0, 0.1, *SHARES):
                found[f"{variable}.{share} {part}"] = float(values[round(part * (values.size - 1))])
    return found
