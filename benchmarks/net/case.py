"""A case of the net: commands of ``bentbeam``, and how closely their answers are held.

Three classes. ``same``: every number comes again to 1e-9 of the size of its family, or to 30 times what a nudge of the
input by 1e-13 changed when the answers were recorded. ``bar``: the settings are the program's own and may become
better ones, so the numbers stay within their recorded error bars, or within ``relative`` where there is none. ``band``:
an undamped whole impact is irregular, so its means stay within what so few runs allow.
"""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import Path

__all__ = ["Case", "part", "sets"]

UNIT = Path(__file__).parent / "unit.toml"
CASE_FILES = UNIT.parents[2] / "cases"


@dataclass(frozen=True)
class Case:
    """One case of the net.

    command : of ``bentbeam``; ``{n}`` stands for ``number``, which the recording nudges, ``{folder}`` for a place for
    files. before : a command that has to run first. kind : same, bar or band. relative : tolerance of a number without
    an error bar, and the least of one with it (not of ``same``).
    """

    name: str
    command: str
    number: float = 1.0
    kind: str = "same"
    reason: str = "every setting is stated"
    relative: float = 0.0
    before: str = ""

    @property
    def asked(self) -> str:
        """What is asked, to see whether an answer belongs to it."""
        return "; ".join(line for line in (self.before, self.command) if line) + f" with n = {self.number!r}"

    def arguments(self, folder: Path, nudge: float = 0.0) -> list[list[str]]:
        """The commands as lists of words."""
        fill = {
            "n": repr(self.number * (1.0 + nudge)),
            "folder": str(folder),
            "cases": str(CASE_FILES),
            "unit": str(UNIT),
        }
        return [shlex.split(line.format(**fill)) for line in (self.before, self.command) if line]


def sets(text: str) -> str:
    """``a.b=1 c.d=2`` as ``--set`` options."""
    return " ".join(f"--set {shlex.quote(word)}" for word in text.split())


def part(table: str, text: str) -> str:
    """``kind field=value`` of one table as assignments."""
    kind, *fields = text.split()
    return " ".join([f"{table}.kind={kind}", *(f"{table}.{field}" for field in fields)])
