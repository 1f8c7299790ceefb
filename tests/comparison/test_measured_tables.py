"""Tables of README and docs that name the command that made them: a fresh run gives the same within the stated digits.

A marker ``<!-- made by: bentbeam match … -->`` stands above a Markdown table or a block of the command's own output.
A cell is about the rows of the match that the first cell of its line names, by label or by method and κ/ν, and the
title of its column, by label, method or loads (α, ψ, χ[, axial]); which numbers it gives, the title says or else the
first title. A table whose titles are κ/ν is read by columns. "≤" states a bound.
"""

from __future__ import annotations

import json
import re
import shlex
from fractions import Fraction
from functools import cache
from typing import Any

import pytest
from markdown_tables import RAISED, ROOT, cells, stated, table_after

from comparison.command_line.app import run
from comparison.whole_impact.ends import TIMES, USUAL, reached
from theory.validity import ends_errors

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
MARKED = re.compile(r"<!-- made by: bentbeam (match .*?) -->\n+((?:\|[^\n]*\n)+|```text\n.*?```)", re.S)
TABLES = [
    pytest.param(command, text, id=f"{page.name}-{k}")
    for page in PAGES
    for k, (command, text) in enumerate(MARKED.findall(page.read_text(encoding="utf-8")))
]

Row = dict[str, Any]


def percent(row: Row, name: str) -> float:
    number = row[name]
    size = abs(number["theory"])
    return 100.0 * (number["value"] - number["theory"]) / (max(size, 1.0) if name.endswith("1") else size)


MEASURES = {
    "λ₀": lambda row: percent(row, "lambda0"),
    "r₀": lambda row: percent(row, "r0"),
    "λ₁": lambda row: percent(row, "lambda1"),
    "r₁": lambda row: percent(row, "r1"),
    "lift": lambda row: row["lift"],
    "pull": lambda row: 100.0 * row["hold"]["pull"],
    "steps": lambda row: row["steps"],
}
BARS = {"λ₁": "lambda1", "r₁": "r1"}  # differences of runs, whose last digits depend on the processor


@cache
def matched(command: str) -> list[Row]:
    """Rows of a fresh run of the command."""
    import contextlib
    import io

    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        assert run([*shlex.split(command), "--fresh", "--json"]) == 0
    rows: list[Row] = json.loads(printed.getvalue())["rows"]
    assert all(row["reason"] is None for row in rows)
    return rows


def chosen(rows: list[Row], cell: str) -> list[Row]:
    """The rows that a first cell is about: a label, or such as "Hermite, κ/ν from 0.1 to 0.8"."""
    labelled = [r for r in rows if r["label"] == cell]
    if labelled:
        return labelled
    before, _, kappas = cell.rpartition("κ/ν")
    numbers = [float(Fraction(n)) for n in re.findall(r"\d+(?:[./]\d+)?", kappas)]
    low, high = 0.999 * numbers[0], 1.001 * numbers[-1]
    label = before.rstrip(" ,") if before.rstrip(" ,") in {r["label"].rpartition(", ")[0] for r in rows} else ""
    label = label or re.split(r"[ ,]", before)[0]
    return [r for r in rows if low <= r["kappa_over_nu"] <= high and r["label"].startswith(label)]


def narrowed(rows: list[Row], title: str) -> list[Row]:
    """Of these rows those that a column's title names, all if it names none."""
    loads = re.search(r"\(([^)]*,[^)]*)\)", title.translate(RAISED))
    if loads:
        asked = [*map(float, loads[1].split(",")), 0.0][:4]
        return [r for r in rows if [r["alpha"], r["psi"], r["chi"], r["axial"]] == asked]
    word = re.split(r"[ ,]", title)[0]
    return [r for r in rows if r["label"].endswith(", " + title) or (word and r["label"].startswith(word))] or rows


