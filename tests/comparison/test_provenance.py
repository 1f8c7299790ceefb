"""Measured numbers that are stored say what made them, are those of today's code, and name commands that exist."""

import json
import re

import pytest
from here import ROOT

from bent_beam import stored
from comparison.command_line.app import add_programs, app

ROOMS = ("comparison", "bent_beam_programs")
STORED = [f for room in ROOMS for f in sorted((ROOT / room).rglob("*.json")) if "versions" in f.read_text()]


@pytest.mark.parametrize("file", STORED, ids=lambda file: file.relative_to(ROOT).as_posix())
def test_stored_measurements_say_how_they_were_made(file):
    made = json.loads(file.read_text())
    assert {"what", "made_by", "date", "versions"} <= made.keys() and ("settings" in made or "studies" in made)
    assert re.fullmatch(r"\d{4}-\d\d-\d\d", made["date"]) and {"numpy", "scipy"} <= made["versions"].keys()
    program, first = re.fullmatch(r"(bentbeam|python -m) (\S+).*", made["made_by"]).groups()
    if program == "bentbeam":  # a command that makes it anew
        add_programs()
        assert first in {command.callback.__name__ for command in app.registered_commands}
    else:
        assert any((ROOT / (first.replace(".", "/") + end)).is_file() for end in (".py", "/__main__.py"))
    assert "digest" not in made or made["packages"]


@pytest.mark.parametrize("file", STORED, ids=lambda file: file.name)
def test_shipped_numbers_are_those_of_today_s_code(file):
    """If this fails: measure them again, or confirm a sample, with the command that the file names."""
    assert not stored.is_stale(file), stored.read(file)["made_by"]
