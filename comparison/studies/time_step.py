"""The time step h (thesis 3.3.1, Figs 3.7–3.9, Table 3.1): 40, 4, 2, 1 and 0.4 times 10⁻⁵ t*, all else as the
thesis had it.
"""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.thesis import Variant, cured, thesis_settings
from comparison.studies.words import between, cure, moves, number, of_kind, values

__all__ = ["FACTORS", "STUDY"]

FACTORS = (40.0, 4.0, 2.0, 1.0, 0.4)


def variants(case: Case) -> list[Variant]:
    base = thesis_settings(case.impact, case.end_time)
    runs = [
        Variant(
            f"h = {f * base.time_step:.2g} s",
            case.impact,
            case.end_time,
            value=f * base.time_step,
            settings=base.replace(time_step=f * base.time_step),
        )
        for f in FACTORS
    ]
    return [*runs, cured(case.impact, case.end_time)]


def conclude(outcomes: Sequence[Outcome]) -> str:
    old = of_kind(outcomes, "thesis")
    fine = sorted((o for o in old if o.value is not None), key=lambda o: o.value or 0.0)[:3]
    noise = values(old, "noise")
    geometry = (
        "the time step does change the lift behind the front"
        if moves(fine, "lift", tell=0.1, relative=True)
        else "the time step does not cause the lift behind the front, as the thesis says"
    )
    reaction = (
        "and moves the reaction with it"
        if moves(fine, "reaction_error", tell=2.0)
        else "nor does it move the impulse: what the thesis saw in the reaction (Fig. 3.9) is noise of the force"
    )
    return (
        f"Between the three smallest steps {geometry} ({between(fine, 'lift')} V₀t), {reaction} "
        f"(r₀ off by {between(fine, 'reaction_error', ' %')}; the force scatters by {number(min(noise))} to "
        f"{number(max(noise))} %). What is wrong at the thesis's step is wrong at any: it comes from elements "
        "longer than the "
        f"front is thick. {cure(outcomes)}"
    )


STUDY = Study("time-step", "Time step h", variants, conclude, heading="time step")
