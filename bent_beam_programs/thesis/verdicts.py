"""Printed numbers of the thesis and the class of each, by the rules that head their table
(:data:`bent_beam_programs.thesis.gallery.numbers.HEAD`). A number that follows from a formula has no same order."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from decimal import Decimal

from comparison.readable import readable

ROUNDING, SAME, OFF = "within rounding", "same order", "off"
RULE, AXES = "other rule, stated by the thesis", "inferred from axes"
CLASSES = (ROUNDING, SAME, OFF, RULE, AXES)
FACTOR = 2.0  # of the same order: at most so many times larger or smaller


def digits(printed: str) -> int:
    return len(Decimal(printed).as_tuple().digits)


def unit_of(printed: str) -> float:
    """One unit of the last printed digit."""
    return 10.0 ** int(Decimal(printed).as_tuple().exponent)


def within_rounding(printed: str, value: float) -> bool:
    """Whether a value rounds to the printed digits; one half-way between two may go either way. One below a power of
    ten has a finer last digit: of one digit 0.588 is 0.6, not 1."""
    own = 10.0 ** (math.floor(math.log10(abs(value))) + 1 - digits(printed)) if value else math.inf
    return abs(value - float(printed)) <= (0.5 + 1e-9) * min(unit_of(printed), own)


@dataclass(frozen=True)
class Printed:
    """One printed number.

    where : section, equation, figure or table; what : of what, with its unit; printed : its digits, as they stand.
    ours : computed; why : how it was measured, what is wrong or stays open.
    read : the thesis read it off a run or a mesh, or prints an order of magnitude. rule : what the thesis's own rule
    gives, where that is another than ours. axes : no number is printed, an axis ends there. consistent : of numbers
    that test a simulation, what the same run gives with the printed mass matrix, (3.1.8).
    """

    where: str
    what: str
    printed: str
    ours: float
    why: str = ""
    read: bool = False
    rule: float | None = None
    axes: bool = False
    consistent: float | None = None

    @property
    def verdict(self) -> str:
        if self.axes:
            return AXES
        if within_rounding(self.printed, self.ours):
            return ROUNDING
        value = float(self.printed)
        if self.rule is not None and abs(self.rule - value) <= unit_of(self.printed):
            return RULE
        return SAME if self.read and 1.0 / FACTOR <= self.ours / value <= FACTOR else OFF

    def row(self) -> list[str]:
        """Cells: where, what, printed, computed, their ratio, class, value and class with (3.1.8), why."""
        ratio, other = f"{self.ours / float(self.printed):.3g}" if not self.axes else "–", ""
        if self.consistent is not None:
            other = f"{readable(self.consistent, 3)}: {replace(self, ours=self.consistent).verdict}"
        long = "e" in self.printed
        printed = readable(float(self.printed), digits(self.printed)) if long else self.printed.replace("-", "−")
        return [self.where, self.what, printed, readable(self.ours, 5), ratio, self.verdict, other, self.why]


def counts(rows: Sequence[Sequence[str]]) -> list[tuple[str, int, int, int, int]]:
    """(class, rows in it, the same with (3.1.8) throughout, and both of those alone that test a simulation), from rows
    of :meth:`Printed.row`."""
    pairs = [(row[5], row[6].rpartition(": ")[2]) for row in rows]
    ours, others = Counter(one for one, _ in pairs), Counter(other for _, other in pairs)
    throughout, tested = Counter(other or one for one, other in pairs), Counter(one for one, other in pairs if other)
    return [(name, ours[name], throughout[name], tested[name], others[name]) for name in CLASSES]


def summary(rows: Sequence[Sequence[str]]) -> str:
    """The count in words, both ways: what report, gallery and page print."""
    found = counts(rows)
    (_, ours, other, runs, runs_other), tested = found[0], sum(row[3] for row in found)
    rest = "; ".join(f"{name} {count} ({with_other})" for name, count, with_other, *_ in found[1:])
    return (
        f"Of {len(rows)} printed numbers {ours} are reproduced within rounding with a lumped mass matrix that was "
        f"chosen on these same rows, and {other} with the thesis's own, (3.1.8). The others, with (3.1.8) in brackets: "
        f"{rest}. Numbers that test a simulation: {tested}; {runs} of them are within rounding with the lumped matrix, "
        f"{runs_other} with (3.1.8). The rest follow from formulas."
    )
