"""What is read from Exudyn's state after each step, and the history made of it.

Every energy comes from what causes it, so that their sum can be wrong. Over a step from 0 to 1, Δ the change and ¯ the
mean of both ends, q̈ the accelerations in equilibrium with all forces (Mq̈ = f),

    work of any force f            f̄ᵀΔq                   (for the linear elastic forces the change of strain energy)
    taken by the integration       (Mq̈)¯ᵀΔq − Δ(½vᵀMv)    the scheme's own kinematics, without force or stiffness
    lost in the contact            f̄_cᵀΔy_c − Δ(energy in its springs), f_c pushing against y

The total impulse is what the momentum of the modelled beam lacks: exact, whatever happens within a step. The impulse of
each contact point passes through the averages that the scheme applies to accelerations; their sum is that total.

States are collected after each step and summed up many steps at a time: of the time that a run takes, next to all is
Exudyn's.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam import ImpactHistory
from exudyn_models.arrays import Array, Flags
from exudyn_models.contacts import ContactRun
from exudyn_models.elements import Beam
from exudyn_models.integrators import Averages
from exudyn_models.scaling import Scaling

__all__ = ["Recorder"]


ROWS = 33  # states that are collected before they are summed up


def _products(first: Array, second: Array) -> Array:
    """Scalar products of the rows."""
    return np.asarray(np.einsum("ij,ij->i", first, second))


def _onwards(before: Array, gains: Array) -> Array:
    """Sums after each gain, the last of ``before`` first."""
    last = before[-1:] if before.ndim == gains.ndim else before[None]
    return np.concatenate([last, last + np.cumsum(gains, axis=0)])


def _means(rows: Array) -> Array:
    """Of neighbouring rows."""
    return np.asarray((rows[1:] + rows[:-1]) / 2)


@dataclass
class Record:
    """What is saved; everything in model units."""

    time: list[float] = field(default_factory=list)
    y: list[Array] = field(default_factory=list)
    v: list[Array] = field(default_factory=list)
    slope: list[Array] = field(default_factory=list)
    impulse: list[Array] = field(default_factory=list)
    active: list[Flags] = field(default_factory=list)
    total: list[float] = field(default_factory=list)
    kinetic: list[float] = field(default_factory=list)
    strain: list[float] = field(default_factory=list)
    stored: list[float] = field(default_factory=list)
    work: list[float] = field(default_factory=list)
    contact_loss: list[float] = field(default_factory=list)
    grid_loss: list[float] = field(default_factory=list)
    material_loss: list[float] = field(default_factory=list)
    algorithmic_loss: list[float] = field(default_factory=list)
    held: list[float] = field(default_factory=list)


class _Steps:
    """States after the steps that are not summed up yet; row 0 is the last one that is. In model units.

    time (rows,); q, v, a : coordinates, velocities, accelerations, (rows, coordinates); force : of the contact points,
    (rows, contacts). filled : rows in use.
    """

    def __init__(self, coordinates: int, contacts: int) -> None:
        self.time = np.zeros(ROWS)
        self.q, self.v, self.a = (np.zeros((ROWS, coordinates)) for _ in range(3))
        self.force = np.zeros((ROWS, contacts))
        self.filled = 0

    def append(self, time: float, q: Array, v: Array, a: Array, force: Array) -> None:
        k = self.filled
        self.time[k], self.q[k], self.v[k], self.a[k], self.force[k] = time, q, v, a, force
        self.filled = k + 1

    def forget(self) -> None:
        """All but the last row."""
        last = self.filled - 1
        for rows in (self.time, self.q, self.v, self.a, self.force):
            rows[0] = rows[last]
        self.filled = 1


class _Largest:
    """The largest gain of any contact point between two saved instants."""

    def __init__(self, contacts: int) -> None:
        self.now, self.saved = np.zeros(contacts), np.zeros(contacts)
        self.value = 0.0

    def add(self, gains: Array, saved: list[int]) -> None:
        """What the points gained in more steps, (steps, contacts), and after how many of these was saved."""
        sums = _onwards(self.now, gains)
        kept = np.concatenate([self.saved[None], sums[saved]])
        self.value = max(self.value, float(np.diff(kept, axis=0).max(initial=0.0)))
        self.now, self.saved = sums[-1], kept[-1]


class Recorder:
    """One beam in one Exudyn system, stepped and read."""

    def __init__(self, beam: Beam, contact: ContactRun, scaling: Scaling, half: bool, averages: Averages) -> None:
        self.averages = averages
        self.beam, self.contact, self.scaling, self.half = beam, contact, scaling, half
        shape = beam.shape
        self.wall_y = shape.wall_y
        self.loads = beam.loads()
        self.loaded = bool(self.loads(np.array([0.0, 1.0])).any())
        self.mass = beam.mass_matrix()
        self.grid, self.material = (matrix if abs(matrix).max() else None for matrix in beam.damping_matrices())
        self.upward = np.zeros(self.mass.shape[0])
        self.upward[beam.vertical] = 1.0  # the shape functions of deflections add up to one
        self.momentum = np.asarray(self.mass @ self.upward)  # along y, of velocities
        self.record = Record()
        self.impulse = np.zeros(contact.contact_s.size)
        self.averaged = np.zeros(contact.contact_s.size)  # contact force after the scheme's averages
        self.steps = _Steps(self.mass.shape[0], contact.contact_s.size)
        self.largest_pull, self.largest_push = (_Largest(contact.contact_s.size) for _ in range(2))
        names = ("work", "contact_work", "grid_loss", "material_loss", "algorithmic_loss", "held", "pushed")
        self.sums = {name: np.zeros(1) for name in names}
        self.pending: list[int] = []  # rows of ``steps`` that are saved
        self.total = self.start_stored = 0.0
        self.start_momentum = math.nan
        self.load_impulse = np.zeros(1)
        self.deepest = 0.0
        self.fastest = float(np.abs(shape.velocity_y).max())

    def read(self, t: float, solution: tuple[Array, Array] | None = None) -> tuple[Array, Array]:
        """Take the state at ``t``; ``solution``: its q and v, where they have been read already.

        :meth:`sum_up` must follow before any of the sums is used.
        """
        data = self.beam.mbs.systemData
        q, v = (data.GetODE2Coordinates(), data.GetODE2Coordinates_t()) if solution is None else solution
        a = data.GetODE2Coordinates_tt()
        if not (math.isfinite(q @ q) and v @ v < (1e3 * self.fastest) ** 2):
            self._check(q, v)
        force, self.active = self.contact.forces(q, v)
        if not self.steps.filled:
            # all contacts are open when Exudyn computes the first accelerations
            force = np.zeros_like(force)
            self.start_momentum = float(v @ self.momentum)
            self.start_stored = self.contact.stored_energy(q)
        elif self.steps.filled == ROWS:
            self.sum_up()
        self.steps.append(t, q, v, a, force)
        return q, v

    def _check(self, q: Array, v: Array) -> None:
        if not (np.isfinite(q).all() and np.isfinite(v).all()):
            raise FloatingPointError("the state is no longer finite")
        if np.abs(v[self.beam.vertical]).max() > 1e3 * self.fastest:
            raise FloatingPointError("velocities have grown a thousandfold: the integration is unstable")

    def sum_up(self) -> None:
        """Sum up what happened in the steps since the last call, and complete the record of the instants among them."""
        taken, rows = self.steps, self.steps.filled
        if rows < 2 and not self.pending:
            return
        time, q, v, a, force = (x[:rows] for x in (taken.time, taken.q, taken.v, taken.a, taken.force))
        dt = np.diff(time)
        moved, mean_v = np.diff(q, axis=0), _means(v)
        sums = self.sums
        inertia = (self.mass @ a.T).T
        kinetic = _products(v, (self.mass @ v.T).T) / 2
        algorithmic = (_products(moved, inertia[1:]) + _products(moved, inertia[:-1])) / 2 - np.diff(kinetic)
        sums["algorithmic_loss"] = _onwards(sums["algorithmic_loss"], algorithmic)
        for name, matrix in (("grid_loss", self.grid), ("material_loss", self.material)):
            lost = np.zeros_like(dt) if matrix is None else _products(mean_v, (matrix @ moved.T).T)
            sums[name] = _onwards(sums[name], lost)
        worked = pressed = np.zeros_like(dt)
        if self.loaded:
            load = _means(self.loads(time))
            worked, pressed = _products(moved, load), load @ self.upward * dt
        sums["work"] = _onwards(sums["work"], worked)
        self.load_impulse = _onwards(self.load_impulse, pressed)
        total = self.start_momentum + self.load_impulse - v @ self.momentum
        means = _means(force)
        places = q[:, self.beam.vertical[self.contact.nodes]]
        sums["contact_work"] = _onwards(sums["contact_work"], _products(means, np.diff(places, axis=0)))
        pushes = means * self.contact.signs * dt[:, None]
        sums["held"] = _onwards(sums["held"], np.minimum(pushes, 0.0).sum(axis=1))
        sums["pushed"] = _onwards(sums["pushed"], np.maximum(pushes, 0.0).sum(axis=1))
        if self.contact.held_until:  # no other law pulls
            self.largest_pull.add(-np.minimum(pushes, 0.0), self.pending)
            self.largest_push.add(pushes, self.pending)
        impulse = _onwards(self.impulse, self._gains(dt, q, force, np.diff(total)))
        record = self.record
        record.kinetic += self.beam.kinetic_energy(v[self.pending]).tolist()
        record.strain += self.beam.strain_energy(q[self.pending]).tolist()
        for k in self.pending:
            record.impulse.append(impulse[k].copy())
            record.total.append(float(total[k]))
            for name in ("work", "grid_loss", "material_loss", "algorithmic_loss", "held"):
                getattr(record, name).append(float(sums[name][k]))
            record.contact_loss.append(float(sums["contact_work"][k]) - record.stored[len(record.contact_loss)])
        self.pending.clear()
        self.impulse, self.total, self.load_impulse = impulse[-1], float(total[-1]), self.load_impulse[-1:]
        for name in sums:
            sums[name] = sums[name][-1:]
        late = np.flatnonzero(time > 0.01)
        if late.size:
            depth = (q[late][:, self.beam.vertical] - self.wall_y).max(axis=1)
            self.deepest = max(self.deepest, float((depth / time[late]).max()))
        taken.forget()

    def _gains(self, dt: Array, q: Array, force: Array, total: Array) -> Array:
        """Impulse of each contact point in each step, (steps, contacts), ``total`` (steps,) being all of them."""
        gain, self.averaged = self.averages.impulses(force, self.averaged)
        gain *= dt[:, None]
        missing = total - gain.sum(axis=1)  # what acted within the step only, and what the solver left over
        weight = np.abs(gain)
        for free in np.flatnonzero((missing != 0.0) & ~weight.any(axis=1)):
            weight[free, np.argmax(self.contact.depth(q[free + 1]))] = 1.0
        whole = weight.sum(axis=1)
        return np.asarray(gain + (missing / np.where(whole > 0.0, whole, 1.0))[:, None] * weight)

    @property
    def pushed(self) -> float:
        """Impulse of the pushes, summed up so far."""
        return float(self.sums["pushed"][-1])

    @property
    def held(self) -> float:
        """Impulse of the pulls, negative or zero, summed up so far."""
        return float(self.sums["held"][-1])

    def save(self, t: float, q: Array, v: Array) -> None:
        """Keep the state last read."""
        r, beam = self.record, self.beam
        r.time.append(t)
        r.y.append(beam.deflection(q) - self.wall_y)
        r.v.append(v[beam.vertical].copy())
        r.slope.append(beam.slope(q) - beam.shape.wall_slope)
        r.active.append(self.active.copy())
        r.stored.append(self.contact.stored_energy(q) - self.start_stored)
        self.pending.append(self.steps.filled - 1)

    def hold(self) -> dict[str, float | None] | None:
        """Until when (s) contact points may have been held, and the largest pull of one over the largest push, each
        between two saved instants (``None`` without a push); ``None``: never."""
        until = min(self.contact.held_until, self.record.time[-1]) * self.scaling.end_time
        pull, push = self.largest_pull.value, self.largest_push.value
        return {"until": until, "pull": pull / push if push > 0.0 else None} if until else None

    def history(self, **about: Any) -> ImpactHistory:
        """The record in SI units, of the whole beam where it is a sum."""
        r, s = self.record, self.scaling
        both = 2.0 if self.half else 1.0
        energies = {
            "kinetic_energy": r.kinetic,
            "strain_energy": r.strain,
            "contact_energy": r.stored,
            "work_of_loads": r.work,
            "loss_impact": r.contact_loss,
            "loss_viscous": r.grid_loss,
            "loss_material": r.material_loss,
            "loss_algorithmic": r.algorithmic_loss,
        }
        fields: dict[str, tuple[tuple[str, ...], NDArray[Any]]] = {
            "gap": (("time", "x"), -np.array(r.y) * s.deflection),
            "velocity": (("time", "x"), np.array(r.v) * s.velocity),
            "impulse": (("time", "contact"), np.array(r.impulse) * s.impulse),
            "in_contact": (("time", "contact"), np.array(r.active)),
            "total_impulse": (("time",), np.array(r.total) * both * s.impulse),
            "held_impulse": (("time",), np.array(r.held) * both * s.impulse),
        }
        fields |= {name: (("time",), np.array(values) * both * s.energy) for name, values in energies.items()}
        front = self.contact.signs > 0.0
        if not front.all():
            fields |= self._of_two_walls(front)
        place = np.interp(self.contact.contact_s[front], self.beam.shape.s, self.beam.shape.x)
        x = self.beam.shape.x * s.length
        # against the model's wall, which may have a share of the beam's own curvature, but not the real one's
        slope = np.array(r.slope) * s.slope - s.impact.wall_curvature * (x - s.impact.first_touch)
        return ImpactHistory.build(
            path="exudyn",
            symmetry="half" if self.half else "full",
            time=np.array(r.time) * s.end_time,
            x=x,
            contact_x=place * s.length,
            fields=fields | {"slope": (("time", "x"), slope)},
            **about,
        )

    def _of_two_walls(self, front: Flags) -> dict[str, tuple[tuple[str, ...], NDArray[Any]]]:
        """What the two walls gave, apart; contact points of the ``front`` wall come first, then the opposite's."""
        impulse = np.array(self.record.impulse) * self.scaling.impulse
        active = np.array(self.record.active)
        dims = ("time", "contact")
        return {
            "impulse": (dims, impulse[:, front]),
            "opposite_impulse": (dims, -impulse[:, ~front]),
            "in_contact": (dims, active[:, front] | active[:, ~front]),
        }
