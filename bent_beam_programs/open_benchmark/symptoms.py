"""What is seen in a result: figures with their limits and where, from its own series and the problem's physics.

Each reading needs fields that a file may lack: then it cannot be told, and is said so. A figure beyond its limit is a
symptom. Symptoms stand in the order in which they explain one another: what breaks a law of mechanics before what may
follow from it. :mod:`.score` names the cause of the first where it has one alone.

At leading order the wall pushes at the front alone, so each length of wall that the front has passed has got the same
impulse; ahead, where no wave has come, the beam moves freely; and ∫μ(V₀ − v)dx = J, ∫μ(gap − free gap)dx = ∫J dt.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bent_beam_programs.open_benchmark.judgement import PART, Symptom
from bent_beam_programs.open_benchmark.problem import Problem
from bent_beam_programs.open_benchmark.result import Array, Result

NODES, GAPS = "node_x and node_impulse", "x, snap_tau and snap_gap"
AHEAD = 5.0  # √τ short of the far end, or 3 ahead of the front: hardly a wave has come there
STEEP = 0.5  # κ/ν, the least that an error of curvature is held against: waves ahead hide a smaller one
OWN = 0.5  # the share of J beyond which a fall is no pull
Seen = tuple[float, str] | tuple[float, str, float] | None  # figure, where, and a limit of its own


def _at(x: float, tau: float) -> str:
    return f"at x = {x:.3g}, τ = {tau:.3g}"


def _free(asked: Problem, x: Array, tau: float) -> tuple[Array, Array]:
    """Gap and velocity of the motion without a wall."""
    alpha, psi, chi, _ = (asked.epsilon * load for load in asked.loads)
    gap = asked.kappa_over_nu * x**2 / 2.0 - psi * x**4 / 24.0 - (1.0 + chi * x**2 / 2.0) * tau - alpha * tau**2 / 2.0
    return gap, 1.0 + chi * x**2 / 2.0 + alpha * tau


def _over_beam(x: Array, values: Array) -> float:
    """∫ over the whole beam, of which x may be a half."""
    return float(np.trapezoid(values, x)) * (1.0 if x[0] < -1e-9 * x[-1] else 2.0)


def last_push(result: Result, when: float, x: Array, gap: Array) -> tuple[Array, Array, float]:
    """What each contact point got in the last hundredth of the time, its gap, and how long that was."""
    assert result.node_x is not None and result.node_impulse is not None
    now, before = np.searchsorted(result.tau, [when * (1.0 + 1e-9), 0.99 * when]) - 1
    push = np.maximum(result.node_impulse[now] - result.node_impulse[before], 0.0)
    places = result.node_x if x[0] < -1e-9 * x[-1] else np.abs(result.node_x)
    return push, np.interp(places, x, gap), float(when - result.tau[before])


def _one_side(result: Result) -> tuple[Array, Array, float] | None:
    """Of one side: places x ≥ 0 of the contact points, their impulses at the end, and how far an even one would go."""
    if result.node_x is None or result.node_impulse is None:
        return None
    keep = np.flatnonzero(result.node_x >= -1e-9)
    keep = keep[np.argsort(result.node_x[keep])]
    x, impulse = np.abs(result.node_x[keep]), result.node_impulse[-1, keep].copy()
    if result.node_x.min() < -1e-9 and x[0] < 1e-9:
        impulse[0] /= 2.0
    if x.size < 2 or impulse.sum() <= 0.0 or np.any(np.diff(x) <= 0.0):
        return None
    return x, impulse, 2.0 * float(x @ impulse) / float(impulse.sum())


def _smooth(result: Result, _: float = 0.0) -> Seen:
    seen = _noise_in_time(result)
    return None if seen is None else (-np.log10(max(seen[0], 1e-300)), "")


def _falls(result: Result, _: float = 0.0) -> Seen:
    """By how much J falls below what it was, without what a pull explains: impulses of a wall add up. Where most of it
    falls, and no pull is declared, it is no impulse."""
    largest, fallen = float(np.abs(result.J).max()), np.maximum.accumulate(result.J) - result.J
    fall, pulled = float(fallen.max()), float(result.series.get("J_minus", np.zeros(1))[-1])
    fall -= 0.0 if result.pull_is_read_off and fall > OWN * largest else pulled
    at = f"at τ = {result.tau[int(fallen.argmax())]:.3g}"
    return (max(fall, 0.0) / largest, at) if largest > 0.0 else None


def _motion(result: Result, _: float = 0.0) -> Seen:
    """The parabola through the gaps ahead: velocity and curvature against the problem's."""
    given, found = result.problem.kappa_over_nu, []
    for when, x, gap in result.snapshots():
        near, far = (np.sqrt(2.0 / min(given, 1.0)) + 3.0) * np.sqrt(when), x.max() - AHEAD * np.sqrt(when)
        ahead = (np.abs(x) > near) & (np.abs(x) < far)
        if far > 2.0 * near and ahead.sum() >= 8:
            curvature, start = np.polyfit(x[ahead] ** 2 / 2.0, gap[ahead], 1)
            figure = max(abs(start / when + 1.0), abs(curvature - given) / max(given, STEEP))
            seen = f"velocity {-start / when:.3g} V₀, curvature {curvature / given:.3g} K at τ = {when:.3g}"
            found.append((float(figure), seen))
    return max(found, default=None)


