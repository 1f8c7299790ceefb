"""What a netCDF file says of itself, checked before a value is read.

netCDF is HDF5, which can point to other files, hold objects, and unpack a few kilobytes to gigabytes. A history needs
little: variables of numbers in the root group, attributes of text and numbers. Everything else is refused.
"""

from __future__ import annotations

import re
from math import prod
from pathlib import Path
from typing import Any

import h5py

__all__ = ["examine"]

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
MOST_VARIABLES = 64
MOST_ATTRIBUTES = 32  # of one object
MOST_TEXT = 16_000_000  # bytes of one attribute: the nodes and saved instants of the largest run fit
LARGEST = 8_000_000_000  # bytes of all values
SMALL, RATIO = 250_000_000, 20  # bytes that any file may unpack to; beyond, times the file's size
OF_NETCDF = {"DIMENSION_LIST", "REFERENCE_LIST"}  # references between variables and their dimensions, no text


def examine(file: Path) -> None:
    """Raise ``ValueError`` for anything in ``file`` that a history does not hold."""
    if file.exists() and not file.is_file():  # a pipe that nobody writes into would be waited for
        raise ValueError("it is no regular file")
    most = min(LARGEST, SMALL + RATIO * file.stat().st_size)
    with h5py.File(file, "r") as content:
        if len(content) > MOST_VARIABLES:
            raise ValueError(f"it holds {len(content)} variables; {MOST_VARIABLES} are the most")
        _check_attributes(content, "the file")
        total = sum(_bytes_of(content, name) for name in content)
    if total > most:
        raise ValueError(f"it would take {total:.2g} bytes of memory or more ({most:.2g} are let in)")


def _bytes_of(content: h5py.File, name: str) -> int:
    """Bytes of a variable's values and of one of its chunks, read from its description alone."""
    if not NAME.fullmatch(name):
        raise ValueError(f"the name {name[:40]!r} is not that of a variable")
    link = content.get(name, getlink=True)
    if not isinstance(link, h5py.HardLink):
        raise ValueError(f"{name} is a link to elsewhere ({type(link).__name__}), which is not followed")
    if content.get(name, getclass=True) is not h5py.Dataset:
        raise ValueError(f"{name} must be a variable in the root group (no groups, no types)")
    variable = content[name]
    if variable.dtype.kind not in "fiub" or variable.dtype.itemsize > 8:
        raise ValueError(f"{name} must hold numbers (got {variable.dtype})")
    if variable.external or variable.is_virtual:
        raise ValueError(f"{name} keeps its values in another file, which is not followed")
    if len(variable.shape) > 2:
        raise ValueError(f"{name} must have at most two dimensions (got {len(variable.shape)})")
    _check_attributes(variable, name)
    items = prod(map(int, variable.shape))
    return int(variable.dtype.itemsize * (items + (prod(map(int, variable.chunks or (0,))) if items else 0)))


def _check_attributes(thing: Any, name: str) -> None:
    """Each attribute is one text or a few numbers."""
    if len(thing.attrs) > MOST_ATTRIBUTES:
        raise ValueError(f"{name} has {len(thing.attrs)} attributes; {MOST_ATTRIBUTES} are the most")
    for key in set(thing.attrs) - OF_NETCDF:
        about = thing.attrs.get_id(key)
        text = about.dtype.kind == "S" or h5py.check_string_dtype(about.dtype) is not None
        items = prod(map(int, about.shape))
        if not (items == 1 if text else about.dtype.kind in "fiub" and items <= 16):
            raise ValueError(f"attribute {key[:40]!r} of {name} must be one text or a few numbers")
        if text and max(about.get_storage_size(), len(thing.attrs[key])) > MOST_TEXT:
            raise ValueError(f"attribute {key[:40]!r} of {name} is too long")
