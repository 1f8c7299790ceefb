"""What a run of the whole impact comes to, in the units ℓ = L/2, T* = ℓ²√(μ/EI), V₀ (docs/whole_impact.md).

A hit is a time of contact whose interruptions are shorter than a period of the first mode; these numbers are of the
first:

    e = −velocity of the centre of mass after it/before it,   J = impulse until then/(μℓV₀), without loads 2(1 + e),

its last contact T_c/T*, how often the beam was off the wall, and the shares of energy then, of what the beam had and
the loads have worked. The largest bending moment of the elastic strain, EI u_xx/(V₀√(EIμ)), and the largest force on a
wall that gives way are those of the whole motion: from the first touch to one period of the lowest mode after the last
contact, where the run goes on so long.

A separation is a time of at least :data:`SHORTEST_SEPARATION` T* without a push: without a smallest duration there is
no such number (the reaction of a beam that is stopped at a point changes sign arbitrarily fast). :func:`hits` lists all
hits; each is of one wall, and goes on while the other wall pushes, too.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from bent_beam.free_flight import LOWEST_PERIOD, acting, given_by_wall, has_left, may_return
from bent_beam.history import Array, ImpactHistory
from bent_beam.impact import Impact
from bent_beam.measure.moments import element_at
from bent_beam.measure.reduction import WALLS, begins_between, moment_left_out, peak_moment, rise_between, wall_peaks

SHARES = ("translation", "vibration", "dissipated")  # of the energy
WINDOW = 0.01  # T*, in which impulses are added up: a rigid wall has no largest force
SHORTEST_SEPARATION = 2e-3
"""Shortest time without a push that counts as a separation, T*: four saved instants of a run to separation."""


@dataclass(frozen=True)
class WholeImpact:
    """One run's whole impact, dimensionless (see the module's head).

    restitution : ``None`` where the beam has not left: loads keep it on the wall, or the run ends too early.
    within : how well ``last_contact`` is known, the middle between two saved instants: half of their distance, all of
        it where a wall gives way, whose push fades. drift : how much restitution and shares of the energy change in it.
    until : end of the span that the largest moment and force are of.
    contacts : begin and end of each contact, separations shorter than the shortest ignored; the last ends at the last
        contact, last_push is its impulse over mV₀, a velocity over V₀. returns : when the beam is nearest to the wall
        again, within a period after the last contact, and the mean velocity since then by which it misses the wall, V₀.
    peak_moment_place : x/ℓ, of a symmetric impact |x|/ℓ. moment_left_out : what the moment may have been at
        first, moment_spread : by how much it may be off (:mod:`bent_beam.measure.reduction`).
    translation, vibration, dissipated : shares of the initial energy and the work of the loads, altogether one; the
        rotation of a beam that rocks counts as vibration.
    peak_force : on the zone of a wall that gives way, over μℓV₀/T*, with its time and its mean |x|/ℓ; ``None`` of a
        rigid one; peak_force_sharp : by how much it stands above the mean of the steps beside its own. push : the
        largest impulse within :data:`WINDOW` T*, over μℓV₀; push_time : when the wall begins to push within that;
        push_rise : its part that was estimated between saved instants, which is also its uncertainty; of a rigid wall,
        whose pushes are short, half of what may lie there.
    supplied : the initial energy and the work of the loads until the last contact, J; supplied_rate : its relative
        growth in T* there. element : length over ℓ of the element at the largest moment; its place lies in it.
    energy_defect : what the independently computed terms of the budget leave, of the initial energy; energy_gain : the
        largest rise of the energy, what springs of the wall hold included, above what loads have worked, likewise.
    left : whether the beam is off the wall (:func:`bent_beam.free_flight.has_left`); otherwise no number is final.
        again : whether the run has later hits; may_return : whether any may come after it.
    """

    restitution: float | None
    impulse: float
    last_contact: float
    separations: int
    peak_moment: float
    peak_moment_place: float
    peak_moment_time: float
    moment_left_out: float
    moment_spread: float
    midspan_moment: float
    translation: float
    vibration: float
    dissipated: float
    peak_force: float | None
    peak_force_time: float | None
    peak_force_place: float | None
    peak_force_sharp: float
    push: float
    push_time: float
    push_rise: float
    supplied: float
    supplied_rate: float
    element: float
    within: float
    drift: dict[str, float]
    until: float
    contacts: tuple[tuple[float, float], ...]
    last_push: float
    returns: tuple[tuple[float, float], ...]
    energy_defect: float
    energy_gain: float
    left: bool
    again: bool = False
    may_return: bool = False


def pushes(time: Array, impulse: Array, shortest: float) -> list[tuple[int, int]]:
    """Saved instants at which contacts begin and end, separations shorter than ``shortest`` (s) ignored; a pull is
    contact, too."""
    pushed = np.flatnonzero(acting(impulse.reshape(time.size, -1)).any(axis=1))
    if pushed.size == 0:
        return []
    off = time[pushed[1:]] - time[pushed[:-1] + 1]
    apart = np.flatnonzero((off > 0.0) & (off >= shortest * (1.0 - 1e-9)))
    begin = np.concatenate([pushed[:1], pushed[apart + 1]])
    end = np.concatenate([pushed[apart], pushed[-1:]]) + 1
    return [(int(i), int(k)) for i, k in zip(begin, end)]


def _check_whole(history: ImpactHistory) -> None:
    if not history.is_whole:
        raise ValueError(f"the run models {history.modelled_length:.6g} m of the beam: its energy is not the beam's")


def whole_impact(history: ImpactHistory) -> WholeImpact:
    """Reduce a run. Raises ``ValueError`` where the wall was never touched, or the beam is modelled in part."""
    _check_whole(history)
    impact, time = history.impact, history.time
    total, unit = history.array("total_impulse"), impact.slow_time_scale
    contacts = pushes(time, given_by_wall(history), SHORTEST_SEPARATION * unit)
    if not contacts:
        raise ValueError("the run ends before the wall was touched")
    mass, speed = impact.mass_per_length * impact.length, impact.velocity
    hit = _grouped([(i, k, "front") for i, k in contacts], impact, time)[0]
    _, end, _ = hit[-1]
    last = 0.5 * float(time[end - 1] + time[end])
    until = min(float(time[contacts[-1][1]]) + LOWEST_PERIOD * unit, float(time[-1]))
    peak, left = peak_moment(history, until=until), has_left(history)
    energy = history.array("kinetic_energy") + history.array("strain_energy")
    initial = float(energy[0])
    work = initial + history.energy("work_of_loads")
    window = WINDOW * unit
    gained = np.interp(time + window, time, total) - total
    k, soft = int(np.argmax(gained)), impact.wall_stiffness is not None
    rise = rise_between(gained, k) if soft else begins_between(time, total, gained, k, window)
    begin = k + max(int(np.argmax(total[k:] > total[k])) - 1, 0)  # the last instant before the wall pushes
    before = _velocity(history, hit[0][0], float(time[hit[0][0]]))
    arrives = abs(before) > 1e-6 * speed  # a beam that only turns has no restitution

    def at(instant: float) -> dict[str, float]:
        kept, given = (float(np.interp(instant, time, values)) for values in (energy, work))
        after = _velocity(history, end, instant)
        translation = 0.5 * mass * after**2 / given
        shares = (translation, kept / given - translation, 1.0 - kept / given)
        return {"restitution": -after / before if arrives else 0.0} | dict(zip(SHARES, shares))

    found, begins, ends = (at(instant) for instant in (last, float(time[end - 1]), float(time[end])))
    part, given = 1.0 if soft else 0.5, float(np.interp(last, time, work))
    gone = arrives and (left or len(contacts) > len(hit))
    return WholeImpact(
        restitution=found["restitution"] if gone else None,
        **{name: found[name] for name in SHARES},
        impulse=2.0 * float(total[end]) / (mass * speed),
        last_contact=last / unit,
        separations=len(hit) - (0 if len(contacts) > len(hit) or left else 1),
        peak_moment=peak.moment / impact.moment_scale,
        peak_moment_place=peak.place / impact.half_length,
        peak_moment_time=peak.time / unit,
        moment_left_out=moment_left_out(history) / impact.moment_scale,
        moment_spread=peak.spread / impact.moment_scale,
        midspan_moment=peak.midspan / impact.moment_scale,
        **_largest_force(history, until),
        push=2.0 * (float(gained[k]) + rise) / (mass * speed),
        push_time=float(time[begin]) / unit,
        push_rise=2.0 * rise / (mass * speed),
        supplied=given,
        supplied_rate=float(work[end] - work[end - 1]) / float(time[end] - time[end - 1]) * unit / given,
        element=element_at(history, -1, peak.place) / impact.half_length,
        within=part * float(time[end] - time[end - 1]) / unit,
        drift={name: part * abs(ends[name] - begins[name]) for name in found},
        until=until / unit,
        contacts=tuple((float(time[i]) / unit, 0.5 * float(time[j - 1] + time[j]) / unit) for i, j, _ in hit),
        last_push=float(total[end] - total[hit[-1][0]]) / (mass * speed),
        returns=_returns(history, end),
        energy_defect=abs(history.energy_budget()["defect"]) / initial,
        energy_gain=float(np.max(np.diff(energy + history.energy("contact_energy") - work), initial=0.0)) / initial,
        left=left,
        again=len(contacts) > len(hit),
        may_return=may_return(history),
    )


def _returns(history: ImpactHistory, end: int) -> tuple[tuple[float, float], ...]:
    """`WholeImpact.returns` after a contact that ends at saved instant ``end``."""
    unit, speed = history.impact.slow_time_scale, history.impact.velocity
    stop = int(np.searchsorted(history.time, history.time[end] + LOWEST_PERIOD * unit))
    gap, since = history.array("gap", slice(end, stop)).min(axis=1), history.time[end:stop] - history.time[end]
    near = np.flatnonzero((gap[1:-1] < gap[:-2]) & (gap[1:-1] <= gap[2:])) + 1
    return tuple((float(history.time[end + k]) / unit, float(gap[k] / since[k]) / speed) for k in near)


def _largest_force(history: ImpactHistory, until: float) -> dict[str, Any]:
    """`WholeImpact.peak_force` until a time, s, and what belongs to it."""
    impact, found = history.impact, wall_peaks(history, until=until)
    if found is None:
        return dict.fromkeys(("peak_force", "peak_force_time", "peak_force_place")) | {"peak_force_sharp": 0.0}
    unit = impact.mass_per_length * impact.half_length * impact.velocity / impact.slow_time_scale
    return {
        "peak_force": found.force / unit,
        "peak_force_time": found.time / impact.slow_time_scale,
        "peak_force_place": None if found.place is None else found.place / impact.half_length,
        "peak_force_sharp": found.sharp / unit,
    }


def peak_times(found: WholeImpact, impact: Impact) -> dict[str, Any]:
    """When, s, and where, m from the middle, the wall pushes hardest, SI: its largest force, ``None`` of a rigid one,
    and the window with the largest impulse."""
    unit, force, place = impact.slow_time_scale, found.peak_force_time, found.peak_force_place
    return {
        "peak_force_time": None if force is None else force * unit,
        "peak_force_place": None if place is None else place * impact.half_length,
        "push_time": found.push_time * unit,
        "push_window": WINDOW * unit,
    }


def _grouped(contacts: list[tuple[int, int, str]], impact: Impact, time: Array) -> list[list[tuple[int, int, str]]]:
    """Contacts (begin, end, wall) by hits: with one wall, gaps shorter than a period of the first mode."""
    groups: list[list[tuple[int, int, str]]] = []
    for begin, end, wall in contacts:
        _, last, before = groups[-1][-1] if groups else (0, 0, "")
        if wall == before and time[begin] - time[last] < LOWEST_PERIOD * impact.slow_time_scale:
            groups[-1].append((begin, end, wall))
        else:
            groups.append([(begin, end, wall)])
    return groups


def _velocity(history: ImpactHistory, k: int, time: float) -> float:
    """Velocity of the centre of mass into the wall, m/s: at saved instant ``k``, or at ``time``, s, beside its push."""
    impact, x = history.impact, history.positions(k)
    if impact.supported:  # by forces that no history holds, and which change it between a push and the instant after
        two = slice(k, min(k + 2, history.time.size))
        means = np.trapezoid(history.array("velocity", two), x, axis=1) / (x[-1] - x[0])
        slope = np.diff(means) / np.diff(history.time[two])
        return float(means[0] + (time - history.time[k]) * slope.sum())
    places = np.array([-impact.half_length, 0.0, impact.half_length]) - impact.first_touch
    # V₀ + c₀x²/2 and the rotation, averaged: Simpson's rule is exact
    arrives = float(impact.free_motion(0.0)(places, by_t=1) @ (1.0, 4.0, 1.0)) / 6.0
    gained = impact.load_within(impact.half_length) * time - float(history.array("total_impulse")[k])
    return arrives + gained / (impact.mass_per_length * impact.length)


@dataclass(frozen=True)
class Hit:
    """wall : "front" or "opposite"; begin, end : s, the end in the middle of its saved interval; place : mean |x| of
    the push, m; impulse : N s, always positive.

    before, after : velocities of the centre of mass, m/s, positive towards the front wall; energy : kinetic, strain and
    in springs of the wall after it, J; lost : what the energy and the work of the loads fell by meanwhile, J; moment :
    the largest until the next begins, or this ends, N m (``None`` where the steps' are not kept). over : whether the
    beam is off the wall in the run, or hits again.
    """

    wall: str
    begin: float
    end: float
    place: float
    impulse: float
    before: float
    after: float
    energy: float
    lost: float
    moment: float | None
    over: bool = True

    @property
    def restitution(self) -> float:
        """−after/before."""
        return -self.after / self.before


def hits(history: ImpactHistory) -> list[Hit]:
    """All hits of a run, in order of time. Raises ``ValueError`` where the beam is modelled in part."""
    _check_whole(history)
    impact, time = history.impact, history.time
    copies = 2.0 / history.sides
    rows = {wall: copies * history.array(name) for wall, name in WALLS.items() if name in history}
    given = {wall: np.column_stack([of_points.sum(axis=1), of_points]) for wall, of_points in rows.items()}
    parts = [(i, k, wall) for wall, of_wall in given.items() for i, k in pushes(time, of_wall, 0.0)]
    work = history.energy("work_of_loads")
    energy = history.array("kinetic_energy") + history.array("strain_energy") - work + history.energy("contact_energy")
    groups = _grouped(sorted(parts), impact, time)
    found, last = [], time.size - 1
    for group, later in zip(groups, [*(group[0][0] for group in groups[1:]), last]):
        i, k, wall = group[0][0], group[-1][1], group[0][2]
        given = rows[wall][k] - rows[wall][i]
        size = np.abs(given)
        place = float(size @ np.abs(history.contact_positions(0))) / float(size.sum())
        end = 0.5 * float(time[k - 1] + time[k])
        before, after = _velocity(history, i, float(time[i])), _velocity(history, k, end)
        has, lost, pushed = float(energy[k] + work[k]), float(energy[i] - energy[k]), float(given.sum())
        until = float(time[max(later, k)])  # of two walls one may push while the other does
        moment = peak_moment(history, until, since=i).moment if "largest_moment" in history else None
        over = has_left(history) or (group is not groups[-1] and later >= k)
        found.append(Hit(wall, float(time[i]), end, place, pushed, before, after, has, lost, moment, over))
    return found