def _push_at_a_gap(result: Result, _: float = 0.0) -> Seen:
    """The share of the last hundredth's push that acts where the gap is open by more than can have opened since."""
    found = []
    for when, x, gap in result.snapshots():
        if result.node_x is None:
            return None
        push, opened, since = last_push(result, when, x, gap)
        away = np.where(opened > PART * when + since, push, 0.0)
        if push.sum() > 0.0:
            found.append((float(away.sum() / push.sum()), _at(result.node_x[int(away.argmax())], when)))
    return max(found, default=None)


def _energy(result: Result, _: float = 0.0) -> Seen:
    """The largest gain over JV₀: of the energies that are reported, or of the kinetic alone, which only falls."""
    largest = float(np.abs(result.J).max())
    if largest == 0.0:
        return None
    if {"E_kin", "E_el"} <= result.series.keys():
        gain = result.series["E_kin"] + result.series["E_el"]
        gain = gain - gain[0]
        return max(float(gain.max()), 0.0) / largest, f"at τ = {result.tau[int(gain.argmax())]:.3g}", 2e-4
    found = [(_over_beam(x, (v**2 - 1.0) / 2.0), when) for when, x, v in result.snapshots("snap_v")]
    gained, when = max(found, default=(0.0, 0.0))
    return (max(gained, 0.0) / largest, f"kinetic energy at τ = {when:.3g}") if found else None


def _pull(result: Result, _: float = 0.0) -> Seen:
    largest = float(np.abs(result.J).max())
    if "J_minus" not in result.series or largest == 0.0:
        return None
    pulled = result.series["J_minus"]
    when = result.tau[int(np.searchsorted(pulled, 0.5 * pulled[-1]))] if pulled[-1] > 0.0 else 0.0
    return float(pulled[-1]) / largest, f"half of it by τ = {when:.3g}"


def _momentum(result: Result, _: float = 0.0) -> Seen:
    """What the beam has lost over what the wall gave, less 1: positive where impulses are missing; the median of the
    record's second half."""
    return _lost(result, "snap_v", result.J, lambda x, tau, v: _free(result.problem, x, tau)[1] - v, 0.015)


def _displacement(result: Result, _: float = 0.0) -> Seen:
    """The same of gaps, once more summed over time."""
    mean = (result.J[1:] + result.J[:-1]) / 2.0
    until = np.concatenate([[0.0], np.cumsum(np.diff(result.tau) * mean)])
    return _lost(result, "snap_gap", until, lambda x, tau, gap: gap - _free(result.problem, x, tau)[0], 0.03)


def _lost(result: Result, of: str, series: Array, deficit: Callable[..., Array], least: float) -> Seen:
    """deficit : of x, τ and what a snapshot has there."""
    pairs = [(when, _over_beam(x, deficit(x, when, values))) for when, x, values in result.snapshots(of)]
    given = [(lost, float(np.interp(when, result.tau, series))) for when, lost in pairs if when >= result.tau[-1] / 2.0]
    ratios = [lost / gave - 1.0 for lost, gave in given if gave != 0.0]
    if not ratios:
        return None
    figure, noise = float(np.median(ratios)), (_noise_in_time(result) or (0.0,))[0]
    return figure, f"the beam has lost {1.0 + figure:.3g} of what the wall gave", max(least, 2.5 * noise)


def _penetration(result: Result, _: float = 0.0) -> Seen:
    deep = [(float(-gap.min()) / when, _at(x[int(gap.argmin())], when)) for when, x, gap in result.snapshots()]
    figure, where = max(deep, default=(0.0, ""))
    return (max(figure, 0.0), where) if deep else None


def _lift(result: Result, lambda0: float) -> Seen:
    """Inside nine tenths of the zone."""
    found = []
    for when, x, gap in result.snapshots():
        zone = np.flatnonzero(np.abs(x) <= 0.9 * lambda0 * np.sqrt(when))
        if zone.size:
            highest = zone[int(gap[zone].argmax())]
            found.append((max(float(gap[highest]) / when, 0.0), _at(x[highest], when)))
    return max(found, default=None)


def _far_end(result: Result, _: float = 0.0) -> Seen:
    if not (found := list(result.snapshots())):
        return None
    when, x, gap = found[-1]
    away = np.abs(gap - _free(result.problem, x, when)[0]) / when
    return float(away[np.abs(x) > 0.9 * x.max()].max()), f"the last tenth of {x.max():.3g} l*, τ = {when:.3g}"


