"""Chapter 3, section 3.5: first order, a₀ = ±700 m/s² (V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, τ = 0.05)."""

import functools
from dataclasses import replace
from typing import Any

import numpy as np

from bent_beam import Impact, ImpactHistory
from bent_beam_programs.thesis.gallery.drawing import beam_at_times, draw_maps, numbers_of, plain_line
from bent_beam_programs.thesis.gallery.runs import stepped
from bent_beam_programs.thesis.sheet import Sheet, item, items
from bent_beam_programs.thesis.studies import first_order_case as study
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.outcome import Outcome, outcome_of
from bent_beam_programs.thesis.studies.panels import banded, contact_length, geometry
from bent_beam_programs.thesis.studies.thesis import MASSES
from comparison.figures import style
from hermite_fe import HermiteFE

DURATION = 0.05
THESIS_STEP = 2.5e-8  # s
ZONES = (0.35, 0.53, 0.7)
"""Where the fine elements end, m, in runs that show how much the lift depends on it (0.544 m by Table 3.2's rule)."""
CASE = (
    "V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m, Δx = 2.5·10⁻³ m, e = 1.25, ρ∞ = 0.8, nodes, lumped mass (r = 1/105), "
    "h = 2.5·10⁻⁸ s"
)
MAP = (
    f"{CASE}; cells even in x and √t, the axis of t scaled alike, so that the front is straight; theory's ±λ_c(t) "
    "(red line)"
)
SIGNS = {-700.0: "a₀ = −700 m/s²", 0.0: "a₀ = 0", 700.0: "a₀ = 700 m/s²"}
EDGE = 0.45  # m, of the figures


def impact(acceleration: float) -> Impact:
    return Impact(1.0, 1.0, length=2.0, curvature=0.35, velocity=3.5, acceleration=acceleration)


def old(acceleration: float, **changes: Any) -> Outcome:
    """A run with the study's settings of the thesis, steps ten times as long as its own, but for ``changes``."""
    given = impact(acceleration)
    end = DURATION * given.time_scale
    return replace(stepped(given, end, study.old_settings(given, end).replace(**changes)), label=study.OLD)


def own(acceleration: float, mass: str = "lumped") -> Outcome:
    """The run with the thesis's own step; mass : a key of ``MASSES``."""
    return old(acceleration, time_step=THESIS_STEP, mass=MASSES[mass])


@functools.cache
def resolved(acceleration: float, duration: float = DURATION) -> ImpactHistory:
    """Hermite with its own choices on the same finite beam."""
    given = impact(acceleration)
    return HermiteFE().simulate(given, end_time=duration * given.time_scale, save=400)


@functools.cache
def ours(acceleration: float, duration: float = DURATION) -> list[Outcome]:
    """The finite beam resolved, the infinite beam."""
    given = impact(acceleration)
    long, endless = study.infinite(given)
    history = endless.simulate(long, end_time=duration * given.time_scale, save=400)
    finite = outcome_of(resolved(acceleration, duration), study.FINITE, mark=HermiteFE.path)
    return [finite, outcome_of(history, study.INFINITE, mark=endless.path)]


