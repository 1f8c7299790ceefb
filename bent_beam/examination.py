"""What a netCDF file says of itself, looked at before anything in it is used, by a process of its own.

netCDF is HDF5, which can point to other files, hold objects, and unpack a few kilobytes to gigabytes. What a history
needs is little: variables of numbers in the root group, attributes of text and numbers. Everything else is refused by
links, types, sizes and filters, before a value is read. A damaged file can still hang or crash the HDF5 library
itself, in compiled code that nothing interrupts: the process ends after ``CPU_SECONDS``, and only that.

Imports nothing of this project, so that it starts fast and wherever the project is.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

import h5py
import numpy as np

__all__ = ["examine"]

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
MOST_VARIABLES = 64
MOST_ATTRIBUTES = 32  # of one object
MOST_TEXT = 16_000_000  # characters in all attributes: the nodes and saved instants of the largest run fit
LARGEST = 8_000_000_000  # bytes of all values, of a packed file
LARGEST_PACKED = 250_000_000  # bytes of all values that a small file may unpack to
RATIO = 20  # of all values to the size of the file, beyond that: numbers of a simulation hardly compress
FILTERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE, h5py.h5z.FILTER_FLETCHER32}
OF_NETCDF = {"DIMENSION_LIST", "REFERENCE_LIST"}  # references between variables and their dimensions, no text
CPU_SECONDS = 4
LIBRARIES = 600_000_000  # bytes of memory besides the values
BLOCK = 64_000_000  # bytes of values that are read at a time
BYTES_A_SECOND = 20_000_000  # a large file may take longer


def allowed(size: int) -> int:
    """Bytes of all values that a file of ``size`` bytes may hold."""
    return max(LARGEST_PACKED + size, min(LARGEST, RATIO * size))


def examine(file: Path) -> None:
    """Raise ``ValueError`` for anything in ``file`` that a history does not hold; read all of the rest once."""
    with h5py.File(file, "r") as content:
        _check_content(content, allowed(file.stat().st_size))
        for name in content:
            _read(content[name])


def _read(variable: h5py.Dataset) -> None:
    """All values once, ``BLOCK`` bytes at a time."""
    rows = variable.shape[0] if variable.shape else 0
    step = max(1, int(BLOCK * rows // max(variable.nbytes, 1)))
    if rows <= step:
        variable[()]
        return
    for first in range(0, rows, step):
        variable[first : first + step]


def _check_content(content: h5py.File, most: int) -> None:
    """Raise ``ValueError`` for anything but numbers in the root group, ``most`` bytes of them, and short attributes."""
    if len(content) > MOST_VARIABLES:
        raise ValueError(f"it holds {len(content)} variables; {MOST_VARIABLES} are the most")
    text = _text_of(content, "the file", 0)
    total = 0
    for name in content:
        if not NAME.fullmatch(name):
            raise ValueError(f"the name {name[:40]!r} is not that of a variable")
        link = content.get(name, getlink=True)
        if not isinstance(link, h5py.HardLink):
            raise ValueError(f"{name} is a link to elsewhere ({type(link).__name__}), which is not followed")
        if content.get(name, getclass=True) is not h5py.Dataset:
            raise ValueError(f"{name} must be a variable in the root group (no groups, no types)")
        variable = content[name]
        total += _bytes_of(variable, name)
        if total > most:
            raise ValueError(f"it would take {total:.2g} bytes of memory or more ({most:.2g} are let in)")
        text = _text_of(variable, name, text)


def _bytes_of(variable: h5py.Dataset, name: str) -> int:
    """Bytes of a variable's values and of one of its chunks, read from its description alone."""
    if variable.dtype.kind not in "fiub" or variable.dtype.itemsize > 8:
        raise ValueError(f"{name} must hold numbers (got {variable.dtype})")
    plist = variable.id.get_create_plist()
    if variable.external or variable.is_virtual:
        raise ValueError(f"{name} keeps its values in another file, which is not followed")
    filters = {plist.get_filter(i)[0] for i in range(plist.get_nfilters())}
    if not filters <= FILTERS:
        raise ValueError(f"{name} is packed by a filter that is not used here (number {max(filters - FILTERS)})")
    if len(variable.shape) > 2:
        raise ValueError(f"{name} must have at most two dimensions (got {len(variable.shape)})")
    items = int(np.prod([int(n) for n in variable.shape], dtype=object))
    chunk = int(np.prod([int(n) for n in variable.chunks or ()], dtype=object))
    return variable.dtype.itemsize * (items + (chunk if items else 0))


def _text_of(thing: Any, name: str, before: int) -> int:
    """``before`` and the characters of an object's attributes; each is one text or a few numbers."""
    if len(thing.attrs) > MOST_ATTRIBUTES:
        raise ValueError(f"{name} has {len(thing.attrs)} attributes; {MOST_ATTRIBUTES} are the most")
    for key in thing.attrs:
        if key in OF_NETCDF:
            continue
        where = f"attribute {key[:40]!r} of {name}"
        about = h5py.h5a.open(thing.id, key.encode())
        if int(np.prod([int(n) for n in about.shape], dtype=object)) > 16 or about.dtype.kind not in "fiubSO":
            raise ValueError(f"{where} must be one text or a few numbers")
        if about.dtype.kind == "O" and h5py.check_string_dtype(about.dtype) is None:
            raise ValueError(f"{where} must be one text or a few numbers")
        if about.dtype.kind in "SO":
            if about.shape not in ((), (1,)):
                raise ValueError(f"{where} must be one text")
            if about.get_storage_size() > MOST_TEXT:
                raise ValueError(f"{where} is too long")
            before += len(thing.attrs[key])
            if before > MOST_TEXT:
                raise ValueError(f"its attributes hold more than {MOST_TEXT:.2g} characters")
    return before


def main() -> int:
    """The file named on the command line; 1 and one line on standard output when it is refused."""
    file = Path(sys.argv[1])
    try:
        import resource

        size = file.stat().st_size
        seconds, memory = CPU_SECONDS + size // BYTES_A_SECOND, LIBRARIES + allowed(size)
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    except ImportError:  # not on Windows: the caller's clock is the only limit there
        pass
    try:
        examine(file)
    except Exception as error:  # h5py raises many kinds for a broken file
        print(" ".join(str(error).split()))
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
