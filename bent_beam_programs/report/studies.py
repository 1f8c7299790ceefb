"""What is stored of the thesis, for the page to show: its parameter studies and the table of its printed numbers, each
with pictures. They take minutes and are measured elsewhere."""

from pathlib import Path
from typing import Any

from bent_beam import stored
from comparison.readable import readable

STUDIES = Path(__file__).resolve().parents[1] / "stored_studies" / "studies.json"
NUMBERS = STUDIES.with_name("numbers.json")
CLASS = 5  # the column of a printed number's class
LEFT_OUT = ("strain", "nodes", "steps", "seconds")  # of the tables: what says nothing of accuracy


def stored_studies(file: Path = STUDIES) -> list[dict[str, Any]]:
    """The stored studies in their order, each as it is stored, with its table as text (``headings``, ``cells``), the
    ``reason`` why it was left out, if it was, ``stale``: code has changed since, and the file of its ``picture``."""
    stale = stored.is_stale(file)
    found = []
    for study in stored.read(file)["studies"]:
        columns = {key: heading for key, heading in study["columns"].items() if key not in LEFT_OUT}
        shown = {
            "headings": list(columns.values()),
            "cells": [[readable(row.get(key), 3) for key in columns] for row in study["rows"]],
            "reason": (study.get("reason") or "no reason given") if study["failed"] else "",
            "stale": stale,
            "picture": file.with_name(f"{study['name']}.png"),
        }
        found.append({"says": "", **study, **shown})
    return found


def stored_numbers() -> dict[str, Any]:
    """The stored table of printed numbers.

    summary : the count in words, both ways; classes : class → its rows (where, what, printed, ours, ratio, class, with
    (3.1.8), why); figures : id, title and picture of each; date; stale.
    """
    found = stored.read(NUMBERS)
    return {
        "summary": found["summary"],
        "classes": {name: [row for row in found["rows"] if row[CLASS] == name] for name in found["classes"]},
        "figures": [(f["id"], f["title"], NUMBERS.with_name(f"{f['id']}.png")) for f in found["figures"]],
        "date": found["date"],
        "stale": stored.is_stale(NUMBERS),
    }
