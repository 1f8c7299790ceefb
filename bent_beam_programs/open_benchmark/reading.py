"""Reads the files of results, bounded in size; nothing in a file is ever executed.

A result is an NPZ file, or a CSV table with a JSON file of the same stem beside it, or a history of this project
(netCDF). The bounds hold before anything is unpacked: a file of a few bytes can announce terabytes.
"""

import csv
import io
import json
import re
import zipfile
from collections.abc import Collection, Iterator
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from bent_beam.checks import shortened
from bent_beam.errors import nearest
from bent_beam_programs.open_benchmark import result as results
from bent_beam_programs.open_benchmark.result import Array, Result, ResultError, result_from_fields

__all__ = ["load_result"]

NUMBER = re.compile(r"\s*[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?|nan|inf(?:inity)?)\s*", re.A | re.I)
MOST_BYTES = 200_000_000
MOST_JSON = 10_000_000  # bytes: five million empty lists, the worst of that size, take half a gigabyte of memory
MOST_DIRECTORY = 100_000  # bytes of an NPZ's table of contents
MOST_LINE = 10_000  # characters of a line of CSV
DEEPEST = 100  # levels of metadata


def load_result(file: str | Path) -> Result:
    """Read and validate a result. Raises :class:`ResultError` with one line naming the field and what is wrong."""
    source = Path(file)
    readers = {".nc": _history, ".csv": _table, ".json": _table, ".npz": _npz}
    try:
        size = source.stat().st_size
        if not source.is_file():
            raise ResultError("is no file")
        if size > MOST_BYTES:
            raise ResultError(f"{size} bytes, {MOST_BYTES} are the most")
        if source.suffix.lower() not in readers:
            raise ResultError("must end in .npz, .csv or .json (CSV beside JSON), or .nc (a history)")
        result = readers[source.suffix.lower()](source)
        _check_depth(result.metadata)
        return result
    except (ValueError, OSError, RecursionError, OverflowError, MemoryError) as error:
        line = _one_line(error)
    if line.startswith(str(source)):
        raise ResultError(line)
    of_pair = line.startswith((f"{source.stem}.csv", f"{source.stem}.json"))  # the part of a pair that is wrong
    raise ResultError(str(source.parent / line) if of_pair else f"{source}: {line}")


def _check_depth(metadata: Any) -> None:
    """Refuse what could be read and not be written again: writers of JSON have bounds of their own."""
    level: list[Any] = [metadata]
    for _ in range(DEEPEST):
        parts = (part for whole in level for part in (whole.values() if isinstance(whole, dict) else whole))
        level = [part for part in parts if isinstance(part, dict | list)]
    if level:
        raise ResultError(f"metadata is nested more than {DEEPEST} levels deep")


def _one_line(error: BaseException) -> str:
    if isinstance(error, OSError) and error.strerror:
        return error.strerror.lower()
    return " ".join(str(error).split())[:300] or type(error).__name__


def _check_names(names: Collection[str], known: Collection[str], kind: str, where: str = "") -> None:
    for name in names:
        if name not in known:
            raise ResultError(f"{where}{shortened(name)} is not a {kind} of a result{nearest(str(name), known)}")


def _history(source: Path) -> Result:
    from bent_beam.history import ImpactHistory  # files of other codes need none of this
    from bent_beam_programs.open_benchmark.histories import result_from_history

    return result_from_history(ImpactHistory.load(source))


def _npz(source: Path) -> Result:
    _check_directory(source)
    found, where = {}, "is not a readable NPZ file"
    try:
        with zipfile.ZipFile(source) as archive:
            total = sum(item.file_size for item in archive.infolist())
        if total > 2 * MOST_BYTES:
            raise ResultError(f"would take {total:.3g} bytes unpacked, {2 * MOST_BYTES} are the most")
        with np.load(source, allow_pickle=False) as stored:
            _check_names(stored.files, (*results.COLUMNS, *results.BESIDE), "field")
            for name in stored.files:
                where = f"{name} cannot be read"
                found[name] = stored[name]
                if not isinstance(found[name], np.ndarray):
                    raise ResultError(f"{name} is no array")
    except ResultError:
        raise
    except Exception as error:  # zipfile and NumPy raise many kinds for a broken file
        raise ResultError(f"{where}: {_one_line(error)}") from None
    return result_from_fields(found)


