"""Tables of README and docs that name the command that made them: a fresh run gives the same within the stated digits.

A marker ``<!-- made by: bentbeam match … -->`` stands above a Markdown table. A line's first cell is a label of the
match, or what a label begins with and κ/ν, from … to …. A column is of numbers, loads (α, ψ, χ[, N]) or the end of a
label; of the last two the first title says of which numbers. "≤" states a bound.
"""

import re
import shlex
from fractions import Fraction
from functools import cache
from typing import Any

import pytest
from called import answered
from markdown_tables import RAISED, ROOT, cells, stated

PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
MARKED = re.compile(r"<!-- made by: bentbeam ((?:match|simulate) .*?) -->\n+((?:\|[^\n]*\n)+)")
FOUND = [
    pytest.param(command, text, id=f"{page.name}-{k}")
    for page in PAGES
    for k, (command, text) in enumerate(MARKED.findall(page.read_text(encoding="utf-8")))
]
TABLES = [found for found in FOUND if found.values[0].startswith("match")]
HITS = [found for found in FOUND if found.values[0].startswith("simulate")]
Row = dict[str, Any]


def percent(row: Row, name: str) -> float:
    number, size = row[name], abs(row[name]["theory"])
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
def fresh(command: str) -> Row:
    """The document of a fresh run of the command."""
    return dict(answered(*shlex.split(command)))


def matched(command: str) -> list[Row]:
    rows: list[Row] = fresh(command + " --fresh")["rows"]
    assert all(row["reason"] is None for row in rows)
    return rows


def meant(rows: list[Row], first: str, title: str) -> list[Row]:
    """The rows that a line's first cell and a column's title name."""
    if labelled := [r for r in rows if r["label"] == first]:
        return labelled
    before, _, kappas = first.rpartition("κ/ν")
    numbers = [float(Fraction(n)) for n in re.findall(r"\d+(?:[./]\d+)?", kappas)]
    found = [r for r in rows if 0.999 * numbers[0] <= r["kappa_over_nu"] <= 1.001 * numbers[-1]]
    if title.startswith("("):
        loads = [*map(float, title.translate(RAISED).strip("()").split(",")), 0.0][:4]
        return [r for r in found if [r["alpha"], r["psi"], r["chi"], r["axial"]] == loads]
    return [r for r in found if r["label"] == before + title] or [
        r for r in found if f"{r['label']}, ".startswith(before)
    ]


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
    wrong = []
    for first, *others in body:
        for title, cell in zip(head[1:], others):
            named = re.findall("|".join(MEASURES), title) or re.findall("|".join(MEASURES), head[0])
            if not named or cell in ("", "–"):
                continue
            about, numbers = meant(rows, first, title), cell.split(", ")
            assert about, f"{first}, {title}: no row of the match"
            assert len(numbers) == len(named), f"{first}, {title}: {cell} is not {', '.join(named)}"
            for name, number in zip(named, numbers):
                if (fresh := agrees(about, name, number)) is not None:
                    wrong.append(f"{first}, {title}: {name} is {number}, measured {fresh:.3g}")
    return wrong


@pytest.mark.verify
@pytest.mark.parametrize(("command", "text"), TABLES)
def test_a_fresh_run_gives_the_stated_numbers(command: str, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    assert wrong_in_table(matched(command), text) == []


@pytest.mark.verify
@pytest.mark.parametrize(("command", "text"), HITS)
def test_the_hits_of_a_page_are_those_of_its_command(command: str, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    names = {"begins": "begin", "impulse": "impulse", "velocity after": "after", "energy lost": "lost"}
    head, _, *body = (cells(line) for line in text.splitlines())
    for row, hit in zip(body, fresh(command + " --quiet")["hits"], strict=True):
        assert row[1].startswith(hit["wall"])
        for title, cell in zip(head[2:], row[2:]):
            value, unit = stated(cell)
            assert hit[names[title.partition(",")[0]]] == pytest.approx(value, abs=1.01 * unit), (title, cell)
