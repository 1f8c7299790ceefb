"""What is read from Exudyn's state after each step, and the history made of it.

Every energy comes from what causes it, so that their sum can be wrong. Over a step from 0 to 1, Δ the change and ¯ the
mean of both ends, q̈ the accelerations in equilibrium with all forces (Mq̈ = f),

    work of any force f            f̄ᵀΔq                   (for the linear elastic forces the change of strain energy)
    taken by the integration       (Mq̈)¯ᵀΔq − v̄ᵀMΔv       the scheme's own kinematics, without force or stiffness
    lost in the contact            f̄_cᵀΔy_c − Δ(energy in its springs), f_c pushing against y

The total impulse is what the momentum of the modelled beam lacks: exact, whatever happens within a step. The impulse of
each contact point passes through the averages that the scheme applies to accelerations; their sum is that total.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from bent_beam import ImpactHistory
from exudyn_models.contacts import ContactRun
from exudyn_models.elements import Beam
from exudyn_models.integrators import Averages
from exudyn_models.scaling import Scaling

__all__ = ["Recorder"]

Array = NDArray[np.float64]


@dataclass
class Record:
    """What is saved; everything in model units."""

    time: list[float] = field(default_factory=list)
    y: list[Array] = field(default_factory=list)
    v: list[Array] = field(default_factory=list)
    slope: list[Array] = field(default_factory=list)
    impulse: list[Array] = field(default_factory=list)
    active: list[NDArray[np.bool_]] = field(default_factory=list)
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


class _State(NamedTuple):
    q: Array
    v: Array
    inertia: Array  # Mq̈
    momenta: Array  # Mv
    force: Array  # of the contact points
    places: Array  # of the contact points, along the force


class Recorder:
    """One beam in one Exudyn system, stepped and read."""

    def __init__(self, beam: Beam, contact: ContactRun, scaling: Scaling, half: bool, averages: Averages) -> None:
        self.averages = averages
        self.beam, self.contact, self.scaling, self.half = beam, contact, scaling, half
        shape = beam.shape
        self.wall_y = shape.wall_y
        self.loads = beam.loads()
        self.mass = beam.mass_matrix()
        self.grid, self.material = (matrix if abs(matrix).max() else None for matrix in beam.damping_matrices())
        self.upward = np.zeros(self.mass.shape[0])
        self.upward[beam.vertical] = 1.0
        self.record = Record()
        self.impulse = np.zeros(contact.contact_s.size)
        self.averaged = np.zeros(contact.contact_s.size)  # contact force after the scheme's averages
        self.previous: _State | None = None
        self.contact_work = self.grid_loss = self.material_loss = self.algorithmic_loss = 0.0
        self.held = self.pushed = self.work = self.total = 0.0
        self.start_stored = 0.0
        self.start_momentum = math.nan
        self.load_impulse = 0.0
        self.deepest = 0.0
        self.fastest = float(np.abs(shape.velocity_y).max())
        self.load: Array = self.loads(0.0)

    def read(self, t: float, dt: float) -> tuple[Array, Array]:
        """Take the state at ``t``, ``dt`` after the last one, and sum up what happened in between."""
        data = self.beam.mbs.systemData
        q, v, a = data.GetODE2Coordinates(), data.GetODE2Coordinates_t(), data.GetODE2Coordinates_tt()
        if not (np.isfinite(q).all() and np.isfinite(v).all()):
            raise FloatingPointError("the state is no longer finite")
        if np.abs(v[self.beam.vertical]).max() > 1e3 * self.fastest:
            raise FloatingPointError("velocities have grown a thousandfold: the integration is unstable")
        force, self.active = self.contact.forces(q, v)
        momenta = self.mass @ v
        momentum = float(momenta[self.beam.vertical].sum())  # the shape functions of deflections add up to one
        new = _State(q, v, self.mass @ a, momenta, force, q[self.beam.vertical[self.contact.nodes]])
        load = self.loads(t)
        if self.previous is None:
            # all contacts are open when Exudyn computes the first accelerations
            new = new._replace(force=np.zeros_like(force))
            self.start_momentum = momentum
            self.start_stored = self.contact.stored_energy(q)
        else:
            old = self.previous
            moved, mean_v = q - old.q, (v + old.v) / 2
            self.algorithmic_loss += float(
                moved @ (old.inertia + new.inertia) / 2 - mean_v @ (new.momenta - old.momenta)
            )
            if self.grid is not None:
                self.grid_loss += float(mean_v @ (self.grid @ moved))
            if self.material is not None:
                self.material_loss += float(mean_v @ (self.material @ moved))
            self.work += float(moved @ (self.load + load) / 2)
            self.contact_work += float((force + old.force) @ (new.places - old.places) / 2)
            self.load_impulse += float(self.upward @ (self.load + load)) * dt / 2
            gain, self.averaged = self.averages.impulse(old.force, force, self.averaged)
            gain = gain * dt
            total = self.start_momentum + self.load_impulse - momentum
            missing = total - self.total - gain.sum()
            if missing:  # what acted within the step only, and what the solver left over
                weight = np.abs(gain)
                if not weight.any():
                    weight[np.argmax(self.contact.depth(q))] = 1.0
                gain = gain + missing * weight / weight.sum()
            self.impulse += gain
            self.total = total
            both = (old.force + force) * self.contact.signs * (dt / 2)
            self.held += float(np.minimum(both, 0.0).sum())
            self.pushed += float(np.maximum(both, 0.0).sum())
        self.previous, self.load = new, load
        if t > 0.01:
            self.deepest = max(self.deepest, float((self.beam.deflection(q) - self.wall_y).max()) / t)
        return q, v

    def save(self, t: float, q: Array, v: Array) -> None:
        r, beam = self.record, self.beam
        stored = self.contact.stored_energy(q) - self.start_stored
        r.time.append(t)
        r.y.append(beam.deflection(q) - self.wall_y)
        r.v.append(v[beam.vertical].copy())
        r.slope.append(beam.slope(q) - beam.shape.wall_slope)
        r.impulse.append(self.impulse.copy())
        r.active.append(self.active.copy())
        r.total.append(self.total)
        r.kinetic.append(beam.kinetic_energy(v))
        r.strain.append(beam.strain_energy(q))
        r.stored.append(stored)
        r.work.append(self.work)
        r.contact_loss.append(self.contact_work - stored)
        r.grid_loss.append(self.grid_loss)
        r.material_loss.append(self.material_loss)
        r.algorithmic_loss.append(self.algorithmic_loss)
        r.held.append(self.held)

    def hold(self) -> dict[str, float] | None:
        """Until when (s) contact points may have been held, and what they pulled over what was pushed; None: never."""
        until = min(self.contact.held_until, self.record.time[-1]) * self.scaling.end_time
        return {"until": until, "pull": -self.held / self.pushed if self.pushed else 0.0} if until else None

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
            "slope": (("time", "x"), np.array(r.slope) * s.slope),
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
        return ImpactHistory.build(
            path="exudyn",
            symmetry="half" if self.half else "full",
            time=np.array(r.time) * s.end_time,
            x=self.beam.shape.x * s.length,
            contact_x=place * s.length,
            fields=fields,
            **about,
        )

    def _of_two_walls(self, front: NDArray[np.bool_]) -> dict[str, tuple[tuple[str, ...], NDArray[Any]]]:
        """What the two walls gave, apart; contact points of the ``front`` wall come first, then the opposite's."""
        impulse = np.array(self.record.impulse) * self.scaling.impulse
        active = np.array(self.record.active)
        dims = ("time", "contact")
        return {
            "impulse": (dims, impulse[:, front]),
            "opposite_impulse": (dims, -impulse[:, ~front]),
            "in_contact": (dims, active[:, front] | active[:, ~front]),
        }
