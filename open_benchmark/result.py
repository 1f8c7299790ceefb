"""Results of the open benchmark: read, bounded and validated; nothing in a file is ever executed.

An NPZ file, or a CSV table with a JSON file of the same stem beside it, or a history of this project (netCDF).
What is required: ``outcome``, ``problem`` (texts), ``tau`` (n), ``J`` (n), ``Jm`` (n), ``metadata`` (one JSON text).
All numbers are in units of μ, V₀, l* and t*: J in μV₀l*, its first moment Jm over x ≥ 0 in μV₀l*², energies in μV₀²l*,
gaps in l*. What is missing is ``None``, never zero.
"""

from __future__ import annotations

import csv
import io
import json
import math
import re
import zipfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TextIO

import numpy as np
from numpy.lib import format as npy
from numpy.typing import NDArray

from bent_beam.checks import shortened
from bent_beam.history import ImpactHistory
from bent_beam.parts import nearest
from comparison.estimators import one_side
from open_benchmark.problem import Problem, first_order_problem, problem

__all__ = ["OUTCOMES", "Result", "ResultError", "load_result", "result_from_history", "save_result"]

Array = NDArray[np.float64]

NUMBER = re.compile(r"\s*[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:[ed][-+]?\d+)?|nan|inf(?:inity)?)\s*", re.I)
OUTCOMES = ("completed", "diverged", "not_converged", "unsupported", "timeout", "crashed", "not_installed")
SERIES = ("J", "Jm", "J_minus", "x_contact", "E_kin", "E_el", "E_damp")
SNAPSHOTS = ("x", "snap_tau", "snap_gap")
TEXTS = ("outcome", "problem", "metadata")
KNOWN = (*TEXTS, "tau", *SERIES, *SNAPSHOTS, "events")
MOST_INSTANTS = 200_000
MOST_SNAPSHOTS = 2_000
MOST_POINTS = 50_000
MOST_VALUES = 8_000_000  # of all snapshots together
MOST_BYTES = 200_000_000
MOST_JSON = 10_000_000  # bytes: five million empty lists, the worst of that size, take half a gigabyte of memory
MOST_DIRECTORY = 100_000  # bytes of an NPZ's table of contents
MOST_LINE = 10_000  # characters of a line of CSV
MOST_TEXT = 200_000
MOST = 1e100  # of any number: beyond is no unit
FEWEST = 200  # instants in the fit window


class ResultError(ValueError):
    """A result that cannot be read: one line naming the field and what is wrong with it."""


@dataclass(frozen=True)
class Result:
    """One result, validated.

    outcome : what the adapter says, with what stands in brackets in ``detail``. problem : the problem it answers.
    tau, J, Jm : shape (n,); optional series of shape (n,) in ``series``; x (m,), snap_tau (s,), snap_gap (s, m) or, on
    a mesh that moves, x of shape (s, m). metadata : whatever the adapter says about itself.
    """

    outcome: str
    detail: str
    problem: Problem
    metadata: dict[str, Any]
    tau: Array | None = None
    J: Array | None = None
    Jm: Array | None = None
    series: dict[str, Array] = field(default_factory=dict)
    x: Array | None = None
    snap_tau: Array | None = None
    snap_gap: Array | None = None

    def model(self, name: str) -> float | None:
        """A number that the adapter declares of its model, in l* and t*; ``None`` when it is not reported."""
        for table in (self.metadata.get("model"), self.metadata):
            if isinstance(table, Mapping):
                value = plain_number(table.get(name))
                if value is not None:
                    return value
        return None


def plain_number(value: Any) -> float | None:
    """A finite number that somebody wrote into JSON; ``None`` for anything else."""
    if not isinstance(value, int | float) or isinstance(value, bool) or not -MOST <= value <= MOST:
        return None
    return float(value)


# --- files ---------------------------------------------------------------------------------------------------------


def load_result(file: str | Path) -> Result:
    """Read and validate a result. Raises :class:`ResultError` with one line naming the field and what is wrong."""
    source = Path(file)
    try:
        size = source.stat().st_size
        if not source.is_file():
            raise ResultError(f"{source}: is no file")
    except OSError as error:
        raise ResultError(f"{source}: {(error.strerror or str(error)).lower()}") from None
    if size > MOST_BYTES:
        raise ResultError(f"{source}: {size} bytes, {MOST_BYTES} are the most")
    kind = source.suffix.lower()
    try:
        if kind == ".nc":
            return result_from_history(ImpactHistory.load(source))
        if kind in (".csv", ".json"):
            return result_from_fields(_csv_fields(source))
        if kind == ".npz":
            return result_from_fields(_npz_fields(source))
    except ResultError as error:
        said = str(error)
        beside = said.startswith((f"{source.stem}.csv", f"{source.stem}.json"))  # of a pair, the part that is wrong
        raise ResultError(str(source.parent / said) if beside else f"{source}: {said}") from None
    except (ValueError, OSError, RecursionError, OverflowError, MemoryError) as error:
        said = _one_line(error)
        raise ResultError(said if said.startswith(str(source)) else f"{source}: {said}") from None
    raise ResultError(f"{source}: must end in .npz, .csv or .json (CSV beside JSON), or .nc (a history)")


