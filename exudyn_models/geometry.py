"""Model units, what may be said of an impact before it is run, and the beam at the first contact.

With the end time T as unit of time and Λ = (EI/μ)^{1/4} √T as unit of length the beam equation is

    y_tt + y_xxxx = q₀ + a₀ − r,   0 ≤ t ≤ 1,   μ = EI = 1,                               (thesis 2.1.1 scaled)

whatever the physical size of the problem: the leading order is self-similar, so its one parameter κ/ν = K√(EI/μ)/V₀
is also the initial curvature here when deflections are measured in V₀T. Deflections carry a further factor, the
``amplitude``: V₀T/Λ gives the true geometry, anything small the linear limit (the problem is linear in it).

The natural shape of the beam at the first contact has the angle θ(s) = −Ks + q₀s³/6 at arc length s. Its material
points lie at

    x = ∫ cos θ ds,  y = ∫ sin θ ds,   ẋ = −∫ θ̇ sin θ ds,  ẏ = V₀ + ∫ θ̇ cos θ ds,  θ̇ = c₀ s       (no stretch)

and for small angles y = −Ks²/2 + q₀s⁴/24, ẏ = V₀ + c₀s²/2, the free motion of Euler–Bernoulli theory.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from bent_beam import Impact
from bent_beam.errors import InputError
from bent_beam.fields import Part, Quantity
from bent_beam.loads import FreeMotion
from bent_beam.modes import lowest_mode

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.int64]

POINTS, WEIGHTS = np.polynomial.legendre.leggauss(4)  # of an element, −1 … 1
STEEPEST = 1e-4  # slope in the linear limit: at 2e-3 the energy budget of a whole impact is 8e-6 off
MODE_SLOPE = 6.0  # over V₀/(L/2): that of the lowest mode of any ends is half of it
MOVED = 2.0  # times `Scaling.front`, from the centre: beyond, the beam keeps the shape that it came with
FARTHEST = 200.0  # Λ, the largest `Scaling.front`, which has no limit as κ → 0


def supports_or_plate(impact: Impact) -> bool:
    """Whether an end is held, or the wall stands before a part of the beam only."""
    return impact.supported or impact.wall_in_part


class Scaling:
    """Conversions between SI and model units (model × factor = SI) for one impact followed to ``end_time`` (s).

    length : Λ = (EI/μ)^{1/4} √T, m; true_amplitude : V₀T/Λ, at which the model has the shape of the real beam.
    deflection (m), velocity (m/s), slope, impulse (N s), energy (J), stiffness (N/m²) and damping (N s/m²) per length :
        factors.
    kappa : κ/ν of the bow against the wall; beam_kappa : of the bow itself, whatever the wall.
    front : √(2ν/κ), Λ, the front's bound, for choosing a resolution, never to make an answer. The zone at the end time
        is shorter, λ₀ < √(2ν/κ): up to there y₀ = V₀t − Kx²/2, without a wall, is inside it.
    motion : y₀ − y_w over amplitude, x from first_touch (Λ); loads : the terms of it that load the ends.
    pushed : over amplitude, a bound of what forces at points change of slopes and velocities until the end: the sum of
        what they change of an endless beam and of a rigid one.
    shear_length : l_s/Λ, 0 without shear; rotary_inertia : J/(μΛ²); material_damping : η/T.
    axial_force : N Λ²/EI; load : uniform load per unit length over amplitude, under which y₀ is the motion without
        contact.
    """

    def __init__(self, impact: Impact, end_time: float, amplitude: float = 1.0) -> None:
        self.impact, self.end_time, self.amplitude = impact, end_time, amplitude
        self.length = math.sqrt(impact.wave_constant * end_time)
        self.true_amplitude = impact.velocity * end_time / self.length
        self.deflection = impact.velocity * end_time / amplitude
        self.velocity = impact.velocity / amplitude
        self.slope = self.deflection / self.length
        self.impulse = impact.mass_per_length * self.length * self.velocity
        self.energy = impact.mass_per_length * self.length * self.velocity**2
        self.stiffness = impact.bending_stiffness / self.length**4
        self.damping = impact.bending_stiffness * end_time / self.length**4
        self.kappa = impact.kappa_over_nu
        self.beam_kappa = impact.curvature * impact.length_scale
        self.front = FARTHEST if self.kappa <= 0.0 else min(FARTHEST, math.sqrt(2.0 / self.kappa))
        self.first_touch = impact.first_touch / self.length
        free = impact.free_motion(impact.relative_curvature)
        self.motion = free.scaled(self.length, end_time, impact.velocity * end_time)
        self.loads = self.motion_of(0.0).bending()
        self.axial_force = impact.epsilon_axial * end_time / impact.time_scale
        self.load = impact.uniform_pressure * end_time / (impact.mass_per_length * impact.velocity)
        self.shear_length = impact.shear_length / self.length
        self.rotary_inertia = impact.shear_ratio * self.shear_length**2
        self.material_damping = impact.damping / end_time
        half, force = impact.half_length / self.length, math.fsum(abs(force) for _, force in impact.forces)
        force *= end_time / (self.impulse * amplitude)
        self.pushed = force * (1.0 + self.shear_length**2 + 2.0 / half + 1.0 / half**2)

    def motion_of(self, kappa: float) -> FreeMotion:
        """``motion`` of a beam of curvature ``kappa``."""
        return FreeMotion({**self.motion.terms, (2, 0): -kappa})


class Units:
    """What the numbers of Exudyn's items are in: model unit × factor = item. ``simulate`` lays its items in model
    units, which are as good for a beam of any size; :func:`exudyn_models.build` in SI units."""

    def __init__(self, length: float = 1.0, time: float = 1.0, force: float = 1.0) -> None:
        self.length, self.time, self.force = length, time, force
        self.bending_stiffness = force * length**2
        self.mass_per_length = force * (time / length) ** 2
        self.stiffness, self.damping = force / length, force * time / length


@dataclass(frozen=True)
class Shape:
    """Places, angles and velocities of the nodes at the first contact in model units, arrays of shape (nodes,).

    curvature : stress-free; slender : true geometry, where the axial stiffness of the section matters.
    wall_curvature : of a wall y = wall_curvature x²/2. It may be given a share of the beam's own; the beam is then laid
        flatter. first_touch : place that x of the wall is measured from.
    """

    s: Array
    x: Array
    y: Array
    angle: Array
    velocity_x: Array
    velocity_y: Array
    angular_velocity: Array
    curvature: float
    slender: bool
    wall_curvature: float
    first_touch: float

    @property
    def place(self) -> Array:
        """x at which results are told, shape (nodes,): in the linear limit, where angles are slopes, s."""
        return self.x if self.slender else self.s

    @property
    def wall_y(self) -> Array:
        """Of the wall at the nodes, shape (nodes,)."""
        return np.asarray(self.wall_curvature * (self.s - self.first_touch) ** 2 / 2)

    @property
    def wall_slope(self) -> Array:
        return np.asarray(self.wall_curvature * (self.s - self.first_touch))

    @property
    def lengths(self) -> Array:
        """Element lengths, shape (nodes − 1,)."""
        return np.diff(self.s)


def element_times(lengths: Array, shear_length: float) -> Array:
    """√(μ/EI) Δx² √(1 + Φ), Φ = 12 (l_s/Δx)², with √(EI/μ) = 1: the time in which an element of this length follows
    what happens at its ends, by bending or, where Δx ≪ l_s, in that of a shear wave. Grid viscosity and penalty are
    measured by it."""
    return np.asarray(lengths * np.sqrt(lengths**2 + 12.0 * shear_length**2))


def _arc(bow: Array, motion: FreeMotion, amplitude: float) -> dict[str, Array]:
    """Places, from the first touch, and velocities of an unstretched line of the angles, and turning at the rates, of
    the slopes of ``motion`` times ``amplitude``; ``bow`` is the arc length from there.

    Four-point Gauss per element: exact to round-off for the small change of angle within one.
    """
    at = bow[:-1, None] + np.diff(bow)[:, None] * (POINTS + 1) / 2
    weight = np.diff(bow)[:, None] * WEIGHTS / 2
    centre = int(np.argmin(np.abs(bow)))

    def integral(values: Array) -> Array:
        sums = np.concatenate([[0.0], np.cumsum((values * weight).sum(axis=1))])
        return np.asarray(sums - sums[centre])

    theta, turning = amplitude * motion(at, by_x=1), amplitude * motion(at, by_x=1, by_t=1)
    cos, sin, start = np.cos(theta), np.sin(theta), bow[centre]
    return {
        "x": start + integral(cos),
        "y": amplitude * motion(start) + integral(sin),
        "velocity_x": -integral(turning * sin),
        "velocity_y": amplitude * motion(start, by_t=1) + integral(turning * cos),
        "angular_velocity": amplitude * motion(bow, by_x=1, by_t=1),
    }


@dataclass(frozen=True)
class Geometry(Part, ABC):
    """How large the deflections of the model are."""

    where: ClassVar[str] = "exudyn.geometry"
    true: ClassVar[bool] = False

    @abstractmethod
    def amplitude_of(self, scaling: Scaling, reach: float) -> float:
        """Deflection scale of the model over Λ for a beam modelled over ``reach`` Λ, ``scaling`` having the amplitude
        one."""

    def shape(self, s: Array, scaling: Scaling, wall_share: float) -> Shape:
        """The beam at the first contact; a share of its curvature may be given to the wall instead."""
        k, a, bow = scaling.beam_kappa - scaling.kappa * wall_share, scaling.amplitude, s - scaling.first_touch
        motion = scaling.motion_of(k)
        angle = a * (motion(bow, by_x=1) + scaling.shear_length**2 * motion(bow, by_x=3))  # φ = y′ + l_s² y‴
        if self.true and np.abs(angle).max() > np.pi / 2:
            raise InputError(
                f"geometry true: the modelled beam of half length {s[-1] * scaling.length:.4g} m turns by more "
                "than a right angle; shorten run.end_time or beam.length, or use the linear limit"
            )
        laid, impact = _arc(bow, motion, a), scaling.impact
        laid["x"] += scaling.first_touch
        if impact.supported:
            mode, angle_of_mode = lowest_mode(impact, s * scaling.length)
            laid |= {"velocity_y": a * mode, "angular_velocity": a * scaling.length * angle_of_mode}
        return Shape(
            s=s,
            angle=angle,
            curvature=-a * k,
            slender=self.true,
            wall_curvature=a * (scaling.kappa * wall_share - impact.wall_curvature * impact.length_scale),
            first_touch=scaling.first_touch,
            **laid,
        )


@dataclass(frozen=True)
class LinearLimit(Geometry):
    """Deflections scaled down until the beam is linear: the comparison with linear theory.

    The history is scaled back. The amplitude is chosen so that slopes of the free motion stay below 1e-4 where the
    impact moves the beam, their square being what is left of geometry.
    """

    amplitude: Annotated[
        float | None,
        Quantity("", "V₀T over (EI/μ)^{1/4}√T in the model", least=1e-9, most=1.0, absent=f"{STEEPEST:g} or less"),
    ] = None

    def amplitude_of(self, scaling: Scaling, reach: float) -> float:
        if self.amplitude is not None:
            return self.amplitude
        held = scaling.impact.supported
        far = (reach if held else min(reach, MOVED * scaling.front)) + abs(scaling.first_touch)
        motion = scaling.motion_of(max(abs(scaling.kappa), abs(scaling.beam_kappa)))
        largest = FreeMotion({powers: abs(c) for powers, c in motion.terms.items()})
        bent = FreeMotion({powers: c for powers, c in largest.terms.items() if powers not in ((0, 1), (2, 0))})
        swings = MODE_SLOPE * scaling.length / scaling.impact.half_length if held else 0.0
        swings *= float(largest(far, 1.0, by_t=1))  # over V₀: as fast as loads could make it until the end
        slopes = (float(largest(far, 1.0, by_x=1)), float(bent(reach, 1.0, by_x=1)))  # loads bend all that is modelled
        return STEEPEST / max(1.0, *slopes, swings, scaling.pushed)


@dataclass(frozen=True)
class TrueGeometry(Geometry):
    """The beam as it is: an arc laid by arc length, axial stiffness EA = 12EI/d² of its section height d.

    Linear theory is approached as slopes vanish, that is for end times T ≪ t* (slopes over the front are ~ √(T/t*)).
    """

    true: ClassVar[bool] = True

    def amplitude_of(self, scaling: Scaling, reach: float) -> float:
        return scaling.true_amplitude


GEOMETRIES: dict[str, type] = {"linear": LinearLimit, "true": TrueGeometry}
"""Kinds of ``[exudyn.geometry]``."""
