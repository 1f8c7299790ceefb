"""Studies of numerical parameters: time step, mesh and far field; contact and mass (thesis 3.3.5, Figs 3.22–3.28) with
their coupling c = W_{j,j±1}/W_jj (:mod:`hermite_fe.contacts`), restitution and damping."""

from collections.abc import Callable
from dataclasses import replace
from itertools import product
from typing import Any

from bent_beam.cases import Case
from bent_beam.meshes import ScaleFreeMesh, SquareMesh
from bent_beam_programs.thesis.studies.base import Study
from bent_beam_programs.thesis.studies.exact import Exact
from bent_beam_programs.thesis.studies.of_methods import MethodOnCase, NotVaried, of_kind
from bent_beam_programs.thesis.studies.thesis import MASSES, POINTS, Runs, Settings, Variant, thesis_settings, varied
from comparison.readable import readable
from hermite_fe.contacts import impact_coupling

STEPS_TRIED = (40.0, 4.0, 2.0, 1.0, 0.4)  # times the thesis's (3.3.1, Figs 3.7–3.9, Table 3.1)
STEP_FACTORS = (4.0, 2.0, 1.0, 0.5)  # times a method's own
STEPS = ("time_step", "growth", "relative_step")  # fields of an integrator that give the length of its steps
LENGTHS = (2.0, 1.0, 0.6, 0.3)  # times the thesis's (3.3.2, Figs 3.10–3.16)
GROWTHS = (1.05, 1.02)
LENGTH_FACTORS = (2.0, 1.0, 0.5)  # times the elements of a method's own mesh
PER_ELEMENT = 5.0  # the thesis's a: steps a front spends in each element of the square mesh
MOST = 6000  # elements of a square mesh
FAR_GROWTHS = (1.25, 1.1, 1.05, 1.02)
ABSORBERS = ("far_field", "element")  # parts that may have a viscosity of the grid
NAMES = {"node": "nodes", "middle": "middles", "mean": "mean gaps", "straight": "middles of straight lines"}
COEFFICIENTS = (0.0, 0.5, 1.0)  # of restitution; thesis 3.3.4, Figs 3.19–3.21
RADII = (1.0, 0.8, 0.5, 0.2, 0.0)  # ρ∞; thesis 3.3.3, Figs 3.17, 3.18
DAMPS: dict[str, Callable[[float], float]] = {
    "spectral_radius": lambda radius: radius,
    "theta": lambda radius: 1.0 / (1.0 + radius),
    "gamma": lambda radius: (3.0 - radius) / (2.0 + 2.0 * radius),
}
"""Field of an integrator → its value for ρ∞: the θ-method amplifies ever higher frequencies by (1 − θ)/θ, Newmark's
with β = (γ + ½)²/4 by (3/2 − γ)/(γ + ½) (Hughes 2000, 9.3)."""


def time_step_variants(case: Case) -> list[Variant]:
    """Time step h, middles, lumped mass

    Lift, impulse and noise for several time steps on the thesis's mesh: errors that the step does not change are those
    of the mesh, which the last rows resolve.
    """
    base = thesis_settings(case.impact, case.end_time)
    steps = [f * base.time_step for f in STEPS_TRIED]
    return varied(case, base, {f"h = {readable(h, 2)} s": (h, {"time_step": h}) for h in steps})


def time_step_vary(on: MethodOnCase) -> list[Variant]:
    """Steps so many times longer; the mesh stays."""
    integrator = on.part("integrator", filled=True)
    steps = {name: value for name in STEPS if (value := getattr(integrator, name, None)) is not None}
    if not steps:
        raise NotVaried(f"its integrator ({type(integrator).__name__}) takes its step from the mesh")
    longer = {f: replace(integrator, **{name: f * value for name, value in steps.items()}) for f in STEP_FACTORS}
    return [on.setting(f"h × {f:g}", on.with_parts(integrator=one), f) for f, one in longer.items()]


