"""What one run did and found, for programs and for readers: the contract of ``bentbeam simulate --json``."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

from bent_beam.checks import one_of
from bent_beam.errors import SimulationError
from bent_beam.history import LOSSES, ImpactHistory
from bent_beam.impact import Impact
from bent_beam.loads import unmodelled
from bent_beam.method import Method, refined
from bent_beam.section import Section
from comparison.match import INSTANTS, without_companion
from comparison.rows import COMPANIONS
from comparison.text_table import text_table
from measure.balance import balance_of
from measure.estimators import leading_order
from measure.hits import hits
from measure.measured import MISSING, Measured
from measure.moments import Moments, moments
from measure.reduction import WallPeaks, hold_of, peak_moment, pull_of, wall_peaks
from theory import predict
from theory.prediction import MODELLED

__all__ = ["Companion", "companions", "energy_at_end", "loss_warnings", "numerical_loss", "run_table", "summary"]

NUMBERS = ("half_contact_length", "total_impulse", "peak_moment")
ENERGY_TITLES = {
    "initial": "initial energy",
    "kinetic": "kinetic energy at the end",
    "strain": "strain energy at the end",
    "wall": "energy in the springs of the wall",
}
BAR = 1.5  # times what another resolution changes
NOTABLE_LOSS = 0.02  # of the initial energy


@dataclass(frozen=True)
class Companion:
    """What a run at another resolution says: half contact length, m, impulse, N s, and largest moment, N m, at its
    end; peaks : of a wall that gives way; moments : for the error bars of λ₀ and r₀."""

    half_contact_length: float
    total_impulse: float
    peak_moment: float
    peaks: WallPeaks | None
    moments: Moments

    @classmethod
    def of(cls, history: ImpactHistory) -> Companion:
        found = moments(history)
        return cls(
            float(found.front[-1]) * history.impact.length_scale,
            float(history.array("total_impulse")[-1]),
            peak_moment(history).moment,
            wall_peaks(history),
            found,
        )


def companions(
    method: Method, run: Callable[[Method, int], ImpactHistory], error_bars: str
) -> tuple[list[Companion], list[str]]:
    """Runs at other resolutions, reduced, for error bars, and a warning for each that could not finish.

    run : simulates with a method and a number of saved instants. error_bars : a key of
    :data:`comparison.match.COMPANIONS`.
    """
    one_of("error_bars", error_bars, COMPANIONS)
    found: list[Companion] = []
    lost: list[str] = []
    for factor in COMPANIONS[error_bars]:
        other = refined(method, factor)
        if other is not None:
            try:
                found.append(Companion.of(run(other, INSTANTS)))
            except (SimulationError, ValueError) as error:  # a coarser run may be too coarse
                lost.append(without_companion(factor, error))
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
    found = moments(history)
    end = float(time[-1])
    infinite = predict(impact, [end]) if comparable(impact) else None
    row = infinite.times[0] if infinite and infinite.times[0].valid else None
    leading = None
    if row and not impact.loaded:
        try:
            leading = leading_order(found, companions=[other.moments for other in others])
        except ValueError:
            pass
    own, peak = Companion.of(history), peak_moment(history)
    bars = {name: _bar(getattr(own, name), [getattr(other, name) for other in others]) for name in NUMBERS}
    stress = None if section is None else section.stress(peak.moment, impact.axial_force)
    energy, balance = energy_at_end(history), balance_of(history)
    return {
        "path": history.path,
        "symmetry": history.symmetry,
        "settings": history.settings,
        "versions": history.versions,
        "steps": history.steps,
        "seconds": history.seconds,
        "time": end,
        "half_contact_length": Measured(
            own.half_contact_length, bars["half_contact_length"], row.half_contact_length if row else None
        ),
        "total_impulse": Measured(own.total_impulse, bars["total_impulse"], row.impulse if row else None),
        "lambda0": _estimated(
            None if leading is None else leading.lambda0, None if infinite is None else infinite.lambda0
        ),
        "r0": _estimated(None if leading is None else leading.r0, None if infinite is None else infinite.r0),
        "lift": found.lift[-1],
        "pull": pull_of(history),
        "hold": hold_of(history),
        "peak_moment": peak.moment,
        "peak_moment_error": bars["peak_moment"],
        "peak_moment_place": peak.place,
        "peak_moment_time": peak.time,
        "peak_stress": stress,
        "peak_stress_error": None if section is None or others == [] else section.stress(bars["peak_moment"] or 0.0),
        "yield_stress": None if section is None else section.yield_stress,
        **_wall_peaks(impact, own, others),
        "energy": energy,
        "numerical_loss": numerical_loss(energy),
        "momentum_residual": balance.momentum,
        "initial_energy_residual": balance.initial_energy,
        "gap_of_push": balance.gap_of_push,
        "hits": [asdict(hit) for hit in hits(history)] if _hits_apart(impact) else None,
        "warnings": [*history.warnings, *loss_warnings(numerical_loss(energy)), *balance.warnings],
        "file": None if file is None else str(file),
    }


def _wall_peaks(impact: Impact, own: Companion, others: Sequence[Companion]) -> dict[str, float | None]:
    """Largest force, its time, largest penetration and pressure with their error bars; ``None`` of a rigid wall, and
    the pressure of a stop."""
    begin, end = impact.wall_span
    found: dict[str, float | None] = {"peak_force_time": None if own.peaks is None else own.peaks.time}
    for name in ("force", "penetration", "pressure"):
        missing = own.peaks is None or (name == "pressure" and begin == end)
        value = None if missing else getattr(own.peaks, name)
        coarser = [getattr(other.peaks, name) for other in others if other.peaks is not None]
        found[f"peak_{name}"] = value
        found[f"peak_{name}_error"] = None if value is None else _bar(value, coarser)
    return found


def _bar(value: float, others: Sequence[float]) -> float | None:
    """What other resolutions change, with a margin for elements of first order; ``None`` without any."""
    return BAR * max(abs(other - value) for other in others) if others else None


def numerical_loss(energy: dict[str, float | None]) -> float:
    """Share of the initial energy that the scheme, the mesh and its viscosity took."""
    taken = sum(energy[name] or 0.0 for name in ("loss_algorithmic", "loss_viscous"))
    return taken / (energy["initial"] or 1.0)


def loss_warnings(share: float) -> list[str]:
    """A warning where :func:`numerical_loss` is notable."""
    if share < NOTABLE_LOSS:
        return []
    return [f"time integration and grid viscosity took {100.0 * share:.2g} % of the initial energy"]


def _hits_apart(impact: Impact) -> bool:
    """Whether an impact is one of several hits: between two walls, or of a beam that rocks."""
    return impact.opposite_wall is not None or impact.off_centre


def _estimated(found: Measured | None, theory: float | None) -> Measured:
    return replace(found or MISSING, theory=theory)


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


def run_table(found: dict[str, Any]) -> str:
    """The summary of one run for a reader."""

    def number(value: float | None) -> str:
        return "-" if value is None else f"{value:.6g}"

    def bar(value: float | None) -> str:
        return "" if value is None else f"{value:.1g}"

    lines = []
    for name, key, unit in (
        ("half contact length", "half_contact_length", "m"),
        ("total impulse", "total_impulse", "N s"),
        ("lambda0", "lambda0", "1"),
        ("r0", "r0", "1"),
    ):
        c = found[key]
        if c.measured or c.theory is not None:
            theory = "outside its range" if c.theory is None else number(c.theory)
            lines.append([name, number(c.value), bar(c.error), unit, theory])
    lines += [
        ["largest bending moment", number(found["peak_moment"]), bar(found["peak_moment_error"]), "N m", ""],
        *_stress_line(found),
        *_wall_lines(found),
        ["lift of the zone over V0 t", number(found["lift"]), "", "1", ""],
        ["largest pull over largest push", number(found["pull"]), "", "1", ""],
    ]
    energy = found["energy"]
    for name, value in energy.items():
        if value is not None and name != "defect":
            title = ENERGY_TITLES.get(name, name.replace("_", " "))
            lines.append([title, number(value), "", "J", ""])
    lines += [
        ["energy residual", number(energy["defect"]), "", "J", ""],
        ["momentum residual over mu L V0", number(found["momentum_residual"]), "", "1", ""],
    ]
    text = [
        f"{found['path']}, {found['time']:.6g} s after first contact; "
        f"{found['steps']} steps took {found['seconds']:.2f} s",
        "",
        text_table(["", "value", "error bar", "unit", "theory"], lines),
    ]
    if found["hold"]:
        hold = found["hold"]
        pulled = "" if hold["pull"] is None else f" and pulled at most {hold['pull']:.2g} of the largest push"
        text.append(
            f"held: contact points were held until {hold['until']:.3g} s{pulled}; the gap of the zone up to then is "
            "imposed"
        )
    if found["hits"]:
        text += ["", _hits_table(found["hits"])]
    text += [f"warning: {w}" for w in found["warnings"]]
    if found["file"]:
        text.append(f"history: {found['file']}")
    return "\n".join(text)


def _stress_line(found: dict[str, Any]) -> list[list[str]]:
    if found["peak_stress"] is None:
        return []
    bar = "" if found["peak_stress_error"] is None else f"{1e-6 * found['peak_stress_error']:.1g}"
    return [["largest stress", f"{1e-6 * found['peak_stress']:.6g}", bar, "MPa", ""]]


def _wall_lines(found: dict[str, Any]) -> list[list[str]]:
    """Of a wall that gives way."""
    if found["peak_force"] is None:
        return []
    lines = [["its time", f"{found['peak_force_time']:.6g}", "", "s", ""]]
    for name, title, unit in (
        ("force", "largest force on the wall", "N"),
        ("penetration", "largest penetration", "m"),
        ("pressure", "largest pressure", "N/m"),
    ):
        bar = found[f"peak_{name}_error"]
        if found[f"peak_{name}"] is None:
            continue
        lines.append([title, f"{found[f'peak_{name}']:.6g}", "" if bar is None else f"{bar:.1g}", unit, ""])
    lines[:2] = lines[1::-1]
    return lines


def _hits_table(rows: Sequence[dict[str, Any]]) -> str:
    head = ["hit", "wall", "from, s", "to, s", "mean |x|, m", "impulse, N s", "V after, m/s", "energy, J", "lost, J"]
    names = ("begin", "end", "place", "impulse", "velocity", "energy", "lost")
    body = [[str(i), row["wall"], *(f"{row[name]:.5g}" for name in names)] for i, row in enumerate(rows, 1)]
    return text_table(head, body)
