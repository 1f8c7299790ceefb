"""Scores: λ₀, r₀ (λ₁, r₁ with a base), error bars, lift, penetration, adhesion, noise, energy, momentum of one result.

A score is a function of the result's numbers alone, so that scoring a saved result again gives the same bits. The
exact values come from :mod:`.references`, the estimates with their error bars from :mod:`bent_beam.measure`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from bent_beam.measure.estimators import first_order, leading_order
from bent_beam.measure.moments import Moments
from bent_beam.measure.numbers import Number
from bent_beam_programs.open_benchmark import doctor
from bent_beam_programs.open_benchmark.judgement import LIMITS, Finding, Score
from bent_beam_programs.open_benchmark.references import reference
from bent_beam_programs.open_benchmark.result import Array, Result, ResultError

__all__ = ["resolution_ignored", "score"]


def score(result: Result, base: Result | None = None) -> Score:
    """Score one result. ``base``: the same code's result of the problem without loads, for λ₁ and r₁.

    Raises :class:`ResultError` when ``base`` does not belong to the result's problem.
    """
    asked = result.problem
    found = Score(asked.id, result.stated, metadata=result.metadata, raw=result.node_impulse is not None)
    if result.outcome != "completed":
        return replace(found, reason=result.detail or result.outcome)
    if not asked.is_front:
        return _judged(replace(found, adhesion=_adhesion(result), energy=_energy(result), **_ladder(result)), result)
    if base is not None and asked.base_id != base.problem.id:
        needed = f"(that is {asked.base_id})" if asked.base_id else "(it needs none)"
        raise ResultError(f"base: {base.problem.id} is not the base of {asked.id} {needed}")
    if base is not None and base.outcome != "completed":
        raise ResultError(f"base: its outcome is {base.outcome}")
    try:
        measured = _estimates(result, base)
    except (ValueError, np.linalg.LinAlgError) as error:
        fields = "J and Jm" if base is None else "J and Jm next to their base"
        reason = f"{fields}: no estimate can be read off ({' '.join(str(error).split())})"
        return replace(found, outcome="invalid", reason=reason)
    lambda0 = 0.0 if asked.kind == "point" else measured["lambda0"].value or 0.0
    lift, penetration = _gaps(result, lambda0)
    found = replace(
        found,
        measured={} if asked.kind == "first" and base is None else measured,  # with loads λ₀ and r₀ mean nothing
        lift=lift,
        penetration=penetration,
        adhesion=_adhesion(result),
        noise=_noise(result),
        energy=_energy(result),
        momentum_residual=_momentum(result),
        ratios=_ratios(base or result),
    )
    return _judged(found, result)


# --- λ₀, r₀, λ₁, r₁ ------------------------------------------------------------------------------------------------


def _estimates(result: Result, base: Result | None) -> dict[str, Number]:
    """λ₀ and r₀ of the base or of the result itself, λ₁ and r₁ where there is a base. A number that neither exceeds its
    bar nor is held against a larger one is none."""
    asked = result.problem
    low, high = asked.fit_window
    sign = -1.0 if (base or result).J[-1] < 0.0 else 1.0  # an impulse of the wrong sign is measured and named
    leading = leading_order(_moments(base or result, sign=sign), window=high / low)
    estimates = {"lambda0": leading.lambda0, "r0": leading.r0.scaled(sign)}
    if base is not None:
        loaded = _moments(result, load=asked.uniform_load, lambda0=leading.lambda0.known)
        change = first_order([(asked.epsilon, loaded)], _moments(_sampled(base, result.tau)), leading)
        estimates |= {"lambda1": change.lambda1, "r1": change.r1}
    exact = reference(asked)
    return {name: _number(number, exact[name]) for name, number in estimates.items()}


def _number(found: Number, exact: float | None) -> Number:
    known = found.spread <= max(abs(found.value or 0.0), abs(exact or 0.0)) or not exact
    return Number(found.value if known else None, abs(found.bar or 0.0) if known else None, exact)


def _sampled(base: Result, tau: Array) -> Result:
    """``base`` at the instants ``tau``: cumulative series, linear between instants as the steps' sums are."""
    if base.tau.size == tau.size and np.allclose(base.tau, tau, rtol=1e-9, atol=0.0):
        return base
    return replace(base, tau=tau, J=np.interp(tau, base.tau, base.J), Jm=np.interp(tau, base.tau, base.Jm))


