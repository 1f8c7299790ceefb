"""The page of printed numbers: each is what is computed, in its class, and the classes are counted alike."""

from collections.abc import Callable, Iterator

import pytest
from here import ROOT
from markdown_tables import lines_after, stated

from bent_beam_programs.report.studies import stored_numbers
from bent_beam_programs.thesis.gallery.numbers import PRINTED, chapter2, scales
from bent_beam_programs.thesis.verdicts import Printed, counts, summary, within_rounding

PAGE = "docs/thesis_numbers.md"


def on_page() -> list[list[str]]:
    return lines_after(PAGE, "| where")[2:]


def test_the_count_is_the_same_in_report_and_docs_and_made_of_the_rows() -> None:
    page, shown = on_page(), stored_numbers()
    assert len(page) > 60 and shown is not None and shown["summary"] == summary(page)
    assert summary(page) in (ROOT / PAGE).read_text()
    found = {name: numbers for name, *numbers in counts(page)}
    tested = sum(bool(row[6]) for row in page)
    assert [sum(column) for column in zip(*found.values())] == [len(page), len(page), tested, tested]
    assert sum(verdict == "within rounding" for *_, verdict, _, _ in page) == found["within rounding"][0]


QUICK = (chapter2, scales)


@pytest.mark.parametrize("part", [pytest.param(p, marks=() if p in QUICK else pytest.mark.verify) for p in PRINTED])
def test_the_page_of_printed_numbers_is_what_is_computed(part: Callable[[], Iterator[Printed]]) -> None:
    page = {tuple(row[:3]): row for row in on_page()}
    for printed in part():
        where, what, thesis, ours, _, verdict, *_ = (cell.replace("|", "/") for cell in printed.row())
        row = page[where, what, thesis]
        assert row[5] == verdict, what
        assert stated(row[3])[0] == pytest.approx(stated(ours)[0], rel=2e-3), what


def test_a_value_is_within_rounding_where_as_many_digits_of_it_are_those_printed() -> None:
    near = {"1": (0.588, 0.96), "2e-4": (2.6e-4, 1.94e-4), "8e-3": (7.4e-3, 8.163e-3), "0.0312": (0.0314, 0.03125)}
    assert [[within_rounding(printed, v) for v in pair] for printed, pair in near.items()] == 4 * [[False, True]]
