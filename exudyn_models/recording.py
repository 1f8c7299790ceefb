"""What is read from Exudyn's state between segments of steps, and the history made of it.

The total impulse is what the momentum of the modelled beam lacks: it is exact, whatever happens within a step. The
impulse of each contact point is the trapezoidal sum of its force, corrected to that total.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam import ImpactHistory
from exudyn_models.contacts import ContactRun
from exudyn_models.elements import Beam
from exudyn_models.scaling import Scaling

__all__ = ["Recorder"]

Array = NDArray[np.float64]


@dataclass
class Record:
    """What is read between segments; everything in model units."""

    time: list[float] = field(default_factory=list)
    y: list[Array] = field(default_factory=list)
    v: list[Array] = field(default_factory=list)
    slope: list[Array] = field(default_factory=list)
    impulse: list[Array] = field(default_factory=list)
    active: list[NDArray[np.bool_]] = field(default_factory=list)
    total: list[float] = field(default_factory=list)
    kinetic: list[float] = field(default_factory=list)
    strain: list[float] = field(default_factory=list)
    work: list[float] = field(default_factory=list)
    contact_loss: list[float] = field(default_factory=list)
    viscous_loss: list[float] = field(default_factory=list)
    held: list[float] = field(default_factory=list)


class Recorder:
    """One beam in one Exudyn system, stepped and read."""

    def __init__(self, beam: Beam, contact: ContactRun, scaling: Scaling, half: bool, newer: float) -> None:
        self.newer = newer  # share of the newer force in the impulse between two readings
        self.beam, self.contact, self.scaling, self.half = beam, contact, scaling, half
        shape, a = beam.shape, scaling.amplitude
        self.load = scaling.load * a
        self.wall_y = shape.wall_curvature * shape.s**2 / 2
        # constant forces along y: the uniform load and the end shears, −q₀x at +x and +q₀x at −x
        length = float(beam.lengths.sum())
        self.shear = a * scaling.psi * shape.s[-1]
        self.force = self.load * length - self.shear * (1.0 if half else 2.0)
        self.record = Record()
        self.impulse = np.zeros(contact.contact_s.size)
        self.previous: tuple[Array, Array, float, float] | None = None
        self.contact_loss = self.viscous_loss = self.held = self.work = 0.0
        self.total = 0.0
        self.start_momentum = math.nan
        self.deepest = 0.0
        self.fastest = float(np.abs(shape.velocity_y).max())

    def read(self, t: float, dt: float) -> tuple[Array, Array]:
        """Take the state at ``t``, ``dt`` after the last one, and integrate what is integrated over time."""
        data = self.beam.mbs.systemData
        q, v = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
        if not (np.isfinite(q).all() and np.isfinite(v).all()):
            raise FloatingPointError("the state is no longer finite")
        if np.abs(v[self.beam.vertical]).max() > 1e3 * self.fastest:
            raise FloatingPointError("velocities have grown a thousandfold: the integration is unstable")
        force, active = self.contact.forces(q, v)
        momentum = self.beam.momentum(v)
        viscous = self.beam.viscous_power(q, v)
        power = self._load_power(t, q, v)
        points = self.contact.velocity(q, v)
        if self.previous is None:
            self.start_momentum = momentum
        else:
            old_force, old_velocity, old_viscous, old_power = self.previous
            gain = ((1.0 - self.newer) * old_force + self.newer * force) * dt
            total = self.start_momentum + self.force * t - momentum
            weight = np.abs(gain)
            missing = total - self.total - gain.sum()
            if not weight.any():  # what acted within the segment only: at the deepest point
                weight[np.argmax(self.contact.depth(q))] = 1.0
            gain = gain + missing * weight / weight.sum()
            self.impulse += gain
            self.total = total
            self.held += np.minimum(gain, 0.0).sum()
            self.contact_loss += float((force * points + old_force * old_velocity).sum() * dt / 2)
            self.viscous_loss += (viscous + old_viscous) * dt / 2
            self.work += (power + old_power) * dt / 2
        self.previous = (force, points, viscous, power)
        self.active = active
        y = self.beam.deflection(q) - self.wall_y
        self.deepest = max(self.deepest, float(y.max()) / max(t, 1e-300)) if t > 0.01 else self.deepest
        return q, v

    def _load_power(self, t: float, q: Array, v: Array) -> float:
        beam, scaling = self.beam, self.scaling
        power = self.load * beam.momentum(v) / beam.section.mass_per_length
        moment = scaling.amplitude * (scaling.psi * beam.shape.s[-1] ** 2 / 2 + scaling.chi * t)
        power += -self.shear * v[beam.vertical[-1]] + moment * v[beam.rotation[-1]]
        if not self.half:
            power += -self.shear * v[beam.vertical[0]] - moment * v[beam.rotation[0]]
        return float(power)

    def save(self, t: float, q: Array, v: Array) -> None:
        r, beam = self.record, self.beam
        r.time.append(t)
        r.y.append(beam.deflection(q) - self.wall_y)
        r.v.append(v[beam.vertical].copy())
        r.slope.append(beam.slope(q) - beam.shape.wall_curvature * beam.shape.s)
        r.impulse.append(self.impulse.copy())
        r.active.append(self.active.copy())
        r.total.append(self.total)
        r.kinetic.append(beam.kinetic_energy(v))
        r.strain.append(beam.strain_energy(q))
        r.work.append(self.work)
        r.contact_loss.append(self.contact_loss)
        r.viscous_loss.append(self.viscous_loss)
        r.held.append(self.held)

    def history(self, **about: Any) -> ImpactHistory:
        """The record in SI units, of the whole beam where it is a sum."""
        r, s = self.record, self.scaling
        both = 2.0 if self.half else 1.0
        energy = both * s.energy
        kinetic, strain, work = (np.array(values) * energy for values in (r.kinetic, r.strain, r.work))
        impact_loss, viscous_loss = np.array(r.contact_loss) * energy, np.array(r.viscous_loss) * energy
        balance = kinetic[0] + strain[0] + work - kinetic - strain
        fields = {
            "gap": (("time", "x"), -np.array(r.y) * s.deflection),
            "velocity": (("time", "x"), np.array(r.v) * s.velocity),
            "slope": (("time", "x"), np.array(r.slope) * s.slope),
            "impulse": (("time", "contact"), np.array(r.impulse) * s.impulse),
            "in_contact": (("time", "contact"), np.array(r.active)),
            "total_impulse": (("time",), np.array(r.total) * both * s.impulse),
            "held_impulse": (("time",), np.array(r.held) * both * s.impulse),
            "kinetic_energy": (("time",), kinetic),
            "strain_energy": (("time",), strain),
            "work_of_loads": (("time",), work),
            "loss_impact": (("time",), impact_loss),
            "loss_viscous": (("time",), viscous_loss),
            "loss_algorithmic": (("time",), balance - impact_loss - viscous_loss),
        }
        place = np.interp(self.contact.contact_s, self.beam.shape.s, self.beam.shape.x)
        return ImpactHistory.build(
            path="exudyn",
            symmetry="half" if self.half else "full",
            time=np.array(r.time) * s.end_time,
            x=self.beam.shape.x * s.length,
            contact_x=place * s.length,
            fields=fields,
            **about,
        )
