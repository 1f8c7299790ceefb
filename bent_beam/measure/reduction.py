"""Largest values of a run, of bending moments and of an elastic wall, and how contact was held: for every reader of a
history. (:mod:`bent_beam.measure.moments` is about moments of the impulse.)"""

import math
from typing import NamedTuple

import numpy as np

from bent_beam.history import Array, ImpactHistory
from bent_beam.measure.moments import element_at

CHUNK = 256  # saved instants at once
OF_RUN, OF_BEAM = 0.02, 0.002  # see _first_resolved
RESOLVED = 10.0  # elements that a bending wave must have passed before a moment is one of the beam, not of its mesh
SMOOTH = 3.0  # elements within √(cη), c = √(EI/μ): so many follow the start of a damped beam within 3 %
WALLS = {"front": "impulse", "opposite": "opposite_impulse"}  # the impulses of their contact points
BESIDE = 2.5  # elements: so far from a point its neighbours may push in its place
PUSH_TIME, OF_TIME = 1e-3, 0.05  # T*, and of the time itself: before and after it, a push is a mean over the shorter
MAY_BE_HELD = 0.01  # of the run: while this lasts, a start may be held
LANDING = 1e-4  # of a force that does not stand out from those beside it, as one at a landing: its least error


class PeakMoment(NamedTuple):
    """Largest bending moment, N m (its size), its place, m, x or of a symmetric impact |x|, and its time, s: of all
    steps the middle of its saved interval, else the saved instant.

    midspan : the largest at x = 0, N m. spread : by how much it may be off, N m, as the push on one point spreads over
    less than an element, or over its neighbours."""

    moment: float
    place: float
    time: float
    midspan: float
    spread: float = 0.0


class WallPeaks(NamedTuple):
    """The largest force on the whole zone of a wall that gives way, N, and its time, s; the largest penetration, m, and
    pressure, N/m (of a stop its force, N); of all steps, not only of the saved instants. sharp : by how much the force
    stands above the mean of both steps beside it, N, or 1e-4 of it. Between the saved instants around its time: the
    mean |x| of that force, m, and on which wall it acts, "front" or "opposite"; ``None`` where nothing pushes."""

    force: float
    time: float
    penetration: float
    pressure: float
    sharp: float
    place: float | None
    wall: str | None


def wall_peaks(history: ImpactHistory, until: float | None = None) -> WallPeaks | None:
    """The peaks up to ``until`` (s; ``None``: the end); ``None`` where the wall is rigid, or the path has none."""
    if "peak_force" not in history:
        return None
    k = max(_instants(history, until) - 1, 0)
    names = ("peak_force", "peak_force_time", "peak_penetration", "peak_pressure")
    force, time, penetration, pressure = (float(history.array(name)[k]) for name in names)
    sharp = _sharpness(history, time) or LANDING * force
    return WallPeaks(force, time, penetration, pressure, sharp, *_pushed_at(history, time))


def _instants(history: ImpactHistory, until: float | None) -> int:
    """How many saved instants there are up to ``until``, s; ``None``: all."""
    return int(np.searchsorted(history.time, math.inf if until is None else until * (1.0 + 1e-9), side="right"))


def _pushed_at(history: ImpactHistory, time: float) -> tuple[float, str] | tuple[None, None]:
    """Mean |x|, m, of the pushes between the saved instants around ``time``, and the wall that gives most of them. A
    damper may push hardest as the beam lands, at the end of a saved interval: then of the next."""
    first = min(max(int(np.searchsorted(history.time, time)), 1), max(history.time.size - 1, 1))
    for k in range(first, min(first + 2, history.time.size)):
        gains = {w: np.diff(history.array(n, slice(k - 1, k + 1)), axis=0)[0] for w, n in WALLS.items() if n in history}
        wall, gain = max(gains.items(), key=lambda one: float(one[1].sum()))
        if (given := float(gain.sum())) > 0.0:
            return float(gain @ np.abs(history.contact_positions(k))) / given, wall
    return None, None


def _sharpness(history: ImpactHistory, when: float) -> float:
    """By how much the force of a step at ``when`` stands above the mean of the steps beside it, N. It is estimated from
    saved instants: with their distance this grows like its square where the force is smooth, and in proportion where
    it has a kink."""
    if history.time.size < 6:
        return 0.0
    k = min(max(int(np.searchsorted(history.time, when)) - 1, 2), history.time.size - 4)
    about = slice(k - 2, k + 4)
    spans = np.diff(history.time[about])
    forces = np.abs(np.diff(history.array("total_impulse", about))) / spans  # its sign says which of two walls pushes
    near, far = (float(forces[2] - 0.5 * (forces[2 - i] + forces[2 + i])) for i in (1, 2))
    if near <= 0.0:
        return 0.0
    order = min(math.log2(max(far / near, 2.0)), 2.0)
    return near * min(float(history.time[-1]) / max(history.steps, 1) / float(spans[2]), 1.0) ** order


