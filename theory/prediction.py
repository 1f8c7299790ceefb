r"""What the theory says about a physical impact, and until when it may be trusted (theory in SI units).

With c = √(EI/μ), ν = 1, τ = t/t*, and r̃₁ = ε(α′+ψ)⁺ μV₀/t* in the continuous regime, 0 otherwise,

    λ_c(t) = √(c t) (λ₀ + ελ₁τ)                                               (2.7.6)
    R(t)   = 2√(2/π) μV₀ √c (r₀ + εr₁τ)/√t + 2 λ_c r̃₁                         (2.7.7), (2.7.5)
    I(t)   = ∫₀ᵗ R = 4√(2/π) μV₀ √(c t) (r₀ + εr₁τ/3) + 4 r̃₁ √c t^{3/2} (λ₀/3 + ελ₁τ/5)
    M      = EI(K_n − K) + V₀√(EIμ) κ in the zone, EI(K_n − K) − V₀√(EIμ) m_ahead ahead of it (leading order)

K_n the curvature free of stress. Only the products εα, εψ, εχ, n are physical (the deflection scale y* of the slow
motion is free): λ₁ and r₁ are linear in them, so ελ₁ and εr₁ are solved for and divided by ε last. Where the beam
touches in one point, its own damping η changes r₀ and M by the factors of `theory.damped_point`; for a zone there is
no such form, and the factors are measured ones (`theory.damped_zone`).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any, Protocol

import numpy as np

from bent_beam.impact import Impact
from theory import damped_point, damped_zone
from theory.contact import DISCRETE, ContactParameters, contact_parameters
from theory.moment import PeakMoment, peak_moment_of
from theory.validity import (
    DAMPING,
    ENDS,
    FIRST_ORDER,
    SECTION,
    SHEAR,
    SLOPE,
    TENSION,
    TOUCH,
    validity,
)

#: Damping times after which the undamped impulse of one point is within 2 %: 1/(8·0.02).
POINT_DAMPING_TIMES = 6.25


class Section(Protocol):
    """What stress and shear need to know of a section, SI units; None where it is not known."""

    @property
    def area(self) -> float:
        """A, m²."""

    @property
    def section_modulus(self) -> float:
        """EI/E over the outermost fibre's distance, m³."""

    @property
    def yield_stress(self) -> float | None:
        """Pa."""

    @property
    def shear_stiffness(self) -> float | None:
        """κ_s G A, N."""


@dataclass(frozen=True)
class PredictionAtTime:
    """The impact at one time after first contact, SI units.

    None where a value does not exist: the reaction at t = 0 (it starts as 1/√t), lengths, forces and impulse once
    the first-order correction has outgrown the leading order or the contact the beam, stress without a section.

    Attributes:
        contact_force_per_length: the uniform reaction in the zone, N/m.
        peak_moment: largest bending moment in the beam, N m, at leading order.
        peak_moment_place: its distance from the middle, m; 0 for the contact zone.
        peak_stress: largest stress by bending and axial force, Pa.
        valid: `Prediction.valid_from` ≤ time ≤ `Prediction.valid_until`.
        spoiled_by: why it is not valid, one of the names in `theory.validity`; None where it is.
    """

    time: float
    tau: float
    half_contact_length: float | None
    reaction: float | None
    contact_force_per_length: float | None
    impulse: float | None
    peak_moment: float
    peak_moment_place: float
    peak_stress: float | None
    valid: bool
    spoiled_by: str | None


@dataclass(frozen=True)
class Prediction:
    """Theory of one impact: groups and parameters (ν = 1, dimensionless), scales (SI), its times, its validity.

    Attributes:
        lambda1, r1: with everything; `lambda_axial`, `r_axial` per unit of `axial`.
        peak_moment, peak_stress: the largest at leading order, where they are constant in time; N m, Pa. Without
            damping: with it and κ/ν < 1 a simulated one was between 0.2 and 1.1 of it.
        valid_from, valid_until: s; half length, force and impulse (not the moment) are within 2 % between them.
        valid_after: what spoils them before valid_from, one of the names in `theory.validity`; None: nothing does.
        limited_by: what ends it, one of these names.
        damping_matters_until: s; before it the beam's own damping changes force or impulse by more than 2 %.
        yields: whether the peak stress is beyond the yield stress; None if either is not known.
        warnings: plain sentences.
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
    peak_moment: float
    peak_stress: float | None
    yields: bool | None
    valid_from: float
    valid_after: str | None
    valid_until: float
    limited_by: str
    damping_matters_until: float
    warnings: tuple[str, ...]
    times: tuple[PredictionAtTime, ...]

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionaries, lists and finite numbers, ready for JSON; None where a value is missing."""
        return _finite(asdict(self))

    def summary(self) -> str:
        """The prediction in plain text: does it spread, one row a time, until when, the moment, what else to know."""
        parts = (_summary_of_contact, _summary_of_times, _summary_of_validity, _summary_of_moment)
        return "\n".join(line for part in parts for line in part(self))


