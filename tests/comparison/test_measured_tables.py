"""Tables of README and docs: a fresh run of what made them gives the same within the stated digits.

A marker ``<!-- made by: bentbeam match … -->`` stands above a Markdown table. A line's first cell names rows of it
(:func:`named`); its numbers are those that the titles name, of these rows one after the other. "≤" states a bound of
all of them. Exudyn's restitutions: ``exudyn_models/test_exudyn_whole_beam.py``.
"""

import re
import shlex
from fractions import Fraction
from functools import cache

import pytest
from called import answered
from here import ROOT
from markdown_tables import cells, lines_after, stated

from bent_beam import Impact
from bent_beam.measure.numbers import Number
from bent_beam.measure.whole_impact import whole_impact
from bent_beam.method import simulate_to_separation
from comparison.rows import HELD_AGAINST
from hermite_fe import HermiteFE
from hermite_fe.integrators import MoreauJean, NonsmoothGeneralizedAlpha, SignoriniPosition
from hermite_fe.whole_beam import ELEMENTS

MARKED = re.compile(r"<!-- made by: bentbeam (match .*?) -->\n+((?:\|[^\n]*\n)+)")
TABLES = [
    pytest.param(command, [cells(line) for line in text.splitlines()], id=f"{page.name}-{k}")
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    for k, (command, text) in enumerate(MARKED.findall(page.read_text(encoding="utf-8")))
]
NUMBERS = {"λ₀": "lambda0", "r₀": "r0", "λ₁": "lambda1", "r₁": "r1"}

fresh = cache(answered)  # lines share a command


@pytest.fixture(autouse=True)
def in_the_project(monkeypatch):
    monkeypatch.chdir(ROOT)


def reading(row, name):
    """What a row says, in per cent where there is a theory, and how far its last digits depend on the processor."""
    if name not in NUMBERS:
        return (100.0 * row["hold"]["pull"] if row["hold"] else 0.0) if name == "pull" else row[name], 0.0
    least = HELD_AGAINST[NUMBERS[name]]
    number = Number(*(row[NUMBERS[name]][key] for key in ("value", "error", "theory")))
    return 100.0 * number.relative(least), 10.0 * number.relative_bar(least) * least  # of first order: of two runs


def agrees(cell, value, noise):
    """Whether a value is what its cell says, with a sign or without, to the last digit, as a bound, or not at all."""
    if cell == "–":
        return True
    printed, unit = stated(cell)
    if "≤" in cell:
        return abs(value) <= printed + 0.5 * unit
    if "±" in cell:  # a noisy run
        unit = max(unit, 0.3 * stated(cell.partition("±")[2])[0])
    return abs((value if cell[0] in "+−" else abs(value)) - printed) <= 1.01 * max(unit, noise)


def named(rows, first):
    """The rows of a label, or of what a label begins with and κ/ν, from … to …"""
    if mine := [row for row in rows if row["label"] == first]:
        return mine
    before, _, kappas = first.rpartition("κ/ν")
    ends = [float(Fraction(number)) for number in re.findall(r"\d+(?:[./]\d+)?", kappas)]
    mine = [row for row in rows if f"{row['label']}, ".startswith(before)]
    return [row for row in mine if 0.999 * ends[0] <= row["kappa_over_nu"] <= 1.001 * ends[-1]]


@pytest.mark.verify
@pytest.mark.parametrize(("command", "table"), TABLES)
def test_a_fresh_match_gives_the_stated_numbers(command, table):
    rows = fresh(*shlex.split(command), "--fresh")["rows"]
    assert all(row["reason"] is None for row in rows)
    (titles, _, *lines), wrong = table, []
    names = re.findall("|".join([*NUMBERS, "lift", "pull", "steps"]), " ".join(titles))
    for first, *columns in lines:
        numbers, about = ", ".join(columns).split(", "), named(rows, first)
        readings = [reading(row, name) for row in about for name in names]
        if "≤" in numbers[0]:
            numbers *= len(about)
        pairs = zip(numbers, readings, strict=True)
        wrong += [(first, cell, value) for cell, (value, noise) in pairs if not agrees(cell, value, noise)]
    assert not wrong