def _one_line(error: BaseException) -> str:
    return " ".join(str(error).split())[:300] or type(error).__name__


def _npz_fields(source: Path) -> dict[str, Any]:
    _check_directory(source)
    try:
        with zipfile.ZipFile(source) as archive:
            total = sum(max(item.file_size, _announced(archive, item)) for item in archive.infolist())
    except Exception as error:  # zipfile raises many kinds for a broken file
        raise ResultError(f"is not a readable NPZ file: {_one_line(error)}") from None
    if total > 2 * MOST_BYTES:
        raise ResultError(f"would take {total:.3g} bytes unpacked, {2 * MOST_BYTES} are the most")
    found: dict[str, Any] = {}
    try:
        with np.load(source, allow_pickle=False) as stored:
            for name in stored.files:
                if name not in KNOWN:
                    raise ResultError(f"{shortened(name)} is not a field of a result{nearest(str(name), KNOWN)}")
                try:
                    found[name] = stored[name]
                except (ValueError, OSError, EOFError, zipfile.BadZipFile, KeyError, TypeError, MemoryError) as error:
                    raise ResultError(f"{name} cannot be read: {_one_line(error)}") from None
                if not isinstance(found[name], np.ndarray):
                    raise ResultError(f"{name} is no array")
    except ResultError:
        raise
    except Exception as error:  # so does NumPy
        raise ResultError(f"is not a readable NPZ file: {_one_line(error)}") from None
    return found


def _check_directory(source: Path) -> None:
    """Refuse a table of contents of a million entries, which ``zipfile`` would read whole."""
    with source.open("rb") as stream:
        stream.seek(-min(source.stat().st_size, 66_000), io.SEEK_END)
        tail = stream.read()
    end = tail.rfind(b"PK\x05\x06")
    size = int.from_bytes(tail[end + 12 : end + 16], "little")
    if end >= 0 and (size > MOST_DIRECTORY or tail[max(end - 20, 0) : end].startswith(b"PK\x06\x07")):
        raise ResultError(f"its table of contents is longer than {MOST_DIRECTORY} bytes")


def _announced(archive: zipfile.ZipFile, item: zipfile.ZipInfo) -> int:
    """Bytes that an array says it takes: NumPy would ask for them before it reads any."""
    with archive.open(item) as stream:
        try:
            version = npy.read_magic(stream)
            read = npy.read_array_header_1_0 if version == (1, 0) else npy.read_array_header_2_0
            shape, _, kind = read(stream)
        except (ValueError, SyntaxError, TypeError):  # no array: said by name when it is read
            return 0
    return kind.itemsize * math.prod(int(n) for n in shape)