def _noise_in_time(result: Result, _: float = 0.0) -> tuple[float, str] | None:
    """Root mean square of the residual of the fit c + a√τ (+ bτ^{3/2} with loads) to J, over that of J."""
    inside = result.in_window(result.tau)
    tau, impulse = result.tau[inside] / result.tau[inside][-1], result.J[inside]
    powers = (0.0, 0.5, 1.5) if result.problem.kind == "first" else (0.0, 0.5)
    columns = np.stack([tau**p for p in powers], axis=1)
    rest = impulse - columns @ np.linalg.lstsq(columns, impulse, rcond=None)[0]
    size = float(np.sqrt(np.mean(impulse**2)))
    at = f"largest at τ = {result.tau[inside][int(np.abs(rest).argmax())]:.3g}"
    return (float(np.sqrt(np.mean(rest**2))) / size, at) if size > 0.0 else None


def _noise_in_space(result: Result, _: float = 0.0) -> Seen:
    """The point that has got most more or less than its neighbours inside the zone."""
    side = _one_side(result)
    if side is None:
        return None
    x, impulse, zone = side
    density = impulse[1:-1] / ((x[2:] - x[:-2]) / 2.0)
    inner = np.flatnonzero((x[1:-1] > 0.15 * zone) & (x[1:-1] < 0.85 * zone))
    if inner.size < 3:
        return None
    uneven = np.abs(density[inner] / np.mean(density[inner]) - 1.0)
    return float(uneven.max()), f"at x = {x[1:-1][inner[int(uneven.argmax())]]:.3g}"


def _distribution(result: Result, _: float = 0.0) -> Seen:
    """Mean distance between the impulse up to x and the exact one, which is even up to the front; over J. The front is
    the result's own: that it is where it should be is λ₀'s to say."""
    side = _one_side(result)
    if side is None:
        return None
    x, impulse, zone = side
    edges, width = (x[1:] + x[:-1]) / 2.0, np.diff(np.append(0.0, (x[1:] + x[:-1]) / 2.0))
    up_to = np.cumsum(impulse)[:-1] / impulse.sum()
    if result.problem.kind == "point":
        beyond = edges > 0.25 * np.sqrt(result.tau[-1])
        return (1.0 - float(up_to[beyond][0]), "away from the middle") if beyond.any() else None
    near = edges < 1.3 * zone
    if not near.any():
        return 1.0, "all in one point"
    away = np.abs(up_to - np.minimum(edges / max(zone, 1e-300), 1.0))[near]
    figure = float(away @ width[near]) / float(width[near].sum())
    return figure, f"most at x = {edges[near][int(away.argmax())]:.3g}", max(PART, 0.05 * float(width[near][-1]) / zone)


class Reading(NamedTuple):
    """Its words, limit, the fields that it needs, the kinds of problems where it means something (none: all), and how
    it is read."""

    words: str
    limit: float
    needs: str
    kinds: tuple[str, ...]
    read: Callable[[Result, float], Seen]


FREE = ("leading", "point")
FRONTS, BEAMS = (*FREE, "first"), (*FREE, "bounce", "stopped-beam")
READINGS = {
    "too_smooth": Reading("decimals to which J is c + a√τ", 12.0, "J", FREE, _smooth),
    "impulse_falls": Reading("fall of the wall's impulse / J", 5.0 * PART, "J", (), _falls),
    "motion": Reading("ahead of all waves the beam does not move as the problem's", 0.03, GAPS, FREE, _motion),
    "far_end": Reading("the far end has left the free motion / V₀τ", 0.1, GAPS, FREE, _far_end),
    "push_at_a_gap": Reading("push across an open gap / push", 0.1, f"{NODES}, {GAPS}", FRONTS, _push_at_a_gap),
    "energy": Reading("energy gained / JV₀", PART, "E_kin and E_el, or snap_v", BEAMS, _energy),
    "pull": Reading("tensile impulse / J", PART, f"J_minus, or {NODES}", (), _pull),
    "momentum": Reading("momentum that the beam lost / J, less 1", 0.015, "snap_v", FRONTS, _momentum),
    "displacement": Reading("the same of gaps and ∫J dτ, less 1", 0.03, GAPS, FREE, _displacement),
    "penetration": Reading("penetration / V₀τ", PART, GAPS, FRONTS, _penetration),
    "lift": Reading("gap inside the zone / V₀τ", PART, GAPS, FREE, _lift),
    "noise_in_time": Reading("noise of J(τ), root mean square / J", PART / 2.0, "J", FRONTS, _noise_in_time),
    "noise_in_space": Reading("one point's impulse against its neighbours'", 0.3, NODES, ("leading",), _noise_in_space),
    "distribution": Reading("impulse along the beam against the exact one / J", PART, NODES, FREE, _distribution),
}


def readings(result: Result, lambda0: float) -> tuple[dict[str, Symptom], dict[str, str]]:
    """What can be read off a result, by name, and what cannot, with the fields that are missing."""
    found, missing = {}, {}
    for name, (words, limit, needs, kinds, read) in READINGS.items():
        if kinds and result.problem.kind not in kinds:
            continue
        seen = read(result, lambda0)
        if seen is None:
            missing[name] = needs
        else:
            found[name] = Symptom(name, seen[0], seen[2] if len(seen) > 2 else limit, seen[1], words)
    return found, missing
