"""A gallery item: a number of the thesis, a title, a caption, and one small function that draws it on a sheet.

The docstring of the function gives the title and the caption. It draws on the :class:`thesis.sheet.Sheet`, whose data
become the CSV; ``sheet.numbers`` are printed below the caption. The items of a module share runs, so one process draws
them.
"""

from __future__ import annotations

import json
import re
import time as clock
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bent_beam.errors import ANY_FAILURE
from comparison.plain import plain
from comparison.store import write_atomically
from comparison.stored import digest_of
from thesis.sheet import Sheet

Draw = Callable[[Sheet], None]
PACKAGES = ("bent_beam", "measure", "theory", "hermite_fe", "self_similar_fe", "exudyn_models", "comparison", "thesis")
ITEMS: dict[str, Item] = {}
"""Every figure and table by its id; filled by the modules."""


@dataclass(frozen=True)
class Item:
    """id : "fig-2.7a", "table-3.1" …; caption : its content, and the difference from the thesis."""

    id: str
    title: str
    caption: str
    module: str
    draw: Draw


def item(name: str, *, beside: str = "", **parts: str) -> Callable[[Draw], Draw]:
    """Decorator that registers a drawing function under its number.

    beside : the module whose items the same process draws, for it shares their runs (default: its own).
    The first line of its docstring is the title, the rest the caption, in which {part} stands for a text of ``parts``.
    """

    def register(draw: Draw) -> Draw:
        title, _, caption = (draw.__doc__ or "").partition("\n\n")
        ITEMS[name] = Item(name, title, " ".join(caption.split()).format(**parts), beside or draw.__module__, draw)
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


def _kept(mark: Path, key: str) -> dict[str, Any] | None:
    """The entry of an item that was drawn before with the same sources and formats and is still there."""
    if not mark.is_file():
        return None
    kept = json.loads(mark.read_text())
    same = kept["key"] == key and all(Path(f).is_file() for f in kept["drawn"]["files"])
    return dict(kept["drawn"]) if same else None


def draw_item(name: str, out: Path, formats: Sequence[str]) -> dict[str, Any]:
    """Draw one item, or find it drawn already. Returns an entry of ``drawn``, or of ``failures`` (with "reason")."""
    chosen, mark = ITEMS[name], out / ".drawn" / f"{name}.json"
    about = {"item": name, "caption": chosen.caption, "title": chosen.title, "formats": sorted(formats)}
    key = digest_of(PACKAGES, about)
    kept = _kept(mark, key)
    if kept is not None:
        return kept
    began = clock.perf_counter()
    sheet = Sheet()
    try:
        chosen.draw(sheet)
        files = sheet.save(out, name, formats)
        drawn: dict[str, Any] = {
            "id": name,
            "title": chosen.title,
            "caption": chosen.caption,
            "numbers": plain(sheet.numbers),
            "files": [str(f) for f in files],
            "seconds": round(clock.perf_counter() - began, 2),
        }
        write_atomically(mark, json.dumps({"key": key, "drawn": drawn}, indent=1))
    except ANY_FAILURE as error:
        return {"id": name, "reason": f"{type(error).__name__}: {' '.join(str(error).split())}"}
    finally:
        sheet.close()
    return drawn