@item("fig-3.33", case=CASE)
def shapes(sheet: Sheet) -> None:
    """First order: geometry

    Geometry at τ = 0.05 for a₀ = −700, 0 and 700 m/s² on one axis, as in the thesis: its settings (lines), {case};
    Hermite on the same beam with its own choices (circles); theory of first order (black, dashed). The thesis's lifts
    are 0.41 mm for a₀ = 0 and 0.32 mm for 700 m/s²; the second is not reproduced: it depends on where the fine elements
    end, because of waves that come back. For −700 m/s² the middle lifts off in theory too. At this time εατ is not
    small, so that theory of first order is only near, for both signs.
    """
    places = np.linspace(0.0, EDGE, 200)
    with sheet.figure(width=5.2, height=3.4) as (fig, axis):
        axis.set(xlabel="$x$  (m)", ylabel="deflection $y$  (mm)", xlim=(0, EDGE))
        for (acceleration, name), colour in zip(SIGNS.items(), ("vermilion", "grey", "purple")):
            thesis_run, finite = own(acceleration), ours(acceleration)[0]
            legend, near = acceleration == 0.0, thesis_run.x <= EDGE
            y = -1e3 * thesis_run.gap[near]
            sheet.line(axis, thesis_run.x[near], y, series=name, **plain_line(colour, width=1.3))
            every = np.unique(np.searchsorted(finite.x, np.linspace(0.0, EDGE, 19)).clip(0, finite.x.size - 1))
            mark = {**style.mark(HermiteFE.path), "color": style.COLOURS[colour]}
            y = -1e3 * finite.gap[every]
            sheet.line(axis, finite.x[every], y, series=f"Hermite, {name}", legend=legend, **mark)
            exact = -1e3 * finite.exact.gap(places, float(finite.time[-1]))
            sheet.line(axis, places, exact, series=f"theory, {name}", legend=legend, **{**style.THEORY, "ls": "--"})
            for label, run in (("thesis's settings", thesis_run), ("Hermite", finite)):
                sheet.numbers[f"lift (mm), {name}, {label}"] = 1e3 * run.lift
        style.wall_below(axis, -9.0, 1.0)
        pairs = sorted(zip(*axis.get_legend_handles_labels()), key=lambda pair: pair[1] not in SIGNS.values())
        short = [label.removesuffix(f", {SIGNS[0.0]}") for _, label in pairs]
        fig.legend([handle for handle, _ in pairs], short, loc="outside lower center", ncols=5, fontsize=7.0)
    for zone in ZONES:
        lift = 1e3 * old(700.0, zone=zone).lift
        sheet.numbers[f"lift (mm), {SIGNS[700.0]}, h = 2.5·10⁻⁷ s, fine to {zone:g} m"] = lift


@item("fig-3.34", case=CASE)
def all_of_it(sheet: Sheet) -> None:
    """First order: geometry, contact length, reaction

    (a, b) geometry at several times with the thesis's settings, (c, d) contact length, (e, f) reaction of one side,
    means in windows, the band holding eight tenths of that of every step, filtered as in 3.3.1, for a₀ = 700 (left) and
    −700 m/s² (right), beside a₀ = 0; {case}. Hermite and Self-similar with their own choices; theory of leading order
    (dotted), which the thesis draws, and of first order, εα = a₀√(EI/μ)/V₀³ by (3.5.5) × t*. So filtered, the reaction
    is mostly noise from 0.6 ms on. The numbers are λ₁ in m/s^(3/2) by the thesis's fit (it prints 227 and −270.8): the
    fit tends to theory's as the part of the run shrinks.
    """
    without = Exact(impact(0.0))
    with sheet.figure(3, 2, height=7.2, texts=[SIGNS[700.0], SIGNS[-700.0]], legend=3) as (_, axes):
        for column, acceleration in enumerate((700.0, -700.0)):
            name = SIGNS[acceleration]
            plain = replace(own(0.0), label=f"{study.OLD}, {SIGNS[0.0]}")
            runs = [own(acceleration), plain, *ours(acceleration)]
            history, above = runs[0].history, axes[0, column]
            times = float(history.time[-1]) * np.array([0.25, 0.5, 0.75, 1.0])
            beam_at_times(sheet, above, history, times, EDGE, lambda t: f"t = {1e3 * t:.2g} ms")
            style.wall_below(above, -8.0, 1.0)
            above.legend(fontsize=6.5, loc="upper left" if acceleration > 0.0 else "upper right")
            contact_length(sheet, axes[1, column], runs)
            banded(sheet, axes[2, column], runs)
            for axis in axes[1:, column]:
                axis.lines[1].set_linestyle("--")  # a₀ = 0
            t = float(history.time[-1]) * np.linspace(0.0, 1.0, 301)[1:] ** 2
            force = 1e-3 if "kN" in axes[2, column].get_ylabel() else 1.0
            values = (1e3 * without.front(t), force * without.side_reaction(t))
            for axis, y in zip(axes[1:, column], values):
                sheet.line(axis, 1e3 * t, y, series="theory, leading order", **{**style.THEORY, "ls": ":"})
            sheet.numbers[f"λ₁, {name}, theory"] = study.predicted(impact(acceleration))
            sheet.numbers |= {f"λ₁, {name}, {o.label}": study.fitted(o) for o in runs if o is not plain}
            sheet.numbers[f"λ₁, {name}, {runs[-1].label}, first 5 %"] = study.fitted(runs[-1], 0.05)


