"""Chapter 3, section 3.3.5, and appendix A.7: contact at nodes against contact at element middles, each with the
consistent mass matrix that the thesis prints and the lumped one that its numbers ask for.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from bent_beam.history import ImpactHistory
from comparison.figures import style
from hermite_fe import CONTACTS
from hermite_fe.delassus import impact_coupling
from hermite_fe.masses import ConsistentMass, LumpedMass, Mass
from thesis.gallery import chapter3_first_order as first
from thesis.gallery.base import item
from thesis.gallery.drawing import REACTION, THEORY, beam_at_times, guide, legend_below, numbers_of, run_figure
from thesis.gallery.maps import CellForces, draw_maps
from thesis.gallery.runs import reference_runs, thesis, thesis_history
from thesis.sheet import Sheet
from thesis.studies.contact import MASSES, NAMES
from thesis.studies.exact import Exact
from thesis.studies.first_order_case import FITTED, fitted
from thesis.studies.outcome import Outcome
from thesis.studies.panels import contact_length, energy, strain
from thesis.studies.thesis import THESIS_MASS

FLAT, BENT = 1.0 / 80.0, 1.0
CONTACT = ("node", "middle")
PAIRS = [(mass, contact) for mass in MASSES for contact in CONTACT]
SHOWN = "K = 1/80 1/m, Δx = 2.5·10⁻³ m, h = 2.5·10⁻⁸ s, e = 1.25, ρ∞ = 0.8"
TIMES = (2.5e-5, 1e-4, 1.75e-4, 2.5e-4)
ROTARY = (16.0, 24.0, 28.0, 32.0, 40.0, 50.0, 78.0, 105.0, 420.0)
"""1/r of the lumped masses of the coupling figure."""


def run(contact: str, mass: str, curvature: float = FLAT, duration: float = 0.1) -> Outcome:
    """One of the four."""
    return thesis(f"{NAMES[contact]}, {mass}", curvature, duration, contact=contact, mass=MASSES[mass])


def history(contact: str, mass: str) -> ImpactHistory:
    """The whole run of one of the four."""
    return thesis_history(FLAT, 0.1, contact=contact, mass=MASSES[mass])


def four() -> list[Outcome]:
    """Nodes and middles, consistent and lumped."""
    return [run(contact, mass) for mass, contact in PAIRS]


def six() -> list[Outcome]:
    """The same and the references."""
    return four() + reference_runs(FLAT, 0.1)


def evolution(sheet: Sheet, contact: str) -> None:
    """Geometry at several times, a panel for each mass."""
    places, last = np.linspace(0.0, 1.1, 300), TIMES[-1]
    with sheet.figure(1, 2, width=style.PAGE, height=2.9, sharey=True) as (fig, axes):
        for axis, mass in zip(axes, MASSES):
            found = history(contact, mass)
            exact = Exact(found.impact)
            beam_at_times(sheet, axis, found, TIMES, 1.1, lambda t: f"t = {1e4 * t:g}·10⁻⁴ s")
            for t, colour in zip(TIMES, style.SEQUENCE):
                axis.plot(float(exact.front(t)), 0.0, marker="^", ms=5, color=colour, clip_on=False, zorder=5)
            flat = -1e3 * exact.gap(places, last)
            sheet.line(axis, places, flat, series=f"theory, t = {1e4 * last:g}·10⁻⁴ s", **THEORY)
            style.wall_below(axis, -2.3, 0.4)
            sheet.numbers[f"largest lift inside the zone (mm), {mass} mass"] = 1e3 * run(contact, mass).lift
        sheet.letter(axes, [f"{mass} mass" for mass in MASSES])
        axes[1].set_ylabel("")
        legend_below(fig, axes[0], 3, fontsize=7.0)


@item("fig-3.23", shown=SHOWN)
def middles(sheet: Sheet) -> None:
    """Middle method: geometry

    Geometry at several times, contact at element middles; {shown}. Triangles are theory's contact points at the times
    of the lines. The thesis's lift is 1.7 mm. The double detachment is numerical: theory's beam lies flat on the wall.
    """
    evolution(sheet, "middle")


@item("fig-3.24", shown=SHOWN)
def nodes(sheet: Sheet) -> None:
    """Node method: geometry

    Geometry at several times, contact at nodes; {shown}. Triangles are theory's contact points at the times of the
    lines. The thesis's lift is 0.17 mm: its tenfold flatter node method is that of lumped masses. An impact at a node
    then moves no other node, while an impact at a middle, or with the consistent matrix anywhere, throws its neighbour
    off the wall.
    """
    evolution(sheet, "node")


@item("fig-3.25", shown=SHOWN)
def lengths(sheet: Sheet) -> None:
    """Nodes and middles: contact length

    Contact length until τ = 0.1, both masses; {shown}. Nodes and middles differ too little for a figure, as the thesis
    found.
    """
    run_figure(sheet, six, (contact_length,), columns=3)


@item("fig-3.26", shown=SHOWN)
def reactions(sheet: Sheet) -> None:
    """Nodes and middles: reaction

    Reaction of one side until τ = 0.1, means over thirtieths of √t (a, peaks cut), impulse (b), both masses; {shown}.
    """
    run_figure(sheet, six, REACTION)


@item("fig-3.27", shown=SHOWN)
def energies(sheet: Sheet) -> None:
    """Nodes and middles: energy

    Energy of the beam until τ = 0.1, less its 10 000 J at the first contact, both masses; {shown}. With lumped masses
    the node method loses more than the middle method, as the thesis says; with the consistent matrix they lose the
    same. The thesis takes the loss for the kinetic energy of the beam that comes to rest; exactly none is lost, all of
    it runs ahead as waves. Hermite with its own choices loses the share of the waves that its coarser elements far
    away and its implicit step damp.
    """
    run_figure(sheet, six, (energy,), columns=3)


@item("fig-3.28", shown=SHOWN)
def strains(sheet: Sheet) -> None:
    """Nodes and middles: strain energy

    Strain energy of the beam until τ = 0.1, both masses (a), and theory beside them (b); {shown}. The thesis's 3.8 J
    (nodes) and 38 J (middles) are those of the lumped masses. Theory has a quarter of the energy V₀∫R dt, most of it in
    waves that elements longer than the front is thick cannot carry.
    """
    found = four()
    with sheet.figure(1, 2, width=style.PAGE, height=2.8) as (fig, axes):
        strain(sheet, axes[0], found, theory=None)
        strain(sheet, axes[1], found)
        axes[1].set(yscale="log", ylim=(0.1, 400.0))
        legend_below(fig, axes[1], 3, fontsize=7.0)
    sheet.numbers |= {f"J at t = 2.5·10⁻⁴ s, {o.label}": float(o.strain[-1]) for o in found}
    sheet.numbers["J at t = 2.5·10⁻⁴ s, theory"] = float(found[0].exact.strain_energy(found[0].time[-1]))


def coupled(contact: str, mass: Mass) -> tuple[float, float]:
    """(coupling c of neighbouring constraints, lift in mm)."""
    lift = thesis("", FLAT, 0.1, contact=contact, mass=mass).lift
    return impact_coupling(CONTACTS[contact](), mass).neighbour, 1e3 * lift


@item("extra-coupling", shown=SHOWN)
def coupling(sheet: Sheet) -> None:
    """Why nodes and middles differ

    Lift at t = 2.5·10⁻⁴ s over the coupling c of neighbouring constraints: an impact at one changes the velocity of the
    next by −cV₀. Lumped masses of rotary part r from 1/16 to 1/420, and the consistent matrix; {shown}. The lift is
    smallest where constraints do not couple, at r = 1/32 for middles and for all lumped masses at nodes, and it grows
    with −c whatever the contact and the mass matrix are. This is the answer to the thesis's open question (3.3.5).
    """
    lumped = np.array([coupled("middle", LumpedMass(1.0 / n)) for n in ROTARY])
    blue, red = style.COLOURS["blue"], style.COLOURS["vermilion"]
    mark: dict[str, Any] = {"ls": "", "ms": 5.5, "mew": 1.1, "mfc": "none"}
    crowded = {24.0: (5, -11), 28.0: (0, -11), 32.0: (-22, -10)}  # clear of their neighbours
    with sheet.figure(width=4.6, height=3.2) as (fig, axis):
        axis.set(xlabel=r"coupling of neighbouring constraints $c$  (1)", ylabel="lift  (mm)", ylim=(0.0, 3.6))
        sheet.line(axis, *lumped.T, series="middles, lumped", color=red, marker="o", ms=5, mfc="none", lw=0.8)
        for contact, mass, colour, marker in (
            ("node", "lumped", blue, "o"),
            ("node", "consistent", blue, "s"),
            ("middle", "consistent", red, "s"),
            ("mean", "consistent", "black", "s"),
        ):
            name = f"{NAMES[contact]}, {mass}"
            c, lift = coupled(contact, MASSES[mass])
            sheet.line(axis, c, lift, series=name, color=colour, marker=marker, **mark)
            sheet.numbers[f"c, {name}"] = c
        for (c, high), n in zip(lumped, ROTARY):
            place = crowded.get(n, (5, 3))
            axis.annotate(f"1/{n:g}", (c, high), xytext=place, textcoords="offset points", fontsize=6.5)
            sheet.numbers[f"c, middles, r = 1/{n:g}"] = float(c)
        guide(axis, x=0.0)
        legend_below(fig, axis, 3, fontsize=7.0)


CANDIDATES = {
    "consistent": ConsistentMass(),
    "lumped, r = 1/24": LumpedMass(1.0 / 24.0),
    "lumped, r = 1/78": LumpedMass(1.0 / 78.0),
    "lumped, r = 1/105": THESIS_MASS,
    "lumped, r = 1/420": LumpedMass(1.0 / 420.0),
}
"""Mass matrices that the thesis's numbers were tried on; sources in :mod:`hermite_fe.masses.lumped`."""