def predict(impact: Impact, times: Iterable[float] | float = (), *, section: Section | None = None) -> Prediction:
    """Contact length, reaction, impulse, moment and stress of an impact, and until when they hold.

    Args:
        impact: the physical problem.
        times: times after the first contact, s, each ≥ 0.
        section: for stress, shear and yield.

    Returns:
        Prediction: relative error 1e-11 of the theory's own formulas; how far these are from the beam is
        what `valid_until` is about.

    Raises:
        ValueError: a beam as curved as its wall (K = K_w), one that rocks (rotation, first_touch), or a time that is
            negative, not finite or beyond 1e30 t*.
    """
    if not impact.relative_curvature > 0.0:
        raise ValueError(
            f"curvature must be more than the wall's (got {impact.curvature!r}): a beam as straight as its wall has "
            "kappa/nu = 0, touches over its whole length at once, and lambda0 is infinite"
        )
    for name in ("rotation", "first_touch"):
        if getattr(impact, name) != 0.0:
            raise ValueError(
                f"{name} must be 0 for the theory, which is symmetric about the first touch "
                f"(got {getattr(impact, name)!r}): simulate the full beam"
            )
    given = [times] if isinstance(times, int | float) else times
    instants = [impact.checked_time("times", t) for t in given]
    epsilon = impact.epsilon
    loads = (impact.epsilon_alpha, impact.epsilon_psi, impact.epsilon_chi)
    solved = contact_parameters(impact.kappa_over_nu, *loads, axial=impact.epsilon_axial)
    bending = _Bending(impact, peak_moment_of(solved), section)
    peak, _ = bending.peak()
    stress = bending.stress(peak)
    limit = None if section is None else section.yield_stress
    yields = None if stress is None or limit is None else stress > limit
    holds = validity(
        impact,
        solved,
        shear_stiffness=None if section is None else section.shear_stiffness,
        yields=bool(yields),
    )
    rows = tuple(_at_time(impact, solved, bending, t, holds.spoiled_by(t)) for t in instants)
    return Prediction(
        kappa_over_nu=impact.kappa_over_nu,
        epsilon_alpha=impact.epsilon_alpha,
        epsilon_psi=impact.epsilon_psi,
        epsilon_chi=impact.epsilon_chi,
        epsilon_axial=impact.epsilon_axial,
        alpha=impact.alpha,
        psi=impact.psi,
        chi=impact.chi,
        axial=impact.axial,
        epsilon=epsilon,
        time_scale=impact.time_scale,
        length_scale=impact.length_scale,
        slow_time_scale=impact.slow_time_scale,
        deflection_scale=impact.deflection_scale,
        regime=solved.regime,
        lambda0=solved.lambda0,
        r0=solved.r0,
        lambda1=solved.lambda1 / epsilon,
        r1=solved.r1 / epsilon,
        lambda_axial=solved.lambda_axial,
        r_axial=solved.r_axial,
        peak_moment=peak,
        peak_stress=stress,
        yields=yields,
        valid_from=holds.begins,
        valid_after=holds.begins_after,
        valid_until=holds.until,
        limited_by=holds.limited_by,
        damping_matters_until=_damping_times(solved) * impact.damping if impact.damping > 0.0 else 0.0,
        warnings=tuple(_warnings(impact, solved)),
        times=rows,
    )


@dataclass(frozen=True)
class _Bending:
    impact: Impact
    moments: PeakMoment
    section: Section | None

    def peak(self, factor: float = 1.0) -> tuple[float, float]:
        """Largest |M| (N m) and its place x/√(ct); `factor` multiplies the moment at the contact."""
        impact = self.impact
        unit = impact.velocity * math.sqrt(impact.bending_stiffness * impact.mass_per_length)
        before = 0.0
        if impact.natural_curvature is not None:
            before = impact.bending_stiffness * (impact.natural_curvature - impact.curvature)
        at_contact = abs(before + unit * self.moments.at_contact * factor)
        ahead = abs(before - unit * self.moments.ahead)
        if at_contact >= max(ahead, abs(before)):
            return at_contact, 0.0
        return (ahead, self.moments.place) if ahead >= abs(before) else (abs(before), math.inf)

    def stress(self, moment: float) -> float | None:
        """Largest |σ| (Pa) of a moment together with the axial force."""
        if self.section is None:
            return None
        return moment / self.section.section_modulus + abs(self.impact.axial_force) / self.section.area


