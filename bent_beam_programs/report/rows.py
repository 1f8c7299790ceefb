"""What the report asks of every method, how good an answer has to be, the rows as cells of its tables, and many of them
in a few numbers."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from statistics import median
from typing import Any

from bent_beam.measure.numbers import Number
from bent_beam.method import Method
from comparison.rows import HELD_AGAINST, First, MatchQuestion, MatchRow

PATHS = ("hermite", "self_similar", "exudyn")
LEADING = (1 / 100, 1 / 20, 1 / 4, 1 / 2, 0.8)  # a thinner front takes half a minute: bentbeam match
MIDDLE = 0.5
ALONG = (0.25, MIDDLE, 0.8)  # κ/ν of first order
FIRST: tuple[First, ...] = ((4, 0, 0, 0), (-1, -1, 0, 0))  # a pressed zone and a lifting one
THIN = 0.02  # κ/ν; below it the front is so thin that it is a case of its own


def true_minus(text: str) -> str:
    """With a true minus sign, as wide as a plus."""
    return text.replace("-", "−")


def report_questions(methods: Sequence[Method], refines: Sequence[float]) -> list[MatchQuestion]:
    """Every row of the report, few enough for two minutes. Leading order over κ/ν; two loads of first order at three
    κ/ν; convergence at κ/ν = 0.5. The longest come first, so that no core idles at the end, and a method's two loads
    apart, so that the second finds the run without loads in the store."""
    return [
        *(MatchQuestion(m, LEADING[0]) for m in reversed(methods)),
        *(MatchQuestion(m, k, load) for load in FIRST for k in ALONG for m in reversed(methods)),
        *(MatchQuestion(m, k) for k in LEADING[1:] for m in reversed(methods)),
        *(MatchQuestion(m, MIDDLE, None, r) for m in methods for r in refines if r != 1.0),
    ]


def tolerance(what: str, kappa_over_nu: float) -> float:
    """The relative error that this project holds itself to (its regression tests do)."""
    return 0.001 if what in ("lambda0", "r0") else 0.03 if kappa_over_nu < 0.3 else 0.01


@dataclass(frozen=True)
class Cell:
    """One number of a row that has value, error bar and theory, as the tables show it."""

    what: str
    number: Number
    tolerance: float

    @property
    def error(self) -> float:
        """The difference from theory, relative (see :func:`tolerance`)."""
        return self.number.relative(HELD_AGAINST[self.what]) or 0.0

    @property
    def bar(self) -> float:
        return self.number.relative_bar(HELD_AGAINST[self.what]) or 0.0

    @property
    def grade(self) -> str:
        """``good`` within half the tolerance, ``fair`` within it, ``poor`` up to thrice, ``bad`` beyond."""
        size = abs(self.error) / self.tolerance
        return "good" if size <= 0.5 else "fair" if size <= 1.0 else "poor" if size <= 3.0 else "bad"

    @property
    def value_text(self) -> str:
        return true_minus(str(self.number).replace("± ", "±\u00a0"))

    @property
    def error_text(self) -> str:
        """The relative error in per cent, two digits and its sign."""
        size = 100.0 * self.error
        if abs(size) < 1e-4:
            return "< 0.0001 %"
        return true_minus(f"{size:+.{max(0, 1 - math.floor(math.log10(abs(size))))}f} %")

    @property
    def theory_text(self) -> str:
        return true_minus(f"{self.number.theory:.6g}")


@dataclass(frozen=True)
class TableRow:
    """A row of the report's tables."""

    row: MatchRow

    @property
    def columns(self) -> list[Cell | None]:
        """What the row is about: λ₁ and r₁ of a load, λ₀ and r₀ otherwise; ``None`` where it has no number."""
        numbers, kappa = self.row.compared(), self.row.kappa_over_nu
        return [
            None if one.covered is None else Cell(name, one, tolerance(name, kappa)) for name, one in numbers.items()
        ]

    @property
    def cells(self) -> list[Cell]:
        """Those of :attr:`columns` that it has."""
        return [cell for cell in self.columns if cell is not None]

    @property
    def ratio_text(self) -> str:
        """κ/ν as the thesis writes it (1/1600), or as a number."""
        inverse = 1.0 / self.row.kappa_over_nu
        whole = abs(inverse - round(inverse)) < 1e-9 and inverse > 10.5
        return f"1/{round(inverse)}" if whole else f"{self.row.kappa_over_nu:g}"

    @property
    def first_text(self) -> str:
        """(α, ψ, χ, N)."""
        return true_minus("(" + ", ".join(f"{v:g}" for v in self.row.first) + ")")


