"""What one run did and found, for programs and for readers: the contract of ``bentbeam simulate --json``."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from bent_beam.checks import one_of
from bent_beam.errors import SimulationError
from bent_beam.free_flight import has_left
from bent_beam.history import LOSSES, ImpactHistory
from bent_beam.hysteresis import converges
from bent_beam.impact import Impact
from bent_beam.loads import unmodelled
from bent_beam.measure.balance import balance_of
from bent_beam.measure.estimators import leading_order, lift_shares
from bent_beam.measure.measured import MISSING, Measured
from bent_beam.measure.moments import Moments, element_at, first_front, half_contact_length, moments
from bent_beam.measure.reduction import WallPeaks, hold_of, peak_moment, pull_of, wall_peaks
from bent_beam.measure.whole_impact import hits, whole_impact
from bent_beam.method import Method, refined
from bent_beam.section import Section
from comparison.companions import companions_of, is_late, number_of
from comparison.match import INSTANTS
from comparison.rows import COMPANIONS
from theory import predict
from theory.prediction import MODELLED

__all__ = ["Companion", "companions", "energy_at_end", "loss_warnings", "numerical_loss", "summary"]

NUMBERS = ("half_contact_length", "total_impulse", "peak_moment", "restitution")
NOISY = 0.01  # of the largest moment: what the chatter of single nodes adds to a largest value without damping
NOTABLE_LOSS = 0.02  # of the initial energy


@dataclass(frozen=True)
class Companion:
    """What a run at another resolution says at its end: half contact length, m, impulse, N s, and largest moment, N m;
    restitution once the beam has left; peaks : of a wall that gives way; moments : for the error bars of λ₀ and r₀;
    element : the length of one at the contact's end, m, where the half length is the place of one."""

    half_contact_length: float
    total_impulse: float
    peak_moment: float
    restitution: float | None
    peaks: WallPeaks | None
    moments: Moments
    element: float

    @classmethod
    def of(cls, history: ImpactHistory) -> Companion:
        impact, found, last = history.impact, moments(history), history.time.size - 1
        spreads = _spreads_first(impact, float(history.time[-1]))
        front = _early_front(history, found) if spreads else half_contact_length(history, last)
        left = has_left(history) and impact.opposite_wall is None
        return cls(
            front,
            float(history.array("total_impulse")[-1]),
            peak_moment(history).moment,
            whole_impact(history).restitution if left else None,
            wall_peaks(history),
            found,
            0.0 if spreads else element_at(history, last, front),
        )


def _spreads_first(impact: Impact, end: float) -> bool:
    """Whether a run to ``end``, s, shows the first spread of a zone about the middle of a beam before a rigid wall."""
    other = impact.wall_stiffness is not None or impact.off_centre or impact.wall_in_part or impact.supported
    return not other and not is_late(impact, end)


def _early_front(history: ImpactHistory, found: Moments) -> float:
    """Half contact length, m, at the end of the first spread; contact points that move with it gather on their way."""
    if "contact_position" in history:
        return float(found.front[-1]) * history.impact.length_scale
    return first_front(history, history.time.size - 1)


def companions(
    method: Method,
    impact: Impact,
    end: float,
    run: Callable[[Method, int], ImpactHistory],
    error_bars: str,
    *,
    stated: bool = False,
) -> tuple[list[Companion], list[str]]:
    """Other runs to ``end``, s, reduced, for error bars, and a warning for each that could not finish.

    run : simulates with a method and a number of saved instants. error_bars : a key of
    :data:`comparison.match.COMPANIONS`; "thorough" adds a finer run. stated : the user has stated the mesh.
    """
    one_of("error_bars", error_bars, COMPANIONS)
    others = [] if error_bars == "drift" else companions_of(method, impact, end, stated=stated)
    finer = refined(method, 2.0) if error_bars == "thorough" else None
    found: list[Companion] = []
    lost: list[str] = []
    for other in others if finer is None else [*others, finer]:
        try:
            found.append(Companion.of(run(other, INSTANTS)))
        except (SimulationError, ValueError) as error:  # a coarser run may be too coarse
            lost.append(f"no companion run: {error}")
    return found, lost


def comparable(impact: Impact) -> bool:
    """Whether the theory has an answer at all: a bow, symmetric about its first touch, before a wall that it knows."""
    return impact.relative_curvature > 0.0 and not impact.off_centre and unmodelled(impact, MODELLED) is None


