"""The coefficient of restitution (thesis 3.3.4, Figs 3.19–3.21): 0, ½ and 1."""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import number, reference_sentences, varied
from comparison.studies.thesis import Variant, references, thesis_settings
from comparison.studies.variation import Setting, with_field

__all__ = ["COEFFICIENTS", "STUDY"]

COEFFICIENTS = (0.0, 0.5, 1.0)


def variants(case: Case) -> list[Variant]:
    impact, end = case.impact, case.end_time
    base = thesis_settings(impact, end)
    runs = [
        Variant(f"restitution {e:g}", impact, end, base.replace(restitution=e).method(), value=e) for e in COEFFICIENTS
    ]
    return [*runs, *references(impact, end)]


def vary(method: Method, case: Case) -> list[Setting]:
    return [Setting(f"restitution {e:g}", with_field(method, "contact", case, restitution=e), e) for e in COEFFICIENTS]


def conclude(outcomes: Sequence[Outcome]) -> str:
    runs = {o.value: o for o in varied(outcomes)}
    none, full = runs.get(0.0), runs.get(1.0)
    if none is None or full is None:
        return reference_sentences(outcomes)
    lifts = none.measure("lift"), full.measure("lift")
    text = [
        f"Restitution 1 lifts the zone by {number(lifts[1])} V₀t against {number(lifts[0])} V₀t with 0, and the "
        f"force scatters by {number(full.measures['noise'])} against {number(none.measures['noise'])} %: "
        + ("0 is right, as the thesis concludes." if lifts[1] > 1.5 * lifts[0] else "the two hardly differ here.")
    ]
    lost, kept = none.measures["lost_impact"], full.measures["lost_impact"]
    if lost is not None and kept is not None:
        text.append(
            f"With restitution 0 the impacts destroy {number(lost)} % of the energy that should leave as waves, with "
            f"restitution 1 {'none of it' if abs(kept) < 1e-3 else f'they destroy {number(abs(kept))} %'}. The thesis "
            "reads the first as what a real impact does; theory, whose contact points move on without doing work, "
            "keeps all of it."
        )
    return " ".join([*text, reference_sentences(outcomes)])


STUDY = Study("restitution", "Coefficient of restitution", variants, conclude, vary=vary, heading="restitution")
