"""Chapter 3, sections 3.3.1–3.3.4: time step, mesh, spectral radius and restitution."""

from __future__ import annotations

import functools
from collections.abc import Mapping

import numpy as np

from bent_beam.meshes import GradedMesh, Mesh, SquareMesh
from comparison.figures import style
from thesis.gallery.base import ITEMS, Item, item
from thesis.gallery.drawing import REACTION, guide, legend_below, numbers_of, plain_line, run_figure
from thesis.gallery.runs import case, compared, thesis
from thesis.sheet import Sheet
from thesis.studies.exact import Exact
from thesis.studies.mesh import PER_ELEMENT, square_mesh
from thesis.studies.outcome import Outcome
from thesis.studies.panels import contact_length, energy, geometry
from thesis.studies.thesis import THESIS_MASS, thesis_settings

COARSE, FLAT = 1.0, 1.0 / 80.0
COST = {  # h: (seconds, most iterations, mean iterations), Table 3.1
    1e-6: (90.0, 18, 5.233),
    1e-7: (235.0, 5, 1.2767),
    5e-8: (381.83, 5, 1.0933),
    2.5e-8: (715.86, 4, 1.035),
    1e-8: (1753.98, 4, 1.011),
}
ELEMENTS = {1.0: 20000, 1.05: 302, 1.1: 192, 1.25: 120, 1.5: 92}  # e: count, Table 3.2


@functools.cache
def square() -> SquareMesh:
    """The square mesh over the contact zone at τ = 0.01."""
    given = case(FLAT, 0.01)
    laid = square_mesh(given, thesis_settings(given.impact, given.end_time))
    if laid is None:
        raise ValueError("the square mesh needs too many elements")
    front = float(Exact(given.impact).front(given.end_time))
    return SquareMesh(first_element=laid.first_element, zone=front, growth=1.25)


def time_steps() -> list[Outcome]:
    return compared(COARSE, 0.01, {f"h = {h:g} s": {"time_step": h} for h in COST})


def lengths() -> list[Outcome]:
    return compared(COARSE, 0.01, {f"Δx = {dx:g} m": {"element_length": dx} for dx in (5e-3, 2.5e-3, 1.5e-3)})


def meshes() -> list[Outcome]:
    return compared(FLAT, 0.01, {"uniform zone": {}, '"square" zone': {"mesh": square()}})


def radii() -> list[Outcome]:
    return compared(1.0 / 40.0, 0.01, {f"ρ∞ = {r:g}": {"spectral_radius": r} for r in (1.0, 0.8, 0.5, 0.0)})


def restitutions() -> list[Outcome]:
    return compared(1.0 / 40.0, 0.1, {f"restitution {e:g}": {"restitution": e} for e in (0.0, 1.0)})


