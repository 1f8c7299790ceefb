"""Chapter 3, section 3.3.1: the time step (K = 1 1/m, τ = 0.01, middles, Δx = 2.5·10⁻³ m, growth 1.25)."""

from __future__ import annotations

from collections.abc import Mapping

from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import one_panel, reaction_and_impulse
from comparison.gallery.runs import reference_runs, thesis
from comparison.studies import time_step
from comparison.studies.outcome import Outcome
from comparison.studies.panels import contact_length, geometry
from comparison.studies.sentences import between, number, varied

CURVATURE, DURATION = 1.0, 0.01
THESIS = {  # h: (seconds, most iterations, mean iterations), Table 3.1
    1e-6: (90.0, 18, 5.233),
    1e-7: (235.0, 5, 1.2767),
    5e-8: (381.83, 5, 1.0933),
    2.5e-8: (715.86, 4, 1.035),
    1e-8: (1753.98, 4, 1.011),
}
SHOWN = (
    "K = 1 1/m, t_f = 2.5·10⁻⁵ s, the thesis's settings (lines), Hermite (circles) and Self-similar (diamonds) "
    "with their "
    "own choices, theory (black)."
)


def outcomes() -> list[Outcome]:
    """One run a time step, and the references."""
    runs = [thesis(f"h = {h:g} s", CURVATURE, DURATION, value=h, time_step=h) for h in THESIS]
    return [*runs, *reference_runs(CURVATURE, DURATION)]


@item("fig-3.7", "Time step: geometry", group="time-step", caption=f"Impact zone for several time steps; {SHOWN}")
def shape(sheet: Sheet) -> str:
    found = outcomes()
    one_panel(sheet, geometry, found)
    lifted = max(float(o.gap[: max(2, o.x.size // 8)].max()) for o in varied(found)[1:])
    return (
        f"Whatever h, the thesis's settings lift the middle by about {lifted:.1e} m (thesis: 2·10⁻⁴ m). "
        f"{time_step.conclude(found)}"
    )


@item(
    "fig-3.8",
    "Time step: contact length",
    group="time-step",
    caption=f"Contact length λ_c for several time steps; {SHOWN}",
)
def length(sheet: Sheet) -> str:
    one_panel(sheet, contact_length, outcomes())
    return (
        "Steps of the lines are the elements; where a line falls back, the outermost node is off the wall for a "
        "moment. Read as the thesis does: the first node from outside that touches or has the smallest gap."
    )


@item(
    "fig-3.9",
    "Time step: reaction",
    group="time-step",
    caption=(
        f"Reaction of one side for several time steps, means over thirtieths of √t (a, peaks cut), impulse (b); {SHOWN}"
    ),
)
def force(sheet: Sheet) -> str:
    found = outcomes()
    reaction_and_impulse(sheet, found)
    noise = ", ".join(f"{number(o.measures['noise'])} % ({o.label})" for o in found[len(THESIS) :])
    return (
        "The thesis filters its force (filtfilt); here it is averaged over windows of time. Scatter about theory "
        f"in the second half: {between(varied(found), 'noise', ' %')} with the thesis's settings, "
        f"{noise}."
    )


@item(
    "table-3.1",
    "Time step: cost",
    group="time-step",
    caption=(
        "Seconds for each time step, the thesis's and ours on the same mesh and steps; then Hermite and "
        "Self-similar with their own choices, which resolve what the thesis's mesh does not."
    ),
)
def cost(sheet: Sheet) -> str:
    found = outcomes()
    rows: list[list[object]] = []
    for (h, (seconds, most, mean)), o in zip(THESIS.items(), found):
        m = o.measures
        rows.append([f"{h:g}", seconds, most, mean, *_ours(m)])
    rows += [[o.label, None, None, None, *_ours(o.measures)] for o in found[len(THESIS) :]]
    sheet.table(
        [
            "h (s)",
            "thesis: time (s)",
            "most iterations",
            "mean",
            "ours: time (s)",
            "most",
            "mean",
            "steps",
            "lift/(V₀t)",
            "r₀ error (%)",
        ],
        rows,
    )
    ratio = THESIS[2.5e-8][0] / found[3].measure("seconds")
    return (
        "Thesis: Matlab on a personal computer of 2019; ours: compiled banded loops on the machine that draws "
        f"this, about {ratio:.0e} times faster at h = 2.5·10⁻⁸ s. Iterations: Newton's in the thesis, active-set "
        "passes of the contact solve in ours."
    )


def _ours(m: Mapping[str, float | None]) -> list[object]:
    """Our columns of Table 3.1."""
    mean = m["mean_iterations"]
    return [
        m["seconds"],
        m["most_iterations"],
        None if mean is None else round(mean, 4),
        None if m["steps"] is None else int(m["steps"]),
        m["lift"],
        m["reaction_error"],
    ]
