"""Checks of a run from its state, which an energy budget cannot replace: momentum, initial energy, complementarity.
Their limits, path by path, are those of :mod:`bent_beam.measure.limits`.

Momenta of the modelled beam are integrated from the saved velocities, its mass taken from the problem, so that a wrong
impulse, a lost mass or a missing load shows, whatever the solver books. With the test functions 1 and x²,

    [∫μ v dx]₀ᵗ    = P t − J,                                 P : all loads, less EI q₀L where the ends follow y₀
    [∫μ x² v dx]₀ᵗ = P L²t/12 − 2EI [∫₀ᵗθ dt + ηθ]₀ᵗ − Σ x_i² J_i,          θ = [y_x + Kx] from −L/2 to L/2

the second for a bow free of stress with free ends, without N and without viscosity at grid scale: it sees where the
impulses act. On a mesh that expands with an infinite beam ∫μ z_t dx = J, z = y₀ − y being the fast part: absorber and
end together take none of it (2e-5 of J at κ/ν = 0.5).

v is taken as piecewise cubic: ∫v = Σ [h/2 (v₁ + v₂) + h²/12 (v₁′ − v₂′)], slopes by differences. Of elements that
shear they may also be the sections' turning, or zero; the first equation takes of the three what closes it best.
"""

import math
from dataclasses import dataclass

import numpy as np

from bent_beam.files import ENERGIES
from bent_beam.history import Array, ImpactHistory
from bent_beam.measure.limits import beyond_limits, limited_as
from bent_beam.measure.reduction import WALLS, hold_of

LEAST_PUSH = 1e-6  # of the largest gain of a contact point between two saved instants: less is no push
LAST = 0.5  # of the time to the last push, or of the saved instants: checks begin there; the start is not resolved
EARLY = 0.8  # of the impulse: what is given after it is always looked at


@dataclass(frozen=True)
class Balance:
    """Shares, ``None`` where one means nothing.

    momentum, second_moment : largest residual of the equations above in the second half of the saved instants, over
        the largest |J| and Σ x_i² J_i (second_moment less what missing momentum at the ends would explain).
    points : the impulses of the contact points, added up, less J, over the largest |J|, at the end.
    law : the impulse of the contact law likewise, where J is what the momentum lacks and is shared among the points.
    initial_energy : (recorded − ½μLV₀²)/½μLV₀² at t = 0, where the beam arrives with one velocity.
    energy : most that the budget leaves at a saved instant, over the initial energy and the work of the loads.
    middle_slope : largest slope at x = 0 of a symmetric run, over the largest anywhere.

    Three look at each wall late: from half of the time to its last push on, or from when four fifths of the impulse
    are given, if that is earlier.

    gap_of_push : largest gap at the end of an interval in which a contact point pushed, over V₀t.
    penetration : deepest node in a rigid wall, over V₀t.
    pull : most impulse that a contact point, not held, took back between two saved instants, over the most that one
        gave."""

    path: str  # the key of its limits (:data:`bent_beam.measure.limits.LIMITS`)

    momentum: float | None
    second_moment: float | None
    points: float | None
    law: float | None
    initial_energy: float | None
    gap_of_push: float | None
    penetration: float | None
    pull: float | None
    energy: float
    middle_slope: float | None

    @property
    def warnings(self) -> list[str]:
        """What is out of balance by more than a resolved run is."""
        return beyond_limits(self.path, self)


def balance_of(history: ImpactHistory) -> Balance:
    """The checks of one run."""
    missing = [_of_fast_part(history)] if "position" in history else _missing_momentum(history)
    return Balance(
        limited_as(history),
        _residual(min(missing, key=_largest_late), history.array("total_impulse")) if missing else None,
        _second_moment(history, missing[0]) if missing else None,
        _points(history),
        _beyond_total(history, float(history.array("law_impulse", -1))) if "law_impulse" in history else None,
        _initial_energy(history),
        _gap_of_push(history),
        _penetration(history),
        _pull(history),
        _energy(history),
        _middle_slope(history),
    )


def _late(history: ImpactHistory, wall: str) -> int:
    """The saved instant from which on a contact with ``wall`` is looked at. A beam that has left flies on for long,
    and may touch once more, lightly: the interval in which ``EARLY`` of the impulse is reached is never before it."""
    gains = np.diff(history.array(wall), axis=0).clip(0.0).sum(axis=1) if wall in history else np.zeros(1)
    pushes = np.flatnonzero(gains > LEAST_PUSH * gains.max(initial=0.0))
    if not pushes.size:
        return int(np.searchsorted(history.time, LAST * history.time[-1]))
    most = np.searchsorted(np.cumsum(gains), EARLY * gains.sum())
    return min(int(np.searchsorted(history.time, LAST * history.time[1 + pushes[-1]])), int(most))


