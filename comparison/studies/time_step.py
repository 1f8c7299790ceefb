"""The time step h (thesis 3.3.1, Figs 3.7–3.9, Table 3.1): 40, 4, 2, 1 and 0.4 times 10⁻⁵ t*, all else as the
thesis had it.
"""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import between, moves, reference_sentences, varied
from comparison.studies.thesis import Variant, references, thesis_settings
from comparison.studies.variation import NotVaried, Setting, part_of, with_field, with_parts

__all__ = ["FACTORS", "STUDY"]

FACTORS = (40.0, 4.0, 2.0, 1.0, 0.4)
OF_METHODS = (4.0, 2.0, 1.0, 0.5)  # times a method's own
STEPS = ("time_step", "growth", "relative_step")  # fields of an integrator that say how long its steps are


def variants(case: Case) -> list[Variant]:
    impact, end = case.impact, case.end_time
    base = thesis_settings(impact, end)
    steps = [f * base.time_step for f in FACTORS]
    runs = [Variant(f"h = {h:.2g} s", impact, end, base.replace(time_step=h).method(), value=h) for h in steps]
    return [*runs, *references(impact, end)]


def vary(method: Method, case: Case) -> list[Setting]:
    """Steps so many times longer; the mesh stays."""
    integrator = part_of(method, "integrator", case, filled=True)
    steps = {name: value for name in STEPS if (value := getattr(integrator, name, None)) is not None}
    if not steps:
        raise NotVaried(f"its integrator ({type(integrator).__name__}) takes its step from the mesh")
    fixed = with_parts(method, integrator=integrator)
    return [
        Setting(f"h × {f:g}", with_field(fixed, "integrator", case, **{n: f * v for n, v in steps.items()}), f)
        for f in OF_METHODS
    ]


def conclude(outcomes: Sequence[Outcome]) -> str:
    runs = sorted((o for o in varied(outcomes) if o.value is not None), key=lambda o: o.value or 0.0)
    fine = runs[:3]
    lifts, pushes = moves(fine, "lift", least=0.2, relative=True), moves(fine, "reaction_error", least=2.0)
    verdict = {
        (
            False,
            False,
        ): "the time step moves neither the lift behind the front, as the thesis says, nor the impulse: what "
        "it saw in the reaction (Fig. 3.9) is noise of the force",
        (False, True): "the time step does not move the lift behind the front, but the impulse, as the thesis says",
        (True, False): "the time step moves the lift behind the front, against the thesis, but not the impulse",
        (True, True): "the time step moves both the lift behind the front and the impulse",
    }[lifts, pushes]
    text = [
        f"Between the three smallest steps {verdict} (lift {between(fine, 'lift')} V₀t, r₀ off by "
        f"{between(fine, 'reaction_error', ' %')}; over all steps the force scatters by "
        f"{between(runs, 'noise', ' %')})."
    ]
    if not (lifts or pushes):
        text.append("What is wrong at the thesis's step is wrong at any: it comes from the mesh.")
    return " ".join([*text, reference_sentences(outcomes)])


STUDY = Study("time-step", "Time step h", variants, conclude, vary=vary, heading="time step")
