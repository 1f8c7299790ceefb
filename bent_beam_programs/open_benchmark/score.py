"""Scores: λ₀, r₀ (λ₁, r₁ with a base) with error bars, what is seen besides (:mod:`.symptoms`), and the verdict.

A score is a function of the result's numbers alone, so that scoring a saved result again gives the same bits. The
exact values come from :mod:`.references`, the estimates with their error bars from :mod:`bent_beam.measure`.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any

import numpy as np

from bent_beam.measure.estimators import first_order, leading_order
from bent_beam.measure.moments import Moments
from bent_beam.measure.numbers import Number
from bent_beam_programs.open_benchmark.judgement import FIRST_ORDER, LOADED, PART, WORDS, Finding, Score, Symptom
from bent_beam_programs.open_benchmark.references import reference
from bent_beam_programs.open_benchmark.result import Result, ResultError
from bent_beam_programs.open_benchmark.symptoms import last_push, readings

__all__ = ["resolution_ignored", "score"]


def score(result: Result, base: Result | None = None) -> Score:
    """Score one result. ``base``: the same code's result of the problem without loads, for λ₁ and r₁.

    Raises :class:`ResultError` when ``base`` does not belong to the result's problem.
    """
    asked = result.problem
    raw = result.node_impulse is not None and result.snap_gap is not None
    found = Score(asked.id, result.stated, metadata=result.metadata, raw=raw)
    if result.outcome != "completed":
        return replace(found, reason=result.detail or result.outcome)
    if not asked.is_front:
        return _judged(replace(found, **_ladder(result)), result)
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
    measured = {} if asked.kind == "first" and base is None else measured  # with loads λ₀ and r₀ mean nothing
    return _judged(replace(found, measured=measured), result)


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
        # cumulative series, linear between instants as the steps' sums are
        J, Jm = (np.interp(result.tau, base.tau, series) for series in (base.J, base.Jm))
        bare = _moments(replace(base, tau=result.tau, J=J, Jm=Jm))
        change = first_order([(asked.epsilon, loaded)], bare, leading)
        estimates |= {"lambda1": change.lambda1, "r1": change.r1}
    exact = reference(asked)
    return {name: _number(number, exact.values.get(name)) for name, number in estimates.items()}


def _number(found: Number, exact: float | None) -> Number:
    known = found.spread <= max(abs(found.value or 0.0), abs(exact or 0.0)) or not exact
    return Number(found.value if known else None, abs(found.bar or 0.0) if known else None, exact)


def _moments(result: Result, *, load: float = 0.0, lambda0: float = 0.0, sign: float = 1.0) -> Moments:
    """The concentrated part of one side's impulse and first moment, as the estimators take it. A uniform load rests on
    the wall in the zone: p λ_c and p λ_c²/2 with λ_c = λ₀√τ are taken out of the rates; the change of the front is of
    second order in ε."""
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


def _ladder(result: Result) -> dict[str, Any]:
    """The impulse against the closed form, the restitution of a whole impact, or the largest force and when it acts."""
    asked, exact = result.problem, reference(result.problem)
    measured: dict[str, Number] = {}
    if asked.kind == "bounce":
        free = result.tau >= 0.9 * asked.end_time  # out of contact by then: any change is an error
        rest = result.J[free] / (asked.length or 2.0) - 1.0
        measured["restitution"] = Number(float(rest[-1]), float(np.ptp(rest)) or None, exact.values.get("restitution"))
    elif "peak_force" in exact.values:
        force, when = _largest_force(result)
        measured["peak_force"] = Number(force, None, exact.values["peak_force"])
        measured["peak_time"] = Number(when, None, exact.values["peak_time"])
    elif exact.impulse is not None:
        expected = exact.impulse(result.tau)
        # mean, not largest: where the impulse jumps, a jump at a slightly wrong time is a small error
        mean = float(np.mean(np.abs(result.J - expected)) / np.abs(expected).max())
        measured["impulse_error"] = Number(mean, None, 0.0)
        measured["impulse"] = Number(float(result.J[-1]), None, float(expected[-1]))
    about = {name: {"error": error, "source": exact.source} for name, error in exact.errors.items()}
    return {"measured": measured, "reference": about}


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


def _judged(found: Score, result: Result) -> Score:
    """What is seen, the judge's additions to the outcome, and the verdict."""
    front = found.measured.get("lambda0", Number()).value or 0.0 if result.problem.kind == "leading" else 0.0
    seen, missing = readings(result, front)
    shown = [one for one in seen.values() if one.seen]
    shown.sort(key=lambda one: not (one.name == "energy" and (one.figure or 0.0) > 1.0))  # a blow-up is that first
    found = replace(found, readings=seen, not_told=missing, symptoms=(*shown, *_of_numbers(found)))
    additions = [WORDS[one.name] for one in shown if one.name in WORDS]
    if found.off:
        additions.append("off")
    elif found.unsure:
        bars = [found.bar(name) for name in found.unsure]
        widest = max((bar for bar in bars if bar is not None), default=None)
        additions.append("no number" if widest is None else f"within its bar of {100.0 * widest:.2g} %")
    reason = "; ".join(map(str, found.symptoms)) or None
    found = replace(found, outcome=", ".join([found.outcome, *additions]), reason=reason)
    return replace(found, diagnosis=_causes(result, found))


