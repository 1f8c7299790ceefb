"""Numerical damping (thesis 3.3.3, Figs 3.17, 3.18): the spectral radius ρ∞, and bending viscosity at grid scale."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bent_beam.cases import Case
from bent_beam.method import Method
from comparison.studies.base import Study
from comparison.studies.outcome import Outcome
from comparison.studies.sentences import between, moves, number, reference_sentences, varied
from comparison.studies.thesis import Variant, references, thesis_settings
from comparison.studies.variation import NotVaried, Setting, part_of, with_field

__all__ = ["RADII", "STUDY"]

RADII = (1.0, 0.8, 0.5, 0.2, 0.0)

DAMPS: dict[str, Callable[[float], float]] = {
    "spectral_radius": lambda radius: radius,
    "theta": lambda radius: 1.0 / (1.0 + radius),
    "gamma": lambda radius: (3.0 - radius) / (2.0 + 2.0 * radius),
}
"""Field of an integrator → its value for ρ∞: the θ-method amplifies ever higher frequencies by (1 − θ)/θ, Newmark's
with β = (γ + ½)²/4 by (3/2 − γ)/(γ + ½) (Hughes 2000, 9.3)."""


def variants(case: Case) -> list[Variant]:
    impact, end = case.impact, case.end_time
    base = thesis_settings(impact, end)
    runs = [
        Variant(f"ρ∞ = {radius:g}", impact, end, base.replace(spectral_radius=radius).method(), value=radius)
        for radius in RADII
    ]
    viscous = Variant("ρ∞ = 0.8, grid viscosity 0.3", impact, end, base.replace(viscosity=0.3).method())
    return [*runs, viscous, *references(impact, end)]


def vary(method: Method, case: Case) -> list[Setting]:
    """The integrator's own damping, as the ρ∞ that it means."""
    integrator = part_of(method, "integrator", case)
    name = next((n for n in DAMPS if hasattr(integrator, n)), None)
    if name is None:
        raise NotVaried(f"its integrator ({type(integrator).__name__}) has no damping to vary ({', '.join(DAMPS)})")
    if getattr(integrator, "beta", None) is not None:
        raise NotVaried(f"its integrator sets beta = {integrator.beta!r}, which gamma alone does not follow")
    return [
        Setting(f"ρ∞ = {radius:g}", with_field(method, "integrator", case, **{name: DAMPS[name](radius)}), radius)
        for radius in RADII
    ]


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


STUDY = Study("damping", "Numerical damping", variants, conclude, vary=vary, heading="damping")
