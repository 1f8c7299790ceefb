r"""Until when the theory of the first instants holds for a real beam, and what ends it.

Waves that have been at the ends are measured on the whole beam (`ends.json`), the second order in the loads and the
axial force is known (`theory.second_order`), the third is bounded by measurement, and the beam's own damping η acts on
a zone at early times, without a closed form. With their relative errors of half length, force and impulse

    e(t) = tol·(t/t_ends)² + max(|λ₂|τ²/λ, |r₂|τ²/r) + 0.1 x³,   x = max(|λ₁|τ/λ₀, |r₁|τ/r₀),   d(t) = tol·t_η/t,

the theory holds while √(e² + d²) ≤ tol = 2 %, d being independent of the rest. The square in e: on the damped beam
what comes from the ends grows faster. t_η is measured: 7η at κ/ν = 0.5, but hundreds of η below 0.3, where what
damping does to the first instant stays in the impulse.
0.1x³: on the self-similar path the error of first order exceeds the second by at most 0.09x³ for a load α at
κ/ν = 0.05 … 0.8, both regimes (docs/theory.md). ε is not in it: the leading order is exact at any ε until the ends are
felt.

Beyond these: slope (an arch is lower than its parabola by θ²/12, 2 % at θ = 0.49), shear (a Timoshenko beam starts
otherwise: a zone's force is within 1 % after 10 t_s, one point's within 4 %, t_s = √(EIμ)/(κ_sGA)), and a section that
yields.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from bent_beam.impact import Impact
from theory._fresnel import FloatArray
from theory.contact import DISCRETE, ContactParameters, contact_parameters
from theory.moment import peak_moment_of
from theory.second_order import second_order
from theory.similarity import SelfSimilarWave

#: Made anew by whoever measures the whole beam: κ/ν ascending, t/T* of the same length, and the tolerance.
DATA = Path(__file__).with_name("ends.json")
#: Bound of the third order over x³.
THIRD_ORDER = 0.1
#: λ₀ of the flattest contact for which r₂ keeps a digit (5 % off there, thirty times at ten times that); beyond it x²,
#: which is more, stands for both.
FLATTEST = 1e4
#: Slope at which an arch is 2 % lower than its parabola, θ²/12.
SLOPE_LIMIT = math.sqrt(12.0 * 0.02)
#: Shear times t_s after which Euler and Bernoulli's beam is within the tolerance, for a zone and for one point.
SHEAR_TIMES = {"zone": 10.0, "point": 20.0}

ENDS = "waves back from the ends"
FIRST_ORDER = "first-order correction"
TENSION = "tension"
DAMPING = "damping"
SLOPE = "slope"
SHEAR = "shear"
SECTION = "section"


@dataclass(frozen=True)
class Validity:
    """The theory holds for `begins` ≤ t ≤ `until` (s); `limited_by` names what ends it. Never valid: until = 0."""

    begins: float
    until: float
    limited_by: str

    def holds(self, time: float) -> bool:
        """Whether the theory holds at `time` (s)."""
        return self.until > 0.0 and self.begins <= time <= self.until


@cache
def _table() -> dict[str, Any]:
    return dict(json.loads(DATA.read_text(encoding="utf-8")))


def ends_limit(kappa_over_nu: float, damping: float = 0.0) -> float:
    """t/T* until which waves from the ends change the leading order by less than the tolerance, at η/T* = `damping`.

    Between the measured κ/ν log t is interpolated in κ/ν, from the last on it is constant, and below the first it
    falls like 1/λ₀², as the time at which the contact itself reaches the ends. Damping kills the short waves, which
    are the first to come back: a factor, interpolated in logarithms.
    """
    table = _table()
    ratios, times = np.array(table["kappa_over_nu"]), np.array(table["time"])
    known = np.array(table["damping"])
    at = np.log(max(damping, float(known[0])))
    factor = float(np.exp(np.interp(at, np.log(known), np.log(table["factor"]))))
    if kappa_over_nu < ratios[0]:
        first, here = contact_parameters(float(ratios[0])), contact_parameters(kappa_over_nu)
        return factor * float(times[0] * (first.lambda0 / here.lambda0) ** 2)
    return factor * float(np.exp(np.interp(kappa_over_nu, ratios, np.log(times))))


def zone_damping_times(kappa_over_nu: float) -> float:
    """t/η from which the beam's own damping changes a contact zone by less than the tolerance."""
    table = _table()
    return float(np.exp(np.interp(kappa_over_nu, table["kappa_over_nu"], np.log(table["zone_damping_times"]))))


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
    tolerance = float(_table()["tolerance"])
    unit = impact.slow_time_scale / impact.time_scale
    ends = ends_limit(solved.kappa_over_nu, impact.relative_damping) * unit
    start = zone_damping_times(solved.kappa_over_nu) * impact.damping / impact.time_scale
    if solved.regime == DISCRETE:
        start = 0.0  # one point's damping is in the prediction
    loads = _Loads(solved)
    tau = np.concatenate([ends * np.geomspace(1e-3, 1.0, 2000), loads.scale * np.geomspace(1e-6, 1.0, 4000)])
    tau = np.sort(tau[(tau > 0.0) & (tau <= ends)])
    from_ends, from_loads = tolerance * (tau / ends) ** 2, loads.error(tau)
    good = np.hypot(from_ends + from_loads, tolerance * start / tau) <= tolerance
    if not np.any(good):
        return Validity(0.0, 0.0, DAMPING)
    first = int(np.argmax(good))
    last = first + int(np.argmin(good[first:])) - 1 if not np.all(good[first:]) else tau.size - 1
    begins, until, limited_by = float(tau[first]) if start > 0.0 else 0.0, float(tau[last]), ENDS
    if from_loads[last] > from_ends[last]:
        limited_by = TENSION if _tension_leads(solved) else FIRST_ORDER
    steep = _slope(solved)
    if steep > 0.0 and (SLOPE_LIMIT / steep) ** 2 < until:
        until, limited_by = (SLOPE_LIMIT / steep) ** 2, SLOPE
        if begins >= until:
            begins, until = 0.0, 0.0
    begins, until = begins * impact.time_scale, until * impact.time_scale
    if shear_stiffness is not None:
        shear_time = math.sqrt(impact.bending_stiffness * impact.mass_per_length) / shear_stiffness
        begins = max(begins, SHEAR_TIMES["point" if solved.regime == DISCRETE else "zone"] * shear_time)
        if begins >= until:
            begins, until, limited_by = 0.0, 0.0, SHEAR
    if yields:
        begins, until, limited_by = 0.0, 0.0, SECTION
    return Validity(begins, until, limited_by)