@item("extra-masses", shown=SHOWN)
def masses(sheet: Sheet) -> None:
    """Which mass matrix the thesis's numbers ask for

    Lift and strain energy at t = 2.5·10⁻⁴ s with contact at nodes and at middles; {shown}. Then the case of 3.5,
    contact at nodes, h = 2.5·10⁻⁷ s: lift for a₀ = 0, and λ₁ fitted for a₀ = 700 and −700 m/s², in m/s^(3/2). 1/24:
    half elements as rods; 1/78: the diagonal of (3.1.8) scaled to the mass of the element (HRZ); 1/105: that diagonal
    as it is; 1/420: the row sum of the rotations. r = 1/105 comes closest to all of the printed numbers at once.
    """
    rows: list[list[object]] = [["thesis", 0.17, 3.8, 1.7, 38.0, 0.41, *FITTED.values()]]
    for name, mass in CANDIDATES.items():
        cells: list[object] = [name]
        for contact in CONTACT:
            outcome = thesis("", FLAT, 0.1, contact=contact, mass=mass)
            cells += [round(1e3 * outcome.lift, 2), round(float(outcome.strain[-1]), 1)]
        cells.append(round(1e3 * first.old_outcome(0.0, mass=mass).lift, 2))
        cells += [round(fitted(first.old_outcome(700.0 * sign, mass=mass)), 1) for sign in FITTED]
        rows.append(cells)
    columns = ("mass matrix", "node: lift (mm)", "strain (J)", "middle: lift (mm)", "strain (J)", "3.5: lift (mm)")
    sheet.table([*columns, "λ₁, +", "λ₁, −"], rows)


