"""The likeliest fault of a result, and what to change.

A decision list over the signs of a result, strongest evidence first; the first rule that holds is the diagnosis, for a
fault has consequences that look like others. "clean" needs an error that was looked at and is small.
Scales as in docs/numerics.md: with λ̂ = √(2/κ) for the front's speed, the beam bends ahead of it over ℓ(τ) = 2√τ/λ̂, and
the front runs λ̂/(2√τ) h in a step h. Thresholds were set on results with one seeded fault each
(tests/open_benchmark/faults.py) and are checked on others.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from bent_beam_programs.open_benchmark.judgement import LIMITS, Finding, Score
from bent_beam_programs.open_benchmark.result import Result

__all__ = ["NAMES", "diagnose"]

GAINED = 2e-4  # energy gained over JV₀: every passive scheme gains none
ADHESION = LIMITS["adhesion"][0]  # tensile impulse over J
PENETRATION = 2e-3  # over V₀τ: five times that of a penalty with ten times the stiffness of the mesh's shortest wave
SOFT = LIMITS["penetration"][0]
LIFT = LIMITS["lift"][0]  # gap in the zone over V₀τ
NOISE = 8e-4  # residual of the fitted impulse over the impulse
PASSING = 3.0  # the same from the front's passing from element to element, times (Δx)²
ELEMENTS = 2.0  # in the front's thickness ℓ at the end of the record, the fewest
TRAVEL = 0.5  # of the front in a step, over the larger of its thickness and an element
OF_LIFT = 0.03  # noise over lift: waves that come back show in the impulse first, a lifted zone in the gap
UNSTEADY = 6e-3  # deviation of the lift's logarithm from a straight line over that of time
NOISE_WITHOUT_GAPS = 4.5e-4  # the noise that tells the same where gaps are reported at too few instants
UNGRADED = 1.02  # largest ratio of neighbouring elements that reflects next to nothing
FEWEST_STEPS = 150  # to the end of the record: a first-order scheme then has lost a per cent
EXACT = 1e-12  # noise below that of any simulation: the self-similar path comes down to 6e-11
MOMENTUM = 0.015  # of J, and 2.5 times the noise: short waves on coarse elements carry momentum to and fro
FACTORS = (1.0, 2.0, 0.5, *(10.0**n for n in (*range(-12, 0), *range(1, 13))))
NEAR = 0.03  # of a factor
VAGUE = 0.03  # a relative error that its bar still holds, and that is not clean all the same
FEWEST_SNAPSHOTS = 10  # from which unsteadiness is read off
FALLS = 5e-3  # of J: how far it falls without a tensile impulse that is reported


#: The numbers that rules compare, as the evidence words them; NaN, so that no comparison holds, where there is none.
SIGNS = {
    "gained": "energy gained / JV₀",
    "adhesion": "tensile impulse / J",
    "penetration": "penetration / V₀t",
    "lift": "lift / V₀t",
    "noise": "noise of the impulse",
    "thickness": "thickness of the front / l*",
    "element": "element at the front / l*",  # at the end of the record
    "growth": "largest ratio of neighbouring elements",
    "half_length": "half length / l*",
    "end": "",
    "travel": "way of the front in the last step / l*",
    "steps": "steps of that length in the record",
    "unsteady": "unsteadiness of the lift",  # see UNSTEADY
    "momentum": "momentum that the beam lost / J, less 1",
    "ratio_J": "J / the exact J",
    "ratio_Jm": "Jm / the exact Jm",
    "factor": "",  # how many of the ratios are one of FACTORS
    "off": "largest error over its limit",
    "falls": "fall of the impulse / J",  # that no tensile impulse explains
    "unknown": "numbers below their error bar",
    "vague": "largest error within its bars",  # without loads
}
Signs = Any  # a namespace of SIGNS


class Rule(NamedTuple):
    """A diagnosis: when it holds, the signs that show it, and what to change."""

    holds: Callable[[Signs], bool]
    evidence: tuple[str, ...]
    advice: str


def _too_long(s: Signs) -> bool:
    return s.travel > TRAVEL * np.fmax(s.thickness, s.element) or s.steps < FEWEST_STEPS


def _noisy(s: Signs) -> bool:
    """Noise that waves can have brought: not from an end out of their reach, nor by taking impulse back."""
    out_of_reach = s.half_length > math.pi * s.end / s.element and not s.growth > UNGRADED
    if s.falls > FALLS or out_of_reach:
        return False
    return s.noise > max(NOISE, np.nan_to_num(PASSING * s.element**2), np.nan_to_num(OF_LIFT * s.lift))


def _unsteady(s: Signs) -> bool:
    return s.noise > NOISE_WITHOUT_GAPS if math.isnan(s.unsteady) else s.unsteady > UNSTEADY


RULES = {
    "too_exact": Rule(
        lambda s: s.noise < EXACT, ("noise",), "numbers of a simulation: these are smoother than any solver's"
    ),
    "ratio": Rule(
        lambda s: s.factor > 0.0 and not s.falls > FALLS,
        ("ratio_J", "ratio_Jm"),
        "½ or 2: J is the whole wall's, Jm that of one half; a power of ten: units, or forces without the step; −1: "
        "the sign of what the wall gives",
    ),
    "momentum": Rule(
        lambda s: abs(s.momentum) > max(MOMENTUM, 2.5 * np.nan_to_num(s.noise)),
        ("momentum",),
        "sum what every step applied at every contact point, and report velocities of the same run: ∫μ(V₀ − v)dx = J",
    ),
    "energy_gained": Rule(
        lambda s: s.gained > GAINED,
        ("gained",),
        "shorter steps against the contact's stiffness, algorithmic damping, or a contact law that dissipates",
    ),
    "adhesion": Rule(
        lambda s: s.adhesion > ADHESION,
        ("adhesion",),
        "clip the contact force at zero (damping in a contact must not pull), or release held nodes sooner",
    ),
    "soft_penalty": Rule(
        lambda s: s.penetration > SOFT and not s.lift > LIFT,
        ("penetration", "lift"),
        "a stiffer contact: as stiff as an element's own bending, 12 EI/Δx³ a node",
    ),
    "rattling": Rule(
        lambda s: s.penetration > PENETRATION and s.lift > LIFT and s.noise > NOISE,
        ("penetration", "lift", "noise"),
        "damp the contact (about critically against the mass of a node) or the integration (ρ∞ ≤ 0.8)",
    ),
    "steps_too_long": Rule(
        _too_long,
        ("steps", "travel", "thickness", "element"),
        f"shorter steps: {FEWEST_STEPS} in the record or more, and the front runs half its thickness in one at most",
    ),
    "front_unresolved": Rule(
        lambda s: s.thickness < ELEMENTS * s.element,
        ("thickness", "element"),
        f"shorter elements where the front is: {ELEMENTS:g} in its thickness or more",
    ),
    "reflection": Rule(
        _noisy,
        ("noise", "growth", "half_length"),
        "a longer beam (about the end time over the element length), elements that grow by 2 % at most, or damping of "
        "short waves (grid viscosity, an absorbing layer)",
    ),
    "rectified_noise": Rule(
        lambda s: s.lift > LIFT and _unsteady(s),
        ("lift", "unsteady", "noise"),
        "damping at grid scale (θ = 1, ρ∞ small, viscosity ∝ Δx²), or the contact law at the new position",
    ),
    "start_unresolved": Rule(
        lambda s: s.lift > LIFT,
        ("lift", "unsteady", "noise"),
        "smaller elements near the first touch, or all closed nodes held until the front is some elements thick",
    ),
    "unsettled": Rule(
        lambda s: (
            s.noise > LIMITS["noise"][0] or s.falls > FALLS or s.unknown > 0.0 or (s.vague > VAGUE and s.off <= 1.0)
        ),
        ("noise", "falls", "unknown", "vague"),
        "cumulated impulses of every step, not forces, filtered or sampled; a smoother run, or a longer record",
    ),
    "off": Rule(
        lambda s: s.off > 1.0,
        ("off", "ratio_J", "ratio_Jm"),
        "the problem's own numbers (stiffness, mass, curvature, loads, boundary), then mesh and steps",
    ),
}
NAMES = ("clean", *RULES)


def diagnose(result: Result, found: Score) -> tuple[Finding, ...]:
    """The likeliest fault, or "clean"; nothing where no fault shows and no error was looked at."""
    signs = _signs(result, found)
    for name, rule in RULES.items():
        if rule.holds(signs):
            shown = {sign: getattr(signs, sign) for sign in rule.evidence}
            evidence = ", ".join(f"{SIGNS[sign]} = {value:.3g}" for sign, value in shown.items() if value == value)
            return (Finding(name, evidence, rule.advice),)
    compared = any(number.difference is not None for number in found.measured.values())
    return (Finding("clean"),) if compared else ()


# --- reading the signs ---------------------------------------------------------------------------------------------


def _signs(result: Result, found: Score) -> Signs:
    asked, end = result.problem, result.problem.end_time
    signs = {
        "gained": found.gained,
        "adhesion": found.adhesion,
        "penetration": found.penetration,
        "lift": found.lift,
        "noise": found.noise,
        "end": end,
        "momentum": found.momentum_residual,
        "factor": sum(map(_is_factor, found.ratios.values())) if found.off else 0.0,
        "off": found.excess,
        "falls": _falls(result),
        "unknown": sum(number.value is None for number in found.measured.values()),
        "vague": _vague(found) if asked.kind == "leading" else None,
        **{f"ratio_{name}": ratio for name, ratio in found.ratios.items()},
    }
    if asked.is_front:
        # λ̂ = √(2/κ) in l*/√t*, of κ = 1 where one point is in contact
        speed, step = math.sqrt(2.0 / min(max(asked.kappa_over_nu, 1e-9), 1.0)), _step(result)
        signs |= {"thickness": 2.0 * math.sqrt(end) / speed, "unsteady": _unsteadiness(result)}
        signs |= {"travel": speed / (2.0 * math.sqrt(end)) * step, "steps": end / step}
        signs |= _mesh(result, speed * math.sqrt(end))
    known = {name: value for name, value in signs.items() if value is not None}
    return SimpleNamespace(**dict.fromkeys(SIGNS, math.nan) | known)


def _mesh(result: Result, front: float) -> dict[str, float | None]:
    """Element at ``front``, largest growth and half length: off the nodes, or as the adapter declares them."""
    declared = {"element": result.model("smallest_element"), "half_length": result.model("half_length")}
    if result.x is None:
        return declared
    nodes = np.unique(np.abs(result.x if result.x.ndim == 1 else result.x[-1]))
    sizes = np.diff(nodes)
    if sizes.size < 3:
        return declared
    at = min(int(np.searchsorted(nodes, front)), sizes.size) - 1
    growth = float((sizes[2:] / sizes[1:-1]).max()) if sizes.size > 3 else None
    return {"element": float(sizes[max(at, 0)]), "growth": growth, "half_length": float(nodes[-1])}


def _unsteadiness(result: Result) -> float | None:
    """Standard deviation of ln(lift) about its straight line over ln τ, at ten snapshots of the window or more."""
    inner = 0.6 * math.sqrt(2.0 / max(result.problem.kappa_over_nu, 1e-9))
    zones = [(when, gap[places <= inner * math.sqrt(when)]) for when, places, gap in result.snapshots()]
    lifts = [(math.log(when), math.log(gap.max() / when)) for when, gap in zones if gap.size and gap.max() > 0.0]
    if len(lifts) < FEWEST_SNAPSHOTS:
        return None
    times, heights = np.array(lifts).T
    return float(np.std(heights - np.polyval(np.polyfit(times, heights, 1), times)))


def _vague(found: Score) -> float:
    return max((abs(found.error(name) or 0.0) for name in found.measured if name not in found.off), default=0.0)


def _is_factor(ratio: float) -> bool:
    """Whether ``ratio`` is one of ``FACTORS`` or its negative, and not 1."""
    return abs(ratio - 1.0) > NEAR and any(abs(abs(ratio) / factor - 1.0) < NEAR for factor in FACTORS)


def _falls(result: Result) -> float:
    """Sum of the falls of J over its largest, without the tensile impulse that is reported."""
    largest = float(np.abs(result.J).max())
    fall = -float(np.minimum(np.diff(result.J), 0.0).sum()) * (1.0 if result.J[-1] >= 0.0 else 0.0)
    told = float(result.series["J_minus"][-1]) if "J_minus" in result.series else 0.0
    return max(fall - told, 0.0) / largest if largest > 0.0 else math.nan


def _step(result: Result) -> float:
    """The last step: as declared, or longer where J rises in straight lines over several instants: cumulated impulses
    are linear within a step."""
    slope = np.diff(result.J) / np.diff(result.tau)
    turns = np.flatnonzero(np.abs(np.diff(slope)) > 1e-7 * np.abs(slope).max()) + 1
    lines = np.diff(turns)[slope[turns[:-1]] > 0.1 * np.median(slope)][-20:]
    seen = float(np.median(lines)) * float(np.diff(result.tau)[-1]) if lines.size and np.median(lines) > 2 else 0.0
    return max(result.model("time_step") or 0.0, seen) or math.nan
