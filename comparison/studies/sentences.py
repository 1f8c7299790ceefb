"""Numbers of a study as sentences: the wording follows the numbers, so that a conclusion cannot disagree with its
table; a number that is missing is called "not measured".
"""

from __future__ import annotations

from collections.abc import Sequence

from comparison.studies.outcome import Outcome

__all__ = [
    "between",
    "moves",
    "number",
    "reference_sentences",
    "references_of",
    "signed",
    "smallest_and_largest",
    "values",
    "varied",
]

MISSING = "not measured"
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def varied(outcomes: Sequence[Outcome]) -> list[Outcome]:
    """The runs whose settings vary."""
    return [o for o in outcomes if not o.reference]


def references_of(outcomes: Sequence[Outcome]) -> list[Outcome]:
    """The methods that they are held against."""
    return [o for o in outcomes if o.reference]


def values(outcomes: Sequence[Outcome], name: str) -> list[float]:
    """One measure of all runs that have it."""
    return [float(v) for o in outcomes if (v := o.measures.get(name)) is not None]


def smallest_and_largest(outcomes: Sequence[Outcome], name: str) -> tuple[float, float] | None:
    """Of one measure; ``None`` when no run has it."""
    found = values(outcomes, name)
    return (min(found), max(found)) if found else None


def number(value: float | None) -> str:
    """Two significant digits, as a reader would write them; "not measured" for ``None``."""
    if value is None:
        return MISSING
    size = abs(value)
    if size < 1e-12:
        return "0"
    if 1e-3 <= size < 1e5:
        return f"{value:.2g}".replace("-", "−") if size < 100 else f"{value:.0f}".replace("-", "−")
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(RAISED)}".replace("-", "−")


def signed(value: float | None) -> str:
    return ("+" if value is not None and value > 0.0 else "") + number(value)


def between(outcomes: Sequence[Outcome], name: str, text: str = "") -> str:
    """``a to b unit`` of a measure, or ``a unit`` when it does not vary."""
    found = smallest_and_largest(outcomes, name)
    if found is None:
        return MISSING
    low, high = (number(v) for v in found)
    return (low if low == high else f"{low} to {high}") + text


def moves(outcomes: Sequence[Outcome], name: str, *, least: float, relative: bool = False) -> bool:
    """Whether a measure differs over the runs by more than ``least`` (``relative``: of its largest size)."""
    found = smallest_and_largest(outcomes, name)
    if found is None:
        return False
    low, high = found
    scale = max(abs(low), abs(high)) if relative else 1.0
    return high - low > least * scale


def reference_sentences(outcomes: Sequence[Outcome]) -> str:
    """What the references reach on the same case."""
    return " ".join(_reference(o) for o in references_of(outcomes))


def _reference(o: Outcome) -> str:
    measured = [
        ("λ₀ off by {} %", o.measures.get("contact_length_error"), signed),
        ("r₀ off by {} %", o.measures.get("reaction_error"), signed),
        ("a lift of {} V₀t", o.measures.get("lift"), number),
        ("{} % of noise", o.measures.get("noise"), number),
    ]
    found = [text.format(write(value)) for text, value, write in measured if value is not None]
    if not found:
        return f"{o.label} gave no number on this case."
    first = "" if o.exact.leading else " (end values; theory is of first order in ε)"
    return f"{o.label} on the same case: {', '.join(found)}{first}."
