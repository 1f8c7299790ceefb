"""Links from the report to the project's guide, where it lies on the same disk."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path

__all__ = ["Guide", "guides"]

ROOT = Path(__file__).resolve().parents[2]
PAGES = (
    ("predict", "Predict the impact of a pipe of your own"),
    ("run", "Run one path"),
    ("swap", "Swap integrator, contact and mesh"),
    ("add-method", "Add a method of your own"),
    ("enter", "Enter another solver in the open benchmark"),
    ("figure", "Draw the figures of the thesis again"),
    ("../theory", "Theory"),
    ("../numerics", "Numerics"),
    ("../scope", "What is modelled, and what is not"),
)


@dataclass(frozen=True)
class Guide:
    """A page of the guide. ``link`` : relative address, ``None`` where this installation has no copy."""

    title: str
    link: str | None


def guides(out: Path) -> list[Guide]:
    """The guide's pages as seen from the folder ``out``: the built site where there is one, its sources otherwise."""
    found = []
    for name, title in PAGES:
        path = os.path.normpath(Path("guide") / name)
        candidates = (ROOT / "site" / path / "index.html", ROOT / "site" / f"{path}.html", ROOT / "docs" / f"{path}.md")
        file = next((c for c in candidates if c.exists()), None)
        link = None if file is None else Path(os.path.relpath(file, out.resolve())).as_posix()
        found.append(Guide(title, link))
    return found