def _of_numbers(found: Score) -> list[Symptom]:
    """Numbers that are off, and those whose error or bar is beyond the limit."""
    shown = []
    for name, kind in [*((name, "error") for name in found.off), *((name, "bar") for name in found.unsure)]:
        number, about = found.measured[name], found.reference.get(name)
        limit = FIRST_ORDER if name in LOADED else PART
        size = number.relative(1.0 if name in LOADED else 0.0) if kind == "error" else found.bar(name)
        reference = Number(number.theory, about["error"] if about else None)
        exact = "" if number.theory is None else f", {'reference' if about else 'exact'} {reference}"
        shown.append(Symptom(f"{kind}_{name}", size, limit, f"{number}{exact}", f"{kind} of {name}"))
    return shown


# Causes are named only where the first symptom has one cause alone; everything else has several, and none is named.
SUSPECT = 0.2  # κ/ν below which the first instants may throw the zone off the wall
EVEN = 0.08  # unevenness of a zone that was laid down point after point, without rebounds
STILL = 0.05  # far end's departure from the free motion / V₀τ; half of what is a symptom
PROPORTIONAL = 0.8  # cosine between pushes and penetrations of a wall on springs; 1 where no dashpot helps


def _on_springs(result: Result, found: Score) -> bool:
    """Whether the wall pushes where it is penetrated, and by as much: the law of springs."""
    if result.node_x is None:
        return False
    last = [last_push(result, *snapshot) for snapshot in result.snapshots()]
    depth, force = (np.hstack(parts) for parts in zip(*[(np.maximum(-gap, 0.0), push / t) for push, gap, t in last]))
    size = float(np.linalg.norm(depth) * np.linalg.norm(force))
    return size > 0.0 and float(depth @ force) / size > PROPORTIONAL


def _thrown_off(result: Result, found: Score) -> bool:
    """Whether a zone of a thin first front is lifted, the less so the later (V₀τ outgrows what was thrown up), and was
    laid down evenly: not by points that rebound one by one."""
    zone = 0.5 * np.sqrt(2.0 / result.problem.kappa_over_nu)
    heights = [gap[np.abs(x) <= zone * np.sqrt(when)].max() / when for when, x, gap in result.snapshots()]
    thin = result.problem.kappa_over_nu < SUSPECT and (found.figure("noise_in_space") or 0.0) < EVEN
    return thin and len(heights) > 1 and bool(np.all(np.diff(heights) < 0.0))


