"""Chapter 3, sections 3.3.1, 3.3.3 and 3.3.4: time step, spectral radius and restitution; the filter."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from comparison.figures import style
from comparison.readable import readable
from thesis.gallery.base import item
from thesis.gallery.drawing import FILTER, LEGEND, REACTION, filtered_scatter, legend_below, plain_line, run_items
from thesis.gallery.runs import Series
from thesis.sheet import Sheet
from thesis.studies.panels import contact_length, energy, filtered, geometry, geometry_off, less
from thesis.studies.steps import CUT_OFF, Steps

COARSE = 1.0  # 1/m
COST = {  # h: (seconds, most iterations, mean iterations), Table 3.1
    1e-6: (90.0, 18, 5.233),
    1e-7: (235.0, 5, 1.2767),
    5e-8: (381.83, 5, 1.0933),
    2.5e-8: (715.86, 4, 1.035),
    1e-8: (1753.98, 4, 1.011),
}


STEPS = Series(COARSE, 0.01, {f"h = {readable(h)} s": {"time_step": h} for h in COST})
RADII = Series(1.0 / 40.0, 0.01, {f"ρ∞ = {r:g}": {"spectral_radius": r} for r in (1.0, 0.8, 0.5, 0.0)})
RESTITUTIONS = Series(1.0 / 40.0, 0.1, {f"restitution {e:g}": {"restitution": e} for e in (0.0, 1.0)})


COARSE_CASE = f"K = 1 1/m, t_f = 2.5·10⁻⁵ s, h = 2.5·10⁻⁸ s; {LEGEND}"
DAMPED_CASE = (
    f"K = 1/40 1/m (κ/ν = 1.25·10⁻³; the thesis prints 1.3·10⁻³), h = 2.5·10⁻⁸ s, Δx = 2.5·10⁻³ m, e = 1.25; {LEGEND}"
)
BASE = 2.5e-8  # s, the thesis's choice
BASE_STEP = f"h = {readable(BASE)} s"
run_items(__name__, (
    ("fig-3.7", "Time step: geometry", (geometry, geometry_off(BASE_STEP)), lambda: STEPS,
     f"Impact zone for several time steps, and differences from {BASE_STEP}; {COARSE_CASE}. The thesis finds a "
     "detachment of the order of 2·10⁻⁴ m whatever h."),
    ("fig-3.8", "Time step: contact length", (contact_length, less(BASE_STEP, "front", r"$\lambda_c$", "m")),
     lambda: STEPS,
     f"Contact length λ_c for several time steps, and less that of {BASE_STEP}; {COARSE_CASE}. Steps of "
     "the lines are the elements; where a line falls back, the outermost node is off the wall for a moment. Read as in "
     "the thesis (3.3.5): the first node from outside that touches or has a minimal gap; it touches below 10⁻⁶ V₀t, "
     "in the thesis below 10⁻⁶ m."),
    ("fig-3.9", "Time step: reaction", REACTION, lambda: STEPS,
     f"Reaction of one side for several time steps: {FILTER}; {COARSE_CASE}. The thesis excludes 10⁻⁶ and 10⁻⁷ s, "
     "which miss 1/√t at the start, and finds 5·10⁻⁸ s too long: the filter smooths over a number of steps, that is "
     "40, 4 and 2 times as long there (extra-filter). The impulse differs little below 10⁻⁶ s."),
    ("fig-3.17", "Spectral radius: geometry", (geometry, geometry_off("ρ∞ = 0.8")), lambda: RADII,
     f"Geometry at τ = 0.01 for several spectral radii, and differences from ρ∞ = 0.8; {DAMPED_CASE}. The values of "
     "the thesis's legend are not in its text; it sees no major change."),
    ("fig-3.18", "Spectral radius: energy", (energy, less("ρ∞ = 0.8", "energy", "$E$", "J")), lambda: RADII,
     f"Energy of the beam until τ = 0.01 for several spectral radii, and differences from ρ∞ = 0.8; {DAMPED_CASE}. As "
     "the thesis says, numerical dissipation is small against the loss in impacts, which it takes for physics. Theory "
     "conserves energy."),
    ("fig-3.19", "Restitution: geometry", (geometry,), lambda: RESTITUTIONS,
     f"Geometry at τ = 0.1 for restitution 0 and 1; {DAMPED_CASE}."),
    ("fig-3.20", "Restitution: reaction", REACTION, lambda: RESTITUTIONS,
     f"Reaction of one side until τ = 0.1 for restitution 0 and 1: {FILTER}; {DAMPED_CASE}."),
    ("fig-3.21", "Restitution: energy", (energy,), lambda: RESTITUTIONS,
     f"Energy of the beam until τ = 0.1 for restitution 0 and 1, and in free flight before; {DAMPED_CASE}. The thesis "
     "takes the loss with 0 for physics; the exact impact loses none."),
))  # fmt: skip


def in_seconds(steps: Steps) -> Steps:
    """With the smoothing, in seconds, of the thesis's step."""
    return replace(steps, cut_off=CUT_OFF * float(steps.time[0]) / BASE)


