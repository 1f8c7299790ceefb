"""What a method is: a path to the answer with its settings and a label. Anybody's package may bring one.

A method is a small frozen dataclass. Its package names it in the entry-point group ``bentbeam.methods``::

    [project.entry-points."bentbeam.methods"]
    my_code = "my_package:MyMethod"

and from then on ``bentbeam simulate --path my_code``, ``match``, ``study`` and ``report`` know it;
with ``for_whole_beam`` ``bounce`` and ``sweep`` do, too. Nothing in this project needs to be touched.
"""

import contextlib
import dataclasses
import math
import os
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from typing import Any, ClassVar, NoReturn, Protocol, TypeVar, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import shortened, whole
from bent_beam.errors import ANY_FAILURE, InputError, SimulationError, TimeLimitError, nearest, unknown_key
from bent_beam.fields import declared, describe, part_or_auto
from bent_beam.free_flight import is_over
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.modes import lowest_mode

GROUP = "bentbeam.methods"
Save = int | Sequence[float] | NDArray[np.float64]
Progress = Callable[[float], None]
"""Called with the finished fraction."""
M = TypeVar("M")


@runtime_checkable
class Method(Protocol):
    """A way to simulate an impact.

    Optional next to what stands below: ``chosen_for(impact, end_time)``, ``refined(factor)``,
    ``for_whole_beam(impact)`` and ``simulate_to_separation(impact, …)`` (see the functions of these names);
    ``cross_checks(impact)`` (cause → a method to compare with, for the error bars of a whole impact; under
    ``contact_law_coarser`` one for the run on half of the elements) and
    ``varied(impact, random)`` (a copy with mesh, steps and contact law drawn at random, for a band);
    ``perturbation`` (by how much of y₀ the largest load of a first-order row may change it);
    ``PARTS`` (field → registry of kinds), for methods made from tables; ``DEFAULT_KINDS`` (field → kind), those that
    a table means that names none.
    """

    path: ClassVar[str]
    """Name of the path, as on the command line."""

    @property
    def label(self) -> str:
        """How rows, curves and tables call it."""

    def refuses(self, impact: Impact) -> str | None:
        """Why this method cannot take the impact, naming the field (``None``: it can)."""

    def simulate(
        self, impact: Impact, *, end_time: float | None = None, save: Save = 200, progress: Progress | None = None
    ) -> ImpactHistory:
        """Follow ``impact`` to ``end_time`` (s). ``save``: about how many instants are saved, or their times, s.

        Raises :class:`bent_beam.InputError` for what it refuses, :class:`bent_beam.SimulationError` when it cannot
        finish; any other error is a failure too.
        """


def checked_times(save: Any, end: float) -> NDArray[np.float64]:
    """Times to save, s: finite, increasing, from 0 to ``end``; ``ValueError`` otherwise."""
    try:
        times = np.asarray(save, float)
    except (TypeError, ValueError):
        times = np.array(np.nan)
    if times.ndim != 1 or times.size < 1 or not np.all(np.isfinite(times)):
        raise InputError("save must be a whole number, or a list of finite times")
    if np.any(np.diff(times) <= 0.0) or times[0] < 0.0 or times[-1] > end * (1.0 + 1e-9):
        raise InputError(f"save must hold increasing times from 0 to the end time {float(end)!r}")
    return times


def chosen_for(method: M, impact: Impact, end_time: float) -> M:
    """``method`` with everything that it leaves open chosen for ``impact``, so that other impacts are then simulated on
    the same mesh with the same steps; the method itself where it has no such choices."""
    choose = getattr(method, "chosen_for", None)
    return method if choose is None else choose(impact, end_time)


def refined(method: M, factor: float) -> M | None:
    """``method`` with elements and steps ``factor`` times finer; ``None`` where it does not know how."""
    refine = getattr(method, "refined", None)
    if refine is None:
        return method if factor == 1.0 else None
    return refine(factor)


def for_whole_beam(method: M, impact: Impact) -> M:
    """``method`` with what it leaves open chosen for the whole beam from first touch to last separation: strictly
    unilateral, nothing absorbed; the method itself where it has no such choices."""
    choose = getattr(method, "for_whole_beam", None)
    return method if choose is None else choose(impact)


