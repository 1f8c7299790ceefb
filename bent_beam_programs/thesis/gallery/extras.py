"""What the thesis mentions or could not run: the uniform mesh, Δx = 10⁻⁴ m, conditioning, and Signorini's condition
over the whole zone (4.0.6); which mass matrix its numbers ask for."""

from typing import Any

import numpy as np

from bent_beam.meshes import GradedMesh, UniformMesh
from bent_beam_programs.thesis.gallery import chapter3_contact_point as contact_point
from bent_beam_programs.thesis.gallery import chapter3_first_order as first
from bent_beam_programs.thesis.gallery.chapter3_contact_point import COLOURS, CONTACT, FLAT, SHOWN
from bent_beam_programs.thesis.gallery.drawing import GUIDE, numbers_of, plain_line
from bent_beam_programs.thesis.gallery.runs import case, reference_history, thesis
from bent_beam_programs.thesis.sheet import Sheet, item, legend_below
from bent_beam_programs.thesis.studies import conditioning as study
from bent_beam_programs.thesis.studies.base import outcomes_of
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.first_order_case import FITTED, fitted
from bent_beam_programs.thesis.studies.numerical import NAMES
from bent_beam_programs.thesis.studies.outcome import outcome_of
from bent_beam_programs.thesis.studies.panels import contact_length, geometry
from bent_beam_programs.thesis.studies.thesis import CONSISTENT, MASSES, thesis_settings
from comparison.figures import style
from comparison.readable import readable
from hermite_fe import CONTACTS, HermiteFE
from hermite_fe.contacts import impact_coupling
from hermite_fe.masses import LumpedMass, Mass

ROTARY = (16.0, 24.0, 32.0, 50.0, 105.0, 420.0)  # 1/r of the lumped masses of the coupling figure
# mass matrices that the thesis's numbers were tried on; sources in hermite_fe.masses.LumpedMass
CANDIDATES: dict[str, Mass] = {"consistent": CONSISTENT}
CANDIDATES |= {f"lumped, r = 1/{n}": LumpedMass(1.0 / n) for n in (24, 78, 105, 420)}


@item("extra-uniform")
def whole_beam(sheet: Sheet) -> None:
    """The uniform mesh that ran out of memory

    Uniform elements Δx = 2.5·10⁻³ m, K = 1 1/m, τ = 0.01, h = 2.5·10⁻⁸ s: L = 5 m, which took the thesis 8 513.72 s,
    and L = 50 m, which did not fit its memory. The answer is that of the graded mesh: the contact is over before the
    far elements matter.
    """
    given, rows = case(1.0, 0.01), []
    method = thesis_settings(given.impact, given.end_time).replace(mesh=UniformMesh(2.5e-3)).method()
    for length, seconds in ((5.0, "8513.72"), (50.0, "out of memory")):
        history = method.simulate(given.impact.replace(length=length), end_time=given.end_time, save=200)
        m = outcome_of(history, "").measures
        rows.append([f"{length:g}", round(length / 2.5e-3), seconds, m["seconds"], m["lift"], m["reaction_error"]])
    sheet.table(["L (m)", "elements", "thesis (s)", "ours (s)", "lift/(V₀t)", "r₀ error (%)"], rows, width=5.2)


@item("extra-fine")
def fine(sheet: Sheet) -> None:
    """Elements of 10⁻⁴ m

    Δx = 10⁻⁴ m, where the thesis's matrix was close to singular, its other settings, no cap on the ratio of lengths,
    K = 1 1/m, τ = 0.01: (a) contact length, (b) geometry at the end, beside its own Δx = 2.5·10⁻³ m. It runs, and
    closes its energy budget to rounding.
    """
    given = case(1.0, 0.01)
    zone = thesis_settings(given.impact, given.end_time).zone
    meshes = [GradedMesh(dx, 1.25, zone=zone, size_ratio=study.UNCAPPED) for dx in (2.5e-3, 1e-4)]
    found = [thesis(f"Δx = {readable(mesh.element_length)} m", 1.0, 0.01, mesh=mesh) for mesh in meshes]
    with sheet.figure(1, 2, height=2.8, legend=3) as (_, axes):
        contact_length(sheet, axes[0], found)
        geometry(sheet, axes[1], found)
    numbers_of(sheet, found, "reaction_error", "seconds")
    sheet.numbers |= {f"energy residual over the largest loss, {o.label}": o.measures["defect"] for o in found}


@item("extra-conditioning")
def conditioning(sheet: Sheet) -> None:
    """Conditioning of the step's matrix

    Condition in the 1-norm of the step's matrix (3.3.4) over Δx, K = 1 1/m, h = 2.5·10⁻⁸ s, e = 1.25 without a cap on
    the ratio of lengths: as it stands, and with deflections and rotations in one unit and the multipliers eliminated,
    as the solver here factors it. The thesis reports a matrix close to singular at Δx = 10⁻⁴ m.
    """
    found = outcomes_of(study.STUDY, case(1.0, 0.01))
    study.STUDY.draw(sheet, found)
    sheet.numbers |= {f"energy residual over the largest loss, {o.label}": o.measures.get("defect") for o in found}


