"""Chapter 3, section 3.3.5, and appendix A.7: contact at nodes against contact at element middles, each with the
consistent mass matrix that the thesis prints and the lumped one that its numbers ask for.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery import chapter3_first_order as first
from comparison.gallery.base import item
from comparison.gallery.drawing import THEORY, key_below, one_panel, reaction_and_impulse
from comparison.gallery.runs import case, reference_runs, thesis, thesis_history
from comparison.studies.contact_point import MASSES, label_of, what_couples
from comparison.studies.exact import Exact
from comparison.studies.first_order_case import FITTED, fitted
from comparison.studies.outcome import Outcome
from comparison.studies.panels import contact_length, energy, strain
from comparison.studies.sentences import number, signed
from comparison.studies.thesis import THESIS_MASS
from hermite_fe import CONTACTS
from hermite_fe.delassus import impact_coupling
from hermite_fe.masses import ConsistentMass, LumpedMass, Mass

FLAT, DURATION = 1.0 / 80.0, 0.1
BENT = 1.0
SHOWN = "K = 1/80 1/m, Δx = 2.5·10⁻³ m, h = 2.5·10⁻⁸ s, e = 1.25, ρ∞ = 0.8"
TIMES = (2.5e-5, 1e-4, 1.75e-4, 2.5e-4)
ROTARY = (16.0, 24.0, 28.0, 32.0, 40.0, 50.0, 78.0, 105.0, 420.0)
"""1/r of the lumped masses of the coupling figure."""


def run(contact: str, mass: str, curvature: float = FLAT, duration: float = DURATION) -> Outcome:
    """One of the four."""
    coupling = impact_coupling(CONTACTS[contact](), MASSES[mass]).neighbour
    return thesis(label_of(contact, mass), curvature, duration, value=coupling, contact=contact, mass=MASSES[mass])


def four() -> list[Outcome]:
    """Nodes and middles, consistent and lumped."""
    return [run(contact, mass) for mass in MASSES for contact in ("node", "middle")]


def evolution(sheet: Sheet, contact: str) -> list[float]:
    """Geometry at several times, a panel for each mass; returns the last lifts inside, m."""
    found = []
    with sheet.figure(1, 2, width=style.PAGE, height=2.9, sharey=True) as (fig, axes):
        for axis, letter, mass in zip(axes, "ab", MASSES):
            history = thesis_history(FLAT, DURATION, contact=contact, mass=MASSES[mass])
            exact, gap, x = Exact(history.impact), history.array("gap"), history.positions(-1)
            near = x <= 1.1
            axis.set_xlabel("$x$  (m)")
            for t, colour in zip(TIMES, style.SEQUENCE):
                k = int(np.argmin(np.abs(history.time - t)))
                front = float(exact.front(t))
                sheet.line(axis, x[near], -1e3 * gap[k][near], series=f"t = {1e4 * t:g}·10⁻⁴ s", color=colour, lw=0.9)
                axis.plot([front], [0.0], marker="^", ms=5, color=colour, clip_on=False, zorder=5)
            found.append(run(contact, mass).lift)
            places = np.linspace(0.0, 1.1, 300)
            last = TIMES[-1]
            sheet.line(
                axis, places, -1e3 * exact.gap(places, last), series=f"theory, t = {1e4 * last:g}·10⁻⁴ s", **THEORY
            )
            axis.set_xlim(0, 1.1)
            style.wall_below(axis, -2.3, 0.4)
            sheet.panel(axis, letter, text=f"{mass} mass")
        axes[0].set_ylabel("deflection $y$  (mm)")
        key_below(fig, axes[0], 3, fontsize=7.0)
    return found


SHAPE_NOTE = (
    "Triangles are theory's contact points at the times of the lines. Largest lift inside the zone at t = "
    "2.5·10⁻⁴ s: {:.2g} mm with the consistent mass matrix of (3.1.8), {:.2g} mm with the lumped one (thesis: {}). "
)


@item(
    "fig-3.23",
    "Middle method: geometry",
    group="contact-point",
    caption=f"Geometry at several times, contact at element middles; {SHOWN}.",
)
def middles(sheet: Sheet) -> str:
    found = evolution(sheet, "middle")
    return SHAPE_NOTE.format(1e3 * found[0], 1e3 * found[1], "1.7 mm") + (
        "The double detachment is numerical: theory's beam lies flat on the wall."
    )


@item(
    "fig-3.24",
    "Node method: geometry",
    group="contact-point",
    caption=f"Geometry at several times, contact at nodes; {SHOWN}.",
)
def nodes(sheet: Sheet) -> str:
    found = evolution(sheet, "node")
    return SHAPE_NOTE.format(1e3 * found[0], 1e3 * found[1], "0.17 mm") + (
        "The thesis's tenfold flatter node method is that of lumped masses: an impact at a node then moves no other "
        "node, while an impact at a middle, or with the consistent matrix anywhere, throws its neighbour off the wall."
    )


@item(
    "fig-3.25",
    "Nodes and middles: contact length",
    group="contact-point",
    caption=f"Contact length until τ = 0.1, both masses; {SHOWN}.",
)
def lengths(sheet: Sheet) -> str:
    found = [*four(), *reference_runs(FLAT, DURATION)]
    one_panel(sheet, contact_length, found, columns=3)
    errors = ", ".join(f"{signed(o.measures['contact_length_error'])} % ({o.label})" for o in found)
    return f"λ₀ is off by {errors}: no difference between nodes and middles that a figure shows, as the thesis found."


@item(
    "fig-3.26",
    "Nodes and middles: reaction",
    group="contact-point",
    caption=(
        "Reaction of one side until τ = 0.1, means over thirtieths of √t (a, peaks cut), impulse (b), both masses; "
        f"{SHOWN}."
    ),
)
def forces(sheet: Sheet) -> str:
    found = [*four(), *reference_runs(FLAT, DURATION)]
    reaction_and_impulse(sheet, found)
    return what_couples(found)


@item(
    "fig-3.27",
    "Nodes and middles: energy",
    group="contact-point",
    caption=f"Energy of the beam until τ = 0.1, less its 10 000 J at the first contact, both masses; {SHOWN}.",
)
def energies(sheet: Sheet) -> str:
    found = [*four(), *reference_runs(FLAT, DURATION)]
    one_panel(sheet, energy, found, columns=3)
    zone = 0.5 * 2.0 * float(found[0].exact.front(found[0].time[-1])) * 400.0
    lost = ", ".join(f"{-o.energy[-1]:.0f} J ({o.label})" for o in found[:4])
    return (
        f"Lost by t = 2.5·10⁻⁴ s: {lost}. With lumped masses the node method loses more than the middle method, as the "
        "thesis says; with the consistent matrix they lose the same. The thesis puts the loss down to the "
        "kinetic energy "
        f"of the beam that comes to rest, {zone:.0f} J, and with lumped nodes it is nearly that; exactly none "
        "is lost, all "
        "of it runs ahead as waves. What Hermite loses with its own choices is the share of the waves that its coarser "
        "elements far away and its implicit step damp."
    )


@item(
    "fig-3.28",
    "Nodes and middles: strain energy",
    group="contact-point",
    caption=f"Strain energy of the beam until τ = 0.1, both masses (a), and theory beside them (b); {SHOWN}.",
)
def strains(sheet: Sheet) -> str:
    found = four()
    with sheet.figure(1, 2, width=style.PAGE, height=2.8) as (fig, axes):
        strain(sheet, axes[0], found, theory=False)
        strain(sheet, axes[1], found)
        axes[1].set_yscale("log")
        axes[1].set_ylim(0.1, 400.0)
        for axis, letter in zip(axes, "ab"):
            sheet.panel(axis, letter)
        key_below(fig, axes[1], 3, fontsize=7.0)
    exact = float(found[0].exact.strain_energy(found[0].time[-1]))
    ends = ", ".join(f"{o.strain[-1]:.1f} J ({o.label})" for o in found)
    return (
        f"At t = 2.5·10⁻⁴ s: {ends}; thesis: 3.8 J (nodes) and 38 J (middles), which are those of the lumped masses. "
        f"Theory has {exact:.0f} J, a quarter of the energy V₀∫R dt, most of it in waves that elements longer than the "
        "front is thick cannot carry."
    )


def coupled(contact: str, mass: Mass) -> tuple[float, float]:
    """(coupling c of neighbouring rows, lift in mm)."""
    outcome = thesis("", FLAT, DURATION, contact=contact, mass=mass)
    return impact_coupling(CONTACTS[contact](), mass).neighbour, 1e3 * outcome.lift


@item(
    "extra-coupling",
    "Why nodes and middles differ",
    group="coupling",
    caption=(
        "Lift at t = 2.5·10⁻⁴ s over the coupling c of neighbouring contact rows: an impact at one row changes the "
        "velocity of the next by −cV₀. Lumped masses of rotary part r from 1/16 to 1/420, and the consistent "
        f"matrix; {SHOWN}."
    ),
)
def coupling(sheet: Sheet) -> str:
    lumped = np.array([coupled("middle", LumpedMass(1.0 / n)) for n in ROTARY])
    consistent = {contact: coupled(contact, ConsistentMass()) for contact in ("node", "middle", "mean")}
    node = coupled("node", LumpedMass(1.0 / 105.0))
    line_style: dict[str, Any] = {"ls": "", "ms": 5.5, "mew": 1.1, "mfc": "none"}
    with sheet.figure(width=4.6, height=3.2) as (fig, axis):
        axis.set_xlabel(r"coupling of neighbouring rows $c$  (1)")
        axis.set_ylabel("lift  (mm)")
        blue, red = style.COLOURS["blue"], style.COLOURS["vermilion"]
        sheet.line(axis, *lumped.T, series="middles, lumped", color=red, marker="o", ms=5, mfc="none", lw=0.8)
        sheet.line(axis, *node, series="nodes, lumped", color=blue, marker="o", **line_style)
        sheet.line(axis, *consistent["node"], series="nodes, consistent", color=blue, marker="s", **line_style)
        sheet.line(axis, *consistent["middle"], series="middles, consistent", color=red, marker="s", **line_style)
        sheet.line(axis, *consistent["mean"], series="mean gaps, consistent", color="black", marker="s", **line_style)
        crowded = {24.0: (5, -11), 28.0: (0, -11), 32.0: (-22, -10)}  # clear of their neighbours
        for (c, high), n in zip(lumped, ROTARY):
            axis.annotate(
                f"1/{n:g}", (c, high), xytext=crowded.get(n, (5, 3)), textcoords="offset points", fontsize=6.5
            )
        axis.axvline(0.0, color=style.COLOURS["grey"], lw=0.6, ls=":")
        axis.set_ylim(0.0, 3.6)
        key_below(fig, axis, 3, fontsize=7.0)
    best = int(np.argmin(lumped[:, 1]))
    return (
        f"The lift is smallest where rows do not couple, at r = 1/{ROTARY[best]:g} for middles (c = 0 at r = "
        "1/32) and for "
        "all lumped masses at nodes, and it grows with −c whatever the contact and the mass matrix are. With r "
        "= 1/105 an "
        "impact at a middle throws its neighbour off the wall at "
        f"{number(-coupled('middle', LumpedMass(1.0 / 105.0))[0])} V₀, "
        f"with the consistent matrix one at a node at {number(-consistent['node'][0])} V₀. This is the answer to the "
        "thesis's open question (3.3.5)."
    )


CANDIDATES = {
    "consistent": ConsistentMass(),
    "lumped, r = 1/24": LumpedMass(1.0 / 24.0),
    "lumped, r = 1/78": LumpedMass(1.0 / 78.0),
    "lumped, r = 1/105": THESIS_MASS,
    "lumped, r = 1/420": LumpedMass(1.0 / 420.0),
}
"""Mass matrices that the thesis's numbers were tried on; sources in :mod:`hermite_fe.masses.lumped`."""