@contextlib.contextmanager
def no_way_out() -> Iterator[None]:
    """Within, ``os._exit`` raises ``SystemExit``: a method that ends its process would end all rows with it."""
    leave, here = os._exit, os.getpid()

    def ended(status: int) -> NoReturn:
        if os.getpid() != here or threading.current_thread() is not threading.main_thread():
            leave(status)
        raise SystemExit(f"os._exit({status})")

    os._exit = ended
    try:
        yield
    finally:
        os._exit = leave


def simulated(run: Callable[..., ImpactHistory], impact: Impact, **how: Any) -> ImpactHistory:
    """The history that ``run``, a method's, returns. Raises what a method may raise, and
    :class:`bent_beam.SimulationError` for all else that somebody's method does."""
    try:
        with contextlib.chdir(os.getcwd()), no_way_out():  # and back, wherever it went
            history = run(impact, **how)
    except (InputError, SimulationError, TimeLimitError, MemoryError):
        raise
    except ANY_FAILURE as error:
        raise SimulationError(f"the method failed: {type(error).__name__}: {error}") from error
    if not isinstance(history, ImpactHistory):
        raise SimulationError(f"the method failed: it returned {type(history).__name__}, not a history")
    return history


LONGEST, LONGEST_OF_WALL = 8.0, 100.0  # T*: a beam still on its wall is given up then; on a soft one then at the latest
ON_WALL = 3.0  # times `time_on_wall`: given up then on a soft wall. A load that presses nearly doubles the time on it
SAVED_LATE = 200  # instants a T* after LONGEST, while a soft wall pushes on
FARTHEST = 20.0  # T*: a longer flight to the wall is not waited for


def time_on_wall(impact: Impact) -> float:
    """How long a rigid beam is on the springs of its wall, s; 0 on a rigid wall. Straight, π√(m/kL); a bow touches in
    part, F = (4/3)k√(2/K) δ^{3/2}, for 2.94 δ/V₀ with ½mV₀² = (8/15)k√(2/K) δ^{5/2}, as of Hertz's contact."""
    if impact.wall_stiffness is None:
        return 0.0
    (begin, end), mass = impact.wall_span, impact.mass_per_length * impact.length
    straight = math.pi * math.sqrt(mass / (impact.wall_stiffness * ((end - begin) or 1.0)))
    if begin == end or impact.relative_curvature <= 0.0:
        return straight
    root = math.sqrt(0.5 * impact.relative_curvature)
    depth = (15.0 / 16.0 * mass * impact.velocity**2 * root / impact.wall_stiffness) ** 0.4
    return max(straight, 2.94 * depth / impact.velocity)


def flight_to_wall(impact: Impact) -> float:
    """How long a beam without loads flies, or swings, over a clearance or up to a wall beside its apex, s."""
    place = min(max(impact.first_touch, impact.wall_span[0]), impact.wall_span[1])
    distance = impact.wall_clearance + 0.5 * impact.relative_curvature * (place - impact.first_touch) ** 2
    speed = impact.velocity * float(lowest_mode(impact, np.array(place))[0]) + impact.rotation * place
    return distance / speed if speed > 0.0 else 0.0


def separation_times(impact: Impact, longest: float | None = None, save: int = 2000) -> NDArray[np.float64]:
    """Saved instants, s, of a run until separation: ``save`` to a T*, evenly, up to ``longest``, s. By default that is
    8 T*, and before a soft wall :data:`ON_WALL` times :func:`time_on_wall`, but 100 T* at most, late instants being
    fewer; each after :func:`flight_to_wall`, of 20 T* at most.

    Raises ``ValueError`` between two walls, or where supports bring the beam back: no separation is then the last.
    """
    if impact.supported and {impact.left_end, impact.right_end} != {"hinged", "free"}:
        raise InputError(
            f"left_end {impact.left_end!r}, right_end {impact.right_end!r}: supports bring the beam back, and no "
            "separation is the last; simulate to an end time (bentbeam simulate)"
        )
    if impact.opposite_wall is not None:
        raise InputError(
            f"opposite_wall {impact.opposite_wall!r}: between two walls no separation is the last; simulate to an end "
            "time (bentbeam simulate), which lists the hits"
        )
    unit, save = impact.slow_time_scale, whole("save", save, 1)
    flight = min(flight_to_wall(impact), FARTHEST * unit)
    end = LONGEST * unit + flight if longest is None else impact.checked_end_time(longest)
    even = np.linspace(0.0, end, max(8, round(save * end / unit)) + 1)[1:]
    on_wall = min(ON_WALL * time_on_wall(impact), LONGEST_OF_WALL * unit) + flight if longest is None else 0.0
    return np.append(even, np.arange(end, on_wall, unit / min(save, SAVED_LATE))[1:])


