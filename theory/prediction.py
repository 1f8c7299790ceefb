r"""What the theory says about a physical impact, and where it may be trusted (theory in SI units).

With c = √(EI/μ), ν = 1, τ = t/t*, and r̃₁ = ε(α+ψ)⁺ μV₀/t* in the continuous regime, 0 otherwise,

    λ_c(t) = √(c t) (λ₀ + ελ₁τ)                                               (2.7.6)
    R(t)   = 2√(2/π) μV₀ √c (r₀ + εr₁τ)/√t + 2 λ_c r̃₁                         (2.7.7), (2.7.5)
    I(t)   = ∫₀ᵗ R = 4√(2/π) μV₀ √(c t) (r₀ + εr₁τ/3) + 4 r̃₁ √c t^{3/2} (λ₀/3 + ελ₁τ/5).

Only the products εα, εψ, εχ are physical (the deflection scale y* of the slow motion is free): λ₁ and r₁
are linear in them, so ελ₁ and εr₁ are solved for and divided by ε last.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import asdict, dataclass
from typing import Any

from bent_beam.impact import Impact
from theory.contact import DISCRETE, contact_parameters

#: Largest ε, ε|λ₁|τ/λ₀ and ε|r₁|τ/r₀: the terms left out are of the order of their squares, 1 %.
EXPANSION_LIMIT = 0.1
#: Largest λ_c/(L/2): the waves ahead of the front travel at twice its speed (group against phase).
CONTACT_LIMIT = 0.5
#: Largest t/T*: then √(EI/μ)^{1/2}√t, which bending waves have covered, is a third of the half length.
TIME_LIMIT = 0.1


@dataclass(frozen=True)
class ValidityCheck:
    """One condition of the theory: holds if `value` ≤ `limit`; `value` is None where it has no meaning."""

    name: str
    value: float | None
    limit: float
    ok: bool
    message: str


@dataclass(frozen=True)
class PredictionAtTime:
    """The impact at one time after first contact, SI units.

    None where a value does not exist: the reaction at t = 0 (it starts as 1/√t), and everything but the
    time once the first-order correction has outgrown the leading order.
    """

    time: float
    tau: float
    half_contact_length: float | None
    reaction: float | None
    contact_force_per_length: float | None
    impulse: float | None
    valid: bool
    checks: tuple[ValidityCheck, ...]


@dataclass(frozen=True)
class Prediction:
    """Theory of one impact: groups and parameters (ν = 1, dimensionless), scales (SI), and its times."""

    kappa_over_nu: float
    epsilon_alpha: float
    epsilon_psi: float
    epsilon_chi: float
    alpha: float
    psi: float
    chi: float
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
    valid: bool
    checks: tuple[ValidityCheck, ...]
    times: tuple[PredictionAtTime, ...]

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionaries, lists and finite numbers, ready for JSON; None where a value is missing."""
        return _finite(asdict(self))

    def summary(self) -> str:
        """The prediction in plain text, one line a fact, one row a time, and what is out of range."""
        return "\n".join([*_summary_of_impact(self), *_summary_of_times(self), *_summary_of_validity(self)])


def predict(impact: Impact, times: Iterable[float] | float = ()) -> Prediction:
    """Contact length, reaction, impulse and validity of the theory for an impact.

    Args:
        impact: the physical problem.
        times: times after the first contact, s, each ≥ 0.

    Returns:
        Prediction: relative error 1e-11 of the theory's own formulas; how far these are from the beam is
        what `checks` is about.

    Raises:
        ValueError: a straight beam (K = 0), or a time that is negative, not finite or beyond 1e30 t*.
    """
    if impact.curvature == 0.0:
        raise ValueError(
            "curvature must be positive (got 0.0): a straight beam has kappa/nu = 0, touches over its whole "
            "length at once, and lambda0 is infinite"
        )
    given = [times] if isinstance(times, int | float) else times
    instants = [impact.checked_time("times", t) for t in given]
    epsilon = impact.epsilon
    solved = contact_parameters(
        impact.kappa_over_nu, impact.epsilon_alpha, impact.epsilon_psi, impact.epsilon_chi
    )
    checks = (_check_epsilon(epsilon),)
    rows = tuple(_at_time(impact, solved, t) for t in instants)
    return Prediction(
        kappa_over_nu=impact.kappa_over_nu,
        epsilon_alpha=impact.epsilon_alpha,
        epsilon_psi=impact.epsilon_psi,
        epsilon_chi=impact.epsilon_chi,
        alpha=impact.alpha,
        psi=impact.psi,
        chi=impact.chi,
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
        valid=all(check.ok for check in checks) and all(row.valid for row in rows),
        checks=checks,
        times=rows,
    )


def _at_time(impact: Impact, solved: Any, t: float) -> PredictionAtTime:
    tau = t / impact.time_scale
    spread = solved.lambda0 + solved.lambda1 * tau
    push = solved.r0 + solved.r1 * tau
    root = math.sqrt(impact.wave_constant)
    momentum = impact.mass_per_length * impact.velocity
    uniform = float(solved.uniform_reaction) * momentum / impact.time_scale
    front = 2.0 * math.sqrt(2.0 / math.pi) * momentum * root
    length = root * math.sqrt(t) * spread
    exists = spread >= 0.0 and push > 0.0
    checks = _checks_at_time(impact, solved, t, length)
    return PredictionAtTime(
        time=t,
        tau=tau,
        half_contact_length=length if exists else None,
        reaction=front * push / math.sqrt(t) + 2.0 * length * uniform if exists and t > 0.0 else None,
        contact_force_per_length=uniform if exists else None,
        impulse=(
            2.0 * front * math.sqrt(t) * (solved.r0 + solved.r1 * tau / 3.0)
            + 4.0 * uniform * root * t**1.5 * (solved.lambda0 / 3.0 + solved.lambda1 * tau / 5.0)
            if exists
            else None
        ),
        valid=all(check.ok for check in checks),
        checks=checks,
    )


