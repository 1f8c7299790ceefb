r"""Until when the theory of the first instants holds for a real beam. Every limit is a formula, derived in
docs/theory.md, section 9; ℓ is the half length, d the distance of the contact's end from the beam's. The theory's
numbers carry such a range, in which they are right to 2 %, in place of an error bar.

- **ends**: waves that the contact sends and the ends send back change the impulse by √2 ct/d² at most; the limit is
  d = `DISTANCE` √(ct), of a flat contact the time at which it has covered a third of ℓ (`FLAT`).
  Short ones swing the momentary force by 2√2 of itself from the first instant on, damped by e^{−ηℓ⁴/2c²t³}. So the
  force that is told is a mean over a tenth of the time before and after, which they swing by √2 ct/d² · 20. It holds
  until both swings are beyond `SWING` (`force_until`).
  Loads make the ends send waves of their own: with q₀ they swing the force by √2 |q₀|cℓ²/(r₀V₀), with an axial force
  along x by 4√2 NKt/(μV₀r₀), and the impulse by 2ct/ℓ² of as much. Where the force would swing by more than 2 %, the
  limit is d = 2 `DISTANCE` √(ct), or earlier, when the impulse swings by 2 %, but not before the force does.
- **loads**: the second order (`theory.second_order`) over what first order predicts, and the first order over the
  leading one, which has to be small. One point spreads when the loads have taken the curvature κ − ν of its gap away.
- **damping**: one point has a closed form (`theory.damped_point`), under an axial force up to its share in r₁. A zone
  has one as long as it is one point, until T_p η.
- **hysteretic loss**: a modulus that grows with the frequency leaves no self-similar contact; never valid.
- **slope**: an arch is lower than its parabola by θ²/12. This is about the slope that the impact adds.
- **shear**: a beam that shears has formulas of its own (`theory.shear`), after some times t_s = √(EIμ)/(κ_sGA). Shear
  waves swing the reaction of a beam without damping longer: by 9 % at `valid_from`, by 2 % twice as late.
- **wall**: one that gives way counts as rigid after many times √(μ/k) (`theory.wall_prediction`).
- **section**: the leading order's stress is beyond the yield stress from the first instant on.
"""

import math
from dataclasses import dataclass

import numpy as np

from bent_beam.impact import Impact
from theory import damped_point
from theory.contact import DISCRETE, ContactParameters, contact_parameters
from theory.second_order import second_order
from theory.shear import forgotten_after
from theory.similarity import SelfSimilarWave, peak_moment_of

#: What force, impulse and half length may lack. The half length is the place of the force. With shear, or on a wall
#: that gives way, this is spread over some length; the rim is a constant distance ahead of its place.
TOLERANCE = 0.02
#: Distance between the ends of contact and beam over √(ct), at which waves from the ends begin to matter.
DISTANCE = 10.0
#: What waves that come back once may add to the force; those that come back again add less than as much.
SWING = 0.5 * TOLERANCE
#: Half length of the beam over that of a flat contact, at which waves of its front are back from the ends.
FLAT = 3.0
#: First order over leading order, beyond which an expansion says nothing.
SMALL_CHANGE = 0.3
#: κ/ν of the flattest contact for which λ₂ and r₂ keep all digits; flatter ones are like it (`_second_order`).
FLATTEST_SOLVED = 3e-3
#: Slope at which an arch is 2 % lower than its parabola, θ²/12.
SLOPE_LIMIT = math.sqrt(12.0 * TOLERANCE)

ENDS = "waves back from the ends"
FIRST_ORDER = "first-order correction"
TENSION = "tension"
DAMPING = "damping"
HYSTERESIS = "hysteretic loss"
SLOPE = "slope"
SHEAR = "shear"
WALL = "wall"
SECTION = "section"


