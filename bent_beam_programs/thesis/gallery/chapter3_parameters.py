"""Chapter 3, sections 3.3.1 to 3.3.4: time step, mesh, spectral radius and restitution; the filter."""

from dataclasses import replace

import numpy as np

from bent_beam.cases import Case
from bent_beam.meshes import GradedMesh, SquareMesh
from bent_beam_programs.thesis.gallery import drawing
from bent_beam_programs.thesis.gallery.drawing import BAND, FILTER, LEGEND
from bent_beam_programs.thesis.gallery.runs import Series, case
from bent_beam_programs.thesis.sheet import Sheet, item, items
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.numerical import PER_ELEMENT
from bent_beam_programs.thesis.studies.outcome import CUT_OFF
from bent_beam_programs.thesis.studies.panels import contact_length, energy, filtered, geometry, geometry_off, less
from bent_beam_programs.thesis.studies.thesis import MASSES, thesis_settings
from comparison.figures import style
from comparison.readable import readable

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
OURS_TOO = (
    "Theory conserves energy. On a beam as flat as this Hermite's own mesh (circles) loses at least as much as the "
    "thesis's: so does any fixed mesh that does not resolve the front. Self-similar (diamonds) resolves it and loses "
    "none."
)
BASE = 2.5e-8  # s, the thesis's choice
BASE_STEP = f"h = {readable(BASE)} s"
items(__name__, drawing.run_figure, (
    ("fig-3.7", "Time step: geometry",
     f"Impact zone for several time steps, and differences from {BASE_STEP}; {COARSE_CASE}. The thesis finds a "
     "detachment of the order of 2·10⁻⁴ m whatever h.",
     STEPS, (geometry, geometry_off(BASE_STEP))),
    ("fig-3.8", "Time step: contact length",
     f"Contact length λ_c for several time steps, and less that of {BASE_STEP}; {COARSE_CASE}. Steps of "
     "the lines are the elements; where a line falls back, the outermost node is off the wall for a moment. Read as in "
     "the thesis (3.3.5): the first node from outside that touches or has a minimal gap; it touches below 10⁻⁶ V₀t, "
     "in the thesis below 10⁻⁶ m.",
     STEPS, (contact_length, less(BASE_STEP, "front", r"$\lambda_c$", "m"))),
    ("fig-3.9", "Time step: reaction",
     f"Reaction of one side for several time steps: {FILTER}; {COARSE_CASE}. Not reproduced: the thesis finds "
     "that 2.5·10⁻⁸ and 10⁻⁸ s catch 1/√t, and 10⁻⁸ s scatters most here. Reproduced: 10⁻⁶ and 10⁻⁷ s miss 1/√t at the "
     "start. Its filter smooths over a number of steps, so that it decides what is seen (extra-filter). The impulse "
     "differs little below 10⁻⁶ s: no step is better.",
     STEPS, drawing.REACTION),
    ("fig-3.17", "Spectral radius: geometry",
     f"Geometry at τ = 0.01 for several spectral radii, and differences from ρ∞ = 0.8; {DAMPED_CASE}. The values of "
     "the thesis's legend are not in its text; it sees no major change.",
     RADII, (geometry, geometry_off("ρ∞ = 0.8"))),
    ("fig-3.18", "Spectral radius: energy",
     f"Energy of the beam until τ = 0.01 for several spectral radii, and differences from ρ∞ = 0.8; {DAMPED_CASE}. As "
     f"the thesis says, numerical dissipation is small against the loss in impacts, which it takes for physics. "
     f"{OURS_TOO}",
     RADII, (energy, less("ρ∞ = 0.8", "energy", "$E$", "J"))),
    ("fig-3.19", "Restitution: geometry",
     f"Geometry at τ = 0.1 for restitution 0 and 1; {DAMPED_CASE}.",
     RESTITUTIONS, (geometry,)),
    ("fig-3.20", "Restitution: reaction",
     f"Reaction of one side until τ = 0.1 for restitution 0 and 1: {BAND}; {DAMPED_CASE}.",
     RESTITUTIONS, drawing.NOISY),
    ("fig-3.21", "Restitution: energy",
     f"Energy of the beam until τ = 0.1 for restitution 0 and 1, and in free flight before; {DAMPED_CASE}. The thesis "
     f"takes the loss with 0 for physics. {OURS_TOO}",
     RESTITUTIONS, (energy,)),
))  # fmt: skip


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
    runs = [(o, o.steps) for o in STEPS.outcomes("lumped") if o.steps is not None]
    outcomes, h = [o for o, _ in runs], [float(steps.time[0]) for _, steps in runs]
    # the smoothing, in seconds, of the thesis's step
    same = [replace(o, steps=replace(steps, cut_off=CUT_OFF * step / BASE)) for (o, steps), step in zip(runs, h)]
    with sheet.figure(1, 3, height=2.7, texts=["per step", "in seconds"], legend=6, legend_size=7.0) as (_, axes):
        for axis, shown in zip(axes, (outcomes, same)):
            filtered(sheet, axis, shown)
        axes[2].set(xscale="log", xlabel="$h$  (s)", ylabel="scatter over theory  (1)")
        for name, shown, colour in (("per step", outcomes, "vermilion"), ("in seconds", same, "blue")):
            off, line = [drawing.filtered_scatter(o) for o in shown], drawing.plain_line(colour, marker="o", ms=4)
            sheet.line(axes[2], h, np.array(off, float), series=f"filter {name}", **line)
            sheet.numbers |= {f"scatter, filter {name}, {o.label}": v for o, v in zip(shown, off)}
        axes[2].legend(fontsize=7)


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
    rows = []
    for row, o in zip(printed, found):
        m, mean = o.measures, o.measures["mean_iterations"]
        iterations = [m["most_iterations"], None if mean is None else round(mean, 4)]
        rows.append([*row, m["seconds"], *iterations, int(m["steps"] or 0), m["lift"], m["reaction_error"]])
    sheet.table([*columns, "steps", "lift/(V₀t)", "r₀ error (%)"], rows)


