"""Studies of Exudyn's models: penalty contact, true geometry, friction."""

from dataclasses import replace

from bent_beam import Case, Impact, Method
from bent_beam_programs.thesis.studies.base import Study
from bent_beam_programs.thesis.studies.of_methods import MethodOnCase
from bent_beam_programs.thesis.studies.thesis import Variant, references
from exudyn_models import CONTACTS, ELEMENTS, GEOMETRIES, INTEGRATORS, ExudynModel

STIFFNESS, DAMPING, RADIUS = 10.0, 3.0, 0.5  # penalty C EI/Δx⁴ and D √(EIμ)/Δx², ρ∞
STEP = 5e-3  # h/t
SAVED = 250
RUNS: dict[str, tuple[float | None, tuple[float, float, float]]] = {  # label → (value, (C, D, ρ∞))
    "bare: C = 10, D = 3, ρ∞ = 0.5": (None, (STIFFNESS, DAMPING, RADIUS)),
    **{f"C = {c:g}": (c, (c, DAMPING, RADIUS)) for c in (0.1, 1.0, 100.0)},
    **{f"D = {d:g}": (d, (STIFFNESS, d, RADIUS)) for d in (0.0, 0.3, 30.0)},
    **{f"ρ∞ = {r:g}": (r, (STIFFNESS, DAMPING, r)) for r in (0.0, 0.9, 1.0)},
}
# Slopes over the front are of order √τ, τ = t/t* (:class:`exudyn_models.geometry.TrueGeometry`): the end time sets them
DURATIONS = (1e-3, 1e-2, 3e-2, 1e-1)
TURN = 1.5  # rad
COEFFICIENTS = (0.0, 0.3, 0.6)  # of friction, in true geometry: in the linear limit no point slides along the wall
RUBBING_DURATION = 1e-3  # τ: slopes of about 0.03
RUBBING_STEP = 1e-2  # h/t


def penalised(stiffness: float, damping: float, radius: float, viscosity: float | None = 0.0) -> ExudynModel:
    return ExudynModel(
        contact=CONTACTS["penalty"](relative_stiffness=stiffness, relative_damping=damping, hold=0),
        element=ELEMENTS["ancf_cable"](viscosity=viscosity),
        integrator=INTEGRATORS["generalized_alpha"](spectral_radius=radius, relative_step=STEP),
    )


def penalty_variants(case: Case) -> list[Variant]:
    """Penalty contact in Exudyn

    Errors of λ₀ and r₀, lift and noise over stiffness and damping of the penalty and over the spectral radius, without
    viscosity of the grid; then with it, and two other paths on the same case.
    """

    def run(label: str, method: Method, value: float | None = None, reference: bool = False) -> Variant:
        return Variant(label, case.impact, case.end_time, method, value, reference, SAVED)

    return [
        *(run(label, penalised(*chosen), value) for label, (value, chosen) in RUNS.items()),
        run("Exudyn's default (viscous)", penalised(STIFFNESS, DAMPING, RADIUS, None), reference=True),
        *references(case.impact, case.end_time),
    ]


def penalty_vary(on: MethodOnCase) -> list[Variant]:
    """Stiffness and damping of the method's contact, in units of its elements' own."""
    found = [on.setting("as it is", on.method)]
    found += on.over("contact", "relative_stiffness", "C = {:g}", (1.0, 10.0, 100.0))
    return found + on.over("contact", "relative_damping", "D = {:g}", (0.3, 3.0, 30.0))


def cut(impact: Impact) -> Impact:
    """The beam, cut where it would turn too far, in the linear run too."""
    return impact.replace(length=min(impact.length, 2.0 * TURN / impact.curvature))


def amplitude_variants(case: Case) -> list[Variant]:
    """True geometry against linear theory

    Errors of λ₀ and r₀ with true geometry beside those of its linear limit on the same mesh, for slopes √τ: their
    difference is the error of the linear theory.
    """
    impact, steps = cut(case.impact), INTEGRATORS["generalized_alpha"](relative_step=STEP)
    methods = {name: ExudynModel(geometry=GEOMETRIES[name](), integrator=steps) for name in ("linear", "true")}
    return [
        Variant(f"{name}, τ = {tau:g}", impact, tau * impact.time_scale, method, tau**0.5, reference=True, save=SAVED)
        for tau in DURATIONS
        for name, method in methods.items()
    ]


def amplitude_vary(on: MethodOnCase) -> list[Variant]:
    """Every geometry that the method knows, over ever longer times."""
    impact = cut(on.case.impact)
    methods = {name: on.with_parts(geometry=kind()) for name, kind in on.kinds("geometry").items()}
    return [
        on.setting(f"{name}, τ = {tau:g}", method, tau**0.5, impact=impact, end_time=tau * impact.time_scale)
        for tau in DURATIONS
        for name, method in methods.items()
    ]


def friction_variants(case: Case) -> list[Variant]:
    """Friction at the wall, true geometry

    Errors of λ₀ and r₀ and the lift without and with friction: it changes them only as far as points of the beam slide
    on the wall, which is of second order in the slope.
    """
    steps, end = INTEGRATORS["generalized_alpha"](relative_step=RUBBING_STEP), RUBBING_DURATION * case.impact.time_scale
    plain = ExudynModel(integrator=steps, geometry=GEOMETRIES["true"]())
    methods = {f: replace(plain, contact=CONTACTS["segment_friction"](friction=f)) for f in COEFFICIENTS}
    return [
        Variant(f"friction {f:g}", case.impact, end, method, f, reference=True, save=SAVED)
        for f, method in methods.items()
    ]


PENALTY = Study("penalty", "penalty", penalty_variants, penalty_vary)
AMPLITUDE = Study("amplitude", "geometry", amplitude_variants, amplitude_vary)
FRICTION = Study(
    "friction", "contact", friction_variants,
    lambda on: on.over("contact", "friction", "friction {:g}", COEFFICIENTS),
)  # fmt: skip
