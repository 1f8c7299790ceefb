"""Numerical damping (thesis 3.3.3, Figs 3.17, 3.18): the spectral radius ρ∞, and bending viscosity at grid scale."""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.thesis import Variant, cured, thesis_settings
from comparison.studies.words import between, cure, moves, number, of_kind

__all__ = ["RADII", "STUDY"]

RADII = (1.0, 0.8, 0.5, 0.2, 0.0)


def variants(case: Case) -> list[Variant]:
    base = thesis_settings(case.impact, case.end_time)
    runs = [
        Variant(
            f"ρ∞ = {radius:g}", case.impact, case.end_time, value=radius, settings=base.replace(spectral_radius=radius)
        )
        for radius in RADII
    ]
    runs.append(
        Variant("ρ∞ = 0.8, grid viscosity 0.3", case.impact, case.end_time, settings=base.replace(viscosity=0.3))
    )
    return [*runs, cured(case.impact, case.end_time)]


def conclude(outcomes: Sequence[Outcome]) -> str:
    old = [o for o in of_kind(outcomes, "thesis") if o.value is not None]
    viscous = [o for o in of_kind(outcomes, "thesis") if o.value is None]
    agrees = not moves(old, "lift", tell=0.1, relative=True)
    text = [
        f"ρ∞ from 1 to 0 {'does not change' if agrees else 'changes'} the geometry (lift {between(old, 'lift')} V₀t)"
        f"{', as the thesis found' if agrees else ''}; r₀ is off by {between(old, 'reaction_error', ' %')}."
    ]
    pairs = [(o.measures["lost_impact"], o.measures["lost_damping"]) for o in old]
    losses = [(i, d) for i, d in pairs if i is not None and d is not None]
    if losses:
        less = all(d < i for i, d in losses)
        text.append(
            f"Of the energy that the exact impact hands over to waves, the impacts of the mesh points destroy "
            f"{between(old, 'lost_impact', ' %')}, the algorithmic damping {between(old, 'lost_damping', ' %')}. "
            f"Theory loses none: {'the thesis is right that damping takes less than the impacts, but ' if less else ''}"
            "both losses are numerical, and the waves that are missing are those which the elements cannot carry."
        )
    if viscous:
        m = viscous[0].measures
        text.append(
            f"Bending viscosity at grid scale gives a lift of {number(m['lift'] or 0.0)} V₀t and "
            f"{number(m['noise'] or 0.0)} % of noise (ρ∞ = 0.8 alone: "
            f"{number(next((o.measures['noise'] or 0.0 for o in old if o.value == 0.8), 0.0))} %)."
        )
    return " ".join([*text, cure(outcomes)])


STUDY = Study("damping", "Numerical damping", variants, conclude, heading="damping")