FLAT = 1.0 / 80.0
ELEMENTS = {1.0: 20000, 1.05: 302, 1.1: 192, 1.25: 120, 1.5: 92}  # e: count, Table 3.2
LENGTHS = Series(
    COARSE, 0.01, {f"Δx = {readable(1e3 * dx)} mm": {"element_length": dx} for dx in (5e-3, 2.5e-3, 1.5e-3)}
)


def square_zone(given: Case, **more: float) -> SquareMesh:
    """The square mesh over the contact zone at the end."""
    settings, exact = thesis_settings(given.impact, given.end_time), Exact(given.impact)
    first, zone = (float(exact.front(t)) for t in (PER_ELEMENT * settings.time_step, given.end_time))
    return SquareMesh(first_element=first, zone=zone, growth=settings.growth, **more)


SQUARE = square_zone(case(FLAT, 0.01))
ZONES = Series(FLAT, 0.01, {"uniform zone": {}, '"square" zone': {"mesh": SQUARE}})
SQUARE_CASE = f"K = 1/80 1/m (κ/ν = 6.25·10⁻⁴), τ = 0.01, h = 2.5·10⁻⁸ s, e = 1.25, a = 5; {LEGEND}"
items(__name__, drawing.run_figure, (
    ("fig-3.10", "Element length: geometry",
     f"Impact zone for several element lengths; {COARSE_CASE}. As the thesis says, its element lengths do not remove"
     " the lift.",
     LENGTHS, (geometry,)),
    ("fig-3.11", "Element length: contact length",
     f"Contact length λ_c for several element lengths; {COARSE_CASE}. The staircase is that of the elements.",
     LENGTHS, (contact_length,)),
    ("fig-3.12", "Element length: reaction",
     f"Reaction of one side for several element lengths: {FILTER}; {COARSE_CASE}. The thesis finds Δx = 5 mm too high "
     "and misses 1/√t at the beginning with 1.5 mm.",
     LENGTHS, drawing.REACTION),
    ("fig-3.14", "Square mesh: geometry",
     f"Geometry at τ = 0.01 on both meshes; {SQUARE_CASE}. The first constraint of the square mesh is at the middle of "
     "its first element and does not stop the central node: the thesis has it some 1.8·10⁻⁴ m inside the wall.",
     ZONES, (geometry,)),
    ("fig-3.16", "Square mesh: reaction",
     f"Reaction of one side until τ = 0.01 on both meshes: {FILTER}; {SQUARE_CASE}. Neither mesh resolves the front.",
     ZONES, drawing.REACTION),
))  # fmt: skip


def table_nodes(growth: float) -> np.ndarray:
    """Nodes of half the beam of Table 3.2, m."""
    even = np.linspace(0.0, 25.0, 10001)
    return even if growth == 1.0 else GradedMesh(2.5e-3, growth, size_ratio=1e6).nodes(25.0)


