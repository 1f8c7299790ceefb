"""Numbers of a study as words: the wording follows the numbers, so that a conclusion cannot disagree with its
table.
"""

from __future__ import annotations

from collections.abc import Sequence

from comparison.studies.outcome import Outcome

__all__ = ["between", "cure", "moves", "number", "of_kind", "signed", "smallest_and_largest", "values"]


def of_kind(outcomes: Sequence[Outcome], kind: str) -> list[Outcome]:
    """The outcomes of one kind ("thesis": the fixed mesh of the thesis's settings; "hermite", "exudyn": ours)."""
    return [o for o in outcomes if o.kind == kind]


def values(outcomes: Sequence[Outcome], name: str) -> list[float]:
    """One measure of all runs that have it."""
    return [float(v) for o in outcomes if (v := o.measures.get(name)) is not None]


def smallest_and_largest(outcomes: Sequence[Outcome], name: str) -> tuple[float, float]:
    found = values(outcomes, name) or [0.0]
    return min(found), max(found)


def number(value: float) -> str:
    """Two significant digits, as a reader would write them."""
    size = abs(value)
    if size < 1e-12:
        return "0"
    if 1e-3 <= size < 1e5:
        return f"{value:.2g}" if size < 100 else f"{value:.0f}"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def signed(value: float) -> str:
    return ("+" if value > 0.0 else "") + number(value)


def between(outcomes: Sequence[Outcome], name: str, text: str = "") -> str:
    """``a to b unit`` of a measure, or ``a unit`` when it does not vary."""
    low, high = smallest_and_largest(outcomes, name)
    same = number(low) == number(high)
    return (number(low) if same else f"{number(low)} to {number(high)}") + text


def moves(outcomes: Sequence[Outcome], name: str, *, tell: float, relative: bool = False) -> bool:
    """Whether a measure differs over the runs by more than ``tell`` (``relative``: of its largest size)."""
    low, high = smallest_and_largest(outcomes, name)
    scale = max(abs(low), abs(high)) if relative else 1.0
    return high - low > tell * scale


def cure(outcomes: Sequence[Outcome]) -> str:
    """What the run that cures it reaches."""
    ours = of_kind(outcomes, "hermite")
    if not ours:
        return ""
    best = ours[-1]
    m = best.measures
    parts = []
    if m["contact_length_error"] is not None:
        parts.append(f"λ₀ within {number(abs(m['contact_length_error']))} %")
    if m["reaction_error"] is not None:
        parts.append(f"r₀ within {number(abs(m['reaction_error']))} %")
    parts.append(f"a lift of {number(m['lift'] or 0.0)} V₀t and {number(m['noise'] or 0.0)} % of noise")
    first = " (end values; theory is of first order in ε)" if not best.exact.leading else ""
    return (
        "With the front resolved at all times and the waves absorbed "
        f"({best.label.lower().replace('hermite', 'Hermite')}) the same case gives {', '.join(parts)}{first}."
    )
