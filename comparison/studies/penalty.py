"""Exudyn's penalty contact: stiffness C EI/Δx⁴, damping D √(EIμ)/Δx², spectral radius ρ∞.

Bare: no viscosity at grid scale; then with it, which is the default of :mod:`exudyn_models`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bent_beam.cases import Case
from bent_beam.history import ImpactHistory
from bent_beam.impact import Impact
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.thesis import Variant, cured
from comparison.studies.words import between, cure, number

__all__ = ["STUDY", "penalised"]

STIFFNESS, DAMPING, RADII = (0.1, 1.0, 100.0), (0.0, 0.3, 30.0), (0.0, 0.9, 1.0)
BASE = {"relative_stiffness": 10.0, "relative_damping": 3.0, "spectral_radius": 0.5, "hold": 0, "viscosity": 0.0}
STEP = 5e-3  # h/t


def penalised(
    impact: Impact,
    *,
    end_time: float,
    relative_stiffness: float,
    relative_damping: float,
    spectral_radius: float,
    hold: int,
    viscosity: float | None = None,
    save: int = 250,
    **others: Any,
) -> ImpactHistory:
    """The Exudyn path with a penalty of these settings."""
    import exudyn_models

    return exudyn_models.simulate(
        impact,
        end_time=end_time,
        save=save,
        contact=exudyn_models.CONTACTS["penalty"](
            relative_stiffness=relative_stiffness, relative_damping=relative_damping, hold=hold
        ),
        element=exudyn_models.ELEMENTS["ancf_cable"](viscosity=viscosity),
        integrator=exudyn_models.INTEGRATORS["generalized_alpha"](spectral_radius=spectral_radius, relative_step=STEP),
        **others,
    )


def variants(case: Case) -> list[Variant]:
    def run(label: str, value: float | None = None, kind: str = "thesis", **changes: Any) -> Variant:
        return Variant(
            label, case.impact, case.end_time, kind=kind, value=value, runner=penalised, arguments={**BASE, **changes}
        )

    return [
        run("bare: C = 10, D = 3, ρ∞ = 0.5"),
        *(run(f"C = {c:g}", c, relative_stiffness=c) for c in STIFFNESS),
        *(run(f"D = {d:g}", d, relative_damping=d) for d in DAMPING),
        *(run(f"ρ∞ = {r:g}", r, spectral_radius=r) for r in RADII),
        run("Exudyn's default (viscous)", kind="exudyn", viscosity=None),
        cured(case.impact, case.end_time),
    ]


def conclude(outcomes: Sequence[Outcome]) -> str:
    names = {"C": "the stiffness C", "D": "the damping D", "ρ∞": "ρ∞"}
    groups = {s: [o for o in outcomes if o.label.startswith(f"{s} = ")] for s in names}
    base = next((o for o in outcomes if o.label.startswith("bare")), None)
    default = next((o for o in outcomes if o.kind == "exudyn"), None)
    text = []
    for symbol, runs in groups.items():
        if runs:
            tried = [o.value for o in runs if o.value is not None]
            text.append(
                f"Over {names[symbol]} from {min(tried):g} to {max(tried):g}, r₀ is off by "
                f"{between(runs, 'reaction_error', ' %')}, λ₀ by {between(runs, 'contact_length_error', ' %')}, "
                f"the reaction scatters by {between(runs, 'noise', ' %')} and the zone lifts by "
                f"{between(runs, 'lift')} V₀t."
            )
    if base is not None and default is not None:
        worst = max((base, *(o for runs in groups.values() for o in runs)), key=lambda o: o.measures["noise"] or 0.0)
        text.append(
            f"The noisiest that finished is {worst.label} ({number(worst.measures['noise'] or 0.0)} %). Held "
            "behind the front and with viscosity at grid scale the lift falls from "
            f"{number(base.measures['lift'] or 0.0)} to {number(default.measures['lift'] or 0.0)} V₀t, the error "
            f"of λ₀ from {number(abs(base.measures['contact_length_error'] or 0.0))} to "
            f"{number(abs(default.measures['contact_length_error'] or 0.0))} %."
        )
    return " ".join([*text, cure(outcomes)])


STUDY = Study("penalty", "Penalty contact in Exudyn", variants, conclude, heading="penalty")
