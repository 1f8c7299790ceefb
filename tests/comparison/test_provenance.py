"""Measured numbers that are stored say where they are from, and a second measurement finds them again."""

import json
import os
import random
import re
from pathlib import Path

import pytest

from bent_beam.versions import processor, stamp

ROOT = Path(__file__).resolve().parents[2]
STORED = [
    file
    for package in ("theory", "comparison", "open_benchmark")
    for file in sorted((ROOT / package).rglob("*.json"))
    if not {"problems", "templates"} & set(file.parts)
]
SEED = os.environ.get("FUZZ_SEED", "0")


@pytest.mark.parametrize("file", STORED, ids=lambda file: file.relative_to(ROOT).as_posix())
def test_stored_measurements_say_how_they_were_made(file):
    stored = json.loads(file.read_text())
    assert {"what", "made_by", "date", "versions"} <= stored.keys()
    assert "settings" in stored or "studies" in stored  # each study with its own
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", stored["date"]) and {"numpy", "scipy"} <= stored["versions"].keys()
    program, words = re.fullmatch(r"(bentbeam|python -m) (.+)", stored["made_by"]).groups()
    assert exists(program, words), "a command that makes it anew"


def test_a_stamp_is_what_is_asked_of_stored_measurements():
    found = stamp("python -m comparison.error_bars")
    assert list(found) == ["made_by", "date", "versions"] and processor()
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", found["date"]) and {"numpy", "scipy"} <= found["versions"].keys()


@pytest.mark.verify
def test_the_stored_errors_of_first_order_are_what_a_measurement_gives_today():
    from comparison.validity import CORRECTIONS, measure, measured

    numbers = random.Random(f"{SEED} validity")
    for regime, rows in measured()["regimes"].items():
        row = numbers.choice(rows)
        again = measure(regime, row["kappa_over_nu"], CORRECTIONS)
        assert again == pytest.approx(row["error"], rel=0.02, abs=2e-5), (regime, row["kappa_over_nu"])


MADE = re.compile(r"<!-- made by: (bentbeam|python -m) ([^>]*?) -->")


def exists(program, words):
    """Whether there is such a command."""
    from comparison.command_line.group import COMMANDS

    first = words.split()[0]
    if program == "bentbeam":
        return first in COMMANDS
    return (ROOT / (first.replace(".", "/") + ".py")).is_file()


def test_the_commands_named_beside_numbers_exist():
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))):
        for program, words in MADE.findall(page.read_text()):
            assert exists(program, words), f"{page.name}: {program} {words}"
