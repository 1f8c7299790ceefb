r"""What the theory says about a physical impact, and until when it may be trusted (theory in SI units).

With c = √(EI/μ), ν = 1, τ = t/t*, and r̃₁ = ε(α′+ψ)⁺ μV₀/t* in the continuous regime, 0 otherwise,

    λ_c(t) = √(c t) (λ₀ + ελ₁τ)                                               (2.7.6)
    R(t)   = 2√(2/π) μV₀ √c (r₀ + εr₁τ)/√t + 2 λ_c r̃₁                         (2.7.7), (2.7.5)
    I(t)   = ∫₀ᵗ R = 4√(2/π) μV₀ √(c t) (r₀ + εr₁τ/3) + 4 r̃₁ √c t^{3/2} (λ₀/3 + ελ₁τ/5)
    M      = EI(K_n − K) + V₀√(EIμ) κ in the zone, EI(K_n − K) − V₀√(EIμ) m_ahead ahead of it (leading order)

K_n the curvature free of stress. Only the products εα, εψ, εχ, n are physical (the deflection scale y* of the slow
motion is free): λ₁ and r₁ are linear in them, so ελ₁ and εr₁ are solved for and divided by ε last. The beam's own
damping η changes force, impulse and moment of one point by the factors of `theory.damped_point`. A zone has no such
factors once it spreads; from then on the numbers are those without damping, and not valid. A beam that shears has
the leading order of `theory.shear`.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from bent_beam.as_json import plain
from bent_beam.impact import Impact, checked_impact
from bent_beam.loads import unmodelled
from bent_beam.section import Section
from theory import damped_point
from theory.contact import DISCRETE, ContactParameters, contact_parameters
from theory.shear import first_instants
from theory.similarity import PeakMoment, peak_moment_of
from theory.validity import validity
from theory.wall_prediction import WallPrediction, on_elastic_wall

MODELLED = ("acceleration", "curvature_rate", "fourth_derivative", "axial_force", "rotation", "hysteretic_loss",
            "wall_stiffness", "wall_damping", "shear_stiffness")  # fmt: skip
"""Features of an impact that the theory has, or refuses with reasons of its own."""

_OF_IMPACT = (
    "kappa_over_nu", "epsilon_alpha", "epsilon_psi", "epsilon_chi", "epsilon_axial", "alpha", "psi", "chi", "axial",
    "epsilon", "time_scale", "length_scale", "slow_time_scale", "deflection_scale",
)  # fmt: skip
_OF_CONTACT = ("regime", "lambda0", "r0", "lambda_axial", "r_axial")


@dataclass(frozen=True)
class PredictionAtTime:
    """The impact at one time after first contact, SI units.

    None where a value does not exist: the reaction at t = 0 (it starts as 1/√t), lengths, forces and impulse once
    the first-order correction has outgrown the leading order or the contact the beam, stress without a section,
    moment and stress of a damped point in its first 75 η, where the moment ahead of it may be the largest: it has no
    closed form.

    contact_force_per_length : the uniform reaction in the zone, N/m.
    peak_moment : largest bending moment of the elastic strain, N m, at leading order.
    peak_moment_place : its distance from the middle, m; 0 for the contact zone.
    peak_stress : largest stress by bending and axial force, Pa.
    valid : `Prediction.valid_from` ≤ time ≤ `Prediction.valid_until`.
    spoiled_by : why it is not valid, one of the names in `theory.validity`; None where it is.
    """

    time: float
    tau: float
    half_contact_length: float | None
    reaction: float | None
    contact_force_per_length: float | None
    impulse: float | None
    peak_moment: float | None
    peak_moment_place: float | None
    peak_stress: float | None
    valid: bool
    spoiled_by: str | None


@dataclass(frozen=True)
class Prediction:
    """Theory of one impact: groups and parameters (ν = 1, dimensionless), scales (SI), its times, its validity.

    lambda1, r1 : with everything; `lambda_axial`, `r_axial` per unit of `axial`.
    peak_moment, peak_stress : the largest at leading order until `valid_until`, N m, Pa. Without damping they are
        constant in time; where the theory never holds, they are those without damping. None as in `PredictionAtTime`.
        Waves that come back from the ends make larger ones: they are those of the first instants only.
    valid_from, valid_until : s; half length and impulse are within 2 % between them (`theory.validity`), but for the
        half length of one point that shears under a load or with damping, which it leaves out.
    force_until : s; until then the force, a mean over a tenth of the time before and after, is within 2 %, too.
        Later `times` still have a force, which may be further off; ``bentbeam predict`` leaves it out.
    valid_after : what spoils them before valid_from, one of the names in `theory.validity`; None: nothing does.
    limited_by : what ends it, one of these names.
    yields : whether the stress at leading order without damping is beyond the yield stress; None where
        either is not known.
    peak_force : the largest force on the whole zone, N; None on a rigid wall, where it is infinite.
    wall : that with all about a wall that gives way. Everything else is that of a rigid wall, but for the half length,
        which is `WallPrediction.zone_offset` longer.
    """

    kappa_over_nu: float
    epsilon_alpha: float
    epsilon_psi: float
    epsilon_chi: float
    epsilon_axial: float
    alpha: float
    psi: float
    chi: float
    axial: float
    epsilon: float
    time_scale: float
    length_scale: float
    slow_time_scale: float
    deflection_scale: float
    regime: str
    lambda0: float
    r0: float
    lambda1: float
    r1: float
    lambda_axial: float
    r_axial: float
    peak_moment: float | None
    peak_stress: float | None
    yields: bool | None
    valid_from: float
    valid_after: str | None
    valid_until: float
    force_until: float
    limited_by: str
    peak_force: float | None
    wall: WallPrediction | None
    times: tuple[PredictionAtTime, ...]

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionaries, lists and finite numbers, ready for JSON; None where a value is missing."""
        return dict(plain(self))