LEGEND = (
    "the thesis's settings (lines), Hermite (circles) and Self-similar (diamonds) with their own choices, theory "
    "(black)"
)
MEANS = "means over thirtieths of √t (a, peaks cut), impulse (b)"
COARSE_CASE = f"K = 1 1/m, t_f = 2.5·10⁻⁵ s, h = 2.5·10⁻⁸ s; {LEGEND}"
SQUARE_CASE = f"K = 1/80 1/m (κ/ν = 6.25·10⁻⁴), τ = 0.01, h = 2.5·10⁻⁸ s, e = 1.25, a = 5; {LEGEND}"
DAMPED_CASE = f"K = 1/40 1/m (κ/ν = 1.25·10⁻³), h = 2.5·10⁻⁸ s, Δx = 2.5·10⁻³ m, e = 1.25; {LEGEND}"
FIGURES = (
    ("fig-3.7", "Time step: geometry", (geometry,), time_steps,
     f"Impact zone for several time steps; {COARSE_CASE}. Whatever h, the thesis's settings lift the middle by its "
     "2·10⁻⁴ m: the lift comes from the mesh."),
    ("fig-3.8", "Time step: contact length", (contact_length,), time_steps,
     f"Contact length λ_c for several time steps; {COARSE_CASE}. Steps of the lines are the elements; where a line "
     "falls back, the outermost node is off the wall for a moment. Read as in the thesis: the first node from "
     "outside that touches or has the smallest gap."),
    ("fig-3.9", "Time step: reaction", REACTION, time_steps,
     f"Reaction of one side for several time steps, {MEANS}; {COARSE_CASE}. The thesis filters its force (filtfilt); "
     "here it is averaged over windows of time."),
    ("fig-3.10", "Element length: geometry", (geometry,), lengths,
     f"Impact zone for several element lengths; {COARSE_CASE}. As the thesis says, its element lengths do not remove"
     " the lift: the front is thinner at the start than at the end, and needs elements of a fraction of its "
     "thickness."),
    ("fig-3.11", "Element length: contact length", (contact_length,), lengths,
     f"Contact length λ_c for several element lengths; {COARSE_CASE}. The staircase is that of the elements."),
    ("fig-3.12", "Element length: reaction", REACTION, lengths,
     f"Reaction of one side for several element lengths, {MEANS}; {COARSE_CASE}. Long elements overestimate it, as the "
     "thesis found."),
    ("fig-3.14", "Square mesh: geometry", (geometry,), meshes,
     f"Geometry at τ = 0.01 on both meshes; {SQUARE_CASE}. The first constraint of the square mesh is at the middle of "
     "its first element and does not stop the central node (thesis: 1.8·10⁻⁴ m inside the wall)."),
    ("fig-3.16", "Square mesh: reaction", REACTION, meshes,
     f"Reaction of one side until τ = 0.01 on both meshes, {MEANS}; {SQUARE_CASE}. Neither of the thesis's meshes "
     "resolves the front."),
    ("fig-3.17", "Spectral radius: geometry", (geometry,), radii,
     f"Geometry at τ = 0.01 for several spectral radii; {DAMPED_CASE}. The values of the thesis's legend are not in "
     "its text."),
    ("fig-3.18", "Spectral radius: energy", (energy,), radii,
     f"Energy of the beam until τ = 0.01 for several spectral radii; {DAMPED_CASE}. The thesis takes the loss for the "
     "energy of the impact. Theory conserves energy: the loss is that of impacts of elements longer than the front is "
     "thick. With its own choices Hermite loses energy to its grid viscosity and its implicit step."),
    ("fig-3.19", "Restitution: geometry", (geometry,), restitutions,
     f"Geometry at τ = 0.1 for restitution 0 and 1; {DAMPED_CASE}."),
    ("fig-3.20", "Restitution: reaction", REACTION, restitutions,
     f"Reaction of one side until τ = 0.1 for restitution 0 and 1, {MEANS}; {DAMPED_CASE}."),
    ("fig-3.21", "Restitution: energy", (energy,), restitutions,
     f"Energy of the beam until τ = 0.1 for restitution 0 and 1; {DAMPED_CASE}. The thesis takes the loss with 0 for "
     "physics; the exact impact loses none."),
)  # fmt: skip
for name, title, panels, runs, caption in FIGURES:
    ITEMS[name] = Item(name, title, caption, __name__, functools.partial(run_figure, runs=runs, panels=panels))


@item("table-3.1")
def cost(sheet: Sheet) -> None:
    """Time step: cost

    Seconds for each time step, the thesis's (Matlab on a personal computer of 2019) and ours on the same mesh and steps
    (on the machine that draws this); then Hermite and Self-similar with their own choices, which resolve the front.
    Iterations: Newton's in the thesis, rounds of the active set in ours.
    """
    found = time_steps()
    printed = [[f"{h:g}", *numbers] for h, numbers in COST.items()]
    printed += [[o.label, None, None, None] for o in found[len(COST) :]]
    columns = ("h (s)", "thesis: time (s)", "most iterations", "mean", "ours: time (s)", "most", "mean")
    rows = [row + our_columns(o.measures) for row, o in zip(printed, found)]
    sheet.table([*columns, "steps", "lift/(V₀t)", "r₀ error (%)"], rows)


def our_columns(m: Mapping[str, float | None]) -> list[object]:
    """Our cells of Table 3.1."""
    mean = m["mean_iterations"]
    iterations = [m["most_iterations"], None if mean is None else round(mean, 4)]
    return [m["seconds"], *iterations, int(m["steps"] or 0), m["lift"], m["reaction_error"]]


def table_nodes(growth: float) -> np.ndarray:
    """Nodes of half the beam of Table 3.2, m."""
    if growth == 1.0:
        return np.linspace(0.0, 25.0, 10001)
    return GradedMesh(2.5e-3, growth, size_ratio=1e6).nodes(25.0)


def count_of(curvature: float, duration: float, *, square: bool = False) -> int:
    """Elements of the whole beam by the thesis's rules (3.3.2), Δx = 2.5·10⁻³ m: a uniform zone of twice the contact
    zone, or a square one over the contact zone.
    """
    given = case(curvature, duration)
    settings, exact = thesis_settings(given.impact, given.end_time), Exact(given.impact)
    zone = float(exact.front(given.end_time))
    laid: Mesh = GradedMesh(2.5e-3, settings.growth, zone=2.0 * zone)
    if square:
        first = float(exact.front(PER_ELEMENT * settings.time_step))
        laid = SquareMesh(first_element=first, zone=zone, growth=settings.growth, size_ratio=1e9)
    return 2 * (laid.nodes(given.impact.half_length).size - 1)