@item("fig-3.31")
def reaction_in_space_and_time(sheet: Sheet) -> None:
    """Reaction in space and time

    Reaction per cell over x and t, K = 1/80 1/m, cells even in x and √t, the axis of t scaled alike, so that the front
    is straight: the thesis's settings with nodes and middles, consistent (a, b) and lumped masses (c, d), and theory's
    ±λ₀√t (red line). The reaction is at the moving ends of the contact, as theory and thesis say: noise comes with the
    steps of the front, not from behind it.
    """
    shown = {f"contact at {contact}s, {mass} mass": history(contact, mass) for mass, contact in PAIRS}
    cells = draw_maps(sheet, shown, 2, 5.0)
    exact = Exact(next(iter(shown.values())).impact)
    for name, found in zip(shown, cells):
        sheet.numbers[f"impulse inside nine tenths of the zone (%), {name}"] = 100.0 * share_inside(found, exact)


def share_inside(cells: CellForces, exact: Exact) -> float:
    """Impulse in cells inside nine tenths of the contact zone, over all of it."""
    middle = 0.5 * (cells.places[1:] + cells.places[:-1])
    impulse = cells.force * np.diff(cells.times)[:, None]
    inner = middle[None, :] < 0.9 * exact.front(cells.times[:-1])[:, None] - (middle[1] - middle[0])
    return float(impulse[inner].sum() / impulse.sum())