@item("extra-filter", case=COARSE_CASE.partition(";")[0].partition(", h")[0])
def filter_decides(sheet: Sheet) -> None:
    """The filter decides h

    Reaction of one side, {case}, middles, lumped mass, the time steps of Fig. 3.9: (a) filtered as in 3.3.1, the
    cut-off a share of half the sampling rate: runs with h = 10⁻⁶ s are smoothed over 40 times as many seconds as those
    with 2.5·10⁻⁸ s; (b) the same runs, all smoothed over as many seconds as with 2.5·10⁻⁸ s (10⁻⁶ s: not at all, its
    steps are longer); (c) scatter about theory in the second half of the run. With the filter per step the scatter
    grows as h falls, and at 10⁻⁶ s 1/√t is lost; with the filter in seconds all steps up to 10⁻⁷ s scatter alike. What
    the thesis compares in Fig. 3.9 to choose h is for the most part its filter.
    """
    outcomes = [o for o in STEPS.outcomes("lumped") if o.steps is not None]
    same = [replace(o, steps=in_seconds(o.steps)) for o in outcomes if o.steps is not None]
    with sheet.figure(1, 3, width=style.PAGE, height=2.7) as (fig, axes):
        for axis, shown in zip(axes, (outcomes, same)):
            filtered(sheet, axis, shown)
        axes[1].set_ylabel("")
        axes[2].set(xscale="log", xlabel="$h$  (s)", ylabel="scatter over theory  (1)")
        for name, shown, colour in (("per step", outcomes, "vermilion"), ("in seconds", same, "blue")):
            h, off = [float(o.steps.time[0]) for o in shown if o.steps], [filtered_scatter(o) for o in shown]
            sheet.line(
                axes[2], h, np.array(off, float), series=f"filter {name}", **plain_line(colour, marker="o", ms=4)
            )
            sheet.numbers |= {f"scatter, filter {name}, {o.label}": v for o, v in zip(shown, off)}
        axes[2].legend(fontsize=7)
        sheet.letter(axes, ["per step", "in seconds", ""])
        legend_below(fig, axes[0], 6, fontsize=7.0)


@item("table-3.1")
def cost(sheet: Sheet) -> None:
    """Time step: cost

    Seconds for each time step, the thesis's (on its author's computer) and ours on the same mesh and steps (on the
    machine that draws this); then Hermite and Self-similar with their own choices, which resolve the front.
    Iterations: Newton's in the thesis, rounds of the active set in ours.
    """
    found = STEPS.outcomes("lumped")
    printed = [[readable(h), *(readable(v, 6) for v in numbers)] for h, numbers in COST.items()]
    printed += [[o.label, *3 * [readable(None)]] for o in found[len(COST) :]]
    columns = ("h (s)", "thesis: time (s)", "most iterations", "mean", "ours: time (s)", "most", "mean")
    rows = [row + our_columns(o.measures) for row, o in zip(printed, found)]
    sheet.table([*columns, "steps", "lift/(V₀t)", "r₀ error (%)"], rows)


def our_columns(m: Mapping[str, float | None]) -> list[object]:
    """Our cells of Table 3.1."""
    mean = m["mean_iterations"]
    iterations = [m["most_iterations"], None if mean is None else round(mean, 4)]
    return [m["seconds"], *iterations, int(m["steps"] or 0), m["lift"], m["reaction_error"]]
