"""The case that the thesis gave up (3.5, Figs 3.33–3.36): a₀ = ±200 V₀ 1/s, that is ±700 m/s² at V₀ = 3.5 m/s.

    λ_c(t) = (EI/μ)^{1/4} √t (λ₀ + ελ₁ t/t*),   the thesis's fitted "λ₁" = ελ₁ (EI/μ)^{1/4}/t*  in m/s^{3/2}

fitted as in the thesis (λ₀ given, least squares in λ_c; it does not say over which time, here 0 ≤ t ≤ t_f) to the
contact length on the thesis's finite beam with the thesis's settings, on a finite beam that is resolved, and on an
infinite one. The fit tends to ελ₁ only as t_f → 0: at the thesis's t_f the correction is a third of the leading order.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from bent_beam import Case, Impact, Method
from bent_beam_programs.thesis.sheet import Sheet
from bent_beam_programs.thesis.studies.base import Study
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.of_methods import MethodOnCase
from bent_beam_programs.thesis.studies.outcome import MEASURES, Outcome
from bent_beam_programs.thesis.studies.panels import contact_length, geometry, reaction
from bent_beam_programs.thesis.studies.thesis import THESIS_MASS, Settings, Variant, thesis_settings
from hermite_fe import HermiteFE
from self_similar_fe import ExpandingMesh, SelfSimilarFE

FITTED = {1.0: 227.0, -1.0: -270.8}  # m/s^{3/2}, the thesis's fits for a₀ = ±700 m/s²
WINDOWS = (1.0, 0.5, 0.25, 0.1, 0.05)
OLD, FINITE, INFINITE = "thesis's settings", "Hermite, finite beam", "Self-similar, infinite beam"
SIGNS = {1.0: "+", -1.0: "−"}


def accelerated(impact: Impact, sign: float) -> Impact:
    """The case's |a₀|, or 200 V₀ 1/s (the thesis's choice) when it has none, with a sign."""
    return impact.replace(acceleration=sign * (abs(impact.acceleration) or 200.0 * impact.velocity))


def infinite(impact: Impact) -> tuple[Impact, Method]:
    """The same impact of a long beam, and the method for it."""
    mesh = ExpandingMesh(front_resolution=0.004, interior_elements=100, decades=5.0)
    return impact.replace(length=1e3 * impact.length_scale), SelfSimilarFE(mesh=mesh)


def old_settings(impact: Impact, end: float) -> Settings:
    """The thesis's, at nodes, with its Δx = 2.5·10⁻³ m = 0.00875 l*, ten times its h (2.5·10⁻⁷ s = 3.0625·10⁻⁶ t*), and
    the lumped masses that its numbers ask for."""
    element, step = 0.00875 * impact.length_scale, 3.0625e-6 * impact.time_scale
    base = thesis_settings(impact, end)
    return base.replace(contact="node", element_length=element, time_step=step, mass=THESIS_MASS)


def variants(case: Case) -> list[Variant]:
    """The thesis's first-order case, nodes, lumped mass

    The thesis's fit of λ₁ over ever shorter parts of the run beside theory: on the infinite beam it tends to theory as
    the part shrinks; the finite beam adds the waves that come back from its ends. The link between a₀ and α is (3.5.5)
    times t*, εα = a₀t*/V₀.
    """
    runs = []
    for sign, name in SIGNS.items():
        impact, end = accelerated(case.impact, sign), case.end_time
        long, endless = infinite(impact)
        runs += [
            Variant(f"{name}a₀, {OLD}", impact, end, old_settings(impact, end).method(), sign),
            Variant(f"{name}a₀, {FINITE}", impact, end, HermiteFE(), sign, reference=True),
            Variant(f"{name}a₀, {INFINITE}", long, end, endless, sign, reference=True, save=400),
        ]
    return runs


def vary(on: MethodOnCase) -> list[Variant]:
    """The method as it is, under both accelerations."""
    impact = on.case.impact
    return [on.setting(f"{name}a₀", on.method, s, impact=accelerated(impact, s)) for s, name in SIGNS.items()]


def fitted(outcome: Outcome, window: float = 1.0) -> float:
    """ελ₁(EI/μ)^{1/4}/t*, m/s^{3/2}, by the thesis's fit over the first ``window`` of the run."""
    # pulled back hard enough, the beam leaves the wall before the run ends
    left = outcome.front < 0.5 * np.maximum.accumulate(outcome.front)
    gone = np.flatnonzero(left & (outcome.time > 0.2 * outcome.time[-1]))
    end = float(outcome.time[gone[0] - 1] if gone.size else outcome.time[-1])
    t = np.linspace(0.0, window * end, 400)[1:]
    leading = outcome.impact.wave_constant**0.5 * float(outcome.exact.parameters.lambda0) * np.sqrt(t)
    correction, basis = np.interp(t, outcome.time, outcome.front) - leading, t**1.5
    return float((correction @ basis) / (basis @ basis))


def predicted(impact: Impact) -> float:
    """Theory's ελ₁(EI/μ)^{1/4}/t*, m/s^{3/2}."""
    return float(Exact(impact).parameters.lambda1) * impact.wave_constant**0.5 / impact.time_scale


def fits(variant: Variant, outcome: Outcome) -> dict[str, float | None]:
    """Theory's prediction and the fit over ever shorter windows."""
    found = {f"fit_{w:g}": fitted(outcome, w) if outcome.failure is None else None for w in WINDOWS}
    return {"theory": predicted(variant.impact), **found}


def draw(sheet: Sheet, outcomes: Sequence[Outcome]) -> None:
    """Geometry, contact length and reaction; a row for each sign of a₀."""
    with sheet.figure(2, 3, height=4.9, legend=4) as (_, axes):
        for row, (sign, name) in zip(axes, SIGNS.items()):
            shown = [o for o in outcomes if o.value == sign and o.failure is None]
            mine = [replace(o, label=o.label.removeprefix(f"{name}a₀, ")) for o in shown]
            for axis, panel in zip(row, (geometry, contact_length, reaction)):
                if mine:
                    panel(sheet, axis, mine)


COLUMNS = {"theory": "theory (m/s^1.5)"} | {f"fit_{w:g}": f"fit over {100 * w:g} %" for w in WINDOWS}
COLUMNS |= {name: MEASURES[name] for name in ("lift", "steps", "seconds")}
STUDY = Study("first-order-case", "acceleration", variants, vary, columns=COLUMNS, more=fits, draw=draw)