def labels(rows: Iterable[MatchRow]) -> list[str]:
    """Labels of the methods, in order: those of this project first."""
    found = {r.label: r.path for r in rows}
    return sorted(found, key=lambda name: PATHS.index(found[name]) if found[name] in PATHS else len(PATHS))


def _at_own_resolution(rows: Iterable[MatchRow], *, first: bool) -> list[TableRow]:
    """Rows of leading or first order at the methods' own resolution, by κ/ν, (α, ψ, χ, N) and method."""
    chosen = [r for r in rows if r.of_first_order == first and r.refine == 1.0 and r.reason is None]
    order = {label: i for i, label in enumerate(labels(chosen))}
    return [TableRow(r) for r in sorted(chosen, key=lambda r: (r.kappa_over_nu, r.first, order[r.label]))]


leading_rows = partial(_at_own_resolution, first=False)
first_order_rows = partial(_at_own_resolution, first=True)


def percent(value: float) -> str:
    """A share as per cent, two significant digits, rounded up: never better than it is."""
    size = max(100.0 * abs(value), 1e-4)
    digits = max(0, 1 - math.floor(math.log10(size)))
    step = 10.0**-digits
    return f"{math.ceil(size / step - 1e-9) * step:.{digits}f} %"


def summary(leading: Sequence[TableRow], first: Sequence[TableRow]) -> list[dict[str, Any]]:
    """A row for each order, range of κ/ν and method that has a number.

    rows, numbers : how many; within, covered : numbers inside the tolerance, and with theory inside their error bar;
    largest, median : of their |error|, relative; seconds : the median row's.
    """
    orders: list[tuple[str, Sequence[TableRow]]] = []
    for thin in (False, True):
        if rows := [r for r in leading if (r.row.kappa_over_nu < THIN) == thin]:
            ends = dict.fromkeys(f(rows, key=lambda r: r.row.kappa_over_nu).ratio_text for f in (min, max))
            orders.append((f"leading order, κ/ν = {' to '.join(ends)}", rows))
    found = []
    for order, every in (*orders, ("first order", first)):
        for label in labels(r.row for r in every):
            mine = [r for r in every if r.row.label == label]
            cells = [c for r in mine for c in r.cells]
            if not cells:
                continue
            errors = [abs(c.error) for c in cells]
            seconds = [r.row.seconds for r in mine if r.row.seconds is not None]
            row: dict[str, Any] = {"order": order, "label": label, "rows": len(mine), "numbers": len(cells)}
            row |= {"largest": max(errors), "median": median(errors)}
            row |= {"within": sum(abs(c.error) <= c.tolerance for c in cells)}
            row |= {"covered": sum(bool(c.number.covered) for c in cells)}
            found.append(row | {"seconds": median(seconds) if seconds else None})
    return found


def headline(leading: Sequence[TableRow], first: Sequence[TableRow], failures: int) -> str:
    """The largest difference from theory of each method at each order, and how many rows failed."""
    orders: dict[str, list[str]] = {}
    for r in summary(leading, first):
        orders.setdefault(r["order"], []).append(f"{r['label']} {percent(r['largest'])}")
    found = "; ".join(f"{order} {', '.join(each)}" for order, each in orders.items())
    return f"Largest difference from theory: {found or 'no numbers'}. Rows failed: {failures}."
