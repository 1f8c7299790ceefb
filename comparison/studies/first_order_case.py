"""The case that the thesis gave up on (3.5, Figs 3.33–3.36): a₀ = ±200 V₀ 1/s, that is ±700 m/s² at V₀ = 3.5 m/s.

    λ_c(t) = (EI/μ)^{1/4} √t (λ₀ + ελ₁ t/t*),   the thesis's fitted "λ₁" = ελ₁ (EI/μ)^{1/4}/t*  in m/s^{3/2}

fitted as the thesis did (λ₀ given, least squares in λ_c over 0 ≤ t ≤ t_f) to the contact length on the thesis's
finite beam with the thesis's settings, on a finite beam that is resolved, and on an infinite one; the last also
over ever shorter t_f, for the fit tends to ελ₁ only as t_f → 0: at the thesis's t_f the correction is a third of
the leading order.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.cases import Case
from bent_beam.impact import Impact
from bent_beam.method import Method
from comparison.figures import style
from comparison.figures.recorder import Sheet
from comparison.studies.base import Progress, Study, StudyResult
from comparison.studies.exact import Exact
from comparison.studies.outcome import Outcome
from comparison.studies.panels import contact_length, geometry, reaction
from comparison.studies.sentences import number
from comparison.studies.thesis import THESIS_MASS, Settings, Variant, run_variants, thesis_settings
from comparison.studies.variation import Setting
from hermite_fe import HermiteFE
from self_similar_fe import ExpandingMesh, SelfSimilarFE

__all__ = ["FINITE", "FITTED", "INFINITE", "OLD", "STUDY", "accelerated", "fitted", "infinite", "variants"]

Array = NDArray[np.float64]
FITTED = {1.0: 227.0, -1.0: -270.8}  # m/s^{3/2}, the thesis's fits for a₀ = ±700 m/s²
WINDOWS = (1.0, 0.5, 0.25, 0.1, 0.05)
OLD, FINITE, INFINITE = "thesis's settings", "Hermite, finite beam", "Self-similar, infinite beam"


def accelerated(impact: Impact, sign: float) -> Impact:
    """The case's |a₀|, or 200 V₀ 1/s (the thesis's choice) when it has none, with a sign."""
    size = abs(impact.acceleration) or 200.0 * impact.velocity
    return impact.replace(acceleration=sign * size)


def old_settings(impact: Impact, end: float) -> Settings:
    """Thesis: Δx = 2.5·10⁻³ m, that is 0.00875 l*, nodes; its h = 2.5·10⁻⁸ s is not needed, 3·10⁻⁶ t* are as good."""
    base = thesis_settings(impact, end)
    element = 0.00875 * impact.length_scale
    return base.replace(contact="node", element_length=element, time_step=3e-6 * impact.time_scale, mass=THESIS_MASS)


def infinite(impact: Impact) -> tuple[Impact, Method]:
    """The same impact of a long beam, and the method for it."""
    mesh = ExpandingMesh(front_resolution=0.004, interior_elements=100, decades=5.0)
    return impact.replace(length=1e3 * impact.length_scale), SelfSimilarFE(mesh=mesh)


def variants(case: Case) -> list[Variant]:
    runs = []
    for sign, name in ((1.0, "+"), (-1.0, "−")):
        impact, end = accelerated(case.impact, sign), case.end_time
        long, endless = infinite(impact)
        runs += [
            Variant(f"{name}a₀, {OLD}", impact, end, old_settings(impact, end).method(), value=sign),
            Variant(f"{name}a₀, {FINITE}", impact, end, HermiteFE(), value=sign, reference=True),
            Variant(f"{name}a₀, {INFINITE}", long, end, endless, value=sign, reference=True, save=400),
        ]
    return runs


def vary(method: Method, case: Case) -> list[Setting]:
    """The method as it is, under both accelerations."""
    return [
        Setting(f"{name}a₀", method, sign, accelerated(case.impact, sign)) for sign, name in ((1.0, "+"), (-1.0, "−"))
    ]


def fitted(outcome: Outcome, window: float = 1.0) -> float:
    """ελ₁(EI/μ)^{1/4}/t*, m/s^{3/2}, by the thesis's fit over the first ``window`` of the run."""
    exact = Exact(outcome.impact)
    scale = outcome.impact.wave_constant**0.5
    end = window * contact_time(outcome)
    t = np.linspace(0.0, end, 400)[1:]
    measured = np.interp(t, outcome.time, outcome.front)
    base, basis = scale * float(exact.parameters.lambda0) * np.sqrt(t), t**1.5
    return float(((measured - base) @ basis) / (basis @ basis))


def contact_time(outcome: Outcome) -> float:
    """Until when the beam touches, s: pulled back hard enough, it leaves the wall before the run ends."""
    highest = np.maximum.accumulate(outcome.front)
    gone = np.flatnonzero((outcome.front < 0.5 * highest) & (outcome.time > 0.2 * outcome.time[-1]))
    return float(outcome.time[gone[0] - 1] if gone.size else outcome.time[-1])


