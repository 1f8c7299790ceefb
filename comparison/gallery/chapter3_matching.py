"""Chapter 3, section 3.4: the parameters chosen, and leading order matched (Tables 3.3, 3.4, Figs 3.29–3.31)."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY
from comparison.gallery.maps import CellForces, cell_forces, colour_bar, map_norm, reaction_map
from comparison.gallery.runs import case, thesis_history
from comparison.match import THESIS_KAPPAS, MatchRow, match, questions
from comparison.methods import default_methods
from comparison.store import RunStore, default_store
from comparison.studies.contact_point import MASSES
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome, outcome_of
from comparison.studies.sentences import number, signed, smallest_and_largest
from comparison.studies.thesis import THESIS_MASS
from hermite_fe import resolution
from theory import contact_parameters

CURVATURES = tuple(20.0 * k for k in THESIS_KAPPAS)
NAMES = ("1/80", "1/40", "1/20", "1/10", "1/5", "1/2", "1", "5", "10")


def element_length(curvature: float) -> float:
    """The thesis's Δx, m, which it refined for larger curvatures (3.4)."""
    if curvature > 2.0:
        return 1e-3
    return 1.5e-3 if 0.09 < curvature < 0.6 else 2.5e-3


@functools.cache
def noisy() -> list[Outcome]:
    """The thesis's own sweep: its settings, middles, lumped masses, τ = 0.1."""
    return [
        outcome_of(
            thesis_history(k, 0.1, element_length=element_length(k), mass=THESIS_MASS), f"K = {name}", value=k / 20.0
        )
        for k, name in zip(CURVATURES, NAMES)
    ]


@functools.cache
def matched() -> list[MatchRow]:
    """Hermite, and Exudyn at every second curvature, with automatic choices; kept runs are used."""
    asked = [
        question
        for path, ratios in (("hermite", THESIS_KAPPAS), ("exudyn", THESIS_KAPPAS[::2]))
        for question in questions(default_methods((path,)), ratios, error_bars="drift")
    ]
    rows = match(asked, store=RunStore(default_store()))
    if not any(r.lambda0.measured for r in rows):
        raise ValueError(rows[0].reason or "no row has a number")
    return rows


@item(
    "table-3.3",
    "Numerical parameters selected",
    group="matching",
    caption="Numerical parameters of the thesis, and what Hermite chooses for K = 1/80 and K = 10 1/m at τ = 0.1.",
)
def parameters(sheet: Sheet) -> str:
    chosen = [
        resolution.choose(given.impact, given.end_time, None, None, None, None)
        for given in (case(1 / 80, 0.1), case(10.0, 0.1))
    ]
    lengths = [np.diff(c.nodes) for c in chosen]
    hold = ["none" if not c.contact.hold else f"{c.contact.hold} rows" for c in chosen]
    sheet.table(
        ["parameter", "thesis", "Hermite, K = 1/80", "Hermite, K = 10"],
        [
            ["contact", "element middles", *(type(c.contact).__name__ for c in chosen)],
            ["integrator", "nonsmooth generalised-α", *(type(c.integrator).__name__ for c in chosen)],
            [
                "time step h",
                "2.5·10⁻⁸ s",
                *(f"max({c.integrator.time_step:.1e} s, {c.integrator.growth:g} t)" for c in chosen),
            ],
            ["damping", "ρ∞ = 0.8", *(type(c.far_field).__name__ for c in chosen)],
            ["restitution", "g = 1 (printed), 0 (used)", *(f"{c.contact.restitution:g}" for c in chosen)],
            ["held behind the front", "–", *hold],
            ["mass", "printed consistent, fits lumped", *(type(c.mass).__name__ for c in chosen)],
            ["mesh", "uniform in the zone", *(type(c.mesh).__name__ for c in chosen)],
            ["smallest element", "2.5·10⁻³ m", *(f"{dx.min():.1e} m" for dx in lengths)],
            ["growth e", "1.25", *(f"{np.max(dx[1:] / dx[:-1]):.3g}" for dx in lengths)],
        ],
    )
    return "Table 3.3 prints g = 1; the thesis's conclusion and runs have g = 0."