def summary(
    history: ImpactHistory,
    file: Path | None = None,
    section: Section | None = None,
    others: Sequence[Companion] = (),
) -> dict[str, Any]:
    """What a run did and found, SI units; the theory's numbers only where it claims to hold, stress with a section."""
    impact, time = history.impact, history.time
    several = impact.opposite_wall is not None or impact.off_centre  # hits: between two walls, or of a beam that rocks
    own, peak = Companion.of(history), peak_moment(history)
    found, end = own.moments, float(time[-1])
    infinite = predict(impact, [end]) if comparable(impact) else None
    row = infinite.times[0] if infinite and infinite.times[0].valid else None
    leading = None
    if row and not impact.loaded_to_first_order:
        try:
            leading = leading_order(found, companions=[other.moments for other in others])
        except ValueError:
            pass
    runs, least = [own, *others], {"half_contact_length": own.element}
    if not converges(impact):
        least["peak_moment"] = NOISY * own.peak_moment
    bars = {name: _bar([getattr(run, name) for run in runs], impact, least.get(name, 0.0)) for name in NUMBERS}
    for name, share in zip(("total_impulse", "half_contact_length"), lift_shares(_thrown_off(history, found))):
        if share and (bar := bars[name]) is not None:
            bars[name] = math.hypot(bar, share * getattr(own, name))
    numbers = {name: Measured(getattr(own, name), bars[name]) for name in NUMBERS}
    energy, balance = energy_at_end(history), balance_of(history)
    return {
        "path": history.path,
        "model": history.impact.model,
        "symmetry": history.symmetry,
        "settings": history.settings,
        "versions": history.versions,
        "steps": history.steps,
        "seconds": history.seconds,
        "time": end,
        "half_contact_length": replace(numbers["half_contact_length"], theory=row.half_contact_length if row else None),
        "total_impulse": replace(numbers["total_impulse"], theory=row.impulse if row else None),
        "restitution": numbers["restitution"],
        "lambda0": replace(leading.lambda0 if leading else MISSING, theory=infinite.lambda0 if infinite else None),
        "r0": replace(leading.r0 if leading else MISSING, theory=infinite.r0 if infinite else None),
        "lift": found.lift[-1],
        "pull": pull_of(history),
        "hold": hold_of(history),
        "peak_moment": peak.moment,
        "peak_moment_error": bars["peak_moment"],
        "peak_moment_place": peak.place,
        "peak_moment_time": peak.time,
        "peak_stress": None if section is None else section.stress(peak.moment, impact.axial_force),
        "peak_stress_error": None if section is None or others == [] else section.stress(bars["peak_moment"] or 0.0),
        "yield_stress": None if section is None else section.yield_stress,
        **_wall_peaks(runs, impact),
        "energy": energy,
        "numerical_loss": numerical_loss(energy),
        "momentum_residual": balance.momentum,
        "second_moment_residual": balance.second_moment,
        "contact_points_residual": balance.points,
        "initial_energy_residual": balance.initial_energy,
        "gap_of_push": balance.gap_of_push,
        "hits": [asdict(hit) for hit in hits(history)] if several else None,
        "warnings": [*history.warnings, *loss_warnings(numerical_loss(energy)), *balance.warnings],
        "file": None if file is None else str(file),
    }


def _thrown_off(history: ImpactHistory, found: Moments) -> float:
    """The largest lift of the last decade of time, V₀t, where the scheme makes it: neither a load nor damping, nor a
    wall that gives way, nor waves from the ends. The companion is thrown off, too, so that it does not show."""
    impact, time = history.impact, history.time
    may = impact.lifts or impact.damping or impact.wall_stiffness is not None
    if may or impact.off_centre or is_late(impact, float(time[-1])):
        return 0.0
    return float(found.lift[time >= 0.1 * time[-1]].max())


def _bar(numbers: Sequence[float | None], impact: Impact, least: float = 0.0) -> float | None:
    """The error bar, at least ``least``, of the first run's number; ``None`` without others."""
    values = [value for value in numbers if value is not None]
    if len(values) < 2:
        return None
    number = number_of(values, impact, least)
    return number.bar + abs(number.known - values[0])


def _wall_peaks(runs: Sequence[Companion], impact: Impact) -> dict[str, float | None]:
    """Largest force, its time, largest penetration and pressure with their error bars; ``None`` of a rigid wall, and
    the pressure of a stop."""
    peaks = [run.peaks for run in runs if run.peaks is not None]
    found: dict[str, float | None] = {"peak_force_time": peaks[0].time if peaks else None}
    for name in ("force", "penetration", "pressure"):
        values = [getattr(one, name) for one in peaks]
        known = bool(values) and not (name == "pressure" and impact.wall_span[0] == impact.wall_span[1])
        found[f"peak_{name}"] = values[0] if known else None
        found[f"peak_{name}_error"] = _bar(values, impact) if known else None
    return found


def numerical_loss(energy: dict[str, float | None]) -> float:
    """Share of the initial energy that the scheme, the mesh and its viscosity took."""
    taken = sum(energy[name] or 0.0 for name in ("loss_algorithmic", "loss_viscous"))
    return taken / (energy["initial"] or 1.0)


def loss_warnings(share: float) -> list[str]:
    """A warning where :func:`numerical_loss` is notable."""
    if share < NOTABLE_LOSS:
        return []
    return [f"time integration and grid viscosity took {100.0 * share:.2g} % of the initial energy"]


def energy_at_end(history: ImpactHistory) -> dict[str, float | None]:
    """The energies at the end, J, what was lost on the way, by cause, and the defect: what these do not explain."""
    budget = history.energy_budget()
    names = ("work_of_loads", *LOSSES)
    return {
        "initial": budget["initial_energy"],
        "kinetic": float(history.array("kinetic_energy")[-1]),
        "strain": float(history.array("strain_energy")[-1]),
        "wall": budget.get("contact_energy"),
        **{name: budget.get(name) for name in names},
        "defect": budget["defect"],
    }