@item(
    "extra-masses",
    "Which mass matrix the thesis's numbers ask for",
    group="coupling",
    caption=(
        f"Lift and strain energy at t = 2.5·10⁻⁴ s with contact at nodes and at middles; {SHOWN}. Then the case of "
        "3.5, contact at nodes, h = 2.5·10⁻⁷ s: lift for a₀ = 0, and λ₁ fitted for a₀ = 700 and −700 m/s²."
    ),
)
def masses(sheet: Sheet) -> str:
    rows: list[list[object]] = [["thesis", 0.17, 3.8, 1.7, 38.0, 0.41, *FITTED.values()]]
    for name, mass in CANDIDATES.items():
        cells: list[object] = [name]
        for contact in ("node", "middle"):
            outcome = thesis("", FLAT, DURATION, contact=contact, mass=mass)
            cells += [round(1e3 * outcome.lift, 2), round(float(outcome.strain[-1]), 1)]
        cells.append(round(1e3 * first.old_outcome(0.0, mass=mass).lift, 2))
        cells += [round(fitted(first.old_outcome(700.0 * sign, mass=mass)), 1) for sign in FITTED]
        rows.append(cells)
    sheet.table(
        ["mass matrix", "node: lift (mm)", "strain (J)", "middle: lift (mm)", "strain (J)", "3.5: lift (mm)",
         "λ₁, +", "λ₁, −"],
        rows,
    )  # fmt: skip
    return (
        "λ₁ in m/s^(3/2). 1/24: half elements as rods; 1/78: the diagonal of (3.1.8) scaled to the mass of the element "
        "(HRZ); 1/105: that diagonal as it is; 1/420: the row sum of the rotations. r = 1/105 comes closest to all of "
        "the printed numbers at once."
    )


