r"""Until when the theory of the first instants holds for a real beam, and what ends it.

What half length, force and impulse lack is added up with its signs: waves that have been at the ends, and those that
start there where the free motion has a fourth derivative (measured on the whole beam, `ends.json`); the second order in
the loads and the axial force (`theory.second_order`); and what damping changes of the answer of a zone to them
(measured, `theory.damped_zone`). The third order is bounded by measurement. With their relative errors e_i(t)

    max |e_i| + 0.1 x³ ≤ ¾ tol,   tol = 2 %,   x = max(|λ₁|τ/λ₀, |r₁|τ/r₀);

a quarter is left for what these do to each other. What comes from the ends grows so fast that it is its time that
must be right, which is known to a tenth: it counts as it is at t or already at 1.1 t, whichever is more. 0.1x³: on the
self-similar path the error of first order exceeds the second by at most 0.08x³ for a load α at κ/ν = 0.05 … 0.8, both
regimes (docs/theory.md). ε is not in it: the leading order is exact at any ε until the ends are felt.

One point begins to spread when the loads have taken the gap's curvature away that is left beside it; a few per cent
beyond that (`POINT`) its length does not matter.

Beyond these: slope (an arch is lower than its parabola by θ²/12, 2 % at θ = 0.49), shear (a Timoshenko beam starts
otherwise: a zone's force is within 1 % after 10 t_s, one point's within 4 %, t_s = √(EIμ)/(κ_sGA)), and a section that
yields.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.impact import Impact
from theory import damped_zone
from theory._fresnel import FloatArray
from theory.contact import DISCRETE, ContactParameters, contact_parameters
from theory.moment import peak_moment_of
from theory.second_order import second_order
from theory.similarity import SelfSimilarWave

#: Made by `python -m comparison.whole_impact.ends`: relative changes over κ/ν and phase, and the tolerance.
DATA = Path(__file__).with_name("ends.json")
#: Of the tolerance, what the known errors may take.
SHARE = 0.75
#: By how much earlier than measured what comes from the ends may come (`make verify` holds it to that).
EARLIER = 1.1
#: Bound of the third order over x³.
THIRD_ORDER = 0.1
#: κ/ν of the flattest contact for which λ₂ and r₂ keep all digits; flatter ones are like it (`_second_order`).
FLATTEST = 3e-3
#: From and until when, over its age, the lifted middle's pulse makes the force uncertain by some per cent: it is felt
#: from 0.81 of it on, under a pressure that is the largest of the random problems' from 0.77.
PULSE = (0.75, 1.3)
#: What the loads may take of a point's curvature beyond all of it, over ν: λ_c is then 0.05√(ct).
POINT = 0.04
#: Slope at which an arch is 2 % lower than its parabola, θ²/12.
SLOPE_LIMIT = math.sqrt(12.0 * 0.02)
#: Shear times t_s after which Euler and Bernoulli's beam is within the tolerance, for a zone and for one point.
SHEAR_TIMES = {"zone": 10.0, "point": 20.0}

ENDS = "waves back from the ends"
FIRST_ORDER = "first-order correction"
TENSION = "tension"
DAMPING = "damping"
TOUCH = "lifted middle back on the wall"
SLOPE = "slope"
SHEAR = "shear"
SECTION = "section"


@dataclass(frozen=True)
class Validity:
    """The theory holds for `begins` ≤ t ≤ `until` (s); `limited_by` names what ends it. Never valid: until = 0.

    `begins_after` names what spoils it before `begins` (None: nothing does, it holds from the first instant).
    """

    begins: float
    until: float
    limited_by: str
    begins_after: str | None = None

    def spoiled_by(self, time: float) -> str | None:
        """What spoils the theory at `time` (s); None: it holds."""
        if self.until == 0.0 or time > self.until:
            return self.limited_by
        return self.begins_after if time < self.begins else None


@cache
def _table() -> dict[str, Any]:
    return dict(json.loads(DATA.read_text(encoding="utf-8")))


def phase(kappa_over_nu: float, time: FloatArray) -> dict[str, FloatArray]:
    """Phases of waves from the ends where they meet the front, at t/T* = `time` (ℓ the half length).

    Bending waves that start together have the phase x²/(4ct) at x. Those that come back from the middle's image at 2ℓ
    meet the front, at λ₀√(ct), with 1/t − λ₀/√t more than it has itself (`ends`); those that start at the end with
    (1/√t − λ₀)²/4, 0 once the front is there (`quartic`). At equal phases curves of different κ/ν have their crests.
    """
    front, root = _front(kappa_over_nu), 1.0 / np.sqrt(time)
    return {"ends": root * (root - front), "quartic": 0.25 * np.maximum(root - front, 0.0) ** 2}


@lru_cache(maxsize=128)
def _front(kappa_over_nu: float) -> float:
    """λ₀, 0 for one point."""
    return float(contact_parameters(kappa_over_nu).lambda0)


def ends_errors(kappa_over_nu: float, time: FloatArray, damping: float = 0.0) -> FloatArray:
    """Relative change of half length, force and impulse by the ends, at t/T* = `time` and η/T* = `damping`.

    Between what was measured linear in ln κ/ν at equal phases, and in the phase. Below the smallest κ/ν the same comes
    earlier, as 1/λ₀², like the time at which the contact itself reaches the ends. Damping kills the short waves, which
    are the first to come back: a factor on time.

    Returns:
        Without loads, and per unit of q₀ (V₀T*/ℓ⁴), shape (2, 3, n).
    """
    table = _table()
    ratios = np.array(table["kappa_over_nu"])
    stretch, size = _factor(damping) * _flattened(kappa_over_nu), max(1.0, float(ratios[0]) / kappa_over_nu)
    here = min(max(kappa_over_nu, float(ratios[0])), float(ratios[-1]))
    i = min(max(int(np.searchsorted(ratios, here)) - 1, 0), ratios.size - 2)
    share = math.log(here / ratios[i]) / math.log(ratios[i + 1] / ratios[i])
    phases = phase(here, time / stretch)
    found = np.empty((2, 3, time.size))
    for k, cause in enumerate(("ends", "quartic")):
        stored = table[cause]
        for j, name in enumerate(("half_length", "reaction", "impulse")):
            row = (1.0 - share) * np.array(stored[name][i]) + share * np.array(stored[name][i + 1])
            found[k, j] = np.interp(phases[cause], stored["phase"], row, right=0.0)
    found[1] *= size
    return found


@lru_cache(maxsize=128)
def _flattened(kappa_over_nu: float) -> float:
    """How much earlier the ends are felt below the smallest measured κ/ν."""
    first = float(_table()["kappa_over_nu"][0])
    if kappa_over_nu >= first:
        return 1.0
    return float(contact_parameters(first).lambda0 / contact_parameters(kappa_over_nu).lambda0) ** 2


def _factor(damping: float) -> float:
    table = _table()
    known = np.array(table["damping"])
    at = np.log(max(damping, float(known[0])))
    return float(np.exp(np.interp(at, np.log(known), np.log(table["factor"]))))


def latest(kappa_over_nu: float, damping: float = 0.0) -> float:
    """t/T* beyond which nothing was measured: the ends have long been felt."""
    table = _table()
    return float(table["last"]) * _factor(damping) * _flattened(kappa_over_nu)


def validity(
    impact: Impact,
    solved: ContactParameters,
    *,
    shear_stiffness: float | None = None,
    yields: bool = False,
) -> Validity:
    """The interval in which half length, force and impulse are within 2 %.

    Args:
        impact: the physical problem.
        solved: its contact parameters with ε = 1 (α stands for εα and so on).
        shear_stiffness: κ_sGA, N; None: shear is left out.
        yields: whether the leading order's bending stress is beyond the material's yield stress.
    """
    errors = _Errors(impact, solved)
    begins, begins_after = 0.0, None
    if solved.regime != DISCRETE and impact.damping > 0.0:
        begins = damped_zone.earliest_age(solved.kappa_over_nu) * impact.damping / impact.time_scale
        if solved.kappa_over_nu < damped_zone.flattest():
            return Validity(0.0, 0.0, DAMPING)
    until, limited_by = errors.limit(begins)
    if solved.regime != DISCRETE and impact.damping > 0.0 and solved.kappa_over_nu > damped_zone.shortest():
        spreads = damped_zone.age_of_spreading(solved.kappa_over_nu) * impact.damping / impact.time_scale
        if spreads < until * (1.0 + 1e-9):  # what loads do then begins there too
            until, limited_by = min(spreads, until), DAMPING
    steep = _slope(solved)
    if steep > 0.0 and (SLOPE_LIMIT / steep) ** 2 < until:
        until, limited_by = (SLOPE_LIMIT / steep) ** 2, SLOPE
    if begins > 0.0:
        begins_after = DAMPING
    if begins >= until:
        limited_by = DAMPING if begins > 0.0 else limited_by
        begins, until = 0.0, 0.0
    begins, until = begins * impact.time_scale, until * impact.time_scale
    if shear_stiffness is not None and until > 0.0:
        shear_time = math.sqrt(impact.bending_stiffness * impact.mass_per_length) / shear_stiffness
        sheared = SHEAR_TIMES["point" if solved.regime == DISCRETE else "zone"] * shear_time
        if sheared > begins:
            begins, begins_after = sheared, SHEAR
        if begins >= until:
            begins, until, limited_by = 0.0, 0.0, SHEAR
    if yields:
        begins, until, limited_by = 0.0, 0.0, SECTION
    return Validity(begins, until, limited_by, begins_after if until > 0.0 else None)


class _Errors:
    """What half length, force and impulse lack at τ, each relative, by cause."""

    def __init__(self, impact: Impact, solved: ContactParameters) -> None:
        self.solved, self.loads = solved, _Loads(solved)
        self.damping = impact.relative_damping
        self.unit = impact.slow_time_scale / impact.time_scale  # T* in t*
        self.age = impact.time_scale / impact.damping if impact.damping > 0.0 else math.inf  # t* in η
        self.quartic = impact.fourth_derivative * impact.half_length**4 / (impact.velocity * impact.slow_time_scale)
        self.end = latest(solved.kappa_over_nu, self.damping) * self.unit
        pushed = solved.alpha + solved.axial * solved.kappa + solved.psi
        self.acting = np.array([max(pushed, 0.0), max(-pushed, 0.0), solved.chi, solved.psi, solved.axial])

    def causes(self, tau: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Ends, as measured and if they come earlier, second order, third order: the first three with signs, shapes
        (2, 3, n) and (3, n), the last as a bound, shape (n,)."""
        ends = np.array([self._ends(tau), self._ends(EARLIER * tau)])
        second, third = self.loads.errors(tau)
        if self.solved.regime != DISCRETE and math.isfinite(self.age) and np.any(self.acting):
            rates = damped_zone.load_rates(self.solved.kappa_over_nu, tau * self.age)
            known = damped_zone.known_press(self.solved.kappa_over_nu)  # what predict takes into account
            rates[damped_zone.LOADS.index("press")] *= 1.0 - known + damped_zone.UNSURE * known
            second = second + np.tensordot(self.acting, rates, 1) * tau
            waiting = damped_zone.waiting(self.solved.kappa_over_nu, tau * self.age)
            second[0] += waiting * self.solved.lambda1 / self.solved.lambda0 * tau
        return ends, second, third

    def _ends(self, tau: FloatArray) -> FloatArray:
        bare, quartic = ends_errors(self.solved.kappa_over_nu, tau / self.unit, self.damping)
        return bare + self.quartic * quartic

    def total(self, tau: FloatArray) -> FloatArray:
        """The largest of the three errors, shape (n,)."""
        ends, second, third = self.causes(tau)
        return np.asarray(np.max(np.abs(ends + second), axis=(0, 1)) + third)

    def limit(self, begins: float) -> tuple[float, str]:
        """τ at which the error first reaches what it may after `begins`, and what makes it (0: at once)."""
        most = SHARE * float(_table()["tolerance"])
        tau = np.sort(np.concatenate([self.end * np.geomspace(1e-4, 1.0, 600), self.loads.scale * _DECADES]))
        tau = tau[(tau > begins) & (tau <= self.end)]
        beyond = np.flatnonzero(~(self.total(tau) <= most))
        high = float(tau[beyond[0]]) if beyond.size else self.end
        low = begins if not beyond.size or beyond[0] == 0 else float(tau[beyond[0] - 1])
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.total(np.array([middle]))[0] <= most else (low, middle)
        until = min(low, self.loads.point)
        touch = damped_zone.touch_age(self.solved.kappa_over_nu) if math.isfinite(self.age) else None
        if touch is not None and PULSE[0] * touch < until * self.age < PULSE[1] * touch:
            return PULSE[0] * touch / self.age, TOUCH
        if until == self.loads.point or until == 0.0:
            return until, TENSION if _tension_leads(self.solved) else FIRST_ORDER
        ends, second, third = self.causes(np.array([until]))
        if np.max(np.abs(second)) + third[0] > np.max(np.abs(ends)):
            return until, TENSION if _tension_leads(self.solved) else FIRST_ORDER
        return until, ENDS


