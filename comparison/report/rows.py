"""What the report asks of both paths, how good an answer has to be, and the rows as cells of its tables."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from bent_beam.method import Method
from comparison.compared import Compared
from comparison.match import First, MatchRow, Question
from comparison.methods import default_methods
from comparison.tables import LEAST

__all__ = [
    "Cell",
    "TableRow",
    "convergence_rows",
    "first_order_rows",
    "labels",
    "leading_rows",
    "report_questions",
    "table_row",
    "tolerance",
    "worst",
]


def true_minus(text: str) -> str:
    """With a true minus sign, as wide as a plus."""
    return text.replace("-", "−")


PATHS = ("hermite", "self_similar", "exudyn")
LEADING = (1 / 1600, 1 / 20, 1 / 4, 1 / 2, 0.8)
MIDDLE = 0.5
FIRST: tuple[First, ...] = ((4, 0, 0, 0), (-1, -1, 0, 0))  # a pressed zone and a lifting one
REFINES = (0.5, 1.0)


def report_questions(
    methods: Sequence[Method] | None = None, refines: Sequence[float] = REFINES
) -> list[Question]:
    """Every row of the report, few enough for a minute and a half.

    The longest come first, so that no core idles at the end, and a method's two loads apart, so that the second finds
    the run without loads in the store.

    Leading order over κ/ν; convergence and two loads of first order at κ/ν = 0.5. A row of first order is five runs and
    their companions: ``bentbeam match --first-order`` asks for more of them.
    """
    methods = default_methods(PATHS) if methods is None else methods
    return [
        *(Question(m, LEADING[0]) for m in reversed(methods)),
        *(Question(m, MIDDLE, load) for load in FIRST for m in reversed(methods)),
        *(Question(m, k) for k in LEADING[1:] for m in reversed(methods)),
        *(Question(m, MIDDLE, None, r) for m in methods for r in refines if r != 1.0),
    ]


def tolerance(what: str, kappa_over_nu: float) -> float:
    """The relative error that this project holds itself to (its regression tests do)."""
    if what in ("lambda0", "r0"):
        return 0.001
    return 0.03 if kappa_over_nu < 0.3 else 0.01


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
            return true_minus(f"{self.value:.6g}")
        digits = max(0, min(8, 1 - math.floor(math.log10(self.bar_absolute))))
        return true_minus(f"{self.value:.{digits}f} ±\u00a0{self.bar_absolute:.{digits}f}")

    @property
    def error_text(self) -> str:
        """The relative error in per cent, two digits and its sign."""
        size = 100.0 * self.error
        if abs(size) < 1e-4:
            return "< 0.0001 %"
        return true_minus(f"{size:+.{max(0, 1 - math.floor(math.log10(abs(size))))}f} %")

    @property
    def exact_text(self) -> str:
        return true_minus(f"{self.exact:.6g}")


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
        return true_minus("(" + ", ".join(f"{v:g}" for v in self.row.first) + ")")


def cell(row: MatchRow, what: str) -> Cell | None:
    """The cell of one number of a row; ``None`` where the row does not have it."""
    number: Compared = getattr(row, what)
    error, bar = number.relative(LEAST[what]), number.relative_error(LEAST[what])
    if number.value is None or number.error is None or number.theory is None or error is None or bar is None:
        return None
    limit = tolerance(what, row.kappa_over_nu)
    return Cell(what, number.value, number.error, number.theory, error, bar, limit)


def table_row(row: MatchRow) -> TableRow:
    """A row with the cells that it is about: λ₁ and r₁ where it has them, λ₀ and r₀ otherwise."""
    return TableRow(row, tuple(c for name in row.compared() if (c := cell(row, name)) is not None))


def leading_rows(rows: Iterable[MatchRow]) -> list[TableRow]:
    """Rows of leading order at the methods' own resolution, by κ/ν; methods stay in their order."""
    chosen = [r for r in rows if not r.of_first_order and r.refine == 1.0 and r.reason is None]
    order = {label: i for i, label in enumerate(labels(chosen))}
    return [table_row(r) for r in sorted(chosen, key=lambda r: (r.kappa_over_nu, order[r.label]))]


def labels(rows: Iterable[MatchRow]) -> list[str]:
    """Labels of the methods, in order: those of this project first."""
    found = {r.label: r.path for r in rows}
    return sorted(found, key=lambda name: PATHS.index(found[name]) if found[name] in PATHS else len(PATHS))


def first_order_rows(rows: Iterable[MatchRow]) -> list[TableRow]:
    """Rows of first order at the methods' own resolution, by κ/ν, (α, ψ, χ, N) and method."""
    chosen = [r for r in rows if r.of_first_order and r.refine == 1.0 and r.reason is None]
    order = {label: i for i, label in enumerate(labels(chosen))}
    return [table_row(r) for r in sorted(chosen, key=lambda r: (r.kappa_over_nu, r.first, order[r.label]))]


def convergence_rows(rows: Iterable[MatchRow]) -> list[TableRow]:
    """Rows of leading order whose κ/ν was asked at several refinements, from coarse to fine."""
    chosen = [r for r in rows if not r.of_first_order and r.reason is None]
    several = {r.kappa_over_nu for r in chosen if r.refine != 1.0}
    return [table_row(r) for r in sorted(chosen, key=lambda r: r.refine) if r.kappa_over_nu in several]


def worst(rows: Sequence[TableRow], label: str) -> Cell | None:
    """The cell of one method that is furthest from theory; ``None`` without rows."""
    cells = [c for r in rows if r.row.label == label for c in r.cells]
    return max(cells, key=lambda c: abs(c.error), default=None)
