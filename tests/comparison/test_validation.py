"""The table *Validation* of README and site: the commands below it give its numbers today, inside its bars."""

import re
from functools import cache

import pytest
from called import answered
from markdown_tables import ROOT, lines_after, stated

PAGES = ("README.md", "docs/index.md")
MATCH = ("match", "--methods", "cases/methods/one_of_each.toml", "--kappa-over-nu", 0.5, "--fresh")
WALL = ("match", "--path", "hermite", "--kappa-over-nu", 0.5, "--wall", "10000,0.1", "--fresh")
BOUNCE = ("bounce", "--kappa-over-nu", 0.5, "--damping", 0.001, "--path", "hermite", "--path", "exudyn", "--fresh")
TUBE = ("bounce", "cases/tube.toml", "--path", "hermite", "--path", "exudyn", "--fresh")
ROWS = {
    "restitution of the tube": (TUBE, "restitution"),
    "largest stress": (TUBE, "peak_stress"),
    "λ₀": (MATCH, "lambda0"),
    "r₀": (MATCH, "r0"),
    "λ₁": ((*MATCH, "--first-order", "4,0,0"), "lambda1"),
    "r₁": ((*MATCH, "--first-order", "4,0,0"), "r1"),
    "largest force": (WALL, "peak_force"),
    "restitution": (BOUNCE, "restitution"),
    "largest moment": (BOUNCE, "peak_moment"),
}


fresh = cache(answered)  # lines share a command


def table(page):
    return lines_after(page, "## Validation")[2:]


def test_the_table_is_the_same_on_both_pages_and_every_line_has_its_command():
    assert table(PAGES[0]) == table(PAGES[1])
    assert all(any(line[0].startswith(name) for name in ROWS) for line in table(PAGES[0]))


@pytest.mark.verify
@pytest.mark.parametrize("line", [pytest.param(line, id=line[0][:20]) for line in table(PAGES[0])])
def test_a_fresh_run_gives_the_line_inside_its_bar(line, monkeypatch):
    monkeypatch.chdir(ROOT)
    title, other, ours, bar = line
    command, key = next(one for name, one in ROWS.items() if title.startswith(name))
    found, (widest, rounding) = fresh(*command), stated(bar)
    known, unit = stated(other)
    if "paths" in found:
        scale = 1e-6 if key == "peak_stress" else 1.0
        one, other = ({name: scale * path[key][name] for name in ("value", "error")} for path in found["paths"])
        rows = {"hermite": one}
        assert abs(other["value"] - known) <= max(0.51 * unit, other["error"])
    else:
        rows = {row["label"].lower(): row[key] for row in found["rows"]}
        assert all(row["theory"] == pytest.approx(known, abs=0.51 * unit) for row in rows.values())
    printed = dict(re.findall(r"([\w-]+) ([\d.]+)", ours.lower()))
    assert printed.keys() == rows.keys()
    for name, text in printed.items():
        number, (value, last) = rows[name], stated(text)
        assert (
            number["error"] <= widest + 0.51 * rounding and abs(number["value"] - value) <= 0.51 * last + 0.1 * widest
        )
        assert abs(value - known) <= widest + 0.5 * unit
