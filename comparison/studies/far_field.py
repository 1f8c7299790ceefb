"""What becomes of the waves that leave: growth of the elements, absorption at grid scale, a sponge, a longer beam."""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import number, reference_sentences, varied
from comparison.studies.thesis import Settings, Variant, references, thesis_settings
from comparison.studies.variation import (
    Setting,
    has_part,
    kinds_of,
    of_kind,
    part_of,
    resolution,
    with_field,
    with_growth,
    with_parts,
)

__all__ = ["STUDY"]

GROWTHS = (1.25, 1.1, 1.05, 1.02)
ABSORBERS = ("far_field", "element")  # parts that may have a viscosity of the grid
COARSE, SLOW, DAMPED = "e = 1.25", "e = 1.02", "e = 1.25, grid viscosity 0.3"
VISCOUS, SPONGE, HALF = (f"e = 1.02, grid viscosity 0.3{more}" for more in ("", ", sponge", ", half the length"))


def base_settings(case: Case) -> Settings:
    """Nodes held behind the front and elements of half the thesis's length, so that what is left comes from far
    away.
    """
    base = thesis_settings(case.impact, case.end_time)
    return base.replace(contact="node", hold=16, element_length=0.5 * base.element_length)


def variants(case: Case) -> list[Variant]:
    base, impact, end = base_settings(case), case.impact, case.end_time
    runs = [
        Variant(f"e = {growth:g}", impact, end, base.replace(growth=growth).method(), value=growth)
        for growth in GROWTHS
    ]
    viscous = base.replace(growth=1.02, viscosity=0.3)
    runs += [
        Variant(DAMPED, impact, end, base.replace(viscosity=0.3).method()),
        Variant(VISCOUS, impact, end, viscous.method()),
        Variant(SPONGE, impact, end, viscous.replace(sponge=True).method()),
        Variant(HALF, impact.replace(length=0.5 * impact.length), end, viscous.method()),
    ]
    return [*runs, *references(impact, end)]


def vary(method: Method, case: Case) -> list[Setting]:
    """The method as it is, on half the beam, and, where it has them, with other growths, viscosities and absorbers."""
    impact = case.impact
    found = [
        Setting("as it is", method),
        Setting("half the length", method, impact=impact.replace(length=0.5 * impact.length)),
    ]
    if has_part(method, "mesh"):
        mesh, laid_on = resolution(method, case)
        grown = {growth: with_growth(mesh, growth) for growth in GROWTHS}
        found += [Setting(f"e = {e:g}", laid_on(other), e) for e, other in grown.items() if other is not None]
    for name in ABSORBERS:
        if not has_part(method, name):
            continue
        part = part_of(method, name, case)
        if hasattr(part, "viscosity"):
            found += [
                Setting(f"viscosity {v:g}", with_field(method, name, case, viscosity=v), v) for v in (0.0, 0.3)
            ]
    if has_part(method, "far_field"):
        part = part_of(method, "far_field", case)
        for name, kind in kinds_of(method, "far_field").items():
            if kind is not type(part):
                changed = with_parts(method, far_field=of_kind(kind, part))
                found.append(Setting(name, changed))
    return found


def conclude(outcomes: Sequence[Outcome]) -> str:
    runs = {o.label: o for o in varied(outcomes)}
    text = []
    if (coarse := runs.get(COARSE)) and (slow := runs.get(SLOW)):
        before, after = coarse.measure("noise"), slow.measure("noise")
        text.append(
            f"Growing by 25 % an element leaves {number(before)} % of noise in the reaction and a lift of "
            f"{number(coarse.measures['lift'])} V₀t, 2 % leave {number(after)} % and "
            f"{number(slow.measures['lift'])} V₀t: "
            + (
                "the coarse elements reflect what the impact radiates."
                if before > 1.25 * after
                else "in this case the waves do not reach the coarse elements and reflection is not the trouble."
            )
        )
    if damped := runs.get(DAMPED):
        text.append(
            f"Viscosity at grid scale alone takes 25 % growth to {number(damped.measures['noise'])} % "
            f"and {number(damped.measures['lift'])} V₀t."
        )
    if (viscous := runs.get(VISCOUS)) and (half := runs.get(HALF)):
        change = abs(viscous.measure("reaction_error") - half.measure("reaction_error"))
        text.append(
            f"Half the length of the beam moves r₀ by {number(change)} %"
            + (": the ends are far enough." if change < 0.2 else ": waves from the ends reach the contact.")
        )
    return " ".join([*text, reference_sentences(outcomes)])


STUDY = Study("far-field", "Far field", variants, conclude, vary=vary, heading="far field")
