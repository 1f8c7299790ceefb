"""The stored parameter studies, for the page to show; they take minutes and are measured elsewhere."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from comparison import stored
from comparison.readable import readable

__all__ = ["STUDIES", "StoredStudy", "stored_studies"]

STUDIES = Path(stored.__file__).parent / "stored_studies" / "studies.json"


@dataclass(frozen=True)
class StoredStudy:
    """One study as it is stored. says : what the thesis says of it, and whether it is so; cells : its table's rows as
    text; stale : code has changed since."""

    name: str
    title: str
    case: str
    conclusion: str
    says: str
    headings: Sequence[str]
    cells: Sequence[Sequence[str]]
    reason: str
    date: str
    stale: bool
    picture: Path


def stored_studies(file: Path = STUDIES) -> list[StoredStudy]:
    """The stored studies in their order; none where there is no file."""
    if not file.exists():
        return []
    stale = stored.is_stale(file)
    return [_study(study, file.parent, stale) for study in stored.read(file)["studies"]]


LEFT_OUT = ("strain", "nodes", "steps", "seconds")  # of the tables: what says nothing of accuracy


def _study(study: Mapping[str, Any], folder: Path, stale: bool) -> StoredStudy:
    columns = {key: heading for key, heading in study["columns"].items() if key not in LEFT_OUT}
    return StoredStudy(
        study["name"],
        study["title"],
        study["case"],
        study["conclusion"],
        study.get("says", ""),
        list(columns.values()),
        [[_text(row.get(key)) for key in columns] for row in study["rows"]],
        (study.get("reason") or "no reason given") if study["failed"] else "",
        study["date"],
        stale,
        folder / f"{study['name']}.png",
    )


def _text(value: Any) -> str:
    """A cell: a number in three digits, with its error bar where it has one."""
    if isinstance(value, Mapping):
        bar = value.get("error")
        return readable(value.get("value"), 3) + ("" if bar is None else f" ± {readable(bar, 1)}")
    return readable(value, 3)
