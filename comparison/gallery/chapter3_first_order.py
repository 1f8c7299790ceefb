"""Chapter 3, section 3.5: first order, a₀ = ±700 m/s² (V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, τ = 0.05)."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY, key_below
from comparison.gallery.maps import cell_forces, colour_bar, map_norm, reaction_map
from comparison.studies import first_order_case as study
from comparison.studies.outcome import Outcome, outcome_of
from comparison.studies.panels import contact_length, geometry, reaction
from comparison.studies.sentences import number, signed
from comparison.studies.thesis import THESIS_MASS, Settings, Variant, thesis_settings
from hermite_fe import HermiteFE

DURATION = 0.05
ZONES = (0.35, 0.53, 0.7)
"""Where the fine elements end, m, in runs that show how much the lift depends on it (0.544 m by Table 3.2's rule)."""
CASE = "V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, Δx = 2.5·10⁻³ m, h = 2.5·10⁻⁷ s, e = 1.25, ρ∞ = 0.8, nodes"
SIGNS = {-700.0: "a₀ = −700 m/s²", 0.0: "a₀ = 0", 700.0: "a₀ = 700 m/s²"}


def impact(acceleration: float) -> Impact:
    return Impact(
        bending_stiffness=1.0, mass_per_length=1.0, length=2.0, curvature=0.35, velocity=3.5, acceleration=acceleration
    )


def settings(acceleration: float) -> Settings:
    """The thesis's, with its Δx, ten times its h, and the lumped masses that its numbers ask for."""
    given = impact(acceleration)
    base = thesis_settings(given, DURATION * given.time_scale)
    return base.replace(element_length=2.5e-3, time_step=2.5e-7, contact="node", mass=THESIS_MASS)


@functools.cache
def old(acceleration: float, **changes: Any) -> ImpactHistory:
    """A run with them but for ``changes`` (fields of :class:`comparison.studies.thesis.Settings`)."""
    given, chosen = impact(acceleration), settings(acceleration).replace(**changes)
    return Variant("", given, DURATION * given.time_scale, chosen.method()).history()


def old_outcome(acceleration: float, **changes: Any) -> Outcome:
    """The same, reduced to its curves."""
    return outcome_of(old(acceleration, **changes), study.OLD, value=float(np.sign(acceleration)))


def lifts_by_zone() -> str:
    """Lift for a₀ = 700 m/s² over where the fine elements end, in words."""
    rule = f"{settings(700.0).zone:.3g} m by the rule of Table 3.2"
    found = ", ".join(f"{1e3 * old_outcome(700.0, zone=zone).lift:.2g} mm for {zone:g} m" for zone in ZONES)
    return f"it depends on where the fine elements end, {rule}: {found}; waves that come back set it"


@functools.cache
def resolved(acceleration: float) -> ImpactHistory:
    """Hermite with its own choices on the same finite beam."""
    given = impact(acceleration)
    return HermiteFE().simulate(given, end_time=DURATION * given.time_scale, save=400)


@functools.cache
def runs(acceleration: float) -> list[Outcome]:
    """Thesis's settings, the finite beam resolved, the infinite beam."""
    given, sign = impact(acceleration), float(np.sign(acceleration))
    long, endless = study.infinite(given)
    history = endless.simulate(long, end_time=DURATION * given.time_scale, save=400)
    return [
        old_outcome(acceleration),
        outcome_of(resolved(acceleration), study.FINITE, value=sign, mark=HermiteFE.path),
        outcome_of(history, study.INFINITE, value=sign, mark=endless.path),
    ]


@item(
    "fig-3.33",
    "First order: geometry",
    group="first-order",
    caption=(
        "Geometry at τ = 0.05 for a₀ = −700, 0 and 700 m/s² on one axis, as in the thesis: its settings "
        f"(lines), {CASE}, "
        "lumped masses; Hermite on the same beam with its own choices (circles); theory of first order (black, dashed)."
    ),
)
def shapes(sheet: Sheet) -> str:
    colours = dict(zip(SIGNS, (style.COLOURS[c] for c in ("vermilion", "grey", "purple"))))
    with sheet.figure(width=5.2, height=3.4) as (fig, axis):
        axis.set_xlabel("$x$  (m)")
        axis.set_ylabel("deflection $y$  (mm)")
        places = np.linspace(0.0, 0.45, 200)
        for acceleration, name in SIGNS.items():
            thesis_run, finite = runs(acceleration)[:2]
            near = thesis_run.x <= 0.45
            sheet.line(
                axis,
                thesis_run.x[near],
                -1e3 * thesis_run.gap[near],
                series=name,
                color=colours[acceleration],
                lw=1.3,
            )
            every = np.unique(np.searchsorted(finite.x, np.linspace(0.0, 0.45, 19)).clip(0, finite.x.size - 1))
            sheet.line(
                axis,
                finite.x[every],
                -1e3 * finite.gap[every],
                series=f"Hermite, {name}",
                legend=acceleration == 0.0,
                **{**style.mark(HermiteFE.path), "color": colours[acceleration]},
            )
            exact = finite.exact.gap(places, float(finite.time[-1]))
            sheet.line(
                axis,
                places,
                -1e3 * exact,
                series=f"theory, {name}",
                legend=acceleration == 0.0,
                **{**THEORY, "ls": "--"},
            )
        axis.set_xlim(0, 0.45)
        style.wall_below(axis, -9.0, 1.0)
        pairs = sorted(zip(*axis.get_legend_handles_labels()), key=lambda pair: pair[1] not in SIGNS.values())
        short = [label.removesuffix(f", {SIGNS[0.0]}") for _, label in pairs]
        fig.legend([handle for handle, _ in pairs], short, loc="outside lower center", ncols=5, fontsize=7.0)
    lifts = {a: 1e3 * runs(a)[0].lift for a in SIGNS}
    ours = [number(max(1e3 * runs(a)[1].lift, 0.0)) for a in (0.0, 700.0)]
    return (
        f"Lift inside the zone with the thesis's settings and lumped masses: {lifts[0.0]:.2g} mm for a₀ = 0 "
        "(thesis: 0.41 mm) "
        f"and {lifts[700.0]:.2g} mm for 700 m/s² (thesis: 0.32 mm; {lifts_by_zone()}); "
        f"Hermite with its own choices {ours[0]} and {ours[1]} mm. "
        "For −700 m/s² the middle lifts off in theory too; at this time εα τ = "
        f"{abs(impact(-700.0).epsilon_alpha) * DURATION:.2g} is not small, so theory of first order is only near."
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
    axis.set_xlim(0, 0.45)
    style.wall_below(axis, -8.0, 1.0)
    axis.legend(fontsize=6.5, loc="upper left" if acceleration > 0.0 else "upper right")


@item(
    "fig-3.34",
    "First order: geometry, contact length, reaction",
    group="first-order",
    caption=(
        "(a, b) geometry at several times with the thesis's settings, (c, d) contact length, (e, f) reaction of "
        f"one side, for a₀ = 700 (left) and −700 m/s² (right); {CASE}; Hermite and Self-similar with their own "
        "choices; theory of "
        "first order, εα = a₀√(EI/μ)/V₀³ by (3.5.5) × t*."
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
    return study.conclude([*runs(700.0), *runs(-700.0)])


def one_map(sheet: Sheet, acceleration: float) -> None:
    """Thesis's settings and Hermite with its own choices, one colour scale."""
    histories = (old(acceleration), resolved(acceleration))
    cells = [cell_forces(h) for h in histories]
    norm = map_norm(*cells)
    with sheet.figure(1, 2, width=style.PAGE, height=3.0, sharey=True) as (fig, axes):
        for axis, letter, history, found, name in zip(axes, "ab", histories, cells, (study.OLD, study.FINITE)):
            drawn = reaction_map(sheet, axis, history, found, norm)
            sheet.panel(axis, letter, text=name)
        colour_bar(fig, axes, drawn)


MAP = (
    f"{CASE}; cells even in x and √t, the axis of t scaled alike, so that the front is straight; theory's ±λ_c(t) "
    "(red line)"
)


@item(
    "fig-3.35",
    "Reaction in space and time, a₀ = 700 m/s²",
    group="first-order",
    caption=f"Reaction per cell over x and t for a₀ = 700 m/s²; {MAP}.",
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
    caption=f"Reaction per cell over x and t for a₀ = −700 m/s²; {MAP}.",
)
def pulled(sheet: Sheet) -> str:
    one_map(sheet, -700.0)
    return (
        "Only the two moving contact points push, as theory says. With the thesis's settings the last push is at "
        f"t = {1e3 * last_push(old(-700.0)):.2g} ms: the beam then leaves the wall (the thesis sees it leave "
        "at 3.7 ms)."
    )


def last_push(history: ImpactHistory) -> float:
    """When the wall pushes for the last time, s."""
    total = history.array("total_impulse")
    return float(history.time[np.flatnonzero(np.diff(total) > 1e-6 * total[-1])[-1] + 1])


@item(
    "extra-a0-17",
    "The case that took 10–12 days",
    group="first-order-long",
    caption=(
        "a₀ = 17 m/s² until τ = 0.5 (V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m), which the thesis left out for its cost: "
        "(a) contact length, (b) geometry at the end, where the finite beam ends at x = 1 m; Hermite on the finite "
        "beam (circles), Self-similar on the infinite one (diamonds), theory of first order (black)."
    ),
)
def left_out(sheet: Sheet) -> str:
    given = impact(17.0)
    end = 0.5 * given.time_scale
    long, endless = study.infinite(given)
    finite = outcome_of(HermiteFE().simulate(given, end_time=end, save=400), study.FINITE, mark=HermiteFE.path)
    infinite = outcome_of(endless.simulate(long, end_time=end, save=400), study.INFINITE, mark=endless.path)
    with sheet.figure(1, 2, width=style.PAGE, height=2.8) as (fig, axes):
        contact_length(sheet, axes[0], [finite, infinite])
        # a centroid means nothing where rows push at random: such points are left outside
        axes[0].set_ylim(0.0, 1.3 * float(finite.exact.front(end)))
        geometry(sheet, axes[1], [finite, infinite])
        blue = style.mark(HermiteFE.path)["color"]  # joins the marks, which are further apart than the waves are long
        sheet.line(axes[1], finite.x, -1e3 * finite.gap, series="Hermite, every node", legend=False, color=blue, lw=0.7)
        for axis, letter in zip(axes, "ab"):
            sheet.panel(axis, letter)
        key_below(fig, axes[0], 3)
    seconds = ", ".join(f"{number(o.measures['seconds'])} s ({o.label})" for o in (finite, infinite))
    ends = ", ".join(f"{signed(o.measures['contact_length_error'])} % ({o.label})" for o in (finite, infinite))
    return (
        f"Computed in {seconds}; the thesis estimated 10–12 days. λ_c at the end is off theory by {ends}: on 2 m "
        "of beam waves are long back from the ends, so that the run would have shown them and not λ₁. "
        f"a₀ = 17 m/s² is εα = {given.epsilon_alpha:.2g} here: it belongs to ε = 0.1 and ν = 1, while (3.5.7) gives "
        "140 m/s² with α = 4 and ν = 0.1."
    )
