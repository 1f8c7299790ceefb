"""Exudyn's penalty contact: stiffness C EI/Δx⁴, damping D √(EIμ)/Δx², spectral radius ρ∞.

Bare: no viscosity at grid scale; then with it, which is the default of :mod:`exudyn_models`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import between, number, reference_sentences, references_of, varied
from comparison.studies.thesis import Variant, references
from comparison.studies.variation import Setting, with_field

__all__ = ["STUDY", "penalised"]

STIFFNESS, DAMPING, RADII = (0.1, 1.0, 100.0), (0.0, 0.3, 30.0), (0.0, 0.9, 1.0)
BASE = {"relative_stiffness": 10.0, "relative_damping": 3.0, "spectral_radius": 0.5}
BARE, DEFAULT = "bare: C = 10, D = 3, ρ∞ = 0.5", "Exudyn's default (viscous)"
STEP = 5e-3  # h/t
SAVED = 250


def penalised(
    *,
    relative_stiffness: float,
    relative_damping: float,
    spectral_radius: float,
    hold: int = 0,
    viscosity: float | None = 0.0,
) -> Method:
    """The Exudyn path with a penalty of these settings."""
    from exudyn_models import CONTACTS, ELEMENTS, INTEGRATORS, ExudynModel

    return ExudynModel(
        contact=CONTACTS["penalty"](
            relative_stiffness=relative_stiffness, relative_damping=relative_damping, hold=hold
        ),
        element=ELEMENTS["ancf_cable"](viscosity=viscosity),
        integrator=INTEGRATORS["generalized_alpha"](spectral_radius=spectral_radius, relative_step=STEP),
    )


def variants(case: Case) -> list[Variant]:
    def run(label: str, value: float | None = None, reference: bool = False, **changes: Any) -> Variant:
        method = penalised(**{**BASE, **changes})
        return Variant(label, case.impact, case.end_time, method, value=value, reference=reference, save=SAVED)

    return [
        run(BARE),
        *(run(f"C = {c:g}", c, relative_stiffness=c) for c in STIFFNESS),
        *(run(f"D = {d:g}", d, relative_damping=d) for d in DAMPING),
        *(run(f"ρ∞ = {r:g}", r, spectral_radius=r) for r in RADII),
        run(DEFAULT, reference=True, viscosity=None),
        *references(case.impact, case.end_time),
    ]


def vary(method: Method, case: Case) -> list[Setting]:
    """Stiffness and damping of the method's contact, in units of its elements' own."""
    fields = {"C": ("relative_stiffness", (1.0, 10.0, 100.0)), "D": ("relative_damping", (0.3, 3.0, 30.0))}
    return [Setting("as it is", method)] + [
        Setting(f"{symbol} = {v:g}", with_field(method, "contact", case, **{name: v}), v)
        for symbol, (name, tried) in fields.items()
        for v in tried
    ]


def conclude(outcomes: Sequence[Outcome]) -> str:
    names = {"C": "the stiffness C", "D": "the damping D", "ρ∞": "ρ∞"}
    runs = varied(outcomes)
    text = []
    for symbol, name in names.items():
        group = [o for o in runs if o.label.startswith(f"{symbol} = ")]
        tried = [o.value for o in group if o.value is not None]
        if tried:
            text.append(
                f"Over {name} from {min(tried):g} to {max(tried):g}, r₀ is off by "
                f"{between(group, 'reaction_error', ' %')}, λ₀ by {between(group, 'contact_length_error', ' %')}, "
                f"the reaction scatters by {between(group, 'noise', ' %')} and the zone lifts by "
                f"{between(group, 'lift')} V₀t."
            )
    base = next((o for o in runs if o.label == BARE), None)
    default = next((o for o in references_of(outcomes) if o.label == DEFAULT), None)
    noisy = [o for o in runs if o.measures["noise"] is not None]
    if base is not None and default is not None and noisy:
        worst = max(noisy, key=lambda o: o.measure("noise"))
        text.append(
            f"The noisiest that finished is {worst.label} ({number(worst.measures['noise'])} %). With "
            "viscosity at grid scale the lift goes from "
            f"{number(base.measures['lift'])} to {number(default.measures['lift'])} V₀t, the error "
            f"of λ₀ from {number(base.measures['contact_length_error'])} to "
            f"{number(default.measures['contact_length_error'])} %."
        )
    others = [o for o in outcomes if o.label != DEFAULT]
    return " ".join([*text, reference_sentences(others)])


STUDY = Study("penalty", "Penalty contact in Exudyn", variants, conclude, vary=vary, heading="penalty")