def _moments(result: Result, *, load: float = 0.0, lambda0: float = 0.0, sign: float = 1.0) -> Moments:
    """The concentrated part of one side's impulse and first moment, as the estimators take it.

    A uniform load rests on the wall in the zone: p λ_c and p λ_c²/2 with λ_c = λ₀√τ are taken out of the rates; the
    change of the front is of second order in ε.
    """
    tau = result.tau
    zero = np.zeros(tau.size)
    return Moments(
        tau=tau,
        impulse=sign * result.J / 2.0 - load * lambda0 * tau**1.5 / 1.5,
        moment=sign * result.Jm - load * lambda0**2 * tau**2 / 4.0,
        pressure=zero + load,
        front=lambda0 * np.sqrt(tau),
        lift=zero,
    )


# --- measures that need no theory ----------------------------------------------------------------------------------


def _noise(result: Result) -> float | None:
    """Root mean square of the residual of the fit c + a√τ (+ bτ^{3/2} with loads) to J, over that of J."""
    inside = result.in_window(result.tau)
    tau, impulse = result.tau[inside] / result.tau[inside][-1], result.J[inside]
    powers = (0.0, 0.5, 1.5) if result.problem.kind == "first" else (0.0, 0.5)
    columns = np.stack([tau**p for p in powers], axis=1)
    coefficients, *_ = np.linalg.lstsq(columns, impulse, rcond=None)
    size = float(np.sqrt(np.mean(impulse**2)))
    return float(np.sqrt(np.mean((impulse - columns @ coefficients) ** 2))) / size if size > 0.0 else None


def _adhesion(result: Result) -> float | None:
    largest = float(np.abs(result.J).max())  # a wall that pulls more than it pushes leaves J negative
    return float(result.series["J_minus"][-1]) / largest if "J_minus" in result.series and largest > 0.0 else None


def _gaps(result: Result, lambda0: float) -> tuple[float | None, float | None]:
    """Largest gap inside nine tenths of the zone, and deepest penetration, over V₀τ, at snapshots of the window."""
    lifts, depths = [], []
    for when, places, gap in result.snapshots():
        depths.append(max(float(-gap.min()) / when, 0.0))
        zone = gap[places <= 0.9 * lambda0 * np.sqrt(when)]
        # a load that lifts the zone off is no fault of the code
        if zone.size and result.problem.kind != "first":
            lifts.append(max(float(zone.max()) / when, 0.0))
    return max(lifts, default=None), max(depths, default=None)


def _momentum(result: Result) -> float | None:
    """Momentum that the beam has lost against the free motion, ∫μ(V₀ + c₀x²/2 + a₀τ − v)dx, over J, less 1: the median
    over the snapshots of the record's second half. ``None`` where velocities are not reported."""
    if result.snap_v is None or result.snap_tau is None or result.x is None:
        return None
    alpha, _, chi, _ = (result.problem.epsilon * load for load in result.problem.loads)
    found = []
    late = result.in_window(result.snap_tau) & (result.snap_tau >= 0.5 * result.problem.end_time)
    for k in np.flatnonzero(late):
        when, x = float(result.snap_tau[k]), result.x if result.x.ndim == 1 else result.x[k]
        given = float(np.interp(when, result.tau, result.J))
        if given == 0.0 or np.any(np.diff(x) <= 0.0):
            continue
        lost = CubicSpline(x, 1.0 + chi * x**2 / 2.0 + alpha * when - result.snap_v[k]).integrate(x[0], x[-1])
        found.append(float(lost) * (1.0 if x[0] < -1e-9 * x[-1] else 2.0) / given - 1.0)
    return float(np.median(found)) if found else None


def _ratios(result: Result) -> dict[str, float]:
    """J and Jm over the exact ones, at the window's end; J alone where the contact has no extent."""
    exact = reference(result.problem)
    r0, lambda0 = exact["r0"] or 0.0, exact["lambda0"] or 0.0
    side, tau = np.sqrt(2.0 / np.pi), float(result.tau[-1])
    found = {"J": float(result.J[-1] / (4.0 * side * r0 * np.sqrt(tau)))} if r0 else {}
    return found | ({"Jm": float(result.Jm[-1] / (side * r0 * lambda0 * tau))} if lambda0 else {})