def predicted(impact: Impact) -> float:
    """Theory's ελ₁(EI/μ)^{1/4}/t*, m/s^{3/2}."""
    return float(Exact(impact).parameters.lambda1) * impact.wave_constant**0.5 / impact.time_scale


def _rows(outcomes: Sequence[Outcome]) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = []
    for o in outcomes:
        row: dict[str, Any] = {"label": o.label, "theory": predicted(o.impact), "failure": o.failure}
        for window in WINDOWS:
            row[f"fit_{window:g}"] = fitted(o, window) if o.failure is None else None
        row.update(lift=o.measures.get("lift"), steps=o.measures.get("steps"), seconds=o.measures.get("seconds"))
        rows.append(row)
    return rows


def conclude(outcomes: Sequence[Outcome]) -> str:
    text = []
    for sign, name in ((1.0, "+"), (-1.0, "−")):
        runs = {_kind(o): o for o in outcomes if o.value == sign and o.failure is None}
        if INFINITE in runs:
            text.append(_one_sign(runs, sign, name))
    if text:
        text.append(
            "What separates the fits from theory is the end time, at which the correction is no longer small, "
            "and on the finite beam the waves that come back; (3.5.5) times t*, εα = a₀t*/V₀, is the direct link "
            "between a₀ and α that the thesis has and did not use."
        )
    return " ".join(text)


def _kind(outcome: Outcome) -> str:
    """Which of the three kinds of run it is, from its label."""
    return next(kind for kind in (OLD, FINITE, INFINITE) if outcome.label.endswith(kind))


def _one_sign(runs: dict[str, Outcome], sign: float, name: str) -> str:
    endless = runs[INFINITE]
    target = predicted(endless.impact)
    sentence = (
        f"a₀ = {name}{abs(endless.impact.acceleration):g} m/s²: theory predicts {number(target)} "
        f"m/s³ᐟ²; on an infinite beam the fit gives {number(fitted(endless))} over the whole run and "
        f"{number(fitted(endless, WINDOWS[-1]))} over its first {100 * WINDOWS[-1]:g} %, tending to it as "
        "the window shrinks"
    )
    end = contact_time(endless)
    if end < 0.99 * float(endless.time[-1]):
        sentence += f" (the beam has left the wall at {1e3 * end:.2g} ms)"
    if FINITE in runs:
        finite = fitted(runs[FINITE])
        away = abs(finite - fitted(endless)) / abs(target)
        sentence += (
            f"; on the finite beam {number(finite)}: "
            + ("waves from its ends cost " if away > 0.02 else "its ends change no more than ")
            + f"{number(100 * away)} % of the prediction"
        )
    if OLD in runs:
        sentence += f"; with the thesis's settings and lumped masses {number(fitted(runs[OLD]))}"
        if abs(abs(endless.impact.acceleration) - 700.0) < 1.0:
            sentence += f" (it printed {number(FITTED[sign])})"
    return f"{sentence}."


def own(case: Case, jobs: int, progress: Progress | None) -> tuple[StudyResult, Sheet]:
    outcomes = run_variants(variants(case), jobs=jobs, progress=progress)
    columns = {
        "label": "run",
        "theory": "theory (m/s^1.5)",
        **{f"fit_{w:g}": f"fit over {100 * w:g} %" for w in WINDOWS},
        "lift": "lift/(V₀t)",
        "steps": "steps",
        "seconds": "seconds",
    }
    warnings = sorted({f"{o.label}: {w}" for o in outcomes if o.reference for w in o.warnings})
    result = StudyResult(
        STUDY.name,
        STUDY.title,
        case.title,
        columns,
        _rows(outcomes),
        conclude(outcomes),
        outcomes=list(outcomes),
        warnings=warnings,
    )
    sheet = Sheet()
    draw(sheet, outcomes)
    return result, sheet


def draw(sheet: Sheet, outcomes: Sequence[Outcome]) -> None:
    """Geometry, contact length and reaction; a row for each sign of a₀."""
    with sheet.figure(2, 3, width=style.PAGE, height=4.9) as (fig, axes):
        for row, sign in enumerate((1.0, -1.0)):
            mine = [o for o in outcomes if o.value == sign and o.failure is None]
            for column, panel in enumerate((geometry, contact_length, reaction)):
                if mine:
                    panel(sheet, axes[row, column], mine)
                sheet.panel(axes[row, column], "abcdef"[3 * row + column])
        handles, labels = axes[0, 0].get_legend_handles_labels()
        fig.legend(handles, [label.removeprefix("+a₀, ") for label in labels], loc="outside lower center", ncols=4)


STUDY = Study("first-order-case", "The thesis's first-order case", own=own, vary=vary, heading="acceleration")
