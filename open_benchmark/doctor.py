"""The likeliest fault of a result of the infinite beam, and what to change.

A decision list over the signs of a result, strongest evidence first; the first rule that holds is the diagnosis, for a
fault has consequences that look like others. Scales as in docs/numerics.md: with λ̂ = √(2/κ) for the front's speed, the
beam bends ahead of it over ℓ(τ) = 2√τ/λ̂, and the front runs λ̂/(2√τ) h in a step h. Thresholds were set on results with
one seeded fault each (tests/open_benchmark/faults.py) and are checked on others.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from open_benchmark.judgement import LIMITS, Finding, Score
from open_benchmark.result import Result

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
FEWEST_SNAPSHOTS = 10
FEWEST_STEPS = 150  # to the end of the record: a first-order scheme then has lost a per cent


@dataclass(frozen=True)
class Signs:
    """The numbers that rules compare; NaN where they are not reported, so that no comparison holds.

    element : length at the front at the end of the record; growth : largest ratio of neighbours; half_length;
    thickness : of the front then; travel : of the front in the last step; steps : how many such make the record;
    unsteady : see ``UNSTEADY``. Lengths in l*.
    """

    gained: float
    adhesion: float
    penetration: float
    lift: float
    noise: float
    thickness: float
    element: float
    growth: float
    half_length: float
    travel: float
    steps: float
    unsteady: float


@dataclass(frozen=True)
class Rule:
    """A diagnosis: when it holds, the signs that show it, and what to change."""

    holds: Callable[[Signs], bool]
    evidence: tuple[str, ...]
    advice: str


def _too_long(s: Signs) -> bool:
    return s.travel > TRAVEL * np.fmax(s.thickness, s.element) or s.steps < FEWEST_STEPS


def _noisy(s: Signs) -> bool:
    return s.noise > max(NOISE, np.nan_to_num(PASSING * s.element**2), np.nan_to_num(OF_LIFT * s.lift))


def _unsteady(s: Signs) -> bool:
    return s.noise > NOISE_WITHOUT_GAPS if math.isnan(s.unsteady) else s.unsteady > UNSTEADY


RULES = {
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
}
NAMES = ("clean", *RULES)

WORDS = {
    "gained": "energy gained / JV₀",
    "adhesion": "tensile impulse / J",
    "penetration": "penetration / V₀t",
    "lift": "lift / V₀t",
    "noise": "noise of the impulse",
    "thickness": "thickness of the front / l*",
    "element": "element at the front / l*",
    "growth": "largest ratio of neighbouring elements",
    "half_length": "half length / l*",
    "travel": "way of the front in the last step / l*",
    "steps": "steps of that length in the record",
    "unsteady": "unsteadiness of the lift",
}


def diagnose(result: Result, found: Score) -> Finding:
    """The likeliest fault, or "clean"."""
    signs = _signs(result, found)
    for name, rule in RULES.items():
        if rule.holds(signs):
            shown = {sign: getattr(signs, sign) for sign in rule.evidence}
            evidence = ", ".join(f"{WORDS[sign]} = {value:.3g}" for sign, value in shown.items() if value == value)
            return Finding(name, evidence, rule.advice)
    return Finding("clean")


# --- reading the signs ---------------------------------------------------------------------------------------------


def _signs(result: Result, found: Score) -> Signs:
    asked = result.problem
    speed = _front_speed(result)
    root = math.sqrt(asked.end_time)
    element, growth, half_length = _mesh(result, speed * root)
    step = _number(result.model("time_step"))
    step = step if step > 0.0 else math.nan
    return Signs(
        gained=_number(found.gained),
        adhesion=_number(found.adhesion),
        penetration=_number(found.penetration),
        lift=_number(found.lift),
        noise=_number(found.noise),
        thickness=2.0 * root / speed,
        element=element,
        growth=growth,
        half_length=half_length,
        travel=speed / (2.0 * root) * step,
        steps=asked.end_time / step,
        unsteady=_unsteadiness(result),
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else value


def _front_speed(result: Result) -> float:
    """λ̂ = √(2/κ) in l*/√t*, of κ = 1 where one point is in contact."""
    return math.sqrt(2.0 / min(max(result.problem.kappa_over_nu, 1e-9), 1.0))


def _mesh(result: Result, front: float) -> tuple[float, float, float]:
    """Element at ``front``, largest growth and half length: off the nodes, or as the adapter declares them."""
    declared = _number(result.model("smallest_element")), math.nan, _number(result.model("half_length"))
    if result.x is None:
        return declared
    nodes = np.unique(np.abs(result.x if result.x.ndim == 1 else result.x[-1]))
    sizes = np.diff(nodes)
    if sizes.size < 3:
        return declared
    at = min(int(np.searchsorted(nodes, front)), sizes.size) - 1
    growth = float((sizes[2:] / sizes[1:-1]).max()) if sizes.size > 3 else math.nan
    return float(sizes[max(at, 0)]), growth, float(nodes[-1])


def _unsteadiness(result: Result) -> float:
    """Standard deviation of ln(lift) about its straight line over ln τ, at ten snapshots of the window or more."""
    inner = 0.6 * math.sqrt(2.0 / max(result.problem.kappa_over_nu, 1e-9))
    zones = [(when, gap[places <= inner * math.sqrt(when)]) for when, places, gap in result.snapshots()]
    lifts = [(math.log(when), math.log(gap.max() / when)) for when, gap in zones if gap.size and gap.max() > 0.0]
    if len(lifts) < FEWEST_SNAPSHOTS:
        return math.nan
    times, heights = np.array(lifts).T
    return float(np.std(heights - np.polyval(np.polyfit(times, heights, 1), times)))
