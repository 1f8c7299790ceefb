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

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import ImpactHistory

__all__ = [
    "Estimate",
    "FirstOrderEstimate",
    "LeadingEstimate",
    "Moments",
    "first_order",
    "last_tenth",
    "leading_order",
    "local_front",
    "moments",
    "one_side",
    "with_companions",
]

Array = NDArray[np.float64]
SIDE = math.sqrt(2.0 / math.pi)
FLOOR = 2e-3  # of a first-order value: what halving mesh and steps moves it by
# The error bar, held against 200 methods drawn at random (comparison/error_bars.py, make verify):
LEAST = 1e-4  # of a leading-order value: what runs keep that no refinement moves any more
COMPANION = 1.2  # first order in Δx: the coarser run is as far from this one as this one from the truth
DRIFT = 2.0  # of the spread over the window and its parts
DRIFT_ALONE = 4.0  # the same where no companion says what the mesh does
LIFTED = 0.1  # of V₀t: a larger lift counts whole, a smaller one in proportion to itself


@dataclass(frozen=True)
class Estimate:
    """A number and its error bar (about two standard deviations, systematic part included)."""

    value: float
    error: float

    def __format__(self, spec: str) -> str:
        return f"{self.value:{spec or '.6g'}} ± {self.error:.1g}"


@dataclass(frozen=True)
class LeadingEstimate:
    """λ₀ and r₀ with ν = 1; ``lift`` is the largest lift inside the zone over V₀t; ``window`` the fitted times (τ)."""

    lambda0: Estimate
    r0: Estimate
    lift: float
    window: tuple[float, float]


@dataclass(frozen=True)
class FirstOrderEstimate:
    """λ₁ and r₁ for ν = 1 and the (α, ψ, χ) asked for, the ε of the runs, and the uniform reaction over ε."""

    lambda1: Estimate
    r1: Estimate
    uniform_reaction: float
    epsilons: tuple[float, ...]
    window: tuple[float, float]


@dataclass(frozen=True)
class Moments:
    """A history reduced to what the estimators need, in fast-layer units, each of shape (times,).

    tau; impulse I(τ) and first moment J(τ) of one side's concentrated reaction; pressure p(τ), the uniform reaction;
    front λ_c(τ); lift, the largest gap inside nine tenths of the contact zone over V₀t.
    """

    tau: Array
    impulse: Array
    moment: Array
    pressure: Array
    front: Array
    lift: Array


# --- reading a history -------------------------------------------------------------------------------------------


def one_side(history: ImpactHistory) -> tuple[Array, Array]:
    """Total impulse of one side (N s) and its first moment (N s m) at the saved instants."""
    total = history.array("total_impulse") / 2.0
    if "impulse_moment" in history:
        return total, history.array("impulse_moment")
    if "contact_position" in history:  # each contact point gathers on its way: what it got is taken halfway
        impulse = history.array("impulse")
        places = np.abs(np.stack([history.contact_positions(k) for k in range(history.time.size)]))
        pushes = np.diff(impulse, axis=0, prepend=0.0 * impulse[:1])
        moment = np.cumsum((pushes * 0.5 * (places + np.concatenate([places[:1], places[:-1]]))).sum(axis=1))
    else:
        places = np.abs(history.contact_positions(0))
        moment = np.concatenate([part @ places for part in history.blocks("impulse")])
    return total, moment / history.sides


ZONE = 0.7  # of the front, within which the uniform reaction is read off


def _outwards(history: ImpactHistory) -> Iterator[tuple[Array, Array, Array]]:
    """Of each interval between saved instants, contact points from the centre outwards: place (m), impulse gathered up
    to there on one side (N s), and length that is the point's own (m)."""
    moving = "contact_position" in history
    before = history.array("impulse", 0)
    for k in range(1, history.time.size):
        if moving or k == 1:  # a moving contact point has gathered its impulse on the way: take its place halfway
            places = np.abs(0.5 * (history.contact_positions(k - 1) + history.contact_positions(k)))
            order = np.argsort(places)
            places = places[order]
            own = np.gradient(places) if places.size > 1 else np.zeros(places.size)
        impulse = history.array("impulse", k)
        gathered = (impulse - before)[order] / history.sides
        before = impulse
        upto = np.cumsum(gathered) - 0.5 * gathered
        upto[places == 0.0] = 0.0  # the centre carries for one side of it
        yield places, upto, own


