"""One result of the open benchmark: its fields and their validation.

docs/guide/enter.md lists the fields; from ``node_impulse`` J and Jm are added up here. Numbers are in units of μ, V₀,
l* and t*: J in μV₀l*, its first moment Jm over x ≥ 0 in μV₀l*², energies in μV₀²l*, gaps in l*. A missing field is
``None`` or empty, never zero. bent_beam_programs.open_benchmark.reading reads the files.
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import shortened
from bent_beam_programs.open_benchmark.problem import Problem, problem

__all__ = ["OUTCOMES", "Result", "ResultError", "result_from_fields"]

Array = NDArray[np.float64]

OUTCOMES = (
    "completed", "diverged", "not_converged", "unsupported", "not_attempted", "timeout", "crashed", "not_installed",
)  # fmt: skip
SERIES = ("J", "Jm", "J_minus", "x_contact", "E_kin", "E_el", "E_damp")
SNAPSHOTS = ("x", "snap_tau", "snap_gap")
COLUMNS = ("tau", *SERIES)  # of a table
BESIDE = ("outcome", "problem", "metadata", *SNAPSHOTS, "snap_v", "node_x", "node_impulse", "events")  # beside it
MOST_INSTANTS = 200_000
MOST_SNAPSHOTS = 2_000
MOST_POINTS = 50_000
MOST_VALUES = 8_000_000  # of all snapshots together
MOST_TEXT = 200_000
MOST = 1e100  # of any number: beyond is no unit
INTERVALS = 50  # of the record, over each of which tension is looked for
FEWEST = 200  # instants in the fit window
NOT_TEXT = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")


class ResultError(ValueError):
    """A result that cannot be read: one line naming the field and what is wrong with it."""


class _Diverged(ResultError):
    """A number that only a run that has blown up gives."""


@dataclass(frozen=True)
class Result:
    """One result, validated.

    outcome : as the adapter states it; ``detail`` is its text in brackets. problem : the problem it answers.
    tau, J, Jm : shape (n,), empty unless completed; optional series of shape (n,) in ``series``; x (m,), snap_tau (s,),
    snap_gap (s, m) or, on a mesh that moves, x of shape (s, m); snap_v, the velocity into the wall, of snap_gap's
    shape. node_x (m,), node_impulse (n, m) : raw histories, whose sums J and Jm then are. metadata : of the adapter.
    """

    outcome: str
    detail: str
    problem: Problem
    metadata: dict[str, Any]
    tau: Array = field(default_factory=lambda: np.empty(0))
    J: Array = field(default_factory=lambda: np.empty(0))
    Jm: Array = field(default_factory=lambda: np.empty(0))
    series: dict[str, Array] = field(default_factory=dict)
    x: Array | None = None
    snap_tau: Array | None = None
    snap_gap: Array | None = None
    snap_v: Array | None = None
    node_x: Array | None = None
    node_impulse: Array | None = None
    pull_is_read_off: bool = True

    @property
    def stated(self) -> str:
        """The outcome with its detail in brackets, as the file says it."""
        return f"{self.outcome}({self.detail})" if self.detail else self.outcome

    def in_window(self, times: Array) -> NDArray[np.bool_]:
        """Which of ``times`` lie in the fit window."""
        low, high = self.problem.fit_window
        return np.asarray((times >= low * (1 - 1e-9)) & (times <= high * (1 + 1e-3)))

    def snapshots(self, of: str = "snap_gap") -> Iterator[tuple[float, Array, Array]]:
        """Time, x and gap (or ``of``: snap_v) of each snapshot in the fit window; nothing where it is not reported."""
        values = getattr(self, of)
        if self.x is None or self.snap_tau is None or values is None:
            return
        for k in np.flatnonzero(self.in_window(self.snap_tau)):
            x = self.x if self.x.ndim == 1 else self.x[k]
            order = np.argsort(x)
            yield float(self.snap_tau[k]), x[order], values[k][order]


def result_from_fields(fields: Mapping[str, Any]) -> Result:
    """A result from its fields by name. Raises :class:`ResultError`."""
    stated = _text(fields, "outcome")
    match = re.fullmatch(r"\s*(\w+)\s*(?:\((.*)\))?\s*", stated, re.S)
    if match is None or match[1] not in OUTCOMES:
        raise ResultError(f"outcome must be one of {', '.join(OUTCOMES)} (got {shortened(stated)})")
    try:
        asked = problem(_text(fields, "problem"))
    except ValueError as error:
        raise ResultError(str(error)) from None
    metadata = _metadata(fields)
    detail = " ".join((match[2] or "").split())[:300]
    if match[1] != "completed":
        return Result(match[1], detail, asked, metadata)
    try:
        return _completed(fields, asked, detail, metadata)
    except _Diverged as error:
        return Result("diverged", str(error), asked, metadata)


def _completed(fields: Mapping[str, Any], asked: Problem, detail: str, metadata: dict[str, Any]) -> Result:
    tau = _instants(fields, asked)
    arrays = _nodes(fields, tau, asked.is_symmetric)
    needed = ("J", "Jm") if asked.is_front else ("J",)
    declared = [name for name in SERIES if name not in arrays and (name in fields or name in needed)]
    arrays |= {name: _series(fields, name, tau.size) for name in declared}
    series = {name: arrays.pop(name) for name in SERIES[2:] if name in arrays}
    if "J_minus" in series and series["J_minus"].min() < -1e-12 * (np.abs(series["J_minus"]).max() + 1e-300):
        raise ResultError("J_minus is the size of the tensile impulse so far: it must not be negative")
    arrays |= {"pull_is_read_off": "J_minus" not in fields, "series": series}
    return Result("completed", detail, asked, metadata, tau, **arrays, **_snapshots(fields))


def _text(fields: Mapping[str, Any], name: str) -> str:
    value = _field(fields, name)
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
    if len(value) > MOST_TEXT:
        raise ResultError(f"{name} has {len(value)} characters, {MOST_TEXT} are the most")
    return _writable(name, value)


def _field(fields: Mapping[str, Any], name: str) -> Any:
    if name not in fields:
        raise ResultError(f"{name} is missing")
    return fields[name]


def _writable(name: str, text: str) -> str:
    """``text`` without halves of characters, control codes and changes of the writing direction."""
    if NOT_TEXT.search(text):
        raise ResultError(f"{name} holds characters that are not text")
    return text


def _metadata(fields: Mapping[str, Any]) -> dict[str, Any]:
    found = _field(fields, "metadata")
    try:
        if isinstance(found, np.ndarray | str | bytes):
            found = json.loads(_text(fields, "metadata"))
        _writable("metadata", json.dumps(found, ensure_ascii=False))
    except ResultError:
        raise
    except (ValueError, RecursionError) as error:
        raise ResultError(f"metadata is not JSON: {error}") from None
    if not isinstance(found, dict):
        raise ResultError("metadata must hold one JSON object")
    return dict(found)


def _instants(fields: Mapping[str, Any], asked: Problem) -> Array:
    tau = _series(fields, "tau", None)
    if tau.size == 0:
        raise ResultError("tau is empty")
    steps = np.diff(tau)
    if np.any(steps <= 0.0):
        k = int(np.argmax(steps <= 0.0))
        raise ResultError(f"tau must increase (tau[{k + 1}] = {tau[k + 1]:g} after {tau[k]:g})")
    if tau[0] < 0.0:
        raise ResultError(f"tau must not be negative (starts at {tau[0]:g})")
    low, high = asked.fit_window
    if tau[-1] < high * (1.0 - 1e-3):
        units = "in the problem's unit of time, t* = 1 for beams, not in s or ms"
        raise ResultError(f"tau ends at {tau[-1]:g}, before the record's end_time {high:g}: both are {units}")
    inside = int(np.sum((tau >= low * (1 - 1e-9)) & (tau <= high * (1 + 1e-9))))
    if inside < FEWEST:
        raise ResultError(f"tau holds {inside} instants in the fit window {low:g} to {high:g}, {FEWEST} are the fewest")
    return tau


def _series(fields: Mapping[str, Any], name: str, instants: int | None) -> Array:
    array = _numbers(fields, name)
    if array.ndim != 1:
        raise ResultError(f"{name} must have one dimension (got shape {array.shape})")
    if array.size > MOST_INSTANTS:
        raise ResultError(f"{name} holds {array.size} instants, {MOST_INSTANTS} are the most")
    if instants is not None and array.size != instants:
        raise ResultError(f"{name} holds {array.size} values for {instants} instants of tau")
    return array


def _numbers(fields: Mapping[str, Any], name: str) -> Array:
    given = _field(fields, name)
    try:
        array = np.asarray(given)
    except (TypeError, ValueError, OverflowError):
        raise ResultError(f"{name} must hold numbers in rows of one length") from None
    if array.size > MOST_VALUES:
        raise ResultError(f"{name} holds {array.size} values, {MOST_VALUES} are the most")
    if array.dtype.kind not in "fiu" and array.size:
        raise ResultError(f"{name} must hold numbers (got {array.dtype})")
    array = np.asarray(array, dtype=float)
    bad = ~(np.abs(array) <= MOST)  # not a number, infinite, or beyond any unit
    if bad.any():
        place = np.unravel_index(int(np.argmax(bad)), array.shape)
        where = ", ".join(str(int(k)) for k in place)
        kind = _Diverged if np.isfinite(array[place]) else ResultError
        raise kind(f"{name}[{where}] is {array[place]:g}: not a finite number of a problem in its own units")
    return array


def _nodes(fields: Mapping[str, Any], tau: Array, symmetric: bool) -> dict[str, Any]:
    """Raw nodal histories, and the wall's impulse, its moment and its tensile part, added up from them. A model of one
    half (no point at x < 0) of a symmetric problem stands for both. Tension is by how much a point falls, over one of
    ``INTERVALS``, below what it had at both ends of the one before: a scheme may give and take back."""
    if not fields.keys() & {"node_x", "node_impulse"}:
        return {}
    x, impulse = (_numbers(fields, name) for name in ("node_x", "node_impulse"))
    if x.ndim != 1 or impulse.shape != (tau.size, x.size) or not x.size:
        raise ResultError(
            f"node_impulse must have shape ({tau.size}, points of node_x) (got {impulse.shape}, {x.shape})"
        )
    sides = 2.0 if symmetric and x.min() >= -1e-9 * np.abs(x).max() else 1.0
    ends = np.unique(np.searchsorted(tau, np.linspace(0.0, tau[-1], INTERVALS + 1)))
    kept = impulse[ends]
    lost = np.maximum(np.minimum(kept[:-2], kept[1:-1]) - kept[2:], 0.0).sum(axis=1).cumsum()
    pulled = np.interp(tau, tau[ends], np.concatenate([[0.0, 0.0], lost]))
    declared = _series(fields, "J_minus", tau.size) if "J_minus" in fields else 0.0
    return {
        "node_x": x,
        "node_impulse": impulse,
        "J": sides * impulse.sum(axis=1),
        "Jm": sides / 2.0 * (impulse @ np.abs(x)),
        "J_minus": np.maximum(sides * pulled, declared),
    }


def _snapshots(fields: Mapping[str, Any]) -> dict[str, Any]:
    given = [name for name in SNAPSHOTS if name in fields]
    missing = [name for name in SNAPSHOTS if name not in fields]
    if not given:
        return {}
    if missing:
        raise ResultError(f"{missing[0]} is missing next to {given[0]}")
    x, when, gap = (_numbers(fields, name) for name in SNAPSHOTS)
    if when.size == 0 and gap.size == 0:
        return {}  # an empty list is not reported
    if gap.size == 0:
        raise ResultError(f"snap_gap is empty (shape {gap.shape}) for {when.size} instants in snap_tau")
    if when.ndim != 1 or when.size > MOST_SNAPSHOTS:
        raise ResultError(f"snap_tau must have one dimension and at most {MOST_SNAPSHOTS} values (shape {when.shape})")
    if gap.ndim != 2 or gap.shape[0] != when.size or gap.shape[1] > MOST_POINTS:
        raise ResultError(f"snap_gap must have shape ({when.size}, points), points ≤ {MOST_POINTS} (got {gap.shape})")
    if x.shape not in ((gap.shape[1],), gap.shape):
        raise ResultError(f"x must have shape ({gap.shape[1]},) or {gap.shape} (got {x.shape})")
    if when.min() < 0.0:
        raise ResultError(f"snap_tau must not be negative (got {when.min():g})")
    found = {"x": x, "snap_tau": when, "snap_gap": gap}
    if "snap_v" in fields:
        found["snap_v"] = velocity = _numbers(fields, "snap_v")
        if velocity.shape != gap.shape:
            raise ResultError(f"snap_v must have the shape of snap_gap, {gap.shape} (got {velocity.shape})")
    return found
