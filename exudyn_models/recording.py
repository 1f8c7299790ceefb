"""What is read from Exudyn's state after each step, and the history made of it.

Every energy comes from what causes it, so that their sum can be wrong. Over a step from 0 to 1, Δ the change and ¯ the
mean of both ends, q̈ the accelerations in equilibrium with all forces (Mq̈ = f),

    work of any force f            f̄ᵀΔq                   (for the linear elastic forces the change of strain energy)
    taken by the integration       (Mq̈)¯ᵀΔq − Δ(½vᵀMv)    the scheme's own kinematics, without force or stiffness
    lost in the contact            f̄_cᵀΔy_c − Δ(energy in its springs), f_c pushing against y

The total impulse is what the momentum of the modelled beam lacks, exact whatever happens within a step; with held ends
it is the sum of the points' impulses. These pass through the averages that the scheme applies to accelerations.

States are collected after each step and summed up many steps at a time: of the time that a run takes, next to all is
Exudyn's.
"""

from __future__ import annotations

import math
from collections import defaultdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam import ImpactHistory
from bent_beam.bending import end_curvatures
from exudyn_models.arrays import Array
from exudyn_models.contacts import ContactRun
from exudyn_models.elements import Beam
from exudyn_models.geometry import Scaling
from exudyn_models.integrators import Averages
from exudyn_models.sums import Largest, means, of_two_walls, onwards, products

__all__ = ["Recorder"]

Field = tuple[tuple[str, ...], NDArray[Any]]

ROWS = 33  # states that are collected before they are summed up
ENERGIES = ("kinetic_energy", "strain_energy", "contact_energy")
SAVED_SUMS = ("work_of_loads", "loss_viscous", "loss_material", "loss_algorithmic", "loss_wall", "held_impulse")
LARGEST = ("largest_moment", "largest_moment_place", "largest_midspan_moment")
OTHER_SUMS = ("contact_work", "pushed", "load_impulse")


