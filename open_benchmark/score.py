"""Scores: λ₀, r₀ (λ₁, r₁ with a base), error bars, lift, penetration, adhesion, noise, energy of one result.

A score is a function of the result's numbers alone, so that scoring a saved result again gives the same bits. The
exact values come from ``theory``; how an estimate is read off J and Jm, with its error bar, is ``comparison``'s.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from comparison.compared import Compared
from comparison.estimators import Estimate, Moments, first_order, leading_order
from open_benchmark import doctor
from open_benchmark.judgement import LIMITS, MEASURES, TOLERANCE, Score
from open_benchmark.references import Reference, reference
from open_benchmark.result import Result, ResultError

__all__ = ["score", "work_precision"]

Array = NDArray[np.float64]


def _compared(found: Estimate, exact: float | None) -> Compared:
    return Compared(found.value, found.error, exact)


def score(result: Result, base: Result | None = None) -> Score:
    """Score one result. ``base``: the same code's result of the problem without loads, for λ₁ and r₁.

    Raises :class:`ResultError` when ``base`` does not belong to the result's problem.
    """
    asked = result.problem
    stated = f"{result.outcome}({result.detail})" if result.detail else result.outcome
    if result.outcome != "completed":
        return Score(asked.id, stated, result.detail or result.outcome, metadata=result.metadata)
    assert result.tau is not None and result.J is not None
    exact = reference(asked)
    if not asked.is_front:
        return _judged(_ladder(result, exact), result)
    bare = _bare(result, base)
    found = Score(asked.id, stated, measured={}, metadata=result.metadata)
    try:
        leading = leading_order(moments(bare), window=asked.fit_window[1] / asked.fit_window[0])
    except (ValueError, np.linalg.LinAlgError) as error:
        return replace(found, outcome="invalid", reason=_unfit("J and Jm", error))
    measured: dict[str, Compared] = {}
    if asked.kind != "first" or base is not None:
        measured["lambda0"] = _compared(leading.lambda0, exact["lambda0"])
        measured["r0"] = _compared(leading.r0, exact["r0"])
    if asked.kind == "first" and base is not None:
        try:
            change = first_order(
                [(asked.epsilon, moments(result, load=asked.uniform_load, lambda0=leading.lambda0.value))],
                moments(_sampled(base, result.tau)),
                leading,
            )
        except (ValueError, np.linalg.LinAlgError) as error:
            return replace(found, outcome="invalid", reason=_unfit("J and Jm next to their base", error))
        measured["lambda1"] = _compared(change.lambda1, exact["lambda1"])
        measured["r1"] = _compared(change.r1, exact["r1"])
    lift, penetration = _gaps(result, leading.lambda0.value if asked.kind != "point" else 0.0)
    found = replace(
        found,
        measured=measured,
        lift=lift,
        penetration=penetration,
        adhesion=_adhesion(result),
        noise=_noise(result),
        energy=_energy(result),
    )
    return _judged(found, result)


def _unfit(fields: str, error: Exception) -> str:
    return f"{fields}: no estimate can be read off ({' '.join(str(error).split())})"


def _bare(result: Result, base: Result | None) -> Result:
    if base is None:
        return result
    if result.problem.base_id != base.problem.id:
        raise ResultError(
            f"base: {base.problem.id} is not the base of {result.problem.id}"
            + (f" (that is {result.problem.base_id})" if result.problem.base_id else ", which needs none")
        )
    if base.outcome != "completed":
        raise ResultError(f"base: its outcome is {base.outcome}")
    return base


def _sampled(base: Result, tau: Array) -> Result:
    """``base`` at the instants ``tau``: cumulative series, linear between instants as the steps' sums are."""
    assert base.tau is not None and base.J is not None and base.Jm is not None
    if base.tau.size == tau.size and np.allclose(base.tau, tau, rtol=1e-9, atol=0.0):
        return base
    return replace(base, tau=tau, J=np.interp(tau, base.tau, base.J), Jm=np.interp(tau, base.tau, base.Jm))


def moments(result: Result, *, load: float = 0.0, lambda0: float = 0.0) -> Moments:
    """The concentrated part of one side's impulse and first moment, as the estimators take it.

    A uniform load rests on the wall in the zone: p λ_c and p λ_c²/2 with λ_c = λ₀√τ are taken out of the rates; what
    the front has moved by is of second order in ε.
    """
    assert result.tau is not None and result.J is not None and result.Jm is not None
    tau = result.tau
    zero = np.zeros(tau.size)
    return Moments(
        tau=tau,
        impulse=result.J / 2.0 - load * lambda0 * tau**1.5 / 1.5,
        moment=result.Jm - load * lambda0**2 * tau**2 / 4.0,
        pressure=zero + load,
        front=lambda0 * np.sqrt(tau),
        lift=zero,
    )


# --- measures that need no theory ----------------------------------------------------------------------------------


def inside_window(result: Result) -> NDArray[np.bool_]:
    """Instants of the fit window."""
    assert result.tau is not None
    low, high = result.problem.fit_window
    return np.asarray((result.tau >= low * (1 - 1e-9)) & (result.tau <= high * (1 + 1e-3)))


def fitted_residual(result: Result, values: Array, powers: Sequence[float]) -> tuple[Array, Array]:
    """Times of the window, and what a fit Σ c_p τ^p leaves of ``values`` there."""
    assert result.tau is not None
    inside = inside_window(result)
    tau = result.tau[inside] / result.tau[inside][-1]
    columns = np.stack([tau**p for p in powers], axis=1)
    coefficients, *_ = np.linalg.lstsq(columns, values[inside], rcond=None)
    return result.tau[inside], values[inside] - columns @ coefficients