def _pressure(time: Array, outwards: Iterable[tuple[Array, Array, Array]], front: Array) -> Array:
    """Uniform reaction (N/m) over each interval: the slope of the impulse gathered from the centre outwards, by least
    squares over the contact points within :data:`ZONE` of the front.

    Few of these may carry the load at a time, each for its neighbours: a sum over them, divided by the length between
    the outermost, is off by what one of them carries; the slope hardly feels it.
    """
    found = np.zeros(time.size)
    for k, (places, upto, own) in enumerate(outwards, 1):
        inside = places < ZONE * front[k]
        if inside.sum() < 3:
            continue
        share = own[inside]
        off = places[inside] - np.average(places[inside], weights=share)
        found[k] = (share * off) @ upto[inside] / ((share * off) @ off) / (time[k] - time[k - 1])
    return found


def moments(history: ImpactHistory, *, uniform: bool | None = None) -> Moments:
    """Concentrated impulse and first moment of one side. ``uniform``: a uniform reaction may act and is taken out
    (``None``: where something presses the zone)."""
    impact = history.impact
    uniform = impact.zone_pressure > 0.0 if uniform is None else uniform
    total, moment = one_side(history)
    time = history.time
    step = np.diff(time, prepend=time[0])
    pressure = np.zeros(time.size)
    front = np.zeros(time.size)
    force, torque = np.diff(total, prepend=total[0]), np.diff(moment, prepend=moment[0])
    carrying = np.maximum.accumulate(np.maximum(total, 0.0)) > 0.0
    front[1:] = np.where(force[1:] > 0.0, torque[1:] / np.where(force[1:] > 0.0, force[1:], 1.0), 0.0)
    front = np.where(carrying, np.clip(front, 0.0, None), 0.0)
    if uniform:
        kept = list(_outwards(history)) if history.file is None else None  # of one on disk they are read again
        for _ in range(6):  # the front and the part of the uniform reaction depend on each other: contracts fast
            pressure = _smooth(time, _pressure(time, _outwards(history) if kept is None else kept, front))
            part, turn = pressure * front * step, pressure * front**2 / 2.0 * step
            left = force - part
            front = np.where(left > 0.0, (torque - turn) / np.where(left > 0.0, left, 1.0), front)
            front = np.clip(front, 0.0, None)
        total = np.cumsum(force - pressure * front * step) + total[0]
        moment = np.cumsum(torque - pressure * front**2 / 2.0 * step) + moment[0]
    unit = impact.mass_per_length * impact.length_scale * impact.velocity
    # the centroid so far is the mean over an interval, that is of √t: carry it to the interval's end
    before = np.sqrt(np.concatenate([time[:1], time[:-1]]))
    front = front * np.sqrt(time) / np.where(time > 0.0, 0.5 * (np.sqrt(time) + before), 1.0)
    return Moments(
        tau=time / impact.time_scale,
        impulse=total / unit,
        moment=moment / (unit * impact.length_scale),
        pressure=pressure / (unit / impact.length_scale / impact.time_scale),
        front=front / impact.length_scale,
        lift=_lift(history),
    )


def _smooth(time: Array, values: Array) -> Array:
    """Running average over the times from a quarter of each to as much beyond: the uniform reaction is steady, its
    measurement is not."""
    out = values.copy()
    gathered = np.concatenate([[0.0], np.cumsum(values[1:] * np.diff(time))])
    for k in range(1, time.size):
        first = int(np.searchsorted(time, 0.25 * time[k]))
        last = min(int(np.searchsorted(time, 1.75 * time[k])), time.size - 1)
        if last > first:
            out[k] = (gathered[last] - gathered[first]) / (time[last] - time[first])
    return out


