"""Chapter 3, section 3.3.5, and appendix A.7: contact at nodes against contact at element middles."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.looks import THEORY, key_below, one_panel, wall
from comparison.gallery.runs import case, ours, thesis, thesis_history
from comparison.studies import contact_point
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome
from comparison.studies.panels import contact_length, energy, reaction, strain

FLAT, DURATION = 1.0 / 80.0, 0.1
BENT = 1.0
SHOWN = "K = 1/80 1/m, Δx = 2.5·10⁻³ m, h = 2.5·10⁻⁸ s, e = 1.25, ρ∞ = 0.8"
TIMES = (2.5e-5, 1e-4, 1.75e-4, 2.5e-4)
METHODS = {"node": "contact at nodes", "middle": "contact at element middles"}


def methods(curvature: float, duration: float) -> list[Outcome]:
    """Node and middle method."""
    return [thesis(name, curvature, duration, contact=contact) for contact, name in METHODS.items()]


def both() -> list[Outcome]:
    """Node and middle method, and ours."""
    return [*methods(FLAT, DURATION), ours(FLAT, DURATION)]


def evolution(sheet: Sheet, contact: str) -> float:
    """Geometry at several times, theory's contact points below; returns the last lift inside, m."""
    history = thesis_history(FLAT, DURATION, contact=contact)
    exact, gap, x = Exact(history.impact), history.array("gap"), history.positions(-1)
    with sheet.figure(width=4.8, height=3.0) as (fig, axis):
        axis.set_xlabel("$x$  (m)")
        axis.set_ylabel("deflection $y$  (mm)")
        for i, t in enumerate(TIMES):
            k = int(np.argmin(np.abs(history.time - t)))
            front = float(exact.front(t))
            lift = float(gap[k][x < 0.9 * front].max())
            near = x <= 1.1
            sheet.line(
                axis, x[near], -1e3 * gap[k][near], series=f"t = {1e4 * t:g}·10⁻⁴ s", color=style.SEQUENCE[i], lw=0.9
            )
            axis.plot([front], [0.0], marker="v", ms=5, color=style.SEQUENCE[i], clip_on=False, zorder=5)
        places = np.linspace(0.0, 1.1, 300)
        sheet.line(
            axis,
            places,
            -1e3 * exact.gap(places, TIMES[-1]),
            series=f"theory, t = {1e4 * TIMES[-1]:g}·10⁻⁴ s",
            **THEORY,
        )
        wall(axis, 1.0)
        axis.set_xlim(0, 1.1)
        axis.set_ylim(-2.5, 0.4)
        key_below(fig, axis, 3, fontsize=7.0)
    return lift


SHAPE_NOTE = (
    "Triangles are theory's contact points at the times of the lines. Largest lift inside the zone at t = "
    "2.5·10⁻⁴ s: {:.2g} mm (thesis: {}). "
)


@item(
    "fig-3.23",
    "Middle method: geometry",
    group="contact-point",
    caption=f"Geometry at several times, contact at element middles; {SHOWN}.",
)
def middles(sheet: Sheet) -> str:
    return SHAPE_NOTE.format(1e3 * evolution(sheet, "middle"), "1.7 mm") + (
        "The double detachment is numerical: theory's beam lies flat on the wall."
    )


@item(
    "fig-3.24",
    "Node method: geometry",
    group="contact-point",
    caption=f"Geometry at several times, contact at nodes; {SHOWN}.",
)
def nodes(sheet: Sheet) -> str:
    return SHAPE_NOTE.format(1e3 * evolution(sheet, "node"), "0.17 mm") + (
        "The thesis's node method was ten times flatter than its middle method; with the same settings ours is "
        "not: it is no property of the method alone."
    )


@item(
    "fig-3.25",
    "Nodes and middles: contact length",
    group="contact-point",
    caption=f"Contact length until τ = 0.1; {SHOWN}.",
)
def lengths(sheet: Sheet) -> str:
    found = both()
    one_panel(sheet, contact_length, found)
    errors = [o.measures["contact_length_error"] or 0.0 for o in found]
    return (
        f"λ₀ is off by {errors[0]:+.2g} % (nodes), {errors[1]:+.2g} % (middles), {errors[2]:+.1g} % (ours): no "
        "difference, as found there."
    )