class Recorder:
    """One beam in one Exudyn system, stepped and read.

    record : what is saved, model units, by the names of :mod:`bent_beam.history`.
    sums : totals over all steps that are summed up, model units.
    """

    def __init__(self, beam: Beam, contact: ContactRun, scaling: Scaling, half: bool, averages: Averages) -> None:
        self.averages = averages
        self.beam, self.contact, self.scaling, self.half = beam, contact, scaling, half
        shape, contacts = beam.shape, contact.contact_s.size
        self.wall_y, self.copies = shape.wall_y, 2.0 if half else 1.0
        self.loads = beam.loads()
        self.loaded = bool(self.loads(np.array([0.0, 1.0])).any())
        self.mass = beam.mass_matrix()
        grid, material = (matrix if abs(matrix).max() else None for matrix in beam.damping_matrices())
        self.damping = {"loss_viscous": grid, "loss_material": material}
        self.upward = np.zeros(self.mass.shape[0])
        self.upward[beam.vertical] = 1.0  # the shape functions of deflections add up to one
        self.momentum = np.asarray(self.mass @ self.upward)  # along y, of velocities
        self.record: dict[str, list[Any]] = defaultdict(list)
        self.impulse = np.zeros(contacts)
        self.averaged = np.zeros(contacts)  # contact force after the scheme's averages
        self.rows: list[tuple[float, Array, Array, Array, Array]] = []  # time, q, v, a, contact force; the first is old
        self.pending: list[int] = []  # rows that are saved
        self.largest_pull, self.largest_push = Largest(contacts), Largest(contacts)
        self.sums = {name: np.zeros(()) for name in (*SAVED_SUMS, *OTHER_SUMS)}
        self.total = self.start_stored = self.deepest = 0.0
        self.start_momentum = math.nan
        self.peaks = np.zeros(3)  # of a wall that gives way, see _of_springs
        self.largest = np.zeros(3)  # see _note_moments
        self.fastest = float(np.abs(shape.velocity_y).max())

    def read(self, t: float, solution: tuple[Array, Array] | None = None) -> tuple[Array, Array]:
        """Take the state at ``t``; ``solution``: its q and v, where they have been read already.

        :meth:`sum_up` must follow before any of the sums is used. Raises ``FloatingPointError`` for a state that is
        not finite or has grown a thousandfold.
        """
        data = self.beam.mbs.systemData
        q, v = (data.GetODE2Coordinates(), data.GetODE2Coordinates_t()) if solution is None else solution
        a = data.GetODE2Coordinates_tt()
        if not (math.isfinite(q @ q) and v @ v < (1e3 * self.fastest) ** 2):
            self._check(q, v)
        force, self.active = self.contact.forces(q, v)
        if not self.rows:
            # all contacts are open when Exudyn computes the first accelerations
            force = np.zeros_like(force)
            self.start_momentum = float(v @ self.momentum)
            self.start_stored = self.contact.stored_energy(q)
        elif len(self.rows) == ROWS:
            self.sum_up()
        self.rows.append((t, q, v, a, force))
        return q, v

    def _check(self, q: Array, v: Array) -> None:
        if not (np.isfinite(q).all() and np.isfinite(v).all()):
            raise FloatingPointError("the state is no longer finite")
        if np.abs(v[self.beam.vertical]).max() > 1e3 * self.fastest:
            raise FloatingPointError("velocities have grown a thousandfold: the integration is unstable")

    def save(self, t: float, q: Array, v: Array) -> None:
        """Keep the state last read."""
        beam, record = self.beam, self.record
        record["time"].append(t)
        record["y"].append(beam.deflection(q) - self.wall_y)
        record["velocity"].append(v[beam.vertical])
        record["slope"].append(beam.slope(q) - beam.shape.wall_slope)
        record["in_contact"].append(self.active.copy())
        record["contact_energy"].append(self.contact.stored_energy(q) - self.start_stored)
        self.pending.append(len(self.rows) - 1)

    def sum_up(self) -> None:
        """Sum up what happened in the steps since the last call, and complete the record of the instants among them."""
        if len(self.rows) < 2 and not self.pending:
            return
        time, q, v, a, force = (np.array(column) for column in zip(*self.rows))
        dt = np.diff(time)
        gains = self._of_energy(time, q, v, a) | self._of_contact(dt, q, force)
        gains["loss_wall"] = self._of_dashpots(q, force)
        after = {name: onwards(self.sums[name], gain) for name, gain in gains.items()}
        if self.scaling.impact.wall_stiffness is not None:
            self._of_springs(time, q, force)
        total = self.start_momentum + after["load_impulse"] - v @ self.momentum
        impulse = onwards(self.impulse, self._impulses(dt, q, force, np.diff(total)))
        if self.scaling.impact.supported:
            total = impulse @ self.contact.signs
        self._note_moments(q)
        record = self.record
        record["kinetic_energy"] += self.beam.kinetic_energy(v[self.pending]).tolist()
        record["strain_energy"] += self.beam.strain_energy(q[self.pending]).tolist()
        for k in self.pending:
            record["impulse"].append(impulse[k].copy())
            record["total_impulse"].append(float(total[k]))
            for name in SAVED_SUMS:
                record[name].append(float(after[name][k]))
            stored = record["contact_energy"][len(record["loss_impact"])]
            record["loss_impact"].append(float(after["contact_work"][k]) - stored - record["loss_wall"][-1])
        self.sums = {name: values[-1] for name, values in after.items()}
        self.impulse, self.total = impulse[-1], float(total[-1])
        late = np.flatnonzero(time > 0.01)
        if late.size:
            near = self.contact.nodes  # what lies beyond them is let through
            depth = (q[late][:, self.beam.vertical[near]] - self.wall_y[near]).max(axis=1)
            self.deepest = max(self.deepest, float((depth / time[late]).max()))
        self.pending.clear()
        self.rows = self.rows[-1:]

    def _note_moments(self, q: Array) -> None:
        """Of all states since the saved instant before: the largest bending moment, its place, and the one in the
        middle, model units; kept with each instant that is saved."""
        beam, impact, unit = self.beam, self.scaling.impact, self.scaling.slope / self.scaling.length
        natural = impact.curvature if impact.natural_curvature is None else impact.natural_curvature
        bent = end_curvatures(beam.shape.x, beam.deflection(q) - self.wall_y, beam.slope(q) - beam.shape.wall_slope)
        ends = np.abs(bent + (natural - impact.wall_curvature) / unit)
        nodes = np.pad(ends[..., 0], ((0, 0), (0, 1)))
        nodes[:, 1:] = np.maximum(nodes[:, 1:], ends[..., 1])
        sizes, middle = nodes.max(axis=1), nodes[:, np.argmin(np.abs(beam.shape.s))]
        begin = 1
        for k in [*self.pending, len(q) - 1]:
            for row in range(begin, k + 1):
                if sizes[row] > self.largest[0]:
                    self.largest[:2] = sizes[row], beam.shape.x[np.argmax(nodes[row])]
                self.largest[2] = max(self.largest[2], middle[row])
            if len(self.record["largest"]) < len(self.record["time"]):
                self.record["largest"].append(self.largest.copy())
                self.largest[:] = 0.0
            begin = k + 1

    def _of_energy(self, time: Array, q: Array, v: Array, a: Array) -> dict[str, Array]:
        """Work of the loads, their impulse and the losses in each step, each (steps,)."""
        moved, mean_v = np.diff(q, axis=0), means(v)
        inertia = (self.mass @ a.T).T
        kinetic = products(v, (self.mass @ v.T).T) / 2
        nothing = np.zeros(time.size - 1)
        gains = {
            "loss_algorithmic": (products(moved, inertia[1:]) + products(moved, inertia[:-1])) / 2 - np.diff(kinetic),
            "work_of_loads": nothing,
            "load_impulse": nothing,
        }
        for name, matrix in self.damping.items():
            gains[name] = nothing if matrix is None else products(mean_v, (matrix @ moved.T).T)
        if self.loaded:
            load = means(self.loads(time))
            gains |= {"work_of_loads": products(moved, load), "load_impulse": load @ self.upward * np.diff(time)}
        return gains

    def _of_contact(self, dt: Array, q: Array, force: Array) -> dict[str, Array]:
        """Work and impulses of the contact forces in each step, each (steps,)."""
        mean = means(force)
        places = q[:, self.beam.vertical[self.contact.nodes]]
        pushes = mean * self.contact.signs * dt[:, None]
        pulls = np.minimum(pushes, 0.0)
        if self.contact.held_until:  # no other law pulls
            self.largest_pull.add(-pulls, self.pending)
            self.largest_push.add(pushes, self.pending)
        return {
            "contact_work": products(mean, np.diff(places, axis=0)),
            "held_impulse": pulls.sum(axis=1),
            "pushed": np.maximum(pushes, 0.0).sum(axis=1),
        }

    def _of_dashpots(self, q: Array, force: Array) -> Array:
        """Loss in the dashpots of a wall that gives way in each step, (steps,); of a rigid one nothing."""
        stiffness = self.contact.wall_springs
        if stiffness is None:
            return np.zeros(force.shape[0] - 1)
        depth = q[:, self.beam.vertical[self.contact.nodes]] - self.contact.wall_y
        dashpots = np.where(depth > 0.0, force - stiffness * depth, 0.0)  # which also slow what would pull
        return products(means(dashpots), np.diff(depth, axis=0))

    def _of_springs(self, time: Array, q: Array, force: Array) -> None:
        """Save the largest force on the zone, when, and the largest penetration of all steps so far."""
        depth = np.maximum(q[:, self.beam.vertical[self.contact.nodes]] - self.contact.wall_y, 0.0).max(axis=1)
        for k, pushed in enumerate(force.sum(axis=1)):
            if pushed > self.peaks[0]:
                self.peaks[:2] = pushed, time[k]
            self.peaks[2] = max(self.peaks[2], depth[k])
            if k in self.pending:
                self.record["peaks"].append(self.peaks.copy())

    def _impulses(self, dt: Array, q: Array, force: Array, total: Array) -> Array:
        """Impulse of each contact point in each step, (steps, contacts), ``total`` (steps,) being all of them."""
        gain, self.averaged = self.averages.impulses(force, self.averaged)
        gain *= dt[:, None]
        if self.scaling.impact.supported:  # supports take momentum, too
            return gain
        missing = total - gain.sum(axis=1)  # what acted within the step only, and what the solver left over
        weight = np.abs(gain)
        for free in np.flatnonzero((missing != 0.0) & ~weight.any(axis=1)):
            weight[free, np.argmax(self.contact.depth(q[free + 1]))] = 1.0
        whole = weight.sum(axis=1)
        return np.asarray(gain + (missing / np.where(whole > 0.0, whole, 1.0))[:, None] * weight)

    @property
    def pushed(self) -> float:
        """Impulse of the pushes, summed up so far."""
        return float(self.sums["pushed"])

    @property
    def held(self) -> float:
        """Impulse of the pulls, negative or zero, summed up so far."""
        return float(self.sums["held_impulse"])

    def hold(self) -> dict[str, float | None] | None:
        """Until when (s) contact points may have been held, and the largest pull of one over the largest push, each
        between two saved instants (``None`` without a push); ``None``: never."""
        until = min(self.contact.held_until, self.record["time"][-1]) * self.scaling.end_time
        pull, push = self.largest_pull.value, self.largest_push.value
        return {"until": until, "pull": pull / push if push > 0.0 else None} if until else None

    def history(self, **about: Any) -> ImpactHistory:
        """The record in SI units, of the whole beam where it is a sum."""
        s, shape, front = self.scaling, self.beam.shape, self.contact.signs > 0.0
        saved = {name: np.array(values) for name, values in self.record.items()}
        both = self.copies
        x = shape.x * s.length
        # against the model's wall, which may have a share of the beam's own curvature, but not the real one's
        slope = saved["slope"] * s.slope - s.impact.wall_curvature * (x - s.impact.first_touch)
        along, at_contact, of_time = ("time", "x"), ("time", "contact"), ("time",)
        fields: dict[str, Field] = {
            "gap": (along, -saved["y"] * s.deflection),
            "velocity": (along, saved["velocity"] * s.velocity),
            "slope": (along, slope),
            "impulse": (at_contact, saved["impulse"] * s.impulse),
            "in_contact": (at_contact, saved["in_contact"]),
        }
        for name in ("total_impulse", "held_impulse"):
            fields[name] = of_time, saved[name] * both * s.impulse
        for name in (*ENERGIES, "loss_impact", *SAVED_SUMS[:-1]):
            fields[name] = of_time, saved[name] * both * s.energy
        if "peaks" not in saved:
            del fields["loss_wall"]
        else:
            force, when, depth = saved["peaks"].T
            fields |= {
                "peak_force": (of_time, force * both * s.impulse / s.end_time),
                "peak_force_time": (of_time, when * s.end_time),
                "peak_penetration": (of_time, depth * s.deflection),
                "peak_pressure": (of_time, depth * s.deflection * (s.impact.wall_stiffness or 0.0)),
            }
        largest, moment = saved["largest"].T, s.impact.bending_stiffness * s.slope / s.length
        for name, values, unit in zip(LARGEST, largest, (moment, s.length, moment)):
            fields[name] = of_time, values * unit
        if not front.all():
            fields |= of_two_walls(fields, front)
        return ImpactHistory.build(
            impact=s.impact,
            path="exudyn",
            symmetry="half" if self.half else "full",
            time=saved["time"] * s.end_time,
            x=x,
            contact_x=np.interp(self.contact.contact_s[front], shape.s, shape.x) * s.length,
            fields=fields,
            **about,
        )
