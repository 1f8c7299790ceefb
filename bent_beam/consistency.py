"""Checks of an :class:`bent_beam.Impact` that look at several fields together."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

from bent_beam.hysteresis import check_loss

__all__ = ["check_consistency"]

RANGE = 1e60  # of every number of a problem, in SI and in its own units: its fourth power can still be calculated with
POSITIVE = ("bending_stiffness", "mass_per_length", "length", "velocity", "section_height")
SCALES = ("wave_constant", "time_scale", "length_scale", "slow_time_scale", "epsilon")
GROUPS = ("epsilon_alpha", "epsilon_chi", "epsilon_psi", "epsilon_axial", "relative_damping", "kappa_over_nu")
NOT_HELD = ("rotation", "curvature_rate", "fourth_derivative")  # motions that a support does not allow


def check_consistency(impact: Any) -> None:
    """``ValueError`` naming field and value: a size that cannot be calculated with, or fields that contradict."""
    check_arrangement(impact)
    check_sizes(impact)
    check_loss(impact)


def check_sizes(impact: Any) -> None:
    """``ValueError`` for numbers, scales and groups that floating point does not hold."""
    for name in (*SCALES, *GROUPS):
        try:
            value = abs(getattr(impact, name))
        except (OverflowError, ZeroDivisionError):
            value = math.inf
        if not value <= RANGE or (name in SCALES and value < 1.0 / RANGE):
            raise ValueError(
                f"length, curvature, velocity, bending_stiffness and mass_per_length put {name} beyond "
                f"{RANGE:g} or below its inverse (got L = {impact.length!r}, K = {impact.curvature!r}, "
                f"V0 = {impact.velocity!r}, EI = {impact.bending_stiffness!r}, mu = {impact.mass_per_length!r})"
            )
    for name in (f.name for f in dataclasses.fields(impact) if not isinstance(getattr(impact, f.name), str)):
        value = abs(getattr(impact, name) or 0.0)
        if value > RANGE:
            raise ValueError(f"{name} must not exceed {RANGE:g} (got {getattr(impact, name)!r})")
        if name in POSITIVE and value < 1.0 / RANGE:
            raise ValueError(f"{name} must be at least {1.0 / RANGE:g} (got {getattr(impact, name)!r})")


def check_arrangement(impact: Any) -> None:
    """``ValueError`` where supports, wall, first touch or bow contradict one another; it names field and value."""
    half = impact.half_length
    if abs(impact.first_touch) >= half:
        raise ValueError(
            f"first_touch must lie on the beam, within {half!r} m of its middle (got {impact.first_touch!r})"
        )
    if impact.wall_curvature and impact.wall_curvature >= impact.curvature:
        raise ValueError(
            f"wall_curvature must be less than the beam's curvature {impact.curvature!r}, or no point touches first "
            f"(got {impact.wall_curvature!r})"
        )
    for name in ("wall_from", "wall_to"):
        place = getattr(impact, name)
        if place is not None and not -half <= place <= half:
            raise ValueError(
                f"{name} must lie on the beam, within {half!r} m of its middle (got {place!r}); leave it out for a "
                "wall that goes on"
            )
    begin, end = impact.wall_span
    if begin > end:
        raise ValueError(f"wall_from must not exceed wall_to {end!r} (got {begin!r})")
    if impact.wall_damping and impact.wall_stiffness is None:
        raise ValueError(
            f"wall_damping has no effect on a rigid wall: give wall_stiffness too (got {impact.wall_damping!r})"
        )
    if impact.supported:
        for name in NOT_HELD:
            if getattr(impact, name):
                raise ValueError(
                    f"{name} must be 0 where an end is held: the beam arrives in the lowest mode that its ends allow "
                    f"(got {getattr(impact, name)!r})"
                )