def simulate_to_separation(
    method: Method, impact: Impact, *, longest: float | None = None, save: int = 2000, progress: Progress | None = None
) -> ImpactHistory:
    """Follow ``impact`` until the beam is off the wall, for a period of a free beam's lowest mode, and without loads
    cannot come back (:mod:`bent_beam.free_flight`).

    longest : s, where a beam that does not leave is given up (by default as :func:`separation_times` has it). save :
    saved instants a T*. A method without a way of its own is run to 1.5 T*, then twice as far and so on.
    """
    own = getattr(method, "simulate_to_separation", None)
    if own is not None:
        return simulated(own, impact, longest=longest, save=save, progress=progress)
    last = float(separation_times(impact, longest, save)[-1])
    end = min(1.5 * impact.slow_time_scale, last)
    while True:
        saved = separation_times(impact, end, save)
        history = simulated(method.simulate, impact, end_time=end, save=saved, progress=progress)
        if end >= last or is_over(history):
            return history
        end = min(2.0 * end, last)


def made_of(method: Any) -> dict[str, Any]:
    """What a method is made of, by name: all its fields but the label, as they are."""
    return {f.name: getattr(method, f.name) for f in dataclasses.fields(method) if f.name != "label"}


def settings_of(method: Any) -> dict[str, Any]:
    """A method as JSON-ready settings: its path, label and parts."""
    return {"path": method.path, **{k: v for k, v in describe(method).items() if k != "kind"}}


@cache
def _found() -> dict[str, EntryPoint]:
    return {point.name: point for point in entry_points(group=GROUP)}


def paths() -> list[str]:
    """Names of all installed paths."""
    return sorted(_found())


def method_type(path: str) -> type[Any]:
    """The class of a path. Raises :class:`InputError` for one that is not installed, does not load or is no method."""
    if path not in _found():
        raise InputError(f"path: {path!r} is not known{nearest(str(path), _found())}")
    try:
        kind = _found()[path].load()
    except ANY_FAILURE as error:  # somebody else's package may fail in any way
        reason = " ".join(str(error).split())
        raise InputError(f"path: {path!r} is installed but does not load ({type(error).__name__}: {reason})") from None
    if not (isinstance(kind, type) and dataclasses.is_dataclass(kind)):
        raise InputError(f"path: {path!r} is installed but is no dataclass (got {shortened(kind)})")
    for name in ("path", "label", "refuses", "simulate"):
        if not hasattr(kind, name) and name not in declared(kind):
            raise InputError(f"path: {path!r} is installed but its class {kind.__name__} has no {name}")
    return kind


def method_from_tables(path: str, tables: Mapping[str, Any], *, label: str | None = None) -> Any:
    """The method of a path from its tables: a part for each field in its ``PARTS``, plain values for the others.

    A part's table whose ``kind`` is "auto" is left out: the method then chooses. Raises :class:`InputError` naming key
    and value for what the method does not know or take.
    """
    kind = method_type(path)
    registries: Mapping[str, Mapping[str, type]] = getattr(kind, "PARTS", {})
    defaults: Mapping[str, str] = getattr(kind, "DEFAULT_KINDS", {})
    known = {f.name for f in dataclasses.fields(kind)} - {"label"}
    values: dict[str, Any] = {}
    for name, value in tables.items():
        if name not in known:
            raise unknown_key(path, str(name), known)
        if name not in registries:
            values[name] = value
        elif (part := part_or_auto(registries[name], value, f"{path}.{name}", defaults.get(name))) is not None:
            values[name] = part
    try:
        made = kind(**values) if label is None else dataclasses.replace(kind(**values), label=label)
    except ANY_FAILURE as error:
        raise InputError(f"{path}: {error}") from None
    if not isinstance(made.label, str):
        raise InputError(f"{path}: label must be a text (got {shortened(made.label)})")
    return made