# --- least squares with a scatter that is not white ---------------------------------------------------------------


def _fit(tau: Array, values: Array, powers: Sequence[float], weight_power: float) -> Array:
    """Coefficients of Σ c_p τ^p (+ an offset, which takes the start's error), rows weighted by τ^−weight_power."""
    weight = tau**-weight_power
    columns = [np.ones_like(tau), *(tau**p for p in powers)]
    scale = np.array([np.linalg.norm(c * weight) for c in columns])
    matrix = np.stack([c * weight / s for c, s in zip(columns, scale)], axis=1)
    solution, *_ = np.linalg.lstsq(matrix, values * weight, rcond=None)
    return np.asarray(solution / scale)[1:]


def _spread(values: Sequence[float]) -> float:
    return float(max(values) - min(values)) if len(values) else 0.0


# --- leading order ---------------------------------------------------------------------------------------------


def leading_order(found: Moments, *, window: float = 10.0, companions: Sequence[Moments] = ()) -> LeadingEstimate:
    """λ₀ and r₀ from the last factor ``window`` of time of one run at ε = 0.

    companions : the same run with elements and steps twice as long (and, for thorough bars, twice as short). What mesh,
    steps and start do to the answer falls at least like Δx, so that the difference from the coarser run is the size of
    the error; without companions only the drift over the window measures it.

    The error bar is the root of the sum of squares, for the causes are independent, of the drift (spread over the
    window and its parts) taken ``DRIFT`` times, of the largest difference from a companion taken ``COMPANION`` times,
    of ``LEAST`` of the value and, for r₀, of the lift over V₀t, times lift/``LIFTED`` where that is less than 1:
    impacts that throw the zone off the wall push it too hard, in the coarser run just as much. With Exudyn at κ/ν from
    1/800 to 1/25 r₀ was 22, 21, 14, 6.5, 2.3 and 0.6 % too large where the zone lifted by 0.2, 0.2, 0.2, 0.07, 0.03 and
    0.01 V₀t.

    Raises ``ValueError`` when fewer than eight instants carry an impulse.
    """
    r0, lambda0, drift_r0, drift_lambda0, lift, times = _leading_values(found, window)
    apart_r0 = apart_lambda0 = 0.0
    for companion in companions:
        other_r0, other_lambda0, *_ = _leading_values(companion, window)
        apart_r0 = max(apart_r0, abs(other_r0 - r0))
        apart_lambda0 = max(apart_lambda0, abs(other_lambda0 - lambda0))
    alone = DRIFT if companions else DRIFT_ALONE
    return LeadingEstimate(
        lambda0=Estimate(
            lambda0, math.hypot(COMPANION * apart_lambda0, alone * drift_lambda0, LEAST * max(lambda0, 0.1))
        ),
        r0=Estimate(
            r0, math.hypot(COMPANION * apart_r0, alone * drift_r0, LEAST * r0, min(lift / LIFTED, 1.0) * lift * r0)
        ),
        lift=lift,
        window=times,
    )


