"""What the report asks of both paths, how good an answer has to be, and the rows as cells of its tables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from comparison.matching import THESIS_KAPPAS, MatchRow, Question
from comparison.tables import leading_error, relative_error

__all__ = [
    "Cell",
    "TableRow",
    "first_order_rows",
    "leading_rows",
    "report_questions",
    "table_row",
    "tolerance",
    "worst",
]

First = tuple[float, float, float]


def signed(text: str) -> str:
    """With a true minus sign, as wide as a plus."""
    return text.replace("-", "−")


LEADING_HERMITE = (*THESIS_KAPPAS, 0.8)
LEADING_EXUDYN = tuple(k for k in LEADING_HERMITE if k >= 0.05)  # below, its fixed mesh would be too long
FIRST_HERMITE: tuple[First, ...] = (
    (1, 0, 0),
    (0, 1, 0),
    (0, 0, 1),
    (4, 0, 0),
    (0, 2, 0),
    (1, 1, 1),
    (-1, 0, 0),
    (-1, -1, 0),
    (-1, -1, 1),
)
FIRST_ELSEWHERE: tuple[First, ...] = ((1, 0, 0), (1, 1, 1), (-1, -1, 1))
ELSEWHERE = (0.1, 0.3, 0.8)
FIRST_EXUDYN: tuple[First, ...] = ((4, 0, 0), (1, 1, 1), (-1, -1, 0))


def report_questions() -> list[Question]:
    """Every row of the report, the longest first so that no core idles at the end."""
    return [
        *(Question("exudyn", 0.5, first) for first in FIRST_EXUDYN),
        *(Question("hermite", k, first) for first in FIRST_ELSEWHERE for k in ELSEWHERE),
        *(Question("hermite", 0.5, first) for first in FIRST_HERMITE),
        *(Question("exudyn", k) for k in LEADING_EXUDYN),
        *(Question("hermite", k) for k in LEADING_HERMITE),
    ]


def tolerance(path: str, what: str, kappa_over_nu: float) -> float:
    """The relative error that this project holds itself to (its regression tests do)."""
    if what in ("lambda0", "r0"):
        return 0.005
    if path == "hermite":
        return 0.03 if kappa_over_nu < 0.3 else 0.01
    return {"lambda1": 0.04, "r1": 0.03}[what]


@dataclass(frozen=True)
class Cell:
    """One number of a row against theory. ``error`` and ``bar`` are relative (see :func:`tolerance`)."""

    what: str
    value: float
    bar_absolute: float
    exact: float
    error: float
    bar: float
    tolerance: float

    @property
    def grade(self) -> str:
        """``good`` within half the tolerance, ``fair`` within it, ``poor`` up to thrice, ``bad`` beyond."""
        size = abs(self.error) / self.tolerance
        return "good" if size <= 0.5 else "fair" if size <= 1.0 else "poor" if size <= 3.0 else "bad"

    @property
    def covered(self) -> bool:
        """Does the error bar hold the theory?"""
        return abs(self.error) <= self.bar

    @property
    def share(self) -> float:
        """The error over the tolerance, at most 1: the length of the bar in the table."""
        return min(abs(self.error) / self.tolerance, 1.0)

    @property
    def value_text(self) -> str:
        """Value ± error bar, with as many digits as the error bar leaves."""
        if not (self.bar_absolute > 0.0 and math.isfinite(self.bar_absolute)):
            return signed(f"{self.value:.6g}")
        digits = max(0, min(8, 1 - math.floor(math.log10(self.bar_absolute))))
        return signed(f"{self.value:.{digits}f} ±\u00a0{self.bar_absolute:.{digits}f}")

    @property
    def error_text(self) -> str:
        """The relative error in per cent."""
        size = 100.0 * self.error
        if abs(size) < 5e-4:
            return "0.000 %"
        return signed(f"{size:+.3f} %" if abs(size) < 0.1 else f"{size:+.2f} %")

    @property
    def exact_text(self) -> str:
        return signed(f"{self.exact:.6g}")


@dataclass(frozen=True)
class TableRow:
    """A row of the report's tables: its cells, and what else is said of it."""

    row: MatchRow
    cells: tuple[Cell, ...]

    @property
    def ratio_text(self) -> str:
        """κ/ν as the thesis writes it (1/1600), or as a number."""
        inverse = 1.0 / self.row.kappa_over_nu
        whole = abs(inverse - round(inverse)) < 1e-9 and inverse > 10.5
        return f"1/{round(inverse)}" if whole else f"{self.row.kappa_over_nu:g}"

    @property
    def first_text(self) -> str:
        """(α, ψ, χ) with proper minus signs."""
        return signed("(" + ", ".join(f"{v:g}" for v in first_of(self.row)) + ")")


def first_of(row: MatchRow) -> First:
    return (row.alpha, row.psi, row.chi)


def cell(row: MatchRow, what: str) -> Cell | None:
    """The cell of one number of a row; ``None`` where the row does not have it."""
    value, bar, exact = (getattr(row, what + end) for end in ("", "_error", "_theory"))
    if value is None or bar is None or exact is None:
        return None
    if what in ("lambda0", "r0"):
        error, unit = leading_error(value, exact), exact if exact > 0.0 else 1.0
    else:
        error, unit = relative_error(value, exact), max(abs(exact), 1.0)
    return Cell(what, value, bar, exact, error, bar / unit, tolerance(row.path, what, row.kappa_over_nu))


def table_row(row: MatchRow) -> TableRow:
    """A row with the cells that it is about: λ₁ and r₁ where it has them, λ₀ and r₀ otherwise."""
    names = ("lambda0", "r0") if row.lambda1 is None else ("lambda1", "r1")
    return TableRow(row, tuple(c for name in names if (c := cell(row, name)) is not None))


def leading_rows(rows: Iterable[MatchRow]) -> list[TableRow]:
    """Rows of leading order, by κ/ν, Hermite before Exudyn."""
    chosen = [r for r in rows if r.lambda1 is None]
    return [table_row(r) for r in sorted(chosen, key=lambda r: (r.kappa_over_nu, r.path != "hermite"))]


def first_order_rows(rows: Iterable[MatchRow]) -> list[TableRow]:
    """Rows of first order, by κ/ν, (α, ψ, χ) and path."""
    chosen = [r for r in rows if r.lambda1 is not None]
    order = {first: i for i, first in enumerate(FIRST_HERMITE)}
    return [
        table_row(r)
        for r in sorted(
            chosen,
            key=lambda r: (r.kappa_over_nu, order.get(first_of(r), 99), first_of(r), r.path != "hermite"),
        )
    ]


def worst(rows: Sequence[TableRow], path: str) -> Cell | None:
    """The cell of one path that is furthest from theory; ``None`` without rows."""
    cells = [c for r in rows if r.row.path == path for c in r.cells]
    return max(cells, key=lambda c: abs(c.error), default=None)
