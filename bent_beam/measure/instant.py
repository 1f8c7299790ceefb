"""What a run says of one instant: rim, impulse and force of the wall then, and the largest moment and force until then.

What grows is interpolated between saved instants, a force is the mean over a window around the instant, and the rim
is that of what pushes in saved intervals around it. A rigid wall has no largest force: it is an impulse over a window.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from bent_beam.history import ImpactHistory
from bent_beam.measure.moments import AROUND, first_front, half_contact_length, lift, mean_reaction, unsure
from bent_beam.measure.reduction import PeakMoment, WallPeaks, moment_left_out, peak_moment, wall_peaks

SHARES_AROUND = np.linspace(1.0 - AROUND, 1.0 + AROUND, 9)  # of an instant
BEYOND = 1.0 + AROUND  # times an instant: how far a run must go to be read there


@dataclass(frozen=True)
class Instant:
    """SI units; ``None`` is what does not exist.

    half_contact_length : of the rim of what pushes, m; none where nothing does (of first instants 0). reaction :
    mean force of the wall over a tenth of the time before and after, N. impulse : N s. peak_moment,
    peak_moment_place, peak_moment_time : the largest moment of all steps so far, N m, m, s; moment_left_out : what
    it may have been at first, moment_spread : by how much it may be off (:mod:`bent_beam.measure.reduction`).
    peak_force, peak_penetration, peak_pressure : of a wall that gives way, so far, the force with its time, s, mean
    |x|, m, wall ("front", "opposite") and how sharp it is, N (:class:`bent_beam.measure.reduction.WallPeaks`); a stop
    has no pressure. impulse_around : at ``SHARES_AROUND`` of the time, N s. element : how well the rim is known, m: the
    element there, or how far it jumps. lift : the largest inside the zone in the last decade of time, over V₀t.
    """

    half_contact_length: float | None
    reaction: float | None
    impulse: float
    peak_moment: float
    peak_moment_place: float
    peak_moment_time: float
    moment_left_out: float
    moment_spread: float
    peak_force: float | None
    peak_force_time: float | None
    peak_force_place: float | None
    peak_force_wall: str | None
    peak_force_sharp: float
    peak_penetration: float | None
    peak_pressure: float | None
    impulse_around: tuple[float, ...]
    element: float
    lift: float


def instant(history: ImpactHistory, time: float, *, first_spread: bool = False) -> Instant:
    """Read a run at ``time``, s.

    first_spread : the contact is the first spread of a zone about the middle of a beam before a rigid wall: its
        rim is read without assuming how the zone behind it bears (:func:`bent_beam.measure.moments.first_front`).
    """
    k = int(np.argmin(np.abs(history.time - time)))  # saved times are those of steps
    front, bent = first_front(history, time) if first_spread else (half_contact_length(history, k), None)
    peak = largest_moment(history, time)
    wall = _wall_so_far(history, time)
    begin, end = history.impact.wall_span
    recent = (history.time >= 0.1 * time) & (history.time <= time * (1.0 + 1e-9))
    return Instant(
        half_contact_length=front,
        reaction=mean_reaction(history, time),
        impulse=float(history.impulse_at(time)),
        peak_moment=peak.moment,
        peak_moment_place=peak.place,
        peak_moment_time=peak.time,
        moment_left_out=moment_left_out(history, time),
        moment_spread=peak.spread,
        peak_force=None if wall is None else wall.force,
        peak_force_time=None if wall is None or wall.place is None else wall.time,
        peak_force_place=None if wall is None else wall.place,
        peak_force_wall=None if wall is None else wall.wall,
        peak_force_sharp=0.0 if wall is None else wall.sharp,
        peak_penetration=None if wall is None else wall.penetration,
        peak_pressure=None if wall is None or begin == end else wall.pressure,
        impulse_around=tuple(history.impulse_at(time * SHARES_AROUND).tolist()),
        element=unsure(history, k, front, bent),
        lift=float(lift(history)[recent].max(initial=0.0)) if first_spread else 0.0,
    )


def largest_moment(history: ImpactHistory, time: float) -> PeakMoment:
    """The largest moment of all steps until ``time``, s. Between two saved instants it is the moment that is
    interpolated: the largest so far has a kink where the moment passes it. From 0 to the first saved instant the moment
    jumps, and is that of the first."""
    k = min(int(np.searchsorted(history.time, time)), history.time.size - 1)
    if k < 2:
        return peak_moment(history, until=float(history.time[k]))
    late = peak_moment(history, until=float(history.time[k]), since=k - 1)
    early = peak_moment(history, until=float(history.time[k - 1]))
    now = float(np.interp(time, history.time[k - 1 : k + 1], history.moment[k - 1 : k + 1]))
    if now <= early.moment:
        return early
    return late._replace(moment=min(now, late.moment), time=min(late.time, time))


def _wall_so_far(history: ImpactHistory, time: float) -> WallPeaks | None:
    """The peaks of all steps until ``time``, s, interpolated between saved instants. A force that had fallen grows
    beyond its earlier largest from what it was at the earlier instant."""
    k = min(int(np.searchsorted(history.time, time)), history.time.size - 1)
    early, late = (wall_peaks(history, until=float(history.time[max(i, 0)])) for i in (k - 1, k))
    if early is None or late is None or k == 0:
        return late
    begin, end = history.time[k - 1 : k + 1]
    share = (time - begin) / (end - begin)
    if k > 1 and early.time < history.time[k - 2] and late.force > early.force:
        fallen = abs(float(np.gradient(history.array("total_impulse"), history.time)[k - 1]))
        force = np.interp(time, (begin, late.time), (fallen, late.force))
        share = max(float(force) - early.force, 0.0) / (late.force - early.force)
    if share == 0.0:
        return early
    names = ("force", "penetration", "pressure")
    mixed: Any = {name: (1.0 - share) * getattr(early, name) + share * getattr(late, name) for name in names}
    return late._replace(time=min(late.time, time), **mixed)
