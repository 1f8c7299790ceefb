"""Many rows in a few numbers: the headline, a table of each method, a table of what an acceleration does."""

from __future__ import annotations

import math
from collections.abc import Sequence
from statistics import median
from typing import Any

from bent_beam_programs.report.impacts import ShownImpact
from bent_beam_programs.report.rows import TableRow, labels, true_minus

THIN = 0.02  # κ/ν; below it the front is so thin that it is a case of its own


def percent(value: float) -> str:
    """A share as per cent, two significant digits, rounded up: never better than it is."""
    size = max(100.0 * abs(value), 1e-4)
    digits = max(0, 1 - math.floor(math.log10(size)))
    step = 10.0**-digits
    return f"{math.ceil(size / step - 1e-9) * step:.{digits}f} %"


def bands(leading: Sequence[TableRow]) -> list[tuple[str, list[TableRow]]]:
    """Rows of leading order by range of κ/ν, named."""
    named = []
    for thin in (False, True):
        if rows := [r for r in leading if (r.row.kappa_over_nu < THIN) == thin]:
            ends = dict.fromkeys(f(rows, key=lambda r: r.row.kappa_over_nu).ratio_text for f in (min, max))
            named.append((f"leading order, κ/ν = {' to '.join(ends)}", rows))
    return named


def summary(leading: Sequence[TableRow], first: Sequence[TableRow]) -> list[dict[str, Any]]:
    """A row for each order, range of κ/ν and method that has a number.

    rows, numbers : how many; within, covered : numbers inside the tolerance, and with theory inside their error bar;
    largest, median : of their |error|, relative; seconds : the median row's.
    """
    found = []
    for order, rows in (*bands(leading), ("first order", first)):
        for label in labels(r.row for r in rows):
            mine = [r for r in rows if r.row.label == label]
            cells = [c for r in mine for c in r.cells]
            errors = [abs(c.error) for c in cells]
            seconds = [r.row.seconds for r in mine if r.row.seconds is not None]
            if cells:
                found.append(
                    {
                        "order": order,
                        "label": label,
                        "rows": len(mine),
                        "numbers": len(cells),
                        "largest": max(errors),
                        "median": median(errors),
                        "within": sum(abs(c.error) <= c.tolerance for c in cells),
                        "covered": sum(bool(c.number.covered) for c in cells),
                        "seconds": median(seconds) if seconds else None,
                    }
                )
    return found


def headline(leading: Sequence[TableRow], first: Sequence[TableRow], failures: int) -> str:
    """The largest difference from theory of each method at each order, and how many rows failed."""
    orders: dict[str, list[str]] = {}
    for r in summary(leading, first):
        orders.setdefault(r["order"], []).append(f"{r['label']} {percent(r['largest'])}")
    found = "; ".join(f"{order} {', '.join(each)}" for order, each in orders.items())
    return f"Largest difference from theory: {found or 'no numbers'}. Rows failed: {failures}."


def acceleration_rows(impacts: Sequence[ShownImpact]) -> list[dict[str, str]]:
    """What an acceleration does to a method's contact, at the end of the impact, ready to be shown: a row for each run
    with acceleration whose method ran without it too.

    zone, reaction : change of contact length and end reaction against the same method's run without acceleration;
    uniform, theory : reaction per length in the zone over μV₀/t*; gap : the largest inside the zone, over V₀t.
    """
    plain = {i.label: i for i in impacts if i.shown.epsilon == 0.0}
    rows = []
    for impact in impacts:
        if impact.shown.epsilon == 0.0 or impact.label not in plain:
            continue
        found, base = impact.data, plain[impact.label].data
        zone, reaction = (
            true_minus(f"{100 * (found[name][-1] / base[name][-1] - 1):+.0f} %") for name in ("front", "reaction")
        )
        rows.append(
            {
                "impact": f"{impact.shown.title}, ε = {impact.shown.epsilon:g}",
                "label": impact.label,
                "zone": zone,
                "reaction": reaction,
                "uniform": true_minus(f"{found['pressure'][-1]:.2f}"),
                "theory": f"{impact.shown.pressure:.2f}",
                "gap": percent(max(found["lift"])),
            }
        )
    return rows
