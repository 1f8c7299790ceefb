"""What the thesis says in passing or could not run: element counts, the uniform mesh, Δx = 10⁻⁴ m, conditioning, and
Signorini's condition over the whole zone (4.0.6).
"""

from __future__ import annotations

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from bent_beam.meshes import GradedMesh, UniformMesh
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.chapter3_mesh import count_of
from comparison.gallery.drawing import key_below
from comparison.gallery.runs import case, reference_history, thesis_history
from comparison.studies import conditioning as conditioning_study
from comparison.studies.outcome import outcome_of
from comparison.studies.panels import contact_length, geometry
from comparison.studies.sentences import number, signed
from comparison.studies.thesis import thesis_settings
from hermite_fe import HermiteFE


@item(
    "extra-counts",
    "Element counts of 3.3.2",
    group="mesh",
    caption="Elements of the whole beam, L = 50 m, e = 1.25, as the thesis gives them and as its rules give them here.",
)
def counts(sheet: Sheet) -> str:
    cases = (
        ("κ/ν = 6.25·10⁻⁴, τ = 0.1, uniform zone", 1496, count_of(1.0 / 80.0, 0.1, 2.5e-3)),
        ("κ/ν = 0.5, τ = 0.1, uniform zone", 96, count_of(10.0, 0.1, 2.5e-3)),
        ('κ/ν = 0.5, τ = 0.1, "square" zone', 4210, count_of(10.0, 0.1, 2.5e-3, square=True)),
    )
    sheet.table(["mesh", "thesis", "ours"], [list(row) for row in cases], width=style.COLUMN + 1.0)
    return (
        "The uniform zone is twice as long as the contact zone at the end, the square one as long: with the first the "
        "counts of Table 3.2 come out too."
    )


def uniform(length: float) -> ImpactHistory:
    """The thesis's uniform mesh Δx = 2.5·10⁻³ m on a beam of a length, K = 1 1/m, τ = 0.01."""
    given = case(1.0, 0.01)
    settings = thesis_settings(given.impact, given.end_time).replace(mesh=UniformMesh(2.5e-3))
    return settings.method().simulate(given.impact.replace(length=length), end_time=given.end_time, save=200)


@item(
    "extra-uniform",
    "The uniform mesh that ran out of memory",
    group="extras",
    caption=(
        "Uniform elements Δx = 2.5·10⁻³ m, K = 1 1/m, τ = 0.01, h = 2.5·10⁻⁸ s: L = 5 m, which took the thesis "
        "8 513.72 s, "
        "and L = 50 m, which did not fit its memory."
    ),
)
def whole_beam(sheet: Sheet) -> str:
    rows: list[list[object]] = []
    for length, thesis_seconds in ((5.0, "8513.72"), (50.0, "out of memory")):
        o = outcome_of(uniform(length), "")
        rows.append(
            [f"{length:g}", round(length / 2.5e-3), thesis_seconds, o.measures["seconds"], o.measures["lift"],
             o.measures["reaction_error"]]
        )  # fmt: skip
    sheet.table(["L (m)", "elements", "thesis (s)", "ours (s)", "lift/(V₀t)", "r₀ error (%)"], rows, width=5.2)
    return "The answer is that of the graded mesh: the contact is over before the far elements matter."


@item(
    "extra-fine",
    "Elements of 10⁻⁴ m",
    group="extras",
    caption=(
        "Δx = 10⁻⁴ m, where the thesis's matrix became singular, with its other settings and no cap on the ratio of "
        "lengths, K = 1 1/m, τ = 0.01: (a) contact length, (b) geometry at the end, beside its own Δx = 2.5·10⁻³ m."
    ),
)
def fine(sheet: Sheet) -> str:
    given = case(1.0, 0.01)
    zone = thesis_settings(given.impact, given.end_time).zone
    meshes = {dx: GradedMesh(dx, 1.25, zone=zone, size_ratio=conditioning_study.UNCAPPED) for dx in (2.5e-3, 1e-4)}
    histories = {dx: thesis_history(1.0, 0.01, mesh=mesh) for dx, mesh in meshes.items()}
    found = [outcome_of(h, f"Δx = {dx:g} m", value=dx) for dx, h in histories.items()]
    with sheet.figure(1, 2, width=style.PAGE, height=2.8) as (fig, axes):
        contact_length(sheet, axes[0], found)
        geometry(sheet, axes[1], found)
        for axis, letter in zip(axes, "ab"):
            sheet.panel(axis, letter)
        key_below(fig, axes[0], 3)
    budget = histories[1e-4].energy_budget()
    largest = max(abs(v) for k, v in budget.items() if k.startswith("loss_"))
    errors = ", ".join(f"{signed(o.measures['reaction_error'])} % ({o.label})" for o in found)
    return (
        f"It runs without complaint in {number(found[1].measures['seconds'])} s and closes its energy budget to "
        f"{number(abs(budget['defect']) / largest)} of its largest loss; r₀ is off by {errors}."
    )


