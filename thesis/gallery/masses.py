"""Which mass matrix made the thesis's numbers, and what its coupling of neighbouring constraints has to do with it."""

from __future__ import annotations

from typing import Any

import numpy as np

from comparison.figures import style
from comparison.readable import readable
from hermite_fe import CONTACTS
from hermite_fe.contacts import impact_coupling
from hermite_fe.masses import LumpedMass, Mass
from thesis.gallery import chapter3_contact_point as contact_point
from thesis.gallery import chapter3_first_order as first
from thesis.gallery.base import item
from thesis.gallery.chapter3_contact_point import CONTACT, FLAT, SHOWN
from thesis.gallery.drawing import guide, legend_below
from thesis.gallery.runs import thesis
from thesis.sheet import Sheet
from thesis.studies.contact import NAMES
from thesis.studies.first_order_case import FITTED, fitted
from thesis.studies.thesis import CONSISTENT, MASSES, THESIS_MASS

ROTARY = (16.0, 24.0, 32.0, 50.0, 105.0, 420.0)
"""1/r of the lumped masses of the coupling figure."""


def coupled(contact: str, mass: Mass) -> tuple[float, float]:
    """(coupling c of neighbouring constraints, lift in mm)."""
    lift = thesis("", FLAT, 0.1, contact=contact, mass=mass).lift
    return impact_coupling(CONTACTS[contact](), mass).neighbour, 1e3 * lift


@item("extra-coupling", beside=contact_point.__name__, shown=SHOWN)
def coupling(sheet: Sheet) -> None:
    """Lift, mass matrix and coupling

    Lift at t = 2.5·10⁻⁴ s: (a) over the rotary part r of lumped masses, (b) over the coupling c of neighbouring
    constraints, an impact at one changing the gap velocity of the next by cV₀; {shown}. Middles lift least near c = 0
    and more on both sides of it. But c is not all: nodes have c = 0 with any lumped mass, and their lift grows with r;
    at r = 1/24 nodes and middles lift alike; the consistent matrix lifts more than lumped middles of the same c. So the
    thesis's nodes are ten times as flat as its middles (3.3.5) with lumped masses of one r, not with any.
    """
    found = {contact: np.array([coupled(contact, LumpedMass(1.0 / n)) for n in ROTARY]) for contact in CONTACT}
    full = {contact: coupled(contact, MASSES["consistent"]) for contact in CONTACT}
    marks = {"node": ("blue", "o"), "middle": ("vermilion", "s")}
    with sheet.figure(1, 2, width=style.PAGE, height=3.0, sharey=True) as (fig, axes):
        axes[0].set(xscale="log", xlabel="rotary part $r$  (1)", ylabel="lift  (mm)", ylim=(0.0, 3.6))
        axes[0].set_xticks([1.0 / n for n in ROTARY], [f"1/{n:g}" for n in ROTARY], fontsize=6.5, rotation=45.0)
        axes[0].minorticks_off()
        axes[1].set(xlabel=r"coupling of neighbouring constraints $c$  (1)")
        guide(axes[1], x=0.0)
        for contact, (name, marker) in marks.items():
            drawn: dict[str, Any] = {"color": style.COLOURS[name], "marker": marker, "ms": 4.5, "mfc": "none"}
            c, lift = found[contact].T
            label = f"{NAMES[contact]}, lumped"
            sheet.line(axes[0], 1.0 / np.array(ROTARY), lift, series=label, **drawn)
            sheet.line(axes[1], c, lift, series=label, **drawn | ({"ls": ""} if contact == "node" else {}))
            one, high = full[contact]
            filled = drawn | {"mfc": style.COLOURS[name], "ls": ""}
            sheet.line(axes[1], one, high, series=f"{NAMES[contact]}, consistent", **filled)
            sheet.numbers |= {f"lift (mm), {label}, r = 1/{n:g}": float(v) for n, v in zip(ROTARY, lift)}
            sheet.numbers |= {f"c, {NAMES[contact]}, consistent": one, f"lift (mm), {NAMES[contact]}, consistent": high}
        for (c, high), n in zip(found["middle"], ROTARY):
            axes[1].annotate(f"1/{n:g}", (c, high), xytext=(5, 3), textcoords="offset points", fontsize=6.5)
            sheet.numbers[f"c, middles, r = 1/{n:g}"] = float(c)
        legend_below(fig, axes[1], 4, fontsize=7.0)


CANDIDATES = {
    "consistent": CONSISTENT,
    "lumped, r = 1/24": LumpedMass(1.0 / 24.0),
    "lumped, r = 1/78": LumpedMass(1.0 / 78.0),
    "lumped, r = 1/105": THESIS_MASS,
    "lumped, r = 1/420": LumpedMass(1.0 / 420.0),
}
"""Mass matrices that the thesis's numbers were tried on; sources in :mod:`hermite_fe.masses.lumped`."""


@item("extra-masses", beside=contact_point.__name__, shown=SHOWN)
def masses(sheet: Sheet) -> None:
    """Which mass matrix the thesis's numbers ask for

    Lift and strain energy at t = 2.5·10⁻⁴ s with contact at nodes and at middles; {shown}. Then the case of 3.5,
    contact at nodes, h = 2.5·10⁻⁷ s: lift for a₀ = 0, and λ₁ fitted for a₀ = 700 and −700 m/s², in m/s^(3/2). 1/24:
    half elements as rods; 1/78: the diagonal of (3.1.8) scaled to the mass of the element (HRZ); 1/105: its rotary
    part 4l²/420, with ½μl for the deflections; 1/420: the row sum of the rotations. The lifts of nodes ask for a lumped
    mass, and of these four r = 1/105 comes closest. The strain energies of middles and λ₁ do not tell masses apart: λ₁
    changes as much with the step (below).
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
    for h in (1e-6, 5e-7, 2.5e-7):
        sheet.numbers[f"λ₁, +, lumped, r = 1/105, h = {readable(h)} s"] = fitted(first.old_outcome(700.0, time_step=h))