@item(
    "table-3.4",
    "Curvatures of the sweep",
    group="matching",
    caption=(
        "Curvatures K of the sweep at V₀ = 20 m/s with κ/ν, theory's λ₀ and r₀, and how many elements of the "
        "thesis span its front's thickness 2√(√(EI/μ) t)/λ₀ at τ = 0.1."
    ),
)
def curvatures(sheet: Sheet) -> str:
    rows: list[list[object]] = []
    for curvature, name in zip(CURVATURES, NAMES):
        found = contact_parameters(curvature / 20.0)
        thick = 2.0 * math.sqrt(2.5e-4) / found.lambda0
        rows.append(
            [
                name,
                f"{curvature / 20.0:.6g}",
                f"{found.lambda0:.6f}",
                f"{found.r0:.6f}",
                thick / element_length(curvature),
            ]
        )
    sheet.table(["K (1/m)", "κ/ν", "λ₀", "r₀/ν", "elements per front"], rows, width=4.6)
    return f"At K = 1/80 an element is {1 / float(rows[0][4]):.1f} fronts long."  # type: ignore[arg-type]


def curve_with_points(sheet: Sheet, what: str, symbol: str) -> None:
    """Theory's curve, the thesis's settings and both paths, and their differences below."""
    ratios = np.geomspace(4e-4, 0.99, 300)
    exact = getattr(contact_parameters(ratios), what)
    old = noisy()
    key = "contact_length_error" if what == "lambda0" else "reaction_error"
    with sheet.figure(2, 1, width=4.6, height=4.9, sharex=True, height_ratios=[1.5, 1]) as (_, (top, below)):
        top.set_xscale("log")
        top.set_yscale("log")
        top.set_ylabel(f"{symbol}  (1)")
        below.set_ylabel("difference  (%)")
        below.set_xlabel(r"$\kappa/\nu$  (1)")
        sheet.line(top, ratios, exact, series="theory", **THEORY)
        known = [o for o in old if o.measures[key] is not None]
        at = np.array([o.value for o in known], float)
        wrong = np.array([o.measure(key) for o in known])
        grey: dict[str, Any] = {"color": style.COLOURS["grey"], "ls": "", "marker": "x", "ms": 4.5}
        sheet.line(
            top, at, getattr(contact_parameters(at), what) * (1.0 + wrong / 100.0), series="thesis's settings", **grey
        )
        sheet.line(below, at, wrong, series="thesis's settings", **grey)
        for name, mark in style.marks(r.label for r in matched()).items():
            mine = [r for r in matched() if r.label == name and getattr(r, what).measured]
            line_style = {k: v for k, v in mark.items() if k != "label"}
            x = np.array([r.kappa_over_nu for r in mine])
            y = np.array([getattr(r, what).value for r in mine])
            t = np.array([getattr(r, what).theory for r in mine])
            sheet.line(top, x, y, series=name, **line_style)
            sheet.line(below, x, 100.0 * (y / t - 1.0), series=name, **line_style)
        below.axhline(0.0, color="black", lw=0.8)
        below.set_yscale("symlog", linthresh=1e-2, linscale=0.6)
        ticks = (-10.0, -1.0, -0.1, -0.01, 0.0, 0.01, 0.1, 1.0, 10.0, 100.0)
        below.set_yticks(ticks, [f"{v:g}".replace("-", "−") for v in ticks], fontsize=6.5)
        below.set_yticks([], minor=True)
        below.set_ylim(-20, 200)
        top.legend()
        sheet.panel(top, "a")
        sheet.panel(below, "b")


def _range(name: str) -> str:
    """From the smallest to the largest error of the thesis's settings."""
    found = smallest_and_largest(noisy(), name)
    return "not measured" if found is None else f"from {signed(found[0])} to {signed(found[1])} %"