def _csv_fields(source: Path) -> dict[str, Any]:
    table, about = source.with_suffix(".csv"), source.with_suffix(".json")
    if not about.exists():
        raise ResultError(f"needs {about.name} beside it (outcome, problem, metadata)")
    if about.stat().st_size > MOST_JSON:
        raise ResultError(f"{about.name}: {about.stat().st_size} bytes, {MOST_JSON} are the most (NPZ takes more)")
    try:
        record = json.loads(about.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise ResultError(f"{about.name} is not JSON: {_one_line(error)}") from None
    if not isinstance(record, dict):
        raise ResultError(f"{about.name} must hold one JSON object")
    allowed = (*TEXTS, *SNAPSHOTS, "events")
    for name in record:
        if name not in allowed:
            raise ResultError(f"{about.name}: {shortened(name)} is not a field of a result{nearest(name, allowed)}")
    if not table.exists():
        if record.get("outcome") == "completed":
            raise ResultError(f"needs {table.name} beside it (tau, J, Jm)")
        return record
    return {**record, **_columns(table)}


def _columns(table: Path) -> dict[str, Array]:
    if table.stat().st_size > MOST_BYTES:
        raise ResultError(f"{table.name}: {table.stat().st_size} bytes, {MOST_BYTES} are the most")
    allowed = ("tau", *SERIES)
    with table.open(encoding="utf-8-sig", newline="") as stream:
        return _read_columns(table, csv.reader(_lines(table, stream)), allowed)


def _lines(table: Path, stream: TextIO) -> Iterator[str]:
    """Lines of bounded length, one at a time."""
    while line := stream.readline(MOST_LINE + 1):
        if len(line) > MOST_LINE:
            raise ResultError(f"{table.name}: a line is longer than {MOST_LINE} characters")
        yield line


def _read_columns(table: Path, rows: Iterator[list[str]], allowed: tuple[str, ...]) -> dict[str, Array]:
    try:
        head = [name.strip() for name in next(rows, [])]
        for name in head:
            if name not in allowed:
                known = nearest(name, allowed)
                raise ResultError(f"{table.name}: {shortened(name)} is not a column of a result{known}")
        if len(set(head)) != len(head):
            raise ResultError(f"{table.name}: a column stands twice in the first line ({', '.join(head)})")
        values: list[list[float]] = []
        for line, row in enumerate(rows, start=2):
            if not row:
                continue
            if len(row) != len(head):
                raise ResultError(f"{table.name}, line {line}: {len(row)} values for {len(head)} columns")
            if len(values) >= MOST_INSTANTS:
                raise ResultError(f"{table.name}: more than {MOST_INSTANTS} instants")
            for name, word in zip(head, row):
                if not NUMBER.fullmatch(word):
                    raise ResultError(f"{table.name}, line {line}: {name} is not a number (got {shortened(word)})")
            values.append([float(re.sub("[dD](?=[-+0-9])", "e", word)) for word in row])  # Fortran writes 1.0D-3
    except UnicodeDecodeError as error:
        raise ResultError(f"{table.name} is not UTF-8 text: {_one_line(error)}") from None
    except csv.Error as error:
        raise ResultError(f"{table.name}: {_one_line(error)}") from None
    block = np.array(values, dtype=float).reshape(len(values), len(head))
    return {name: block[:, k] for k, name in enumerate(head)}


# --- fields --------------------------------------------------------------------------------------------------------


def result_from_fields(fields: Mapping[str, Any]) -> Result:
    """A result from its fields by name. Raises :class:`ResultError`."""
    said = _text(fields, "outcome")
    match = re.fullmatch(r"\s*(\w+)\s*(?:\((.*)\))?\s*", said, re.S)
    if match is None or match[1] not in OUTCOMES:
        raise ResultError(f"outcome must be one of {', '.join(OUTCOMES)} (got {shortened(said)})")
    name = _text(fields, "problem")
    try:
        asked = problem(name)
    except ValueError as error:
        raise ResultError(str(error)) from None
    metadata = _metadata(fields)
    detail = " ".join((match[2] or "").split())[:300]
    if match[1] != "completed":
        return Result(match[1], detail, asked, metadata)
    tau = _series(fields, "tau", None)
    if tau.size == 0:
        raise ResultError("tau is empty")
    if np.any(np.diff(tau) <= 0.0):
        at = int(np.argmax(np.diff(tau) <= 0.0))
        raise ResultError(f"tau must increase (tau[{at + 1}] = {tau[at + 1]:g} after {tau[at]:g})")
    if tau[0] < 0.0:
        raise ResultError(f"tau must not be negative (starts at {tau[0]:g})")
    low, high = asked.fit_window
    inside = int(np.sum((tau >= low * (1 - 1e-9)) & (tau <= high * (1 + 1e-9))))
    if tau[-1] < high * (1.0 - 1e-3):
        raise ResultError(f"tau ends at {tau[-1]:g}, before the record's end_time {high:g}")
    if inside < FEWEST:
        raise ResultError(f"tau holds {inside} instants in the fit window {low:g} to {high:g}, {FEWEST} are the fewest")
    series = {name: _series(fields, name, tau.size) for name in SERIES if name in fields and name not in ("J", "Jm")}
    if "J_minus" in series and series["J_minus"].min() < -1e-12 * (np.abs(series["J_minus"]).max() + 1e-300):
        raise ResultError("J_minus is the size of the tensile impulse so far: it must not be negative")
    moment = _series(fields, "Jm", tau.size) if asked.is_front or "Jm" in fields else None
    x, when, gap = _snapshots(fields)
    return Result(
        "completed", detail, asked, metadata, tau, _series(fields, "J", tau.size), moment, series, x, when, gap
    )


def _text(fields: Mapping[str, Any], name: str) -> str:
    if name not in fields:
        raise ResultError(f"{name} is missing")
    value = fields[name]
    if isinstance(value, np.ndarray):
        if value.size != 1:
            raise ResultError(f"{name} must be one text (got {value.size} values)")
        value = value.reshape(()).item()
    if isinstance(value, bytes):
        try:
            value = value.decode("utf-8")
        except UnicodeDecodeError:
            raise ResultError(f"{name} is not UTF-8 text") from None
    if not isinstance(value, str):
        raise ResultError(f"{name} must be a text (got {shortened(value)})")
    if not _is_text(value):
        raise ResultError(f"{name} holds characters that are not text")
    if len(value) > MOST_TEXT:
        raise ResultError(f"{name} has {len(value)} characters, {MOST_TEXT} are the most")
    return value


def _metadata(fields: Mapping[str, Any]) -> dict[str, Any]:
    try:
        given = fields.get("metadata")
        in_json = given is not None and not isinstance(given, np.ndarray | str | bytes)  # not as a text, as what it is
        found = given if in_json else json.loads(_text(fields, "metadata"))
        readable = _is_text(json.dumps(found, ensure_ascii=False))
    except ResultError:
        raise
    except (ValueError, RecursionError) as error:
        raise ResultError(f"metadata is not JSON: {_one_line(error)}") from None
    if not isinstance(found, dict):
        raise ResultError("metadata must hold one JSON object")
    if not readable:
        raise ResultError("metadata holds characters that are not text")
    return dict(found)


def _is_text(value: str) -> bool:
    """Whether it can be written: no halves of characters, no control codes, no writing turned round."""
    try:
        value.encode("utf-8")
    except UnicodeEncodeError:
        return False
    return not re.search(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", value)


def _numbers(fields: Mapping[str, Any], name: str) -> Array:
    value = fields[name]
    try:
        array = np.asarray(value)
    except (TypeError, ValueError, OverflowError):
        raise ResultError(f"{name} must hold numbers in rows of one length") from None
    if array.dtype.kind not in "fiu":
        raise ResultError(f"{name} must hold numbers (got {array.dtype})")
    array = np.asarray(array, dtype=float)
    if array.size > MOST_VALUES:
        raise ResultError(f"{name} holds {array.size} values, {MOST_VALUES} are the most")
    return array


def _series(fields: Mapping[str, Any], name: str, instants: int | None) -> Array:
    if name not in fields:
        raise ResultError(f"{name} is missing")
    array = _numbers(fields, name)
    if array.ndim != 1:
        raise ResultError(f"{name} must have one dimension (got shape {array.shape})")
    if array.size > MOST_INSTANTS:
        raise ResultError(f"{name} holds {array.size} instants, {MOST_INSTANTS} are the most")
    if instants is not None and array.size != instants:
        raise ResultError(f"{name} holds {array.size} values for {instants} instants of tau")
    _finite(name, array)
    return array


def _finite(name: str, array: Array) -> None:
    bad = ~(np.abs(array) <= MOST)  # not a number, infinite, or beyond any unit
    if bad.any():
        place = np.unravel_index(int(np.argmax(bad)), array.shape)
        where = ", ".join(str(int(k)) for k in place)
        raise ResultError(f"{name}[{where}] is {array[place]:g}: not a finite number of a problem in its own units")


def _snapshots(fields: Mapping[str, Any]) -> tuple[Array | None, Array | None, Array | None]:
    given = [name for name in SNAPSHOTS if name in fields]
    if not given:
        return None, None, None
    for name in SNAPSHOTS:
        if name not in given:
            raise ResultError(f"{name} is missing next to {given[0]}")
    x, when, gap = (_numbers(fields, name) for name in SNAPSHOTS)
    if when.size == 0 and gap.size == 0:
        return None, None, None  # an empty list is not reported
    if gap.size == 0:
        raise ResultError(f"snap_gap is empty (shape {gap.shape}) for {when.size} instants in snap_tau")
    if when.ndim != 1 or when.size > MOST_SNAPSHOTS:
        raise ResultError(f"snap_tau must have one dimension and at most {MOST_SNAPSHOTS} values (shape {when.shape})")
    if gap.ndim != 2 or gap.shape[0] != when.size or gap.shape[1] > MOST_POINTS:
        raise ResultError(f"snap_gap must have shape ({when.size}, points), points ≤ {MOST_POINTS} (got {gap.shape})")
    if x.shape not in ((gap.shape[1],), gap.shape):
        raise ResultError(f"x must have shape ({gap.shape[1]},) or {gap.shape} (got {x.shape})")
    for name, array in zip(SNAPSHOTS, (x, when, gap)):
        _finite(name, array)
    if when.min() < 0.0:
        raise ResultError(f"snap_tau must not be negative (got {when.min():g})")
    return x, when, gap


def save_result(file: str | Path, result: Result) -> None:
    """Write a result as NPZ."""
    stated = f"{result.outcome}({result.detail})" if result.detail else result.outcome
    arrays: dict[str, Any] = {"outcome": stated, "problem": result.problem.id, "metadata": json.dumps(result.metadata)}
    for name in ("tau", "J", "Jm", *SNAPSHOTS):
        if getattr(result, name) is not None:
            arrays[name] = getattr(result, name)
    arrays |= result.series
    np.savez_compressed(file, **arrays)


# --- this project's own histories --------------------------------------------------------------------------------


def result_from_history(history: ImpactHistory, asked: Problem | None = None) -> Result:
    """A history of this project as a result: the same numbers that any adapter hands in.

    asked : the problem that it answers; ``None`` reads it off the history's impact.
    Raises :class:`ResultError` for an impact that is none of the infinite beam's: no exact solution knows of it.
    """
    impact = history.impact
    if impact.curvature <= 0.0:
        raise ResultError("curvature must be positive: a straight beam has no isolated first touch")
    for name, why in (
        ("damping", "the exact solution has none; `bentbeam bounce` gives a damped beam's whole impact"),
        ("rotation", "the exact solution is symmetric"),
        ("first_touch", "the exact solution is symmetric"),
        ("opposite_wall", "the exact solution knows one wall"),
    ):
        if asked is None and getattr(impact, name):
            raise ResultError(f"{name} is {getattr(impact, name):g}: {why}")
    length, time = impact.length_scale, impact.time_scale
    mass = impact.mass_per_length
    impulse = mass * impact.velocity * length
    energy = mass * impact.velocity**2 * length
    end = float(history.time[-1]) / time
    asked = asked or _problem_of(history, end)
    _, moment = one_side(history)
    fixed = "position" not in history  # a mesh that expands takes in energy with the beam that it takes in
    series = {
        name: history.array(source) / energy
        for name, source in (("E_kin", "kinetic_energy"), ("E_el", "strain_energy"))
        if source in history and fixed
    }
    series["J_minus"] = _pulled(history) / impulse
    tau = history.time / time
    keep = np.unique(np.linspace(0, tau.size - 1, min(tau.size, 400)).round().astype(int))
    keep = keep[tau[keep] > 0.0]
    places = np.array([history.positions(int(k)) for k in keep]) / length
    nodes = np.sort(np.abs(places[-1]))
    settings = history.settings
    model: dict[str, Any] = {
        "time_step": _last_step(history, end) / time,
        "half_length": float(nodes[-1]),
        "smallest_element": float(np.diff(np.unique(nodes)).min()),
        "theory": "Euler-Bernoulli",
    }
    metadata = {
        "tool": f"bent-beam-impact, {history.path}",
        "version": history.versions.get("bent-beam-impact", ""),
        "seconds": history.seconds,
        "steps": history.steps,
        "settings": settings,
        "model": model,
    }
    return Result(
        "completed" if history.completed else "diverged",
        "" if history.completed else f"{end:g}",
        asked,
        metadata,
        tau,
        history.array("total_impulse") / impulse,
        moment / (impulse * length),
        series,
        places,
        tau[keep],
        history.array("gap", keep) / length,
    )


def _last_step(history: ImpactHistory, end: float) -> float:
    """The last step, s: as the settings say, or the mean one."""
    table = history.settings.get("integrator")
    whole = end * history.impact.time_scale
    if isinstance(table, dict):
        sizes = [table.get("time_step"), (table.get("growth") or 0.0) * whole]
        given = [float(size) for size in sizes if isinstance(size, int | float) and size > 0.0]
        if given:
            return max(given)
    return whole / max(history.steps, 1)


def _pulled(history: ImpactHistory) -> Array:
    """Size of the tensile impulse so far of the whole wall, N s: as the path books it, else point by point."""
    if "held_impulse" in history:
        return np.maximum.accumulate(np.abs(history.array("held_impulse")))
    pulls = np.minimum(np.diff(history.array("impulse"), axis=0), 0.0).sum(axis=1)
    return 2.0 / history.sides * np.concatenate([[0.0], np.cumsum(-pulls)])


def _problem_of(history: ImpactHistory, end: float) -> Problem:
    impact = history.impact
    loads = (impact.alpha, impact.psi, impact.chi, impact.axial)
    return first_order_problem(impact.kappa_over_nu, loads, impact.epsilon, end)
