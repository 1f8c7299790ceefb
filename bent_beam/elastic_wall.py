"""The scales of a wall that gives way: R = max(0, k p + c ṗ) per length of beam where the penetration p is positive.

    ℓ_k = (EI/k)^¼,   t_k = ℓ_k²√(μ/EI) = √(μ/k),   ζ = c/(2√(kμ));      of a stop, k in N/m:   ℓ_k = (EI/k)^⅓
"""

from __future__ import annotations

from typing import NamedTuple

from bent_beam.impact import Impact

__all__ = ["WallScales", "wall_scales"]


class WallScales(NamedTuple):
    """ℓ_k, m, and t_k, s, see the module's head."""

    length: float
    time: float


def wall_scales(impact: Impact) -> WallScales | None:
    """The scales of the wall of ``impact``; ``None`` of a rigid one."""
    if impact.wall_stiffness is None:
        return None
    begin, end = impact.wall_span
    length = (impact.bending_stiffness / impact.wall_stiffness) ** (1.0 / 3.0 if begin == end else 0.25)
    return WallScales(length, length**2 / impact.wave_constant)