def agrees(rows: list[Row], name: str, cell: str) -> float | None:
    """Nothing where a cell's number is what these rows give; else what they give."""
    value, unit = stated(cell)
    if "±" in cell:  # a noisy run's last digits depend on the processor
        unit = max(unit, 0.3 * stated(cell.partition("±")[2])[0])
    row = max(rows, key=lambda r: abs(MEASURES[name](r)))
    fresh = MEASURES[name](row)
    if name in BARS:
        bar = row[BARS[name]]
        unit = max(unit, 10.0 * bar["error"] / max(abs(bar["theory"]), 1.0))
    size = fresh if cell[0] in "+−" else abs(fresh)
    return None if (size <= value + unit / 2 if "≤" in cell else abs(size - value) <= 1.01 * unit) else fresh


def wrong_in_table(rows: list[Row], text: str) -> list[str]:
    head, _, *body = (cells(line) for line in text.splitlines())
    if head[0] == "κ/ν" and all(re.fullmatch(r"[\d./]+", title) for title in head[1:]):
        head, *body = map(list, zip(head, *body))
        body = [[f"κ/ν = {first}", *others] for first, *others in body]
    wrong = []
    for first, *others in body:
        for title, cell in zip(head[1:], others):
            named = re.findall("|".join(MEASURES), title) or re.findall("|".join(MEASURES), head[0])
            if not named or cell in ("", "–"):
                continue
            about = narrowed(chosen(rows, first), title)
            assert about, f"{first}, {title}: no row of the match"
            numbers = cell.split(", ")
            assert len(numbers) == len(named), f"{first}, {title}: {cell} is not {', '.join(named)}"
            for name, number in zip(named, numbers):
                fresh = agrees(about, name, number)
                if fresh is not None:
                    wrong.append(f"{first}, {title}: {name} is {number}, measured {fresh:.3g}")
    return wrong


def wrong_in_output(rows: list[Row], text: str) -> list[str]:
    """The command's own table: values within a tenth of their error bars, small sizes within a factor of two."""
    lines = [re.split(r"\s{2,}", line.strip()) for line in text.splitlines()[2:-1]]
    assert len(lines) == len(rows)
    wrong = []
    for row, (label, kappa, *found) in zip(rows, lines):
        assert (row["label"], f"{row['kappa_over_nu']:g}") == (label, kappa)
        for name, printed in (("lambda0", found[0]), ("r0", found[2])):
            value, bar = printed.split("±")
            if abs(row[name]["value"] - float(value)) > max(0.1 * float(bar), 1.01 * stated(value)[1]):
                wrong.append(f"{label}, {kappa}: {name} is {printed}, measured {row[name]['value']:.7g}")
            if not 0.4 < row[name]["error"] / float(bar) < 2.5:
                wrong.append(f"{label}, {kappa}: {name} is {printed}, its bar measured {row[name]['error']:.2g}")
        if not 0.4 < (row["lift"] + 1e-12) / (float(found[4]) + 1e-12) < 2.5:
            wrong.append(f"{label}, {kappa}: lift is {found[4]}, measured {row['lift']:.2g}")
    return wrong


def test_there_are_marked_tables() -> None:
    assert sum("README" in str(table.id) for table in TABLES) >= 2


def test_a_stated_number_has_the_unit_of_its_last_digit() -> None:
    assert stated("≤ 1·10⁻³") == pytest.approx((1e-3, 1e-3))
    assert stated("−0.016 %") == pytest.approx((-0.016, 1e-3))
    assert stated("4e-3") == pytest.approx((4e-3, 1e-3))
    row = {"label": "A", "kappa_over_nu": 0.5, "lambda0": {"value": 1.01, "theory": 1.0}, "lift": 2e-3}
    assert wrong_in_table([row], "| | λ₀ (%) | lift |\n| - | - | - |\n| A, κ/ν = 0.5 | ≤ 1.0 | 2e-3 |\n") == []
    assert len(wrong_in_table([row], "| | λ₀ (%) | lift |\n| - | - | - |\n| A, κ/ν = 0.5 | ≤ 0.9 | 4e-3 |\n")) == 2
    assert wrong_in_table([row], "| κ/ν | 1/2 |\n| - | - |\n| λ₀ (%) | +1.0 |\n| lift | 2e-3 |\n") == []
    assert len(wrong_in_table([row], "| κ/ν | 1/2 |\n| - | - |\n| λ₀ (%) | −1.0 |\n| lift | 4e-3 |\n")) == 2