def _leading_values(found: Moments, window: float) -> tuple[float, float, float, float, float, tuple[float, float]]:
    """r₀, λ₀, their drift over the window, the largest lift in it, and its ends."""
    tau, last = found.tau, found.tau[-1]
    inside = (tau >= last / window * (1 - 1e-9)) & (tau > 0.0) & (found.impulse > 0.0)
    if inside.sum() < 8:
        raise ValueError(f"history must hold at least 8 instants with contact in the last factor {window:g} of time")

    def values(low: float, high: float) -> tuple[float, float]:
        part = inside & (tau >= low * (1 - 1e-9)) & (tau <= high * (1 + 1e-9))
        r0 = _fit(tau[part], found.impulse[part], (0.5,), 0.25)[0] / (2.0 * SIDE)
        product = _fit(tau[part], found.moment[part], (1.0,), 0.5)[0] / SIDE
        return r0, max(product / r0, 0.0)

    r0, lambda0 = values(last / window, last)
    cuts = [(last / window, last / window**0.4), (last / window**0.7, last / window**0.2), (last / window**0.5, last)]
    usable = [c for c in cuts if (inside & (tau >= c[0]) & (tau <= c[1])).sum() >= 6]
    others = [(r0, lambda0), *(values(*c) for c in usable)]
    return (
        r0,
        lambda0,
        _spread([o[0] for o in others]),
        _spread([o[1] for o in others]),
        float(found.lift[inside].max()),
        (float(tau[inside][0]), float(last)),
    )


def _lift(history: ImpactHistory) -> Array:
    """Largest gap inside nine tenths of the contact zone over V₀t at the saved instants (0 without a zone)."""
    front = local_front(history.time, *one_side(history))
    lift = np.zeros(history.time.size)
    for k, t in enumerate(history.time):
        inside = np.abs(history.positions(k)) <= 0.9 * front[k]
        if t > 0.0 and inside.any():
            lift[k] = max(0.0, float(history.array("gap", k)[inside].max())) / (history.impact.velocity * t)
    return lift


def local_front(time: Array, impulse: Array, moment: Array) -> Array:
    """λ_c at the instants ``time`` from one side's ``impulse`` and its first ``moment``, all of shape (times,), in the
    unit of moment/impulse: the centroid of what was gathered over the last tenth of each instant's time.

    That lies where the front was at the mean of √t, and is carried to the instant: exact for λ_c ~ √t.
    """
    front = np.zeros(time.size)
    for k in range(1, time.size):
        j = last_tenth(time, k)
        if impulse[k] > impulse[j]:
            roots = np.sqrt(time[[j, k]])
            centroid = (moment[k] - moment[j]) / (impulse[k] - impulse[j])
            front[k] = max(centroid * roots[1] / roots.mean(), 0.0)
    return front


def last_tenth(time: Array, k: int) -> int:
    """The saved instant at which the last tenth of the time of instant ``k`` begins."""
    return max(0, min(int(np.searchsorted(time, 0.9 * time[k])), k - 1))


# --- first order -----------------------------------------------------------------------------------------------


def _same_times(run: Moments, base: Moments) -> None:
    if run.tau.size != base.tau.size or not np.allclose(run.tau, base.tau, rtol=1e-9, atol=0.0):
        raise ValueError("the runs at ε and at ε = 0 must be saved at the same times (same mesh, steps and end time)")