@pytest.mark.verify
def test_the_hits_of_a_page_are_those_of_its_command():
    lines = lines_after("docs/whole_impact.md", "made by: bentbeam simulate cases/two_walls.toml --save 4000")[2:]
    hits = answered("simulate", "cases/two_walls.toml", "--save", 4000, "--quiet")["hits"]
    for (_, wall, *numbers), hit in zip(lines, hits, strict=True):
        assert wall.startswith(hit["wall"])
        for name, cell in zip(("begin", "impulse", "after", "lost"), numbers, strict=True):
            value, unit = stated(cell)
            assert hit[name] == pytest.approx(value, abs=1.01 * unit), (wall, name)


# --- restitutions, each of one run to the last separation -------------------------------------------------------------

SCHEMES = {
    "Signorini": SignoriniPosition(theta=0.5),
    "Moreau": MoreauJean(theta=0.5),
    "generalised": NonsmoothGeneralizedAlpha(spectral_radius=0.8),
}
PARTS = {"1": 1.0, "½": 0.5, "¼": 0.25}
TITLES, _, *LINES = lines_after("docs/whole_impact.md", "How much the parts matter")
RESTITUTIONS = [
    *((HermiteFE(), kappa, damping, cell, 1e-4)
      for kappa, damping, _, _, cell in lines_after("docs/exudyn.md", "## The whole impact")[2:]),
    *((HermiteFE(integrator=SCHEMES[re.match(r"\w+", scheme)[0]].with_steps(PARTS[part] / ELEMENTS**2, 0.0)),
       *title.strip("()").split(", "), cell, 0.0)
      for scheme, part, *columns in LINES for title, cell in zip(TITLES[2:], columns)),
]  # fmt: skip


@pytest.mark.verify
@pytest.mark.parametrize(("method", "kappa", "damping", "cell", "least"), RESTITUTIONS)
def test_a_run_gives_the_restitution_of_the_page(method, kappa, damping, cell, least):
    """To the last digit of the cell; where that is the fourth, to the round-off that hits amplify (seen: 2.5e-4)."""
    value, unit = stated(cell)
    within = max(1.01 * unit, 3e-4 if 0.99e-4 < unit < 1.01e-4 else least)
    impact = Impact.whole_beam(float(kappa), relative_damping=stated(damping)[0])
    assert whole_impact(simulate_to_separation(method, impact)).restitution == pytest.approx(value, abs=within)


# --- the table *Validation*, which README and site share: commands below it give its numbers inside its bars ----------

TITLE = "## Validation"
VALIDATED = lines_after("README.md", TITLE)[2:]
BELOW = (ROOT / "README.md").read_text(encoding="utf-8").partition(TITLE)[2].partition("Commands: ")[2]
MATCH, LOADED, WALL, BOUNCE, TUBE = re.findall(r"`(?:bentbeam )?([^`]+)`", BELOW)[:5]
ASKED = [  # what gives each line, and the name of its number there
    (MATCH, "lambda0"), (MATCH, "r0"), (f"{MATCH} {LOADED}", "lambda1"), (f"{MATCH} {LOADED}", "r1"),
    (WALL, "peak_force"), (BOUNCE, "restitution"), (BOUNCE, "peak_moment"), (TUBE, "restitution"),
    (TUBE, "peak_stress"),
]  # fmt: skip
VALIDATION = [pytest.param(line, *asked, id=line[0][:20]) for line, asked in zip(VALIDATED, ASKED, strict=True)]


def test_the_validation_table_of_readme_and_site_is_the_same():
    assert lines_after("docs/index.md", TITLE)[2:] == VALIDATED


@pytest.mark.verify
@pytest.mark.parametrize(("line", "command", "key"), VALIDATION)
def test_a_fresh_run_gives_the_line_inside_its_bar(line, command, key):
    _, other, ours, bar = line
    found, (widest, rounding), (known, unit) = fresh(*shlex.split(command), "--fresh"), stated(bar), stated(other)
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
        assert number["error"] <= widest + 0.51 * rounding
        assert abs(number["value"] - value) <= 0.51 * last + 0.1 * widest
        assert abs(value - known) <= widest + 0.5 * unit
