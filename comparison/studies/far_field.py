"""What becomes of the waves that leave: growth of the elements, absorption at grid scale, a sponge, a longer beam."""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.thesis import Settings, Variant, cured, thesis_settings
from comparison.studies.words import cure, number, of_kind

__all__ = ["STUDY"]


def base_settings(case: Case) -> Settings:
    """Nodes held behind the front and elements of half the thesis's length, so that what is left comes from far
    away.
    """
    base = thesis_settings(case.impact, case.end_time)
    return base.replace(contact="node", hold=16, element_length=0.5 * base.element_length)


def variants(case: Case) -> list[Variant]:
    base, impact, end = base_settings(case), case.impact, case.end_time
    runs = [
        Variant(f"e = {growth:g}", impact, end, value=growth, settings=base.replace(growth=growth))
        for growth in (1.25, 1.1, 1.05, 1.02)
    ]
    runs += [
        Variant("e = 1.25, grid viscosity 0.3", impact, end, settings=base.replace(viscosity=0.3)),
        Variant("e = 1.02, grid viscosity 0.3", impact, end, settings=base.replace(growth=1.02, viscosity=0.3)),
        Variant("the same, sponge", impact, end, settings=base.replace(growth=1.02, viscosity=0.3, sponge=True)),
        Variant(
            "the same, half the length",
            impact.replace(length=0.5 * impact.length),
            end,
            settings=base.replace(growth=1.02, viscosity=0.3),
        ),
    ]
    return [*runs, cured(impact, end)]


def conclude(outcomes: Sequence[Outcome]) -> str:
    old = {o.label: o.measures for o in of_kind(outcomes, "thesis")}
    coarse, slow = old.get("e = 1.25"), old.get("e = 1.02")
    viscous, half = old.get("e = 1.02, grid viscosity 0.3"), old.get("the same, half the length")
    text = []
    if coarse and slow:
        before, after = coarse["noise"] or 0.0, slow["noise"] or 0.0
        text.append(
            f"Growing by 25 % an element leaves {number(before)} % of noise in the reaction and a lift of "
            f"{number(coarse['lift'] or 0.0)} V₀t, 2 % leave {number(after)} % and {number(slow['lift'] or 0.0)} V₀t: "
            + (
                "the coarse elements reflect what the impact radiates."
                if before > 1.25 * after
                else "in this case the waves do not reach the coarse elements and reflection is not the trouble."
            )
        )
    if coarse and (damped := old.get("e = 1.25, grid viscosity 0.3")):
        text.append(
            f"Viscosity at grid scale alone takes 25 % growth to {number(damped['noise'] or 0.0)} % "
            f"and {number(damped['lift'] or 0.0)} V₀t."
        )
    if viscous and half:
        change = abs((viscous["reaction_error"] or 0.0) - (half["reaction_error"] or 0.0))
        text.append(
            f"Half the length of the beam moves r₀ by {number(change)} %"
            + (": the ends are far enough." if change < 0.2 else ": the ends are heard.")
        )
    return " ".join([*text, cure(outcomes)])


STUDY = Study("far-field", "Far field", variants, conclude, heading="far field")
