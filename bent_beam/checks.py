"""Validation: every part of a run checks its own numbers with these, once, when it is made."""

import math
from collections.abc import Collection

from bent_beam.errors import InputError

LARGEST_COUNT = 2**53  # the last integer that a float tells from its neighbours
MOST_INSTANTS = 1_000_000  # that a run may save
LARGEST_RECORD = 60_000_000  # values a field: half a gigabyte
LARGEST = 1e60  # of every number, and its inverse of what is positive: fourth powers can still be calculated with


def finite(name: str, value: float, unit: str | None = None) -> float:
    """Return ``value`` as a float, or raise ``ValueError`` naming the field when it is no finite number. unit : of a
    field that may be written in a file."""
    try:
        number = math.nan if isinstance(value, (bool, str, bytes)) else float(value)
    except (TypeError, ValueError, OverflowError):
        number = math.nan
    if not math.isfinite(number):
        wanted = "" if unit in (None, "", "1") else f" in {unit}"
        wanted += ", with a decimal point and without its unit" if unit is not None and isinstance(value, str) else ""
        raise InputError(f"{name} must be a finite number{wanted} (got {shortened(value)})")
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
            "the most that one run takes: take longer steps, larger elements or an earlier end time"
        )
    if instants * nodes > LARGEST_RECORD:
        raise InputError(
            f"save asks for {instants} instants of {nodes} nodes, {LARGEST_RECORD:.2g} values are the most; "
            "fewer instants or larger elements"
        )
