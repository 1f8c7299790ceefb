"""What the thesis mentions or could not run: the uniform mesh, Δx = 10⁻⁴ m, conditioning, and Signorini's condition
over the whole zone (4.0.6).
"""

from __future__ import annotations

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.meshes import GradedMesh, UniformMesh
from comparison.figures import style
from comparison.readable import readable
from hermite_fe import HermiteFE
from thesis.gallery.base import item
from thesis.gallery.drawing import legend_below, numbers_of, plain_line
from thesis.gallery.runs import case, reference_history, thesis_history
from thesis.sheet import Sheet
from thesis.studies import conditioning as study
from thesis.studies.base import outcomes_of
from thesis.studies.exact import Exact
from thesis.studies.outcome import Outcome, outcome_of
from thesis.studies.panels import contact_length, geometry
from thesis.studies.thesis import thesis_settings


def uniform(length: float) -> Outcome:
    """The thesis's uniform mesh Δx = 2.5·10⁻³ m on a beam of a length, K = 1 1/m, τ = 0.01."""
    given = case(1.0, 0.01)
    method = thesis_settings(given.impact, given.end_time).replace(mesh=UniformMesh(2.5e-3)).method()
    return outcome_of(method.simulate(given.impact.replace(length=length), end_time=given.end_time, save=200), "")


@item("extra-uniform")
def whole_beam(sheet: Sheet) -> None:
    """The uniform mesh that ran out of memory

    Uniform elements Δx = 2.5·10⁻³ m, K = 1 1/m, τ = 0.01, h = 2.5·10⁻⁸ s: L = 5 m, which took the thesis 8 513.72 s,
    and L = 50 m, which did not fit its memory. The answer is that of the graded mesh: the contact is over before the
    far elements matter.
    """
    rows = []
    for length, seconds in ((5.0, "8513.72"), (50.0, "out of memory")):
        m = uniform(length).measures
        rows.append([f"{length:g}", round(length / 2.5e-3), seconds, m["seconds"], m["lift"], m["reaction_error"]])
    sheet.table(["L (m)", "elements", "thesis (s)", "ours (s)", "lift/(V₀t)", "r₀ error (%)"], rows, width=5.2)


@item("extra-fine")
def fine(sheet: Sheet) -> None:
    """Elements of 10⁻⁴ m

    Δx = 10⁻⁴ m, where the thesis's matrix was close to singular, its other settings, no cap on the ratio of lengths,
    K = 1 1/m, τ = 0.01: (a) contact length, (b) geometry at the end, beside its own Δx = 2.5·10⁻³ m. It runs, and
    closes its energy budget to rounding.
    """
    given = case(1.0, 0.01)
    zone = thesis_settings(given.impact, given.end_time).zone
    found = [
        outcome_of(
            thesis_history(1.0, 0.01, mesh=GradedMesh(dx, 1.25, zone=zone, size_ratio=study.UNCAPPED)),
            f"Δx = {readable(dx)} m",
        )
        for dx in (2.5e-3, 1e-4)
    ]
    with sheet.figure(1, 2, width=style.PAGE, height=2.8) as (fig, axes):
        contact_length(sheet, axes[0], found)
        geometry(sheet, axes[1], found)
        legend_below(fig, axes[0], 3)
    numbers_of(sheet, found, "reaction_error", "seconds")
    sheet.numbers |= {f"energy residual over the largest loss, {o.label}": o.measures["defect"] for o in found}


@item("extra-conditioning")
def conditioning(sheet: Sheet) -> None:
    """Conditioning of the step's matrix

    Condition in the 1-norm of the step's matrix (3.3.4) over Δx, K = 1 1/m, h = 2.5·10⁻⁸ s, e = 1.25 without a cap on
    the ratio of lengths: as it stands, and with deflections and rotations in one unit and the multipliers eliminated,
    as the solver here factors it. The thesis reports a matrix close to singular at Δx = 10⁻⁴ m.
    """
    found = outcomes_of(study.STUDY, case(1.0, 0.01))
    study.STUDY.draw(sheet, found)
    sheet.numbers |= {f"energy residual over the largest loss, {o.label}": o.measures.get("defect") for o in found}


@item("extra-signorini")
def signorini(sheet: Sheet) -> None:
    """Signorini's condition over the whole zone

    The two integrals of (4.0.6) over time, K = 10 1/m: ∫y² dx over the contact zone, in units of (V₀t)²λ_c, and the
    impulse of the reaction, whose product must vanish: the thesis's settings with nodes, and Hermite with its own
    choices. (4.0.6) asks one number of the whole zone; complementarity at every node and step, which implies it, is
    what the solver here asks. By (3.2.7) its second integral is ≥ 0, where ≤ 0 is printed.
    """
    old = plain_line("vermilion", width=1.1)
    runs = {
        "thesis's settings": (thesis_history(10.0, 0.1, contact="node"), old),
        HermiteFE().label: (reference_history(10.0, 0.1, HermiteFE.path), style.mark(HermiteFE.path)),
    }
    with sheet.figure(1, 2, width=style.PAGE, height=2.7) as (fig, axes):
        for name, (history, line) in runs.items():
            zone, t = whole_zone(history), history.time
            kept = np.flatnonzero(zone > 0.0)
            kept = kept[:: max(1, kept.size // 40)] if line.get("marker") else kept
            sheet.line(axes[0], 1e6 * t[kept], zone[kept], series=name, **line)
            sheet.line(axes[1], 1e6 * t[kept], history.array("total_impulse")[kept], series=name, **line)
            sheet.numbers[f"∫y² dx/((V₀t)²λ_c) at the end, {name}"] = float(zone[-1])
        axes[0].set(xlabel="$t$  (µs)", ylabel=r"$\int y^2\,dx\;/\;(V_0t)^2\lambda_c$  (1)", yscale="log")
        axes[1].set(xlabel="$t$  (µs)", ylabel="impulse  (N s)")
        legend_below(fig, axes[0], 2)


def whole_zone(history: ImpactHistory) -> np.ndarray:
    """∫y² dx over (V₀t)²λ_c for nine tenths of the contact zone at each saved instant (trapezoids of nodal gaps)."""
    exact, gap = Exact(history.impact), history.array("gap")
    found = np.zeros(history.time.size)
    for k, t in enumerate(history.time):
        front, x = 0.9 * float(exact.front(t)), history.positions(k)
        inside = (x >= 0.0) & (x <= front)
        if inside.sum() > 2:
            found[k] = np.trapezoid(gap[k, inside] ** 2, x[inside]) / ((history.impact.velocity * t) ** 2 * front)
    return found
