"""Chapter 3, section 3.3.2: the mesh (K = 1 1/m for the element length, K = 1/80 1/m for the square mesh; τ =
0.01).
"""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np

from bent_beam.meshes import GradedMesh, Mesh, SquareMesh
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import key_below, one_panel, reaction_and_impulse
from comparison.gallery.runs import case, reference_runs, thesis
from comparison.studies import mesh as study
from comparison.studies.outcome import Outcome
from comparison.studies.panels import contact_length, geometry
from comparison.studies.sentences import number, signed
from comparison.studies.thesis import THESIS_MASS, thesis_settings

DURATION = 0.01
COARSE, FLAT = 1.0, 1.0 / 80.0
ELEMENTS = {1.0: 20000, 1.05: 302, 1.1: 192, 1.25: 120, 1.5: 92}  # Table 3.2
LENGTHS = (5e-3, 2.5e-3, 1.5e-3)
SHOWN = (
    "K = 1 1/m, t_f = 2.5·10⁻⁵ s, h = 2.5·10⁻⁸ s; the thesis's settings (lines), Hermite (circles) and Self-similar "
    "(diamonds) with their own choices, theory (black)."
)
SQUARE = "K = 1/80 1/m (κ/ν = 6.25·10⁻⁴), τ = 0.01, h = 2.5·10⁻⁸ s, e = 1.25, a = 5"


def lengths() -> list[Outcome]:
    """One run an element length, and the references."""
    runs = [thesis(f"Δx = {dx:g} m", COARSE, DURATION, value=dx, element_length=dx) for dx in LENGTHS]
    return [*runs, *reference_runs(COARSE, DURATION)]


def errors(found: Sequence[Outcome], what: str) -> str:
    """One of the errors of each, in words."""
    return ", ".join(f"{signed(o.measures[what])} %" for o in found)


@item("fig-3.10", "Element length: geometry", group="mesh", caption=f"Impact zone for several element lengths; {SHOWN}")
def shape(sheet: Sheet) -> str:
    found = lengths()
    one_panel(sheet, geometry, found)
    lifts = ", ".join(f"{number(o.measures['lift'])} ({o.label})" for o in found)
    return (
        f"Lift over V₀t: {lifts}. As the thesis says, its element lengths do not remove the lift: the front, "
        f"{1e3 * 2 / float(found[0].exact.parameters.lambda0) * 0.05 * np.sqrt(DURATION):.2g} mm thick at the "
        "end and less before, needs elements of "
        "a fraction of that from the start."
    )


@item(
    "fig-3.11",
    "Element length: contact length",
    group="mesh",
    caption=f"Contact length λ_c for several element lengths; {SHOWN}",
)
def length(sheet: Sheet) -> str:
    found = lengths()
    one_panel(sheet, contact_length, found)
    return (
        "λ₀ fitted to the centroid of the reaction is off by "
        f"{errors(found[:3], 'contact_length_error')} for the three lengths: the staircase is the elements'."
    )


@item(
    "fig-3.12",
    "Element length: reaction",
    group="mesh",
    caption=(
        "Reaction of one side for several element lengths, means over thirtieths of √t (a, peaks cut), impulse (b); "
        f"{SHOWN}"
    ),
)
def force(sheet: Sheet) -> str:
    found = lengths()
    reaction_and_impulse(sheet, found)
    return (
        f"r₀ fitted to the impulse is off by {errors(found[:3], 'reaction_error')}: overestimated by long elements, "
        "as the thesis saw."
    )


@item(
    "table-3.2",
    "Growth and number of elements",
    group="mesh",
    caption=(
        "Number of elements of the whole beam for each growth e, L = 50 m, Δx = 2.5·10⁻³ m, κ/ν = 0.05, τ = 0.01."
    ),
)
def counts(sheet: Sheet) -> str:
    rows: list[list[object]] = []
    for growth, printed in ELEMENTS.items():
        laid = GradedMesh(2.5e-3, growth, size_ratio=1e6).nodes(25.0) if growth > 1.0 else np.linspace(0.0, 25.0, 10001)
        rows.append([f"{growth:g}", printed, 2 * (laid.size - 1), float(np.diff(laid)[-1])])
    sheet.table(["e", "thesis", "ours", "largest element (m)"], rows, width=style.COLUMN + 0.8)
    return (
        "A uniform zone of 25 elements a side gives the thesis's numbers within two elements, without its cap of "
        "10³ on the ratio of lengths; its largest element for e = 1.25, 0.2994 m, does not fit 120 elements."
    )


@functools.cache
def square() -> SquareMesh:
    given = case(FLAT, DURATION)
    base = thesis_settings(given.impact, given.end_time)
    laid = study.square_mesh(given, base)
    assert laid is not None
    front = float(study.Exact(given.impact).front(given.end_time))
    return SquareMesh(first_element=laid.first_element, zone=front, growth=1.25)


def meshes() -> list[Outcome]:
    """Uniform zone and square mesh, and the references."""
    return [
        thesis("uniform zone", FLAT, DURATION),
        thesis('"square" zone', FLAT, DURATION, mesh=square()),
        *reference_runs(FLAT, DURATION),
    ]


def square_middle() -> float:
    """How deep the central node of the square mesh is inside the wall at the end, m."""
    return -float(thesis("", FLAT, DURATION, mesh=square(), mass=THESIS_MASS).gap[0])