def _penetration(history: ImpactHistory) -> float | None:
    """``None`` where a wall gives way or stands along a part, or contact points are no nodes."""
    impact, gaps = history.impact, {"front": history.array("gap")}
    nodal = "contact_position" not in history or "position" in history
    if impact.wall_stiffness is not None or impact.wall_in_part or not nodal:
        return None
    if impact.opposite_wall is not None:  # flat, behind the apex at the start
        front = impact.wall_clearance - 0.5 * impact.wall_curvature * (history.positions(0) - impact.first_touch) ** 2
        gaps["opposite"] = front + impact.opposite_wall - gaps["front"]
    if _ends_follow(history):  # the expansion y₀ itself is in the wall where its gap, grown so far, falls again
        x, start = np.abs(history.positions(0) - impact.first_touch), history.array("gap", 0)
        gaps["front"] = gaps["front"][:, x <= x[int(np.argmax(start))]]
    if "position" in history:  # the free motion means something where a node may touch
        pushed = np.flatnonzero(history.array("impulse", -1) > 0.0)
        gaps["front"] = gaps["front"][:, : 1 + int(1.2 * pushed.max(initial=0))]
    deepest = 0.0
    for wall, gap in gaps.items():
        first = max(_late(history, WALLS[wall]), 1)
        depth = np.abs(gap[first:].min(axis=1, initial=0.0))
        deepest = max(deepest, float((depth / (impact.velocity * history.time[first:])).max(initial=0.0)))
    return deepest


def _pull(history: ImpactHistory) -> float | None:
    """``None`` where nothing pushed, or what is held may pull."""
    first, gains = _late(history, "impulse"), np.diff(history.array("impulse"), axis=0)
    most = float(gains.max(initial=0.0))  # of the whole run: a beam that has left gives and takes round-off
    hold = hold_of(history)
    held = hold is not None and (hold["until"] or 0.0) > history.time[first]
    return None if most <= 0.0 or held else max(0.0, -float(gains[first:].min(initial=0.0))) / most


def _energy(history: ImpactHistory) -> float:
    kinds = [name for name in ENERGIES if name != "work_of_loads"]
    stored = np.sum([history.energy(name) for name in kinds], axis=0)
    work = history.energy("work_of_loads")
    left = stored - stored[0] - (work - work[0])
    given = float(history.energy("kinetic_energy")[0] + history.energy("strain_energy")[0])
    return float(np.abs(left).max()) / ((given + float(np.abs(work).max())) or 1.0)


def _middle_slope(history: ImpactHistory) -> float | None:
    if history.sides != 1 or "slope" not in history:
        return None
    slopes = np.abs(history.array("slope"))
    return float(slopes[:, 0].max()) / (float(slopes.max()) or 1.0)


def _largest_late(residual: Array) -> float:
    """Largest |residual| in the second half of the saved instants."""
    return float(np.abs(residual[int(LAST * residual.size) :]).max())


def _residual(residual: Array, impulse: Array) -> float | None:
    """Largest in the second half of the saved instants, over the largest impulse; ``None`` without one."""
    most = float(np.abs(impulse).max())
    return _largest_late(residual) / most if most > 0.0 else None


def _missing_momentum(history: ImpactHistory) -> list[Array]:
    """N s at each instant, slopes by differences and, where the beam shears, straight and by its sections' turning.
    Nothing where supports or an absorbing layer act, where ends that follow pull at a tangent that turns, and where a
    free end loses its rate of curvature within less than an element: it does so along √(ct)."""
    impact, motion = history.impact, history.impact.free_motion(0.0)
    turned = impact.fourth_derivative or impact.curvature_rate
    if impact.supported or not _keeps_momentum(history) or (impact.axial_force and turned and _ends_follow(history)):
        return []
    x, reached = history.positions(0), math.sqrt(impact.wave_constant * history.time[-1])
    if impact.curvature_rate and not _ends_follow(history) and x[-1] - x[-2] > reached:
        return []
    load = impact.load_within(0.5 * history.modelled_length)
    if _ends_follow(history):
        load -= impact.bending_stiffness * float(motion(0.0, by_x=4)) * history.modelled_length
    velocity, given = history.array("velocity"), load * history.time
    slopes: list[Array | None] = [None]
    if "angular_velocity" in history:
        slopes += [np.zeros_like(velocity), history.array("angular_velocity")]
    mass = impact.mass_per_length * 2.0 / history.sides
    gained = (mass * _integral(x, velocity, slope) for slope in slopes)
    return [now - now[0] - given + history.array("total_impulse") for now in gained]


