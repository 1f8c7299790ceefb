"""Chapter 3, section 3.4: the parameters chosen, and leading order matched (Tables 3.3, 3.4, Figs 3.29–3.31)."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY
from comparison.gallery.maps import reaction_map
from comparison.gallery.runs import thesis_history
from comparison.match import THESIS_KAPPAS, MatchRow, match, questions
from comparison.methods import default_methods
from comparison.store import RunStore, default_store
from comparison.studies.outcome import Outcome, outcome_of
from comparison.studies.words import number, signed
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
    """The thesis's own sweep: its settings, middles, τ = 0.1."""
    return [
        outcome_of(thesis_history(k, 0.1, element_length=element_length(k)), f"K = {name}", "thesis", k / 20.0)
        for k, name in zip(CURVATURES, NAMES)
    ]


@functools.cache
def matched() -> list[MatchRow]:
    """Hermite and Exudyn with automatic choices; kept runs are used."""
    rows = match(questions(default_methods(("hermite", "exudyn")), THESIS_KAPPAS), store=RunStore(default_store()))
    if not any(r.lambda0.measured for r in rows):
        raise ValueError(rows[0].reason or "no row has a number")
    return [r for r in rows if r.lambda0.measured]


@item(
    "table-3.3",
    "Numerical parameters selected",
    group="matching",
    caption="Numerical parameters of the thesis and of this project's automatic choices.",
)
def parameters(sheet: Sheet) -> str:
    sheet.table(
        ["parameter", "thesis", "Hermite, expanding mesh", "Exudyn"],
        [
            ["contact", "element middles", "nodes, Signorini", "nodes, penalty, held"],
            ["time step h", "2.5·10⁻⁸ s", "0.02 t", "0.002 t"],
            ["damping", "ρ∞ = 0.8", "implicit Euler", "ρ∞ = 0.5, viscosity at grid scale"],
            ["restitution", "g = 1 (printed), 0 (used)", "0", "0"],
            ["mesh", "uniform in the zone", "moves with √t", "in proportion to x"],
            ["element Δx", "2.5·10⁻³ m", "1 % of the front", "from κ/ν"],
            ["growth e", "1.25", "2 % per length", "1.01"],
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
    with sheet.figure(2, 1, width=4.6, height=4.4, sharex=True, height_ratios=[2, 1]) as (_, (top, below)):
        top.set_xscale("log")
        top.set_yscale("log")
        top.set_ylabel(f"{symbol}  (1)")
        below.set_ylabel("difference  (%)")
        below.set_xlabel(r"$\kappa/\nu$  (1)")
        sheet.line(top, ratios, exact, series="theory", **THEORY)
        at = np.array([o.value for o in old], float)
        wrong = np.array([o.measures[key] or 0.0 for o in old])
        grey: dict[str, Any] = {"color": style.COLOURS["grey"], "ls": "", "marker": "x", "ms": 4.5}
        sheet.line(
            top, at, getattr(contact_parameters(at), what) * (1.0 + wrong / 100.0), series="thesis's settings", **grey
        )
        sheet.line(below, at, wrong, series="thesis's settings", **grey)
        for name, mark in style.marks(r.label for r in matched()).items():
            mine = [r for r in matched() if r.label == name]
            look = {k: v for k, v in mark.items() if k != "label"}
            x = np.array([r.kappa_over_nu for r in mine])
            y = np.array([getattr(r, what).value for r in mine])
            t = np.array([getattr(r, what).theory for r in mine])
            sheet.line(top, x, y, series=name, **look)
            sheet.line(below, x, 100.0 * (y / t - 1.0), series=name, **look)
        below.axhline(0.0, color="black", lw=0.8)
        below.set_yscale("symlog", linthresh=1e-2)
        below.set_yticks([-10, -1e-1, 0, 1e-1, 10], ["−10", "−0.1", "0", "0.1", "10"])
        below.set_ylim(-60, 60)
        top.legend()
        sheet.panel(top, "a")
        sheet.panel(below, "b")


def _worst(what: str) -> str:
    found = []
    for name in dict.fromkeys(r.label for r in matched()):
        errors = [abs(getattr(r, what).relative()) for r in matched() if r.label == name]
        if errors:
            found.append(f"{name} within {number(100.0 * max(errors))} %")
    return ", ".join(found)


@item(
    "fig-3.29",
    "λ₀ over κ/ν: theory and simulation",
    group="matching",
    caption=(
        "λ₀ over κ/ν for the curvatures of Table 3.4: theory, the thesis's settings, and both paths of this "
        "project; relative differences below."
    ),
)
def matched_length(sheet: Sheet) -> str:
    curve_with_points(sheet, "lambda0", r"$\lambda_0$")
    old = [abs(o.measures["contact_length_error"] or 0.0) for o in noisy()]
    return f"{_worst('lambda0')}; the thesis's settings within {number(max(old))} %."


@item(
    "fig-3.30",
    "r₀ over κ/ν: theory and simulation",
    group="matching",
    caption=(
        "r₀ over κ/ν for the curvatures of Table 3.4: theory, the thesis's settings, and both paths of this "
        "project; relative differences below."
    ),
)
def matched_reaction(sheet: Sheet) -> str:
    curve_with_points(sheet, "r0", r"$r_0/\nu$")
    old = [o.measures["reaction_error"] or 0.0 for o in noisy()]
    return (
        f"{_worst('r0')}; the thesis's settings from {signed(min(old))} to {signed(max(old))} %, largest where an "
        "element is longest against the front. r₀ is fitted to impulses here, not to filtered forces. The "
        "thesis's R₀ is √(2/π)μV₀(EI/μ)^¼ r₀, one side, N√s."
    )


def space_time(sheet: Sheet, axis: Axes, curvature: float, contact: str, letter: str) -> None:
    """Reaction by contact point and time."""
    history = thesis_history(curvature, 0.1, contact=contact)
    reaction_map(sheet, axis, history, LogNorm(1e0, 1e4))
    sheet.panel(axis, letter, text="contact at element middles" if contact == "middle" else "contact at nodes")


@item(
    "fig-3.31",
    "Reaction in space and time",
    group="contact-point",
    caption=(
        "Reaction per contact point over x and t, K = 1/80 1/m: the thesis's settings (a, b) and theory's "
        "±λ₀√t (red line)."
    ),
)
def reaction_in_space_and_time(sheet: Sheet) -> str:
    with sheet.figure(1, 2, width=style.PAGE, height=3.0, sharey=True) as (_, axes):
        space_time(sheet, axes[0], 1.0 / 80.0, "middle", "a")
        space_time(sheet, axes[1], 1.0 / 80.0, "node", "b")
    return (
        "The reaction is at the moving ends of the contact, as theory says; what is scattered inside is the "
        "rattling of contact points that theory leaves without any reaction."
    )
