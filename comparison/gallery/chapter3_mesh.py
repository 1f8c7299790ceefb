"""Chapter 3, section 3.3.2: the mesh (K = 1 1/m for the element length, K = 1/80 1/m for the square mesh; τ =
0.01).
"""

from __future__ import annotations

import functools
from collections.abc import Sequence

import numpy as np

from bent_beam.meshes import GradedMesh, SquareMesh
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.looks import one_panel
from comparison.gallery.runs import case, ours, thesis
from comparison.studies import mesh as study
from comparison.studies.outcome import Outcome
from comparison.studies.panels import contact_length, geometry, reaction
from comparison.studies.thesis import thesis_settings

DURATION = 0.01
COARSE, FLAT = 1.0, 1.0 / 80.0
ELEMENTS = {1.0: 20000, 1.05: 302, 1.1: 192, 1.25: 120, 1.5: 92}  # Table 3.2
LENGTHS = (5e-3, 2.5e-3, 1.5e-3)
SHOWN = "K = 1 1/m, t_f = 2.5·10⁻⁵ s, h = 2.5·10⁻⁸ s; the thesis's settings (lines), our cure (circles) and theory."
SQUARE = "K = 1/80 1/m (κ/ν = 6.25·10⁻⁴), τ = 0.01, h = 2.5·10⁻⁸ s, e = 1.25, a = 5"


def lengths() -> list[Outcome]:
    """One run an element length, and ours."""
    return [*(thesis(f"Δx = {dx:g} m", COARSE, DURATION, element_length=dx) for dx in LENGTHS), ours(COARSE, DURATION)]


def errors(found: Sequence[Outcome], what: str) -> str:
    """One of the errors of each, in words."""
    return ", ".join(f"{o.measures[what]:+.2g} %" for o in found)


@item("fig-3.10", "Element length: geometry", group="mesh", caption=f"Impact zone for several element lengths; {SHOWN}")
def shape(sheet: Sheet) -> str:
    found = lengths()
    one_panel(sheet, geometry, found)
    lifts = ", ".join(f"{o.measures['lift']:.2g}" for o in found)
    return (
        f"Lift over V₀t: {lifts}. As the thesis says, its element lengths do not cure the lift: the front, "
        f"{1e3 * 2 / 6.237 * 0.05 * np.sqrt(DURATION):.2g} mm thick at the end and less before, needs elements of "
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
        f"{errors(found[:-1], 'contact_length_error')} for the three lengths: the staircase is the elements'."
    )


@item(
    "fig-3.12",
    "Element length: reaction",
    group="mesh",
    caption=f"Reaction of one side for several element lengths, averaged over eightieths of the run; {SHOWN}",
)
def force(sheet: Sheet) -> str:
    found = lengths()
    one_panel(sheet, reaction, found)
    return (
        f"r₀ fitted to the impulse is off by {errors(found[:-1], 'reaction_error')}: overestimated by long elements, "
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
    front = float(np.sqrt(given.end_time) * 56.5684)
    return SquareMesh(first_element=laid.first_element, zone=front, growth=1.25)


def meshes() -> list[Outcome]:
    """Uniform zone and square mesh, and ours."""
    return [
        thesis("uniform zone", FLAT, DURATION),
        thesis('"square" zone', FLAT, DURATION, mesh=square()),
        ours(FLAT, DURATION),
    ]


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
    side = "inside the wall" if middle > 0 else "off the wall"
    return (
        f"The middle node of the square mesh is {1e4 * abs(middle):.2g}·10⁻⁴ m {side} (thesis: 1.8·10⁻⁴ m "
        f"inside): the first element, {1e3 * square().first_element:.2g} mm, is what its row in the middle leaves "
        f"free. Ours is flat to {found[-1].measures['lift']:.0e} V₀t."
    )


@item(
    "fig-3.15",
    "Square mesh: contact length",
    group="mesh-square",
    caption=f"Contact length until τ = 0.01 on both meshes; {SQUARE}.",
)
def square_length(sheet: Sheet) -> str:
    one_panel(sheet, contact_length, meshes())
    return "Each element of the square mesh lasts as long as any other: no long steps at the end, as the thesis found."


@item(
    "fig-3.16",
    "Square mesh: reaction",
    group="mesh-square",
    caption=f"Reaction of one side until τ = 0.01 on both meshes, averaged over eightieths of the run; {SQUARE}.",
)
def square_force(sheet: Sheet) -> str:
    found = meshes()
    one_panel(sheet, reaction, found)
    return (
        f"r₀ is off by {errors(found, 'reaction_error')} (uniform zone, square zone, ours): neither of the thesis's "
        "meshes resolves the front."
    )
