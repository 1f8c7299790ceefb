"""What is read from Exudyn's state after each step, and the history made of it.

Every energy comes from what causes it, so that an error shows: their sum does not close. Over a step from 0 to 1, Δ the
change and ¯ the mean of both ends, q̈ the accelerations in equilibrium with all forces (Mq̈ = f),

    work of any force f            f̄ᵀΔq                   (for the linear elastic forces the change of strain energy)
    taken by the integration       (Mq̈)¯ᵀΔq − Δ(½vᵀMv)    the scheme's own kinematics, without force or stiffness
    lost in the contact            f̄_cᵀΔy_c − Δ(energy in its springs), f_c pushing against y

The total impulse is what the momentum of the modelled beam lacks; with held ends it is the sum of the points' impulses.
That of the contact law passes through the averages that the scheme applies to accelerations. It is kept beside it
(``law_impulse``), so that a wrong force at the wall shows. States are collected after each step and summed up many
steps at a time: a run spends nearly all of its time in Exudyn.
"""

import math
from collections import defaultdict
from typing import Any

import numpy as np

from bent_beam import ImpactHistory
from bent_beam.files import ENERGIES
from exudyn_models.contacts import ContactRun
from exudyn_models.elements import Beam
from exudyn_models.geometry import Array
from exudyn_models.integrators import Averages

ROWS = 33  # states that are collected before they are summed up


def products(first: Array, second: Array) -> Array:
    """Scalar products of the rows."""
    return np.asarray(np.einsum("ij,ij->i", first, second))


def means(rows: Array) -> Array:
    """Of neighbouring rows."""
    return np.asarray((rows[1:] + rows[:-1]) / 2)


def sides(ends: Array) -> tuple[Array, Array]:
    """What the elements left and right of a node say there, each (rows, nodes), 0 beyond the ends of the beam; from
    (rows, elements, 2)."""
    padded = np.pad(ends, ((0, 0), (1, 1), (0, 0)))
    return padded[:, :-1, 1], padded[:, 1:, 0]


def onwards(before: Any, gains: Array) -> Array:
    """Sums after each gain, ``before`` first."""
    return np.asarray(before + np.insert(np.cumsum(gains, axis=0), 0, 0.0, axis=0))