@item(
    "extra-conditioning",
    "Conditioning of the step's matrix",
    group="extras",
    caption=(
        "Condition in the 1-norm of the step's matrix (3.3.4) over Δx, K = 1 1/m, h = 2.5·10⁻⁸ s, e = 1.25 "
        "without a "
        "cap on the ratio of lengths: as it stands, and with deflections and rotations in one unit and the multipliers "
        "eliminated, as the solver here factors it."
    ),
)
def conditioning(sheet: Sheet) -> str:
    found = conditioning_study.sweep(case(1.0, 0.01))
    conditioning_study.draw(sheet, found)
    return conditioning_study.conclude(found)


@item(
    "extra-signorini",
    "Signorini's condition over the whole zone",
    group="extras",
    caption=(
        "The two integrals of (4.0.6) over time, K = 10 1/m: ∫y² dx over the contact zone, in units of "
        "(V₀t)²λ_c, and the "
        "impulse of the reaction, whose product must vanish: the thesis's settings with nodes, and Hermite "
        "with its own "
        "choices."
    ),
)
def signorini(sheet: Sheet) -> str:
    runs = {
        "thesis's settings": (thesis_history(10.0, 0.1, contact="node"), {"color": style.COLOURS["vermilion"]}),
        HermiteFE().label: (reference_history(10.0, 0.1, HermiteFE.path), style.mark(HermiteFE.path)),
    }
    ends = []
    with sheet.figure(1, 2, width=style.PAGE, height=2.7) as (fig, axes):
        for name, (history, line_style) in runs.items():
            zone, t = whole_zone(history), history.time
            kept = np.flatnonzero(zone > 0.0)
            kept = kept[:: max(1, kept.size // 40)] if line_style.get("marker") else kept
            sheet.line(axes[0], 1e6 * t[kept], zone[kept], series=name, **line_style)
            sheet.line(axes[1], 1e6 * t[kept], history.array("total_impulse")[kept], series=name, **line_style)
            ends.append(float(zone[-1]))
        axes[0].set_yscale("log")
        axes[0].set_ylabel(r"$\int y^2\,dx\;/\;(V_0t)^2\lambda_c$  (1)")
        axes[1].set_ylabel("impulse  (N s)")
        for axis, letter in zip(axes, "ab"):
            axis.set_xlabel("$t$  (µs)")
            sheet.panel(axis, letter)
        key_below(fig, axes[0], 2)
    return (
        f"At the end {number(ends[0])} and {number(ends[1])}. (4.0.6) asks one number of the whole zone; "
        "complementarity at "
        "every node and step, which implies it, is what the solver here asks. Its second integral must be ≥ 0 "
        "for a wall "
        "that pushes: the printed sign is wrong."
    )


def whole_zone(history: ImpactHistory) -> np.ndarray:
    """∫y² dx over (V₀t)²λ_c for nine tenths of the contact zone at each saved instant (trapezoids of nodal gaps)."""
    from comparison.studies.exact import Exact

    impact: Impact = history.impact
    exact, gap = Exact(impact), history.array("gap")
    out = np.zeros(history.time.size)
    for k, t in enumerate(history.time):
        front, x = 0.9 * float(exact.front(t)), history.positions(k)
        inside = (x >= 0.0) & (x <= front)
        if inside.sum() > 2:
            out[k] = np.trapezoid(gap[k, inside] ** 2, x[inside]) / ((impact.velocity * t) ** 2 * front)
    return out