@item(
    "fig-3.26",
    "Nodes and middles: reaction",
    group="contact-point",
    caption=f"Reaction of one side until τ = 0.1, averaged over eightieths of the run; {SHOWN}.",
)
def forces(sheet: Sheet) -> str:
    found = both()
    one_panel(sheet, reaction, found)
    return contact_point.conclude(found)


@item(
    "fig-3.27",
    "Nodes and middles: energy",
    group="contact-point",
    caption=f"Energy of the beam until τ = 0.1, less its 10 000 J at the first contact; {SHOWN}.",
)
def energies(sheet: Sheet) -> str:
    found = both()
    one_panel(sheet, energy, found)
    zone = 0.5 * 2.0 * float(found[0].exact.front(found[0].time[-1])) * 400.0
    return (
        f"Lost by t = 2.5·10⁻⁴ s: {-found[0].energy[-1]:.0f} J (nodes), {-found[1].energy[-1]:.0f} J (middles). "
        f"The thesis puts the loss down to the kinetic energy of the beam that comes to rest, {zone:.0f} J; "
        "exactly none is lost, all of it runs ahead as waves."
    )


@item(
    "fig-3.28",
    "Nodes and middles: strain energy",
    group="contact-point",
    caption=f"Strain energy of the beam until τ = 0.1; {SHOWN}.",
)
def strains(sheet: Sheet) -> str:
    found = both()
    shown = [o for o in found if o.kind == "thesis"]
    one_panel(sheet, strain, shown)
    exact = float(found[0].exact.strain_energy(found[0].time[-1]))
    return (
        f"At t = 2.5·10⁻⁴ s: {shown[0].strain[-1]:.1f} J (nodes), {shown[1].strain[-1]:.1f} J (middles); thesis: "
        f"3.8 and 38 J. Theory has {exact:.0f} J, a quarter of the energy V₀∫R dt, most of it in waves that "
        "elements longer than the front is thick cannot carry."
    )


@item(
    "fig-A.2",
    "Contact length at the start, nodes and middles",
    group="contact-point",
    caption=(
        "Contact length over the first part of the run, K = 1 1/m, thesis's settings: the middle method starts later."
    ),
)
def starts(sheet: Sheet) -> str:
    given = case(BENT, 0.01)
    found = methods(BENT, 0.01)
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
        "7.5·10⁻⁸ s joins nodes by straight lines."
    )


def raw(axes: Sequence[Axes], sheet: Sheet) -> list[float]:
    """Unaveraged reaction of one side, every saved interval; returns the rms of each over theory's mean."""
    noise = []
    for axis, (contact, name), colour in zip(axes, METHODS.items(), style.SEQUENCE):
        history = thesis_history(FLAT, DURATION, contact=contact)
        exact, time = Exact(history.impact), history.time
        impulse = history.array("total_impulse") / 2.0
        force = np.diff(impulse) / np.diff(time)
        middle = 0.5 * (time[1:] + time[:-1])
        target = exact.side_reaction(middle)
        late = middle > 0.5 * time[-1]
        noise.append(float(np.sqrt(np.mean((force[late] / target[late] - 1.0) ** 2))))
        axis.set_xlabel("$t$  (µs)")
        axis.set_ylabel("reaction of one side  (kN)")
        sheet.line(axis, 1e6 * middle, 1e-3 * force, series=name, color=colour, lw=0.5)
        sheet.line(axis, 1e6 * middle, 1e-3 * target, series="theory", **THEORY)
        axis.set_xlim(0, 1e6 * time[-1])
        axis.set_ylim(0, 8e-3 * float(exact.side_reaction(time[-1])))
    return noise


@item(
    "fig-A.3",
    "Reaction without filtering, nodes and middles",
    group="contact-point",
    caption=(
        "Reaction of one side, neither filtered nor averaged but over the saved intervals (half a "
        f"microsecond); {SHOWN}."
    ),
)
def unfiltered(sheet: Sheet) -> str:
    with sheet.figure(1, 2, width=style.PAGE, height=2.7) as (_, axes):
        noise = raw(axes, sheet)
        for axis, letter, contact in zip(axes, "ab", METHODS):
            sheet.panel(axis, letter, text=f"{contact} method")
            axis.legend(loc="upper right", fontsize=7)
    quiet = "the middle method is the quieter, as the thesis found" if noise[1] < 0.95 * noise[0] else "they are alike"
    return (
        f"Root mean square over theory's value in the second half: {noise[0]:.2g} (nodes) and {noise[1]:.2g} "
        f"(middles): {quiet}."
    )
