"""What a stored history (:class:`bent_beam.ImpactHistory`) must hold: numbers and JSON, nothing else."""

from __future__ import annotations

import json
import unicodedata
from typing import Any

import numpy as np

from bent_beam.checks import one_of, shortened

__all__ = ["check_contents"]

REQUIRED = ("time", "x", "contact_x", "gap", "impulse", "total_impulse", "kinetic_energy", "strain_energy")
CONTROL = {"Cc", "Cf", "Cs"}  # of Unicode


def check_contents(history: Any) -> None:
    """Raise when an attribute or a variable is not what a history holds: numbers and JSON, nothing else."""
    for name in ("impact", "settings", "versions", "warnings", "path", "symmetry"):
        if not isinstance(history.dataset.attrs[name], str):
            raise TypeError(f"attribute {name} must be text")
    for name, kind in (("impact", dict), ("settings", dict), ("versions", dict), ("warnings", list)):
        held = json.loads(history.dataset.attrs[name])
        if not isinstance(held, kind):
            raise TypeError(f"attribute {name} must hold a JSON {kind.__name__}")
        _plain_text(held, f"attribute {name}")
    _plain_text([history.path, *map(str, history.dataset.variables)], "attribute path or a variable's name")
    if not all(isinstance(line, str) for line in history.warnings):
        raise TypeError("attribute warnings must hold texts")
    if "section" in history.attrs and not all(value > 0.0 for value in json.loads(history.attrs["section"]).values()):
        raise ValueError("attribute section must hold positive numbers")
    one_of("attribute symmetry", history.dataset.attrs["symmetry"], ("half", "full"))
    _ = history.impact, history.steps, history.seconds, history.completed
    for required in REQUIRED:
        _ = history.dataset[required]
    for label, variable in history.dataset.variables.items():
        if variable.dtype.kind not in "fiub":
            raise TypeError(f"{label} must hold numbers (got {variable.dtype})")
        if not set(variable.dims) <= {"time", "x", "contact"}:
            raise ValueError(f"{label} must have dimensions time, x and contact (got {variable.dims})")
        if not np.isfinite(variable.values).all():
            raise ValueError(f"{label} is not finite")
    if history.time.size < 1 or np.any(np.diff(history.time) <= 0.0):
        raise ValueError("time must increase")


def _plain_text(value: Any, where: str) -> None:
    """Raise ``ValueError`` for a text with control characters, which could tell a terminal what to do."""
    if isinstance(value, str):
        if not all(unicodedata.category(c) not in CONTROL or c in "\n\t" for c in value):
            raise ValueError(f"{where} holds control characters ({shortened(value)})")
    elif isinstance(value, dict):
        for key, item in value.items():
            _plain_text(key, where)
            _plain_text(item, where)
    elif isinstance(value, list):
        for item in value:
            _plain_text(item, where)
