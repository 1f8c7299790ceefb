"""Chapter 3, section 3.5: first order, a₀ = ±700 m/s² (V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, τ = 0.05)."""

from __future__ import annotations

import functools

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.looks import key_below
from comparison.gallery.maps import reaction_map
from comparison.studies import first_order_case as study
from comparison.studies.outcome import Outcome, outcome_of
from comparison.studies.panels import contact_length, geometry, reaction
from comparison.studies.thesis import Variant, expanding, thesis_settings

DURATION = 0.05
CASE = "V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, Δx = 2.5·10⁻³ m, h = 2.5·10⁻⁸ s, e = 1.25, ρ∞ = 0.8, nodes"
SIGNS = {-700.0: "a₀ = −700 m/s²", 0.0: "a₀ = 0", 700.0: "a₀ = 700 m/s²"}


def impact(acceleration: float) -> Impact:
    return Impact(
        bending_stiffness=1.0, mass_per_length=1.0, length=2.0, curvature=0.35, velocity=3.5, acceleration=acceleration
    )


@functools.cache
def old(acceleration: float) -> ImpactHistory:
    """The thesis's settings, its h and Δx."""
    given = impact(acceleration)
    end = DURATION * given.time_scale
    settings = thesis_settings(given, end).replace(element_length=2.5e-3, time_step=2.5e-8, contact="node")
    return Variant("", given, end, settings=settings).history()


@functools.cache
def runs(acceleration: float) -> list[Outcome]:
    """Thesis's settings, the finite beam resolved, the infinite beam."""
    given = impact(acceleration)
    end, sign = DURATION * given.time_scale, float(np.sign(acceleration))
    long = given.replace(length=1e3 * given.length_scale)
    infinite = expanding(long, end_time=end, front_resolution=0.004, interior_elements=100, decades=5.0)
    return [
        outcome_of(old(acceleration), "thesis's settings", "thesis", sign),
        outcome_of(study.finite(given, end_time=end), "finite beam resolved", "fixed", sign),
        outcome_of(infinite, "infinite beam", "hermite", sign),
    ]


def lift(outcome: Outcome) -> float:
    """Largest gap inside nine tenths of the contact zone at the end, m."""
    return float(outcome.measures["lift"] or 0.0) * outcome.impact.velocity * float(outcome.time[-1])


@item(
    "fig-3.33",
    "First order: geometry",
    group="first-order",
    caption=(
        f"Geometry at τ = 0.05 for a₀ = −700, 0 and 700 m/s²; {CASE}; resolved, finite and infinite; theory of "
        "first order."
    ),
)
def shapes(sheet: Sheet) -> str:
    with sheet.figure(1, 3, width=style.PAGE, height=2.8) as (fig, axes):
        for axis, letter, acceleration in zip(axes, "abc", SIGNS):
            geometry(sheet, axis, runs(acceleration))
            sheet.panel(axis, letter, text=SIGNS[acceleration])
        key_below(fig, axes[0], 4)
    lifts = {a: lift(runs(a)[0]) for a in SIGNS}
    return (
        f"Lift inside the zone with the thesis's settings: {1e3 * lifts[0.0]:.2g} mm for a₀ = 0 (thesis: 0.41 mm) "
        f"and {1e3 * lifts[700.0]:.2g} mm for 700 m/s² (thesis: 0.32 mm); resolved "
        f"{1e3 * abs(lift(runs(0.0)[1])):.1g} and {1e3 * abs(lift(runs(700.0)[1])):.1g} mm. For −700 m/s² the "
        "middle lifts off in theory too; at this time εα τ = "
        f"{abs(runs(-700.0)[0].impact.epsilon_alpha) * DURATION:.2g} is not small, so theory of first order is "
        "only near."
    )


