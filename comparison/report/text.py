"""The report's sentences, drawn from its numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import median

from comparison.report.impacts import ShownImpact
from comparison.report.rows import Cell, TableRow, labels, worst

__all__ = [
    "acceleration_answer",
    "acceleration_short",
    "agreement_answer",
    "coverage",
    "headline",
    "speed_answer",
]

SYMBOLS = {"lambda0": "λ₀", "r0": "r₀", "lambda1": "λ₁", "r1": "r₁"}


def percent(value: float) -> str:
    """A share as per cent, two significant digits, rounded up: never better than it is."""
    size = 100.0 * abs(value)
    if size == 0.0:
        return "0 %"
    digits = max(0, 1 - math.floor(math.log10(size)))
    step = 10.0**-digits
    return f"{math.ceil(size / step - 1e-9) * step:.{digits}f} %"


def _worst_of(rows: Sequence[TableRow]) -> list[tuple[str, Cell, float, int]]:
    """Label, worst cell, median error and number of rows of each method that has any."""
    found = []
    for name in labels(r.row for r in rows):
        cell = worst(rows, name)
        if cell is not None:
            mine = [r for r in rows if r.row.label == name]
            found.append((name, cell, median(abs(c.error) for r in mine for c in r.cells), len(mine)))
    return found


def headline(leading: Sequence[TableRow], first: Sequence[TableRow], failures: int) -> str:
    """One sentence: how good the agreement is."""
    parts = []
    for what, rows in (("leading order (λ₀, r₀)", leading), ("first order (λ₁, r₁)", first)):
        each = [
            f"{name} within {percent(cell.error)} (median {percent(middle)}, {count} rows)"
            for name, cell, middle, count in _worst_of(rows)
        ]
        if each:
            parts.append(f"{what}: {' and '.join(each)}")
    if not parts:
        return f"No row could be computed ({failures} failed)."
    lost = f" {failures} row{'s' if failures != 1 else ''} failed." if failures else ""
    return "Simulation against theory at " + "; ".join(parts) + "." + lost


def coverage(rows: Sequence[TableRow]) -> tuple[int, int]:
    """How many numbers have the theory inside their error bar, of how many."""
    cells = [c for r in rows for c in r.cells]
    return sum(c.covered for c in cells), len(cells)


def agreement_answer(leading: Sequence[TableRow], first: Sequence[TableRow]) -> str:
    """The answer to "how good is the agreement?" in two or three sentences."""
    rows = [*leading, *first]
    if not rows:
        return "Nothing was computed."
    cells = [c for r in rows for c in r.cells]
    within = sum(abs(c.error) <= c.tolerance for c in cells)
    covered, total = coverage(rows)
    text = (
        f"{within} of {len(cells)} numbers are within the tolerance that this project holds itself to, "
        f"and for {covered} of {total} the theory lies inside the error bar that the simulation gives itself."
    )
    beyond = [(abs(c.error) / c.tolerance, r, c) for r in rows for c in r.cells if abs(c.error) > c.tolerance]
    if beyond:
        _, row, cell = max(beyond, key=lambda b: b[0])
        text += (
            f" Furthest beyond it: {row.row.label}, κ/ν = {row.ratio_text}, "
            f"(α, ψ, χ, N) = {row.first_text}, "
            f"{SYMBOLS[cell.what]} = {cell.value_text} (theory {cell.exact_text})."
        )
    return text


def speed_answer(leading: Sequence[TableRow], first: Sequence[TableRow]) -> str:
    """What a row takes with each method: the median of those that all of them answered."""
    sentences = []
    for order, rows in (("leading order", leading), ("first order", first)):
        seconds: dict[str, dict[tuple[float, ...], float]] = {}
        for r in rows:
            if r.row.seconds is not None:
                seconds.setdefault(r.row.label, {})[(r.row.kappa_over_nu, *r.row.first)] = r.row.seconds
        shared = set.intersection(*(set(mine) for mine in seconds.values())) if seconds else set()
        if shared and len(seconds) > 1:
            each = [f"{label} {median(mine[k] for k in shared):.2g} s" for label, mine in seconds.items()]
            sentences.append(f"at {order} a row takes {', '.join(each)} (medians of {len(shared)} rows)")
    if not sentences:
        return "No row was answered by two methods, so their times cannot be compared."
    text = "; ".join(sentences)
    return text[0].upper() + text[1:] + "."


def _change(value: float, plain: float, what: str) -> str:
    share = value / plain - 1.0
    return f"{what} is {abs(100 * share):.0f} % {'larger' if share > 0 else 'smaller'}"


def acceleration_short(impacts: Sequence[ShownImpact]) -> str:
    """The same in one breath, from the impacts pressed onto the wall and released from it."""
    by_name = {i.shown.name: i for i in impacts}
    if not {"plain", "pressed", "released"} <= set(by_name):
        return "The impacts with acceleration could not be computed."

    def change(name: str, what: str) -> str:
        share = 100.0 * (by_name[name].data[what][-1] / by_name["plain"].data[what][-1] - 1.0)
        return f"{abs(share):.0f} % {'more' if share > 0.0 else 'less'}"

    return (
        f"Into the wall, it spreads the contact faster ({change('pressed', 'front')} at the end of the "
        f"impact shown), raises the end reactions ({change('pressed', 'reaction')}) and presses the whole "
        f"zone on the wall. Away from it, the contact spreads slower ({change('released', 'front')}), the "
        f"reactions fall ({change('released', 'reaction')}) and the middle of the zone lifts off, by "
        f"{100.0 * max(by_name['released'].data['lift']):.1g} % of V₀t."
    )


def acceleration_answer(impacts: Sequence[ShownImpact]) -> list[str]:
    """What α does to the contact: a sentence an impact, measured at its end against the impact without it."""
    by_name = {i.shown.name: i for i in impacts}
    plain = by_name.get("plain")
    if plain is None:
        return []
    sentences = []
    for impact in impacts:
        if impact is plain:
            continue
        shown, data = impact.shown, impact.data
        zone = _change(data["front"][-1], plain.data["front"][-1], "the contact zone")
        force = _change(
            data["reaction"][-1], plain.data["reaction"][-1], "the concentrated reaction at each of its ends"
        )
        load = shown.epsilon * (shown.first[0] + shown.first[1])
        if load > 0.0:
            inside = (
                f"the beam stays on the wall (largest gap inside {max(data['lift']):.0e} V₀t), which now "
                f"carries a uniform reaction of {data['pressure'][-1]:.3g} μV₀/t* per length, the "
                f"ε(α+ψ) = {load:.3g} that theory says"
            )
        else:
            inside = (
                f"the middle lifts off at once, by up to {100 * max(data['lift']):.2g} % of V₀t, and only "
                "the two ends of the zone still touch"
            )
        sentences.append(
            f"{shown.title[0].upper() + shown.title[1:]}, ε = {shown.epsilon:g}: at τ = {data['time'][-1]:g} "
            f"{zone} and {force} than without acceleration; {inside}."
        )
    return sentences
