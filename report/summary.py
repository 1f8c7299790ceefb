"""Many rows in a few numbers: the headline, a table of each method, a table of what an acceleration does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

from report.impacts import ShownImpact
from report.rows import TableRow, labels, true_minus

__all__ = ["AccelerationRow", "SummaryRow", "acceleration_rows", "headline", "percent", "summary"]


def percent(value: float) -> str:
    """A share as per cent, two significant digits, rounded up: never better than it is."""
    size = max(100.0 * abs(value), 1e-4)
    digits = max(0, 1 - math.floor(math.log10(size)))
    step = 10.0**-digits
    return f"{math.ceil(size / step - 1e-9) * step:.{digits}f} %"


@dataclass(frozen=True)
class SummaryRow:
    """One method at one order. within, covered: numbers inside the tolerance, and with theory inside their error bar,
    of ``numbers``; largest, median: of their |error|, relative; seconds: the median row's."""

    order: str
    label: str
    rows: int
    numbers: int
    largest: float
    median: float
    within: int
    covered: int
    seconds: float | None


THIN = 0.02  # κ/ν; below it the front is so thin that it is a case of its own


def bands(leading: Sequence[TableRow]) -> list[tuple[str, list[TableRow]]]:
    """Rows of leading order by range of κ/ν, named."""
    thick = [r for r in leading if r.row.kappa_over_nu >= THIN]
    thin = [r for r in leading if r.row.kappa_over_nu < THIN]
    named = []
    for rows in (thick, thin):
        if rows:
            ends = dict.fromkeys(f(rows, key=lambda r: r.row.kappa_over_nu).ratio_text for f in (min, max))
            named.append((f"leading order, κ/ν = {' to '.join(ends)}", rows))
    return named


def summary(leading: Sequence[TableRow], first: Sequence[TableRow]) -> list[SummaryRow]:
    """A row for each order, range of κ/ν and method that has a number."""
    found = []
    for order, rows in (*bands(leading), ("first order", first)):
        for label in labels(r.row for r in rows):
            mine = [r for r in rows if r.row.label == label]
            cells = [c for r in mine for c in r.cells]
            errors = [abs(c.error) for c in cells]
            seconds = [r.row.seconds for r in mine if r.row.seconds is not None]
            if cells:
                found.append(
                    SummaryRow(
                        order,
                        label,
                        len(mine),
                        len(cells),
                        max(errors),
                        median(errors),
                        sum(abs(c.error) <= c.tolerance for c in cells),
                        sum(bool(c.number.covered) for c in cells),
                        median(seconds) if seconds else None,
                    )
                )
    return found


def headline(leading: Sequence[TableRow], first: Sequence[TableRow], failures: int) -> str:
    """The largest difference from theory of each method at each order, and how many rows failed."""
    rows = summary(leading, first)
    parts = [
        f"{order} {', '.join(f'{r.label} {percent(r.largest)}' for r in rows if r.order == order)}"
        for order in dict.fromkeys(r.order for r in rows)
    ]
    return f"Largest difference from theory: {'; '.join(parts) or 'no numbers'}. Rows failed: {failures}."


@dataclass(frozen=True)
class AccelerationRow:
    """What an acceleration does to one method's contact, at the end of the impact; ready to be shown.

    zone, reaction : change of contact length and end reaction against the same method's run without acceleration;
    uniform, theory : reaction per length in the zone over μV₀/t*; gap : the largest inside the zone, over V₀t.
    """

    impact: str
    label: str
    zone: str
    reaction: str
    uniform: str
    theory: str
    gap: str


def acceleration_rows(impacts: Sequence[ShownImpact]) -> list[AccelerationRow]:
    """A row for each run with acceleration whose method ran without it too."""
    plain = {i.label: i for i in impacts if i.shown.epsilon == 0.0}
    rows = []
    for impact in impacts:
        if impact.shown.epsilon == 0.0 or impact.label not in plain:
            continue
        base = plain[impact.label].data
        zone, reaction = (
            true_minus(f"{100 * (impact.data[name][-1] / base[name][-1] - 1):+.0f} %") for name in ("front", "reaction")
        )
        rows.append(
            AccelerationRow(
                f"{impact.shown.title}, ε = {impact.shown.epsilon:g}",
                impact.label,
                zone,
                reaction,
                true_minus(f"{impact.data['pressure'][-1]:.2f}"),
                f"{impact.shown.pressure:.2f}",
                percent(max(impact.data["lift"])),
            )
        )
    return rows