def predict(impact: Impact, times: Iterable[float] | float = (), *, section: Section | None = None) -> Prediction:
    """Contact length, reaction, impulse, moment and stress of an impact, and until when they hold. Relative error 1e-11
    of the theory's own formulas; how far these are from the beam is what `valid_until` is about.

    impact : the physical problem.
    times : after the first contact, s, each ≥ 0.
    section : for stress and yield.

    Raises ``ValueError`` for a beam as curved as its wall (K = K_w), one that rocks (rotation, first_touch), a wall or
    supports that the theory does not have, or a time that is negative, not finite or beyond 1e30 t*.

    >>> from bent_beam import Impact
    >>> from theory import predict
    >>> pipe = Impact(bending_stiffness=1.224e6, mass_per_length=29.02, length=90.0, curvature=0.002, velocity=2.0)
    >>> found = predict(pipe, [0.010])
    >>> found.regime, round(found.times[0].half_contact_length, 2), found.limited_by
    ('continuous', 3.8, 'waves back from the ends')
    """
    _check(impact)
    given = times if isinstance(times, Iterable) else [times]
    instants = [impact.checked_time("times", t) for t in given]
    loads = (impact.epsilon_alpha, impact.epsilon_psi, impact.epsilon_chi)
    solved = contact_parameters(impact.kappa_over_nu, *loads, axial=impact.epsilon_axial)
    bending = _Bending(impact, peak_moment_of(solved), section)
    peak: float | None = bending.peak()[0]
    stress = bending.stress(peak)
    limit = None if section is None else section.yield_stress
    yields = None if stress is None or limit is None else stress > limit
    wall = on_elastic_wall(impact, solved)
    holds = validity(impact, solved, rigid_from=0.0 if wall is None else wall.rigid_from, yields=bool(yields))
    if impact.damping > 0.0 and 0.0 < holds.valid_until < math.inf:  # grows until then
        last = _at_time(impact, solved, bending, holds.valid_until * (1.0 - 1e-9), None)
        peak, stress = last.peak_moment, last.peak_stress
    offset = 0.0 if wall is None else wall.zone_offset
    rows = tuple(_at_time(impact, solved, bending, t, holds.spoiled_by(t), offset) for t in instants)
    return Prediction(
        **{name: getattr(impact, name) for name in _OF_IMPACT},
        **{name: getattr(solved, name) for name in _OF_CONTACT},
        **vars(holds),
        lambda1=solved.lambda1 / impact.epsilon,
        r1=solved.r1 / impact.epsilon,
        peak_moment=peak,
        peak_stress=stress,
        yields=yields,
        peak_force=None if wall is None else wall.peak_force,
        wall=wall,
        times=rows,
    )


def _check(impact: Impact) -> None:
    """Raise ``ValueError`` for what the theory does not cover."""
    if reason := unmodelled(checked_impact(impact), MODELLED):
        raise ValueError(reason)
    if not impact.relative_curvature > 0.0:
        raise ValueError(
            f"curvature must be more than the wall's (got {impact.curvature:.6g}): a beam as straight as its wall has "
            "kappa/nu = 0, touches over its whole length at once, and lambda0 is infinite"
        )
    for name in ("rotation", "first_touch"):
        if getattr(impact, name) != 0.0:
            raise ValueError(
                f"{name} must be 0 for the theory, which is symmetric about the first touch "
                f"(got {getattr(impact, name)!r}): bentbeam bounce follows the full beam (simulate, between two walls)"
            )