def _energy(result: Result) -> dict[str, float | None] | None:
    """Energy gained at most and lost at the end, over J V₀, the energy that goes through the contact."""
    scale = float(np.abs(result.J).max())
    loaded = result.problem.kind == "first" or result.problem.given  # work and springs are not reported
    if not {"E_kin", "E_el"} <= result.series.keys() or loaded or scale <= 0.0:
        return None
    total = result.series["E_kin"] + result.series["E_el"]
    return {
        "gained": max(float((total - total[0]).max()), 0.0) / scale,
        "lost": float(total[0] - total[-1]) / scale,
        "damped": float(result.series["E_damp"][-1]) / scale if "E_damp" in result.series else None,
    }


def _ladder(result: Result) -> dict[str, Any]:
    """The impulse against the closed form, the restitution of a whole impact, or the largest force and when it acts."""
    asked, exact = result.problem, reference(result.problem)
    measured: dict[str, Number] = {}
    ratio = np.nan
    if asked.kind == "bounce":
        free = result.tau >= 0.9 * asked.end_time  # out of contact by then: any change is an error
        rest = result.J[free] / (asked.length or 2.0) - 1.0
        measured["restitution"] = Number(float(rest[-1]), float(np.ptp(rest)) or None, exact["restitution"])
        ratio = float(1.0 + rest[-1]) / (1.0 + (exact["restitution"] or np.nan))
    elif "peak_force" in exact.values:
        force, when = _largest_force(result)
        measured["peak_force"] = Number(force, None, exact["peak_force"])
        measured["peak_time"] = Number(when, None, exact["peak_time"])
        ratio = force / exact.values["peak_force"]
    elif exact.impulse is not None:
        expected = exact.impulse(result.tau)
        # mean, not largest: where the impulse jumps, a jump at a slightly wrong time is a small error
        mean = float(np.mean(np.abs(result.J - expected)) / np.abs(expected).max())
        measured["impulse_error"] = Number(mean, None, 0.0)
        measured["impulse"] = Number(float(result.J[-1]), None, float(expected[-1]))
        ratio = float(result.J @ expected / (expected @ expected))
    about = {name: {"error": error, "source": exact.source} for name, error in exact.errors.items()}
    return {"measured": measured, "reference": about, "ratios": {"J": ratio} if np.isfinite(ratio) else {}}


def _largest_force(result: Result) -> tuple[float, float]:
    """Top of the parabola through the largest force, the slope of J, and its neighbours, and its time; at either end
    of the record the force itself."""
    when, force = (result.tau[1:] + result.tau[:-1]) / 2.0, np.diff(result.J) / np.diff(result.tau)
    k = int(force.argmax())
    if not 0 < k < force.size - 1:  # a parabola would rise beyond the record
        return float(force[k]), float(when[k])
    near = when[k - 1 : k + 2] - when[k]
    fit = np.polyfit(near, force[k - 1 : k + 2], 2)
    top = float(np.clip(-fit[1] / (2.0 * fit[0]), near[0], near[2])) if fit[0] < 0.0 else 0.0
    return float(np.polyval(fit, top)), float(when[k]) + top


# --- the judge -----------------------------------------------------------------------------------------------------


def _judged(found: Score, result: Result) -> Score:
    """The judge's additions to the outcome, and the doctor's findings."""
    additions, reasons = [], []
    for measure, (limit, addition) in LIMITS.items():
        value = getattr(found, measure)
        if value is not None and value > limit:
            additions.append(addition)
            reasons.append(f"{measure} {value:.2g} (limit {limit:g})")
    for name in found.off:
        number, about = found.measured[name], found.reference.get(name)
        bar = f" ± {about['error']:.1g}" if about else ""
        additions.append("off")
        reasons.append(f"{name} {number}, {'reference' if about else 'exact'} {number.theory:.6g}{bar}")
    stated = ", ".join([found.outcome, *dict.fromkeys(additions)])
    found = replace(found, outcome=stated, reason="; ".join(reasons) or None)
    return replace(found, diagnosis=doctor.diagnose(result, found))


def resolution_ignored(scores: Sequence[Score]) -> list[Score]:
    """The scores of one code at several resolutions; three of one problem with the very same numbers are flagged."""
    numbers = [repr((found.problem, found.measured, found.noise)) if found.completed else "" for found in scores]
    same = (Finding("too_exact", "the very same numbers at three resolutions", "mesh and steps that differ"),)
    flagged = [bool(own) and numbers.count(own) >= 3 for own in numbers]
    return [replace(found, diagnosis=same) if alike else found for found, alike in zip(scores, flagged)]
