"""Files that are whole or not there, and histories (:class:`bent_beam.ImpactHistory`) in them: netCDF, checked.

netCDF is HDF5, which can point to other files, hold objects, and unpack a few kilobytes to gigabytes. A history needs
little: variables of numbers in the root group, attributes of text and numbers. Everything else is refused, before a
value is read (:func:`examine`). A digest of all that is written goes along; what differs from it is refused.
"""

from __future__ import annotations

import errno
import hashlib
import io
import json
import os
import re
import secrets
import unicodedata
import warnings
from collections.abc import Mapping
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from bent_beam.checks import finite, one_of, positive, shortened
from bent_beam.guarded import try_first

if TYPE_CHECKING:
    import xarray as xr

LOSSES = tuple(f"loss_{cause}" for cause in ("impact", "algorithmic", "viscous", "material", "absorbed", "wall"))
ENERGIES = ("kinetic_energy", "strain_energy", "contact_energy", "work_of_loads", *LOSSES)
REQUIRED = ("time", "x", "contact_x", "gap", "impulse", "total_impulse", "kinetic_energy", "strain_energy")

# dimensions → the variables of them → their units
VARIABLES: dict[tuple[str, ...], dict[str, str]] = {
    ("x",): {"x": "m"},
    ("contact",): {"contact_x": "m"},
    ("time", "x"): {"gap": "m", "position": "m", "velocity": "m/s", "slope": "1", "angle": "1",
                    "angular_velocity": "1/s", "bending_moment": "N m"},
    ("time", "contact"): {
        "impulse": "N s", "opposite_impulse": "N s", "contact_position": "m", "in_contact": "",
    },
    ("time",): {
        "time": "s", "total_impulse": "N s", "law_impulse": "N s", "held_impulse": "N s",
        **dict.fromkeys(("branch_energy", *ENERGIES), "J"),
        "peak_force": "N", "peak_force_time": "s", "peak_penetration": "m", "peak_pressure": "N/m",
        "largest_moment": "N m", "largest_moment_place": "m", "largest_midspan_moment": "N m",
    },
}  # fmt: skip
DIMENSIONS = {name: dimensions for dimensions, units in VARIABLES.items() for name in units}
UNITS = {name: unit for units in VARIABLES.values() for name, unit in units.items() if unit}

LARGEST_VALUE = 1e150  # its square can still be calculated with
NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,63}")
MOST_VARIABLES = 64
MOST_ATTRIBUTES = 32  # of one object
MOST_TEXT = 16_000_000  # bytes of one attribute: the nodes and saved instants of the largest run fit
LARGEST_FILE = 8_000_000_000  # bytes of all values
ANY_FILE, RATIO = 250_000_000, 20  # bytes that any file may unpack to; a larger one to RATIO times its size
OF_NETCDF = {"DIMENSION_LIST", "REFERENCE_LIST"}  # references between variables and their dimensions, no text
CONTROL = {"Cc", "Cf", "Cs"}  # of Unicode


def write_atomically(file: Path, content: str | bytes | memoryview) -> None:
    """Write a file so that a reader sees either nothing or all of it, and a killed run leaves no half of it. A link is
    followed.

    Raises ``OSError`` that names the file: a full disk does not say by itself which one it could not take.
    """
    file = file.resolve()
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(f".{file.name[:100]}.{secrets.token_hex(4)}.part")
    try:
        with part.open("xb") as stream:
            stream.write(content.encode(errors="backslashreplace") if isinstance(content, str) else content)
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(part, file)
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(file)) from error
    finally:
        part.unlink(missing_ok=True)


def write_dataset(dataset: xr.Dataset, file: Path) -> None:
    """Write netCDF, compressed, whole or not at all. ``OSError`` names the file."""
    encoding = {v: {"compression": "gzip", "compression_opts": 1} for v in dataset.variables if dataset[v].ndim == 2}
    content = io.BytesIO()  # HDF5 itself does not survive a full disk: only finished bytes go there
    try:
        dataset.assign_attrs(digest=_digest(dataset)).to_netcdf(content, engine="h5netcdf", encoding=encoding)
    except OSError as error:
        raise OSError(error.errno or errno.EIO, error.strerror or str(error), str(file)) from error
    write_atomically(file, content.getbuffer())


def read_dataset(file: Path) -> xr.Dataset:
    """All of a netCDF file. ``ValueError`` in one line for what is none, or holds what a history does not."""
    import xarray as xr

    try:
        try_first(file)
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
    if dataset.attrs.pop("digest", written := _digest(dataset)) != written:
        raise ValueError(f"{file} is not what was written: damaged, or edited (then remove its attribute digest)")
    return dataset


