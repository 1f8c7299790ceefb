"""Tables of README and docs that name the command that made them: a fresh run gives the same within the stated digits.

A marker ``<!-- made by: bentbeam match … -->`` stands above a Markdown table or a block of the command's own output.
The first cell of a table's row says which rows of the match it is about, by label or by method and κ/ν; "≤" states
a bound.
"""

from __future__ import annotations

import json
import re
import shlex
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from comparison.command_line.app import run

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
MARKED = re.compile(r"<!-- made by: bentbeam (match [^>]*?) -->\n+((?:\|[^\n]*\n)+|```text\n.*?```)", re.S)
TABLES = [
    pytest.param(command, text, id=f"{page.name}-{k}")
    for page in PAGES
    for k, (command, text) in enumerate(MARKED.findall(page.read_text(encoding="utf-8")))
]
RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
NUMBER = re.compile(r"([-+]?\d+(?:\.(\d+))?)(?:(?:·10|e)([-+]?\d+))?")

Row = dict[str, Any]


def stated(text: str) -> tuple[float, float]:
    """A number as it is printed and the unit of its last digit."""
    found = NUMBER.search(text.translate(RAISED))
    assert found, text
    power = 10.0 ** int(found[3] or 0)
    return float(found[1]) * power, power * 10.0 ** -len(found[2] or "")


def percent(row: Row, name: str) -> float:
    number = row[name]
    return 100.0 * (number["value"] / number["theory"] - 1.0)


QUANTITIES = {
    "λ₀": lambda row: percent(row, "lambda0"),
    "r₀": lambda row: percent(row, "r0"),
    "lift": lambda row: row["lift"],
    "steps": lambda row: row["steps"],
}


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
    numbers = [float(n) for n in re.findall(r"\d+(?:\.\d+)?", cell.rpartition("κ/ν")[2])]
    low, high = numbers[0], numbers[-1]
    label = "" if cell[0].isdigit() else re.split(r"[ ,]", cell)[0]
    found = [r for r in rows if low <= r["kappa_over_nu"] <= high and r["label"].startswith(label)]
    assert found, cell
    return found


def cells(line: str) -> list[str]:
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def wrong_in_table(rows: list[Row], text: str) -> list[str]:
    head, _, *body = (cells(line) for line in text.splitlines())
    wrong = []
    for first, *others in body:
        for title, cell in zip(head[1:], others):
            measure = QUANTITIES.get(re.split(r"[ (/]", title)[0])
            if measure is None or cell in ("", "–"):
                continue
            value, unit = stated(cell)
            if "±" in cell:  # a noisy run's last digits depend on the processor
                unit = max(unit, 0.3 * stated(cell.partition("±")[2])[0])
            fresh = max((measure(row) for row in chosen(rows, first)), key=abs)
            size = fresh if cell[0] in "+−" else abs(fresh)
            fits = size <= value + unit / 2 if "≤" in cell else abs(size - value) <= 1.01 * unit
            if not fits:
                wrong.append(f"{first}: {title} is {cell}, measured {fresh:.3g}")
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


@pytest.mark.verify
@pytest.mark.parametrize(("command", "text"), TABLES)
def test_a_fresh_run_gives_the_stated_numbers(command: str, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    rows = matched(command)
    assert (wrong_in_table if text.startswith("|") else wrong_in_output)(rows, text) == []