_DECADES = np.geomspace(1e-6, 1.0, 600)


class _Loads:
    """Relative errors of first order; homogeneous in loads times τ, so that loads of order one are solved for."""

    def __init__(self, solved: ContactParameters) -> None:
        self.size = max(abs(solved.alpha), abs(solved.psi), abs(solved.chi), abs(solved.axial))
        self.exact = self.size == 0.0 or (solved.regime == DISCRETE and solved.axial == 0.0)  # a linear problem
        self.scale, self.point = 0.0, math.inf
        if self.size == 0.0:
            return
        alpha, psi, chi, axial = (v / self.size for v in (solved.alpha, solved.psi, solved.chi, solved.axial))
        self.unit = p = contact_parameters(solved.kappa_over_nu, alpha, psi, chi, axial=axial)
        spreads = p.lambda0 > 0.0
        self.change = max(abs(p.r1) / p.r0, abs(p.lambda1) / p.lambda0 if spreads else 0.0)
        self.lambda2, self.r2, opening = _second_order(p)
        if not spreads and opening < 0.0:
            self.point = (p.kappa_over_nu - 1.0 + POINT) / (-opening * self.size)
        square = max(abs(self.r2) / p.r0, abs(self.lambda2) / p.lambda0 if spreads else 0.0)
        # τ at which a first or second order is as large as the leading one
        pace = max(self.change, math.sqrt(square)) * self.size
        self.scale = 1.0 / pace if pace > 0.0 else 0.0  # loads may be subnormal

    def errors(self, tau: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Second order of half length, force and impulse, shape (3, n), and the bound of the third, shape (n,)."""
        found, third = np.zeros((3, tau.size)), np.zeros(tau.size)
        if self.exact:
            return found, third
        p, at = self.unit, self.size * tau
        push, spread = p.r0 + p.r1 * at, p.lambda0 + p.lambda1 * at
        uniform = np.sqrt(np.pi / 2.0) * at * p.uniform_reaction
        force = push + uniform * spread
        total = p.r0 + p.r1 * at / 3.0 + uniform * (p.lambda0 / 3.0 + p.lambda1 * at / 5.0)
        with np.errstate(all="ignore"):
            found[1], found[2] = self.r2 * at**2 / force, self.r2 * at**2 / (5.0 * total)
            if p.lambda0 > 0.0:
                found[0] = self.lambda2 * at**2 / spread
            third = THIRD_ORDER * (self.change * at) ** 3
        gone = ~(push > 0.0) | ~(force > 0.0) | ~(spread > 0.0) & (p.lambda0 > 0.0)
        return np.where(gone, np.inf, found), np.where(gone, np.inf, third)


def _second_order(p: ContactParameters) -> tuple[float, float, float]:
    """λ₂, r₂ and the rate of the curvature.

    As κ → 0 relative changes depend on α, χ/κ, ψ/κ² and κn alone, so that a flatter contact is one of κ = `FLATTEST`
    with other loads, but for a relative error of order κ.
    """
    if p.kappa_over_nu >= FLATTEST:
        second = second_order(p)
        return second.lambda2, second.r2, second.opening
    flatter = p.kappa_over_nu / FLATTEST
    like = contact_parameters(FLATTEST, p.alpha, p.psi / flatter**2, p.chi / flatter, axial=p.axial * flatter)
    second = second_order(like)
    return second.lambda2 / like.lambda0 * p.lambda0, second.r2 / like.r0 * p.r0, second.opening


def _tension_leads(solved: ContactParameters) -> bool:
    """Whether the axial force changes λ and r more than the loads do."""

    def change(lambda1: float, r1: float) -> float:
        return abs(r1) / solved.r0 + (abs(lambda1) / solved.lambda0 if solved.lambda0 > 0.0 else 0.0)

    if solved.axial == 0.0:
        return False
    alone = contact_parameters(solved.kappa_over_nu, solved.alpha, solved.psi, solved.chi)
    return change(solved.lambda1 - alone.lambda1, solved.r1 - alone.r1) >= change(alone.lambda1, alone.r1)


def _slope(solved: ContactParameters) -> float:
    """Largest slope that the impact adds, |η_ξ|/√τ; a slope in the fast layer is one of the beam."""
    start, stop = float(solved.lambda0), float(peak_moment_of(solved).place)
    return float(np.max(np.abs(SelfSimilarWave(solved).slope(np.linspace(start, stop, 65)))))