@item(
    "fig-A.2",
    "Contact length at the start, nodes and middles",
    group="contact-point",
    caption=(
        "Contact length over the first part of the run, K = 1 1/m, thesis's settings, lumped mass: the middle method "
        "starts later."
    ),
)
def starts(sheet: Sheet) -> str:
    given = case(BENT, 0.01)
    found = [run(contact, "lumped", BENT, 0.01) for contact in ("node", "middle")]
    late = []
    with sheet.figure(width=4.6, height=3.0) as (fig, axis):
        axis.set_xlabel("$t$  (µs)")
        axis.set_ylabel(r"$\lambda_c$  (mm)")
        for o, colour in zip(found, style.SEQUENCE):
            sheet.line(axis, 1e6 * o.time, 1e3 * o.front, series=o.label, color=colour, drawstyle="steps-post", lw=0.9)
            late.append(float(o.time[np.argmax(o.side_impulse > 0.0)]))
        times = np.linspace(0.0, 5e-6, 200)
        sheet.line(axis, 1e6 * times, 1e3 * Exact(given.impact).front(times), series="theory", **THEORY)
        axis.set_xlim(0, 5)
        axis.set_ylim(0, 17)
        key_below(fig, axis, 3, fontsize=7.0)
    predicted = BENT * 2.5e-3**2 / 8.0 / 20.0
    return (
        f"The middle of the first element reaches the wall KΔx²/(8V₀) = {predicted:.1e} s after the centre would; "
        f"its first reaction is seen at {late[1]:.1e} s, that of the node method at {late[0]:.1e} s. The thesis's "
        "7.5·10⁻⁸ s joins nodes by straight lines, which doubles it."
    )


