"""Docstrings as they stand in the source: the first paragraph as prose, the rest as preformatted text.

Equations and lists of parameters are laid out by hand there, and Markdown would fold them.
"""

from __future__ import annotations

import re
from typing import Any

import griffe

ROLE = re.compile(r":[a-z]+:`~?([^`]+)`")


class PlainDocstrings(griffe.Extension):
    """Rewrites every docstring that is collected."""

    def on_object(self, *, obj: griffe.Object, **_: Any) -> None:
        if obj.docstring is not None:
            obj.docstring.value = plain(obj.docstring.value)


def plain(text: str) -> str:
    """A docstring as Markdown that keeps its layout."""
    text = ROLE.sub(r"`\1`", text.strip("\n"))
    first, _, rest = text.partition("\n\n")
    head = re.sub(r"([\[\]*_|<>#])", r"\\\1", " ".join(first.split()))
    head = re.sub(r"`+[^`]*`+", lambda m: m[0].replace("\\", ""), head)
    rest = rest.strip("\n").replace("``", "").replace("**", "")
    return head + (f"\n\n```text\n{rest}\n```" if rest else "")
