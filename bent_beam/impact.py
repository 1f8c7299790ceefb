"""The physical problem: a naturally bent beam arriving at a wall.

    μ y_tt + EI(y_xxxx + η y_txxxx) − N y_xx = p − r,     0 ≤ r ⊥ g = y_w − y ≥ 0         (thesis 2.1.1–2; N, η added)

That is Euler and Bernoulli's beam. With a shear stiffness S = κ_sGA it is Timoshenko's, φ the turning of its sections
and J their rotary inertia (Timoshenko 1921, Philos. Mag. 41, 744; docs/shear.md):

    μ y_tt − S[(y_x − φ) + η(y_x − φ)_t]_x − N y_xx = p − r,     J φ_tt = EI(φ + ηφ_t)_xx + S[(y_x − φ) + η(y_x − φ)_t]

y > 0 points into the wall y_w = −K_w x²/2; x = 0 touches first, at t = 0. The free motion close to the contact is

    y₀ = V₀ t − K x²/2 + a₀ t²/2 + c₀ x² t/2 + q₀ x⁴/24.                      (thesis 2.2.30; bent_beam/loads.py)
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bent_beam.checks import LARGEST, non_negative, positive, shortened
from bent_beam.errors import InputError
from bent_beam.hysteresis import check_loss
from bent_beam.loads import loads_of, places_of
from bent_beam.scales import Scales

ENDLESS = 1e30  # time, and change of the free motion by the loads, in the problem's own units
WAVES_FELT = 0.005  # T*: until then waves from the ends change the impulse by 1 % at most, of flat contacts by more
BEFORE_WAVES_RETURN = 0.01  # T*: the earliest that they change the impulse by 2 %
ROUND_OFF = 1e-9  # of the length: a place so near an edge of the wall lies on it
AT_ONCE = 1e-4  # of a step: what touches within it lands at once
SCALES = ("wave_constant", "time_scale", "length_scale", "slow_time_scale", "epsilon")
GROUPS = ("epsilon_alpha", "epsilon_chi", "epsilon_psi", "epsilon_axial", "relative_damping", "kappa_over_nu")
NOT_HELD = ("rotation", "curvature_rate", "fourth_derivative")  # motions that a support does not allow


@dataclasses.dataclass(frozen=True)
class Impact(Scales):
    """A bent beam about to hit a wall (SI units). Unless said otherwise its ends are free, the wall is rigid, and
    all is symmetric about x = 0.

    Units, meanings and ranges of the fields stand in :class:`bent_beam.scales.Scales`. Raises ``ValueError`` naming
    field and value.

    >>> from bent_beam import Impact
    >>> pipe = Impact(bending_stiffness=1.224e6, mass_per_length=29.02, length=90.0, curvature=0.002, velocity=2.0)
    >>> round(pipe.kappa_over_nu, 3)
    0.205
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        if not self.wall_in_part:  # from end to end, as if no edge were given
            object.__setattr__(self, "wall_from", None)
            object.__setattr__(self, "wall_to", None)
        _check_arrangement(self)
        _check_scales(self)
        check_loss(self)

    @classmethod
    def dimensionless(
        cls,
        kappa_over_nu: float,
        *,
        epsilon_alpha: float = 0.0,
        epsilon_psi: float = 0.0,
        epsilon_chi: float = 0.0,
        epsilon_axial: float = 0.0,
        damping: float = 0.0,
        length: float = 1e3,
    ) -> Impact:
        """The impact in units of the fast layer: EI = μ = V₀ = 1, so l* = t* = 1 and ν = 1. The beam stands for an
        infinite one, which goes on at its ends: an axial force follows the bow there."""
        return cls(
            bending_stiffness=1.0,
            mass_per_length=1.0,
            length=length,
            velocity=1.0,
            curvature=positive("kappa_over_nu", kappa_over_nu),
            acceleration=epsilon_alpha,
            fourth_derivative=epsilon_psi,
            curvature_rate=epsilon_chi,
            axial_force=epsilon_axial,
            tension_direction="tangent",
            damping=damping,
        )

    @classmethod
    def whole_beam(
        cls, kappa_over_nu: float, *, relative_damping: float = 0.0, shear_length: float = 0.0, shear_ratio: float = 0.0
    ) -> Impact:
        """The free–free beam in units of its half length: EI = μ = V₀ = L/2 = 1, so T* = 1; damping is η/T*,
        shear_length l_s over L/2 (0: Euler and Bernoulli's), shear_ratio κ_sG/E (:mod:`bent_beam.scales`)."""
        bare = cls.dimensionless(kappa_over_nu, damping=relative_damping, length=2.0).replace(tension_direction="axis")
        if shear_length == 0.0:
            if shear_ratio != 0.0:
                raise InputError(f"shear_ratio has no effect without shear_length (got {shear_ratio!r})")
            return bare
        length = positive("shear_length", shear_length)
        return bare.replace(shear_stiffness=length**-2.0, rotary_inertia=shear_ratio * length**2)

    def replace(self, **changes: Any) -> Impact:
        """A copy with some fields changed, validated again."""
        return dataclasses.replace(self, **changes)

    @property
    def unsheared(self) -> Impact:
        """The same of Euler and Bernoulli's beam."""
        return self.replace(shear_stiffness=None, rotary_inertia=0.0)

    def before_wall(self, x: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of the places x, m from the middle, are before the wall; round-off at an edge counts as before it."""
        (begin, end), near = self.wall_span, ROUND_OFF * self.length
        return np.asarray((x >= begin - near) & (x <= end + near))

    @property
    def damping_at_landing(self) -> float:
        """Force over velocity of the wall's dashpots where all of a stop (N s/m), or of a plate along a straight beam
        (N s/m²), lands at once (:data:`AT_ONCE`): c, as the beam has not slowed down yet. Without damping of its own a
        beam that shears slows down at once at a stop: it sends off shear waves, F = c(V − F/(2√(κ_sGA μ))), half as
        many at an end."""
        c, (begin, end) = self.wall_damping, self.wall_span
        if begin != end or self.shear_stiffness is None or self.damping or self.hysteretic_loss:
            return c
        waves = 1.0 if abs(begin) >= self.half_length * (1.0 - ROUND_OFF) else 2.0
        return c / (1.0 + c / (waves * math.sqrt(self.shear_stiffness * self.mass_per_length)))

    def checked_end_time(self, end_time: float | None = None) -> float:
        """``end_time`` (s) of a simulation, or ``ValueError`` when it is out of all proportion to t*. ``None``: 0.1 t*,
        the longest time that the thesis computes, but 0.01 T* at most: then waves come back from the ends and what is
        asked without a time, the first spread of the contact, is over."""
        if end_time is None:
            end_time = min(0.1 * self.time_scale, BEFORE_WAVES_RETURN * self.slow_time_scale)
        if positive("end_time", end_time) / self.time_scale < 1.0 / ENDLESS:
            raise InputError(
                f"end_time must be at least {1 / ENDLESS:g} t* (got {end_time!r}, t* = {self.time_scale!r} s)"
            )
        return self.checked_time("end_time", end_time)

    def checked_time(self, name: str, value: float) -> float:
        """A time (s) since impact, or ``ValueError`` when it, or what the loads do by then, is out of proportion."""
        time = non_negative(name, value) / self.time_scale
        if time > ENDLESS:
            raise InputError(f"{name} must not exceed {ENDLESS:g} t* (got {value!r}, t* = {self.time_scale!r} s)")
        for load in loads_of(Impact):
            given = getattr(self, load)
            if abs(self.group(load)) * time > ENDLESS:
                raise InputError(f"{load} is out of all proportion to a time of {value:.6g} s (got {given!r})")
        return float(value)


def checked_impact(given: Any) -> Impact:
    """``given``, or ``ValueError`` where it is no impact but a case or its file."""
    if not isinstance(given, Impact):
        raise InputError(f"impact must be a bent_beam.Impact, as load_case(…).impact is (got {shortened(given)})")
    return given


def _check_scales(impact: Impact) -> None:
    """``ValueError`` for scales and groups that floating point does not hold."""
    for name in (*SCALES, *GROUPS):
        try:
            value = abs(getattr(impact, name))
        except (OverflowError, ZeroDivisionError):
            value = math.inf
        if not value <= LARGEST or (name in SCALES and value < 1.0 / LARGEST):
            raise InputError(
                f"length, curvature, velocity, bending_stiffness and mass_per_length put {name} beyond "
                f"{LARGEST:g} or below its inverse (got L = {impact.length!r}, K = {impact.curvature!r}, "
                f"V0 = {impact.velocity!r}, EI = {impact.bending_stiffness!r}, mu = {impact.mass_per_length!r})"
            )


def _check_arrangement(impact: Impact) -> None:
    """``ValueError`` where supports, wall, first touch or bow contradict one another; it names field and value."""
    half, touch = impact.half_length, impact.first_touch
    if abs(touch) >= half:
        raise InputError(f"first_touch must lie on the beam, within {half!r} m of its middle (got {touch!r})")
    straight = not (impact.curvature or impact.wall_curvature or impact.fourth_derivative or impact.curvature_rate)
    if touch and straight:
        raise InputError(f"first_touch, the place of a bow's apex, has no effect on a straight beam (got {touch!r})")
    if impact.wall_curvature and impact.wall_curvature >= impact.curvature:
        raise InputError(
            f"wall_curvature must be less than the beam's curvature {impact.curvature:.6g}, or no point touches first "
            f"(got {impact.wall_curvature!r})"
        )
    if impact.opposite_wall is not None:  # behind the bow K s²/2 − q₀ s⁴/24 at the start
        s, bend = max(abs(place - touch) for place in impact.wall_span), impact.fourth_derivative
        s = min(s, math.sqrt(6.0 * max(impact.curvature, 0.0) / bend)) if bend > 0.0 else s
        bow, room = 0.5 * impact.curvature * s**2 - bend * s**4 / 24.0, impact.opposite_wall
        if bow > room * (1.0 + 1e-9):
            raise InputError(f"opposite_wall must leave room for the bow of {bow:.6g} m behind its apex (got {room!r})")
    for name, about in places_of(type(impact)).items():
        place = getattr(impact, name)
        if place is not None and not -half <= place <= half:
            raise InputError(
                f"{name} must lie on the beam, within {half!r} m of its middle (got {place!r}){about.outside}"
            )
        if about.load and place and not getattr(impact, about.load):
            raise InputError(f"{name} has no effect without {about.load} (got {place!r})")
        if about.load and {-half: impact.left_end, half: impact.right_end}.get(place, "free") != "free":
            raise InputError(f"{name}: {about.load} has no effect on an end that is held (got {place!r})")
    begin, end = impact.wall_span
    if begin > end:
        raise InputError(f"wall_from must not exceed wall_to {end!r} (got {begin!r})")
    if impact.wall_damping and impact.wall_stiffness is None:
        raise InputError(
            f"wall_damping has no effect on a rigid wall: give wall_stiffness too (got {impact.wall_damping!r})"
        )
    if impact.wall_clearance and not impact.supported:
        raise InputError(
            "wall_clearance has no effect on a free beam, which flies up to the wall as it is: leave it out, or hold "
            f"an end (got {impact.wall_clearance!r})"
        )
    if impact.rotary_inertia and impact.shear_stiffness is None:
        raise InputError(f"rotary_inertia has no effect without shear_stiffness (got {impact.rotary_inertia!r})")
    if impact.supported:
        for name in NOT_HELD:
            if getattr(impact, name):
                raise InputError(
                    f"{name} must be 0 where an end is held: the beam arrives in the lowest mode that its ends allow "
                    f"(got {getattr(impact, name)!r})"
                )
