"""Chapter 3, section 3.3.5, and appendix A.7: contact at nodes and at element middles, with both masses."""

import numpy as np

from bent_beam_programs.thesis.gallery import drawing
from bent_beam_programs.thesis.gallery.runs import reference_runs, thesis
from bent_beam_programs.thesis.sheet import Sheet, item, items
from bent_beam_programs.thesis.studies import panels
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.numerical import NAMES
from bent_beam_programs.thesis.studies.outcome import Outcome, scatter
from bent_beam_programs.thesis.studies.thesis import MASSES
from comparison.figures import style
from comparison.readable import readable

FLAT, BENT = 1.0 / 80.0, 1.0
CONTACT = ("node", "middle")
PAIRS = [(mass, contact) for mass in MASSES for contact in CONTACT]
COLOURS = dict(zip(PAIRS, panels.LINES))  # of each of the four, in every figure
SHOWN = "K = 1/80 1/m, Δx = 2.5·10⁻³ m, h = 2.5·10⁻⁸ s, e = 1.25, ρ∞ = 0.8"
TIMES = (2.5e-5, 1e-4, 1.75e-4, 2.5e-4)


def run(contact: str, mass: str, curvature: float = FLAT, duration: float = 0.1) -> Outcome:
    return thesis(f"{NAMES[contact]}, {mass}", curvature, duration, contact=contact, mass=MASSES[mass])


def compare(sheet: Sheet, *shown: panels.Panel) -> None:
    """Panels of the four and of the references in a row, one legend, their numbers beside them."""
    own = [run(contact, mass) for mass, contact in PAIRS]
    outcomes = own + reference_runs(FLAT, 0.1)
    count, width = len(shown), style.PAGE if len(shown) > 1 else 4.6
    with sheet.figure(1, count, width=width, height=3.0, legend=2 + count, legend_size=7.0) as (_, axes):
        for axis, panel in zip(np.ravel(axes), shown):
            panel(sheet, axis, outcomes)
            drawing.numbers_of(sheet, outcomes, *drawing.NUMBERS.get(panel, ()))
    if panels.banded in shown:
        drawing.scatters_of(sheet, own)


def evolution(sheet: Sheet, contact: str) -> None:
    places, last = np.linspace(0.0, 1.1, 300), TIMES[-1]
    texts = [f"{mass} mass" for mass in MASSES]
    with sheet.figure(1, 2, height=2.9, texts=texts, legend=3, legend_size=7.0) as (_, axes):
        for axis, mass in zip(axes, MASSES):
            found = run(contact, mass)
            drawing.beam_at_times(sheet, axis, found.history, TIMES, 1.1, lambda t: f"t = {readable(t, 3)} s")
            for t, colour in zip(TIMES, style.SEQUENCE):
                axis.plot(float(found.exact.front(t)), 0.0, marker="^", ms=5, color=colour, clip_on=False, zorder=5)
            flat = -1e3 * found.exact.gap(places, last)
            sheet.line(axis, places, flat, series=f"theory, t = {readable(last, 3)} s", **style.THEORY)
            sheet.numbers[f"largest lift inside the zone (mm), {mass} mass"] = lift = 1e3 * found.lift
            style.wall_below(axis, -1.4 * lift, 0.25 * lift)
    if contact == "middle":
        for mass in MASSES:
            straight = run("straight", mass)
            sheet.numbers |= {
                f"largest lift (mm), straight lines, {mass} mass": 1e3 * straight.lift,
                f"strain energy at 2.5·10⁻⁴ s (J), straight lines, {mass} mass": float(straight.strain[-1]),
            }


EVOLUTION = (
    f"{SHOWN}, both masses, each with its own axis. Triangles are theory's contact points at the times of the lines"
)
items(__name__, evolution, (
    ("fig-3.23", "Middle method: geometry",
     f"Geometry at several times, contact at element middles; {EVOLUTION}. The thesis's lift is of the order of 1.7 "
     "mm; with middles of straight lines between the nodes, as 3.3.5 words it, the numbers are those below. The double "
     "detachment is numerical, as the thesis says: theory's beam lies flat on the wall.",
     "middle"),
    ("fig-3.24", "Node method: geometry",
     f"Geometry at several times, contact at nodes; {EVOLUTION}. The thesis's lift is of the order of 0.17 mm, a tenth "
     "of its middles': so it is with lumped masses, while with the consistent matrix nodes and middles lift alike.",
     "node"),
))  # fmt: skip
items(__name__, compare, (
    ("fig-3.25", "Nodes and middles: contact length",
     f"Contact length until τ = 0.1 (a), and less theory's (b), nodes and middles with both masses; {SHOWN}. As the "
     "thesis says, no significant difference.",
     panels.contact_length, panels.length_off),
    ("fig-3.26", "Nodes and middles: reaction",
     f"Reaction of one side until τ = 0.1, nodes and middles with both masses; {SHOWN}: (a) means in windows, the band "
     "holding eight tenths of the reaction of every step, filtered as in 3.3.1, peaks cut; (b) the impulse less "
     "theory's, unfiltered. The thesis finds the general behaviour of 1/√t with both. In impulse lumped nodes are "
     "nearest to theory and lumped middles furthest from it.",
     panels.banded, panels.impulse_off),
    ("fig-3.27", "Nodes and middles: energy",
     "Energy of the beam until τ = 0.1, less its 10 000 J before the contact, which is drawn too, nodes and middles "
     f"with both masses; {SHOWN}. With lumped masses the node method loses more than the middle method, as the thesis "
     "says; with the consistent matrix they lose about the same. The thesis takes the loss for the kinetic energy of "
     "the beam that comes to rest. In theory none is lost, all of it runs ahead as waves; Hermite's own mesh (circles) "
     "does not resolve so thin a front either and loses as much, Self-similar (diamonds) resolves it and loses none.",
     panels.energy),
))  # fmt: skip