def square_mesh(case: Case, settings: Settings) -> SquareMesh | None:
    """x_i = λ₀√(ah)·√i over the zone (3.3.5–9), ``None`` if the contact does not spread or needs too many elements."""
    first = float(Exact(case.impact).front(PER_ELEMENT * settings.time_step))
    if first <= 0.0 or (settings.zone / first) ** 2 > MOST:
        return None
    return SquareMesh(first_element=first, zone=settings.zone, growth=settings.growth)


def mesh_variants(case: Case) -> list[Variant]:
    """Mesh, middles, lumped mass

    Lift, r₀ and noise over the element length, the growth of the elements outside the zone and the kind of mesh: the
    reaction is right where an element is short against the front, and noise tells of waves that coarse elements
    reflect.
    """
    base = thesis_settings(case.impact, case.end_time)
    own = base.element_length
    runs: Runs = {f"Δx = {readable(f * own, 2)} m, e = 1.25": (f * own, {"element_length": f * own}) for f in LENGTHS}
    runs |= {f"Δx = {readable(own, 2)} m, e = {e}": (e, {"growth": e}) for e in GROWTHS}
    square = square_mesh(case, base)
    if square is not None:
        runs['"square" mesh'] = None, {"mesh": square}
    even = ScaleFreeMesh(element_length=0.1 * own, growth=1.02)
    runs["scale-free, held, damped"] = None, {"mesh": even, "hold": 16, "viscosity": 0.3}
    return varied(case, base, runs)


def mesh_vary(on: MethodOnCase) -> list[Variant]:
    """Elements so many times longer, then other growths; the steps stay."""
    mesh = on.part("mesh", filled=True)
    return [on.setting(f"Δx × {f:g}", on.laid_on(mesh.refined(1.0 / f)), f) for f in LENGTH_FACTORS] + on.grown(GROWTHS)


def far_field_variants(case: Case) -> list[Variant]:
    """Far field, nodes, lumped mass

    Noise, lift and r₀ for several growths of the elements, with and without absorption, and on half the beam: noise
    tells of waves that coarse elements reflect, a change of r₀ on half the beam of waves from its ends.
    """
    # Nodes held behind the front and elements of half the thesis's length, so that the far field makes the errors.
    base = thesis_settings(case.impact, case.end_time)
    base = base.replace(contact="node", hold=16, element_length=0.5 * base.element_length)
    slow: dict[str, Any] = {"growth": 1.02, "viscosity": 0.3}
    runs: Runs = {f"e = {e:g}": (e, {"growth": e}) for e in FAR_GROWTHS}
    runs["e = 1.25, grid viscosity 0.3"] = None, {"viscosity": 0.3}
    runs["e = 1.02, grid viscosity 0.3"] = None, slow
    runs["e = 1.02, grid viscosity 0.3, sponge"] = None, {**slow, "sponge": True}
    short = case.impact.replace(length=0.5 * case.impact.length)
    half = Variant("e = 1.02, grid viscosity 0.3, half the length", short, case.end_time, base.replace(**slow).method())
    return varied(case, base, runs, half)


def far_field_vary(on: MethodOnCase) -> list[Variant]:
    """The method as it is, on half the beam, and, where it has them, with other growths, viscosities and absorbers."""
    half = on.case.impact.replace(length=0.5 * on.case.impact.length)
    found = [on.setting("as it is", on.method), on.setting("half the length", on.method, impact=half)]
    if on.has("mesh"):
        found += on.grown(FAR_GROWTHS)
    for name in ABSORBERS:
        if on.has(name) and hasattr(on.part(name), "viscosity"):
            found += on.over(name, "viscosity", "viscosity {:g}", (0.0, 0.3))
    if on.has("far_field"):
        part, kinds = on.part("far_field"), on.kinds("far_field")
        others = {name: kind for name, kind in kinds.items() if kind is not type(part)}
        found += [on.setting(name, on.with_parts(far_field=of_kind(kind, part))) for name, kind in others.items()]
    return found