@item("fig-A.2")
def starts(sheet: Sheet) -> None:
    """Contact length at the start, nodes and middles

    Contact length over the first part of the run, K = 1 1/m, thesis's settings, lumped mass. The middle method starts
    later: the middle of the first element reaches the wall KΔx²/(8V₀) = 3.9·10⁻⁸ s after the centre would. The thesis's
    7.5·10⁻⁸ s joins nodes by straight lines, which doubles it.
    """
    found = [run(contact, "lumped", BENT, 0.01) for contact in CONTACT]
    times = np.linspace(0.0, 5e-6, 200)
    with sheet.figure(width=4.6, height=3.0) as (fig, axis):
        axis.set(xlabel="$t$  (µs)", ylabel=r"$\lambda_c$  (mm)", xlim=(0, 5), ylim=(0, 17))
        for o, colour in zip(found, style.SEQUENCE):
            sheet.line(axis, 1e6 * o.time, 1e3 * o.front, series=o.label, color=colour, drawstyle="steps-post", lw=0.9)
            sheet.numbers[f"first reaction (s), {o.label}"] = float(o.time[np.argmax(o.side_impulse > 0.0)])
        sheet.line(axis, 1e6 * times, 1e3 * found[0].exact.front(times), series="theory", **THEORY)
        legend_below(fig, axis, 3, fontsize=7.0)


@item("fig-A.3", shown=SHOWN)
def unfiltered(sheet: Sheet) -> None:
    """Reaction without filtering, nodes and middles

    Reaction of one side, neither filtered nor averaged but over the saved intervals (half a microsecond), on a
    logarithmic axis that shows all of it: consistent mass (a, b), lumped (c, d); {shown}. The numbers are its scatter
    about theory in the second half, root mean square over theory (the thesis finds middles quieter).
    """
    with sheet.figure(2, 2, width=style.PAGE, height=4.4, sharex=True, sharey=True) as (_, axes):
        for axis, (mass, contact) in zip(axes.flat, PAIRS):
            found, name = history(contact, mass), f"{NAMES[contact]}, {mass}"
            time = found.time
            force = np.diff(found.array("total_impulse")) / 2.0 / np.diff(time)
            middle = 0.5 * (time[1:] + time[:-1])
            target = Exact(found.impact).side_reaction(middle)
            scatter = (force / target - 1.0)[middle > 0.5 * time[-1]]
            sheet.numbers[f"scatter, {name} mass"] = float(np.sqrt(np.mean(scatter**2)))
            colour = style.SEQUENCE[CONTACT.index(contact)]
            sheet.line(axis, 1e6 * middle, 1e-3 * force, series=name, color=colour, lw=0.4)
            sheet.line(axis, 1e6 * middle, 1e-3 * target, series="theory", **THEORY)
            axis.set(xlabel="$t$  (µs)", xlim=(0, 1e6 * time[-1]))
            axis.set(ylabel="reaction of one side  (kN)", ylim=(1e-1, 1e3), yscale="log")
            axis.label_outer()
        sheet.letter(axes, [f"{NAMES[contact]}, {mass} mass" for mass, contact in PAIRS])
    numbers_of(sheet, four(), "noise")