def last_push(history: ImpactHistory) -> float:
    """Time of the last reaction, s."""
    total = history.array("total_impulse")
    return float(history.time[np.flatnonzero(np.diff(total) > 1e-6 * total[-1])[-1] + 1])


def one_map(sheet: Sheet, acceleration: float) -> None:
    draw_maps(sheet, {study.OLD: own(acceleration).history, study.FINITE: resolved(acceleration)}, 1, 3.0)
    if acceleration < 0.0:
        sheet.numbers["R = 0 by theory of first order (ms)"] = 1e3 * Exact(impact(acceleration)).end_of_contact
        sheet.numbers["last reaction with the thesis's settings (ms)"] = 1e3 * last_push(own(acceleration).history)


items(__name__, one_map, (
    ("fig-3.35", "Reaction in space and time, a₀ = 700 m/s²",
     f"Reaction per cell over x and t for a₀ = 700 m/s²; {MAP}. Theory has the two moving forces and between them the "
     "uniform reaction μa₀: the thesis sees localised points for short times (a), a resolved beam carries it "
     "everywhere (b).",
     700.0),
    ("fig-3.36", "Reaction in space and time, a₀ = −700 m/s²",
     f"Reaction per cell over x and t for a₀ = −700 m/s²; {MAP}, drawn until its R = 0. Only the two moving contact "
     "points push, as theory and the thesis say. Then the beam leaves the wall: at 2.52 ms by theory of first order, "
     "at 2.64 ms with the thesis's settings. The thesis draws theory beyond that time and sees the beam leave at "
     "3.7 ms.",
     -700.0),
))  # fmt: skip


@item("extra-a0-17")
def left_out(sheet: Sheet) -> None:
    """The case that took 10–12 days

    a₀ = 17 m/s² until τ = 0.5 (V₀ = 3.5 m/s, K = 0.35 1/m, L = 2 m), which the thesis left out for its cost: (a)
    contact length, (b) geometry at the end, where the finite beam ends at x = 1 m; Hermite on the finite beam
    (circles), Self-similar on the infinite one (diamonds), theory of first order (black). On 2 m of beam the waves are
    long back from the ends, so that the run would have shown them and not λ₁. a₀ = 17 m/s² is εα = 0.4 here: it belongs
    to ε = 0.1 and ν = 1, while (3.5.7) gives 140 m/s² with α = 4 and ν = 0.1.
    """
    found = finite, _ = ours(17.0, 0.5)
    with sheet.figure(1, 2, height=2.8, legend=3) as (_, axes):
        contact_length(sheet, axes[0], found)
        # a centroid means nothing where the reaction is random: such points are left outside
        axes[0].set_ylim(0.0, 1.3 * float(finite.exact.front(float(finite.time[-1]))))
        geometry(sheet, axes[1], found)
        # marks are further apart than waves are long
        blue = style.mark(HermiteFE.path)["color"]
        sheet.line(axes[1], finite.x, -1e3 * finite.gap, series="Hermite, every node", legend=False, color=blue, lw=0.7)
    numbers_of(sheet, found, "contact_length_error", "seconds")