def _noise(result: Result) -> float | None:
    """Root mean square of what the fit of the impulse leaves, over the impulse's own."""
    assert result.J is not None
    _, left = fitted_residual(result, result.J, (0.0, 0.5, 1.5) if result.problem.kind == "first" else (0.0, 0.5))
    size = float(np.sqrt(np.mean(result.J[inside_window(result)] ** 2)))
    return float(np.sqrt(np.mean(left**2))) / size if size > 0.0 else None


def _adhesion(result: Result) -> float | None:
    if "J_minus" not in result.series:
        return None
    assert result.J is not None
    largest = float(np.abs(result.J).max())  # a wall that pulls more than it pushes leaves J negative
    return float(result.series["J_minus"][-1]) / largest if largest > 0.0 else None


def _gaps(result: Result, lambda0: float) -> tuple[float | None, float | None]:
    """Largest gap inside nine tenths of the zone, and deepest penetration, over V₀τ, at snapshots of the window."""
    if result.x is None or result.snap_tau is None or result.snap_gap is None:
        return None, None
    low, high = result.problem.fit_window
    lift: float | None = None
    depth: float | None = None
    for k, when in enumerate(result.snap_tau):
        if not low * (1 - 1e-9) <= when <= high * (1 + 1e-3):
            continue
        places = np.abs(result.x if result.x.ndim == 1 else result.x[k])
        gap = result.snap_gap[k]
        depth = max(depth or 0.0, float(-gap.min()) / float(when), 0.0)
        zone = places <= 0.9 * lambda0 * np.sqrt(when)
        # a load that lifts the zone off is no fault of the code
        if zone.any() and result.problem.kind != "first":
            lift = max(lift or 0.0, float(gap[zone].max()) / float(when), 0.0)
    return lift, depth


def _energy(result: Result) -> dict[str, float | None] | None:
    """Energy gained at most and lost at the end, over J V₀, the energy that goes through the contact."""
    if "E_kin" not in result.series or "E_el" not in result.series or result.problem.kind == "first":
        return None  # with loads the loads work, which nobody reports
    assert result.J is not None
    total = result.series["E_kin"] + result.series["E_el"]
    scale = float(np.abs(result.J).max())
    if scale <= 0.0:
        return None
    damped = float(result.series["E_damp"][-1]) / scale if "E_damp" in result.series else None
    return {
        "gained": max(float((total - total[0]).max()), 0.0) / scale,
        "lost": float(total[0] - total[-1]) / scale,
        "damped": damped,
    }


def _ladder(result: Result, exact: Reference) -> Score:
    """A problem with a fixed contact: the impulse against the closed form, or the restitution of a whole impact."""
    assert result.tau is not None and result.J is not None
    asked = result.problem
    measured: dict[str, Compared] = {}
    if asked.kind == "bounce":
        free = result.tau >= 0.9 * asked.end_time  # out of contact by then: what still changes is the error
        rest = result.J[free] / (asked.length or 2.0) - 1.0
        measured["restitution"] = Compared(float(rest[-1]), float(np.ptp(rest)), exact["restitution"])
    elif exact.impulse is not None:
        expected = exact.impulse(result.tau)
        # mean, not largest: where the impulse jumps, a jump at a slightly wrong time is a small error
        mean = float(np.mean(np.abs(result.J - expected)) / np.abs(expected).max())
        measured["impulse_error"] = Compared(mean, None, 0.0)
        measured["impulse"] = Compared(float(result.J[-1]), None, float(expected[-1]))
    return Score(
        asked.id,
        "completed",
        measured=measured,
        adhesion=_adhesion(result),
        energy=_energy(result),
        reference={name: {"error": error, "source": exact.source} for name, error in exact.errors.items()},
        metadata=result.metadata,
    )


def _off(found: Score) -> list[str]:
    """Names of the numbers that their reference, within both error bars and the tolerance, does not bear out."""
    names = []
    for name, about in found.reference.items():
        difference = found.measured[name].difference
        if (
            difference is not None
            and abs(difference) > about["error"] + (found.measured[name].error or 0.0) + TOLERANCE
        ):
            names.append(name)
    return names


def _judged(found: Score, result: Result) -> Score:
    """The judge's additions to the outcome, and the doctor's findings."""
    beyond = [
        name
        for name, measure in MEASURES.items()
        if (value := getattr(found, measure)) is not None and value > LIMITS[name]
    ]
    reasons = [f"{MEASURES[n]} {getattr(found, MEASURES[n]):.2g} (limit {LIMITS[n]:g})" for n in beyond]
    for name in _off(found):
        number, error = found.measured[name], found.reference[name]["error"]
        reasons.append(f"{name} {number.value:.4g}, reference {number.theory:.4g} ± {error:.1g}")
    stated = ", ".join([found.outcome, *beyond, *(["off"] if len(reasons) > len(beyond) else [])])
    reason = "; ".join(reasons)
    findings = tuple(doctor.diagnose(result, found)) if result.problem.is_front else ()
    return replace(found, outcome=stated, reason=reason or None, diagnosis=findings)


def work_precision(scores: Sequence[Score]) -> list[dict[str, Any]]:
    """Points of the work–precision line: seconds, steps and relative errors of the results of one code and problem."""
    points = []
    for found in scores:
        points.append(
            {
                "problem": found.problem,
                "resolution": found.metadata.get("resolution"),
                "seconds": found.seconds,
                "steps": found.metadata.get("steps"),
                "errors": {name: found.error(name) for name in found.measured},
            }
        )
    return sorted(points, key=lambda point: (point["problem"], point["seconds"] is None, point["seconds"] or 0.0))