def raw(axes: Sequence[Axes], sheet: Sheet, mass: str) -> list[float]:
    """Unaveraged reaction of one side, every saved interval; returns the rms of each over theory's mean."""
    noise = []
    for axis, contact, colour in zip(axes, ("node", "middle"), style.SEQUENCE):
        history = thesis_history(FLAT, DURATION, contact=contact, mass=MASSES[mass])
        exact, time = Exact(history.impact), history.time
        impulse = history.array("total_impulse") / 2.0
        force = np.diff(impulse) / np.diff(time)
        middle = 0.5 * (time[1:] + time[:-1])
        target = exact.side_reaction(middle)
        late = middle > 0.5 * time[-1]
        noise.append(float(np.sqrt(np.mean((force[late] / target[late] - 1.0) ** 2))))
        sheet.line(axis, 1e6 * middle, 1e-3 * force, series=label_of(contact, mass), color=colour, lw=0.4)
        sheet.line(axis, 1e6 * middle, 1e-3 * target, series="theory", **THEORY)
        axis.set_xlim(0, 1e6 * time[-1])
        axis.set_ylim(1e-1, 1e3)
        axis.set_yscale("log")
    return noise


@item(
    "fig-A.3",
    "Reaction without filtering, nodes and middles",
    group="contact-point",
    caption=(
        "Reaction of one side, neither filtered nor averaged but over the saved intervals (half a "
        f"microsecond), on a logarithmic axis that shows all of it: consistent mass (a, b), lumped (c, d); {SHOWN}."
    ),
)
def unfiltered(sheet: Sheet) -> str:
    noise = {}
    with sheet.figure(2, 2, width=style.PAGE, height=4.4, sharex=True, sharey=True) as (_, axes):
        for row, mass in enumerate(MASSES):
            noise[mass] = raw(axes[row], sheet, mass)
            for axis, letter, contact in zip(axes[row], "abcd"[2 * row :], ("nodes", "middles")):
                sheet.panel(axis, letter, text=f"{contact}, {mass} mass")
        for axis in axes[1]:
            axis.set_xlabel("$t$  (µs)")
        for axis in axes[:, 0]:
            axis.set_ylabel("reaction of one side  (kN)")
    parts = []
    for mass, (node, middle) in noise.items():
        quiet = (
            "middles are quieter" if middle < 0.95 * node else "nodes are quieter" if node < 0.95 * middle else "alike"
        )
        parts.append(f"{number(node)} (nodes) and {number(middle)} (middles) with the {mass} matrix: {quiet}")
    return (
        f"Scatter about theory in the second half, root mean square over theory: {'; '.join(parts)} (thesis: middles)."
    )