def rise_between(values: Array, k: int) -> float:
    """How much the parabola through a largest value and its neighbours rises above it."""
    if not 0 < k < values.size - 1:
        return 0.0
    before, largest, after = (float(value) for value in values[k - 1 : k + 2])
    bent = 2.0 * largest - before - after
    return (after - before) ** 2 / (8.0 * bent) if bent > 0.0 else 0.0


def begins_between(time: Array, total: Array, gained: Array, k: int, window: float) -> float:
    """Half of what a window, s, that begins between saved instants may gain beyond the largest of those that begin at
    one, ``gained`` at ``k``: each lies within one that is longer by a saved interval."""
    step = float(np.diff(time[k : k + 2]).max(initial=0.0))
    return 0.5 * float(np.max(np.interp(time + (window + step), time, total) - total) - gained[k])


def hold_of(history: ImpactHistory) -> dict[str, float | None] | None:
    """``{"until": s, "pull": largest pull over largest push}`` where any contact point was held, pull ``None`` where
    nothing pushed; else ``None``."""
    found = history.settings.get("hold")
    if not isinstance(found, dict) or not found:
        return None
    return {k: None if found[k] is None else float(found[k]) for k in ("until", "pull")}


def pull_of(history: ImpactHistory) -> float | None:
    """Largest pull over largest push between two saved instants, after the start; ``None`` where nothing pushed."""
    time = history.time
    first = int(np.searchsorted(time, MAY_BE_HELD * time[-1]))
    gains = np.diff(history.array("impulse", slice(first, None)), axis=0)
    least, most = float(gains.min(initial=0.0)), float(gains.max(initial=0.0))
    return None if most <= 0.0 else (0.0 - least) / most  # nothing pulled: 0, not −0


def peak_moment(history: ImpactHistory, until: float | None = None, since: int = 0) -> PeakMoment:
    """The largest bending moment anywhere, and in the middle, up to ``until`` (s; ``None``: the last instant), after
    the saved instant ``since``: of all steps where a history has them, otherwise at the saved instants. The first
    instants of all steps are left out: the first touch of a mesh bends it the more the stiffer its contact is
    (κ/ν = 2.5: 1.42 V₀√(EIμ) on every mesh, where the beam has 1)."""
    count = _instants(history, until)
    told = all(name in history for name in ("largest_moment", "largest_moment_place", "largest_midspan_moment"))
    if told and count > 1:
        first = max(_first_resolved(history, count), min(since + 1, count - 1))
        sizes = history.array("largest_moment", slice(first, count))
        k = first + int(np.argmax(sizes))
        place, middle = history.array("largest_moment_place")[k], history.array("largest_midspan_moment")[first:count]
        time = float(history.time[k - 1 : k + 1].mean())
        best = PeakMoment(float(sizes.max()), _side(history, float(place)), time, float(middle.max()))
        return best._replace(spread=_spread(history, best))
    best = PeakMoment(0.0, 0.0, float(history.time[0]), 0.0)
    midspan = 0.0
    moving = "position" in history
    for first in range(since + 1, count, 1 if moving else CHUNK):
        moments, place = history.bending_moments(first if moving else slice(first, min(first + CHUNK, count)))
        sizes = np.abs(moments).reshape(-1, *place.shape)
        if moving:  # with a beam without end
            sizes = np.where(np.abs(place) <= history.impact.half_length, sizes, 0.0)
        j, *worst = np.unravel_index(int(np.argmax(sizes)), sizes.shape)
        if sizes[j, *worst] > best.moment:
            best = PeakMoment(float(sizes[j, *worst]), float(place[*worst]), float(history.time[first + j]), 0.0)
        middle = (place[:, 0] <= 0.0) & (place[:, 1] >= 0.0)
        share = -place[middle, 0] / (place[middle, 1] - place[middle, 0])  # linear in an element, as of a cubic
        there = (1.0 - share) * moments[..., middle, 0] + share * moments[..., middle, 1]
        midspan = max(midspan, float(np.abs(there).max(initial=0.0)))
    best = best._replace(place=_side(history, best.place), midspan=midspan)
    return best._replace(spread=_spread(history, best))


def _side(history: ImpactHistory, place: float) -> float:
    """x, or of a symmetric impact, whose halves are alike, |x|."""
    return place if history.impact.off_centre else abs(place)