class _Loads:
    """Relative error of first order; homogeneous in loads times τ, so that loads of order one are solved for."""

    def __init__(self, solved: ContactParameters) -> None:
        self.size = max(abs(solved.alpha), abs(solved.psi), abs(solved.chi), abs(solved.axial))
        self.exact = self.size == 0.0 or (solved.regime == DISCRETE and solved.axial == 0.0)  # a linear problem
        self.scale = 0.0
        if self.exact:
            return
        alpha, psi, chi, axial = (v / self.size for v in (solved.alpha, solved.psi, solved.chi, solved.axial))
        self.unit = p = contact_parameters(solved.kappa_over_nu, alpha, psi, chi, axial=axial)
        spreads = p.lambda0 > 0.0
        self.change = max(abs(p.r1) / p.r0, abs(p.lambda1) / p.lambda0 if spreads else 0.0)
        if p.lambda0 < FLATTEST:
            second = second_order(p)
            self.lambda2, self.r2 = abs(second.lambda2), abs(second.r2)
        else:
            self.lambda2, self.r2 = self.change**2 * p.lambda0, self.change**2 * p.r0
        square = max(self.r2 / p.r0, self.lambda2 / p.lambda0 if spreads else 0.0)
        # τ at which a first or second order is as large as the leading one
        fastest = max(self.change, math.sqrt(square))
        self.scale = 1.0 / (fastest * self.size) if fastest > 0.0 else 0.0

    def error(self, tau: FloatArray) -> FloatArray:
        """At τ, shape (n,); infinite once λ or r has changed sign."""
        if self.exact:
            return np.zeros_like(tau)
        p, at = self.unit, self.size * tau
        push = p.r0 + p.r1 * at
        spread = p.lambda0 + p.lambda1 * at
        force = push + np.sqrt(np.pi / 2.0) * at * spread * p.uniform_reaction
        with np.errstate(all="ignore"):
            error = np.where(push > 0.0, self.r2 * at**2 / np.abs(force), np.inf)
            if p.lambda0 > 0.0:
                error = np.maximum(error, np.where(spread > 0.0, self.lambda2 * at**2 / np.abs(spread), np.inf))
            error = error + THIRD_ORDER * (self.change * at) ** 3
        return np.where(np.isnan(error), np.inf, error)


def _tension_leads(solved: ContactParameters) -> bool:
    """Whether the axial force changes λ and r more than the loads do."""

    def change(lambda1: float, r1: float) -> float:
        return abs(r1) / solved.r0 + (abs(lambda1) / solved.lambda0 if solved.lambda0 > 0.0 else 0.0)

    if solved.axial == 0.0:
        return False
    still = replace(solved, alpha=0.0)
    alone = contact_parameters(still.kappa_over_nu, solved.alpha, solved.psi, solved.chi)
    return change(solved.lambda1 - alone.lambda1, solved.r1 - alone.r1) >= change(alone.lambda1, alone.r1)


def _slope(solved: ContactParameters) -> float:
    """Largest slope that the impact adds, |η_ξ|/√τ; a slope in the fast layer is one of the beam."""
    start, stop = float(solved.lambda0), float(peak_moment_of(solved).place)
    return float(np.max(np.abs(SelfSimilarWave(solved).slope(np.linspace(start, stop, 65)))))
