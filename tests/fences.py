"""Fenced blocks of README and docs."""

import re
from pathlib import Path
from typing import NamedTuple

from here import ROOT

FENCE = re.compile(r"^```(?P<info>[^\n`]*)\n(?P<body>.*?)^```\s*$", re.S | re.M)


class Block(NamedTuple):
    """A fenced block: language, the rest of its info line, text."""

    language: str
    options: str
    body: str

    @property
    def is_long(self) -> bool:
        return "make verify" in self.options


def blocks(page: Path) -> list[Block]:
    found = FENCE.finditer(page.read_text(encoding="utf-8"))
    return [Block(*match["info"].strip().partition(" ")[::2], match["body"]) for match in found]


def snippet(page: str, words: str) -> str:
    """The first block of a page of the docs that has these words in its title or its text."""
    return next(block.body for block in blocks(ROOT / "docs" / page) if words in block.options + block.body)