def count_of(curvature: float, *, square: bool = False) -> int:
    """Elements of the whole beam until τ = 0.1 by the thesis's rules (3.3.2), Δx = 2.5·10⁻³ m: a uniform zone of twice
    the contact zone, or a square one over the contact zone."""
    given = case(curvature, 0.1)
    zone = 2.0 * float(Exact(given.impact).front(given.end_time))
    laid = square_zone(given, size_ratio=1e9) if square else GradedMesh(2.5e-3, 1.25, zone=zone)
    return 2 * (laid.nodes(given.impact.half_length).size - 1)


@item("table-3.2")
def counts(sheet: Sheet) -> None:
    """Growth and number of elements

    Number of elements of the whole beam for each growth e, L = 50 m, Δx = 2.5·10⁻³ m, κ/ν = 0.05, τ = 0.01. A uniform
    zone of 25 elements a side gives the thesis's numbers within two elements, without its cap of 10³ on the ratio of
    lengths; its largest element for e = 1.25, 0.2994 m, does not fit 120 elements.
    """
    laid = [(growth, printed, table_nodes(growth)) for growth, printed in ELEMENTS.items()]
    rows = [[f"{growth:g}", printed, 2 * (x.size - 1), float(np.diff(x)[-1])] for growth, printed, x in laid]
    sheet.table(["e", "thesis", "ours", "largest element (m)"], rows, width=style.COLUMN + 0.8)


@item("fig-3.13", case=SQUARE_CASE.partition(";")[0])
def square_nodes(sheet: Sheet) -> None:
    """Square mesh: nodes

    Nodes of the "square" mesh x_i ∝ √i on the bent beam before the impact; {case}. (b) Lengths of the elements; dotted,
    the end of the contact at τ = 0.01.
    """
    curvature, laid = case(FLAT, 0.01).impact.curvature, SQUARE.nodes(25.0)
    shown = laid[laid <= 1.6 * SQUARE.zone]
    line = drawing.plain_line("blue", width=0.5, marker="o", ms=2.5)
    with sheet.figure(1, 2, height=2.5) as (_, axes):
        axes[0].set(xlabel="$x$  (m)", ylabel="$y$  (mm)")
        axes[1].set(xlabel="$x$  (m)", ylabel=r"$\Delta x$  (mm)")
        sheet.line(axes[0], shown, -500.0 * curvature * shown**2, series="nodes", **line)
        sheet.line(axes[1], shown[:-1], 1e3 * np.diff(shown), series="element length", **line)
        axes[0].invert_yaxis()  # the wall is below
        for axis in axes:
            axis.axvline(SQUARE.zone, **drawing.GUIDE)
    sheet.numbers |= {"first element (mm)": 1e3 * laid[1], "shortest element (mm)": 1e3 * float(np.diff(laid).min())}


@item("fig-3.15", square_case=SQUARE_CASE)
def square_length(sheet: Sheet) -> None:
    """Square mesh: contact length

    Contact length until τ = 0.01 on both meshes (above) and its last part (below); {square_case}. The thesis sees
    steps on the uniform mesh and none on the square one: there λ_c rests for a third of the time, but it does rest.
    """
    texts = [f"{mass} mass" for mass in MASSES] * 2
    with sheet.figure(2, 2, height=4.6, texts=texts, legend=5, legend_size=7.0) as (_, axes):
        for column, mass in zip(axes.T, MASSES):
            found = ZONES.outcomes(mass)
            end = float(found[0].time[-1])
            low, high = (float(found[0].exact.front(t)) for t in (0.6 * end, end))
            for axis in column:
                contact_length(sheet, axis, found)
            column[1].set(xlim=(0.6e6 * end, 1e6 * end), ylim=(0.97e3 * low, 1.03e3 * high))
            drawing.numbers_of(sheet, drawing.named(found, mass, mass != "lumped"), "contact_length_error")
            for o in found[:2]:
                late = o.time >= 0.6 * end
                highest = np.maximum.accumulate(o.front[late])
                moved = np.flatnonzero(np.diff(highest) > 0.0)
                rests = np.diff(o.time[late][np.concatenate([[0], moved + 1, [highest.size - 1]])])
                name = f"longest rest of λ_c in the last two fifths (µs), {o.label}, {mass}"
                sheet.numbers[name] = 1e6 * float(rests.max())