@dataclass(frozen=True)
class Validity:
    """The theory holds for `valid_from` ≤ t ≤ `valid_until` (s), which `limited_by` ends. Never: `valid_until` = 0.
    `valid_after` names what spoils it before `valid_from` (None: it holds from the first instant). The force, a mean
    over a tenth of the time before and after, holds until `force_until` alone: then waves from the ends swing it."""

    valid_from: float
    valid_until: float
    limited_by: str
    valid_after: str | None = None
    force_until: float = 0.0

    def spoiled_by(self, time: float) -> str | None:
        """What spoils the theory at `time` (s); None: it holds."""
        if self.valid_until == 0.0 or time > self.valid_until:
            return self.limited_by
        return self.valid_after if time < self.valid_from else None


def validity(impact: Impact, solved: ContactParameters, *, rigid_from: float = 0.0, yields: bool = False) -> Validity:
    """The interval in which half length and impulse are within 2 % of those of the beam, and that of the force.

    impact : the physical problem.
    solved : its contact parameters with ε = 1 (α stands for εα and so on).
    rigid_from : time after which a wall that gives way counts as rigid, s (`theory.wall_prediction`).
    yields : whether the leading order's bending stress is beyond the material's yield stress.
    """
    if yields and rigid_from == 0.0:
        return Validity(0.0, 0.0, SECTION)
    if impact.hysteretic_loss > 0.0:
        return Validity(0.0, 0.0, HYSTERESIS)
    limits = [(_until_ends(impact, solved), ENDS), _until_loads(solved), (_until_slope(solved), SLOPE)]
    if impact.damping > 0.0:
        limits.append((_until_damping(impact, solved), DAMPING))
    until, limited_by = min(limits)
    until *= impact.time_scale
    starts = [(rigid_from, WALL)]
    if impact.shear_stiffness is not None:
        starts.append((forgotten_after(solved.kappa_over_nu) * impact.shear_time, SHEAR))
    begins, after = max(starts)
    force = min(until, _until_swings(impact, solved))
    if begins == 0.0:
        return Validity(0.0, until, limited_by, force_until=force)
    if begins >= until or yields:  # a wall that gives way bends the beam less until it counts as rigid
        return Validity(0.0, 0.0, after if begins >= until else SECTION)
    return Validity(begins, until, limited_by, after, force)


def _until_swings(impact: Impact, solved: ContactParameters) -> float:
    """Time, s, from which on waves from the ends swing both the force and its mean by more than `SWING`. Without
    damping they swing the force from the first instant on."""
    whole = 20.0 * math.sqrt(2.0) / SWING  # d²/ct
    undamped = (math.sqrt(whole) + solved.lambda0) ** -2.0  # T*
    decay = 2.0 * math.log(2.0 * math.sqrt(2.0) / SWING)  # ηℓ⁴/c²t³
    damped = (impact.damping / impact.slow_time_scale / decay) ** (1.0 / 3.0)
    return max(undamped, damped) * impact.slow_time_scale


def _until_ends(impact: Impact, solved: ContactParameters) -> float:
    """τ at which the contact's end is `DISTANCE` √(ct) from the beam's, or earlier where q₀ sends waves from there."""
    slow = impact.slow_time_scale / impact.time_scale
    time = max(DISTANCE + solved.lambda0, FLAT * solved.lambda0) ** -2.0  # T*
    quartic = abs(impact.fourth_derivative) * impact.half_length**4 / (impact.velocity * impact.slow_time_scale)
    twice = (2.0 * DISTANCE + solved.lambda0) ** -2.0
    if math.sqrt(2.0) * quartic > TOLERANCE * solved.r0:
        time = min(time, twice, TOLERANCE * solved.r0 / (2.0 * math.sqrt(2.0) * quartic))
    if impact.tension_direction == "axis":
        pull = abs(impact.axial_force) * impact.curvature * impact.slow_time_scale
        swing = 4.0 * math.sqrt(2.0) * pull / (impact.mass_per_length * impact.velocity * solved.r0)  # a T*
        if swing * time > TOLERANCE:
            time = min(time, max(TOLERANCE / swing, min(twice, math.sqrt(TOLERANCE / (2.0 * swing)))))
    return time * slow