class Recorder:
    """One beam in one Exudyn system, stepped and read.

    copies : how often the whole beam has what is modelled: of a half beam 2.
    record : what is saved, model units, by the names of :mod:`bent_beam.history`.
    sums : totals over all steps that are summed up, model units.
    active : contact points that are closed, (contacts,); pushes : steps so far at whose ends one pushed.
    """

    def __init__(self, beam: Beam, contact: ContactRun, half: bool, averages: Averages) -> None:
        self.beam, self.contact, self.averages = beam, contact, averages
        shape, self.copies = beam.shape, 2.0 if half else 1.0
        self.scaling = scaling = beam.scaling
        # what the bow has been bent by before the first touch
        bent = scaling.impact.unbent_curvature - scaling.impact.curvature
        self.unbent = bent * scaling.length / scaling.slope
        self.momentum = beam.momentum
        self.record: dict[str, list[Any]] = defaultdict(list)
        self.sums: dict[str, Any] = defaultdict(float)
        self.total = self.deepest = self.start_momentum = self.start_stored = 0.0
        driven = scaling.amplitude * scaling.motion_of(scaling.beam_kappa)(shape.s - shape.first_touch, 1.0, by_t=1)
        fastest = max(np.abs(shape.velocity_y).max(), np.abs(driven).max())  # at first, by loads in the end
        self.fastest = float(fastest) + scaling.amplitude * scaling.pushed
        self.pushes = 0
        self._averaged = np.zeros(contact.nodes.size)  # contact force after the scheme's averages
        self._rows: list[tuple[Any, ...]] = []  # time, q, v, a, contact force, that along x, active; the first is old
        self._pending: list[int] = []  # rows that are saved
        self._largest: dict[str, Array] = {}  # see _keep_largest

    def read(self, t: float) -> tuple[Array, Array]:
        """Take the state at ``t``: q and v. :meth:`sum_up` must follow before any of the sums is used.

        Raises ``FloatingPointError`` for a state that is not finite or has grown a thousandfold.
        """
        data = self.beam.mbs.systemData
        q, v, a = data.GetODE2Coordinates(), data.GetODE2Coordinates_t(), data.GetODE2Coordinates_tt()
        if not math.isfinite(q @ q + v @ v):
            raise FloatingPointError("the state is no longer finite")
        if np.abs(v[self.beam.vertical]).max() > 1e3 * self.fastest:
            raise FloatingPointError("velocities have grown a thousandfold: the integration is unstable")
        force, self.active = self.contact.forces(q, v)
        along = self.contact.along
        if not self._rows:
            # all contacts are open when Exudyn computes the first accelerations
            force, along = np.zeros_like(force), np.zeros_like(along)
            self.start_momentum = float(v @ self.momentum)
            self.start_stored = self.contact.stored_energy(q)
        else:
            self.pushes += bool(force.any() or self._rows[-1][4].any())
            if len(self._rows) == ROWS:
                self.sum_up()
        self._rows.append((t, q, v, a, force, along, self.active))
        return q, v

    def whole_beam(self, q: Array, v: Array) -> tuple[Array, Array, Array, float]:
        """x, gap (m) and velocity (m/s) of the nodes, and the energy of the whole beam (J), as
        :class:`bent_beam.free_flight.Separation` asks for them."""
        scaling, beam = self.scaling, self.beam
        return (
            beam.shape.s * scaling.length,
            (beam.shape.wall_y - q[beam.vertical]) * scaling.deflection,
            v[beam.vertical] * scaling.velocity,
            float(beam.kinetic_energy(v) + beam.strain_energy(q)) * scaling.energy * self.copies,
        )

    def save(self, q: Array) -> None:
        """Keep the state last read; the rest of its record follows when it is summed up."""
        self.record["contact_energy"].append(self.contact.stored_energy(q) - self.start_stored)
        self._pending.append(len(self._rows) - 1)

    def sum_up(self) -> None:
        """Sum up what happened in the steps since the last call, and complete the record of the instants among them."""
        if len(self._rows) < 2 and not self._pending:
            return
        time, q, v, a, force, along, active = (np.array(column) for column in zip(*self._rows))
        beam, shape, saved = self.beam, self.beam.shape, self._pending
        gains = self._of_energy(time, q, v, a) | self._of_contact(time, q, v, force, along)
        after = {name: onwards(self.sums[name], gain) for name, gain in gains.items()}
        total = self.start_momentum + after["load_impulse"] - v @ self.momentum
        averaged, self._averaged = self.averages.impulses(force, self._averaged)
        of_law = averaged * np.diff(time)[:, None]  # at each point in each step, (steps, contacts)
        after["law_impulse"] = onwards(self.sums["law_impulse"], of_law.sum(axis=1))
        after["impulse"] = onwards(self.sums["impulse"], self._shared(of_law, q, np.diff(total)))
        if self.scaling.impact.supported:
            total = after["law_impulse"]
        y, slope = q[:, beam.vertical] - shape.wall_y, beam.slope(q) - shape.wall_slope
        left, right = sides(beam.bending_moments(q) + self.unbent)
        now = {"time": time, "y": y, "velocity": v[:, beam.vertical], "slope": slope}
        now |= {"total_impulse": total, "in_contact": active}
        if beam.scaling.shear_length:
            mean = left + right
            mean[:, 1:-1] /= 2.0
            now |= {"angular_velocity": v[:, beam.rotation], "bending_moment": mean}
        for name, values in (after | now).items():
            self.record[name] += [values[k].copy() for k in saved]
        self.record["kinetic_energy"] += beam.kinetic_energy(v[saved]).tolist()
        self.record["strain_energy"] += beam.strain_energy(q[saved]).tolist()
        self.record["stretch_energy"] += beam.stretch_energy(q[saved]).tolist()
        largest = np.maximum(np.abs(left), np.abs(right))
        middle, where = largest[:, np.argmin(np.abs(shape.s))], shape.place[largest.argmax(axis=1)]
        self._keep_largest("moments", largest.max(axis=1), where, middle, anew=True)
        self.sums |= {name: values[-1] for name, values in after.items()}
        self.total = float(total[-1])
        late = time > (0.1 if beam.shears else 0.01)  # its first hits are those of a string
        if late.any():
            depth = y[late][:, self.contact.nodes].max(axis=1)  # what lies beyond them is let through
            self.deepest = max(self.deepest, float((depth / time[late]).max()))
        self._pending, self._rows = [], self._rows[-1:]

    def _keep_largest(self, name: str, sizes: Array, where: Array, *others: Array, anew: bool) -> None:
        """Save with each instant the largest of ``sizes``, ``where`` it was, and the largest of each of ``others``, of
        all steps so far; ``anew``: since the saved instant before. Each of shape (rows,); row 0 is the last step of
        the rows before."""
        rows, begin = np.stack([sizes, where, *others], axis=1), 0
        rows[0] = self._largest.pop(name, 0.0)

        def largest(some: Array) -> Array:
            return np.array([*some[np.argmax(some[:, 0]), :2], *some[:, 2:].max(axis=0)])

        for k in self._pending:
            self.record[name].append(largest(rows[begin : k + 1]))
            begin = k + 1 if anew else 0
        if begin < len(rows):
            self._largest[name] = largest(rows[begin:])

    def _of_energy(self, time: Array, q: Array, v: Array, a: Array) -> dict[str, Array]:
        """Work of the loads, their impulse and the losses in each step, each (steps,)."""
        moved, inertia = np.diff(q, axis=0), (self.beam.mass @ a.T).T
        kinetic, load = self.beam.kinetic_energy(v), means(self.beam.loads(time))
        viscous, material = self.beam.damping_work(q, v)
        return {
            "loss_algorithmic": (products(moved, inertia[1:]) + products(moved, inertia[:-1])) / 2 - np.diff(kinetic),
            "work_of_loads": products(moved, load),
            "load_impulse": load @ self.beam.upward * np.diff(time),
            "loss_viscous": viscous,
            "loss_material": material,
        }

    def _of_contact(self, time: Array, q: Array, v: Array, force: Array, along: Array) -> dict[str, Array]:
        """Work, losses and impulses of the contact forces in each step, each (steps,)."""
        mean, contact = means(force), self.contact
        depth = q[:, contact.coordinates] - contact.wall_y
        deeper = np.diff(depth, axis=0)
        pushes = mean * contact.signs * np.diff(time)[:, None]
        moved = np.diff(q[:, self.beam.horizontal[contact.nodes]], axis=0)
        work = products(mean, deeper) - products(means(along), moved)
        gains = {"contact_work": work, "held_impulse": np.minimum(pushes, 0.0).sum(axis=1)}
        if contact.held_until:  # no other law pulls
            gains |= {"pulls": np.maximum(-pushes, 0.0), "pushes": pushes}
        if contact.wall_springs is not None:
            s, speed = self.scaling, v[:, contact.coordinates]
            delay = s.impact.wall_damping / (s.impact.wall_stiffness or math.inf) / s.end_time  # c/k
            landing = np.pad(contact.landing(depth, speed), ((1, 0), (0, 0)))
            pressure = np.maximum(np.where(depth > 0.0, depth + delay * speed, 0.0), landing / contact.wall_springs)
            deepest, whole, landed = np.maximum(depth, 0.0).max(axis=1), force.sum(axis=1), landing.sum(axis=1)
            when = np.where(landed > whole, np.roll(time, 1), time)  # as a step begins
            self._keep_largest("peaks", np.maximum(whole, landed), when, deepest, pressure.max(axis=1), anew=False)
            dashpots = np.where(depth > 0.0, force - contact.wall_springs * depth, 0.0)  # also slow what would pull
            gains["loss_wall"] = products(means(dashpots), deeper)
        return gains

    def _shared(self, gain: Array, q: Array, total: Array) -> Array:
        """``gain`` of each contact point in each step, (steps, contacts). What its sum lacks of ``total``, (steps,), is
        shared among those that push: an explicit scheme has forces within its steps, too."""
        if self.scaling.impact.supported:  # supports take momentum, too
            return gain
        missing = total - gain.sum(axis=1)
        weight = np.abs(gain)
        for free in np.flatnonzero((missing != 0.0) & ~weight.any(axis=1)):
            weight[free, np.argmax(self.contact.depth(q[free + 1]))] = 1.0
        whole = weight.sum(axis=1)
        return np.asarray(gain + (missing / np.where(whole > 0.0, whole, 1.0))[:, None] * weight)

    def hold(self) -> dict[str, float | None] | None:
        """Until when (s) contact points may have been held, and the largest pull of one over the largest push, each
        between two saved instants (``None`` without a push); ``None``: never."""
        until = min(self.contact.held_until, self.record["time"][-1]) * self.scaling.end_time
        if not until:
            return None
        pull, push = (float(np.diff(self.record[n], axis=0).max(initial=0.0)) for n in ("pulls", "pushes"))
        return {"until": until, "pull": pull / push if push > 0.0 else None}

    def history(self, **about: Any) -> ImpactHistory:
        """The record in SI units, of the whole beam where it is a sum."""
        s, shape, front = self.scaling, self.beam.shape, self.contact.signs > 0.0
        saved = {name: np.array(values) for name, values in self.record.items()}
        if not self.pushes:  # what balances of momentum leave is round-off
            saved |= {name: np.zeros_like(saved[name]) for name in ("total_impulse", "law_impulse", "impulse")}
        saved["loss_impact"] = saved["contact_work"] - saved["contact_energy"] - saved.get("loss_wall", 0.0)
        # an axial force is a load: the stretch that it keeps in the beam is none of its work, nor energy of the bending
        saved["work_of_loads"] = saved["work_of_loads"] - saved["stretch_energy"] + saved["stretch_energy"][0]
        x, moment = shape.place * s.length, s.impact.bending_stiffness * s.slope / s.length
        # against the model's wall, which may have a share of the beam's own curvature, but not the real one's
        slope = saved["slope"] * s.slope - s.impact.wall_curvature * (x - s.impact.first_touch)
        at_nodes = {"gap": -saved["y"] * s.deflection, "velocity": saved["velocity"] * s.velocity}
        if s.impact.shear_stiffness is None:
            at_nodes["slope"] = slope
        else:
            units = {"angular_velocity": s.slope / s.end_time, "bending_moment": moment}
            at_nodes |= {"angle": slope} | {name: saved[name] * unit for name, unit in units.items()}
        impulse, active = saved["impulse"] * s.impulse, saved["in_contact"]
        at_contact = {"impulse": impulse[:, front], "in_contact": active[:, front]}
        if not front.all():  # contact points of the opposite wall follow those of the front
            at_contact["opposite_impulse"] = -impulse[:, ~front]
            at_contact["in_contact"] |= active[:, ~front]
        of_time = {n: saved[n] * self.copies * s.impulse for n in ("total_impulse", "law_impulse", "held_impulse")}
        of_time |= {name: saved[name] * self.copies * s.energy for name in ENERGIES if name in saved}
        largest, place, midspan = saved["moments"].T
        of_time |= {"largest_moment": largest * moment, "largest_moment_place": place * s.length}
        of_time |= {"largest_midspan_moment": midspan * moment}
        if s.impact.wall_stiffness is not None:
            force, when, depth, pressure = saved["peaks"].T
            of_time |= {
                "peak_force": force * self.copies * s.impulse / s.end_time,
                "peak_force_time": when * s.end_time,
                "peak_penetration": depth * s.deflection,
                "peak_pressure": pressure * s.deflection * s.impact.wall_stiffness,
            }
        groups = ((("time", "x"), at_nodes), (("time", "contact"), at_contact), (("time",), of_time))
        return ImpactHistory.build(
            impact=s.impact,
            path="exudyn",
            symmetry="half" if self.copies == 2.0 else "full",
            time=saved["time"] * s.end_time,
            x=x,
            contact_x=x[self.contact.nodes[front]],
            fields={name: (dims, values) for dims, group in groups for name, values in group.items()},
            **about,
        )
