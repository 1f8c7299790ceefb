"""Every figure and table of the thesis by its number, drawn from this project's own computations, with its data as CSV.

    from pathlib import Path
    from bent_beam_programs.thesis.gallery import draw_all

    draw_all(["fig-2.7a", "table-3.1"], Path("gallery"))

One small module a theme; the items of a module share runs, so one process draws them.
"""

import json
import time as clock
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

from bent_beam.as_json import plain
from bent_beam.errors import ANY_FAILURE, InputError, nearest
from bent_beam.files import write_atomically
from bent_beam.stored import digest_of
from bent_beam_programs.thesis.sheet import ITEMS as _REGISTERED
from bent_beam_programs.thesis.sheet import Item, Sheet, order
from comparison.figures.style import FORMATS
from comparison.readable import readable
from comparison.store import PACKAGES
from comparison.workers import Count, run_all

CODE = (*PACKAGES, "bent_beam_programs.thesis")

for _module in iter_modules(__path__):  # each registers its items
    import_module(f"{__name__}.{_module.name}")

ITEMS: dict[str, Item] = {name: _REGISTERED[name] for name in sorted(_REGISTERED, key=order)}


def listing() -> list[dict[str, str]]:
    return [{"id": i.id, "title": i.title, "caption": i.caption} for i in ITEMS.values()]


def draw_item(name: str, out: Path, formats: Sequence[str]) -> dict[str, Any]:
    """Draw one item, unless it was drawn with the same sources and formats and is still there. Returns an entry of
    ``drawn``, or of ``failures`` (with "reason")."""
    chosen, mark = ITEMS[name], out / ".drawn" / f"{name}.json"
    about = {"id": name, "title": chosen.title, "caption": chosen.caption}
    key = digest_of(CODE, about | {"formats": sorted(formats)})
    kept: dict[str, Any] = json.loads(mark.read_text()) if mark.is_file() else {"key": None}
    if kept["key"] == key and all(Path(f).is_file() for f in kept["drawn"]["files"]):
        return dict(kept["drawn"])
    began = clock.perf_counter()
    sheet = Sheet()
    try:
        chosen.draw(sheet)
        files = sheet.save(out, name, formats)
        seconds = round(clock.perf_counter() - began, 2)
        drawn = about | {"numbers": plain(sheet.numbers), "files": [str(f) for f in files], "seconds": seconds}
        write_atomically(mark, json.dumps({"key": key, "drawn": drawn}, indent=1))
        return drawn
    except ANY_FAILURE as error:
        return {"id": name, "reason": f"{type(error).__name__}: {' '.join(str(error).split())}"}


def _draw_group(names: Sequence[str], out: Path, formats: Sequence[str]) -> list[dict[str, Any]]:
    return [draw_item(name, out, formats) for name in names]


def draw_all(
    ids: Sequence[str], out: Path, *, formats: Sequence[str] = ("png",), jobs: int = 1, progress: Count | None = None
) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Draw items into ``out``; what an interrupted call has drawn is not drawn again (unless the sources changed).

    Returns (drawn, failures): drawn = [{"id", "title", "caption", "numbers", "files": [picture(s) …, csv], "seconds"}],
    failures = [{"id", "reason"}]. ``index.md`` in ``out`` shows all that was drawn, with captions and numbers.
    ``progress`` counts modules. Raises ``InputError`` for an unknown id, ``ValueError`` for an unknown format.
    """
    for name in ids:
        if name not in ITEMS:
            raise InputError(f"gallery {name!r} is not known{nearest(name, ITEMS)}")
    for kind in formats:
        if kind not in FORMATS:
            raise ValueError(f"format must be one of {', '.join(FORMATS)} (got {kind!r})")
    groups: dict[str, list[str]] = {}
    for name in dict.fromkeys(ids):
        groups.setdefault(ITEMS[name].module, []).append(name)
    calls = [(names, Path(out), tuple(formats)) for names in groups.values()]
    found = run_all(
        _draw_group, calls, jobs=jobs, progress=progress,
        on_death=lambda i, why: [{"id": name, "reason": why} for name in calls[i][0]],
    )  # fmt: skip
    entries = sorted((entry for group in found for entry in group), key=lambda e: order(e["id"]))
    drawn = [e for e in entries if "reason" not in e]
    failures = [e for e in entries if "reason" in e]
    try:
        if drawn:
            write_atomically(Path(out) / "index.md", _index(drawn))
    except OSError as error:
        failures.append({"id": "index.md", "reason": str(error)})
    return drawn, failures


def _index(drawn: Sequence[dict[str, Any]]) -> str:
    parts = ["# Figures and tables of the thesis, regenerated\n"]
    for entry in drawn:
        picture, data = Path(entry["files"][0]).name, Path(entry["files"][-1]).name
        picture = f"[the table]({picture})" if picture.endswith(".md") else f"![{entry['id']}]({picture})"
        parts.append(f"## {entry['id']}: {entry['title']}\n\n{picture}\n\n{entry['caption']} ([data]({data}))\n")
        if entry["numbers"]:
            rows = [f"| {name.replace('|', chr(92) + '|')} | {readable(v)} |" for name, v in entry["numbers"].items()]
            parts.append("\n".join(["| number | value |", "| --- | --- |", *rows, ""]))
    return "\n".join(parts)
