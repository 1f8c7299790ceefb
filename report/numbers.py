"""The stored table of the thesis's printed numbers, with small pictures of its figures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from comparison import stored
from report.studies import STUDIES

__all__ = ["StoredNumbers", "stored_numbers"]

FILE = STUDIES.with_name("numbers.json")
CLASS = 5  # its column


@dataclass(frozen=True)
class StoredNumbers:
    """classes : class → its rows (where, what, printed, ours, ratio, class, why); figures : id, title, picture."""

    rows: int
    classes: Mapping[str, Sequence[Sequence[str]]]
    figures: Sequence[tuple[str, str, Path]]
    date: str
    stale: bool


def stored_numbers(file: Path = FILE) -> StoredNumbers | None:
    """What is stored; ``None`` where there is no file."""
    if not file.exists():
        return None
    found = stored.read(file)
    classes = {name: [row for row in found["rows"] if row[CLASS] == name] for name in found["classes"]}
    figures = [(f["id"], f["title"], file.with_name(f"{f['id']}.png")) for f in found["figures"]]
    return StoredNumbers(len(found["rows"]), classes, figures, found["date"], stored.is_stale(file))
