"""λ₀, r₀, λ₁, r₁ from a history, with error bars.

In the units of the fast layer one end of the contact carries F(τ) = √(2/π)(r₀ + εr₁τ)/√τ at λ_c = √τ(λ₀ + ελ₁τ), and
the zone behind it a uniform reaction p. Forces are never filtered: impulses are fitted, whose noise does not
accumulate,

    I(τ) = ∫F dτ   = √(2/π) [2 r₀ τ^{1/2} + (2/3) ε r₁ τ^{3/2} + …]                             (one side)
    J(τ) = ∫F λ_c dτ = √(2/π) [r₀λ₀ τ + (r₀λ₁ + r₁λ₀) ετ²/2 + …]                                (its first moment)

after what the uniform reaction adds, ∫pλ_c dτ and ∫pλ_c²/2 dτ, with p as measured well inside the zone, is taken out.
First order: the same of the difference between a run at ε and one at ε = 0 on the same mesh and steps, so that what
both share, the start above all, drops out.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import Array
from bent_beam.measure.moments import Moments
from bent_beam.measure.numbers import FACTOR, Number, number_of

__all__ = ["FirstOrderEstimate", "LeadingEstimate", "first_order", "leading_order", "lift_shares"]

SIDE = math.sqrt(2.0 / math.pi)
FLOOR = 2e-3  # of the larger of λ₁ and r₁: what halving mesh and steps moves them by
# What no companion shows, held against methods drawn at random (benchmarks/coverage.py, make coverage):
LEAST_LEADING = 1e-4  # of a leading-order value: what runs keep that no refinement moves any more
DRIFT_ALONE = 4.0  # of the spread over the window and its parts, where no companion says what the mesh does
LIFTED = 0.1  # of V₀t: a larger lift counts whole, a smaller one in proportion to itself
INSIDE = 0.5  # relative error of λ₀ over that of r₀, by a lift: such pushes act anywhere behind the front
STUCK_FIRST = 0.4  # … of a load that should lift the zone and does not: springs push on, or no node is there
LIFTED_FIRST = 2.0  # of what the lift does to r₀ and λ₀: a load moves the front of a lifted zone differently
LIFTED_MORE, UNDER_LIFT = 0.01, 10.0  # under a load that lifts, a share UNDER_LIFT (lift/V₀t − LIFTED_MORE) is added:
# velocity-level laws at κ/ν = 0.055 and 0.075 lift it by 0.03, and r₁ is 40 and 23 % off
HITS_FIRST = 3.0  # times what a load that lifts the zone changes of hits inside it: they also act closer to the front
MISSING_FIRST = 2.5  # of the zone's length times what its uniform reaction lacks: a zone off the wall moves the front


@dataclass(frozen=True)
class LeadingEstimate:
    """λ₀ and r₀ with ν = 1; ``lift`` is the largest lift inside the zone over V₀t; ``window`` the fitted times (τ)."""

    lambda0: Number
    r0: Number
    lift: float
    window: tuple[float, float]

    @property
    def front(self) -> float:
        """λ₀, or 0 where it does not exceed its error bar: the run then shows a contact in one point."""
        return self.lambda0.known if self.lambda0.known > self.lambda0.spread else 0.0


@dataclass(frozen=True)
class FirstOrderEstimate:
    """λ₁ and r₁ for ν = 1 and the (α, ψ, χ) asked for, the ε of the runs, and the uniform reaction over ε."""

    lambda1: Number
    r1: Number
    uniform_reaction: float
    epsilons: tuple[float, ...]
    window: tuple[float, float]


def _fit(tau: Array, values: Array, power: float, weight_power: float) -> float:
    """c of c τ^power (+ an offset, which takes the start's error), rows weighted by τ^−weight_power."""
    weight = tau**-weight_power
    return float(_lstsq(np.stack([weight, tau**power * weight], axis=1), values * weight)[1])


def _lstsq(matrix: Array, right: Array) -> Array:
    scale = np.linalg.norm(matrix, axis=0)
    scale[scale == 0.0] = 1.0
    solution, *_ = np.linalg.lstsq(matrix / scale, right, rcond=None)
    return np.asarray(solution / scale)


def _numbers(best: Array, companions: Sequence[Array], known: Mapping[str, Array]) -> list[Number]:
    """The values with their bars. companions : the values at other resolutions, of which the farthest counts; known :
    cause → sizes, one for each value."""
    others = np.array(companions or [best])
    other = others[np.abs(others - best).argmax(axis=0), np.arange(best.size)]
    parts = [{cause: float(sizes[i]) for cause, sizes in known.items()} for i in range(best.size)]
    return [number_of(float(best[i]), {"mesh_and_step": float(other[i])}, parts[i]) for i in range(best.size)]


def leading_order(
    found: Moments, *, window: float = 10.0, companions: Sequence[Moments] = (), unresolved: float = 0.0
) -> LeadingEstimate:
    """λ₀ and r₀ from the last factor ``window`` of time of one run at ε = 0.

    unresolved : l*, :func:`bent_beam.measure.moments.unresolved_at_end`; λ₀ is no surer than that over √τ.
    companions : the same run with elements and steps twice as long (and, for thorough bars, twice as short). What mesh,
    steps and start do to the answer falls at least like Δx, so that the difference from the coarser run is the size of
    the error; without companions only the drift over the window measures it.

    The bar (:func:`bent_beam.measure.numbers.number_of`) holds the largest difference from a companion, the drift
    (spread over the window and its parts), ``LEAST_LEADING`` of the value and the shares of :func:`lift_shares`.

    Raises ``ValueError`` when fewer than eight instants carry an impulse.

    >>> from bent_beam import Impact
    >>> from bent_beam.measure.estimators import leading_order
    >>> from bent_beam.measure.moments import moments
    >>> from self_similar_fe import SelfSimilarFE
    >>> found = leading_order(moments(SelfSimilarFE().simulate(Impact.dimensionless(0.5), end_time=0.1)))
    >>> bool(abs(found.lambda0.value - 1.018866) < 1e-3)
    True
    """
    best, drift, lift, times = _leading_values(found, window)
    known = {
        "drift": (FACTOR if companions else DRIFT_ALONE) * drift,
        "least": LEAST_LEADING * np.maximum(best, [0.0, 0.1]),
        "element": np.array([0.0, unresolved / math.sqrt(times[1])]),
        "lift": np.array(lift_shares(lift)) * best,
    }
    r0, lambda0 = _numbers(best, [_leading_values(companion, window)[0] for companion in companions], known)
    return LeadingEstimate(lambda0, r0, lift, times)


def lift_shares(lift: float) -> tuple[float, float]:
    """What a zone that its scheme has thrown off the wall by ``lift`` V₀t may be off by: shares of the push, r₀, and of
    its place, λ₀. The impacts that throw it off push it too hard, in a coarser run just as much.

    With Exudyn at κ/ν from 1/800 to 1/25 r₀ was 22, 21, 14, 6.5, 2.3 and 0.6 % too large where the zone lifted by 0.2,
    0.2, 0.2, 0.07, 0.03 and 0.01 V₀t. Velocity-level laws at κ/ν = 0.06 lift it by 0.03 to 0.14 V₀t, r₀ is 0.4 to 2.2 %
    too large and λ₀ 0.14 to 0.7 % too small."""
    lifted = min(lift / LIFTED, 1.0) * lift
    return lifted, INSIDE * lifted


def _leading_values(found: Moments, window: float) -> tuple[Array, Array, float, tuple[float, float]]:
    """r₀ and λ₀, their drift over the window, the largest lift in it, and its ends."""
    tau, last = found.tau, found.tau[-1]
    inside = (tau >= last / window * (1 - 1e-9)) & (tau > 0.0) & (found.impulse > 0.0)
    if inside.sum() < 8:
        raise ValueError(f"history must hold at least 8 instants with contact in the last factor {window:g} of time")

    def values(low: float, high: float) -> Array:
        part = inside & (tau >= low * (1 - 1e-9)) & (tau <= high * (1 + 1e-9))
        r0 = _fit(tau[part], found.impulse[part], 0.5, 0.25) / (2.0 * SIDE)
        product = _fit(tau[part], found.moment[part], 1.0, 0.5) / SIDE
        return np.array([r0, max(product / r0, 0.0)])

    best = values(last / window, last)
    cuts = [(last / window, last / window**0.4), (last / window**0.7, last / window**0.2), (last / window**0.5, last)]
    usable = [c for c in cuts if (inside & (tau >= c[0]) & (tau <= c[1])).sum() >= 6]
    drift = np.ptp([best, *(values(*c) for c in usable)], axis=0)
    return best, drift, float(found.lift[inside].max()), (float(tau[inside][0]), float(last))


def first_order(
    runs: Sequence[tuple[float, Moments]],
    base: Moments,
    leading: LeadingEstimate,
    *,
    window: float = 8.0,
    pressure: float | None = None,
    companions: Sequence[FirstOrderEstimate] = (),
) -> FirstOrderEstimate:
    """λ₁ and r₁ from runs at several ε (their α, ψ, χ in one ratio) against ``base`` at ε = 0 on the same mesh.

    runs : (ε, moments taken with ``uniform=True``), ε of the asked-for (α, ψ, χ): the run's εα is ε·α and so on.
    pressure : what presses the zone, over ε, in the units of the moments; the zone's reaction tends to it once the load
        has closed what the start left open. Where it is negative the zone should lift. ``None``: its own mean.
    companions : what the same runs at other resolutions gave.

    Each run gives polynomials in δ = ετ; all runs are fitted together, so ε → 0 is reached by
    the term in δ². One in δ³ tells the bar.

    The bar is the sum of

    - the spread: the largest change by a further term, by half the window, or by one run alone, whose noise counts in
      proportion to its ε;
    - the largest difference from a companion;
    - ``MISSING_FIRST`` times what the uniform reaction lacks. That moves r₁ by λ₀/√(2/π) of itself at least, and λ₁ by
      about half of that times λ₀/r₀. A zone that should lift and does not lacks ``STUCK_FIRST`` of the load;
    - ``LIFTED_FIRST`` times the shares of :func:`lift_shares`, under a load that lifts the zone with ``UNDER_LIFT`` of
      what the lift is above ``LIFTED_MORE``; and ``HITS_FIRST`` times what such a load changes of hits inside the zone;
    - what λ₁ inherits from the bars of λ₀ and r₀; and ``FLOOR``.

    Raises ``ValueError`` without runs or when saved times differ.
    """
    if not runs:
        raise ValueError("runs must hold at least one run at ε > 0")
    r0, lambda0 = leading.r0.known, leading.front
    rows = []
    for epsilon, run in runs:
        if run.tau.size != base.tau.size or not np.allclose(run.tau, base.tau, rtol=1e-9, atol=0.0):
            raise ValueError(
                "the runs at ε and at ε = 0 must be saved at the same times (same mesh, steps and end time)"
            )
        rows.append((epsilon, run.tau, (run.impulse - base.impulse) / SIDE, (run.moment - base.moment) / SIDE))

    def solve(chosen: Sequence[int], degree: int, start: float) -> Array:
        """r₁ and λ₁, from I and J."""
        r1 = 1.5 * _coefficient([rows[c][:3] for c in chosen], 0.5, degree, start)
        product = _coefficient([(*rows[c][:2], rows[c][3]) for c in chosen], 1.0, degree, start)
        return np.array([r1, (2.0 * product - r1 * lambda0) / r0])

    every, largest = list(range(len(rows))), max(epsilon for epsilon, _ in runs)
    best = solve(every, 2, window)
    changes = [solve(every, 3, window) - best, solve(every, 2, window / 2.0) - best]
    changes += [(solve([i], 2, window) - best) * runs[i][0] / largest for i in every if len(rows) > 1]
    epsilon, tail = runs[-1]
    late = tail.tau >= tail.tau[-1] / window
    reaction, hits = tail.pressure[late] / epsilon, base.pressure[late] / epsilon
    lacks = _lacking(reaction, hits, pressure, tail.lift[late] == 0.0)
    missing = math.sqrt(float(np.mean(lacks**2))) * lambda0 / SIDE
    under_lift = UNDER_LIFT * max(leading.lift - LIFTED_MORE, 0.0) if (pressure or 0.0) < 0.0 else 0.0
    inherited = (abs(best[0]) * leading.lambda0.spread + abs(best[1]) * leading.r0.spread) / r0
    known = {
        "spread": FACTOR * np.abs(changes).max(axis=0),
        "uniform_reaction": MISSING_FIRST * missing * np.array([1.0, 0.5 * lambda0 / r0]),
        "lift": (LIFTED_FIRST * np.array(lift_shares(leading.lift)) + under_lift) * np.abs(best),
        "leading_order": np.array([0.0, inherited]),
        "least": np.full(2, FLOOR * np.abs(best).max()),
    }
    r1, lambda1 = _numbers(best, [np.array([c.r1.known, c.lambda1.known]) for c in companions], known)
    fitted = float(tail.tau[late][0]), float(tail.tau[-1])
    return FirstOrderEstimate(lambda1, r1, float(reaction.mean()), tuple(row[0] for row in rows), fitted)


def _lacking(reaction: Array, hits: Array, pressure: float | None, stuck: NDArray[np.bool_]) -> Array:
    """What a zone's uniform reaction, over ε, is off by. pressure : of :func:`first_order`; hits : the reaction of the
    run at ε = 0; stuck : where the zone lies on the wall."""
    if pressure is None:
        return np.abs(reaction - reaction.mean())
    if pressure >= 0.0:
        return np.abs(reaction - pressure)
    return HITS_FIRST * np.abs(reaction - hits) - STUCK_FIRST * pressure * stuck


def _coefficient(rows: Sequence[tuple[float, Array, Array]], power: float, degree: int, start: float) -> float:
    """c₁ of ε^p Δ = Σ c_n δ^(n + p), δ = ετ, p = ``power``, and an offset a run, to which all runs collapse: from ε, τ
    and Δ of each run, from the time τ_end/start on."""
    blocks, right = [], []
    for place, (epsilon, tau, change) in enumerate(rows):
        inside = tau >= tau[-1] / start * (1 - 1e-9)
        d = epsilon * tau[inside]
        weight = d ** -(1.0 + power)
        offset = np.zeros((d.size, len(rows)))
        offset[:, place] = 1.0
        columns = np.column_stack([offset, *(d ** (n + power) for n in range(1, degree + 1))])
        blocks.append(columns * weight[:, None])
        right.append(epsilon**power * change[inside] * weight)
    return float(_lstsq(np.concatenate(blocks), np.concatenate(right))[len(rows)])