def _until_loads(solved: ContactParameters) -> tuple[float, str]:
    """τ at which the second order is 2 % of the first, or this no longer small, and which load does most."""
    size = max(abs(solved.alpha), abs(solved.psi), abs(solved.chi), abs(solved.axial))
    if size == 0.0:
        return math.inf, FIRST_ORDER
    # homogeneous in loads times τ: loads of order one are solved for
    alpha, psi, chi, axial = (v / size for v in (solved.alpha, solved.psi, solved.chi, solved.axial))
    unit = contact_parameters(solved.kappa_over_nu, alpha, psi, chi, axial=axial)
    lambda2, r2, opening = _second_order(unit)
    changes = [(unit.r1 / unit.r0, r2 / unit.r0)]
    if unit.lambda0 > 0.0:
        changes.append((unit.lambda1 / unit.lambda0, lambda2 / unit.lambda0))
    found = math.inf
    if unit.lambda0 > 0.0 or axial != 0.0:  # one point without an axial force is linear in the loads
        found = min(_until_second_order(first, second) for first, second in changes)
    elif unit.r1 < 0.0:
        found = -unit.r0 / unit.r1  # the force is gone
    if unit.lambda0 == 0.0 and opening < 0.0:
        found = min(found, (unit.kappa_over_nu - 1.0) / -opening)
    return found / size, TENSION if _tension_leads(solved) else FIRST_ORDER


def _until_second_order(first: float, second: float) -> float:
    """The smallest τ > 0 with |second|τ² = 2 % of |1 + first τ|, or |first|τ = `SMALL_CHANGE`."""
    found = SMALL_CHANGE / abs(first) if first else math.inf
    if second:
        # |second|τ² − 2 % first τ − 2 % = 0; 1 + first τ > 0 up to `found`
        half = 0.5 * TOLERANCE * first
        found = min(found, (half + math.sqrt(half**2 + TOLERANCE * abs(second))) / abs(second))
    return found


def _second_order(p: ContactParameters) -> tuple[float, float, float]:
    """λ₂, r₂ and the rate of the curvature. As κ → 0 relative changes depend on α, χ/κ, ψ/κ² and κn alone, so that a
    flatter contact is one of κ = `FLATTEST_SOLVED` with other loads, but for a relative error of order κ."""
    if p.kappa_over_nu >= FLATTEST_SOLVED:
        second = second_order(p)
        return second.lambda2, second.r2, second.opening
    flatter = p.kappa_over_nu / FLATTEST_SOLVED
    like = contact_parameters(FLATTEST_SOLVED, p.alpha, p.psi / flatter**2, p.chi / flatter, axial=p.axial * flatter)
    second = second_order(like)
    return second.lambda2 / like.lambda0 * p.lambda0, second.r2 / like.r0 * p.r0, second.opening


def _tension_leads(solved: ContactParameters) -> bool:
    """Whether the axial force changes r more than the loads do."""
    if solved.axial == 0.0:
        return False
    alone = contact_parameters(solved.kappa_over_nu, solved.alpha, solved.psi, solved.chi)
    return abs(solved.r1 - alone.r1) >= abs(alone.r1)


def _until_damping(impact: Impact, solved: ContactParameters) -> float:
    """τ until which a damped contact has a closed form: as long as it is one point."""
    if solved.regime != DISCRETE:
        return damped_point.age_of_spreading(solved.kappa_over_nu) * impact.damping / impact.time_scale
    share = abs(solved.r_axial * solved.axial) / solved.r0
    return TOLERANCE / share if share > 0.0 else math.inf


def _until_slope(solved: ContactParameters) -> float:
    """τ at which the slope that the impact adds, |η_ξ| (one of the beam), reaches its limit."""
    start, stop = float(solved.lambda0), float(peak_moment_of(solved).place)
    steepest = float(np.max(np.abs(SelfSimilarWave(solved).slope(np.linspace(start, stop, 65)))))
    return (SLOPE_LIMIT / steepest) ** 2 if steepest > 0.0 else math.inf
