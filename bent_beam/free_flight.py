"""Whether a beam that has left the wall can come back to it.

A free–free beam without loads flies on: centre of mass and rotation go on at constant rates, and the elastic energy E,
what is left of the total without them, can only fall. Its elastic deflection is then nowhere beyond

    |u_e(x)| ≤ √(2E C),      C = L³/(105 EI) + 2L/(15 κ_sGA),                                                (1)

C being the compliance of the beam's end with its rigid motion taken out (Σφ_j²/ω_j² of the free–free modes), the second
part with shear. With Maxwell branches EI is that of the spring beside them: by then they may have relaxed, and it may
hold all of the energy.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from bent_beam.history import Array, ImpactHistory
from bent_beam.hysteresis import FIRST_MODE, branches_of
from bent_beam.impact import Impact
from bent_beam.loads import loads_of

#: Period of the free–free beam's lowest mode over T*, whatever the beam's ends: 2π/(4.730/2)².
LOWEST_PERIOD = 2.0 * math.pi / (FIRST_MODE / 2.0) ** 2

ROUND_OFF = 1e-9
"""Of the largest impulse of the record: less between two saved instants is no force. A path that takes the
impulse from the beam's momentum leaves 1e-12 to 1e-10 of it in free flight."""


def acting(impulse: Array) -> NDArray[np.bool_]:
    """Between which saved instants a wall pushed, or pulled where it may, of its impulse so far: shape (times − 1,)
    and, for contact points, (times − 1, contacts)."""
    return np.abs(np.diff(impulse, axis=0)) > ROUND_OFF * float(np.abs(impulse).max(initial=0.0))


def given_by_wall(history: ImpactHistory) -> Array:
    """Impulses of the wall, N s, (times, 1 + contacts): in all, and of contact points, of which some may pull as hard
    as others push."""
    return np.column_stack([history.array("total_impulse"), history.array("impulse")])


def bears_free_flight(impact: Impact) -> bool:
    """Whether the beam moves without loads and supports once it is off the wall, and towards no other wall; off a plate
    or a stop that cannot be told."""
    return not (impact.supported or impact.wall_in_part or impact.net_load != 0.0 or _turned_back(impact))


def _turned_back(impact: Impact) -> bool:
    """Whether another wall, or a load that has no term of y₀, may send a beam back that flies away from the wall."""
    forces = any(about.powers is None and getattr(impact, load) for load, about in loads_of(Impact).items())
    return forces or impact.opposite_wall is not None


def cannot_return(impact: Impact, x: Array, gap: Array, velocity: Array, energy: float) -> bool:
    """Whether the wall can never be touched again, by (1): sufficient, not necessary.

    x : node places, m, of the whole beam or of its half x ≥ 0; gap (m) and velocity into the wall (m/s) there.
    energy : kinetic and strain, of the whole beam, J.
    """
    return bears_free_flight(impact) and _stays_clear(impact, x, gap, velocity, energy)


def _stays_clear(impact: Impact, x: Array, gap: Array, velocity: Array, energy: float) -> bool:
    """Whether no point can come back to where a wall stands, or would stand if it went on."""
    free = gap - 0.5 * impact.relative_curvature * (x - impact.first_touch) ** 2  # zero for an unstrained beam at rest
    distance, tilt = _rigid(x, free)
    speed, spin = _rigid(x, -velocity)
    mass = impact.mass_per_length * impact.length
    rigid = 0.5 * mass * (speed**2 + spin**2 * impact.length**2 / 12.0)
    elastic = max(energy - rigid, 0.0)
    branches = branches_of(impact)
    stiffness = impact.bending_stiffness * (1.0 if branches is None else branches.relaxed)
    compliance = impact.length**3 / (105.0 * stiffness)
    if impact.shear_stiffness is not None:
        compliance += 2.0 * impact.length / (15.0 * impact.shear_stiffness)
    reach = math.sqrt(2.0 * elastic * compliance)
    clear = gap - free + distance + tilt * x >= reach
    return bool(np.all(clear) and np.all(speed + spin * x >= 0.0))


State = tuple[Array, Array, Array, float]


def _last(history: ImpactHistory) -> State:
    energy = float(history.array("kinetic_energy")[-1] + history.array("strain_energy")[-1])
    return history.positions(-1), history.array("gap", -1), history.array("velocity", -1), energy


def has_left(history: ImpactHistory) -> bool:
    """Whether a run ends with the beam off the wall: it cannot return, or has not pushed for :data:`LOWEST_PERIOD`."""
    quiet = _quiet(history)
    return quiet >= _period(history.impact) or (quiet > 0.0 and _is_off(history.impact, quiet, lambda: _last(history)))


def is_over(history: ImpactHistory) -> bool:
    """Whether a run holds a whole impact, as :class:`Separation` asks for it."""
    quiet = _quiet(history)
    return quiet >= _period(history.impact) and _is_off(history.impact, quiet, lambda: _last(history))


def _period(impact: Impact) -> float:
    return LOWEST_PERIOD * impact.slow_time_scale


def _quiet(history: ImpactHistory) -> float:
    """s from the start of the saved interval of the last push to the end of a run; 0 without one. It is at least what
    :class:`Separation` has counted, which knows the step of that push."""
    pushed = np.flatnonzero(acting(given_by_wall(history)).any(axis=1))
    return float(history.time[-1] - history.time[pushed[-1]]) if pushed.size else 0.0


def may_return(history: ImpactHistory) -> bool:
    """Whether a beam that has left may come back to its wall after the end of a run. A beam on a hinge does under
    tension, or pushed to it. A free one may unless (1) forbids it; a uniform pull only takes it farther away."""
    impact = history.impact
    if impact.supported:
        return impact.axial_force > 0.0 or impact.net_load > 0.0
    if impact.net_load < 0.0 and not impact.off_centre:
        return False
    return impact.net_load > 0.0 or _turned_back(impact) or not _stays_clear(impact, *_last(history))


def _is_off(impact: Impact, quiet: float, state: Callable[[], State]) -> bool:
    """Whether a beam that has not pushed for ``quiet`` s is off for good: of ``state``, where that tells it."""
    if not bears_free_flight(impact):
        return quiet >= _period(impact)
    x, gap, velocity, energy = state()
    return bool(gap.min() > 0.0) and cannot_return(impact, x, gap, velocity, energy)


class Separation:
    """Says in the course of a run when a whole impact is over: the beam has not pushed for :data:`LOWEST_PERIOD`, in
    which its largest stress may still come, and is off the wall for good."""

    def __init__(self, impact: Impact) -> None:
        self.impact, self.period = impact, _period(impact)
        self.impulse = self.since = 0.0

    def __call__(self, time: float, impulse: float, state: Callable[[], State], *, closed: bool = False) -> bool:
        """Whether the beam has left at ``time`` (s), asked at increasing times.

        impulse : a measure that grows while the wall pushes, such as its impulse so far. closed : whether any contact
            point is closed, pushing or not.
        state : gives x, gap, velocity and energy as :func:`cannot_return` takes them; called where they matter.
        """
        if closed or impulse > self.impulse:
            self.impulse, self.since = impulse, time
            return False
        over = impulse != 0.0 and time - self.since >= self.period
        return over and _is_off(self.impact, time - self.since, state)


def _rigid(x: Array, field: Array) -> tuple[float, float]:
    """Mean and slope of the straight line nearest to a field along the beam (slope 0 of a half)."""
    span = float(x[-1] - x[0])
    mean = float(np.trapezoid(field, x)) / span
    return mean, 0.0 if x[0] >= 0.0 else 12.0 * float(np.trapezoid(field * x, x)) / span**3
