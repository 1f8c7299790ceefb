"""What a gallery item is: a number of the thesis, a title, a caption, and one small function that draws it on a sheet.

    @item("fig-2.3", "The kernel H", "Shape of the deflection under an impulse (2.3.3).", group="kernel")
    def kernel(sheet: Sheet) -> str: …

The function draws on the :class:`comparison.figures.recorder.Sheet`, whose data become the CSV, and returns what
the numbers add to the caption (how ours differs from the thesis, and why) or nothing. Items of one group share
runs, so one process draws them.
"""

from __future__ import annotations

import json
import re
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path
from typing import Any

from bent_beam.errors import SimulationError
from comparison.figures.recorder import Sheet
from comparison.store import source_digest, write_atomically

__all__ = ["ITEMS", "Item", "draw_item", "item", "order"]

Draw = Callable[[Sheet], str | None]
ITEMS: dict[str, Item] = {}
"""Every figure and table by its id; filled by the modules' ``@item``."""


@dataclass(frozen=True)
class Item:
    """id : "fig-2.7a", "table-3.1" …; caption : what is shown; ``files`` of an item that draws no sheet come from
    ``write``.
    """

    id: str
    title: str
    caption: str
    group: str
    draw: Draw
    write: Callable[[Path, Sheet], tuple[list[Path], str]] | None = None


def item(
    name: str,
    title: str,
    caption: str,
    *,
    group: str,
    write: Callable[[Path, Sheet], tuple[list[Path], str]] | None = None,
) -> Callable[[Draw], Draw]:
    """Register a drawing function under its number."""

    def register(draw: Draw) -> Draw:
        ITEMS[name] = Item(name, title, caption, group, draw, write)
        return draw

    return register


def order(name: str) -> tuple[int, int, int, str]:
    """Place of an id in the thesis: chapters, then the appendix, tables after the figures of their section, the
    animation last.
    """
    found = re.fullmatch(r"(fig|table)-(\d+|A)\.(\d+)([a-z]?)", name)
    if found is None:
        return (99, 0, 0, name)
    chapter = 50 if found[2] == "A" else int(found[2])
    return (chapter, 1 if found[1] == "table" else 0, int(found[3]), found[4])


def _key(name: str, formats: Sequence[str]) -> str:
    return sha256(json.dumps([name, sorted(formats), source_digest()]).encode()).hexdigest()


def _kept(mark: Path, key: str) -> dict[str, Any] | None:
    """What was drawn before with the same sources and formats and is still there."""
    try:
        kept = json.loads(mark.read_text())
        drawn = kept["drawn"]
        if kept["key"] == key and drawn["files"] and all(Path(f).is_file() for f in drawn["files"]):
            return dict(drawn)
    except (OSError, ValueError, KeyError, TypeError):
        pass
    return None


def draw_item(name: str, out: Path, formats: Sequence[str]) -> dict[str, Any]:
    """Draw one item, or find it drawn already. Returns an entry of ``drawn``, or of ``failures`` (with "reason")."""
    chosen, mark = ITEMS[name], out / ".drawn" / f"{name}.json"
    key = _key(name, formats)
    kept = _kept(mark, key)
    if kept is not None:
        return kept
    began = clock.perf_counter()
    sheet = Sheet()
    try:
        if chosen.write is not None:
            files, note = chosen.write(out, sheet)
        else:
            note = chosen.draw(sheet) or ""
            files = sheet.save(out, name, formats)
    except (SimulationError, ArithmeticError, ValueError, LookupError, OSError) as error:
        return {"id": name, "reason": f"{type(error).__name__}: {' '.join(str(error).split())}"}
    finally:
        sheet.close()
    drawn = {
        "id": name,
        "title": chosen.title,
        "caption": f"{chosen.caption} {note}".strip(),
        "files": [str(f) for f in files],
        "seconds": round(clock.perf_counter() - began, 2),
    }
    write_atomically(mark, json.dumps({"key": key, "drawn": drawn}, indent=1))
    return drawn
