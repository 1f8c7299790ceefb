"""What a stored history (:class:`bent_beam.ImpactHistory`) must hold: numbers and JSON, nothing else."""

from __future__ import annotations

import json
import unicodedata
from collections.abc import Mapping
from typing import Any

import numpy as np

from bent_beam.checks import finite, one_of, shortened
from bent_beam.schema import check_variables

__all__ = ["check_contents"]

REQUIRED = ("time", "x", "contact_x", "gap", "impulse", "total_impulse", "kinetic_energy", "strain_energy")
CONTROL = {"Cc", "Cf", "Cs"}  # of Unicode


def check_contents(history: Any, units: Mapping[str, str]) -> None:
    """Raise when an attribute or a variable is not what a history holds: numbers and JSON, nothing else.

    units : of the known variables.
    """
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
        _ = history.dataset.variables[required]  # the dataset itself makes coordinates up
    check_variables(history.dataset, units)
    finite("attribute seconds", history.seconds)
    places = history.positions(0)
    beyond = np.abs([places[0], places[-1]]).max() > history.impact.half_length * (1.0 + 1e-6)
    if beyond or (places[0] < 0.0) != (history.symmetry == "full"):
        raise ValueError(f"x must lie on the {history.symmetry} beam of length {history.impact.length!r}")


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
