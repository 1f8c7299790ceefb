"""Histories on disk: netCDF, written whole or not at all, and checked before it is read."""

from __future__ import annotations

import errno
import io
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from bent_beam.files import write_atomically

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["read_dataset", "write_dataset"]


def write_dataset(dataset: xr.Dataset, file: Path) -> None:
    """Write netCDF, compressed, whole or not at all. ``OSError`` names the file."""
    encoding = {v: {"compression": "gzip", "compression_opts": 1} for v in dataset.variables if dataset[v].ndim == 2}
    content = io.BytesIO()  # HDF5 itself does not survive a full disk: only finished bytes go there
    try:
        dataset.to_netcdf(content, engine="h5netcdf", encoding=encoding)
    except OSError as error:
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(file)) from error
    write_atomically(file, content.getbuffer())


def read_dataset(file: Path) -> xr.Dataset:
    """All of a netCDF file. ``ValueError`` in one line for what is none, or holds what a history does not."""
    import xarray as xr

    from bent_beam.examination import examine

    try:
        examine(file)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what a foreign file lacks is said by whoever asks for it
            # no scales, offsets or fill values: they would turn small numbers into large arrays
            dataset = xr.load_dataset(file, engine="h5netcdf", decode_times=False, mask_and_scale=False)
    except FileNotFoundError:
        raise FileNotFoundError(f"history {file}: no such file") from None
    except Exception as error:  # h5py raises many kinds for a broken file
        if file.suffix == ".toml":
            wanted = f"a history is wanted, bentbeam simulate {file} --out FILE.nc writes one"
            raise ValueError(f"{file} is a case file: {wanted}") from None
        raise ValueError(f"{file} is not a readable history: {' '.join(str(error).split())}") from None
    for variable in dataset.variables.values():
        variable.attrs.pop("_FillValue", None)
    return dataset