def _check(name: str, value: float | None, limit: float, good: str, bad: str) -> ValidityCheck:
    ok = value is None or value <= limit
    return ValidityCheck(name, value, limit, ok, good if ok else bad)


def _check_epsilon(epsilon: float) -> ValidityCheck:
    return _check(
        "epsilon",
        epsilon,
        EXPANSION_LIMIT,
        f"The impact is fast against the beam's own vibration (epsilon = t*/T* = {epsilon:.3g}).",
        f"epsilon = t*/T* = {epsilon:.3g}: the impact is not fast against the beam's own vibration, so the "
        "two time scales do not separate; at best times far below T* can be trusted. A faster, longer, "
        "heavier or softer beam would bring epsilon down.",
    )


def _correction(name: str, what: str, ratio: float | None, until: float, good: str) -> ValidityCheck:
    if ratio is not None and ratio >= 1.0:
        bad = (
            f"The first-order change of the {what} is {ratio:.3g} times its leading order: the expansion "
            f"says nothing here, it is valid up to {until:.3g} s. Ask for an earlier time or simulate."
        )
    else:
        bad = (
            f"The load changes the {what} by {_percent(ratio)} of its leading order: the terms left out are "
            f"no longer small and the {what} is an indication only, it is valid up to {until:.3g} s."
        )
    return _check(name, ratio, EXPANSION_LIMIT, good, bad)


def _checks_at_time(impact: Impact, solved: Any, t: float, length: float) -> tuple[ValidityCheck, ...]:
    tau = t / impact.time_scale
    spreads = solved.regime != DISCRETE
    growth = abs(solved.lambda1) / solved.lambda0 if spreads else None
    load = abs(solved.r1) / solved.r0
    reach = max(length, 0.0) / impact.half_length
    age = t / impact.slow_time_scale
    return (
        _correction(
            "contact_length_correction",
            "contact length",
            None if growth is None else growth * tau,
            EXPANSION_LIMIT / growth * impact.time_scale if growth else math.inf,
            "The first-order change of the contact length is a small correction."
            if spreads
            else "The beam touches in one point only: there is no contact length to correct.",
        ),
        _correction(
            "reaction_correction",
            "reaction",
            load * tau,
            EXPANSION_LIMIT / load * impact.time_scale if load else math.inf,
            "The first-order change of the reaction is a small correction.",
        ),
        _check(
            "contact_length_over_half_length",
            reach,
            CONTACT_LIMIT,
            f"The contact covers {_percent(reach)} of the beam.",
            f"The contact covers {_percent(reach)} of the beam: the waves ahead of it have reached the "
            "beam's ends, which the theory takes to be infinitely far.",
        ),
        _check(
            "time_over_slow_time_scale",
            age,
            TIME_LIMIT,
            f"Bending waves have covered about {_percent(math.sqrt(age))} of the half length.",
            f"The time is {age:.2g} T*: bending waves have covered about {_percent(math.sqrt(age))} of the "
            "half length and come back from the ends, and the beam's free motion is no longer its Taylor "
            "expansion at the first contact.",
        ),
    )


def _percent(value: float | None) -> str:
    return "" if value is None else f"{100.0 * value:.3g} %"


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


_REGIMES = {
    "discrete": "one point: the beam is too curved (or too slow) for the contact to spread",
    "continuous": "a growing zone, in contact all along, with a concentrated force at each end",
    "detached": "two points that move apart while the beam lifts off between them",
}


def _summary_of_impact(p: Prediction) -> list[str]:
    return [
        f"Contact: {p.regime}: {_REGIMES[p.regime]}.",
        f"  kappa/nu = {p.kappa_over_nu:.6g}   epsilon = {p.epsilon:.3g}",
        f"  t* = {p.time_scale:.4g} s   l* = {p.length_scale:.4g} m   T* = {p.slow_time_scale:.4g} s",
        f"  lambda0 = {p.lambda0:.9g}   r0 = {p.r0:.9g}",
        f"  epsilon lambda1 = {p.epsilon * p.lambda1:.6g}   epsilon r1 = {p.epsilon * p.r1:.6g}",
    ]


def _summary_of_times(p: Prediction) -> list[str]:
    if not p.times:
        return []
    head = ("time, s", "half contact, m", "reaction, N", "zone force, N/m", "impulse, N s", "valid")
    rows = [
        (
            f"{row.time:.4g}",
            *(
                "-" if value is None else f"{value:.5g}"
                for value in (
                    row.half_contact_length,
                    row.reaction,
                    row.contact_force_per_length,
                    row.impulse,
                )
            ),
            "yes" if row.valid else "no",
        )
        for row in p.times
    ]
    return ["  ".join(f"{cell:>15}" for cell in line) for line in (head, *rows)]


def _summary_of_validity(p: Prediction) -> list[str]:
    failed = [check.message for check in p.checks if not check.ok]
    failed += [f"At {row.time:.4g} s: {c.message}" for row in p.times for c in row.checks if not c.ok]
    return (
        ["Outside the theory's range:", *(f"  {line}" for line in failed)]
        if failed
        else ["Within the theory's range."]
    )