@item("fig-3.28", shown=SHOWN)
def strains(sheet: Sheet) -> None:
    """Nodes and middles: strain energy

    Strain energy of the beam until τ = 0.1, nodes and middles with both masses (a), and theory beside them (b);
    {shown}. The thesis has 3.8 J with nodes and 38 J with middles. Nodes tell the masses apart, middles do not. Theory
    has a quarter of the energy V₀∫R dt, most of it in waves that elements longer than the front is thick cannot carry.
    """
    found = [run(contact, mass) for mass, contact in PAIRS]
    with sheet.figure(1, 2, height=2.8, legend=3, legend_size=7.0) as (_, axes):
        panels.strain(sheet, axes[0], found, theory=None)
        panels.strain(sheet, axes[1], found)
        axes[1].set(yscale="log", ylim=(0.1, 400.0))
    sheet.numbers |= {f"J at t = 2.5·10⁻⁴ s, {o.label}": float(o.strain[-1]) for o in found}
    sheet.numbers["J at t = 2.5·10⁻⁴ s, theory"] = float(found[0].exact.strain_energy(found[0].time[-1]))


@item("fig-3.31")
def reaction_in_space_and_time(sheet: Sheet) -> None:
    """Reaction in space and time

    Reaction per cell over x and t, K = 1/80 1/m, cells even in x and √t, the axis of t scaled alike, so that the front
    is straight: the thesis's settings with nodes and middles, lumped (a, b) and consistent mass (c, d), and theory's
    ±λ₀√t (red line). The reaction is at the moving ends of the contact, as theory and thesis say: noise comes with the
    steps of the front, not from behind it.
    """
    shown = {f"contact at {contact}s, {mass} mass": run(contact, mass).history for mass, contact in PAIRS}
    exact = Exact(next(iter(shown.values())).impact)
    for name, found in zip(shown, drawing.draw_maps(sheet, shown, 2, 5.0)):
        middle, impulse = 0.5 * (found.places[1:] + found.places[:-1]), found.force * np.diff(found.times)[:, None]
        inner = middle[None, :] < 0.9 * exact.front(found.times[:-1])[:, None] - (middle[1] - middle[0])
        share = 100.0 * float(impulse[inner].sum() / impulse.sum())
        sheet.numbers[f"impulse inside nine tenths of the zone (%), {name}"] = share


@item("fig-A.2")
def starts(sheet: Sheet) -> None:
    """Contact length at the start, nodes and middles

    Contact length over the first part of the run, K = 1 1/m, thesis's settings, lumped mass. The middle method starts
    later: the middle of the first element reaches the wall KΔx²/(8V₀) = 3.9·10⁻⁸ s after the centre would. The thesis's
    7.5·10⁻⁸ s joins nodes by straight lines, which doubles it.
    """
    found = [run(contact, "lumped", BENT, 0.01) for contact in CONTACT]
    times = np.linspace(0.0, 5e-6, 200)
    with sheet.figure(width=4.6, height=3.0, legend=3, legend_size=7.0) as (_, axis):
        axis.set(xlabel="$t$  (µs)", ylabel=r"$\lambda_c$  (mm)", xlim=(0, 5), ylim=(0, 17))
        for o, colour in zip(found, COLOURS.values()):
            sheet.line(axis, 1e6 * o.time, 1e3 * o.front, series=o.label, color=colour, drawstyle="steps-post", lw=0.9)
            sheet.numbers[f"first reaction (s), {o.label}"] = float(o.time[np.argmax(o.side_impulse > 0.0)])
        sheet.line(axis, 1e6 * times, 1e3 * found[0].exact.front(times), series="theory", **style.THEORY)


@item("fig-A.3", shown=SHOWN)
def unfiltered(sheet: Sheet) -> None:
    """Reaction without filtering, nodes and middles

    Reaction of one side in every step, unfiltered, on a logarithmic axis, on which steps without a reaction are left
    out: lumped mass (a, b), consistent (c, d); {shown}. The numbers are its scatter about theory in the second half,
    root mean square over theory. The thesis finds middles quieter: with lumped masses they are. The line at the top of
    (a) is μΔxV₀/h, the impact of one lumped node, again and again.
    """
    texts = [f"{NAMES[contact]}, {mass} mass" for mass, contact in PAIRS]
    with sheet.figure(2, 2, height=4.4, sharex=True, sharey=True, texts=texts) as (_, axes):
        for axis, (mass, contact) in zip(axes.flat, PAIRS):
            whole = run(contact, mass)
            assert whole.steps is not None
            found, name, time = whole.steps, f"{NAMES[contact]}, {mass}", whole.steps.time
            target = whole.exact.side_reaction(time)
            sheet.numbers[f"scatter, {name} mass"] = scatter(time, found.reaction, target)
            sheet.numbers[f"steps without a reaction (%), {name} mass"] = 100.0 * float(np.mean(found.reaction <= 0.0))
            colour = COLOURS[mass, contact]
            pushed = np.where(found.reaction > 0.0, found.reaction, np.nan)
            sheet.line(axis, 1e6 * time, 1e-3 * pushed, series=name, color=colour, ls="", marker=".", ms=0.8)
            sheet.line(axis, 1e6 * time, 1e-3 * target, series="theory", **style.THEORY)
            axis.set(xlabel="$t$  (µs)", xlim=(0, 1e6 * time[-1]))
            axis.set(ylabel="reaction of one side  (kN)", ylim=(1e-1, 1e4), yscale="log")
