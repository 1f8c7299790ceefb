"""The report's sentences, drawn from its numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from comparison.report.impacts import ShownImpact
from comparison.report.noise import Noise
from comparison.report.rows import Cell, TableRow, labels, true_minus, worst

__all__ = [
    "acceleration_rows",
    "acceleration_short",
    "agreement_answer",
    "coverage",
    "edge_answer",
    "headline",
    "noise_answer",
    "powers",
    "problem_answer",
    "speed_answer",
]

SYMBOLS = {"lambda0": "λ₀", "r0": "r₀", "lambda1": "λ₁", "r1": "r₁"}


def percent(value: float) -> str:
    """A share as per cent, two significant digits, rounded up: never better than it is. Tiny ones are "less than"."""
    size = 100.0 * abs(value)
    if size == 0.0:
        return "0 %"
    if size < 1e-4:
        return "less than 0.0001 %"
    digits = max(0, 1 - math.floor(math.log10(size)))
    step = 10.0**-digits
    return f"{math.ceil(size / step - 1e-9) * step:.{digits}f} %"


RAISED = str.maketrans("-−0123456789", "⁻⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def powers(text: str) -> str:
    """``text`` with numbers like 7.0e-4 as 7.0·10⁻⁴, as a reader writes them."""
    return re.sub(r"(?<=\d)e([-−]?)0*(\d+)\b", lambda m: "·10" + (m[1] + m[2]).translate(RAISED), text)


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
            f"{name} within {percent(cell.error)} (median {percent(middle)}, {count} row{'s' if count > 1 else ''})"
            for name, cell, middle, count in _worst_of(rows)
        ]
        if each:
            parts.append(f"{what}: {', '.join(each)}")
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
            f"{f'(α, ψ, χ, N) = {row.first_text}, ' if row.row.of_first_order else ''}"
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
            count = f"medians of {len(shared)} rows" if len(shared) > 1 else "one row"
            sentences.append(f"at {order} a row takes {', '.join(each)} ({count})")
    if not sentences:
        return "No row was answered by two methods, so their times cannot be compared."
    text = "; ".join(sentences)
    return text[0].upper() + text[1:] + "."


def problem_answer(leading: Sequence[TableRow]) -> str:
    """λ₀ and r₀ of theory in figures, at the κ/ν among the rows nearest to 1/2."""
    found = [r for r in leading if len(r.cells) == 2 and r.cells[0].exact > 0.0]
    if not found:
        return ""
    row = min(found, key=lambda r: abs(r.row.kappa_over_nu - 0.5))
    front, force = row.cells
    return (
        f"At κ/ν = {row.ratio_text}, theory has λ₀ = {front.exact_text} and r₀ = {force.exact_text}: four times the "
        "time gives twice the contact length and half the reaction."
    )


def noise_answer(noise: Noise) -> str:
    """How much the reaction scatters and the zone lifts, before and after."""
    before, after = (f"{percent(noise.scatter(run))}" for run in (noise.before, noise.after))
    lifts = [percent(noise.lift(run)) for run in (noise.before, noise.after)]
    return (
        f"With the {noise.before.label} the reaction of one end scatters by {before} about theory and the zone lifts "
        f"by up to {lifts[0]} of V₀t, with the {noise.after.label} by {after} and {lifts[1]}. Both are runs of the "
        f"same code, in {noise.before.seconds:.2g} s and {noise.after.seconds:.2g} s."
    )


def _by_name(impacts: Sequence[ShownImpact]) -> dict[str, ShownImpact]:
    """One run of each impact: of the first method that ran all of them, so that like is compared with like."""
    names = {i.shown.name for i in impacts}
    for label in dict.fromkeys(i.label for i in impacts):
        mine = {i.shown.name: i for i in impacts if i.label == label}
        if set(mine) == names:
            return mine
    return {}


def acceleration_short(impacts: Sequence[ShownImpact]) -> str:
    """What an acceleration does, from the impacts pressed onto the wall and released from it."""
    by_name = _by_name(impacts)
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
        f"{100.0 * max(by_name['released'].data['lift']):.1g} % of V₀t ({by_name['plain'].label})."
    )


@dataclass(frozen=True)
class AccelerationRow:
    """What an acceleration does to one method's contact, at the end of the impact; ready to be shown.

    zone, reaction : change of contact length and end reaction against the same method's run without acceleration;
    uniform : reaction per length in the zone over μV₀/t*; gap : the largest inside the zone, over V₀t.
    """

    impact: str
    label: str
    zone: str
    reaction: str
    uniform: str
    gap: str


def _change(value: float, plain: float) -> str:
    return true_minus(f"{100 * (value / plain - 1):+.0f} %")


def acceleration_rows(impacts: Sequence[ShownImpact]) -> list[AccelerationRow]:
    """A row for each run with acceleration."""
    plain = {i.label: i for i in impacts if i.shown.name == "plain"}
    rows = []
    for impact in impacts:
        base = plain.get(impact.label)
        if base is None or impact is base:
            continue
        lift = max(impact.data["lift"])
        zone, reaction = (_change(impact.data[n][-1], base.data[n][-1]) for n in ("front", "reaction"))
        pressed = impact.shown.pressure > 0.0
        rows.append(
            AccelerationRow(
                f"{impact.shown.title}, ε = {impact.shown.epsilon:g}",
                impact.label,
                zone,
                reaction,
                f"{impact.data['pressure'][-1]:.3g} (theory: {impact.shown.pressure:.3g})" if pressed else "0",
                ("0" if lift == 0.0 else percent(lift)) + ("" if pressed else ": the middle lifts off"),
            )
        )
    return rows


def edge_answer(impacts: Sequence[ShownImpact]) -> str:
    """How much of the zone behind the front bears no uniform reaction, method by method, where theory has it all over.

    A trace of lift that the front leaves behind takes the load a time √(2 gap/ε(α+ψ)) to close.
    """
    shares = []
    for impact in impacts:
        if impact.shown.pressure <= 0.0:
            continue
        share = _empty_behind_front(impact)
        if share is not None:
            shares.append(f"{impact.label} {percent(share)}")
    if not shares:
        return ""
    return (
        "Theory has the uniform reaction on all of the zone. In the simulations a strip behind the front bears less "
        f"than half of it, at the end of the impact: {', '.join(shares)} of the zone's length (to within a bin of the "
        "map). There the load still closes the trace of gap that the moving front left, which takes it a time of "
        "√(2 gap/ε(α+ψ)); the finer the mesh at the front, the narrower the strip."
    )


def _empty_behind_front(impact: ShownImpact) -> float | None:
    """Length of the strip behind the front that bears less than half the uniform reaction, over λ_c, at the end."""
    field = impact.data["map"]
    x, force = np.array(field["x"]), np.array(field["force"][-1])
    front = impact.data["front"][-1]
    bears = np.flatnonzero((force > 0.5 * impact.shown.pressure) & (x < front - 2.0 * (x[1] - x[0])))
    if bears.size == 0:
        return None
    return max(0.0, 1.0 - (float(x[bears[-1]]) + 2.5 * float(x[1] - x[0])) / front)
