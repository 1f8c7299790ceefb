"""Studies of contact, restitution and damping."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product

from bent_beam.cases import Case
from bent_beam.method import Method
from hermite_fe import CONTACTS
from hermite_fe.contacts import impact_coupling
from thesis.studies.base import Study
from thesis.studies.thesis import MASSES, Runs, Variant, thesis_settings, varied
from thesis.studies.variation import NotVaried, Setting, has_part, kinds_of, of_kind, part_of, with_field, with_parts

# Contact at nodes, element middles or mean gaps, each with the consistent and with a lumped mass matrix (thesis 3.3.5,
# Figs 3.22–3.28); then nodes with a bilateral start.
#
# An impact at one constraint changes the gap velocities of its neighbours by c = W_{j,j±1}/W_jj of its own change
# (:mod:`hermite_fe.contacts`).

NAMES = {"node": "nodes", "middle": "middles", "mean": "mean gaps"}


def contact_point_variants(case: Case) -> list[Variant]:
    """Contact at nodes or middles, consistent or lumped mass

    Lift and noise for contact at nodes, middles and mean gaps with both mass matrices, each with its coupling c: an
    impact at one constraint changes the gap velocity of the next by cV₀. Shorter elements, slow growth and nodes held
    behind the front show the rest of the lift.
    """
    base = thesis_settings(case.impact, case.end_time)
    runs: Runs = {
        f"{NAMES[key]}, {name}": (impact_coupling(CONTACTS[key](), mass).neighbour, {"contact": key, "mass": mass})
        for name, mass in MASSES.items()
        for key in NAMES
    }
    fine = {"contact": "node", "growth": 1.02, "element_length": 0.4 * base.element_length}
    runs["nodes, Δx/2.5, e = 1.02"] = None, fine
    runs["nodes, Δx/2.5, e = 1.02, held 16 elements"] = None, {**fine, "hold": 16, "viscosity": 0.3}
    return varied(case, base, runs)


def contact_point_vary(method: Method, case: Case) -> list[Setting]:
    """Every contact discretisation that the method knows, with every mass matrix that it knows."""
    names = ["contact", *(["mass"] if has_part(method, "mass") else [])]
    found = []
    for chosen in product(*(kinds_of(method, name).items() for name in names)):
        parts = {name: of_kind(kind, part_of(method, name, case)) for name, (_, kind) in zip(names, chosen)}
        found.append(Setting(", ".join(kind for kind, _ in chosen), with_parts(method, **parts)))
    return found


CONTACT_POINT = Study("contact-point", "contact, mass", contact_point_variants, contact_point_vary)


# The coefficient of restitution (thesis 3.3.4, Figs 3.19–3.21): 0, ½ and 1.

COEFFICIENTS = (0.0, 0.5, 1.0)


def restitution_variants(case: Case) -> list[Variant]:
    """Coefficient of restitution, middles, lumped mass

    Lift, noise and lost energy for three coefficients of restitution. In theory the contact points move on without
    work, and nothing is lost.
    """
    runs: Runs = {f"restitution {e:g}": (e, {"restitution": e}) for e in COEFFICIENTS}
    return varied(case, thesis_settings(case.impact, case.end_time), runs)


def restitution_vary(method: Method, case: Case) -> list[Setting]:
    return [Setting(f"restitution {e:g}", with_field(method, "contact", case, restitution=e), e) for e in COEFFICIENTS]


RESTITUTION = Study("restitution", "restitution", restitution_variants, restitution_vary)


# Numerical damping (thesis 3.3.3, Figs 3.17, 3.18): the spectral radius ρ∞, and bending viscosity at grid scale.

RADII = (1.0, 0.8, 0.5, 0.2, 0.0)

DAMPS: dict[str, Callable[[float], float]] = {
    "spectral_radius": lambda radius: radius,
    "theta": lambda radius: 1.0 / (1.0 + radius),
    "gamma": lambda radius: (3.0 - radius) / (2.0 + 2.0 * radius),
}
"""Field of an integrator → its value for ρ∞: the θ-method amplifies ever higher frequencies by (1 − θ)/θ, Newmark's
with β = (γ + ½)²/4 by (3/2 − γ)/(γ + ½) (Hughes 2000, 9.3)."""


def damping_variants(case: Case) -> list[Variant]:
    """Numerical damping, middles, lumped mass

    Lift, r₀, noise and lost energy for several spectral radii and with viscosity at grid scale; theory loses no energy,
    so that all of the loss is numerical.
    """
    runs: Runs = {f"ρ∞ = {radius:g}": (radius, {"spectral_radius": radius}) for radius in RADII}
    runs["ρ∞ = 0.8, grid viscosity 0.3"] = None, {"viscosity": 0.3}
    return varied(case, thesis_settings(case.impact, case.end_time), runs)


def damping_vary(method: Method, case: Case) -> list[Setting]:
    """The integrator's own damping, as the ρ∞ of the same high-frequency amplification."""
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


DAMPING = Study("damping", "damping", damping_variants, damping_vary)