def contact_point_variants(case: Case) -> list[Variant]:
    """Contact at nodes or middles, consistent or lumped mass

    Lift and noise for contact at nodes, middles and mean gaps with both mass matrices, each with its coupling c: an
    impact at one constraint changes the gap velocity of the next by cV₀. Shorter elements, slow growth and nodes held
    behind the front show the rest of the lift.
    """
    base = thesis_settings(case.impact, case.end_time)
    runs: Runs = {
        f"{NAMES[key]}, {name}": (impact_coupling(POINTS[key](), mass), {"contact": key, "mass": mass})
        for name, mass in MASSES.items()
        for key in NAMES
    }
    fine = {"contact": "node", "growth": 1.02, "element_length": 0.4 * base.element_length}
    runs["nodes, Δx/2.5, e = 1.02"] = None, fine
    runs["nodes, Δx/2.5, e = 1.02, held 16 elements"] = None, {**fine, "hold": 16, "viscosity": 0.3}
    return varied(case, base, runs)


def contact_point_vary(on: MethodOnCase) -> list[Variant]:
    """Every contact discretisation that the method knows, with every mass matrix that it knows."""
    names = ["contact", *(["mass"] if on.has("mass") else [])]
    found = []
    for chosen in product(*(on.kinds(name).items() for name in names)):
        parts = {name: of_kind(kind, on.part(name)) for name, (_, kind) in zip(names, chosen)}
        found.append(on.setting(", ".join(kind for kind, _ in chosen), on.with_parts(**parts)))
    return found


def restitution_variants(case: Case) -> list[Variant]:
    """Coefficient of restitution, middles, lumped mass

    Lift, noise and lost energy for three coefficients of restitution. In theory the contact points move on without
    work, and nothing is lost.
    """
    runs: Runs = {f"restitution {e:g}": (e, {"restitution": e}) for e in COEFFICIENTS}
    return varied(case, thesis_settings(case.impact, case.end_time), runs)


def damping_variants(case: Case) -> list[Variant]:
    """Numerical damping, middles, lumped mass

    Lift, r₀, noise and lost energy for several spectral radii and with viscosity at grid scale; theory loses no energy,
    so that all of the loss is numerical.
    """
    runs: Runs = {f"ρ∞ = {radius:g}": (radius, {"spectral_radius": radius}) for radius in RADII}
    runs["ρ∞ = 0.8, grid viscosity 0.3"] = None, {"viscosity": 0.3}
    return varied(case, thesis_settings(case.impact, case.end_time), runs)


def damping_vary(on: MethodOnCase) -> list[Variant]:
    """The integrator's own damping, as the ρ∞ of the same high-frequency amplification."""
    integrator = on.part("integrator")
    name = next((n for n in DAMPS if hasattr(integrator, n)), None)
    if name is None:
        raise NotVaried(f"its integrator ({type(integrator).__name__}) has no damping to vary ({', '.join(DAMPS)})")
    if getattr(integrator, "beta", None) is not None:
        raise NotVaried(f"its integrator sets beta = {integrator.beta!r}, which gamma alone does not follow")
    damped = {radius: on.with_field("integrator", **{name: DAMPS[name](radius)}) for radius in RADII}
    return [on.setting(f"ρ∞ = {radius:g}", one, radius) for radius, one in damped.items()]


TIME_STEP = Study("time-step", "time step", time_step_variants, time_step_vary)
MESH = Study("mesh", "mesh", mesh_variants, mesh_vary)
FAR_FIELD = Study("far-field", "far field", far_field_variants, far_field_vary)
CONTACT_POINT = Study("contact-point", "contact, mass", contact_point_variants, contact_point_vary)
RESTITUTION = Study(
    "restitution", "restitution", restitution_variants,
    lambda on: on.over("contact", "restitution", "restitution {:g}", COEFFICIENTS),
)  # fmt: skip
DAMPING = Study("damping", "damping", damping_variants, damping_vary)