def test_columns_are_read_by_load_and_by_label() -> None:
    none = {"value": 1.0, "theory": 1.0, "error": 0.01}
    loads = {"alpha": -1.0, "psi": 0.0, "chi": 0.0, "axial": 0.0}
    row = {"label": "even, soft", "kappa_over_nu": 0.5, "lambda1": none | {"value": 1.02}, "r1": none, "lift": 0.1}
    text = "| κ/ν: λ₁, r₁ | (−1, 0, 0) |\n| - | - |\n| 0.5 | {} |\n"
    assert wrong_in_table([row | loads], text.format("+2.0, +0.0")) == []
    assert len(wrong_in_table([row | loads], text.format("+0.0, +2.0"))) == 2
    with pytest.raises(AssertionError, match="no row"):
        wrong_in_table([row | loads | {"axial": 1.0}], text.format("+2.0, +0.0"))
    text = "| λ₁, lift | soft |\n| - | - |\n| even, κ/ν = 0.5 | +2, {} |\n"
    assert wrong_in_table([row], text.format("0.1")) == []
    assert len(wrong_in_table([row], text.format("0.3"))) == 1


@pytest.mark.verify
@pytest.mark.parametrize(("command", "text"), TABLES)
def test_a_fresh_run_gives_the_stated_numbers(command: str, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    rows = matched(command)
    assert (wrong_in_table if text.startswith("|") else wrong_in_output)(rows, text) == []


def test_the_times_until_waves_return_are_the_stored_ones() -> None:
    stored = json.loads((ROOT / "theory/ends.json").read_text(encoding="utf-8"))
    table = table_after("docs/whole_impact.md", "The same beam, and one 2.5 times as long")
    for column, title in enumerate(table["κ/ν"]):
        row = stored["kappa_over_nu"].index(1.2 if title.startswith("≥") else float(title))
        curves, _ = ends_errors(stored["kappa_over_nu"][row], TIMES, USUAL)
        for share in ("1 %", "2 %", "5 %"):
            found = [reached(TIMES, curve, float(share[:1]) / 100.0) for curve in curves]
            assert float(table[share][column]) == pytest.approx(min(t for t in found if t is not None), abs=1e-4)
    factors = table_after("docs/whole_impact.md", "At other dampings the same comes earlier")
    assert [float(f) for f in factors["factor"]] == pytest.approx(stored["factor"], abs=6e-3)


HITS = {"begins": "begin", "impulse": "impulse", "velocity after": "velocity", "energy lost": "lost"}


@pytest.mark.verify
def test_the_hits_of_the_page_are_those_of_its_command(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    page = (ROOT / "docs/whole_impact.md").read_text(encoding="utf-8")
    found = re.search(r"<!-- made by: bentbeam (simulate .*?) -->\n+((?:\|[^\n]*\n)+)", page)
    assert found is not None
    assert run([*shlex.split(found[1]), "--json", "--quiet"]) == 0
    hits = json.loads(capsys.readouterr().out)["hits"]
    head, _, *body = (cells(line) for line in found[2].splitlines())
    assert len(body) == len(hits)
    for row, hit in zip(body, hits):
        assert row[1].startswith(hit["wall"])
        for title, cell in zip(head[2:], row[2:]):
            value, unit = stated(cell)
            assert hit[HITS[title.partition(",")[0]]] == pytest.approx(value, abs=1.01 * unit), (title, cell)
