"""Validation: every part of a run checks its own numbers with these, once, when it is made."""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import Any

from bent_beam.errors import InputError

__all__ = [
    "affordable", "at_least", "between", "check_arrangement", "check_scales", "finite", "non_negative", "one_of",
    "positive", "shortened", "whole",
]  # fmt: skip

LARGEST_COUNT = 2**53  # the last integer that a float tells from its neighbours
MOST_INSTANTS = 1_000_000  # that a run may save
LARGEST_RECORD = 60_000_000  # values a field: half a gigabyte
LARGEST = 1e60  # of every number, and its inverse of what is positive: fourth powers can still be calculated with
SCALES = ("wave_constant", "time_scale", "length_scale", "slow_time_scale", "epsilon")
GROUPS = ("epsilon_alpha", "epsilon_chi", "epsilon_psi", "epsilon_axial", "relative_damping", "kappa_over_nu")
NOT_HELD = ("rotation", "curvature_rate", "fourth_derivative")  # motions that a support does not allow


def finite(name: str, value: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` naming the field when it is no finite number."""
    try:
        number = math.nan if isinstance(value, (bool, str, bytes)) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        raise InputError(f"{name} must be a finite number (got {shortened(value)})")
    return number


def shortened(value: object) -> str:
    """``repr`` of a value, cut to one short line."""
    try:
        text = " ".join(repr(value).split())
    except ValueError:  # an integer of more digits than Python is willing to write
        text = "a number too long to write"
    except RecursionError:
        text = "tables or lists nested without end"
    return text if len(text) <= 80 else text[:77] + "..."


def positive(name: str, value: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not finite and > 0."""
    number = finite(name, value)
    if number <= 0.0:
        raise InputError(f"{name} must be positive (got {shortened(value)})")
    return number


def non_negative(name: str, value: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not finite and ≥ 0."""
    number = finite(name, value)
    if number < 0.0:
        raise InputError(f"{name} must not be negative (got {shortened(value)})")
    return number


def at_least(name: str, value: float, low: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not finite and ≥ ``low``."""
    number = finite(name, value)
    if number < low:
        raise InputError(f"{name} must be at least {low:g} (got {shortened(value)})")
    return number


def between(name: str, value: float, low: float, high: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not in [``low``, ``high``]."""
    number = finite(name, value)
    if not low <= number <= high:
        raise InputError(f"{name} must lie in [{low:g}, {high:g}] (got {shortened(value)})")
    return number


def whole(name: str, value: int, low: int) -> int:
    """Return ``value`` as an int, or raise ``ValueError`` when it is no whole number ≥ ``low``."""
    number = finite(name, value)
    if not low <= number <= LARGEST_COUNT or number != int(number):
        raise InputError(f"{name} must be a whole number of at least {low} (got {shortened(value)})")
    return int(number)


def one_of(name: str, value: str, allowed: Collection[str]) -> str:
    """Return ``value``, or raise ``ValueError`` listing what is allowed."""
    if not isinstance(value, str) or value not in allowed:
        raise InputError(f"{name} must be one of {', '.join(sorted(allowed))} (got {shortened(value)})")
    return value


def affordable(settings: str, steps: float, nodes: int, instants: int, most: float) -> None:
    """``ValueError`` naming ``settings`` when a run asks for more than ``most`` steps × nodes, or would keep more than
    ``LARGEST_RECORD`` nodes × saved instants in memory."""
    if steps * nodes > most:
        raise InputError(
            f"{settings} ask for {steps:.3g} steps of {nodes} nodes: {steps * nodes:.2g} steps x nodes, {most:.2g} are "
            "the most that one run takes; longer steps, larger elements or an earlier end time"
        )
    if instants * nodes > LARGEST_RECORD:
        raise InputError(
            f"save asks for {instants} instants of {nodes} nodes, {LARGEST_RECORD:.2g} values are the most; "
            "fewer instants or larger elements"
        )


# several fields of an Impact together -----------------------------------------------------------------------
def check_scales(impact: Any) -> None:
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


def check_arrangement(impact: Any) -> None:
    """``ValueError`` where supports, wall, first touch or bow contradict one another; it names field and value."""
    half = impact.half_length
    if abs(impact.first_touch) >= half:
        raise InputError(
            f"first_touch must lie on the beam, within {half!r} m of its middle (got {impact.first_touch!r})"
        )
    if impact.wall_curvature and impact.wall_curvature >= impact.curvature:
        raise InputError(
            f"wall_curvature must be less than the beam's curvature {impact.curvature!r}, or no point touches first "
            f"(got {impact.wall_curvature!r})"
        )
    for name in ("wall_from", "wall_to"):
        place = getattr(impact, name)
        if place is not None and not -half <= place <= half:
            raise InputError(
                f"{name} must lie on the beam, within {half!r} m of its middle (got {place!r}); leave it out for a "
                "wall that goes on"
            )
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