def evolution(sheet: Sheet, axis: Axes, acceleration: float) -> None:
    """Geometry at several times with the thesis's settings."""
    history = old(acceleration)
    gap, x, end = history.array("gap"), history.positions(-1), float(history.time[-1])
    near = x <= 0.45
    axis.set_xlabel("$x$  (m)")
    axis.set_ylabel("deflection $y$  (mm)")
    for part, colour in zip((0.25, 0.5, 0.75, 1.0), style.SEQUENCE):
        k = int(np.argmin(np.abs(history.time - part * end)))
        sheet.line(
            axis, x[near], -1e3 * gap[k][near], series=f"t = {1e3 * history.time[k]:.2g} ms", color=colour, lw=0.9
        )
    axis.axhspan(0.0, 5.0, color="#E8E8E8", lw=0, zorder=0)
    axis.set_xlim(0, 0.45)
    axis.set_ylim(-8.0, 1.0)
    axis.legend(fontsize=6.5, loc="lower left" if acceleration > 0.0 else "lower right")


@item(
    "fig-3.34",
    "First order: geometry, contact length, reaction",
    group="first-order",
    caption=(
        "(a, b) geometry at several times with the thesis's settings, (c, d) contact length, (e, f) reaction of "
        f"one side, for a₀ = 700 (left) and −700 m/s² (right); {CASE}; resolved, finite and infinite; theory of "
        "first order, by the direct link εα = a₀√(EI/μ)/V₀³."
    ),
)
def all_of_it(sheet: Sheet) -> str:
    with sheet.figure(3, 2, width=style.PAGE, height=7.2) as (fig, axes):
        for column, acceleration in enumerate((700.0, -700.0)):
            evolution(sheet, axes[0, column], acceleration)
            contact_length(sheet, axes[1, column], runs(acceleration))
            reaction(sheet, axes[2, column], runs(acceleration))
            for row in range(3):
                sheet.panel(axes[row, column], "abcdef"[2 * row + column], text=SIGNS[acceleration] if row == 0 else "")
        key_below(fig, axes[1, 0], 4)
    return study.conclude([*runs(700.0), *runs(-700.0)]).replace("thesis's mesh", "thesis's settings")


def one_map(sheet: Sheet, acceleration: float) -> None:
    """Thesis's settings and the finite beam resolved."""
    given = impact(acceleration)
    resolved = study.finite(given, end_time=DURATION * given.time_scale)
    with sheet.figure(1, 2, width=style.PAGE, height=3.0, sharey=True) as (_, axes):
        for axis, letter, history, name in zip(
            axes, "ab", (old(acceleration), resolved), ("thesis's settings", "finite beam resolved")
        ):
            reaction_map(sheet, axis, history, LogNorm(1e-2, 1e2))
            sheet.panel(axis, letter, text=name)


@item(
    "fig-3.35",
    "Reaction in space and time, a₀ = 700 m/s²",
    group="first-order",
    caption=f"Reaction per cell over x and t for a₀ = 700 m/s²; {CASE}; theory's ±λ_c(t) (red line).",
)
def pushed(sheet: Sheet) -> str:
    one_map(sheet, 700.0)
    return (
        "Theory has the two moving forces and between them the uniform reaction μa₀: the thesis saw points here "
        "and there (a), a resolved beam carries it everywhere (b)."
    )


@item(
    "fig-3.36",
    "Reaction in space and time, a₀ = −700 m/s²",
    group="first-order",
    caption=f"Reaction per cell over x and t for a₀ = −700 m/s²; {CASE}; theory's ±λ_c(t) (red line).",
)
def pulled(sheet: Sheet) -> str:
    one_map(sheet, -700.0)
    history = old(-700.0)
    total = history.array("total_impulse")
    last = float(history.time[np.flatnonzero(np.diff(total) > 1e-6 * total[-1])[-1] + 1])
    return (
        "Only the two moving contact points push, as theory says. With the thesis's settings the last push is at "
        f"t = {1e3 * last:.2g} ms: the beam then leaves the wall (the thesis sees it leave at 3.7 ms)."
    )
