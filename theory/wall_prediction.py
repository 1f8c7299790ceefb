r"""What the theory says about an impact on a wall that gives way, SI units (`theory.elastic_wall`).

    F_max = f(κ/ν, ζ) V₀√μ(EI k)^{1/4},   t_k = √(μ/k),   ℓ_k = (EI/k)^{1/4},   ζ = c/(2√(kμ)),
    λ_c(t) → λ₀√(ct) + (4EI/k)^{1/4} for κ/ν < 1                                 (docs/theory.md, section 9)

while the force acts at λ₀√(ct). Impulse, force over a tenth of the time and place of the force come within 2 % of
the rigid wall's, the impulse in half of the time or less. When they do is read off `theory.elastic_wall`
(``python -m benchmarks.wall``): the constants below. In a flatter zone, or with less damping, what the wall gives back
stays in the impulse for thousands of t_k, and no time is given.
"""

import math
from dataclasses import dataclass
from typing import Any

from bent_beam.impact import Impact
from bent_beam.loads import wall_scales
from theory.contact import ContactParameters
from theory.elastic_wall import FLATTEST, MOST_DAMPED, SHARPEST, peak_force
from theory.validity import DAMPING, FIRST_ORDER, SHEAR, TOLERANCE, validity

#: κ/ν of the flattest zone, and the least ζ, whose force and impulse were seen to come back to the rigid wall's.
FLATTEST_SETTLED, LEAST_DAMPED = 0.35, 0.25
#: t_k after which the force of a zone does, and λ₀√(ct)/ℓ_k at which its place does.
ZONE_TIME, ZONE_LENGTHS = 200.0, 4.2
#: t_k, and t_k (κ/ν)^{1/4}, after which the force of one point does.
POINT_TIME, SHARP_POINT_TIME = 29.0, 14.0
#: η/t_k from which the beam's own damping changes the largest force by more than 2 % (κ/ν ≤ 5; measured).
MOST_OWN_DAMPING = 0.18
#: t_k/t_s below which shear changes the largest force of a zone, and of one point, by more than 2 % (docs/wall.md).
SHEAR_TIMES, POINT_SHEAR_TIMES = 3.0, 10.0


@dataclass(frozen=True, kw_only=True)
class WallPrediction:
    """One impact on an elastic wall, SI units.

    The numbers of the largest force are None where κ/ν or ζ is beyond the range of `theory.elastic_wall`. They are
    those of an infinite undamped beam without loads; `spoiled_by` names what makes this one another.

    time_scale, length_scale, damping_ratio : t_k (s), ℓ_k (m) and ζ.
    peak_force, peak_force_error, peak_force_time : the largest force on the whole zone, N, and when it acts, s.
    half_contact_length : of the zone then, m.
    penetration, pressure : the largest anywhere, m and N/m; the penetration None where something changes it, and not
        the force, by more than 2 % before it is largest, which a damped wall puts off.
    spoiled_by : what changes the force by more than 2 % before it is largest, one of the names in `theory.validity`;
        None: nothing.
    zone_offset : what the wall makes the zone longer by later, m; 0 for one point, whose zone shrinks.
    rigid_from : time after which the force over a tenth of the time, its place and the impulse are those of the rigid
        wall to 2 %, s; infinite where none is known.
    """

    time_scale: float
    length_scale: float
    damping_ratio: float
    peak_force: float | None = None
    peak_force_error: float | None = None
    peak_force_time: float | None = None
    half_contact_length: float | None = None
    penetration: float | None = None
    pressure: float | None = None
    spoiled_by: str | None = None
    zone_offset: float
    rigid_from: float


def zone_offset(kappa_over_nu: float, shear: float = 0.0) -> float:
    """What an elastic wall adds to the half contact length of a rigid one in the end, (EI/k)^{1/4}; 0 for one point.
    Behind the rim a beam on springs is pressed by e^{−ay} sin by, a² + b² = 1, 4a² = 2 + s², ``shear`` s = l_s/ℓ_k: its
    force acts 2a behind the rim, that of a rigid wall s."""
    return math.hypot(math.sqrt(2.0), shear) - shear if kappa_over_nu < 1.0 else 0.0


def on_elastic_wall(impact: Impact, solved: ContactParameters) -> WallPrediction | None:
    """The largest force and the range of the rigid wall's law, with the impact's contact parameters; None for a rigid
    wall."""
    scales = wall_scales(impact)
    if scales is None or impact.wall_stiffness is None:
        return None
    ratio, damping = float(solved.kappa_over_nu), impact.wall_damping_ratio
    largest: dict[str, Any] = {}
    if FLATTEST <= ratio <= SHARPEST and damping <= MOST_DAMPED:
        found, deep = peak_force(ratio, damping), impact.velocity * scales.time
        unit = deep * impact.wall_stiffness * scales.length  # V₀√μ(EI k)^{1/4}
        spoiled = [
            _spoiled_by(impact, solved, scales.time, scales.time * t) for t in (found.time, found.penetration_time)
        ]
        largest = {
            "peak_force": unit * found.value,
            "peak_force_error": unit * found.error,
            "peak_force_time": scales.time * found.time,
            "half_contact_length": scales.length * found.half_contact_length,
            "penetration": deep * found.penetration if spoiled[1] is None or spoiled[0] is not None else None,
            "pressure": impact.wall_stiffness * deep * found.pressure,
            "spoiled_by": spoiled[0],
        }
    return WallPrediction(
        time_scale=scales.time,
        length_scale=scales.length,
        damping_ratio=damping,
        zone_offset=scales.length * zone_offset(ratio, impact.shear_length / scales.length),
        rigid_from=scales.time * _rigid_from(ratio, damping, float(solved.lambda0)),
        **largest,
    )


def _spoiled_by(impact: Impact, solved: ContactParameters, wall_time: float, peak_time: float) -> str | None:
    """What the infinite beam lacks when the force is largest."""
    if impact.damping > MOST_OWN_DAMPING * wall_time:
        return DAMPING
    sheared = SHEAR_TIMES if solved.kappa_over_nu < 1.0 else POINT_SHEAR_TIMES
    if impact.shear_stiffness is not None and wall_time < sheared * impact.shear_time:
        return SHEAR
    free = validity(impact.unsheared.replace(damping=0.0), solved).spoiled_by(peak_time)
    return FIRST_ORDER if free is None and _change_by_loads(impact, solved, peak_time) > TOLERANCE else free


def _change_by_loads(impact: Impact, solved: ContactParameters, time: float) -> float:
    """What loads change of a rigid wall's force at a time, s, to first order; a share."""
    tau = time / impact.time_scale
    of_zone = math.sqrt(0.5 * math.pi) * solved.lambda0 * float(solved.uniform_reaction) * tau
    return abs(solved.r1 * tau + of_zone) / solved.r0


def _rigid_from(ratio: float, damping: float, lambda0: float) -> float:
    """t_k after which force, its place and impulse are within 2 % of those on a rigid wall."""
    if ratio >= 1.0:
        return max(POINT_TIME, SHARP_POINT_TIME * ratio**0.25)
    if ratio < FLATTEST_SETTLED or damping < LEAST_DAMPED:
        return math.inf
    return max(ZONE_TIME, (ZONE_LENGTHS / lambda0) ** 2)