def moments_around(history: ImpactHistory, time: float, window: float) -> tuple[Array, Array]:
    """Saved instants within ``window`` of ``time``, s, and the largest moment at each, N m; of all steps those that
    :func:`peak_moment` looks at."""
    first = _first_resolved(history, history.time.size) if "largest_moment" in history else 1
    near = np.abs(history.time[first:] - time) <= window * (1.0 + 1e-9)
    return history.time[first:][near], history.moment[first:][near]


def moment_left_out(history: ImpactHistory, until: float | None = None) -> float:
    """How large the moment, N m, may have been in the first instants that :func:`peak_moment` leaves out, of a damped
    beam before a rigid wall: there it rises above what follows and falls within some η. What the mesh made of it, and
    no more than V₀√(EIμ), the moment of a beam that is stopped at a point. 0 of other beams."""
    impact = history.impact
    if "largest_moment" not in history or not impact.damping or impact.shear_stiffness or impact.wall_stiffness:
        return 0.0
    count = _instants(history, until)
    left_out = history.array("largest_moment", slice(1, _first_resolved(history, count)))
    return min(float(left_out.max(initial=0.0)), impact.moment_scale)


def _spread(history: ImpactHistory, peak: PeakMoment) -> float:
    """`PeakMoment.spread`. Before a rigid wall a beam that shears is flat over b on either side of the point that it
    touches, where the slope of its shear makes up for what its bending leaves of the curvature: with a push P = 2bp,
    p/κ_sGA = (M_flat − M)/EI, and M is less by Pb/4. From half an element on, nodes show b. Nodes within
    :data:`BESIDE` may push beside the point, or in its place, where contact enters the wall or the point has just
    lifted: each takes half of its push times its distance from M. Of all of it Pb/4 is right, P being the push of all.
    Pushes are means over :data:`PUSH_TIME` about the time."""
    impact, time = history.impact, history.time
    if impact.shear_stiffness is None or impact.wall_stiffness is not None or time.size < 2:
        return 0.0
    half = min(PUSH_TIME * impact.slow_time_scale, OF_TIME * peak.time)
    first = max(int(np.searchsorted(time, peak.time - half, side="right")) - 1, 0)
    last = max(min(int(np.searchsorted(time, peak.time + half)), time.size - 1), first + 1)
    x, impulse = history.contact_positions(last), history.array("impulse", slice(first, last + 1))
    pushes = (impulse[-1] - impulse[0]) / float(time[last] - time[first])
    away = np.abs(x - x[np.argmin(np.abs(x - peak.place))])
    if history.sides == 1:  # the other half pushes as well; the middle is a half of its node
        away, pushes = np.concatenate((away, np.abs(-x - x[np.argmin(away)]))), np.tile(pushes, 2)
    element = element_at(history, last, peak.place)
    near = away <= BESIDE * element
    push, total = (max(float(pushes[those].sum()), 0.0) for those in (away == 0.0, near))
    flat = impact.bending_stiffness * (impact.unbent_curvature - impact.wall_curvature)
    twice_p = 2.0 * impact.shear_stiffness * max(flat - peak.moment, 0.0) / impact.bending_stiffness
    begin, end = impact.wall_span
    widest = 0.5 * min(element, end - begin)
    spread = 0.25 * push * (push / twice_p if push < twice_p * widest else widest)
    if not twice_p:
        return spread
    return spread + max(0.5 * float(pushes[near] @ away[near]) - 0.25 * total * (total / twice_p), 0.0)


def _first_resolved(history: ImpactHistory, count: int) -> int:
    """The first saved instant whose steps all lie behind the time in which a bending wave, √(EI/μ)t = x², passes
    :data:`RESOLVED` of the shortest elements. At most :data:`OF_RUN` of the time of the last of ``count`` is left out,
    and :data:`OF_BEAM` of T*: a coarse mesh or few saved instants hide no maximum. With a hysteretic loss, and with
    damping that is :data:`SMOOTH`, the moment of the first instants is the beam's own."""
    impact, time = history.impact, history.time
    element = float(np.diff(np.unique(history.positions(0))).min())
    smooth = impact.wave_constant * impact.damping >= (SMOOTH * element) ** 2 and impact.shear_stiffness is None
    if impact.hysteretic_loss or smooth:
        return 1
    most = min(OF_RUN * float(time[count - 1]), OF_BEAM * impact.slow_time_scale)
    begin = min((RESOLVED * element) ** 2 / impact.wave_constant, most)
    first = min(int(np.searchsorted(time, begin)) + 1, count - 1)
    while first > 1 and time[first - 1] > most:
        first -= 1
    return first
