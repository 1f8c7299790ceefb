"""Numerical damping (thesis 3.3.3, Figs 3.17, 3.18): the spectral radius ρ∞, and bending viscosity at grid scale."""

from __future__ import annotations

from collections.abc import Sequence

from bent_beam.cases import Case
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import between, moves, number, reference_sentences, varied
from comparison.studies.thesis import Variant, references, thesis_settings

__all__ = ["RADII", "STUDY"]

RADII = (1.0, 0.8, 0.5, 0.2, 0.0)


def variants(case: Case) -> list[Variant]:
    impact, end = case.impact, case.end_time
    base = thesis_settings(impact, end)
    runs = [
        Variant(f"ρ∞ = {radius:g}", impact, end, base.replace(spectral_radius=radius).method(), value=radius)
        for radius in RADII
    ]
    viscous = Variant("ρ∞ = 0.8, grid viscosity 0.3", impact, end, base.replace(viscosity=0.3).method())
    return [*runs, viscous, *references(impact, end)]


def conclude(outcomes: Sequence[Outcome]) -> str:
    radii = [o for o in varied(outcomes) if o.value is not None]
    viscous = [o for o in varied(outcomes) if o.value is None]
    agrees = not moves(radii, "lift", least=0.1, relative=True)
    text = [
        f"ρ∞ from 1 to 0 {'does not change' if agrees else 'changes'} the geometry (lift {between(radii, 'lift')} V₀t)"
        f"{', as the thesis found' if agrees else ''}; r₀ is off by {between(radii, 'reaction_error', ' %')}."
    ]
    pairs = [(o.measures["lost_impact"], o.measures["lost_damping"]) for o in radii]
    losses = [(i, d) for i, d in pairs if i is not None and d is not None]
    if losses:
        less = all(d < i for i, d in losses)
        text.append(
            f"Of the energy that the exact impact radiates as waves, the impacts of the mesh points destroy "
            f"{between(radii, 'lost_impact', ' %')}, the algorithmic damping {between(radii, 'lost_damping', ' %')}. "
            f"Theory loses none: {'the thesis is right that damping takes less than the impacts, but ' if less else ''}"
            "both losses are numerical, and the waves that are missing are those which the elements cannot carry."
        )
    for o in viscous:
        alone = next((r.measures["noise"] for r in radii if r.value == 0.8), None)
        text.append(
            f"Bending viscosity at grid scale gives a lift of {number(o.measures['lift'])} V₀t and "
            f"{number(o.measures['noise'])} % of noise (ρ∞ = 0.8 alone: {number(alone)} %)."
        )
    return " ".join([*text, reference_sentences(outcomes)])


STUDY = Study("damping", "Numerical damping", variants, conclude, heading="damping")
