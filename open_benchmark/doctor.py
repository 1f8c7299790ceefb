"""What is likely wrong with a result of the infinite beam, and what to change.

A decision list over what the result shows, strongest evidence first. Scales as in docs/numerics.md: with
λ̂ = √(2/κ) for the front's speed, the beam bends ahead of it over ℓ(τ) = 2√τ/λ̂, and the front runs λ̂/(2√τ) h in a step
h. Thresholds were set on results with one seeded fault each (tests/open_benchmark/faults.py) and are checked on others.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from open_benchmark.judgement import LIMITS, Finding, Score
from open_benchmark.result import Result

__all__ = ["NAMES", "diagnose"]

Array = NDArray[np.float64]

NAMES = (
    "clean",
    "reflection",
    "front_unresolved",
    "start_unresolved",
    "rectified_noise",
    "adhesion",
    "soft_penalty",
    "rattling",
    "steps_too_long",
    "energy_gained",
)

GAINED = 2e-4  # energy gained over JV₀: every passive scheme gains none
ADHESION = LIMITS["adhesive"]  # tensile impulse over J
PENETRATION = 2e-3  # over V₀τ: five times that of a penalty with ten times the stiffness of the mesh's shortest wave
SOFT = LIMITS["leaky"]
LIFT = LIMITS["lifted"]  # gap in the zone over V₀τ
NOISE = 8e-4  # residual of the fitted impulse over the impulse
PASSING = 3.0  # the same from the front's passing from element to element, times (Δx)²
ELEMENTS = 2.0  # in the front's thickness ℓ at the end of the record, the fewest
TRAVEL = 0.5  # of the front in a step, over the larger of its thickness and an element
GROWTH = 1.05  # of neighbouring elements: what reflects short waves (docs/numerics.md)
OF_LIFT = 0.03  # noise over lift: waves that come back show in the impulse first, a lifted zone in the gap
UNSTEADY = 6e-3  # deviation of the lift's logarithm from a straight line over that of time
NOISE_WITHOUT_GAPS = 4.5e-4  # the noise that tells the same where gaps are reported at too few instants
FEWEST_SNAPSHOTS = 10
FEWEST_STEPS = 150  # to the end of the record: a first-order scheme then has lost a per cent


@dataclass(frozen=True)
class Signs:
    """What the mesh, the steps and the gaps of a result tell; ``None`` where they are not reported.

    element : length at the front at the end of the record; growth : largest ratio of neighbours; half_length;
    thickness : of the front then; travel : of the front in the last step; steps : how many such make the record;
    unsteady : see ``UNSTEADY``.
    """

    thickness: float
    element: float | None
    growth: float | None
    half_length: float | None
    travel: float | None
    steps: float | None
    unsteady: float | None


def diagnose(result: Result, found: Score) -> list[Finding]:
    """The likeliest fault, or "clean". One only: a fault has consequences that look like others."""
    signs = _signs(result)
    for look in (_gain, _pull, _contact, _resolution, _waves, _lift):
        finding = look(found, signs)
        if finding is not None:
            return [finding]
    return [Finding("clean")]


def _gain(found: Score, signs: Signs) -> Finding | None:
    gained = (found.energy or {}).get("gained")
    if gained is None or gained <= GAINED:
        return None
    return Finding(
        "energy_gained",
        f"the beam gained {100 * gained:.2g} % of JV₀",
        "shorter steps against the contact's stiffness, algorithmic damping, or a contact law that dissipates",
    )


def _pull(found: Score, signs: Signs) -> Finding | None:
    if found.adhesion is None or found.adhesion <= ADHESION:
        return None
    return Finding(
        "adhesion",
        f"the wall pulled with {100 * found.adhesion:.2g} % of the impulse",
        "clip the contact force at zero (damping in a contact must not pull), or release held nodes sooner",
    )


def _contact(found: Score, signs: Signs) -> Finding | None:
    depth, lift, noise = found.penetration or 0.0, found.lift or 0.0, found.noise or 0.0
    if depth <= PENETRATION:
        return None
    if depth > SOFT and lift <= LIFT:
        return Finding(
            "soft_penalty",
            f"the beam is {100 * depth:.2g} % of V₀t inside the wall and stays there",
            "a stiffer contact: as stiff as an element's own bending, 12 EI/Δx³ a node",
        )
    if lift > LIFT and noise > NOISE:
        return Finding(
            "rattling",
            f"penetration {depth:.2g} and lift {lift:.2g} of V₀t at once",
            "damp the contact (about critically against the mass of a node) or the integration (ρ∞ ≤ 0.8)",
        )
    return None


def _resolution(found: Score, signs: Signs) -> Finding | None:
    if signs.travel is not None and signs.steps is not None:
        room = max(signs.thickness, signs.element or 0.0)
        needed = max(signs.travel / (TRAVEL * room), FEWEST_STEPS / signs.steps)
        if needed > 1.0:
            return Finding(
                "steps_too_long",
                f"{signs.steps:.0f} steps like the last make the record; the front runs {signs.travel:.2g} l* in one",
                f"steps at least {needed:.2g} times shorter",
            )
    if signs.element is not None and signs.thickness < ELEMENTS * signs.element:
        return Finding(
            "front_unresolved",
            f"the front is {signs.thickness:.2g} l* thick, an element there {signs.element:.2g} l*",
            f"elements at least {ELEMENTS * signs.element / signs.thickness:.2g} times shorter where the front is",
        )
    return None


def _waves(found: Score, signs: Signs) -> Finding | None:
    least = max(NOISE, PASSING * (signs.element or 0.0) ** 2, OF_LIFT * (found.lift or 0.0))
    if found.noise is None or found.noise <= least:
        return None
    if signs.growth is not None and signs.growth > GROWTH:
        cause = f"elements grow by {100 * (signs.growth - 1):.2g} % from one to the next"
        advice = "let elements grow by 2 % at most, or absorb short waves (grid-scale viscosity, a sponge)"
    else:
        cause = "waves come back to the contact"
        if signs.half_length is not None:
            cause += f" from the end at {signs.half_length:.2g} l*"
        advice = "a longer beam (about the end time over the element length), or damp short waves"
    return Finding("reflection", f"the impulse is {100 * found.noise:.2g} % off a smooth one; {cause}", advice)


def _lift(found: Score, signs: Signs) -> Finding | None:
    if found.lift is None or found.lift <= LIFT:
        return None
    noisy = signs.unsteady > UNSTEADY if signs.unsteady is not None else (found.noise or 0.0) > NOISE_WITHOUT_GAPS
    if noisy:
        return Finding(
            "rectified_noise",
            f"the zone is kicked off again and again: lift {found.lift:.2g} of V₀t, unsteady",
            "damping at grid scale (θ = 1, ρ∞ small, viscosity ∝ Δx²), or the contact law at the new position",
        )
    return Finding(
        "start_unresolved",
        f"the zone floats off smoothly, lift {found.lift:.2g} of V₀t: the first instants threw it",
        "smaller elements near the first touch, or all closed nodes held until the front is some elements thick",
    )


# --- reading the signs ---------------------------------------------------------------------------------------------


def _signs(result: Result) -> Signs:
    asked = result.problem
    speed = math.sqrt(2.0 / min(max(asked.kappa_over_nu, 1e-9), 1.0))
    root = math.sqrt(asked.end_time)
    place, thickness = speed * root, 2.0 * root / speed
    step = result.model("time_step")
    if step is not None and step <= 0.0:
        step = None  # says nothing
    element = growth = half_length = None
    if result.x is not None and result.x.size > 3:
        nodes = np.unique(np.abs(result.x if result.x.ndim == 1 else result.x[-1]))
        sizes = np.diff(nodes)
        if sizes.size > 2:
            at = min(int(np.searchsorted(nodes, min(place, nodes[-1]))), nodes.size - 1) - 1
            element, half_length = float(sizes[max(at, 0)]), float(nodes[-1])
            growth = float((sizes[2:] / sizes[1:-1]).max()) if sizes.size > 3 else None
    return Signs(
        thickness=thickness,
        element=element if element is not None else result.model("smallest_element"),
        growth=growth,
        half_length=half_length if half_length is not None else result.model("half_length"),
        travel=None if step is None else speed / (2.0 * root) * step,
        steps=None if step is None else asked.end_time / step,
        unsteady=_unsteadiness(result),
    )


def _unsteadiness(result: Result) -> float | None:
    """Standard deviation of ln(lift) about its straight line over ln τ, at ten snapshots of the window or more."""
    if result.x is None or result.snap_gap is None or result.snap_tau is None:
        return None
    low, high = result.problem.fit_window
    inner = 0.6 * math.sqrt(2.0 / max(result.problem.kappa_over_nu, 1e-9))
    times, lifts = [], []
    for k, when in enumerate(result.snap_tau):
        if not low <= when <= high * (1 + 1e-3):
            continue
        places = np.abs(result.x if result.x.ndim == 1 else result.x[k])
        zone = result.snap_gap[k][places <= inner * math.sqrt(when)]
        if zone.size and zone.max() > 0.0:
            times.append(math.log(when))
            lifts.append(math.log(zone.max() / when))
    if len(times) < FEWEST_SNAPSHOTS:
        return None
    line = np.polyfit(times, lifts, 1)
    return float(np.std(np.asarray(lifts) - np.polyval(line, times)))