@item("extra-signorini")
def signorini(sheet: Sheet) -> None:
    """Signorini's condition over the whole zone

    The two integrals of (4.0.6) over time, K = 10 1/m: ∫y² dx over the contact zone, in units of (V₀t)²λ_c, and the
    impulse of the reaction, whose product must vanish: the thesis's settings with nodes, and Hermite with its own
    choices. (4.0.6) asks one number of the whole zone; complementarity at every node and step, which implies it, is
    what the solver here asks. By (3.2.7) its second integral is ≥ 0, where ≤ 0 is printed.
    """
    runs = {
        "thesis's settings": (thesis("", 10.0, 0.1, contact="node").history, plain_line("vermilion", width=1.1)),
        HermiteFE().label: (reference_history(10.0, 0.1, HermiteFE.path), style.mark(HermiteFE.path)),
    }
    with sheet.figure(1, 2, height=2.7, legend=2) as (_, axes):
        for name, (history, line) in runs.items():
            exact, gap, t, speed = Exact(history.impact), history.array("gap"), history.time, history.impact.velocity
            zone = np.zeros(t.size)  # of nine tenths of the contact zone, by trapezoids of nodal gaps
            for k, front in enumerate(0.9 * exact.front(t)):
                x = history.positions(k)
                inside = (x >= 0.0) & (x <= front)
                if inside.sum() > 2:
                    zone[k] = np.trapezoid(gap[k, inside] ** 2, x[inside]) / ((speed * t[k]) ** 2 * front)
            kept = np.flatnonzero(zone > 0.0)
            kept = kept[:: max(1, kept.size // 40)] if line.get("marker") else kept
            sheet.line(axes[0], 1e6 * t[kept], zone[kept], series=name, **line)
            sheet.line(axes[1], 1e6 * t[kept], history.array("total_impulse")[kept], series=name, **line)
            sheet.numbers[f"∫y² dx/((V₀t)²λ_c) at the end, {name}"] = float(zone[-1])
        axes[0].set(xlabel="$t$  (µs)", ylabel=r"$\int y^2\,dx\;/\;(V_0t)^2\lambda_c$  (1)", yscale="log")
        axes[1].set(xlabel="$t$  (µs)", ylabel="impulse  (N s)")


def coupled(contact: str, mass: Mass) -> tuple[float, float]:
    """(coupling c of neighbouring constraints, lift in mm)."""
    lift = 1e3 * thesis("", FLAT, 0.1, contact=contact, mass=mass).lift
    return impact_coupling(CONTACTS[contact](), mass), lift


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
    with sheet.figure(1, 2, height=3.0, sharey=True) as (fig, axes):
        axes[0].set(xscale="log", xlabel="rotary part $r$  (1)", ylabel="lift  (mm)", ylim=(0.0, 3.6))
        axes[0].set_xticks([1.0 / n for n in ROTARY], [f"1/{n:g}" for n in ROTARY], fontsize=6.5, rotation=45.0)
        axes[0].minorticks_off()
        axes[1].set(xlabel=r"coupling of neighbouring constraints $c$  (1)", ylabel="lift  (mm)")
        axes[1].axvline(0.0, **GUIDE)
        for contact, marker in zip(CONTACT, "os"):
            drawn: dict[str, Any] = {"color": COLOURS["lumped", contact], "marker": marker, "ms": 4.5, "mfc": "none"}
            c, lift = found[contact].T
            label = f"{NAMES[contact]}, lumped"
            sheet.line(axes[0], 1.0 / np.array(ROTARY), lift, series=label, **drawn)
            sheet.line(axes[1], c, lift, series=label, **drawn | ({"ls": ""} if contact == "node" else {}))
            one, high = coupled(contact, MASSES["consistent"])
            shade = COLOURS["consistent", contact]
            filled = drawn | {"color": shade, "mfc": shade, "ls": ""}
            sheet.line(axes[1], one, high, series=f"{NAMES[contact]}, consistent", **filled)
            sheet.numbers |= {f"lift (mm), {label}, r = 1/{n:g}": float(v) for n, v in zip(ROTARY, lift)}
            sheet.numbers |= {f"c, {NAMES[contact]}, consistent": one, f"lift (mm), {NAMES[contact]}, consistent": high}
        for (c, high), n in zip(found["middle"], ROTARY):
            axes[1].annotate(f"1/{n:g}", (c, high), xytext=(5, 3), textcoords="offset points", fontsize=6.5)
            sheet.numbers[f"c, middles, r = 1/{n:g}"] = float(c)
        legend_below(fig, axes[1], 4, fontsize=7.0)


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
        runs = [thesis("", FLAT, 0.1, contact=contact, mass=mass) for contact in CONTACT]
        cells = [number for o in runs for number in (round(1e3 * o.lift, 2), round(float(o.strain[-1]), 1))]
        fits = [round(fitted(first.old(700.0 * sign, mass=mass)), 1) for sign in FITTED]
        rows.append([name, *cells, round(1e3 * first.old(0.0, mass=mass).lift, 2), *fits])
    columns = ("mass matrix", "node: lift (mm)", "strain (J)", "middle: lift (mm)", "strain (J)", "3.5: lift (mm)")
    sheet.table([*columns, "λ₁, +", "λ₁, −"], rows)
    for h in (1e-6, 5e-7, 2.5e-7):
        sheet.numbers[f"λ₁, +, lumped, r = 1/105, h = {readable(h)} s"] = fitted(first.old(700.0, time_step=h))
