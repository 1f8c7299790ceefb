"""Docstrings as Markdown: paragraphs as prose, sections and lists of fields as lists, indented lines as they stand."""

import pydoc
import re
import textwrap
from typing import Any

import griffe

from bent_beam.fields import Part, declared

ROLE = re.compile(r":[a-z]+:`~?([^`]+)`")
CODE = re.compile(r"`+[^`]*`+")
FIELD = re.compile(r"([A-Za-z_][\w.,* ]*?) : (.*)", re.DOTALL)


class PlainDocstrings(griffe.Extension):
    """Rewrites every docstring that is collected, and adds the fields of parts, which their annotations describe."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        if obj.docstring is not None:
            obj.docstring.value = markdown(obj.docstring.value)
            part = pydoc.locate(obj.path) if obj.is_class else None
            if isinstance(part, type) and issubclass(part, Part):
                obj.docstring.value += fields_of(part)

    def on_package(self, *, pkg: griffe.Module, **_: Any) -> None:
        if pkg.docstring is not None:  # on_object is not called for a package
            pkg.docstring.value = markdown(pkg.docstring.value)


def fields_of(part: type) -> str:
    """Name, unit, range and meaning of every field of a part, as a list in Markdown."""
    text = "\n\n**Fields**\n"
    for name, field in declared(part).items():
        quantity = field.quantity
        if not quantity.text:
            continue
        known = ", ".join(word for word in (quantity.unit, quantity.allowed) if word)
        text += f"\n- `{name}`{f' ({_prose(known)})' if known else ''}: {_prose(quantity.text)}"
    return text


def markdown(text: str) -> str:
    """A docstring as Markdown."""
    text = ROLE.sub(r"`\1`", text.strip("\n")).replace("``", "`")
    return "\n\n".join(_block(block) for block in re.split(r"\n\s*\n", text) if block.strip())


def _block(block: str) -> str:
    lines = block.strip("\n").splitlines()
    if all(line.startswith("    ") for line in lines):  # equations and tables, laid out by hand
        return "```text\n" + textwrap.dedent("\n".join(lines)) + "\n```"
    if all(line.startswith("|") for line in lines):
        return re.sub(r"([*_])", r"\\\1", block)
    if any(line.strip().startswith(">>>") for line in lines):
        return "```pycon\n" + textwrap.dedent("\n".join(lines)) + "\n```"
    if len(lines) > 1 and lines[0].endswith(":") and all(line.startswith("    ") for line in lines[1:]):
        entries = _entries(textwrap.dedent("\n".join(lines[1:])).splitlines())
        return f"**{lines[0].strip()[:-1]}**\n\n" + "\n".join(f"- {_prose(entry)}" for entry in entries)
    entries = _entries(lines)
    if entries and all(FIELD.fullmatch(entry) for entry in entries):
        return "\n".join(f"- `{m[1]}`: {_prose(m[2])}" for m in map(FIELD.fullmatch, entries) if m)
    return _prose(block)


def _entries(lines: list[str]) -> list[str]:
    """Lines of a list, each with the indented lines that go on with it."""
    found: list[str] = []
    for line in lines:
        if line.startswith("    ") and found:
            found[-1] += " " + line.strip()
        else:
            found.append(line.strip())
    return found


def _prose(text: str) -> str:
    """One paragraph; signs that Markdown would take for its own are escaped, but for code."""
    text = " ".join(text.split())
    escaped = re.sub(r"([\[\]*_|#])", r"\\\1", text).replace("<", "&lt;")
    return CODE.sub(lambda m: m[0].replace("\\", "").replace("&lt;", "<"), escaped)
