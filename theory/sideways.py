r"""A round beam that turns while it hits the wall: Coulomb's friction drives it sideways (new, not in the thesis).

    μ z_tt + EI z_xxxx − N z_xx = μ_f r   where every loaded contact slides,   μ η_tt + EI η_xxxx − N η_xx = r,

so z = μ_f η exactly, and a contact slides as long as the surface's speed v_s = ωD/2 is more than μ_f ∂_t y₀. At leading
order ∂_t y₀ = V₀: it slides for ever or sticks at once, and then z = (v_s/V₀)η has the contacts at v_s and stays inside
Coulomb's cone. At first order ∂_t y₀ = V₀ + a₀t + c₀x²/2, fastest at the front x² = λ₀²ct for c₀ > 0, and in the middle
of a pressed zone for c₀ < 0: it sticks at

    t = (v_s/μ_f − V₀)/(a₀ + ½c₀λ₀²c)

where the denominator is positive, in the latter case without the term c₀. The spin is that of a rigid shaft: v_s does
not change. No command asks for it; it stands in docs/theory.md, section 9.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from bent_beam.checks import non_negative, positive
from bent_beam.impact import Impact
from theory.prediction import Prediction, predict


@dataclass(frozen=True)
class SidewaysAtTime:
    """Along the wall at one time, SI units; None where `Prediction` has none.

    push : force of the wall on the beam along the surface's velocity, N.
    push_impulse : its time integral, N s.
    torque_impulse : that times the radius, N m s, what brakes the spin; None without a radius.
    valid : the impact's prediction holds, and a beam that slides has not stuck yet.
    """

    time: float
    push: float | None
    push_impulse: float | None
    torque_impulse: float | None
    valid: bool


@dataclass(frozen=True)
class Sideways:
    """Sideways motion of one impact.

    motion : "slides" or "sticks", at the first instant.
    ratio : z/η, sideways motion over what the wall does to the beam: μ_f or v_s/V₀.
    sticks_at : s; when a beam that slides comes to stick, 0 if it sticks at once, None if it never does.
    """

    motion: str
    ratio: float
    sticks_at: float | None
    times: tuple[SidewaysAtTime, ...]


def sideways(
    impact: Impact,
    surface_speed: float,
    friction: float,
    times: Iterable[float] | float = (),
    *,
    radius: float | None = None,
) -> Sideways:
    """Does the turning beam slide or stick, and what does the wall give it along the surface?

    impact : in the plane normal to the wall.
    surface_speed : v_s ≥ 0 of the beam's surface along the wall, m/s.
    friction : μ_f > 0 of Coulomb's law, the same at rest and in motion.
    times : after the first contact, s.
    radius : of the section, m; for the torque impulse.

    Raises ``ValueError`` for an argument out of its range, or an impact that `theory.predict` refuses.
    """
    non_negative("surface_speed", surface_speed)
    positive("friction", friction)
    if radius is not None:
        positive("radius", radius)
    prediction = predict(impact, times)
    sticks_at = _sticks_at(impact, prediction, surface_speed / friction)
    ratio = surface_speed / impact.velocity if sticks_at == 0.0 else friction
    last = sticks_at or math.inf  # a beam that slides is no longer what was predicted once it sticks
    rows = tuple(
        SidewaysAtTime(
            time=row.time,
            push=_scaled(row.reaction, ratio),
            push_impulse=_scaled(row.impulse, ratio),
            torque_impulse=_scaled(_scaled(row.impulse, ratio), radius),
            valid=row.valid and row.time <= last,
        )
        for row in prediction.times
    )
    return Sideways("sticks" if sticks_at == 0.0 else "slides", ratio, sticks_at, rows)


def _scaled(value: float | None, by: float | None) -> float | None:
    return None if value is None or by is None else by * value


def _sticks_at(impact: Impact, prediction: Prediction, speed: float) -> float | None:
    """When the fastest loaded contact reaches `speed` = v_s/μ_f."""
    if speed <= impact.velocity:
        return 0.0
    spread = impact.curvature_rate * prediction.lambda0**2 * impact.wave_constant / 2.0
    pressed = prediction.regime == "continuous" and impact.zone_pressure > 0.0
    rate = impact.acceleration + (max(spread, 0.0) if pressed else spread)
    return (speed - impact.velocity) / rate if rate > 0.0 else None