@item("table-3.2")
def counts(sheet: Sheet) -> None:
    """Growth and number of elements

    Number of elements of the whole beam for each growth e, L = 50 m, Δx = 2.5·10⁻³ m, κ/ν = 0.05, τ = 0.01. A uniform
    zone of 25 elements a side gives the thesis's numbers within two elements, without its cap of 10³ on the ratio of
    lengths; its largest element for e = 1.25, 0.2994 m, does not fit 120 elements.
    """
    rows = []
    for growth, printed in ELEMENTS.items():
        laid = table_nodes(growth)
        rows.append([f"{growth:g}", printed, 2 * (laid.size - 1), float(np.diff(laid)[-1])])
    sheet.table(["e", "thesis", "ours", "largest element (m)"], rows, width=style.COLUMN + 0.8)


@item("extra-counts")
def zone_counts(sheet: Sheet) -> None:
    """Element counts of 3.3.2

    Elements of the whole beam, L = 50 m, e = 1.25, as the thesis gives them and as its rules give them here. The
    uniform zone is twice as long as the contact zone at the end, the square one as long: with the first the counts of
    Table 3.2 come out too.
    """
    rows = [
        ["κ/ν = 6.25·10⁻⁴, τ = 0.1, uniform zone", 1496, count_of(FLAT, 0.1)],
        ["κ/ν = 0.5, τ = 0.1, uniform zone", 96, count_of(10.0, 0.1)],
        ['κ/ν = 0.5, τ = 0.1, "square" zone', 4210, count_of(10.0, 0.1, square=True)],
    ]
    sheet.table(["mesh", "thesis", "ours"], rows, width=style.COLUMN + 1.0)


def square_middle() -> float:
    """Depth of the central node of the square mesh inside the wall at the end, m, lumped masses."""
    return -float(thesis("", FLAT, 0.01, mesh=square(), mass=THESIS_MASS).gap[0])


@item("fig-3.13", case=SQUARE_CASE.partition(';')[0])
def square_nodes(sheet: Sheet) -> None:
    """Square mesh: nodes

    Nodes of the "square" mesh x_i ∝ √i on the bent beam before the impact; {case}. (b) Lengths of the elements; dotted,
    the end of the contact at τ = 0.01.
    """
    curvature, laid = case(FLAT, 0.01).impact.curvature, square().nodes(25.0)
    shown = laid[laid <= 1.6 * square().zone]
    line = plain_line("blue", width=0.5, marker="o", ms=2.5)
    with sheet.figure(1, 2, width=style.PAGE, height=2.5) as (_, axes):
        axes[0].set(xlabel="$x$  (m)", ylabel="$y$  (mm)")
        axes[1].set(xlabel="$x$  (m)", ylabel=r"$\Delta x$  (mm)")
        sheet.line(axes[0], shown, -500.0 * curvature * shown**2, series="nodes", **line)
        sheet.line(axes[1], shown[:-1], 1e3 * np.diff(shown), series="element length", **line)
        axes[0].invert_yaxis()  # the wall is below
        for axis in axes:
            guide(axis, x=square().zone)
    sheet.numbers |= {"first element (mm)": 1e3 * laid[1], "shortest element (mm)": 1e3 * float(np.diff(laid).min())}


@item("fig-3.15", square_case=SQUARE_CASE)
def square_length(sheet: Sheet) -> None:
    """Square mesh: contact length

    Contact length until τ = 0.01 on both meshes; {square_case}. λ_c rests for shorter times on the square mesh, as the
    thesis found, but it does rest.
    """
    found = meshes()
    end = float(found[0].time[-1])
    low, high = (float(found[0].exact.front(t)) for t in (0.6 * end, end))
    with sheet.figure(1, 2, width=style.PAGE, height=2.9) as (fig, axes):
        for axis in axes:
            contact_length(sheet, axis, found)
        axes[1].set(xlim=(0.6e6 * end, 1e6 * end), ylim=(0.97e3 * low, 1.03e3 * high))
        sheet.letter(axes, ["", "zoom on the last part"])
        legend_below(fig, axes[0], 5, fontsize=7.0)
    numbers_of(sheet, found, "contact_length_error")
    for o in found[:2]:
        sheet.numbers[f"longest rest of λ_c in the last two fifths (µs), {o.label}"] = 1e6 * longest_rest(o)


def longest_rest(outcome: Outcome) -> float:
    """The longest time for which λ_c rests at one place in the last two fifths of the run, s."""
    late = outcome.time >= 0.6 * outcome.time[-1]
    highest = np.maximum.accumulate(outcome.front[late])
    moved = np.flatnonzero(np.diff(highest) > 0.0)
    instants = outcome.time[late][np.concatenate([[0], moved + 1, [highest.size - 1]])]
    return float(np.diff(instants).max())