def _worst(what: str) -> str:
    """The largest error of each method, and which of its runs have no number."""
    found = []
    for name in dict.fromkeys(r.label for r in matched()):
        mine = [r for r in matched() if r.label == name]
        errors = [abs(getattr(r, what).relative()) for r in mine if getattr(r, what).measured]
        missing = ", ".join(f"{r.kappa_over_nu:.3g}" for r in mine if not getattr(r, what).measured)
        text = f"{name} within {number(100.0 * max(errors))} %" if errors else name
        found.append(f"{text} (no number at κ/ν = {missing})" if missing else text)
    return ", ".join(found)


@item(
    "fig-3.29",
    "λ₀ over κ/ν: theory and simulation",
    group="matching",
    caption=(
        "λ₀ over κ/ν for the curvatures of Table 3.4: theory, the thesis's settings with lumped masses, Hermite, "
        "and Exudyn at every second one; relative differences below, linear within ±0.01 %, logarithmic beyond."
    ),
)
def matched_length(sheet: Sheet) -> str:
    curve_with_points(sheet, "lambda0", r"$\lambda_0$")
    return f"{_worst('lambda0')}; the thesis's settings {_range('contact_length_error')}."


@item(
    "fig-3.30",
    "r₀ over κ/ν: theory and simulation",
    group="matching",
    caption=(
        "r₀ over κ/ν for the curvatures of Table 3.4: theory, the thesis's settings with lumped masses, Hermite, "
        "and Exudyn at every second one; relative differences below, linear within ±0.01 %, logarithmic beyond."
    ),
)
def matched_reaction(sheet: Sheet) -> str:
    curve_with_points(sheet, "r0", r"$r_0/\nu$")
    return (
        f"{_worst('r0')}; the thesis's settings {_range('reaction_error')}, largest where an "
        "element is longest against the front. r₀ is fitted to impulses here, not to filtered forces. The "
        "thesis's R₀ is √(2/π)μV₀(EI/μ)^¼ r₀, one side, N√s."
    )


@item(
    "fig-3.31",
    "Reaction in space and time",
    group="contact-point",
    caption=(
        "Reaction per cell over x and t, K = 1/80 1/m, cells even in x and √t, the axis of t scaled alike, so that the "
        "front is straight: the thesis's settings with nodes and middles, consistent (a, b) and lumped masses "
        "(c, d), and "
        "theory's ±λ₀√t (red line)."
    ),
)
def reaction_in_space_and_time(sheet: Sheet) -> str:
    shown = [(mass, contact) for mass in MASSES for contact in ("node", "middle")]
    histories = [thesis_history(1.0 / 80.0, 0.1, contact=contact, mass=MASSES[mass]) for mass, contact in shown]
    cells = [cell_forces(h) for h in histories]
    norm = map_norm(*cells)
    inside = []
    with sheet.figure(2, 2, width=style.PAGE, height=5.0, sharex=True, sharey=True) as (fig, axes):
        for axis, letter, (mass, contact), history, found in zip(axes.flat, "abcd", shown, histories, cells):
            drawn = reaction_map(sheet, axis, history, found, norm)
            axis.label_outer()
            sheet.panel(axis, letter, text=f"contact at {contact}s, {mass} mass")
            inside.append(share_inside(found, Exact(history.impact)))
        colour_bar(fig, axes, drawn)
    listed = ", ".join(f"{number(100 * v)} % ({letter})" for v, letter in zip(inside, "abcd"))
    return (
        "The reaction is at the moving ends of the contact, as theory and thesis say. Inside nine tenths of the "
        f"zone falls {listed} of the impulse: the noise is in the steps of the front, not behind it."
    )


def share_inside(cells: CellForces, exact: Exact) -> float:
    """Impulse in cells inside nine tenths of the contact zone, over all of it."""
    middle = 0.5 * (cells.places[1:] + cells.places[:-1])
    impulse = cells.force * np.diff(cells.times)[:, None]
    inner = middle[None, :] < 0.9 * exact.front(cells.times[:-1])[:, None] - (middle[1] - middle[0])
    return float(impulse[inner].sum() / impulse.sum())