def _check_directory(source: Path) -> None:
    """Refuse a table of contents of a million entries, which ``zipfile`` would read whole."""
    with source.open("rb") as stream:
        stream.seek(-min(source.stat().st_size, 66_000), io.SEEK_END)
        tail = stream.read()
    end = tail.rfind(b"PK\x05\x06")
    size = int.from_bytes(tail[end + 12 : end + 16], "little")
    if end >= 0 and (size > MOST_DIRECTORY or tail[max(end - 20, 0) : end].startswith(b"PK\x06\x07")):
        raise ResultError(f"its table of contents is longer than {MOST_DIRECTORY} bytes")


def _table(source: Path) -> Result:
    table, about = source.with_suffix(".csv"), source.with_suffix(".json")
    if not about.is_file():  # a pipe would never end
        raise ResultError(f"needs {about.name} beside it (outcome, problem, metadata)")
    if about.stat().st_size > MOST_JSON:
        raise ResultError(f"{about.name}: {about.stat().st_size} bytes, {MOST_JSON} are the most (NPZ takes more)")
    try:
        record = json.loads(about.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise ResultError(f"{about.name} is not JSON: {_one_line(error)}") from None
    if not isinstance(record, dict):
        raise ResultError(f"{about.name} must hold one JSON object")
    _check_names(record, results.BESIDE, "field", f"{about.name}: ")
    if table.is_file():
        record |= _columns(table)
    elif record.get("outcome") == "completed":
        raise ResultError(f"needs {table.name} beside it (tau, J, Jm)")
    return result_from_fields(record)


def _columns(table: Path) -> dict[str, Array]:
    if table.stat().st_size > MOST_BYTES:
        raise ResultError(f"{table.name}: {table.stat().st_size} bytes, {MOST_BYTES} are the most")
    values: list[list[float]] = []
    try:
        with table.open(encoding="utf-8-sig", newline="") as stream:
            rows = csv.reader(_lines(stream))
            head = [name.strip() for name in next(rows, [])]
            _check_names(head, results.COLUMNS, "column", f"{table.name}: ")
            if len(set(head)) != len(head):
                raise ResultError(f"{table.name}: a column stands twice in the first line ({', '.join(head)})")
            for line, row in enumerate(rows, start=2):
                if row:
                    values.append(_values(row, head, f"{table.name}, line {line}"))
                if len(values) > results.MOST_INSTANTS:
                    raise ResultError(f"{table.name}: more than {results.MOST_INSTANTS} instants")
    except UnicodeDecodeError as error:
        raise ResultError(f"{table.name} is not UTF-8 text: {_one_line(error)}") from None
    except csv.Error as error:
        raise ResultError(f"{table.name}: {_one_line(error)}") from None
    block = np.array(values, dtype=float).reshape(len(values), len(head))
    return {name: block[:, k] for k, name in enumerate(head)}


def _lines(stream: TextIO) -> Iterator[str]:
    """Lines of bounded length, one at a time."""
    while line := stream.readline(MOST_LINE + 1):
        if len(line) > MOST_LINE:
            raise csv.Error(f"a line is longer than {MOST_LINE} characters")
        yield line


def _values(row: list[str], head: list[str], where: str) -> list[float]:
    if len(row) != len(head):
        raise ResultError(f"{where}: {len(row)} values for {len(head)} columns")
    for name, word in zip(head, row):
        if not NUMBER.fullmatch(word):
            raise ResultError(f"{where}: {name} is not a number (got {shortened(word)})")
    return [float(word.lower().replace("d", "e")) for word in row]  # Fortran writes 1.0D-3