def count_of(curvature: float, duration: float, element: float, *, square: bool = False) -> int:
    """Elements of the whole beam that the thesis's rules give (3.3.2): a uniform zone of twice the contact zone, or a
    square one over the contact zone.
    """
    given = case(curvature, duration)
    settings = thesis_settings(given.impact, given.end_time)
    zone = 2.0 * float(study.Exact(given.impact).front(given.end_time))
    laid: Mesh = GradedMesh(element, settings.growth, zone=zone)
    if square:
        first = float(study.Exact(given.impact).front(study.PER_ELEMENT * settings.time_step))
        laid = SquareMesh(first_element=first, zone=0.5 * zone, growth=settings.growth, size_ratio=1e9)
    return 2 * (laid.nodes(given.impact.half_length).size - 1)


@item(
    "fig-3.13",
    "Square mesh: nodes",
    group="mesh-square",
    caption=(
        f'Nodes of the "square" mesh x_i ∝ √i on the bent beam before the impact; {SQUARE}. (b) Lengths of the '
        "elements."
    ),
)
def nodes(sheet: Sheet) -> str:
    given, laid = case(FLAT, DURATION), square().nodes(25.0)
    shown = laid[laid <= 1.6 * square().zone]
    with sheet.figure(1, 2, width=style.PAGE, height=2.5) as (_, axes):
        axes[0].set_xlabel("$x$  (m)")
        axes[0].set_ylabel("$y$  (mm)")
        sheet.line(
            axes[0],
            shown,
            -500.0 * given.impact.curvature * shown**2,
            series="nodes",
            color=style.COLOURS["blue"],
            marker="o",
            ms=2.5,
            lw=0.5,
        )
        axes[0].invert_yaxis()  # the wall is below
        axes[1].set_xlabel("$x$  (m)")
        axes[1].set_ylabel(r"$\Delta x$  (mm)")
        sheet.line(
            axes[1],
            shown[:-1],
            1e3 * np.diff(shown),
            series="element length",
            color=style.COLOURS["blue"],
            marker="o",
            ms=2.5,
            lw=0.5,
        )
        for axis, letter in zip(axes, "ab"):
            axis.axvline(square().zone, color=style.COLOURS["grey"], lw=0.7, ls=":")
            sheet.panel(axis, letter)
    return (
        f"First element {1e3 * laid[1]:.3g} mm, {1e3 * np.diff(laid).min():.2g} mm where the contact ends at τ = "
        "0.01 (dotted)."
    )


@item(
    "fig-3.14", "Square mesh: geometry", group="mesh-square", caption=f"Geometry at τ = 0.01 on both meshes; {SQUARE}."
)
def square_shape(sheet: Sheet) -> str:
    found = meshes()
    one_panel(sheet, geometry, found)
    middle = -float(found[1].gap[0])
    lifts = ", ".join(f"{number(o.measures['lift'])} ({o.label})" for o in found[2:])
    side = "inside the wall" if middle > 0 else "off the wall"
    return (
        f"The middle node of the square mesh is {1e4 * abs(middle):.2g}·10⁻⁴ m {side} (thesis: 1.8·10⁻⁴ m "
        f"inside): the contact row sits at the middle of the first element, "
        f"{1e3 * square().first_element:.2g} mm long, and does not stop the node. Lift over V₀t of the references: "
        f"{lifts}."
    )


@item(
    "fig-3.15",
    "Square mesh: contact length",
    group="mesh-square",
    caption=f"Contact length until τ = 0.01 on both meshes; {SQUARE}.",
)
def square_length(sheet: Sheet) -> str:
    found = meshes()
    end = float(found[0].time[-1])
    with sheet.figure(1, 2, width=style.PAGE, height=2.9) as (fig, axes):
        contact_length(sheet, axes[0], found)
        contact_length(sheet, axes[1], found)
        axes[1].set_xlim(1e6 * 0.6 * end, 1e6 * end)
        low, high = (float(found[0].exact.front(t)) for t in (0.6 * end, end))
        axes[1].set_ylim(1e3 * 0.97 * low, 1e3 * 1.03 * high)
        sheet.panel(axes[0], "a")
        sheet.panel(axes[1], "b", text="zoom on the last part")
        key_below(fig, axes[0], 5, fontsize=7.0)
    steps = [_longest_step(o) for o in found[:2]]
    return (
        f"In the last two fifths λ_c rests for up to {1e6 * steps[0]:.2g} µs on the uniform zone and "
        f"{1e6 * steps[1]:.2g} µs on "
        "the square one: shorter steps, as the thesis found, not none."
    )


def _longest_step(outcome: Outcome) -> float:
    """How long λ_c rests at one place at most in the last two fifths of the run, s."""
    late = outcome.time >= 0.6 * outcome.time[-1]
    highest = np.maximum.accumulate(outcome.front[late])
    moved = np.flatnonzero(np.diff(highest) > 0.0)
    instants = outcome.time[late][np.concatenate([[0], moved + 1, [highest.size - 1]])]
    return float(np.diff(instants).max())


@item(
    "fig-3.16",
    "Square mesh: reaction",
    group="mesh-square",
    caption=(
        "Reaction of one side until τ = 0.01 on both meshes, means over thirtieths of √t (a, peaks cut), impulse (b); "
        f"{SQUARE}."
    ),
)
def square_force(sheet: Sheet) -> str:
    found = meshes()
    reaction_and_impulse(sheet, found)
    labels = ", ".join(o.label for o in found)
    return (
        f"r₀ is off by {errors(found, 'reaction_error')} ({labels}): neither of the thesis's meshes resolves the front."
    )
