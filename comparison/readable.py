"""Numbers as a reader writes them: 0.0025, 2.5·10⁻⁸, −1.3, a dash for nothing."""

from __future__ import annotations

from numbers import Real
from typing import Any

__all__ = ["readable"]

RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
SMALL, LARGE = 1e-3, 1e5  # beyond them a power of ten


def readable(value: Any, digits: int = 4) -> str:
    """Any value as text; floating-point numbers with so many significant digits, their zeros at the end left out."""
    if value is None:
        return "–"
    if isinstance(value, (bool, int, str)) or not isinstance(value, Real):
        return str(value)
    number = float(value)
    if number != number or number in (float("inf"), float("-inf")):
        return str(number)
    text = f"{number:.{digits}g}"
    if number != 0.0 and not SMALL <= abs(number) < LARGE:
        mantissa, power = f"{number:.{digits - 1}e}".split("e")
        mantissa = mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa
        factor = {"1": "", "-1": "-"}.get(mantissa, f"{mantissa}·")
        text = f"{factor}10{str(int(power)).translate(RAISED)}"
    elif "e" in text:
        text = f"{float(text):.0f}"
    return text.replace("-", "−")
