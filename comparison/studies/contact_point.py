"""Where the no-penetration is asked for, and what mass moves there (thesis 3.3.5, Figs 3.22–3.28): nodes, element
middles,
mean gaps, each with the consistent and with a lumped mass matrix; then nodes held behind the front.

An impact at one row changes the velocities of its neighbours by c = W_{j,j±1}/W_jj of what it takes
(:mod:`hermite_fe.delassus`): with c < 0 the neighbour that has just come to rest is thrown off the wall.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import number, reference_sentences, signed, varied
from comparison.studies.thesis import THESIS_MASS, Variant, references, thesis_settings
from comparison.studies.variation import Setting, has_part, kinds_of, of_kind, part_of, with_parts
from hermite_fe import CONTACTS
from hermite_fe.delassus import impact_coupling
from hermite_fe.masses import ConsistentMass

__all__ = ["MASSES", "STUDY", "label_of", "what_couples"]

NAMES = {"node": "nodes", "middle": "middles", "mean": "mean gaps"}
MASSES = {"consistent": ConsistentMass(), "lumped": THESIS_MASS}
FINE, HELD = "nodes, Δx/2.5, e = 1.02", "nodes, Δx/2.5, e = 1.02, held 16 elements"


def label_of(contact: str, mass: str) -> str:
    """How the runs of this study are called."""
    return f"{NAMES[contact]}, {mass}"


def variants(case: Case) -> list[Variant]:
    impact, end = case.impact, case.end_time
    base = thesis_settings(impact, end)
    runs = [
        Variant(
            label_of(contact, name),
            impact,
            end,
            base.replace(contact=contact, mass=mass).method(),
            value=impact_coupling(CONTACTS[contact](), mass).neighbour,
        )
        for name, mass in MASSES.items()
        for contact in NAMES
    ]
    fine = base.replace(contact="node", growth=1.02, element_length=0.4 * base.element_length)
    return [
        *runs,
        Variant(FINE, impact, end, fine.method()),
        Variant(HELD, impact, end, fine.replace(hold=16, viscosity=0.3).method()),
        *references(impact, end),
    ]


def vary(method: Method, case: Case) -> list[Setting]:
    """Every contact discretisation that the method knows, with every mass matrix that it knows."""
    varied_parts = [name for name in ("contact", "mass") if name == "contact" or has_part(method, name)]
    kinds = [kinds_of(method, name).items() for name in varied_parts]
    found = []
    for chosen in product(*kinds):
        parts = {
            name: of_kind(kind, part_of(method, name, case)) for name, (_, kind) in zip(varied_parts, chosen)
        }
        changed = with_parts(method, **parts)
        found.append(Setting(", ".join(name for name, _ in chosen), changed))
    return found


def conclude(outcomes: Sequence[Outcome]) -> str:
    runs = {o.label: o for o in varied(outcomes)}
    text = [what_couples(outcomes)]
    fine, held = runs.get(FINE), runs.get(HELD)
    if fine is not None and held is not None:
        text.append(_held(fine.measure("lift"), held.measure("lift")))
    return " ".join(t for t in (*text, reference_sentences(outcomes)) if t)


def what_couples(outcomes: Sequence[Outcome]) -> str:
    """Lift and noise with nodes and middles, for each mass matrix, beside the coupling of neighbouring rows."""
    runs = {o.label: o for o in varied(outcomes)}
    text = []
    for mass in MASSES:
        node, middle = runs.get(label_of("node", mass)), runs.get(label_of("middle", mass))
        if node is None or middle is None:
            continue
        lifts = node.measure("lift"), middle.measure("lift")
        ratio = max(lifts) / max(min(lifts), 1e-300)
        flatter = "nodes" if lifts[0] < lifts[1] else "middles"
        verdict = (
            f"{flatter} are flatter by a factor of {number(ratio)}" if ratio > 1.5 else "there is little between them"
        )
        text.append(
            f"With the {mass} mass matrix nodes lift by {number(lifts[0])} V₀t and middles by {number(lifts[1])} V₀t: "
            f"{verdict} (coupling of neighbours c = {signed(node.value)} and {signed(middle.value)}); r₀ is off by "
            f"{signed(node.measures['reaction_error'])} and {signed(middle.measures['reaction_error'])} %, the force "
            f"scatters by {number(node.measures['noise'])} and {number(middle.measures['noise'])} %."
        )
    return " ".join(text)


def _held(fine: float, held: float) -> str:
    if fine > 1.2 * held:
        return (
            "The double detachment is rectified noise and a start that no mesh resolves: behind the front the "
            "exact reaction is zero, so a one-sided law turns noise of either sign into pushes off the wall. "
            f"Shorter elements and slow growth leave {number(fine)} V₀t; with captured nodes held until the "
            "front is 16 "
            f"elements on, and damping at grid scale, {number(held)} V₀t are left."
        )
    return (
        f"Holding captured nodes behind the front on this mesh gives {number(held)} V₀t against {number(fine)} V₀t "
        "without: the front itself is not resolved here (an element is longer than it is thick), and no contact law "
        "corrects that."
    )


STUDY = Study(
    "contact-point",
    "Contact at nodes or middles, consistent or lumped mass",
    variants,
    conclude,
    heading="contact, mass",
    vary=vary,
)
