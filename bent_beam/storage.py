"""Histories on disk: written whole or not at all, and examined in a process apart before they are read."""

from __future__ import annotations

import errno
import io
import os
import subprocess
import sys
import warnings as python_warnings
from pathlib import Path
from typing import TYPE_CHECKING

from bent_beam.files import write_atomically

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["read_dataset", "write_dataset"]

PATIENCE = 120  # s of the clock, beyond the limit of CPU time that ends an examination


def write_dataset(dataset: xr.Dataset, file: Path) -> None:
    """Write netCDF, compressed, whole or not at all. ``OSError`` names the file."""
    encoding = {v: {"compression": "gzip", "compression_opts": 1} for v in dataset.variables if dataset[v].ndim == 2}
    content = io.BytesIO()  # HDF5 itself does not survive a full disk: only finished bytes go there
    try:
        dataset.to_netcdf(content, engine="h5netcdf", encoding=encoding)
        write_atomically(file, content.getbuffer())
    except OSError as error:
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(file)) from error


def read_dataset(file: Path) -> xr.Dataset:
    """All of a netCDF file in memory; ``ValueError`` in one line for what is none or holds what a history does not."""
    import xarray as xr

    from bent_beam.examination import BYTES_A_SECOND

    try:
        size = file.stat().st_size  # FileNotFoundError is the caller's to tell
        examine_apart(file, PATIENCE + size // BYTES_A_SECOND)
        with python_warnings.catch_warnings():
            python_warnings.simplefilter("ignore")  # what a foreign file lacks is said by whoever asks for it
            # no scales, offsets or fill values: they would turn small numbers into large arrays
            with xr.open_dataset(file, engine="h5netcdf", decode_times=False, mask_and_scale=False) as stored:
                dataset = stored.load()
    except FileNotFoundError:
        raise
    except Exception as error:  # h5py raises many kinds for a broken file
        raise ValueError(f"{file} is not a readable history: {' '.join(str(error).split())}") from None
    for variable in dataset.variables.values():
        variable.attrs.pop("_FillValue", None)
    return dataset


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
