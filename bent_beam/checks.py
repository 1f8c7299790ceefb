"""Validation at the door: every part of a run checks its own numbers with these, once, when it is made."""

from __future__ import annotations

import math
from collections.abc import Collection

__all__ = ["at_least", "between", "finite", "non_negative", "one_of", "positive", "whole"]


def finite(name: str, value: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` naming the field when it is no finite number."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        try:
            number = float(value) if not isinstance(value, (bool, str)) else math.nan
        except (TypeError, ValueError, OverflowError):
            number = math.nan
        if not math.isfinite(number):
            raise ValueError(f"{name} must be a finite number (got {value!r})")
        return number
    return float(value)


def positive(name: str, value: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not finite and > 0."""
    number = finite(name, value)
    if number <= 0.0:
        raise ValueError(f"{name} must be positive (got {value!r})")
    return number


def non_negative(name: str, value: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not finite and ≥ 0."""
    number = finite(name, value)
    if number < 0.0:
        raise ValueError(f"{name} must not be negative (got {value!r})")
    return number


def at_least(name: str, value: float, low: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not finite and ≥ ``low``."""
    number = finite(name, value)
    if number < low:
        raise ValueError(f"{name} must be at least {low:g} (got {value!r})")
    return number


def between(name: str, value: float, low: float, high: float) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` when it is not in [``low``, ``high``]."""
    number = finite(name, value)
    if not low <= number <= high:
        raise ValueError(f"{name} must lie in [{low:g}, {high:g}] (got {value!r})")
    return number


def whole(name: str, value: int, low: int) -> int:
    """Return ``value`` as an int, or raise ``ValueError`` when it is no whole number ≥ ``low``."""
    number = finite(name, value)
    if number != int(number) or number < low:
        raise ValueError(f"{name} must be a whole number of at least {low} (got {value!r})")
    return int(number)


def one_of(name: str, value: str, allowed: Collection[str]) -> str:
    """Return ``value``, or raise ``ValueError`` listing what is allowed."""
    if value not in allowed:
        raise ValueError(f"{name} must be one of {', '.join(sorted(allowed))} (got {value!r})")
    return value