def _in_the_books(result: Result, found: Score) -> bool:
    """Whether momentum alone is violated, contact, motion and energy are sound, and no support can have taken it, the
    far end being still: then sums or masses are wrong."""
    sound = not {one.name for one in found.symptoms} & {"energy", "penetration", "lift", "far_end", "motion"}
    return sound and (found.figure("far_end") or 0.0) < STILL


def _settled(result: Result, found: Score) -> bool:
    """Whether a pull is declared, or read off impulses that are smooth: those that jitter fall, too. And of a wall that
    is not penetrated: dashpots beside soft springs pull, too."""
    smooth = not result.pull_is_read_off or (found.figure("noise_in_time") or 0.0) < PART / 2.0
    return smooth and "penetration" not in {one.name for one in found.symptoms}


BOOKS = ("momentum", _in_the_books, "every step's impulse of every point, once; the beam's own mass")
CAUSES: dict[str, tuple[str, Callable[[Result, Score], bool], str]] = {
    "energy": ("energy_gained", lambda result, found: True, "steps, contact and loads: find what does work"),
    "pull": ("adhesion", _settled, "clip the contact's force at zero, or release held points sooner"),
    "momentum": BOOKS,
    "displacement": BOOKS,
    "penetration": ("soft_penalty", _on_springs, "a stiffer contact: as stiff as an element's bending, 12 EI/Δx³"),
    "lift": ("start_unresolved", _thrown_off, "smaller elements at the first touch, or closed points held at first"),
}


def _causes(result: Result, found: Score) -> tuple[Finding, ...]:
    """The cause that the first symptom has alone, else whether a number is off, or that the result is clean."""
    if found.symptoms and (known := CAUSES.get(found.symptoms[0].name)) and known[1](result, found):
        return (Finding(known[0], str(found.symptoms[0]), known[2]),)
    if found.off:
        return (Finding("off", found.reason or "", "the problem's numbers, then mesh and steps"),)
    compared = any(number.difference is not None for number in found.measured.values())
    return (Finding("clean"),) if compared and not found.symptoms else ()


SAME = 1e-6  # of numbers: no two meshes agree so well


def resolution_ignored(scores: Sequence[Score]) -> list[Score]:
    """The scores of one code at several resolutions: three of one problem that agree as no two meshes do are copies,
    and where no two agree within the limit, the spread is a symptom."""
    return [_beside(one, [_numbers(other) for other in scores if other.problem == one.problem]) for one in scores]


def _beside(found: Score, others: Sequence[dict[str, float]]) -> Score:
    own = _numbers(found)
    apart = sorted(_apart(own, other) for other in others if own and other.keys() == own.keys())
    nearest = min((_apart(a, b) for a, b in combinations(others, 2) if a and a.keys() == b.keys()), default=0.0)
    limit = FIRST_ORDER if "lambda1" in own else PART
    if len(apart) >= 3 and apart[2] < SAME:
        seen = Symptom("copies", apart[2], SAME, "", "the very same numbers at three resolutions")
    elif own and nearest > limit:
        seen = Symptom("spread", nearest, limit, "of the two that agree best", "difference between resolutions")
    else:
        return found
    kept = tuple(one for one in found.diagnosis if one.name != "clean" and seen.name == "spread")
    return replace(found, symptoms=(seen, *found.symptoms), diagnosis=kept)


def _numbers(found: Score) -> dict[str, float]:
    """What is compared between resolutions: the numbers over their exact values, and the noise."""
    known = {
        name: one.value / (max(abs(one.theory or 0.0), 1.0 if name in LOADED else 0.0) or 1.0)
        for name, one in found.measured.items()
        if one.value is not None
    }
    noise = found.figure("noise_in_time")
    return known | ({} if noise is None or not known else {"noise": noise})


def _apart(one: Mapping[str, float], other: Mapping[str, float]) -> float:
    return max(abs(one[name] - other[name]) for name in one)