def first_order(
    runs: Sequence[tuple[float, Moments]], base: Moments, leading: LeadingEstimate, *, window: float = 8.0
) -> FirstOrderEstimate:
    """λ₁ and r₁ from runs at several ε (their α, ψ, χ in one ratio) against ``base`` at ε = 0 on the same mesh.

    runs : (ε, moments taken with ``uniform=True``), ε of the asked-for (α, ψ, χ): the run's εα is ε·α and so on.

    Each run gives polynomials in δ = ετ; all runs are fitted together, so ε → 0 is reached by the terms in δ², δ³. The
    error bar is the spread over degrees, windows and single runs. Raises ``ValueError`` without runs or when saved
    times differ.
    """
    if not runs:
        raise ValueError("runs must hold at least one run at ε > 0")
    r0, lambda0 = leading.r0.value, leading.lambda0.value
    rows = []
    for epsilon, run in runs:
        _same_times(run, base)
        rows.append((epsilon, run.tau, (run.impulse - base.impulse) / SIDE, (run.moment - base.moment) / SIDE, run))

    def solve(chosen: Sequence[int], degree: int, cut: tuple[float, float]) -> tuple[float, float]:
        # δ = ετ collapses all runs: √ε·ΔI and ε·ΔJ are functions of δ alone, with an offset a run
        blocks_i, blocks_j, right_i, right_j = [], [], [], []
        for place, c in enumerate(chosen):
            epsilon, tau, impulse, moment, _ = rows[c]
            inside = (tau >= tau[-1] / cut[0] * (1 - 1e-9)) & (tau <= tau[-1] / cut[1] * (1 + 1e-9))
            d = epsilon * tau[inside]
            offset = np.zeros((d.size, len(chosen)))
            offset[:, place] = 1.0
            wi, wj = d**-1.5, d**-2.0
            blocks_i.append(
                np.column_stack([offset * wi[:, None], *((d ** (n + 0.5)) * wi for n in range(1, degree + 1))])
            )
            blocks_j.append(
                np.column_stack([offset * wj[:, None], *((d ** (n + 1.0)) * wj for n in range(1, degree + 1))])
            )
            right_i.append(math.sqrt(epsilon) * impulse[inside] * wi)
            right_j.append(epsilon * moment[inside] * wj)
        ci = _lstsq(np.concatenate(blocks_i), np.concatenate(right_i))[len(chosen)]
        cj = _lstsq(np.concatenate(blocks_j), np.concatenate(right_j))[len(chosen)]
        r1 = 1.5 * ci
        return r1, (2.0 * cj - r1 * lambda0) / r0

    every = list(range(len(rows)))
    best = solve(every, 2, (window, 1.0))
    variants = [
        best,
        solve(every, 3, (window, 1.0)),
        solve(every, 2, (window / 2.0, 1.0)),
        solve(every, 2, (2 * window, 1.2)),
    ]
    if len(rows) > 1:
        variants += [solve([i], 2, (window, 1.0)) for i in every]
    tail = rows[-1][4]
    late = tail.tau >= tail.tau[-1] / window
    pressure = float(np.mean(tail.pressure[late])) / rows[-1][0]
    # What the base leaves uncertain, 0.2 % for steps and mesh, and a uniform reaction that is not yet steady: taken
    # out of the impulse wrongly by dp, it moves r₁ by dp λ₀/√(2/π), and λ₁ by about half of that times λ₀/r₀.
    inherited = abs(best[0]) * leading.lambda0.error / r0 + abs(best[1]) * leading.r0.error / r0
    unsteady = float(np.std(tail.pressure[late])) / rows[-1][0] * lambda0 / SIDE
    return FirstOrderEstimate(
        lambda1=Estimate(
            best[1],
            _spread([v[1] for v in variants])
            + inherited
            + 0.5 * unsteady * lambda0 / r0
            + FLOOR * max(abs(best[1]), 1.0),
        ),
        r1=Estimate(best[0], _spread([v[0] for v in variants]) + unsteady + FLOOR * max(abs(best[0]), 1.0)),
        uniform_reaction=pressure,
        epsilons=tuple(row[0] for row in rows),
        window=(float(tail.tau[late][0]), float(tail.tau[-1])),
    )


def with_companions(found: FirstOrderEstimate, companions: Sequence[FirstOrderEstimate]) -> FirstOrderEstimate:
    """``found`` with error bars that hold its largest difference from companion runs at other resolutions."""

    def widened(number: Estimate, others: Sequence[Estimate]) -> Estimate:
        apart = max((abs(o.value - number.value) for o in others), default=0.0)
        return Estimate(number.value, number.error + COMPANION * apart)

    return dataclasses.replace(
        found,
        lambda1=widened(found.lambda1, [c.lambda1 for c in companions]),
        r1=widened(found.r1, [c.r1 for c in companions]),
    )


def _lstsq(matrix: Array, right: Array) -> Array:
    scale = np.linalg.norm(matrix, axis=0)
    scale[scale == 0.0] = 1.0
    solution, *_ = np.linalg.lstsq(matrix / scale, right, rcond=None)
    return np.asarray(solution / scale)
