"""The settings of a case file as tables for a terminal and as a page of the documentation."""

from collections.abc import Iterable

from bent_beam.settings import Setting, about, settings
from comparison.readable import text_table

HEAD = ["field", "unit", "default", "allowed", "what"]


def settings_text(word: str = "") -> str:
    """Settings (:func:`about`) as tables for a terminal."""
    texts = []
    for (table, kind), (title, rows) in _tables(about(word)).items():
        head = f"[{table}]" + (f" kind = {kind}" if kind else "") + (f": {title}" if title else "")
        texts.append("\n".join([head, *([text_table(HEAD, rows, left=(0, 4))] if rows else [])]))
    return "\n\n".join(texts)


def settings_markdown() -> str:
    """The page of the documentation; columns without an entry are left out."""
    lines = [
        "# Every setting",
        "",
        "Made from the code by `bentbeam settings --markdown`; a table is a table of a case file.",
    ]
    for (table, kind), (title, rows) in _tables(settings()).items():
        lines += ["", f"## `[{table}]`" + (f" kind = `{kind}`" if kind else ""), "", *([title, ""] if title else [])]
        if not rows:
            continue
        rows = [HEAD, *([f"`{name}`", *others] for name, *others in rows)]
        columns = [column for column in zip(*rows) if any(column[1:])]
        rows = [[cell.replace("|", "\\|").replace("*", "\\*") for cell in row] for row in zip(*columns)]
        rows.insert(1, ["---"] * len(columns))
        lines += ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([*lines, ""])


def _tables(chosen: Iterable[Setting]) -> dict[tuple[str, str | None], tuple[str, list[list[str]]]]:
    """What a kind is, and rows, by table and kind: field, unit, default, what is allowed, what it is."""
    found: dict[tuple[str, str | None], tuple[str, list[list[str]]]] = {}
    titles = {(s.table, s.kind): s.text for s in settings() if s.name == "kind"}
    for s in chosen:
        _, rows = found.setdefault((s.table, s.kind), (titles.get((s.table, s.kind), ""), []))
        if s.name != "kind":
            rows.append([s.name, s.unit, "required" if s.default is None else s.default, s.allowed, s.text])
    return found