def _at_time(
    impact: Impact, solved: ContactParameters, bending: _Bending, t: float, spoiled_by: str | None
) -> PredictionAtTime:
    tau = t / impact.time_scale
    spread = solved.lambda0 + solved.lambda1 * tau
    push = solved.r0 + solved.r1 * tau
    root = math.sqrt(impact.wave_constant)
    momentum = impact.mass_per_length * impact.velocity
    uniform = float(solved.uniform_reaction) * momentum / impact.time_scale
    front = 2.0 * math.sqrt(2.0 / math.pi) * momentum * root
    length = root * math.sqrt(t) * spread
    of_force = of_impulse = of_moment = 1.0
    of_loads = of_impulse_of_loads = 1.0
    of_press = (1.0, 1.0, 1.0)
    if impact.damping > 0.0 and 0.0 < t < 1e12 * impact.damping:
        age = t / impact.damping
        if solved.regime == DISCRETE:
            of_force, of_impulse = float(damped_point.reaction_ratio(age)), float(damped_point.impulse_ratio(age))
            of_moment = float(damped_point.moment_ratio(age))
        else:
            of_length, of_force, of_impulse = damped_zone.ratios(solved.kappa_over_nu, solved.r0, age)[:, 0].tolist()
            press = solved.uniform_reaction * tau
            of_press = damped_zone.press_factors(solved.kappa_over_nu, age, press)[:, 0].tolist()
            length *= of_length
            of_loads, of_impulse_of_loads = of_force, of_impulse
    exists = spread >= 0.0 and push > 0.0 and min(of_press) > 0.0 and length * of_press[0] <= impact.half_length
    moment, place = bending.peak(of_moment)
    force = front * (of_force * solved.r0 + of_loads * solved.r1 * tau)
    impulse = 2.0 * front * math.sqrt(t) * (of_impulse * solved.r0 + of_impulse_of_loads * solved.r1 * tau / 3.0)
    impulse += 4.0 * uniform * root * t**1.5 * (solved.lambda0 / 3.0 + solved.lambda1 * tau / 5.0)
    return PredictionAtTime(
        time=t,
        tau=tau,
        half_contact_length=of_press[0] * length if exists else None,
        reaction=of_press[1] * (force / math.sqrt(t) + 2.0 * length * uniform) if exists and t > 0.0 else None,
        contact_force_per_length=uniform if exists else None,
        impulse=of_press[2] * impulse if exists else None,
        peak_moment=moment,
        peak_moment_place=min(place * root * math.sqrt(t) if t > 0.0 else 0.0, impact.half_length),
        peak_stress=bending.stress(moment),
        valid=spoiled_by is None,
        spoiled_by=spoiled_by,
    )


def _damping_times(solved: ContactParameters) -> float:
    """t/η from which damping changes force and impulse by less than 2 %."""
    if solved.regime == DISCRETE:
        return POINT_DAMPING_TIMES
    ages = np.geomspace(1.0, 1e6, 1000)
    change = np.abs(damped_zone.ratios(solved.kappa_over_nu, solved.r0, ages)[1:] - 1.0).max(axis=0)
    return float(ages[np.flatnonzero(change > 0.02)[-1]]) if np.any(change > 0.02) else float(ages[0])


def _warnings(impact: Impact, solved: ContactParameters) -> list[str]:
    found = []
    buckling = math.pi**2 * impact.bending_stiffness / impact.length**2
    if impact.axial_force < -buckling:
        found.append(
            f"The compression of {-impact.axial_force:.4g} N is beyond the Euler load pi^2 EI/L^2 = {buckling:.4g} N: "
            "a free beam of this length would buckle."
        )
    if impact.damping > 0.0 and solved.kappa_over_nu < damped_zone.flattest():
        found.append(
            f"What the beam's own damping does to so flat a contact was not measured (kappa/nu below "
            f"{damped_zone.flattest():g}): the numbers are those of kappa/nu = {damped_zone.flattest():g}'s damping."
        )
    return found


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