def _digest(dataset: xr.Dataset) -> str:
    """Of all values and attributes: HDF5 has no sums of the bytes of a short variable, nor of its own headers."""
    about = {str(name): str(np.asarray(value).tolist()) for name, value in dataset.attrs.items() if name != "digest"}
    told: list[Any] = [sorted(about.items())]
    content = hashlib.sha256()
    for name, variable in sorted((str(name), variable) for name, variable in dataset.variables.items()):
        told.append((name, variable.dims, str(variable.dtype), variable.attrs.get("units")))
        content.update(np.ascontiguousarray(variable.values).tobytes())
    content.update(repr(told).encode())
    return content.hexdigest()


def examine(file: Path) -> None:
    """Raise ``ValueError`` for anything that ``file`` says of itself and that a history does not hold."""
    import h5py

    if file.exists() and not file.is_file():  # a pipe that nobody writes into would be waited for
        raise ValueError("it is no regular file")
    most = min(LARGEST_FILE, ANY_FILE + RATIO * file.stat().st_size)
    with h5py.File(file, "r") as content:
        if len(content) > MOST_VARIABLES:
            raise ValueError(f"it holds {len(content)} variables; {MOST_VARIABLES} are the most")
        _check_attributes(content, "the file")
        total = sum(_bytes_of(content, name) for name in content)
    if total > most:
        raise ValueError(f"it would take {total:.2g} bytes of memory or more ({most:.2g} are let in)")


def _bytes_of(content: Any, name: str) -> int:
    """Bytes of a variable's values and of one of its chunks, read from its description alone."""
    import h5py

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
    import h5py

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


def check_variables(variables: Mapping[str, Any]) -> None:
    """Raise ``ValueError`` for a variable whose dimensions, units, order or size are not those of a history."""
    places = [variables[name] for name in ("time", "x", "contact_x")]
    sizes = {dimension: size for one in places for dimension, size in zip(one.dims, one.values.shape)}
    for name, variable in variables.items():
        if variable.values.dtype.kind not in "fiub":
            raise ValueError(f"{name} must hold numbers (got {variable.values.dtype})")
        expected, unit = DIMENSIONS.get(name), UNITS.get(name, "")
        unknown = expected is None and set(variable.dims) <= {"time", "x", "contact"}
        if not unknown and variable.dims != expected:
            asked, got = ", ".join(expected or ("time", "x", "contact")), ", ".join(map(str, variable.dims))
            raise ValueError(f"{name} must have dimensions {asked} (got {got})")
        if not unknown and variable.attrs.get("units", "") != unit:
            raise ValueError(f"{name} must be in {unit or 'no unit'} (got {variable.attrs.get('units')!r})")
        shape = tuple(sizes[dimension] for dimension in variable.dims)
        if variable.values.shape != shape:
            raise ValueError(f"{name} must have shape {shape} (got {variable.values.shape})")
        if not np.isfinite(variable.values).all():
            raise ValueError(f"{name} is not finite")
        if np.abs(variable.values.astype(float)).max(initial=0.0) > LARGEST_VALUE:
            raise ValueError(f"{name} must not exceed {LARGEST_VALUE:g}")
    if sizes["time"] < 1 or sizes["x"] < 1 or variables["time"].values[0] < 0.0:
        raise ValueError("time must hold instants from 0 on, and x at least one node")
    for name in ("time", "x", "position"):
        if name in variables and np.any(np.diff(variables[name].values) <= 0.0):
            raise ValueError(f"{name} must increase")


def check_contents(history: Any) -> None:
    """Raise when an attribute or a variable of a stored history is anything but numbers and JSON."""
    attributes, variables = history.attrs, history.variables
    for name in ("impact", "settings", "versions", "warnings", "path", "symmetry"):
        if not isinstance(attributes[name], str):
            raise TypeError(f"attribute {name} must be text")
    for name, kind in (("impact", dict), ("settings", dict), ("versions", dict), ("warnings", list)):
        held = json.loads(attributes[name])
        if not isinstance(held, kind):
            raise TypeError(f"attribute {name} must hold a JSON {kind.__name__}")
        _plain_text(held, f"attribute {name}")
    _plain_text([history.path, *map(str, variables)], "attribute path or a variable's name")
    if not all(isinstance(line, str) for line in history.warnings):
        raise TypeError("attribute warnings must hold texts")
    for name in ("area", "section_modulus") if "section" in attributes else ():
        positive(f"attribute section: {name}", json.loads(attributes["section"])[name])
    one_of("attribute symmetry", attributes["symmetry"], ("half", "full"))
    _ = history.impact, history.steps, history.completed
    for required in REQUIRED:
        _ = variables[required]
    check_variables(variables)
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
    elif isinstance(value, dict | list):
        for item in [*value, *value.values()] if isinstance(value, dict) else value:
            _plain_text(item, where)
