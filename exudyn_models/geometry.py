"""How large the deflections of the model are.

The natural shape of the beam at the first contact has the angle θ(s) = −Ks + q₀s³/6 at arc length s. Its material
points lie at

    x = ∫ cos θ ds,  y = ∫ sin θ ds,   ẋ = −∫ θ̇ sin θ ds,  ẏ = V₀ + ∫ θ̇ cos θ ds,  θ̇ = c₀ s       (no stretch)

and for small angles y = −Ks²/2 + q₀s⁴/24, ẏ = V₀ + c₀s²/2, the free motion of Euler–Bernoulli theory.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, Protocol

import numpy as np

from bent_beam.fields import Part, Quantity
from bent_beam.loads import FreeMotion, lowest_mode
from exudyn_models.arrays import Array
from exudyn_models.scaling import Scaling, front_bound

__all__ = ["GEOMETRIES", "Geometry", "LinearLimit", "Shape", "TrueGeometry"]

STEEPEST = 1e-4  # slope in the linear limit: at 2e-3 the energy budget of a whole impact is 8e-6 off
MODE_SLOPE = 6.0  # of the lowest mode of any ends, V₀/(L/2): clamped and free, at the tip
MOVED = 2.0  # fronts' bounds from the centre: beyond, the beam keeps the shape that it came with


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
    wall_curvature: float = 0.0
    first_touch: float = 0.0

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


def _arc(s: Array, motion: FreeMotion, amplitude: float) -> tuple[Array, Array, Array, Array]:
    """x, y and their velocities beyond V₀ of an unstretched line of the angles, and turning at the rates, of the slopes
    of ``motion`` times ``amplitude``.

    Four-point Gauss per element: exact to round-off for the small change of angle within one.
    """
    points, weights = np.polynomial.legendre.leggauss(4)
    at = s[:-1, None] + np.diff(s)[:, None] * (points + 1) / 2
    weight = np.diff(s)[:, None] * weights / 2

    def integral(values: Array) -> Array:
        return np.concatenate([[0.0], np.cumsum((values * weight).sum(axis=1))])

    theta, turning = amplitude * motion(at, by_x=1), amplitude * motion(at, by_x=1, by_t=1)
    fields = (np.cos(theta), np.sin(theta), -turning * np.sin(theta), turning * np.cos(theta))
    centre = int(np.argmin(np.abs(s)))
    x, y, vx, vy = (f - f[centre] for f in map(integral, fields))
    return x, y, vx, vy


class Geometry(Protocol):
    """What ``simulate`` asks of a geometry."""

    true: ClassVar[bool]

    def amplitude_of(self, scaling: Scaling, reach: float) -> float:
        """Deflection scale of the model over Λ for a beam modelled over ``reach`` Λ, ``scaling`` having the amplitude
        one."""
        ...

    def shape(self, s: Array, scaling: Scaling, wall_share: float = 0.0) -> Shape:
        """The beam at the first contact; a share of its curvature may be given to the wall instead."""
        ...


@dataclass(frozen=True)
class LinearLimit(Part):
    """Deflections scaled down until the beam is linear: the comparison with linear theory.

    The history is scaled back. The amplitude is chosen so that slopes of the free motion stay below 1e-4 where the
    impact moves the beam, their square being what is left of geometry.
    """

    where: ClassVar[str] = "exudyn.geometry"
    true: ClassVar[bool] = False

    amplitude: Annotated[
        float | None,
        Quantity("", "V₀T over (EI/μ)^{1/4}√T in the model", least=1e-9, most=1.0, absent=f"{STEEPEST:g} or less"),
    ] = None

    def amplitude_of(self, scaling: Scaling, reach: float) -> float:
        if self.amplitude is not None:
            return self.amplitude
        held, moved = scaling.impact.supported, MOVED * front_bound(scaling.kappa)
        far = (reach if held else min(reach, moved)) + abs(scaling.first_touch)
        motion = scaling.motion_of(max(abs(scaling.kappa), abs(scaling.beam_kappa)))
        largest = FreeMotion({powers: abs(c) for powers, c in motion.terms.items()})
        swings = MODE_SLOPE * scaling.length / scaling.impact.half_length if held else 0.0
        return STEEPEST / max(1.0, float(largest(far, 1.0, by_x=1)), swings)

    def shape(self, s: Array, scaling: Scaling, wall_share: float = 0.0) -> Shape:
        k, a = scaling.beam_kappa - scaling.kappa * wall_share, scaling.amplitude
        bow, motion, impact = s - scaling.first_touch, scaling.motion_of(k), scaling.impact
        velocity, turning = motion(bow, by_t=1), motion(bow, by_x=1, by_t=1)
        if impact.supported:
            velocity, turning = lowest_mode(impact.left_end, impact.right_end, impact.half_length / scaling.length, s)
        return Shape(
            s=s,
            # what carries a force must not be stretched by its own slope
            x=_arc(s, motion, a)[0] if scaling.axial_force else s,
            y=a * motion(bow),
            angle=a * motion(bow, by_x=1),
            velocity_x=np.zeros_like(s),
            velocity_y=a * velocity,
            angular_velocity=a * turning,
            curvature=-a * k,
            slender=False,
            wall_curvature=a * (scaling.kappa * wall_share - scaling.wall_kappa),
            first_touch=scaling.first_touch,
        )


@dataclass(frozen=True)
class TrueGeometry:
    """The beam as it is: an arc laid by arc length, axial stiffness EA = 12EI/d² of its section height d.

    Linear theory is approached as slopes vanish, that is for end times T ≪ t* (slopes over the front are ~ √(T/t*)).
    """

    true: ClassVar[bool] = True

    def amplitude_of(self, scaling: Scaling, reach: float) -> float:
        return scaling.true_amplitude

    def shape(self, s: Array, scaling: Scaling, wall_share: float = 0.0) -> Shape:
        k, a = scaling.beam_kappa - scaling.kappa * wall_share, scaling.amplitude
        motion = scaling.motion_of(k)
        angle = a * motion(s, by_x=1)
        if np.max(np.abs(angle)) > np.pi / 2:
            raise ValueError(
                f"geometry true: the modelled beam of half length {s[-1] * scaling.length:.4g} m turns by more "
                "than a right angle; shorten run.end_time or beam.length, or use the linear limit"
            )
        x, y, vx, vy = _arc(s, motion, a)
        return Shape(
            s=s,
            x=x,
            y=y,
            angle=angle,
            velocity_x=vx,
            velocity_y=a + vy,
            angular_velocity=a * motion(s, by_x=1, by_t=1),
            curvature=-a * k,
            slender=True,
            wall_curvature=a * (scaling.kappa * wall_share - scaling.wall_kappa),
        )


GEOMETRIES: dict[str, type] = {"linear": LinearLimit, "true": TrueGeometry}
"""Kinds of ``[exudyn.geometry]``."""
