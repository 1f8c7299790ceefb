"""The coefficient of restitution (thesis 3.3.4, Figs 3.19–3.21): 0, ½ and 1."""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.thesis import Variant, cured, thesis_settings
from comparison.studies.words import cure, number, of_kind

__all__ = ["COEFFICIENTS", "STUDY"]

COEFFICIENTS = (0.0, 0.5, 1.0)


def variants(case: Case) -> list[Variant]:
    base = thesis_settings(case.impact, case.end_time)
    runs = [
        Variant(f"restitution {e:g}", case.impact, case.end_time, value=e, settings=base.replace(restitution=e))
        for e in COEFFICIENTS
    ]
    return [*runs, cured(case.impact, case.end_time)]


def conclude(outcomes: Sequence[Outcome]) -> str:
    old = {o.value: o.measures for o in of_kind(outcomes, "thesis")}
    if 0.0 not in old or 1.0 not in old:
        return cure(outcomes)
    none, full = old[0.0], old[1.0]
    lifts = (none["lift"] or 0.0, full["lift"] or 0.0)
    text = [
        f"Restitution 1 lifts the zone by {number(lifts[1])} V₀t against {number(lifts[0])} V₀t with 0, and the "
        f"force scatters by {number(full['noise'] or 0.0)} against {number(none['noise'] or 0.0)} %: "
        + ("0 it must be, as the thesis concludes." if lifts[1] > 1.5 * lifts[0] else "the two hardly differ here.")
    ]
    if none["lost_impact"] is not None:
        text.append(
            f"With 0 the impacts destroy {number(none['lost_impact'])} % of the energy that should leave as "
            f"waves, with 1 {number(abs(full['lost_impact'] or 0.0))} %. The thesis reads the first as what a "
            "real impact does; theory, whose contact points move on without doing work, keeps it all, and so "
            "does a mesh that resolves the front, with restitution 0."
        )
    return " ".join([*text, cure(outcomes)])


STUDY = Study("restitution", "Coefficient of restitution", variants, conclude, heading="restitution")