_REGIMES = {
    "discrete": "The contact stays a point: the beam is too curved (or too slow) for it to spread.",
    "continuous": "The contact spreads: a growing zone, in contact all along, with a concentrated force at each end.",
    "detached": "The contact spreads as two points that move apart while the beam lifts off between them.",
}
_LIFTED = (
    "The contact spreads: a growing zone with a concentrated force at each end; the beam's own damping lifts its "
    "middle off the wall for a time."
)

_ENDS_OF_VALIDITY = {
    ENDS: "waves come back from the beam's ends, which the theory takes to be infinitely far",
    FIRST_ORDER: "the loads change the contact so much that the first-order correction is no longer enough",
    TENSION: "the axial force changes the contact so much that the first-order correction is no longer enough",
    DAMPING: "the beam's own damping rules, and was not measured for so flat or so short a contact, or so early",
    TOUCH: "the middle of the contact, which the first instants have lifted, comes back to the wall with a pulse",
    SLOPE: "the beam's slopes are no longer small",
    SHEAR: "the beam is so stubby that it shears before it bends, all the time that the ends leave",
    SECTION: "the bending stress is beyond the yield stress from the first instant on",
}


def _summary_of_contact(p: Prediction) -> list[str]:
    lifted = p.regime == "continuous" and p.damping_matters_until > 0.0
    return [
        _LIFTED if lifted else _REGIMES[p.regime],
        f"  kappa/nu = {p.kappa_over_nu:.6g} (below 1 it spreads), regime {p.regime}",
        f"  t* = {p.time_scale:.4g} s   l* = {p.length_scale:.4g} m   T* = {p.slow_time_scale:.4g} s   "
        f"epsilon = {p.epsilon:.3g}",
        f"  lambda0 = {p.lambda0:.9g}   r0 = {p.r0:.9g}   "
        f"epsilon lambda1 = {p.epsilon * p.lambda1:.6g}   epsilon r1 = {p.epsilon * p.r1:.6g}",
    ]


_STARTS_OF_VALIDITY = {
    DAMPING: "before, the beam's own damping rules, and was not measured so early",
    SHEAR: "before, the beam shears as much as it bends, which the theory leaves out",
}


def _summary_of_times(p: Prediction) -> list[str]:
    if not p.times:
        return []
    head = ("time, s", "half contact, m", "reaction, N", "impulse, N s", "moment, N m", "stress, Pa", "holds")
    rows = [
        (
            f"{row.time:.4g}",
            *(
                "-" if value is None else f"{value:.5g}"
                for value in (row.half_contact_length, row.reaction, row.impulse, row.peak_moment, row.peak_stress)
            ),
            "yes" if row.spoiled_by is None else f"no: {row.spoiled_by}",
        )
        for row in p.times
    ]
    return ["  ".join([*(f"{cell:>15}" for cell in line[:-1]), line[-1]]) for line in (head, *rows)]


def _summary_of_validity(p: Prediction) -> list[str]:
    reason = _ENDS_OF_VALIDITY[p.limited_by]
    if p.valid_until == 0.0:
        lines = [f"This does not hold at any time: {reason}."]
    else:
        start = ""
        if p.valid_after is not None:
            start = f"from {p.valid_from:.3g} s ({_STARTS_OF_VALIDITY[p.valid_after]}) "
        lines = [f"This holds {start}until {p.valid_until:.3g} s, to 2 %: then {reason}."]
    if any(row.half_contact_length is None for row in p.times):
        lines.append(
            "Where there is a dash the correction exceeds the leading order, or the contact the beam: the theory does "
            "not hold there."
        )
    if any(not row.valid for row in p.times):
        lines.append("For other times simulate: bentbeam predict --simulate, or bentbeam simulate.")
    return lines


def _summary_of_moment(p: Prediction) -> list[str]:
    order = "at leading order"
    if p.damping_matters_until > 0.0 and p.kappa_over_nu < 1.0:
        order += "; without the damping, which may take most of it away: bentbeam predict --simulate"
    lines = [f"The largest bending moment is {p.peak_moment:.4g} N m from the first instant on ({order})."]
    if p.peak_stress is not None:
        verdict = {None: "", True: ", beyond the yield stress", False: ", below the yield stress"}[p.yields]
        lines.append(f"The largest stress is {p.peak_stress:.4g} Pa{verdict}.")
    return [*lines, *p.warnings]
