"""Histories on disk: written whole or not at all, and examined in a process apart before they are read.

A file larger than ``LARGE`` is not held in memory: its values are read as they are asked for.
"""

from __future__ import annotations

import errno
import io
import os
import stat
import subprocess
import sys
import warnings as python_warnings
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from bent_beam.files import write_atomically

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["blocks", "copy_whole", "open_lazily", "read_dataset", "write_dataset"]

PATIENCE = 120  # s of the clock, beyond the limit of CPU time that ends an examination
LARGE = 1_000_000_000  # bytes of all values; a larger history is read as it is asked for
BLOCK = 64_000_000  # bytes that are read of it at a time, where all of it is looked at


def write_dataset(dataset: xr.Dataset, file: Path) -> None:
    """Write netCDF, compressed, whole or not at all. ``OSError`` names the file."""
    encoding = {v: {"compression": "gzip", "compression_opts": 1} for v in dataset.variables if dataset[v].ndim == 2}
    content = io.BytesIO()  # HDF5 itself does not survive a full disk: only finished bytes go there
    try:
        dataset.to_netcdf(content, engine="h5netcdf", encoding=encoding)
    except OSError as error:
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(file)) from error
    write_atomically(file, content.getbuffer())


def copy_whole(source: Path, file: Path) -> None:
    """Copy a history's file: a killed run or a full disk leaves either the whole copy or none."""
    with source.open("rb") as content:
        write_atomically(file, content)


def open_lazily(file: Path) -> xr.Dataset:
    """A netCDF file as a dataset that holds none of the values that have been read from it, but places and instants."""
    import xarray as xr

    # no scales, offsets or fill values: they would turn small numbers into large arrays
    dataset = xr.open_dataset(file, engine="h5netcdf", decode_times=False, mask_and_scale=False, cache=False)
    for variable in dataset.variables.values():
        variable.attrs.pop("_FillValue", None)
    return dataset


def blocks(variable: xr.Variable) -> Iterator[Any]:
    """The values of a variable, some at a time."""
    rows = variable.shape[0] if variable.ndim else 1
    step = max(1, int(BLOCK * rows // max(variable.nbytes, 1)))
    if rows <= step:
        yield variable.values
        return
    for first in range(0, rows, step):
        yield variable[first : first + step].values


def read_dataset(file: Path) -> tuple[xr.Dataset, bool]:
    """A netCDF file, and whether its values are read as they are asked for (when there are more than ``LARGE``).

    ``ValueError`` in one line for what is none or holds what a history does not.
    """
    from bent_beam.examination import BYTES_A_SECOND

    try:
        described = file.stat()  # FileNotFoundError is the caller's to tell
        if not stat.S_ISREG(described.st_mode):  # a pipe that nobody writes into would be waited for
            raise ValueError("it is no regular file")
        size = described.st_size
        examine_apart(file, PATIENCE + size // BYTES_A_SECOND)
        with python_warnings.catch_warnings():
            python_warnings.simplefilter("ignore")  # what a foreign file lacks is said by whoever asks for it
            dataset = open_lazily(file)
            large = dataset.nbytes > LARGE
            if not large:
                with dataset as stored:
                    dataset = stored.load()
    except FileNotFoundError:
        raise
    except Exception as error:  # h5py raises many kinds for a broken file
        raise ValueError(f"{file} is not a readable history: {' '.join(str(error).split())}") from None
    return dataset, large


def examine_apart(file: Path, patience: float) -> None:
    """:func:`bent_beam.examination.examine` in a process of its own: a file that hangs or crashes HDF5 is refused."""
    from bent_beam import examination

    program = [sys.executable, "-P", str(examination.__file__), str(file.absolute())]
    alone = os.environ | {"OPENBLAS_NUM_THREADS": "1"}  # each of its threads takes 41 MB of the memory allowed
    try:
        done = subprocess.run(program, capture_output=True, timeout=patience, text=True, errors="replace", env=alone)
    except subprocess.TimeoutExpired:
        raise ValueError(f"it cannot be read within {patience:.0f} s") from None
    if done.returncode != 0:
        said = done.stdout.strip()[:300] if done.returncode == 1 else ""
        raise ValueError(said or "it is damaged: the HDF5 library hangs or crashes on it")
