"""What one run did and found, for programs and for readers: the contract of ``bentbeam simulate --json``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from bent_beam.checks import one_of
from bent_beam.errors import SimulationError
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.method import Method, refined
from bent_beam.section import Section
from comparison.compared import Compared
from comparison.estimators import Estimate, Moments, leading_order, moments
from comparison.match import COMPANIONS, INSTANTS, without_companion
from comparison.reduction import hold_of, peak_moment, pull_of
from comparison.text_table import text_table
from comparison.whole_impact.hits import hits
from theory import predict

__all__ = ["companions", "run_table", "summary"]


def companions(
    method: Method, impact: Impact, end_time: float, error_bars: str
) -> tuple[list[Moments], list[str]]:
    """Runs at other resolutions, reduced, for the error bars of λ₀ and r₀, and a warning for each that could not
    finish; neither where λ₀ and r₀ are not estimated.

    error_bars : a key of :data:`comparison.match.COMPANIONS`.
    """
    one_of("error_bars", error_bars, COMPANIONS)
    found: list[Moments] = []
    lost: list[str] = []
    if comparable(impact) and not impact.loaded and predict(impact, [end_time]).times[0].valid:
        for factor in COMPANIONS[error_bars]:
            other = refined(method, factor)
            if other is not None:
                try:
                    found.append(moments(other.simulate(impact, end_time=end_time, save=INSTANTS)))
                except (SimulationError, ValueError) as error:  # a coarser run may be too coarse
                    lost.append(without_companion(factor, error))
    return found, lost


def comparable(impact: Impact) -> bool:
    """Whether the theory has an answer at all: a bow, symmetric about its first touch."""
    return impact.relative_curvature > 0.0 and not impact.off_centre


def summary(
    history: ImpactHistory,
    file: Path | None = None,
    section: Section | None = None,
    others: Sequence[Moments] = (),
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
            leading = leading_order(found, companions=others)
        except ValueError:
            pass
    front = found.front[-1]
    peak = peak_moment(history)
    return {
        "path": history.path,
        "symmetry": history.symmetry,
        "settings": history.settings,
        "versions": history.versions,
        "steps": history.steps,
        "seconds": history.seconds,
        "time": end,
        "half_contact_length": Compared(front * impact.length_scale, None, row.half_contact_length if row else None),
        "total_impulse": Compared(history.array("total_impulse")[-1], None, row.impulse if row else None),
        "lambda0": _estimated(
            None if leading is None else leading.lambda0, None if infinite is None else infinite.lambda0
        ),
        "r0": _estimated(None if leading is None else leading.r0, None if infinite is None else infinite.r0),
        "lift": found.lift[-1],
        "pull": pull_of(history),
        "hold": hold_of(history),
        "peak_moment": peak.moment,
        "peak_moment_place": peak.place,
        "peak_moment_time": peak.time,
        "peak_stress": None if section is None else section.stress(peak.moment, impact.axial_force),
        "yield_stress": None if section is None else section.yield_stress,
        "energy": energy_at_end(history),
        "hits": [asdict(hit) for hit in hits(history)] if _hits_apart(impact) else None,
        "warnings": history.warnings,
        "file": None if file is None else str(file),
    }


def _hits_apart(impact: Impact) -> bool:
    """Whether an impact is one of several hits: between two walls, or of a beam that rocks."""
    return impact.opposite_wall is not None or impact.off_centre


def _estimated(found: Estimate | None, theory: float | None) -> Compared:
    return Compared(theory=theory) if found is None else Compared(found.value, found.error, theory)


def energy_at_end(history: ImpactHistory) -> dict[str, float | None]:
    """The energies at the end, J, what was lost on the way, by cause, and the defect: what these do not explain."""
    budget = history.energy_budget()
    names = ("work_of_loads", "loss_impact", "loss_algorithmic", "loss_viscous", "loss_material", "loss_absorbed")
    return {
        "initial": budget["initial_energy"],
        "kinetic": float(history.array("kinetic_energy")[-1]),
        "strain": float(history.array("strain_energy")[-1]),
        **{name: budget.get(name) for name in names},
        "defect": budget["defect"],
    }


def run_table(found: dict[str, Any]) -> str:
    """The summary of one run for a reader."""

    def number(value: float | None) -> str:
        return "-" if value is None else f"{value:.6g}"

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
            bar = "" if c.error is None else f"{c.error:.1g}"
            lines.append([name, number(c.value), bar, unit, theory])
    lines += [
        ["largest bending moment", number(found["peak_moment"]), "", "N m", ""],
        *([["largest stress", number(found["peak_stress"]), "", "Pa", ""]] if found["peak_stress"] is not None else []),
        ["lift of the zone over V0 t", number(found["lift"]), "", "1", ""],
        ["largest pull over largest push", number(found["pull"]), "", "1", ""],
    ]
    energy = found["energy"]
    for name, value in energy.items():
        if value is not None:
            titles = {"kinetic": "kinetic energy at the end", "strain": "strain energy at the end"}
            title = titles.get(name, "initial energy" if name == "initial" else name.replace("_", " "))
            lines.append([title, number(value), "", "J", ""])
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


def _hits_table(rows: Sequence[dict[str, Any]]) -> str:
    head = ["hit", "wall", "from, s", "to, s", "mean |x|, m", "impulse, N s", "V after, m/s", "energy, J", "lost, J"]
    names = ("begin", "end", "place", "impulse", "velocity", "energy", "lost")
    body = [[str(i), row["wall"], *(f"{row[name]:.5g}" for name in names)] for i, row in enumerate(rows, 1)]
    return text_table(head, body)
