"""Every figure and table of the thesis by its number, drawn from this project's own computations, each with its data
as CSV.

    from pathlib import Path
    from comparison.gallery import draw_all

    draw_all(["fig-2.7a", "table-3.1"], Path("gallery"))

One small module a theme; :mod:`comparison.gallery.base` says what an item is.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from comparison.gallery import (  # noqa: F401  (each registers its items)
    animated,
    chapter2_detached,
    chapter2_first_order,
    chapter2_kernel,
    chapter2_leading,
    chapter3_contact_point,
    chapter3_damping,
    chapter3_discrete,
    chapter3_first_order,
    chapter3_matching,
    chapter3_mesh,
    chapter3_statics,
    chapter3_time_step,
    diagrams,
    extras,
    numbers,
)
from comparison.gallery.base import ITEMS as _REGISTERED
from comparison.gallery.base import Item, draw_item, order
from comparison.store import write_atomically
from comparison.workers import run_all

__all__ = ["ITEMS", "Item", "draw_all", "listing"]

ITEMS: dict[str, Item] = {name: _REGISTERED[name] for name in sorted(_REGISTERED, key=order)}
"""Items in the order of the thesis."""

LONGEST = (
    "matching",
    "contact-point",
    "coupling",
    "numbers",
    "first-order",
    "restitution",
    "theory",
    "damping",
    "mesh-square",
)
"""Groups that take longest, first: so that two processes end together."""


def listing() -> list[dict[str, str]]:
    """What there is: id, title and caption of each item."""
    return [{"id": i.id, "title": i.title, "caption": i.caption} for i in ITEMS.values()]


def _draw_group(names: Sequence[str], out: Path, formats: Sequence[str]) -> list[dict[str, Any]]:
    """Items that share runs, one after the other in one process."""
    return [draw_item(name, out, formats) for name in names]


def draw_all(
    ids: Sequence[str],
    out: Path,
    *,
    formats: Sequence[str] = ("png",),
    jobs: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Draw items into ``out``; what an interrupted call has drawn is not drawn again (unless the sources changed).

    Returns (drawn, failures): drawn = [{"id", "title", "caption", "files": [picture(s) …, csv], "seconds"}],
    failures = [{"id", "reason"}]. ``index.md`` in ``out`` shows all that was drawn, with captions. ``progress``
    counts groups of items. Raises ``ValueError`` for an unknown id or format.
    """
    from comparison.figures.style import FORMATS

    for name in ids:
        if name not in ITEMS:
            raise ValueError(f"gallery {name!r} is not known")
    for kind in formats:
        if kind not in FORMATS:
            raise ValueError(f"format must be one of {', '.join(FORMATS)} (got {kind!r})")
    groups: dict[str, list[str]] = {}
    for name in dict.fromkeys(ids):
        groups.setdefault(ITEMS[name].group, []).append(name)
    folder = Path(out)
    asked = [groups[g] for g in sorted(groups, key=lambda g: (LONGEST.index(g) if g in LONGEST else len(LONGEST), g))]
    found = run_all(
        _draw_group,
        [(names, folder, tuple(formats)) for names in asked],
        jobs=jobs,
        progress=progress,
        on_death=lambda i, why: [{"id": name, "reason": why} for name in asked[i]],
    )
    entries = sorted((entry for group in found for entry in group), key=lambda e: order(e["id"]))
    drawn = [e for e in entries if "reason" not in e]
    if drawn:
        write_atomically(folder / "index.md", _index(drawn))
    return drawn, [e for e in entries if "reason" in e]


def _index(drawn: Sequence[dict[str, Any]]) -> str:
    """The gallery as one Markdown page."""
    parts = ["# Figures and tables of the thesis, regenerated\n"]
    for entry in drawn:
        picture, data = Path(entry["files"][0]).name, Path(entry["files"][-1]).name
        shown = f"![{entry['id']}]({picture})" if not picture.endswith(".md") else f"[the table]({picture})"
        parts.append(f"## {entry['id']}: {entry['title']}\n\n{shown}\n\n{entry['caption']} ([data]({data}))\n")
    return "\n".join(parts)
