"""Chapter 3, sections 3.3.3 and 3.3.4: spectral radius (τ = 0.01) and restitution (τ = 0.1), K = 1/40 1/m."""

from __future__ import annotations

from comparison.figures.recorder import Sheet
from comparison.gallery.base import item
from comparison.gallery.drawing import one_panel, reaction_and_impulse
from comparison.gallery.runs import reference_runs, thesis
from comparison.studies import damping as damping_study
from comparison.studies import restitution as restitution_study
from comparison.studies.outcome import Outcome
from comparison.studies.panels import energy, geometry
from comparison.studies.sentences import number, signed
from hermite_fe import HermiteFE

CURVATURE = 1.0 / 40.0
RADII = (1.0, 0.8, 0.5, 0.0)
DAMPED = "K = 1/40 1/m (κ/ν = 1.25·10⁻³), τ = 0.01, h = 2.5·10⁻⁸ s, Δx = 2.5·10⁻³ m, e = 1.25"
BOUNCED = "K = 1/40 1/m (κ/ν = 1.25·10⁻³), τ = 0.1, h = 2.5·10⁻⁸ s, Δx = 2.5·10⁻³ m, e = 1.25"


def damped() -> list[Outcome]:
    """One run a spectral radius, and the references."""
    runs = [thesis(f"ρ∞ = {radius:g}", CURVATURE, 0.01, value=radius, spectral_radius=radius) for radius in RADII]
    return [*runs, *reference_runs(CURVATURE, 0.01)]


@item(
    "fig-3.17",
    "Spectral radius: geometry",
    group="damping",
    caption="Geometry at τ = 0.01 for several spectral radii, Hermite (circles) and Self-similar (diamonds) "
    f"with their own choices, theory (black); {DAMPED}.",
)
def damped_shape(sheet: Sheet) -> str:
    found = damped()
    one_panel(sheet, geometry, found)
    return f"The values of the thesis's legend are not in its text. {damping_study.conclude(found)}"


@item(
    "fig-3.18",
    "Spectral radius: energy",
    group="damping",
    caption=(
        "Energy of the beam until τ = 0.01 for several spectral radii, Hermite (circles) and Self-similar "
        f"(diamonds) with their own choices, theory (black); {DAMPED}."
    ),
)
def damped_energy(sheet: Sheet) -> str:
    found = damped()
    one_panel(sheet, energy, found)
    exact = float(found[0].exact.fast_energy(found[0].time[-1]))
    return (
        f"The thesis reads the loss as the energy of the impact. Theory conserves energy: of the {exact:.3g} J "
        "that the wall's push hands to the waves, the thesis's settings lose "
        f"{number(found[1].measures['lost_impact'])} % in impacts of its elements, which are longer than the front is "
        f"thick. {damped_by_hermite(found)}"
    )


def damped_by_hermite(found: list[Outcome]) -> str:
    """What the finite beam loses with its own choices, and to what."""
    finite = next(o for o in found if o.mark == HermiteFE.path)
    return (
        f"Hermite with its own choices loses {-float(finite.energy[-1]):.3g} J: its grid viscosity and its implicit "
        "step damp the waves that its elements far away cannot carry."
    )


def bounced() -> list[Outcome]:
    """Restitution 0 and 1, and the references."""
    runs = [thesis(f"restitution {e:g}", CURVATURE, 0.1, value=e, restitution=e) for e in (0.0, 1.0)]
    return [*runs, *reference_runs(CURVATURE, 0.1)]


@item(
    "fig-3.19",
    "Restitution: geometry",
    group="restitution",
    caption="Geometry at τ = 0.1 for restitution 0 and 1, Hermite (circles) and Self-similar (diamonds) with "
    f"their own choices, theory (black); {BOUNCED}.",
)
def bounced_shape(sheet: Sheet) -> str:
    found = bounced()
    one_panel(sheet, geometry, found)
    return restitution_study.conclude(found)


@item(
    "fig-3.20",
    "Restitution: reaction",
    group="restitution",
    caption=(
        "Reaction of one side until τ = 0.1 for restitution 0 and 1, averaged over thirtieths of √t (a, peaks cut), "
        "and its impulse (b); "
        f"{BOUNCED}."
    ),
)
def bounced_force(sheet: Sheet) -> str:
    found = bounced()
    reaction_and_impulse(sheet, found)
    return "r₀ is off by " + ", ".join(f"{signed(o.measures['reaction_error'])} % ({o.label})" for o in found) + "."


@item(
    "fig-3.21",
    "Restitution: energy",
    group="restitution",
    caption="Energy of the beam until τ = 0.1 for restitution 0 and 1, Hermite (circles) and Self-similar "
    f"(diamonds) with their own choices, theory (black); {BOUNCED}.",
)
def bounced_energy(sheet: Sheet) -> str:
    found = bounced()
    one_panel(sheet, energy, found)
    return (
        f"With 0 the thesis's settings lose {-float(found[0].energy[-1]):.3g} J, which the thesis takes for "
        "physics; with 1 "
        f"{'they gain ' if found[1].energy[-1] > 0 else 'they lose '}{abs(float(found[1].energy[-1])):.2g} J. The "
        f"exact impact loses none. {damped_by_hermite(found)}"
    )
