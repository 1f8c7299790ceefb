"""What the variables of a history are: dimensions, units, order and size of their values, checked at every door."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["check_variables"]

COORDINATES = {"time": ("time",), "x": ("x",), "contact_x": ("contact",)}
DIMENSIONS = COORDINATES | dict.fromkeys(("gap", "velocity", "slope", "position"), ("time", "x"))
DIMENSIONS |= dict.fromkeys(("impulse", "opposite_impulse", "in_contact", "contact_position"), ("time", "contact"))
LARGEST = 1e150  # of a value: its square can still be calculated with


def check_variables(dataset: xr.Dataset, units: Mapping[str, str]) -> None:
    """Raise ``ValueError`` for a variable that is not what a history holds. units : of the known variables; those that
    :data:`DIMENSIONS` does not name are functions of time."""
    for name, variable in ((str(label), one) for label, one in dataset.variables.items()):
        if variable.dtype.kind not in "fiub":
            raise ValueError(f"{name} must hold numbers (got {variable.dtype})")
        expected = DIMENSIONS.get(name, ("time",) if name in units else None)
        if expected is None and set(variable.dims) <= {"time", "x", "contact"}:
            continue
        if variable.dims != expected:
            asked, got = ", ".join(expected or ("time", "x", "contact")), ", ".join(map(str, variable.dims))
            raise ValueError(f"{name} must have dimensions {asked} (got {got})")
        if variable.attrs.get("units", "") != units.get(name, ""):
            raise ValueError(f"{name} must be in {units.get(name, 'no unit')} (got {variable.attrs.get('units')!r})")
    for label, one in dataset.variables.items():
        if not np.isfinite(one.values).all():
            raise ValueError(f"{label} is not finite")
        if np.abs(one.values.astype(float)).max(initial=0.0) > LARGEST:
            raise ValueError(f"{label} must not exceed {LARGEST:g}")
    if dataset.sizes["time"] < 1 or dataset.sizes["x"] < 1 or dataset["time"].values[0] < 0.0:
        raise ValueError("time must hold instants from 0 on, and x at least one node")
    for name in ("time", "x", "position"):
        if name in dataset.variables and np.any(np.diff(dataset[name].values) <= 0.0):
            raise ValueError(f"{name} must increase")