def _second_moment(history: ImpactHistory, missing: Array) -> float | None:
    """``missing`` : of the momentum, N s, slopes by differences, as those here. ``None`` where a layer, viscosity at
    grid scale or N acts, where ends that follow carry moments, and before a plate or a stop, whose moment is small or
    given, and with Maxwell branches, whose stretch is not kept."""
    impact, time = history.impact, history.time
    bent = impact.fourth_derivative or impact.curvature_rate or impact.natural_curvature is not None
    lossy = history.energy("loss_viscous")[-1] != 0.0 or impact.hysteretic_loss
    if not _keeps_momentum(history) or lossy or impact.wall_in_part or impact.axial_force:
        return None
    turning = "slope" if impact.shear_stiffness is None else "angle"
    if (bent and _ends_follow(history)) or history.is_arc or turning not in history:
        return None
    x, both = history.positions(0), 2.0 / history.sides
    angles = history.array(turning) + impact.curvature * x
    turn = both * angles[:, -1] - (angles[:, 0] if history.sides == 2 else 0.0)
    turned, coarser = _integral_over(time, turn), _integral_over(time[::2], turn[::2])
    force = impact.load_within(0.5 * history.modelled_length, 2) * time
    force -= 2.0 * impact.bending_stiffness * (turned + impact.damping * (turn - turn[0]))
    impulse = history.array("impulse") - (history.array("opposite_impulse") if "opposite_impulse" in history else 0.0)
    pushed = both * impulse @ history.contact_positions(0) ** 2
    gained = impact.mass_per_length * both * _integral(x, x**2 * history.array("velocity"))
    if "angular_velocity" in history:
        gained += 2.0 * impact.rotary_inertia * both * _integral(x, x * history.array("angular_velocity"))
    # what is missing of the momentum may be missing anywhere, at the ends at the farthest
    unexplained = np.abs(gained - gained[0] - force + pushed) - np.abs(missing).max() * np.square(x).max()
    unexplained -= 2.0 * impact.bending_stiffness * np.abs(turned[::2] - coarser).max()  # what lies between instants
    least = np.abs(history.array("total_impulse")) * np.square(np.diff(x).max())  # a place is known to an element
    if impact.wall_stiffness is not None:
        unexplained -= least / 4.0  # a push between nodes turns them, too
    return _residual(np.maximum(unexplained, 0.0), np.maximum(np.abs(pushed), least))


def _integral_over(time: Array, values: Array) -> Array:
    """From the first of the instants to each of them, by the trapezium rule."""
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(time))])


def _of_fast_part(history: ImpactHistory) -> Array:
    """Missing momentum, N s, by that of z = y₀ − y, of an infinite beam on a mesh that expands with it, both sides."""
    rate, mass = history.impact.free_motion(0.0), history.impact.mass_per_length
    left = []
    for k, t in enumerate(history.time):
        x = history.positions(k)
        left.append(2.0 * mass * _integral(x, rate(x, t, by_t=1) - history.array("velocity", k)))
    return np.asarray(history.array("total_impulse") - np.array(left))


def _points(history: ImpactHistory) -> float | None:
    found = float(history.array("impulse", -1).sum())
    if "opposite_impulse" in history:
        found -= float(history.array("opposite_impulse", -1).sum())
    return _beyond_total(history, 2.0 / history.sides * found)


def _beyond_total(history: ImpactHistory, found: float) -> float | None:
    """An impulse, N s, less J at the end, over the largest |J|; ``None`` without an impulse."""
    total = history.array("total_impulse")
    most = float(np.abs(total).max())
    return (found - float(total[-1])) / most if most > 0.0 else None


def _keeps_momentum(history: ImpactHistory) -> bool:
    """Whether no momentum leaves but through the wall, and nodes stay where they are."""
    absorbs = history.energy("loss_absorbed")[-1] != 0.0
    return "position" not in history and "velocity" in history and not absorbs


def _ends_follow(history: ImpactHistory) -> bool:
    """Whether the ends carry the forces of the free motion, as the run says of its far field or of its ends."""
    far, ends = history.settings.get("far_field"), history.settings.get("ends", "free")
    return ends != "free" or (isinstance(far, dict) and far.get("end") == "following")


def _integral(x: Array, v: Array, slope: Array | None = None) -> Array:
    """∫v dx of piecewise cubics through node values, (…, nodes), and slopes (``None``: by differences)."""
    h = np.diff(x)
    if slope is None:
        slope = np.gradient(v, x, axis=-1, edge_order=2)
    pieces = 0.5 * h * (v[..., 1:] + v[..., :-1]) + h**2 / 12.0 * (slope[..., :-1] - slope[..., 1:])
    return np.asarray(pieces.sum(axis=-1))


def _initial_energy(history: ImpactHistory) -> float | None:
    impact = history.impact
    moving = impact.curvature_rate or impact.rotation or impact.supported  # velocities differ along the beam
    if moving or "position" in history or history.time[0] > 0.0 or history.is_arc:
        return None
    whole = 0.5 * impact.mass_per_length * history.modelled_length * impact.velocity**2
    return float(history.array("kinetic_energy")[0]) / whole - 1.0


def _gap_of_push(history: ImpactHistory) -> float | None:
    """``None`` where contact points are no nodes, nothing pushed, or the wall gives way."""
    if history.impact.wall_stiffness is not None:
        return None
    places, x = history.contact_positions(0), history.positions(0)
    if "contact_position" in history or "position" in history or not np.all(np.isin(places, x)):
        return None
    nodes, first = np.searchsorted(x, places), _late(history, "impulse")
    gains = np.diff(history.array("impulse"), axis=0)
    most, gains = float(gains.max(initial=0.0)), gains[first:]
    if most <= 0.0:
        return None
    fallen = history.impact.velocity * history.time[first + 1 :, None]
    gaps = np.abs(history.array("gap", slice(first + 1, None))[:, nodes]) / fallen
    return float(gaps[gains > LEAST_PUSH * most].max(initial=0.0))