@dataclass(frozen=True)
class _Bending:
    impact: Impact
    moments: PeakMoment
    section: Section | None

    def peak(self, factor: float = 1.0) -> tuple[float, float]:
        """Largest |M| (N m) and its place x/√(ct). `factor` multiplies the moment at the contact of a damped point.
        Ahead of it this is an upper bound: the moment there is 0.24 of that at the contact at first and 0.56 of it in
        the end, as without damping."""
        impact = self.impact
        unit = impact.moment_scale
        before = impact.bending_stiffness * (impact.unbent_curvature - impact.curvature)
        at_contact = abs(before + unit * self.moments.at_contact * factor)
        ahead = abs(before - unit * self.moments.ahead * factor)
        if at_contact >= max(ahead, abs(before)):
            return at_contact, 0.0
        return (ahead, self.moments.place) if ahead >= abs(before) else (abs(before), math.inf)

    def stress(self, moment: float | None) -> float | None:
        """Largest |σ| (Pa) of a moment together with the axial force."""
        if self.section is None or moment is None:
            return None
        return moment / self.section.section_modulus + abs(self.impact.axial_force) / self.section.area


def _at_time(
    impact: Impact, solved: ContactParameters, bending: _Bending, t: float, spoiled_by: str | None, offset: float = 0.0
) -> PredictionAtTime:
    """offset : of the rim before the place of the force on a wall that gives way, m."""
    tau = t / impact.time_scale
    age = t / impact.damping if impact.damping > 0.0 else math.inf
    of_force = of_impulse = of_acceleration = 1.0
    of_moment, ahead_known = float(age > 0.0), True  # a damped point bends from nothing
    if t > 0.0 and age <= min(damped_point.age_of_spreading(solved.kappa_over_nu), 1e12):
        if solved.regime != DISCRETE:  # it is one point as yet
            solved = contact_parameters(1.0, solved.alpha, solved.psi, solved.chi, axial=solved.axial)
            bending = replace(bending, moments=peak_moment_of(solved))
        of_force, of_impulse = float(damped_point.reaction_ratio(age)), float(damped_point.impulse_ratio(age))
        of_acceleration = float(damped_point.impulse_ratio_of_acceleration(age))
        of_moment, ahead_known = float(damped_point.elastic_moment_ratio(age)), age >= damped_point.AHEAD_FROM
    spread = solved.lambda0 + solved.lambda1 * tau
    push = solved.r0 + solved.r1 * tau
    root = math.sqrt(impact.wave_constant)
    momentum = impact.mass_per_length * impact.velocity
    uniform = float(solved.uniform_reaction) * momentum / impact.time_scale
    front = 2.0 * math.sqrt(2.0 / math.pi) * momentum * root
    length = root * math.sqrt(t) * spread
    exists = spread >= 0.0 and push > 0.0 and length <= impact.half_length
    moment, place = bending.peak(of_moment)
    peak = moment if ahead_known or place in (0.0, math.inf) else None
    force = front * (of_force * solved.r0 + of_impulse * solved.r1 * tau)
    impulse = 2.0 * front * math.sqrt(t) * (of_impulse * solved.r0 + of_acceleration * solved.r1 * tau / 3.0)
    impulse += 4.0 * uniform * root * t**1.5 * (solved.lambda0 / 3.0 + solved.lambda1 * tau / 5.0)
    if impact.shear_stiffness is not None and t > 0.0:  # its own leading order in place of Euler and Bernoulli's
        unit = impact.velocity * math.sqrt(impact.shear_stiffness * impact.mass_per_length)
        age = t / impact.shear_time
        zone, push, given = first_instants(
            impact.kappa_over_nu, solved, impact.shear_ratio, age, impact.damping / impact.shear_time
        )
        length += impact.shear_length * zone - root * math.sqrt(t) * solved.lambda0
        force += unit * push * math.sqrt(t) - front * of_force * solved.r0
        impulse += unit * impact.shear_time * given - 2.0 * front * math.sqrt(t) * of_impulse * solved.r0
    rim = length + offset if solved.lambda0 > 0.0 else length
    return PredictionAtTime(
        time=t,
        tau=tau,
        half_contact_length=min(rim, impact.half_length) if exists else None,
        reaction=force / math.sqrt(t) + 2.0 * length * uniform if exists and t > 0.0 else None,
        contact_force_per_length=uniform if exists else None,
        impulse=impulse if exists else None,
        peak_moment=peak,
        peak_moment_place=None if peak is None else min(place * root * math.sqrt(t) if t else 0.0, impact.half_length),
        peak_stress=bending.stress(peak),
        valid=spoiled_by is None,
        spoiled_by=spoiled_by,
    )
